"""The tree that a preview shows, choosing from it, places for imports, parts of projects on their way out."""

from __future__ import annotations

import pytest
from twincat_project import FILES

from tappet.project import edit
from tappet.project.errors import UnknownObjectError
from tappet.project.exchange.choosing import ImportNode
from tappet.project.exchange.importing import import_files
from tappet.project.exchange.parts import chosen_ids, part_of, st_files
from tappet.project.exchange.placing import Place
from tappet.project.exchange.plcopen_write import write_plcopen
from tappet.project.folder.codec import encode
from tappet.project.model import Project
from tappet.project.new_project import new_project
from tappet.project.sources import application_sources

PUMP = (
    b"FUNCTION_BLOCK FB_Pump\nVAR\nEND_VAR\nMETHOD Start : BOOL\nEND_METHOD\n"
    b"METHOD Stop : BOOL\nEND_METHOD\nEND_FUNCTION_BLOCK\n"
    b"TYPE E_State : (Idle, Busy); END_TYPE\n"
    b"CONFIGURATION c RESOURCE r ON PLC TASK T(INTERVAL := T#10ms, PRIORITY := 1);\n"
    b"PROGRAM Main WITH T : MAIN; END_RESOURCE END_CONFIGURATION\n"
)


def at(project: Project, name: str) -> str:
    return next(item.id for item in project.walk() if item.name == name)


def keys(nodes: list[ImportNode], *names: str) -> list[str]:
    return [node.key for node in nodes if node.name in names]


def test_the_tree_of_an_import_and_what_is_chosen_of_it() -> None:
    whole = import_files({"Pumps.st": PUMP})
    shown = [(node.name, node.kind, node.subkind) for node in whole.nodes]
    assert shown[:4] == [
        ("FB_Pump", "pou", "function_block"),
        ("Start", "method", None),
        ("Stop", "method", None),
        ("E_State", "dut", "enum"),
    ]
    parents = {node.key: node.parent for node in whole.nodes}
    (start,) = keys(whole.nodes, "Start")
    assert parents[start] in keys(whole.nodes, "FB_Pump")
    some = import_files({"Pumps.st": PUMP}, chosen=[start])
    names = {item.name for item in some.project.walk()}
    assert {"FB_Pump", "Start"} <= names
    assert names.isdisjoint({"Stop", "E_State"})
    assert [node.key for node in some.nodes] == [node.key for node in whole.nodes]


def test_objects_go_to_the_place_that_is_asked_for() -> None:
    project = new_project("Press")
    application = project.applications()[0]
    project, folder = edit.add_object(project, application.id, "folder", "Pumps")
    project, shared = edit.add_object(project, None, "folder", "Shared")
    inside = import_files({"Pumps.st": PUMP}, project, where=Place(folder.id)).project
    assert inside.path_of(at(inside, "FB_Pump")).endswith("Application/Pumps/FB_Pump")
    assert inside.path_of(at(inside, "T")).endswith("Application/Task Configuration/T")
    for place, path in ((Place(shared.id), "Shared/FB_Pump"), (Place(None), "FB_Pump")):
        placed = import_files({"Pumps.st": PUMP}, project, where=place)
        assert placed.project.path_of(at(placed.project, "FB_Pump")) == path
        refused = [entry.object for entry in placed.report.entries if entry.outcome == "refused"]
        assert refused == ["Task Configuration"]
    program = at(project, "PLC_PRG")
    with pytest.raises(UnknownObjectError, match="takes no imported objects"):
        import_files({"Pumps.st": PUMP}, project, where=Place(program))
    with pytest.raises(UnknownObjectError):
        import_files({"Pumps.st": PUMP}, project, where=Place("0" * 32))


