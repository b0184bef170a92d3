"""The store on SQLite and on PostgreSQL: projects, locking, revisions, undo."""

from concurrent.futures import ThreadPoolExecutor
from datetime import timedelta
from pathlib import Path

import pytest
from tests.project.project_paths import APP
from tests.project.project_paths import stored_at as at

from tappet.project import edit
from tappet.project.errors import (
    InvalidDataError,
    InvalidNameError,
    NameTakenError,
    NotPlaceableError,
    UnknownObjectError,
)
from tappet.project.model import Project, ProjectObject, new_id
from tappet.project.new_project import new_project
from tappet.project.objects import make_object
from tappet.project.store import StaleRevision, Store, saving
from tappet.project.store.records import ChangeEvent, UnknownProjectError, UnknownRevisionError


def shape(project: Project) -> dict[str, object]:
    """What two projects are compared by when their revisions differ."""
    return {project.path_of(item.id): (item.kind, item.index, item.data) for item in project.walk()}


def text(declaration: str, implementation: str = "") -> dict[str, str]:
    return {"declaration": declaration, "implementation": implementation}


def test_projects(store: Store) -> None:
    one = store.create_project("Press", "ann", description="line 3")
    assert (one.name, one.description, one.revision, one.created_by) == ("Press", "line 3", 1, "ann")
    with pytest.raises(NameTakenError, match="'PRESS'"):
        store.create_project("PRESS", "bob")
    assert store.create_project("press", "bob", free_name=True).name == "press_1"
    with pytest.raises(InvalidNameError):
        store.create_project("a\tb", "bob")
    assert [info.name for info in store.projects()] == ["Press", "press_1"]
    changed = store.change_project(one.id, "bob", name="Stamp", description="")
    assert (changed.name, changed.description, changed.changed_by, changed.revision) == (
        "Stamp",
        "",
        "bob",
        1,
    )
    with pytest.raises(NameTakenError):
        store.change_project(one.id, "bob", name="Press_1")
    with pytest.raises(UnknownProjectError):
        store.change_project(new_id(), "bob", name="x")


def test_a_deleted_project_can_be_restored(store: Store, pid: str) -> None:
    before = store.load(pid)
    store.delete_project(pid, "ann")
    assert store.projects() == []
    assert [info.id for info in store.projects(deleted=True)] == [pid]
    for read in (store.load, store.tree, store.project):
        with pytest.raises(UnknownProjectError):
            read(pid)
    store.create_project("Press", "bob")
    assert store.restore_project(pid, "ann").name == "Press_1"
    assert store.load(pid).objects == before.objects
    with pytest.raises(UnknownProjectError):
        store.restore_project(pid, "ann")


def test_a_stored_project_is_the_one_given(store: Store) -> None:
    given = new_project("x")
    given, _ = edit.add_object(given, None, "pou", "F", subkind="function")
    curve = make_object(
        id=new_id(), kind="oscillogram", name="Curve", index=1, data={"a": [1.5, None, "\x00é"]}
    )
    given = Project("x", objects={**given.objects, curve.id: curve}, extra_files={"README.md": b"\xff\x00"})
    info = store.create_project("x", "ann", content=given)
    loaded = store.load(info.id, with_files=True)
    assert shape(loaded) == shape(given)
    assert loaded.objects.keys() == given.objects.keys()
    assert {item.revision for item in loaded.objects.values()} == {1}
    assert loaded.extra_files == {"README.md": b"\xff\x00"}
    assert store.load(info.id).extra_files == {}
    again = store.create_project("y", "ann", content=given)
    assert shape(store.load(again.id)) == shape(given)


def test_tree_and_single_objects(store: Store, pid: str, prg: ProjectObject) -> None:
    tree = {item.id: item for item in store.tree(pid)}
    assert tree.keys() == store.load(pid).objects.keys()
    assert (tree[prg.id].subkind, tree[prg.id].index, tree[prg.id].revision) == ("program", 1, 1)
    assert store.get(pid, prg.id) == prg
    with pytest.raises(UnknownObjectError):
        store.get(pid, new_id())
    with pytest.raises(UnknownProjectError):
        store.get(new_id(), prg.id)


