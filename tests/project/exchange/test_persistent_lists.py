"""Persistent variables of an import join the one list of an application, wherever it stands (PERS-02)."""

import pytest

from tappet.project.edit import add_object
from tappet.project.exchange.drafts import Batch, Draft
from tappet.project.exchange.placing import Place, place
from tappet.project.exchange.report import ImportReport
from tappet.project.new_project import new_project
from tappet.project.placement import check_project


def text(name: str) -> str:
    return f"VAR_GLOBAL PERSISTENT RETAIN\n    {name} : INT;\nEND_VAR"


@pytest.mark.parametrize("at", ["application", "folder"])
@pytest.mark.parametrize("own", ["none", "application", "folder"])
@pytest.mark.parametrize("imported", [("application",), ("folder",), ("folder", "application")])
def test_all_variables_are_in_the_one_list(at: str, own: str, imported: tuple[str, ...]) -> None:
    project = new_project("P")
    application = project.applications()[0]
    project, folder = add_object(project, application.id, "folder", "Own")
    if own != "none":
        parent = folder.id if own == "folder" else application.id
        project, _ = add_object(project, parent, "persistent", "Kept")
    batch = Batch()
    for number, where in enumerate(imported):
        target = batch.loose.below(("Deep", "Deeper"), "a.export") if where == "folder" else batch.loose
        draft = Draft("persistent", f"Persistent{number}", {"declaration": text(f"x{number}")}, "a.export")
        target.children.append(draft)
    report = ImportReport()
    result = place(batch, project, report, Place(folder.id if at == "folder" else application.id))
    check_project(result)
    (only,) = result.find_kind("persistent")
    declaration = only.data.model_dump()["declaration"]
    assert [f"x{number} :" in declaration for number in range(len(imported))] == [True] * len(imported)
    assert not [entry for entry in report.entries if entry.outcome == "refused"]
