"""`tappet check --static`: coding rules chosen on the command line."""

from __future__ import annotations

from pathlib import Path

from tests.cli.invoke import invoke

from tappet.project import edit, folder
from tappet.project.new_project import new_project


def test_rules_are_chosen_by_code(tmp_path: Path) -> None:
    text = "PROGRAM P\nVAR n : INT; END_VAR\nn := n + 1437;\nEND_PROGRAM\n"
    (tmp_path / "p.st").write_text(text)
    plain = invoke("check", tmp_path)
    chosen = invoke("check", tmp_path, "--static", "S1211")
    assert (plain.code, chosen.code) == (0, 0)
    assert "S1211" not in plain.output
    assert "p.st:3:10: warning S1211: The number 1437 has no name" in chosen.output
    assert "S1006" not in chosen.output


def test_an_unknown_rule_is_named(tmp_path: Path) -> None:
    (tmp_path / "p.st").write_text("PROGRAM P\nEND_PROGRAM\n")
    result = invoke("check", tmp_path, "--static", "Q7")
    assert result.code == 2
    assert "'Q7'" in result.errors


def test_warnings_that_the_project_switches_off_are_not_shown(tmp_path: Path) -> None:
    project = new_project("Press")
    (program,) = project.find_kind("pou")
    declaration = "PROGRAM PLC_PRG\nVAR\n    a, b : REAL;\n    x : BOOL;\nEND_VAR"
    texts = {"declaration": declaration, "implementation": "x := a = b;"}
    project = edit.change_data(project, program.id, texts)
    folder.save(project, tmp_path / "all")
    off = {"disabled_warnings": ["W1122"]}
    folder.save(edit.change_data(project, project.applications()[0].id, off), tmp_path / "off")
    assert "W1122" in invoke("check", tmp_path / "all").output
    assert "W1122" not in invoke("check", tmp_path / "off").output
    assert "W1122" not in invoke("check", tmp_path / "off", "--static", "S1211").output
