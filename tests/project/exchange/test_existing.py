"""Imports of what exists already: overwrite, rename, merge, skip, for all and for single objects."""

from __future__ import annotations

import pytest

from tappet.project import edit
from tappet.project.errors import InvalidNameError, NameTakenError
from tappet.project.exchange.deciding import Decided
from tappet.project.exchange.existing import Decision, Decisions, ExistingAct
from tappet.project.exchange.importing import Imported, import_files
from tappet.project.folder.codec import encode
from tappet.project.model import Project, ProjectObject
from tappet.project.new_project import new_project

OLD = b"""FUNCTION_BLOCK FB_Pump
VAR
  bOn : BOOL;
END_VAR
bOn := TRUE;
METHOD Start : BOOL
Start := TRUE;
END_METHOD
METHOD Stop : BOOL
END_METHOD
END_FUNCTION_BLOCK
TYPE E_State : (Idle, Busy); END_TYPE
"""
NEW = b"""FUNCTION_BLOCK FB_Pump
VAR
  bOn : BOOL;
  nStarts : INT;
END_VAR
bOn := TRUE;
METHOD Start : BOOL
Start := FALSE;
END_METHOD
METHOD Pause : BOOL
END_METHOD
END_FUNCTION_BLOCK
TYPE E_State : (Idle, Busy); END_TYPE
"""


@pytest.fixture
def project() -> Project:
    return import_files({"a.st": OLD}, new_project("Press")).project


def named(project: Project, name: str) -> ProjectObject:
    return next(item for item in project.walk() if item.name == name)


def members(project: Project, name: str) -> list[str]:
    return [item.name for item in project.children(named(project, name).id)]


def bring(
    project: Project, every: ExistingAct = "rename", files: dict[str, bytes] | None = None, **one: Decision
) -> Imported:
    files = files or {"a.st": NEW}
    keys = {node.name: node.key for node in import_files(files, project, preview=True).nodes}
    objects = {keys[name]: decision for name, decision in one.items()}
    return import_files(files, project, decided=Decided(Decisions(all=every, objects=objects)))


def said(imported: Imported) -> list[tuple[str, str]]:
    return [(entry.object, entry.outcome) for entry in imported.report.entries]


def test_a_preview_names_what_exists_and_what_is_equal(project: Project) -> None:
    nodes = {node.name: node for node in import_files({"a.st": NEW}, project, preview=True).nodes}
    pump, state = nodes["FB_Pump"].existing, nodes["E_State"].existing
    assert pump is not None
    assert state is not None
    assert (pump.object_id, pump.same, pump.proposal) == (named(project, "FB_Pump").id, False, "FB_Pump_1")
    assert pump.acts == ("overwrite", "rename", "merge", "skip")
    assert state.same
    start = nodes["Start"].existing
    assert start is not None
    assert start.path.endswith("FB_Pump/Start")
    assert nodes["Pause"].existing is None
    assert [node.existing for node in import_files({"a.st": NEW}).nodes] == [None] * 4


def test_overwriting_keeps_the_object_and_takes_the_content_of_the_file(project: Project) -> None:
    done = bring(project, "overwrite")
    pump = named(done.project, "FB_Pump")
    assert pump.id == named(project, "FB_Pump").id
    assert "nStarts" in pump.data.model_dump()["declaration"]
    assert members(done.project, "FB_Pump") == ["Start", "Pause"]
    assert [item.index for item in done.project.children(pump.id)] == [0, 1]
    assert named(done.project, "Start").id == named(project, "Start").id
    assert said(done) == [
        ("FB_Pump.Stop", "overwritten"),
        ("FB_Pump", "overwritten"),
        ("FB_Pump.Start", "overwritten"),
        ("FB_Pump.Pause", "imported"),
        ("E_State", "overwritten"),
    ]
    fresh = import_files({"a.st": NEW}, new_project("Press")).project
    texts = [
        {path.rpartition("/")[2]: content for path, content in encode(one).items() if path.endswith(".st")}
        for one in (done.project, fresh)
    ]
    assert texts[0] == texts[1]


def test_members_that_are_not_chosen_are_not_deleted(project: Project) -> None:
    nodes = import_files({"a.st": OLD}, project, preview=True).nodes
    wanted = [node.key for node in nodes if node.name == "Start"]
    decided = Decided(Decisions(all="overwrite"))
    done = import_files({"a.st": OLD}, project, chosen=wanted, decided=decided)
    assert members(done.project, "FB_Pump") == ["Start", "Stop"]


