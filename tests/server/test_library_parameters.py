"""Values that library managers give to parameters: in builds, in their messages and in the editor."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest
from fastapi.testclient import TestClient

from tappet.lang.services.documents import Position
from tappet.lang.services.hover import hover
from tappet.lang.services.workspace import Workspace
from tappet.libraries import archive, repository
from tappet.project import edit
from tappet.project.model import Project, ProjectObject
from tappet.server.lsp.project_programs import ProjectPrograms, part_uri
from tappet.server.services import Services

LISTS = {
    "GVL_Belt": (
        "{attribute 'qualified_only'}\n{attribute 'parameter_list'}\n"
        "VAR_GLOBAL CONSTANT\n    cSlots : INT := 4; // Places\nEND_VAR\n"
    ),
    "Belt": (
        "FUNCTION_BLOCK Belt\nVAR\n    aPlace : ARRAY[1..GVL_Belt.cSlots] OF LREAL;\nEND_VAR\n"
        "aPlace[1] := aPlace[1] + 1.0;\nEND_FUNCTION_BLOCK\n"
    ),
}
BODY = "belt();\nn := GVL_Belt.cSlots;"


@pytest.fixture(autouse=True)
def library_folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv(repository.LOCATION_VARIABLE, str(tmp_path / "libraries"))
    archive.install(archive.manifest("Conveyors", "1.0.0.0"), LISTS)


class Plant:
    """A stored project with two applications, each with a library manager of its own."""

    def __init__(self, client: TestClient, services: Services) -> None:
        self.client = client
        self.store = services.store
        project = Project("Plant")
        for name in ("Small", "Large"):
            project, _ = edit.add_object(project, None, "device", name)
            application = next(a for a in project.applications() if project.path_of(a.id).startswith(name))
            body = {
                "declaration": "PROGRAM PLC_PRG\nVAR\n    belt : Belt;\n    n : INT;\nEND_VAR",
                "implementation": BODY,
            }
            project, _ = edit.add_object(project, application.id, "pou", "PLC_PRG", data=body)
        body = {"declaration": "FUNCTION Twice : INT", "implementation": "Twice := 2;"}
        project, _ = edit.add_object(project, None, "pou", "Twice", data=body)
        self.id = self.store.create_project("Plant", "ann", content=project).id

    def find(self, path: str) -> ProjectObject:
        project = self.store.load(self.id)
        found = project.find(path)
        assert found is not None, [project.path_of(item.id) for item in project.walk()]
        return found

    def give(self, device: str, value: str | None, name: str = "cSlots") -> str:
        """Saves the value as the library manager of the workbench does; the manager's id."""
        manager = self.find(f"{device}/PLC Logic/Application/Library Manager")
        values = [{"list": "GVL_Belt", "name": name, "value": value}] if value else []
        references = [{"name": "Conveyors", "version": "*", "namespace": "", "parameters": values}]
        body = {"base_revision": manager.revision, "data": {"references": references}}
        answer = self.client.put(f"/api/v1/projects/{self.id}/objects/{manager.id}", json=body)
        assert answer.status_code == 200, answer.text
        given = answer.json()["data"]["references"][0]
        assert given.get("parameters", []) == values
        return manager.id

    def build(self, device: str) -> dict[str, Any]:
        application = self.find(f"{device}/PLC Logic/Application")
        answer = self.client.post(f"/api/v1/projects/{self.id}/applications/{application.id}/build")
        assert answer.status_code == 200, answer.text
        report: dict[str, Any] = answer.json()
        return report


@pytest.fixture
def plant(admin: TestClient, services: Services) -> Plant:
    return Plant(admin, services)


def test_two_applications_of_a_project_have_values_of_their_own(plant: Plant) -> None:
    plant.give("Small", "2")
    plant.give("Large", "1000")
    small, large = plant.build("Small"), plant.build("Large")
    assert small["ok"]
    assert large["ok"]
    assert large["data_size"] - small["data_size"] >= 998 * 8
    before = plant.build("Small")["data_id"]
    plant.give("Small", "3")
    assert plant.build("Small")["data_id"] != before


@pytest.mark.parametrize(
    ("name", "value", "code", "ok"),
    [("cSlots", "'many'", "E0904", False), ("cSlots", "n", "E0904", False), ("cGone", "1", "W1411", True)],
)
def test_a_message_about_a_value_leads_to_the_library_manager(
    plant: Plant, name: str, value: str, code: str, ok: bool
) -> None:
    manager = plant.give("Small", value, name)
    report = plant.build("Small")
    assert report["ok"] is ok
    (found,) = [d for d in report["diagnostics"] if d["severity"] in ("error", "warning")]
    assert (found["code"], found["object_id"], found["part"], found["line"]) == (code, manager, None, None)
    assert found["object_path"] == "Small/PLC Logic/Application/Library Manager"


def test_a_project_whose_values_do_not_suit_becomes_no_library(plant: Plant) -> None:
    manager = plant.give("Small", "'many'")
    answer = plant.client.post(f"/api/v1/projects/{plant.id}/library", json={"version": "1.0.0.0"})
    assert answer.status_code == 422
    found = [d for d in answer.json().get("diagnostics", []) if d["severity"] == "error"]
    assert [(d["code"], d["object_id"]) for d in found] == [("E0904", manager)]


def test_a_missing_library_leads_to_the_library_manager(plant: Plant) -> None:
    manager = plant.give("Small", None)
    archive.remove("Conveyors", "1.0.0.0")
    found = [d for d in plant.build("Small")["diagnostics"] if d["code"] == "E0902"]
    assert [d["object_id"] for d in found] == [manager]


def test_hover_shows_the_value_of_the_application(plant: Plant) -> None:
    plant.give("Small", "2")
    plant.give("Large", "10 * 100")
    programs = ProjectPrograms(plant.id, lambda: plant.store.load(plant.id))
    workspace = Workspace(programs)

    def shown(device: str) -> str:
        main = plant.find(f"{device}/PLC Logic/Application/PLC_PRG")
        document = part_uri(plant.id, main.id, "implementation")
        found = hover(
            workspace.snapshot(document), document, Position(1, BODY.splitlines()[1].index("cSlots"))
        )
        assert found is not None
        return found.code

    assert shown("Small") == "VAR_GLOBAL CONSTANT cSlots : INT := 2;"
    assert shown("Large") == "VAR_GLOBAL CONSTANT cSlots : INT := 10 * 100;"
    plant.give("Small", None)
    programs.changed()
    workspace.refresh()
    assert shown("Small") == "VAR_GLOBAL CONSTANT cSlots : INT := 4;"
