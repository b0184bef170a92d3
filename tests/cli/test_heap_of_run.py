"""The heap of the application of a project folder is that of `tappet run` and `tappet test`."""

from __future__ import annotations

from pathlib import Path

import pytest
from invoke import invoke

from tappet.project import edit, folder
from tappet.project.new_project import new_project

TEXT = {
    "declaration": "PROGRAM PLC_PRG\nVAR p : POINTER TO BYTE; made : DINT; END_VAR",
    "implementation": "p := __NEW(BYTE, 1000);\nIF p <> 0 THEN made := made + 1; END_IF",
}


@pytest.mark.parametrize(("limit_kib", "least", "most"), [(16, 12, 16), (32, 25, 32), (None, 100, 100)])
def test_a_run_has_the_limit_of_the_project(
    tmp_path: Path, limit_kib: int | None, least: int, most: int
) -> None:
    project = new_project("Heap")
    (application,) = project.applications()
    program = next(item for item in project.walk() if item.name == "PLC_PRG")
    project = edit.change_data(project, program.id, TEXT)
    if limit_kib is not None:
        project = edit.change_data(project, application.id, {"heap": {"limit_kib": limit_kib}})
    folder.save(project, tmp_path)
    stored = [path for path in tmp_path.rglob("*.json") if "limit_kib" in path.read_text()]
    assert len(stored) == (limit_kib is not None)
    ran = invoke("run", tmp_path, "--cycles", 100, "--virtual", "--print", "PLC_PRG.made")
    assert ran.code == 0, ran.errors
    assert least <= int(ran.output.strip().rpartition(" ")[2]) <= most
