"""`tappet compare`."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from tests.cli.invoke import invoke

from tappet.project import edit, folder
from tappet.project.exchange.plcopen_write import write_plcopen
from tappet.project.model import Project
from tappet.project.new_project import new_project


@pytest.fixture
def project() -> Project:
    project = new_project("Press")
    application = project.applications()[0].id
    project, _ = edit.add_object(project, application, "gvl", "GVL_Speeds")
    return project


def saved(project: Project, path: Path) -> Path:
    folder.save(project, path)
    return path


def changed(project: Project) -> Project:
    """The project with a comment, another task name, a new block and without its list."""
    application = project.applications()[0].id
    program = next(item for item in project.walk() if item.name == "PLC_PRG")
    task = next(item for item in project.walk() if item.kind == "task")
    speeds = next(item for item in project.walk() if item.name == "GVL_Speeds")
    project = edit.change_data(project, program.id, {**program.data.model_dump(), "implementation": "// go"})
    project = edit.rename_object(project, task.id, "Fast")
    project = edit.delete_object(project, speeds.id)
    project, _ = edit.add_object(project, application, "pou", "FB_New", subkind="function_block")
    return project


def test_two_folders_in_text_and_json(project: Project, tmp_path: Path) -> None:
    a, b = saved(project, tmp_path / "a"), saved(changed(project), tmp_path / "b")
    done = invoke("compare", a, b)
    where = "Tappet Soft PLC/PLC Logic/Application"
    assert done.code == 1
    assert sorted(done.output.splitlines()) == [
        "1 added, 1 removed, 2 changed",
        f"added   {where}/FB_New",
        f"changed {where}/PLC_PRG: implementation",
        f"changed {where}/Task Configuration/Fast: renamed from MainTask",
        f"removed {where}/GVL_Speeds",
    ]
    found = json.loads(invoke("compare", a, b, "--format", "json").output)["differences"]
    program = next(one for one in found if one["path"].endswith("PLC_PRG"))
    assert program["fields"] == [{"field": "implementation", "old": "", "new": "// go"}]
    assert "PLC_PRG" not in invoke("compare", a, b, "--ignore-comments", "--ignore-white-space").output
    assert "    +// go" in invoke("compare", a, b, "--lines").output.splitlines()


def test_equal_projects_and_their_export(project: Project, tmp_path: Path) -> None:
    a, b = saved(project, tmp_path / "a"), saved(project, tmp_path / "b")
    assert invoke("compare", a, b) == (0, "no differences\n", "")
    (tmp_path / "press.xml").write_bytes(write_plcopen(project))
    (tmp_path / "press.zip").write_bytes(folder.write_zip(project))
    assert invoke("compare", a, tmp_path / "press.zip").code == 0
    assert invoke("compare", a, tmp_path / "press.xml") == (0, "no differences\n", "")


def test_what_cannot_be_compared_is_wrong_usage(project: Project, tmp_path: Path) -> None:
    a = saved(project, tmp_path / "a")
    assert invoke("compare", a, tmp_path / "none").code == 2
    (tmp_path / "x.project").write_bytes(b"PK")
    done = invoke("compare", a, tmp_path / "x.project")
    assert (done.code, "CODESYS" in done.errors) == (2, True)
