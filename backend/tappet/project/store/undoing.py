"""Undoing changes of the tree: who added, deleted, renamed or moved something goes back over it.

Undo is the inverse of a change on the project as it is now, as a new change; redo undoes that one. What
others have done since stays: where both concern the same, undoing is refused. The steps are in the history,
so they are there after a reload and a restart.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from datetime import datetime
from typing import Any

from sqlalchemy import Connection, Row, and_, func, select

from tappet.project import edit
from tappet.project.data import CodeData
from tappet.project.errors import ProjectError
from tappet.project.kind_registry import kind_of
from tappet.project.model import Project, ProjectObject
from tappet.project.placement import check_project
from tappet.project.store.changes import apply_project, write_change
from tappet.project.store.history import deleted_with, object_revisions
from tappet.project.store.records import ChangeEvent, ProjectInfo, UnknownRevisionError
from tappet.project.store.rows import StoredProject, object_of, ranks_of, read_project
from tappet.project.store.tables import changes, revisions

ACTIONS = ("add", "copy", "delete", "rename", "move", "build", "import", "merge", "replace", "revert")
"""Changes that count as steps; texts and settings have the undo of their editors."""
MOST_STEPS = 200
"""Of one author, which are looked at."""


class NotUndoableError(ProjectError):
    """There is nothing to undo, or nothing to do again."""

    code = "not_undoable"


class ChangedSinceError(ProjectError):
    """What the change that is to be taken back concerns has been changed again; nothing has been written."""

    code = "changed_since"


@dataclass(frozen=True, slots=True)
class Step:
    """A change that can be undone, or done again."""

    revision: int
    """Of the change; to do it again, of the one that undid it."""
    action: str
    """What was done at first: `delete`."""
    at: datetime
    objects: tuple[str, ...]
    """Names of the objects that the change touched."""


@dataclass(frozen=True, slots=True)
class Steps:
    """What the next undo and the next redo of an author would do."""

    undo: Step | None
    redo: Step | None


def steps_of(connection: Connection, project_id: str, author: str) -> Steps:
    """The next steps of an author, from the history."""
    rows = connection.execute(
        select(changes.c.revision, changes.c.action, changes.c.at, changes.c.undoes)
        .where(
            changes.c.project_id == project_id,
            changes.c.author == author,
            changes.c.revision > 1,  # the first one made the project
            changes.c.action.in_([*ACTIONS, "undo", "redo"]),
        )
        .order_by(changes.c.revision.desc())
        .limit(MOST_STEPS)
    ).all()
    done: list[Step] = []
    undone: list[Step] = []
    for row in reversed(rows):
        if row.undoes is None:
            done.append(Step(row.revision, row.action, row.at, ()))
            undone.clear()
            continue
        source, target = (done, undone) if row.action == "undo" else (undone, done)
        step = next((one for one in source if one.revision == row.undoes), None)
        if step is not None:
            source.remove(step)
            target.append(replace(step, revision=row.revision))
    return Steps(
        _named(connection, project_id, done[-1]) if done else None,
        _named(connection, project_id, undone[-1]) if undone else None,
    )


def _named(connection: Connection, project_id: str, step: Step) -> Step:
    names = connection.scalars(
        select(revisions.c.name)
        .where(revisions.c.project_id == project_id, revisions.c.change == step.revision)
        .order_by(revisions.c.parent_id, revisions.c.position)
    )
    return replace(step, objects=tuple(names))


def undo_change(
    connection: Connection, info: ProjectInfo, number: int, author: str, *, redo: bool = False
) -> tuple[int, ChangeEvent | None]:
    """Take back a change of a locked project, as a new one; its revision and the event.

    The event is None when the project is so already; the step is taken all the same.
    """
    stored = read_project(connection, info)
    wanted, places = without_change(connection, stored, number, author)
    action = "redo" if redo else "undo"
    _, event = apply_project(connection, stored, wanted, action, author, "", undoes=number, places=places)
    if event is not None:
        return event.revision, event
    return write_change(connection, info, action, author, "", undoes=number), None


def without_change(
    connection: Connection, stored: StoredProject, number: int, author: str
) -> tuple[Project, dict[str, int]]:
    """A locked project as it is now, without what a change did, and the positions that objects had before.

    Raises UnknownRevisionError, ChangedSinceError naming the object that was changed since, and what
    `check_project` finds.
    """
    after = connection.execute(
        select(revisions).where(revisions.c.project_id == stored.info.id, revisions.c.change == number)
    ).all()
    if not after:
        raise UnknownRevisionError(f"The project '{stored.info.name}' has no change {number} of objects")
    before = _states_before(connection, stored.info.id, after)
    places = {row.object_id: row.position for row in after if row.deleted}
    places |= {
        row.object_id: before[row.object_id].position
        for row in after
        if row.object_id in before and row.position != before[row.object_id].position
    }
    if all(row.deleted for row in after):
        return _restored(connection, stored, number, places), places
    renamed = _renaming(after, before)
    if renamed is not None:
        return _renamed_back(stored, *renamed), places
    return _as_before(connection, stored, after, before, author), places


def _states_before(connection: Connection, project_id: str, after: Sequence[Row[Any]]) -> dict[str, Row[Any]]:
    """The states that objects had before a change; none of those that it made."""
    found = {}
    for row in after:
        newest = (
            select(func.max(revisions.c.revision))
            .where(
                revisions.c.project_id == project_id,
                revisions.c.object_id == row.object_id,
                revisions.c.revision < row.revision,
            )
            .scalar_subquery()
        )
        state = connection.execute(
            select(revisions).where(
                and_(
                    revisions.c.project_id == project_id,
                    revisions.c.object_id == row.object_id,
                    revisions.c.revision == newest,
                )
            )
        ).one_or_none()
        if state is not None and not state.deleted:
            found[row.object_id] = state
    return found


def _restored(
    connection: Connection, stored: StoredProject, number: int, places: Mapping[str, int]
) -> Project:
    """What a change deleted, back where it was."""
    project = stored.project
    items = deleted_with(connection, stored.info.id, number)
    gone = {item.id for item in items}
    positions = {**stored.positions, **places}
    tops = [item for item in items if item.parent_id not in gone]
    for top in sorted(tops, key=lambda item: positions[item.id]):
        if top.id in project.objects:
            raise ChangedSinceError(f"'{top.name}' has been restored already")
        siblings = project.siblings(top.parent_id, top.kind)
        index = sum(positions[item.id] < positions[top.id] for item in siblings)
        project = edit.restore_objects(project, top, items, index)
    return project


def _renaming(after: Sequence[Row[Any]], before: Mapping[str, Row[Any]]) -> tuple[Row[Any], Row[Any]] | None:
    """The states of the object behind and before a change that was a renaming and nothing else."""
    named = [
        (row, before[row.object_id])
        for row in after
        if row.object_id in before and before[row.object_id].name != row.name
    ]
    if len(named) != 1 or len(before) != len(after) or any(row.deleted for row in after):
        return None
    row, state = named[0]
    item = object_of(state, state.object_id)
    kind = kind_of(item)
    data = item.data if kind is None or kind.renamed is None else kind.renamed(item.data, row.name)
    if data.model_dump(mode="json") != object_of(row, row.object_id).data.model_dump(mode="json"):
        return None
    return row, state


def _renamed_back(stored: StoredProject, row: Row[Any], state: Row[Any]) -> Project:
    item = _present(stored, row)
    if item.name != row.name:
        raise ChangedSinceError(f"'{row.name}' is named '{item.name}' by now; rename it again instead")
    return edit.rename_object(stored.project, item.id, state.name)


def _present(stored: StoredProject, row: Row[Any]) -> ProjectObject:
    item = stored.project.objects.get(row.object_id)
    if item is None:
        raise ChangedSinceError(f"'{row.name}' has been deleted since; restore it first")
    return item


def _as_before(
    connection: Connection,
    stored: StoredProject,
    after: Sequence[Row[Any]],
    before: Mapping[str, Row[Any]],
    author: str,
) -> Project:
    """The project with the states of before, and without what the change made."""
    objects = dict(stored.project.objects)
    positions = dict(stored.positions)
    for row in after:
        state = before.get(row.object_id)
        if state is None:
            _check_untouched(connection, stored, row, author)
            for below in stored.project.walk(row.object_id):
                _check_untouched(connection, stored, below, author)
                objects.pop(below.id, None)
            objects.pop(row.object_id, None)
        elif row.deleted:
            if row.object_id in objects:
                raise ChangedSinceError(f"'{row.name}' has been restored already")
            objects[row.object_id] = object_of(state, row.object_id)
            positions[row.object_id] = state.position
        else:
            item = _present(stored, row)
            objects[item.id] = item.model_copy(update=_undone(connection, stored, item, row, state))
            if (row.parent_id, row.position) != (state.parent_id, state.position):
                positions[item.id] = state.position
    for item in objects.values():
        if item.parent_id is not None and item.parent_id not in objects:
            raise ChangedSinceError(f"What '{item.name}' was in has been deleted since; restore that first")
    ranks = ranks_of(
        (one.id, one.parent_id, one.kind, positions[one.id], one.name) for one in objects.values()
    )
    placed = {key: item.model_copy(update={"index": ranks[key]}) for key, item in objects.items()}
    project = replace(stored.project, objects=placed)
    check_project(project)
    return project


def _undone(
    connection: Connection, stored: StoredProject, item: ProjectObject, row: Row[Any], state: Row[Any]
) -> dict[str, Any]:
    """What of an object becomes again what it was before the change; what the change left alone stays."""
    values: dict[str, Any] = {}
    if row.name != state.name:
        if item.name != row.name:
            raise _changed_since(connection, stored, item)
        values["name"] = state.name
    if row.parent_id != state.parent_id:
        if item.parent_id != row.parent_id:
            raise ChangedSinceError(f"'{item.name}' has been moved since")
        values["parent_id"] = state.parent_id
    if row.data != state.data:
        was, became = object_of(state, item.id).data, object_of(row, item.id).data
        if item.data == became:
            values["data"] = was
        elif (
            isinstance(was, CodeData)
            and isinstance(item.data, CodeData)
            and became == was.model_copy(update={"exclude_from_build": not was.exclude_from_build})
        ):
            values["data"] = item.data.model_copy(update={"exclude_from_build": was.exclude_from_build})
        else:
            raise _changed_since(connection, stored, item)
    return values


def _check_untouched(
    connection: Connection, stored: StoredProject, touched: Row[Any] | ProjectObject, author: str
) -> None:
    """Raise ChangedSinceError when somebody else has worked on an object that undoing would delete."""
    object_id = touched.id if isinstance(touched, ProjectObject) else touched.object_id
    item = stored.project.objects.get(object_id)
    if item is not None and object_revisions(connection, stored.info.id, object_id)[0].author != author:
        raise _changed_since(connection, stored, item)


def _changed_since(connection: Connection, stored: StoredProject, item: ProjectObject) -> ChangedSinceError:
    last = object_revisions(connection, stored.info.id, item.id)[0]
    return ChangedSinceError(
        f"'{item.name}' changed since, by {last.author}; go back to an earlier revision in its history"
    )