def test_saving(store: Store, pid: str, prg: ProjectObject) -> None:
    saved = store.save(pid, prg.id, 1, text("FUNCTION PLC_PRG : INT", "x;"), "ann", comment="as function")
    assert (saved.revision, saved.index, saved.subkind) == (2, 1, "function")
    assert store.get(pid, prg.id) == saved
    assert next(item.subkind for item in store.tree(pid) if item.id == prg.id) == "function"
    last, first = store.object_revisions(pid, prg.id)
    assert (last.revision, last.author, last.comment, last.action) == (2, "ann", "as function", "save")
    assert (first.revision, first.action) == (1, "create")
    assert store.object_at(pid, prg.id, 1).data == prg.data
    assert store.project(pid).revision == 2


def test_saving_the_same_again_is_no_revision(store: Store, pid: str, prg: ProjectObject) -> None:
    assert store.save(pid, prg.id, 1, prg.data.model_dump(), "bob").revision == 1
    assert store.project(pid).revision == 1


def test_wrong_data_are_refused_and_nothing_is_written(store: Store, pid: str, prg: ProjectObject) -> None:
    with pytest.raises(InvalidDataError, match="pou 'PLC_PRG': colour: Extra"):
        store.save(pid, prg.id, 1, {"colour": 1}, "ann")
    with pytest.raises(UnknownObjectError):
        store.save(pid, new_id(), 1, {}, "ann")
    assert store.get(pid, prg.id) == prg


def test_of_two_tabs_the_second_gets_both_versions(store: Store, pid: str, prg: ProjectObject) -> None:
    store.save(pid, prg.id, 1, text("PROGRAM PLC_PRG", "ann;"), "ann")
    with pytest.raises(
        StaleRevision, match=r"'PLC_PRG' was changed by ann .*revision 1, stored is 2"
    ) as caught:
        store.save(pid, prg.id, 1, text("PROGRAM PLC_PRG", "bob;"), "bob")
    stale = caught.value
    assert stale.current is not None
    assert stale.current == store.get(pid, prg.id)
    assert stale.current.data.model_dump()["implementation"] == "ann;"
    assert stale.yours["data"]["implementation"] == "bob;"
    saved = store.save(pid, prg.id, stale.current.revision, text("PROGRAM PLC_PRG", "ann; bob;"), "bob")
    assert saved.revision == 3


def test_saving_what_somebody_deleted(store: Store, pid: str, prg: ProjectObject) -> None:
    store.delete(pid, "ann", prg.id)
    with pytest.raises(StaleRevision, match="was deleted by ann") as caught:
        store.save(pid, prg.id, 1, text("PROGRAM PLC_PRG", "bob;"), "bob")
    assert caught.value.current is None
    assert caught.value.yours["data"]["implementation"] == "bob;"


def test_a_move_does_not_disturb_who_is_typing(store: Store, pid: str, prg: ProjectObject) -> None:
    moved = store.arrange(pid, "ann", prg.id, place=(prg.parent_id, 0))
    assert (moved.index, moved.revision) == (0, 2)
    saved = store.save(pid, prg.id, 1, text("PROGRAM PLC_PRG", "bob;"), "bob")
    assert (saved.revision, saved.index) == (3, 0)


def test_a_rename_of_somebody_else_is_a_conflict(store: Store, pid: str, prg: ProjectObject) -> None:
    store.arrange(pid, "ann", prg.id, name="Main")
    with pytest.raises(StaleRevision):
        store.save(pid, prg.id, 1, text("PROGRAM PLC_PRG", "bob;"), "bob")
    with pytest.raises(StaleRevision) as caught:
        store.arrange(pid, "bob", prg.id, name="Other", base_revision=1)
    assert caught.value.yours == {"name": "Other"}


def test_many_writers_lose_nothing(store: Store, pid: str, prg: ProjectObject) -> None:
    """Twenty saves at once on one base: one is stored, nineteen get both versions."""

    def write(number: int) -> str | None:
        try:
            store.save(pid, prg.id, 1, text("PROGRAM PLC_PRG", f"{number};"), f"u{number}")
        except StaleRevision as stale:
            return str(stale.yours["data"]["implementation"])
        return None

    with ThreadPoolExecutor(8) as pool:
        answers = list(pool.map(write, range(20)))
    assert answers.count(None) == 1
    assert all(answer in (None, f"{number};") for number, answer in enumerate(answers))
    assert store.get(pid, prg.id).revision == 2


