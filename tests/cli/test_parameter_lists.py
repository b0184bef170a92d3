"""`tappet library` and `tappet check` with parameter lists."""

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


def invoke(*arguments: object, code: int = 0) -> str:
    done = commands.invoke(*arguments)
    assert done.code == code, done.errors
    return done.output


def library_project() -> Project:
    """A list as 'Add object' makes it, with two parameters, and a block that has room for them."""
    project = new_project("Belts")
    application = project.applications()[0]
    project, sizes = edit.add_object(project, application.id, "gvl", "GVL_Belt", subkind="parameter_list")
    declared = sizes.data.model_dump()["declaration"].replace(
        "END_VAR", "    cSlots : INT := 4; // Places\n    cPause : TIME := T#5ms;\nEND_VAR"
    )
    project = edit.change_data(project, sizes.id, {"declaration": declared})
    body = {
        "declaration": "FUNCTION_BLOCK Belt\nVAR\n    a : ARRAY[1..GVL_Belt.cSlots] OF INT;\nEND_VAR\n"
        "VAR_OUTPUT\n    n : DINT;\nEND_VAR",
        "implementation": "n := UPPER_BOUND(a, 1);",
    }
    project, _ = edit.add_object(project, application.id, "pou", "Belt", data=body)
    return project


def machine(value: str) -> Project:
    project = new_project("Machine")
    manager = next(item for item in project.walk() if item.kind == "library_manager")
    values = [{"list": "GVL_Belt", "name": "cSlots", "value": value}]
    project = edit.change_data(project, manager.id, {"references": [{"name": "Belts", "parameters": values}]})
    main = next(item for item in project.walk() if item.name == "PLC_PRG")
    body = {"declaration": "PROGRAM PLC_PRG\nVAR\n    b : Belt;\nEND_VAR", "implementation": "b();"}
    return edit.change_data(project, main.id, body)


def test_a_project_with_a_parameter_list_becomes_a_library_with_parameters(tmp_path: Path) -> None:
    folder.save(library_project(), tmp_path / "belts")
    file = tmp_path / "belts.tappetlib"
    invoke("library", "save", tmp_path / "belts", "--to", file, "--version", "1.0.0.0")
    invoke("library", "install", file)
    shown = [line.rstrip() for line in invoke("library", "show", "Belts").splitlines()]
    at = shown.index("PARAMETER_LIST GVL_Belt")
    assert shown[at + 1 : at + 4] == [
        "  VAR_GLOBAL CONSTANT",
        "    cSlots : INT := 4  Places",
        "    cPause : TIME := T#5ms",
    ]
    folder.save(machine("3 * 5"), tmp_path / "machine")
    ran = invoke("run", tmp_path / "machine", "--virtual", "--cycles", "1", "--print", "PLC_PRG.b.n")
    assert ran.split() == ["PLC_PRG.b.n", "=", "15"]
    folder.save(machine("many"), tmp_path / "faulty")
    said = invoke("check", tmp_path / "faulty", code=1)
    assert "Application/Library Manager:1:1: error E0904: Library 'Belts', list 'GVL_Belt'" in said