def test_the_report_knows_the_objects() -> None:
    project = import_files({"Pumps.st": PUMP}, new_project("Press")).project
    again = import_files({"Pumps.st": PUMP}, project)
    renamed = next(entry for entry in again.report.entries if "imported as 'FB_Pump_1'" in entry.text)
    assert renamed.object_id is not None
    assert again.project.get(renamed.object_id).name == "FB_Pump_1"
    start = next(entry for entry in again.report.entries if entry.object == "FB_Pump_1.Start")
    assert start.object_id is not None
    assert again.project.get(start.object_id).kind == "method"


def test_what_is_excluded_from_the_build_stays_so() -> None:
    imported = import_files(FILES)
    assert {node.name: node.excluded for node in imported.nodes} == {"FB_Used": False, "FB_Old": True}
    project = imported.project
    assert project.get(at(project, "FB_Old")).excluded
    compiled = [text.uri for text in application_sources(project, project.applications()[0].id)]
    assert compiled == ["FB_Used"]
    back = import_files({"line.xml": write_plcopen(project)}).project
    assert back.get(at(back, "FB_Old")).excluded
    assert not back.get(at(back, "FB_Used")).excluded


def test_our_own_archive_comes_in_whole_or_in_parts() -> None:
    origin = import_files({"Pumps.st": PUMP}, new_project("Press")).project
    files = {f"Press/{path}": content for path, content in encode(origin).items()} | {"Press/README.md": b"x"}
    whole = import_files(files)
    assert encode(whole.project) == encode(origin) | {"README.md": b"x"}
    fresh = import_files(files, chosen=keys(whole.nodes, "E_State")).project
    assert fresh.find_kind("library_manager")
    assert not fresh.find_kind("task")
    part = import_files(files, new_project("Other"), chosen=keys(whole.nodes, "E_State"))
    added = {item.name for item in part.project.walk()} - {item.name for item in new_project("x").walk()}
    assert added == {"E_State"}
    broken = import_files({**files, "Press/Devices/index.json": b"[", "x.st": PUMP})
    assert [e.source for e in broken.report.entries if e.outcome == "refused"] == ["Press/Devices/index.json"]


def test_parts_of_a_project_go_out() -> None:
    project = import_files({"Pumps.st": PUMP}, new_project("Press")).project
    part = part_of(project, [at(project, "FB_Pump")])
    assert [item.name for item in part.walk()][-3:] == ["FB_Pump", "Start", "Stop"]
    texts = st_files(part)
    (path,) = texts
    assert path.endswith("Application/FB_Pump.st")
    again = import_files({path: texts[path].encode()}, new_project("Other")).project
    assert {"FB_Pump", "Start", "Stop"} <= {item.name for item in again.walk()}
    assert b"E_State" not in write_plcopen(part)
    with pytest.raises(UnknownObjectError, match="no POU"):
        st_files(part_of(project, [at(project, "Task Configuration")]))
    with pytest.raises(UnknownObjectError):
        part_of(project, ["0" * 32])


def test_the_nearest_name_decides_what_is_chosen() -> None:
    project = import_files({"Pumps.st": PUMP}, new_project("Press")).project
    pump, start, application = (at(project, name) for name in ("FB_Pump", "Start", "Application"))

    def names(ids: list[str], without: list[str]) -> set[str]:
        return {project.get(one).name for one in chosen_ids(project, ids, without)}

    everything = {item.name for item in project.walk()}
    assert names([], []) == everything
    assert names([pump], [start]) == {"FB_Pump", "Stop"}
    assert names([], [pump]) == everything - {"FB_Pump", "Start", "Stop"}
    assert names([start], [pump]) == {"Start"}
    below = {item.name for item in project.walk(application)} | {"Application"}
    assert names([application, start], [pump]) == below - {"FB_Pump", "Stop"}
    part = part_of(project, [application], [start])
    assert {item.name for item in project.walk()} - {
        item.name for item in part.walk()
    } == everything - below - {item.name for item in project.ancestors(application)} | {"Start"}
    with pytest.raises(UnknownObjectError):
        chosen_ids(project, [], ["0" * 32])