def test_many_writers_of_one_name_leave_one_object(store: Store, pid: str) -> None:
    app = at(store, pid, APP)

    def add(number: int) -> bool:
        try:
            store.add(pid, f"u{number}", app.id, "gvl", "Limits")
        except NameTakenError:
            return False
        return True

    with ThreadPoolExecutor(8) as pool:
        assert sum(pool.map(add, range(12))) == 1
    project = store.load(pid)
    assert [item.name for item in project.children(app.id)].count("Limits") == 1
    assert store.project(pid).revision == 2


def test_editing_the_tree(store: Store, pid: str) -> None:
    app = at(store, pid, APP)
    block = store.add(pid, "ann", app.id, "pou", "FB_Motor", subkind="function_block", index=0)
    assert (block.revision, block.index, block.subkind) == (1, 0, "function_block")
    prop = store.add(pid, "ann", block.id, "property", "Speed")
    assert [item.name for item in store.load(pid).children(prop.id)] == ["Get", "Set"]
    copied = store.copy(pid, "bob", block.id, app.id)
    assert copied.name == "FB_Motor_1"
    other = store.create_project("Other", "ann").id
    taken = store.copy(other, "bob", block.id, None, source_project_id=pid)
    assert store.load(other).path_of(taken.id) == "FB_Motor"
    both = store.arrange(pid, "bob", copied.id, name="FB_Pump", place=(app.id, 1))
    assert (both.name, both.index, both.revision) == ("FB_Pump", 1, 2)
    with pytest.raises(NotPlaceableError):
        store.add(pid, "ann", app.id, "task_configuration")
    names = [item.name for item in store.load(pid).children(app.id)]
    assert names == ["FB_Motor", "FB_Pump", "Library Manager", "PLC_PRG", "Task Configuration"]
    assert [item.index for item in store.load(pid).children(app.id)] == [0, 1, 2, 3, 4]


def test_a_move_writes_one_revision(store: Store, pid: str, prg: ProjectObject) -> None:
    for index in (2, 0, 1, 2):
        store.arrange(pid, "ann", prg.id, place=(prg.parent_id, index))
    project = store.load(pid)
    assert [item.name for item in project.children(prg.parent_id)] == [
        "Library Manager",
        "Task Configuration",
        "PLC_PRG",
    ]
    assert {item.revision for item in project.objects.values() if item.id != prg.id} == {1}


def test_undo_to_any_revision_of_an_object(store: Store, pid: str, prg: ProjectObject) -> None:
    store.save(pid, prg.id, 1, text("PROGRAM PLC_PRG", "two;"), "ann")
    store.arrange(pid, "ann", prg.id, name="Main")
    back = store.revert_object(pid, prg.id, 1, "bob", comment="undo")
    assert (back.name, back.data, back.revision) == ("PLC_PRG", prg.data, 4)
    again = store.revert_object(pid, prg.id, 3, "bob")
    assert (again.name, again.data.model_dump()["implementation"]) == ("Main", "two;")
    assert [item.action for item in store.object_revisions(pid, prg.id)] == [
        "revert",
        "revert",
        "rename",
        "save",
        "create",
    ]
    with pytest.raises(UnknownRevisionError, match="no revision 9"):
        store.revert_object(pid, prg.id, 9, "bob")
    with pytest.raises(UnknownRevisionError, match="never had"):
        store.object_revisions(pid, new_id())


def test_undo_of_a_deletion_brings_back_what_was_below(store: Store, pid: str) -> None:
    app = at(store, pid, APP)
    block = store.add(pid, "ann", app.id, "pou", "FB", subkind="function_block", index=1)
    store.add(pid, "ann", block.id, "method", "Start")
    store.add(pid, "ann", block.id, "property", "Speed", index=0)
    before = shape(store.load(pid))
    store.delete(pid, "bob", block.id)
    assert f"{APP}/FB" not in shape(store.load(pid))
    assert [item.deleted for item in store.object_revisions(pid, block.id)] == [True, False]
    back = store.revert_object(pid, block.id, 1, "ann")
    assert (back.id, back.revision, back.index) == (block.id, 3, 1)
    assert shape(store.load(pid)) == before


