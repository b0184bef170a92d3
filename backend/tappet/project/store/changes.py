"""The one way to write to a project: compare what is with what shall be, and store the difference.

Adding, moving, importing and reverting all give a new Project value; here it becomes rows and revisions.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from datetime import UTC, datetime
from typing import Any

from sqlalchemy import Connection, delete, func, insert, select, update

from tappet.project.model import Project, ProjectObject
from tappet.project.objects import changed_object
from tappet.project.store.positions import new_positions
from tappet.project.store.records import ChangeEvent, ObjectAction, ObjectChange, ProjectInfo
from tappet.project.store.rows import StoredProject, data_of, summary_of
from tappet.project.store.tables import changes, objects, projects, revisions

_CHUNK = 500
"""Rows in one statement; databases limit the number of parameters."""


def write_change(
    connection: Connection,
    info: ProjectInfo,
    action: str,
    author: str,
    comment: str,
    *,
    autosave: bool = False,
    undoes: int | None = None,
) -> int:
    """Begin a change of a locked project: its row in the history, and the project's new revision number."""
    now = datetime.now(UTC)
    number = info.revision + 1
    connection.execute(
        update(projects)
        .where(projects.c.id == info.id)
        .values(revision=number, changed_at=now, changed_by=author)
    )
    connection.execute(
        insert(changes).values(
            project_id=info.id,
            revision=number,
            action=action,
            author=author,
            at=now,
            comment=comment,
            autosave=autosave,
            undoes=undoes,
        )
    )
    return number


def apply_project(
    connection: Connection,
    stored: StoredProject,
    wanted: Project,
    action: str,
    author: str,
    comment: str,
    *,
    moved: str | None = None,
    undoes: int | None = None,
    places: Mapping[str, int] | None = None,
) -> tuple[Project, ChangeEvent | None]:
    """Make a locked project what `wanted` says. Returns it with its new revisions, and the event.

    The event is None when nothing differs; then nothing is written. `moved` is the object that was moved
    among its siblings: of two neighbours that changed places, that one gets the revision. `undoes` is the
    revision of the change that this one takes back, `places` the positions that objects had before it: they
    get them again where that gives the wanted order.
    """
    old = stored.project
    positions = _changed_positions(stored, wanted, moved, places or {})
    created = [item for item in wanted.walk() if item.id not in old.objects]
    changed = [
        item
        for item in wanted.objects.values()
        if item.id in old.objects and (item.id in positions or _differs(old.objects[item.id], item))
    ]
    deleted = [item for item in old.objects.values() if item.id not in wanted.objects]
    if not (created or changed or deleted):
        return wanted, None
    number = write_change(connection, stored.info, action, author, comment, undoes=undoes)
    places = {**stored.positions, **positions}
    last = _last_revisions(connection, stored.info.id, [item.id for item in created])
    created = [changed_object(item, revision=last.get(item.id, 0) + 1) for item in created]
    changed = [changed_object(item, revision=old.objects[item.id].revision + 1) for item in changed]
    gone = [changed_object(item, revision=item.revision + 1) for item in deleted]
    _delete_objects(connection, stored.info.id, [item.id for item in deleted])
    for item in changed:
        row = _object_row(stored.info.id, item, places[item.id])
        connection.execute(
            update(objects).where(objects.c.project_id == stored.info.id, objects.c.id == item.id).values(row)
        )
    _insert(connection, objects, (_object_row(stored.info.id, item, places[item.id]) for item in created))
    _insert(
        connection,
        revisions,
        (
            revision_row(stored.info.id, item, places[item.id], number, deleted=item.id not in wanted.objects)
            for item in (*created, *changed, *gone)
        ),
    )
    renewed = {item.id: item for item in (*created, *changed)}
    result = Project(
        wanted.name, wanted.description, {**wanted.objects, **renewed}, extra_files=old.extra_files
    )
    touched = (
        *(ObjectChange("created", summary_of(item)) for item in created),
        *(ObjectChange(_action(old.objects[item.id], item), summary_of(item)) for item in changed),
        *(ObjectChange("deleted", summary_of(item)) for item in gone),
    )
    return result, ChangeEvent(stored.info.id, number, action, author, touched)


def revision_row(
    project_id: str, item: ProjectObject, position: int, change: int, *, deleted: bool = False
) -> dict[str, Any]:
    """The row that keeps this state of an object for ever."""
    return {
        "project_id": project_id,
        "object_id": item.id,
        "revision": item.revision,
        "change": change,
        "deleted": deleted,
        "parent_id": item.parent_id,
        "kind": item.kind,
        "name": item.name,
        "position": position,
        "data": data_of(item),
    }


def _object_row(project_id: str, item: ProjectObject, position: int) -> dict[str, Any]:
    return {
        "project_id": project_id,
        "id": item.id,
        "parent_id": item.parent_id,
        "kind": item.kind,
        "subkind": item.subkind,
        "name": item.name,
        "position": position,
        "revision": item.revision,
        "data": data_of(item),
        "excluded": item.excluded,
    }


def _differs(old: ProjectObject, new: ProjectObject) -> bool:
    """Whether an object has other content; its index alone is kept by positions, its number is ours."""
    if old is new:
        return False
    return (old.parent_id, old.kind, old.name, old.data) != (new.parent_id, new.kind, new.name, new.data)


def _action(old: ProjectObject, new: ProjectObject) -> ObjectAction:
    same = (old.name, old.data) == (new.name, new.data)
    return "moved" if same else "updated"


def _changed_positions(
    stored: StoredProject, wanted: Project, moved: str | None, places: Mapping[str, int]
) -> dict[str, int]:
    """Positions that give each parent's children the wanted order."""
    changed = {
        key: place
        for key, place in places.items()
        if key in wanted.objects and stored.positions.get(key) != place
    }
    for parent_id in {item.parent_id for item in wanted.objects.values()}:
        order = [item.id for item in wanted.children(parent_id)]
        before = [item.id for item in stored.project.children(parent_id)]
        if order == before and changed.keys().isdisjoint(order):
            continue
        here = {key for key in before if key not in (moved, *places)}
        present = {key: stored.positions[key] for key in order if key in here}
        present |= {key: places[key] for key in order if key in places}
        changed.update(new_positions(order, present))
    return changed


def _last_revisions(connection: Connection, project_id: str, ids: Sequence[str]) -> dict[str, int]:
    """The last revision number of ids that existed before."""
    found: dict[str, int] = {}
    for chunk in _chunks(ids):
        rows = connection.execute(
            select(revisions.c.object_id, func.max(revisions.c.revision))
            .where(revisions.c.project_id == project_id, revisions.c.object_id.in_(chunk))
            .group_by(revisions.c.object_id)
        )
        found.update((row[0], row[1]) for row in rows)
    return found


def _delete_objects(connection: Connection, project_id: str, ids: Sequence[str]) -> None:
    for chunk in _chunks(ids):
        connection.execute(delete(objects).where(objects.c.project_id == project_id, objects.c.id.in_(chunk)))


def _insert(connection: Connection, table: Any, rows: Iterable[dict[str, Any]]) -> None:
    for chunk in _chunks(list(rows)):
        connection.execute(insert(table), list(chunk))


def _chunks(items: Sequence[Any]) -> Iterator[Sequence[Any]]:
    for start in range(0, len(items), _CHUNK):
        yield items[start : start + _CHUNK]