def test_merging_joins_members_and_declarations(project: Project) -> None:
    changed = edit.change_data(
        project,
        named(project, "FB_Pump").id,
        {"declaration": "FUNCTION_BLOCK FB_Pump\nVAR\n  bOn : BOOL;\n  rMine : REAL;\nEND_VAR"}
        | {"implementation": "bOn := TRUE;"},
    )
    done = bring(changed, "merge")
    declaration = named(done.project, "FB_Pump").data.model_dump()["declaration"]
    assert declaration.split("\n")[2:5] == ["  bOn : BOOL;", "  rMine : REAL;", "  nStarts : INT;"]
    assert members(done.project, "FB_Pump") == ["Start", "Stop", "Pause"]
    outcomes = dict(said(done))
    assert outcomes["FB_Pump.Start"] == "refused"
    assert "implementation (1 place)" in next(
        entry.text for entry in done.report.entries if entry.object == "FB_Pump.Start"
    )
    assert "TRUE" in named(done.project, "Start").data.model_dump()["implementation"]
    solved = bring(changed, "merge", Start=Decision(act="merge", texts={"implementation": "Start := bOn;"}))
    assert named(solved.project, "Start").data.model_dump()["implementation"] == "Start := bOn;"


def test_both_versions_of_one_object_are_joined_from_their_ancestor(project: Project) -> None:
    start = named(project, "Start")

    def with_body(text: str) -> Project:
        return edit.change_data(
            project, start.id, {"declaration": "METHOD Start : BOOL", "implementation": text}
        )

    before, ours, theirs = (
        with_body(text) for text in ("a();\nb();\nc();", "a();\nb();\nours();", "theirs();\nb();\nc();")
    )
    files = {f"p/{path}": content for path, content in encode(theirs).items()}
    blind = Decided(Decisions(all="merge"))
    assert import_files(files, ours, decided=blind).unknown_pasts >= {start.id}
    past = [one.get(start.id).data.model_dump() for one in (ours, before)]
    decided = Decided(Decisions(all="merge"), {start.id: past})
    done = import_files(files, ours, decided=decided)
    assert done.project.get(start.id).data.model_dump()["implementation"] == "theirs();\nb();\nours();"
    assert dict(said(done))["FB_Pump.Start"] == "merged"
    key = next(
        n.key for n in import_files(files, ours, preview=True).nodes if n.existing and n.name == "Start"
    )
    shown = import_files(files, ours, decided=Decided(histories={start.id: past}, compare=key), preview=True)
    assert shown.comparison is not None
    assert shown.comparison.ancestor
    body = {text.field: text for text in shown.comparison.texts}["implementation"]
    assert (body.ours, body.theirs) == ("a();\nb();\nours();", "theirs();\nb();\nc();")
    assert (body.merged, body.conflicts) == ("theirs();\nb();\nours();", ())


def test_what_is_skipped_stays_with_all_below_it(project: Project) -> None:
    done = bring(project, "skip")
    assert encode(done.project) == encode(project)
    assert said(done) == [("FB_Pump", "skipped"), ("E_State", "skipped")]
    one = bring(project, "skip", Start=Decision(act="overwrite"))
    assert "FALSE" in named(one.project, "Start").data.model_dump()["implementation"]
    assert members(one.project, "FB_Pump") == ["Start", "Stop"]


def test_a_name_of_the_users_own_is_checked(project: Project) -> None:
    done = bring(project, "skip", FB_Pump=Decision(act="rename", name="FB_Drain"))
    drain = named(done.project, "FB_Drain")
    assert drain.data.model_dump()["declaration"].startswith("FUNCTION_BLOCK FB_Drain\n")
    assert [item.name for item in done.project.children(drain.id)] == ["Start", "Pause"]
    assert members(done.project, "FB_Pump") == ["Start", "Stop"]
    with pytest.raises(NameTakenError, match="'FB_Pump' cannot be imported as 'e_state'"):
        bring(project, FB_Pump=Decision(act="rename", name="e_state"))
    with pytest.raises(InvalidNameError):
        bring(project, FB_Pump=Decision(act="rename", name="2 pumps"))


def test_an_object_of_another_kind_is_never_overwritten(project: Project) -> None:
    files = {"a.st": b"TYPE FB_Pump : INT; END_TYPE"}
    (node,) = import_files(files, project, preview=True).nodes
    assert node.existing is not None
    assert node.existing.acts == ("rename", "skip")
    done = bring(project, "overwrite", files)
    assert named(done.project, "FB_Pump").kind == "pou"
    assert named(done.project, "FB_Pump_1").kind == "dut"


def test_objects_in_other_folders_are_overwritten_where_they_are(project: Project) -> None:
    application = project.applications()[0].id
    project, folder = edit.add_object(project, application, "folder", "Pumps")
    project = edit.move_object(project, named(project, "FB_Pump").id, folder.id)
    done = bring(project, "overwrite")
    assert named(done.project, "FB_Pump").parent_id == folder.id
    assert members(done.project, "FB_Pump") == ["Start", "Pause"]