def test_undo_of_a_deletion_where_the_place_has_changed(store: Store, pid: str) -> None:
    app = at(store, pid, APP)
    folder = store.add(pid, "ann", app.id, "folder", "Motors")
    gvl = store.add(pid, "ann", folder.id, "gvl", "Limits")
    store.delete(pid, "ann", gvl.id)
    store.add(pid, "ann", app.id, "gvl", "Limits")
    assert store.revert_object(pid, gvl.id, 1, "ann").name == "Limits_1"
    store.delete(pid, "ann", folder.id)
    with pytest.raises(NotPlaceableError, match="restore that first"):
        store.revert_object(pid, gvl.id, 1, "ann")


def test_the_whole_project_goes_back_to_any_revision(store: Store, pid: str, prg: ProjectObject) -> None:
    states = {1: shape(store.load(pid))}
    app = at(store, pid, APP)

    def remember() -> None:
        states[store.project(pid).revision] = shape(store.load(pid))

    block = store.add(pid, "ann", app.id, "pou", "FB", subkind="function_block", index=0)
    remember()
    store.save(pid, prg.id, 1, text("PROGRAM PLC_PRG", "two;"), "ann")
    remember()
    store.arrange(pid, "ann", prg.id, place=(None, 0))
    remember()
    store.delete(pid, "bob", block.id)
    remember()
    assert sorted(states) == [1, 2, 3, 4, 5]
    for revision, state in reversed(states.items()):
        assert shape(store.project_at(pid, revision)) == state
        store.revert_project(pid, revision, "bob", comment=f"back to {revision}")
        assert shape(store.load(pid)) == state
    assert store.load(pid).objects.keys() == store.project_at(pid, 1).objects.keys()
    assert block.id in store.project_at(pid, 2).objects
    for revision in (0, 99):
        with pytest.raises(UnknownRevisionError, match="has the revisions 1 to"):
            store.revert_project(pid, revision, "bob")


def test_going_back_to_the_present_changes_nothing(store: Store, pid: str) -> None:
    assert store.revert_project(pid, 1, "bob").revision == 1


def test_changes_of_a_project(store: Store, pid: str, prg: ProjectObject) -> None:
    store.save(pid, prg.id, 1, text("PROGRAM PLC_PRG", "two;"), "ann", comment="why")
    store.delete(pid, "bob", prg.id, comment="gone")
    last, save, create = store.project_revisions(pid)
    assert (last.revision, last.action, last.author, last.comment) == (3, "delete", "bob", "gone")
    assert save.objects == ((prg.id, "PLC_PRG"),)
    assert len(create.objects) == 7
    assert [item.revision for item in store.project_revisions(pid, limit=1)] == [3]
    assert [item.revision for item in store.project_revisions(pid, before=3, limit=1)] == [2]


def save_all(store: Store, pid: str, item: ProjectObject, texts: list[tuple[str, str, bool]]) -> list[int]:
    """Save texts as (author, text, autosave) one after the other; the object's revisions that are left."""
    revision = store.get(pid, item.id).revision
    for author, body, autosave in texts:
        saved = store.save(pid, item.id, revision, text("PROGRAM PLC_PRG", body), author, autosave=autosave)
        revision = saved.revision
    return [found.revision for found in reversed(store.object_revisions(pid, item.id))]


def test_autosaves_of_one_author_leave_one_revision(store: Store, pid: str, prg: ProjectObject) -> None:
    auto = [("ann", f"a{i};", True) for i in range(4)]
    assert save_all(store, pid, prg, auto) == [1, 5]
    assert store.object_revisions(pid, prg.id)[0].autosave
    assert [item.revision for item in store.project_revisions(pid)] == [5, 1]
    assert store.object_at(pid, prg.id, 5).data.model_dump()["implementation"] == "a3;"


def test_explicit_saves_are_kept(store: Store, pid: str, prg: ProjectObject) -> None:
    texts = [
        ("ann", "1;", True),
        ("ann", "2;", False),
        ("ann", "3;", True),
        ("bob", "4;", True),
        ("bob", "5;", True),
    ]
    assert save_all(store, pid, prg, texts) == [1, 2, 3, 4, 6]


