"""Saving objects: optimistic locking, and autosaves that replace each other."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from datetime import UTC, datetime, timedelta
from typing import Any

from sqlalchemy import Connection, and_, delete, func, insert, select, update

from tappet.project.data import CodeData
from tappet.project.errors import InvalidDataError, UnknownObjectError
from tappet.project.model import DEVICE, Project, ProjectObject
from tappet.project.objects import changed_object
from tappet.project.store.changes import revision_row, write_change
from tappet.project.store.history import object_revisions
from tappet.project.store.records import (
    ChangeEvent,
    ObjectChange,
    ObjectContent,
    ProjectInfo,
    StaleRevision,
    UnknownRevisionError,
)
from tappet.project.store.rows import data_of, object_of, summary_of
from tappet.project.store.tables import changes, objects, revisions

AUTOSAVE_WINDOW = timedelta(seconds=60)
"""Autosaves of one author that follow each other within this time leave one revision."""


@dataclass(frozen=True, slots=True)
class StoredObject:
    """An object as it is in its row; its index is not known here and 0."""

    item: ProjectObject
    position: int


def read_object(connection: Connection, project_id: str, object_id: str) -> StoredObject:
    """One object. Raises UnknownObjectError."""
    row = connection.execute(
        select(objects).where(objects.c.project_id == project_id, objects.c.id == object_id)
    ).one_or_none()
    if row is None:
        raise UnknownObjectError(f"The project has no object with the id {object_id}")
    return StoredObject(object_of(row, row.id), row.position)


def with_index(connection: Connection, project_id: str, stored: StoredObject) -> ProjectObject:
    """The object with its place among its siblings."""
    item = stored.item
    before = (
        select(func.count())
        .select_from(objects)
        .where(
            objects.c.project_id == project_id,
            objects.c.parent_id == item.parent_id,
            objects.c.position < stored.position,
        )
    )
    if item.parent_id is None:
        is_device = objects.c.kind == DEVICE
        before = before.where(is_device if item.kind == DEVICE else ~is_device)
    return changed_object(item, index=connection.scalar(before))


def check_base(
    connection: Connection, project_id: str, object_id: str, base_revision: int, yours: Mapping[str, Any]
) -> StoredObject:
    """The object as it is, provided its content is that of `base_revision`: a mere move disturbs nobody, nor
    does excluding it from the build.

    Raises StaleRevision when somebody else changed or deleted it, UnknownObjectError when it never was.
    """
    try:
        stored = read_object(connection, project_id, object_id)
    except UnknownObjectError:
        raise _deleted(connection, project_id, object_id, base_revision, yours) from None
    if stored.item.revision == base_revision:
        return stored
    base = _state(connection, project_id, stored.item, base_revision)
    if base is not None and (base.name, _content(base)) == (stored.item.name, _content(stored.item)):
        return stored
    author = object_revisions(connection, project_id, object_id)[0].author
    current = with_index(connection, project_id, stored)
    raise StaleRevision(object_id, base_revision, current, yours, author)


def _state(
    connection: Connection, project_id: str, item: ProjectObject, revision: int
) -> ProjectObject | None:
    """The object with the name and data of an earlier revision of it; None when there is none."""
    row = connection.execute(
        select(revisions.c.name, revisions.c.data).where(
            revisions.c.project_id == project_id,
            revisions.c.object_id == item.id,
            revisions.c.revision == revision,
        )
    ).one_or_none()
    return None if row is None else changed_object(item, name=row.name, data=row.data)


def _content(item: ProjectObject) -> object:
    """What an editor edits."""
    if isinstance(item.data, CodeData):
        return item.data.model_copy(update={"exclude_from_build": False})
    return item.data


def _with_flag(
    connection: Connection, info: ProjectInfo, before: ProjectObject, revision: int, wanted: ProjectObject
) -> ProjectObject:
    """`wanted`, excluded from the build as it is now when the save did not change that itself."""
    if before.excluded == wanted.excluded:
        return wanted
    base = _state(connection, info.id, before, revision)
    if base is None or base.excluded != wanted.excluded:
        return wanted
    return changed_object(wanted, data=wanted.data.model_copy(update={"exclude_from_build": before.excluded}))


def save_data(
    connection: Connection,
    info: ProjectInfo,
    object_id: str,
    base_revision: int,
    data: Any,
    author: str,
    comment: str,
    autosave: bool,
) -> tuple[ProjectObject, ChangeEvent | None]:
    """Give an object of a locked project other data. The event is None when they were the same already.

    Raises StaleRevision, InvalidDataError, UnknownObjectError.
    """
    try:
        before = read_object(connection, info.id, object_id)
    except UnknownObjectError:
        raise _deleted(connection, info.id, object_id, base_revision, {"data": data}) from None
    wanted = _with_flag(connection, info, before.item, base_revision, changed_object(before.item, data=data))
    if wanted.data == before.item.data:
        if not autosave:
            _keep_autosave(connection, info, before.item, comment)
        return with_index(connection, info.id, before), None
    check_base(connection, info.id, object_id, base_revision, {"data": data_of(wanted)})
    saved = changed_object(wanted, revision=before.item.revision + 1)
    updated = connection.execute(
        update(objects)
        .where(
            objects.c.project_id == info.id,
            objects.c.id == object_id,
            objects.c.revision == before.item.revision,
        )
        .values(data=data_of(saved), subkind=saved.subkind, revision=saved.revision, excluded=saved.excluded)
    )
    assert updated.rowcount == 1, "the project is locked, so nobody else can have saved"
    replaced = _replaceable(connection, info, before.item, author) if autosave else None
    number = write_change(connection, info, "save", author, comment, autosave=autosave)
    row = revision_row(info.id, saved, before.position, number)
    if replaced is None:
        connection.execute(insert(revisions).values(row))
    else:
        _replace(connection, info, before.item, row, replaced)
    result = with_index(connection, info.id, StoredObject(saved, before.position))
    event = ChangeEvent(info.id, number, "save", author, (ObjectChange("updated", summary_of(result)),))
    return result, event


def with_contents(
    connection: Connection, info: ProjectInfo, project: Project, contents: Iterable[ObjectContent]
) -> Project:
    """A locked project with other data in several objects, all of which are as they were read.

    Raises StaleRevision for the first that is not, InvalidDataError, UnknownObjectError.
    """
    given: dict[str, ProjectObject] = {}
    for content in contents:
        object_id, base = content.object_id, content.base_revision
        if object_id in given:
            raise InvalidDataError(
                f"The object {object_id} is given twice; one content an object can be saved"
            )
        item = project.objects.get(object_id)
        if item is None:
            raise _deleted(connection, info.id, object_id, base, {"data": content.data})
        wanted = _with_flag(connection, info, item, base, changed_object(item, data=content.data))
        if wanted.data != item.data:
            check_base(connection, info.id, object_id, base, {"data": data_of(wanted)})
        given[object_id] = wanted
    objects_now = {**project.objects, **given}
    return Project(project.name, project.description, objects_now, extra_files=project.extra_files)


def _deleted(
    connection: Connection, project_id: str, object_id: str, base_revision: int, yours: Mapping[str, Any]
) -> StaleRevision | UnknownObjectError:
    try:
        last = object_revisions(connection, project_id, object_id)[0]
    except UnknownRevisionError:
        return UnknownObjectError(f"The project has no object with the id {object_id}")
    return StaleRevision(object_id, base_revision, None, yours, last.author)


def _last_change(connection: Connection, info: ProjectInfo, item: ProjectObject) -> Any:
    """The change that made the present revision of an object."""
    return connection.execute(
        select(changes.c.revision, changes.c.author, changes.c.at, changes.c.autosave)
        .join(
            revisions,
            and_(changes.c.project_id == revisions.c.project_id, changes.c.revision == revisions.c.change),
        )
        .where(
            revisions.c.project_id == info.id,
            revisions.c.object_id == item.id,
            revisions.c.revision == item.revision,
        )
    ).one()


def _replaceable(connection: Connection, info: ProjectInfo, item: ProjectObject, author: str) -> Any:
    """The autosave that the next one may take the place of, or None.

    Not when an explicit change of the project came after it: going back to that one must find the object as
    it was then.
    """
    last = _last_change(connection, info, item)
    if not last.autosave or last.author != author or datetime.now(UTC) - last.at > AUTOSAVE_WINDOW:
        return None
    explicit = connection.execute(
        select(changes.c.revision)
        .where(
            changes.c.project_id == info.id,
            changes.c.revision > last.revision,
            changes.c.autosave.is_(False),
        )
        .limit(1)
    ).first()
    return last if explicit is None else None


def _replace(
    connection: Connection, info: ProjectInfo, before: ProjectObject, row: dict[str, Any], replaced: Any
) -> None:
    """Put a revision in the place of an autosave; the time stays that of the first of them."""
    number = row["change"]
    connection.execute(
        update(changes)
        .where(changes.c.project_id == info.id, changes.c.revision == number)
        .values(at=replaced.at)
    )
    connection.execute(
        update(revisions)
        .where(
            revisions.c.project_id == info.id,
            revisions.c.object_id == before.id,
            revisions.c.revision == before.revision,
        )
        .values(row)
    )
    connection.execute(
        delete(changes).where(changes.c.project_id == info.id, changes.c.revision == replaced.revision)
    )


def _keep_autosave(connection: Connection, info: ProjectInfo, item: ProjectObject, comment: str) -> None:
    """An explicit save of what an autosave holds already makes that one explicit."""
    last = _last_change(connection, info, item)
    if last.autosave:
        connection.execute(
            update(changes)
            .where(changes.c.project_id == info.id, changes.c.revision == last.revision)
            .values(autosave=False, comment=comment)
        )
