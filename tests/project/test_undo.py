"""Undoing changes of the tree, and the list of what was deleted."""

from __future__ import annotations

import random
from pathlib import Path

import pytest
from tests.project.project_paths import APP
from tests.project.project_paths import stored_at as at

from tappet.project import edit
from tappet.project.errors import ProjectError
from tappet.project.model import Project
from tappet.project.store import Store
from tappet.project.store.undoing import ChangedSinceError, NotUndoableError


def shape(project: Project) -> dict[str, object]:
    return {project.path_of(item.id): (item.id, item.kind, item.index, item.data) for item in project.walk()}


def random_act(store: Store, pid: str, chance: random.Random) -> None:
    """A change of the tree as a user makes it; some are not possible and change nothing."""
    project = store.load(pid)
    item, other = chance.choice(list(project.walk())), chance.choice(list(project.walk()))
    act = chance.choice(["add", "delete", "rename", "move", "order", "copy", "exclude"])
    name = f"X{chance.randrange(100)}"
    if act == "add":
        kind = chance.choice(["pou", "gvl", "folder", "method", "task", "property"])
        store.add(pid, "ann", item.id, kind, None if kind == "task" else name)
    elif act == "delete" and item.parent_id is not None and other.parent_id is not None:
        store.delete(pid, "ann", item.id, other.id)
    elif act == "rename":
        store.arrange(pid, "ann", item.id, name=name)
    elif act == "move":
        store.arrange(pid, "ann", item.id, place=(other.id, chance.randrange(3)))
    elif act == "order":
        store.arrange(pid, "ann", item.id, place=(item.parent_id, chance.randrange(3)))
    elif act == "copy":
        store.copy(pid, "ann", item.id, other.id)
    elif act == "exclude":
        store.arrange(pid, "ann", item.id, excluded=chance.random() < 0.5)


@pytest.mark.parametrize("seed", range(12))
def test_all_changes_of_the_tree_are_undone_and_done_again(store: Store, pid: str, seed: int) -> None:
    chance = random.Random(seed)
    states = [store.load(pid)]
    for _ in range(25):
        try:
            random_act(store, pid, chance)
        except ProjectError:
            continue
        if shape(store.load(pid)) != shape(states[-1]):
            states.append(store.load(pid))
    for state in reversed(states[:-1]):
        store.undo(pid, "ann")
        assert shape(store.load(pid)) == shape(state)
    assert store.steps(pid, "ann").undo is None
    for state in states[1:]:
        store.undo(pid, "ann", redo=True)
        assert shape(store.load(pid)) == shape(state)
    assert store.steps(pid, "ann").redo is None


def test_steps_outlive_the_store(store: Store, pid: str, database_url: str) -> None:
    before = shape(store.load(pid))
    store.delete(pid, "ann", at(store, pid, f"{APP}/PLC_PRG").id)
    store.close()
    again = Store(database_url)
    step = again.steps(pid, "ann").undo
    assert step is not None
    assert (step.action, step.objects) == ("delete", ("PLC_PRG",))
    again.undo(pid, "ann")
    assert shape(again.load(pid)) == before
    redo = again.steps(pid, "ann").redo
    assert redo is not None
    assert redo.action == "delete"
    again.close()


def test_texts_written_since_stay(store: Store, pid: str) -> None:
    program = at(store, pid, f"{APP}/PLC_PRG")
    renamed = store.arrange(pid, "ann", program.id, name="Main")
    data = {**renamed.data.model_dump(), "implementation": "x := 1;"}
    store.save(pid, program.id, renamed.revision, data, "bob")
    store.arrange(pid, "ann", program.id, excluded=True)
    store.undo(pid, "ann")
    store.undo(pid, "ann")
    back = at(store, pid, f"{APP}/PLC_PRG")
    assert back.data.model_dump()["implementation"] == "x := 1;"
    assert back.data.model_dump()["declaration"].startswith("PROGRAM PLC_PRG")
    assert not back.excluded


def test_the_work_of_others_is_not_undone(store: Store, pid: str) -> None:
    program = at(store, pid, f"{APP}/PLC_PRG")
    copy = store.copy(pid, "ann", program.id, program.parent_id)
    store.save(pid, copy.id, copy.revision, {**copy.data.model_dump(), "implementation": "x;"}, "bob")
    with pytest.raises(ChangedSinceError, match="changed since, by bob"):
        store.undo(pid, "ann")
    with pytest.raises(NotUndoableError, match="nothing to undo"):
        store.undo(pid, "bob")
    store.arrange(pid, "ann", program.id, name="Main")
    store.arrange(pid, "bob", program.id, name="Start")
    with pytest.raises(ChangedSinceError, match="is named 'Start' by now"):
        store.undo(pid, "ann")
    store.delete(pid, "bob", program.id)
    with pytest.raises(ChangedSinceError, match="deleted since"):
        store.undo(pid, "ann")


def test_a_new_change_ends_what_can_be_done_again(store: Store, pid: str) -> None:
    program = at(store, pid, f"{APP}/PLC_PRG")
    store.arrange(pid, "ann", program.id, name="Main")
    store.undo(pid, "ann")
    store.arrange(pid, "ann", program.id, name="Other")
    with pytest.raises(NotUndoableError, match="nothing to redo"):
        store.undo(pid, "ann", redo=True)


def test_a_project_that_was_imported_is_not_undone(store: Store, pid: str) -> None:
    copy = store.create_project("Copy", "ann", content=store.load(pid))
    assert store.steps(copy.id, "ann").undo is None


def test_what_was_deleted_is_listed_until_it_is_back(store: Store, pid: str, tmp_path: Path) -> None:
    application = at(store, pid, APP)
    folder = store.add(pid, "ann", application.id, "folder", "Drives")
    block = store.add(pid, "ann", folder.id, "pou", "FB_Motor", subkind="function_block")
    store.add(pid, "ann", block.id, "method", "Start")
    program = at(store, pid, f"{APP}/PLC_PRG")
    store.delete(pid, "ann", block.id)
    store.delete(pid, "bob", folder.id, program.id)
    found = [(one.name, one.path, one.author, one.below) for one in store.deleted_objects(pid)]
    assert sorted(found) == [
        ("Drives", f"{APP}/Drives", "bob", 0),
        ("FB_Motor", f"{APP}/Drives/FB_Motor", "ann", 1),
        ("PLC_PRG", f"{APP}/PLC_PRG", "bob", 0),
    ]
    assert {one.subkind for one in store.deleted_objects(pid)} == {None, "function_block", "program"}
    for one in store.deleted_objects(pid):
        if one.name != "PLC_PRG":
            store.revert_object(pid, one.id, one.revision, "ann")
    assert [one.name for one in store.deleted_objects(pid)] == ["PLC_PRG"]
    assert at(store, pid, f"{APP}/Drives/FB_Motor/Start").parent_id == block.id


def test_changes_of_several_objects_are_one_step(store: Store, pid: str) -> None:
    before = shape(store.load(pid))

    def merged(project: Project) -> tuple[Project, None]:
        program = project.find(f"{APP}/PLC_PRG")
        task = project.find(f"{APP}/Task Configuration/MainTask")
        assert program is not None
        assert task is not None
        project = edit.change_data(project, program.id, {"implementation": "x;"})
        project = edit.delete_object(project, task.id)
        project, _ = edit.add_object(project, program.parent_id, "gvl", "GVL")
        return project, None

    store.edit(pid, "ann", "merge", merged)
    after = shape(store.load(pid))
    store.undo(pid, "ann")
    assert shape(store.load(pid)) == before
    store.undo(pid, "ann", redo=True)
    assert shape(store.load(pid)) == after
