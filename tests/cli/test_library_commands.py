"""`tappet library save | install | remove`: a project becomes a library that another program uses."""

import json
from pathlib import Path

import pytest
from tests.cli import invoke as commands

from tappet.libraries import repository
from tappet.project import edit, folder
from tappet.project.model import Project
from tappet.project.new_project import new_project


@pytest.fixture(autouse=True)
def library_folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv(repository.LOCATION_VARIABLE, str(tmp_path / "libraries"))


def project_of_motor() -> Project:
    project = new_project("Drives", description="Motors")
    application = project.applications()[0]
    interface = {"declaration": "(* Something that runs. *)\nINTERFACE I_Run"}
    project, run = edit.add_object(project, application.id, "interface", "I_Run", data=interface)
    project, _ = edit.add_object(
        project, run.id, "method", "Start", data={"declaration": "METHOD Start : BOOL"}
    )
    declaration = (
        "(* A motor. *)\nFUNCTION_BLOCK FB_Motor IMPLEMENTS I_Run\nVAR\n    n : INT;\n    t : TON;\nEND_VAR"
    )
    body = {"declaration": declaration, "implementation": "n := n + cStep;"}
    project, motor = edit.add_object(project, application.id, "pou", "FB_Motor", data=body)
    body = {"declaration": "METHOD Start : BOOL", "implementation": "n := 100;\nStart := TRUE;"}
    project, _ = edit.add_object(project, motor.id, "method", "Start", data=body)
    project, _ = edit.add_object(project, motor.id, "action", "Reset", data={"implementation": "n := 0;"})
    project, count = edit.add_object(
        project, motor.id, "property", "Count", data={"declaration": "PROPERTY Count : INT"}
    )
    project = edit.change_data(project, project.children(count.id)[0].id, {"implementation": "Count := n;"})
    declaration = "VAR_GLOBAL CONSTANT\n    cStep : INT := 7;\nEND_VAR"
    project, _ = edit.add_object(project, None, "gvl", "Steps", data={"declaration": declaration})
    return project


def invoke(*arguments: object) -> str:
    done = commands.invoke(*arguments)
    assert done.code == 0, done.errors
    return done.output


def test_a_project_is_saved_installed_used_and_removed(tmp_path: Path) -> None:
    folder.save(project_of_motor(), tmp_path / "project")
    file = tmp_path / "drives.tappetlib"
    said = invoke(
        "library", "save", tmp_path / "project", "--to", file, "--version", "1.0.0.0", "--company", "W"
    )
    assert "3 objects" in said
    invoke("library", "install", file)
    assert "Drives" in invoke("library", "list")
    shown = json.loads(invoke("library", "show", "Drives, 1.0.0.0 (W)", "--format", "json"))
    assert [item["name"] for item in shown] == ["FB_Motor", "I_Run"]
    program = tmp_path / "main.st"
    program.write_text(
        "PROGRAM Main\nVAR m : Drives.FB_Motor; r : I_Run; n, c : INT; END_VAR\n"
        "m(); n := m.Count; r := m; r.Start(); c := m.Count; m.Reset(); m();\nEND_PROGRAM\n"
    )
    values = invoke(
        "run", program, "--virtual", "--print", "Main.n", "--print", "Main.c", "--print", "Main.m.n"
    )
    assert values.split() == ["Main.n", "=", "7", "Main.c", "=", "100", "Main.m.n", "=", "7"]
    invoke("library", "remove", "Drives", "1.0.0.0")
    refused = commands.invoke("library", "remove", "Drives", "1.0.0.0")
    assert refused.code == 2
    assert "is not installed" in refused.errors


def test_a_library_can_ask_for_its_namespace(tmp_path: Path) -> None:
    folder.save(project_of_motor(), tmp_path / "project")
    file = tmp_path / "drives.tappetlib"
    invoke("library", "save", tmp_path / "project", "--to", file, "--version", "1.0.0.0", "--qualified-only")
    invoke("library", "install", file)
    shown = invoke("library", "show", "Drives")
    assert shown.startswith("LIBRARY Drives 1.0.0.0, namespace Drives, qualified access only\n")
    listed = json.loads(invoke("library", "list", "--format", "json"))
    flags = {library["name"]: library["qualified_only"] for library in listed}
    assert (flags["Drives"], flags["Standard"]) == (True, False)
    program = tmp_path / "main.st"
    program.write_text("PROGRAM Main\nVAR m : FB_Motor; END_VAR\nm();\nEND_PROGRAM\n")
    refused = commands.invoke("check", program)
    assert refused.code == 1
    assert "Write 'Drives.FB_Motor'" in refused.output


def test_a_project_that_does_not_compile_is_no_library(tmp_path: Path) -> None:
    project = project_of_motor()
    body = {"declaration": "FUNCTION Bad : INT", "implementation": "Bad := nowhere;"}
    project, _ = edit.add_object(project, None, "pou", "Bad", data=body)
    folder.save(project, tmp_path / "project")
    file = tmp_path / "bad.tappetlib"
    result = commands.invoke("library", "save", tmp_path / "project", "--to", file, "--version", "1.0")
    assert result.code == 1
    assert "nowhere" in result.errors
    assert not file.exists()


def test_a_folder_that_is_no_library_is_refused(tmp_path: Path) -> None:
    refused = commands.invoke("library", "install", tmp_path)
    assert refused.code == 2
    assert "has no library.json" in refused.errors