def test_an_explicit_save_of_an_autosaved_text_makes_it_explicit(
    store: Store, pid: str, prg: ProjectObject
) -> None:
    assert save_all(store, pid, prg, [("ann", "1;", True), ("ann", "1;", False), ("ann", "2;", True)]) == [
        1,
        2,
        3,
    ]
    assert [item.autosave for item in store.object_revisions(pid, prg.id)] == [True, False, False]


def test_autosaves_of_others_in_between_do_not_matter(store: Store, pid: str, prg: ProjectObject) -> None:
    gvl = store.add(pid, "bob", prg.parent_id, "gvl", "Limits")
    revision = 1
    for i in range(3):
        revision = store.save(
            pid, prg.id, revision, text("PROGRAM PLC_PRG", f"{i};"), "ann", autosave=True
        ).revision
        gvl = store.save(pid, gvl.id, gvl.revision, {"declaration": f"// {i}"}, "bob", autosave=True)
    assert [item.revision for item in store.object_revisions(pid, prg.id)] == [4, 1]
    assert [item.revision for item in store.object_revisions(pid, gvl.id)] == [4, 1]


def test_an_autosave_stays_when_something_explicit_came_after_it(
    store: Store, pid: str, prg: ProjectObject
) -> None:
    """Going back to the explicit change finds the program as it was then."""
    save_all(store, pid, prg, [("ann", "1;", True)])
    store.add(pid, "bob", prg.parent_id, "gvl", "Limits")
    then = store.project(pid).revision
    assert save_all(store, pid, prg, [("ann", "2;", True)]) == [1, 2, 3]
    assert store.project_at(pid, then).get(prg.id).data.model_dump()["implementation"] == "1;"


def test_autosaves_apart_in_time_stay(
    store: Store, pid: str, prg: ProjectObject, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(saving, "AUTOSAVE_WINDOW", timedelta(0))
    assert save_all(store, pid, prg, [("ann", "1;", True), ("ann", "2;", True)]) == [1, 2, 3]


def test_listeners_hear_what_was_stored(store: Store, pid: str, prg: ProjectObject) -> None:
    heard: list[ChangeEvent] = []

    def fails(_event: ChangeEvent) -> None:
        raise RuntimeError("a broken listener")

    store.listen(fails)
    stop = store.listen(heard.append)
    store.save(pid, prg.id, 1, text("PROGRAM PLC_PRG", "two;"), "ann")
    store.arrange(pid, "bob", prg.id, place=(prg.parent_id, 0))
    gvl = store.add(pid, "bob", prg.parent_id, "gvl", "Limits")
    store.delete(pid, "ann", gvl.id)
    with pytest.raises(StaleRevision):
        store.save(pid, prg.id, 1, text("PROGRAM PLC_PRG", "three;"), "ann")
    stop()
    store.delete(pid, "ann", prg.id)
    assert [(event.action, event.author, event.revision) for event in heard] == [
        ("save", "ann", 2),
        ("move", "bob", 3),
        ("add", "bob", 4),
        ("delete", "ann", 5),
    ]
    changes = [(change.action, change.summary.name) for event in heard for change in event.objects]
    assert changes == [
        ("updated", "PLC_PRG"),
        ("moved", "PLC_PRG"),
        ("created", "Limits"),
        ("deleted", "Limits"),
    ]
    assert heard[1].objects[0].summary.index == 0


def test_a_large_project(store: Store) -> None:
    objects = {}
    for number in range(1200):
        item = make_object(
            id=new_id(), kind="gvl", name=f"G{number}", index=number, data={"declaration": "x"}
        )
        objects[item.id] = item
    info = store.create_project("large", "ann", content=Project("large", objects=objects))
    loaded = store.load(info.id)
    assert [item.name for item in loaded.children(None)] == [f"G{number}" for number in range(1200)]
    last = loaded.children(None)[-1]
    alone = Project("large", objects={last.id: last})
    store.edit(info.id, "ann", "delete", lambda _project: (alone, None))
    assert len(store.tree(info.id)) == 1
    store.revert_project(info.id, 1, "ann")
    assert len(store.tree(info.id)) == 1200


def test_the_database_survives_reopening(database_url: str, tmp_path: Path) -> None:
    first = Store(database_url)
    pid = first.create_project("Press", "ann").id
    before = first.load(pid)
    first.close()
    second = Store(database_url)
    assert second.load(pid) == before
    second.close()
