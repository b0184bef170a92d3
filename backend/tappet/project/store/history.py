"""Reading the history: the states of an object, the changes of a project, a project as it was."""

from __future__ import annotations

from collections import defaultdict
from typing import Any

from sqlalchemy import Connection, Row, and_, func, select

from tappet.project.model import Project, ProjectObject
from tappet.project.store.records import (
    DeletedObject,
    ObjectRevision,
    ProjectInfo,
    ProjectRevision,
    UnknownRevisionError,
)
from tappet.project.store.rows import object_of, ranks_of, stored_project
from tappet.project.store.tables import changes, revisions

MOST_PAST = 200
"""States of one object that are looked at for the common ancestor of two versions."""


def object_revisions(connection: Connection, project_id: str, object_id: str) -> list[ObjectRevision]:
    """The states of an object, newest first; also of one that is deleted. Raises UnknownRevisionError."""
    rows = connection.execute(
        select(
            revisions.c.object_id,
            revisions.c.revision,
            revisions.c.name,
            revisions.c.kind,
            revisions.c.deleted,
            revisions.c.change,
            changes.c.action,
            changes.c.author,
            changes.c.at,
            changes.c.comment,
            changes.c.autosave,
        )
        .join(
            changes,
            and_(changes.c.project_id == revisions.c.project_id, changes.c.revision == revisions.c.change),
        )
        .where(revisions.c.project_id == project_id, revisions.c.object_id == object_id)
        .order_by(revisions.c.revision.desc())
    ).all()
    if not rows:
        raise UnknownRevisionError(f"The project never had an object with the id {object_id}")
    return [ObjectRevision(*row) for row in rows]


def object_at(
    connection: Connection, project_id: str, object_id: str, revision: int
) -> tuple[ProjectObject, int]:
    """An object as it was (its index is not known here and 0), and its position.

    Raises UnknownRevisionError; autosaves that a later one replaced are gone.
    """
    row = connection.execute(
        select(revisions).where(
            revisions.c.project_id == project_id,
            revisions.c.object_id == object_id,
            revisions.c.revision == revision,
        )
    ).one_or_none()
    if row is None:
        raise UnknownRevisionError(f"The object {object_id} has no revision {revision}")
    return object_of(row, object_id), row.position


def past_data(connection: Connection, project_id: str, object_id: str) -> list[dict[str, Any]]:
    """The data an object has had, newest first: at most its last `MOST_PAST` states."""
    rows = connection.execute(
        select(revisions.c.data)
        .where(revisions.c.project_id == project_id, revisions.c.object_id == object_id)
        .order_by(revisions.c.revision.desc())
        .limit(MOST_PAST)
    )
    return [dict(row.data) for row in rows]


def deleted_with(connection: Connection, project_id: str, change: int) -> list[ProjectObject]:
    """The objects that a change deleted, in the order they had among those of them with the same parent."""
    rows = connection.execute(
        select(revisions).where(
            revisions.c.project_id == project_id,
            revisions.c.change == change,
            revisions.c.deleted.is_(True),
        )
    ).all()
    ranks = ranks_of((row.object_id, row.parent_id, row.kind, row.position, row.name) for row in rows)
    return [object_of(row, row.object_id, ranks[row.object_id]) for row in rows]


def deleted_objects(
    connection: Connection, project: Project, project_id: str, limit: int
) -> list[DeletedObject]:
    """What was deleted and is not back, latest first, without what was deleted with something above it."""
    newest = (
        select(revisions.c.object_id, func.max(revisions.c.revision).label("revision"))
        .where(revisions.c.project_id == project_id)
        .group_by(revisions.c.object_id)
        .subquery()
    )
    rows = connection.execute(
        select(revisions, changes.c.author, changes.c.at)
        .join(
            newest,
            and_(newest.c.object_id == revisions.c.object_id, newest.c.revision == revisions.c.revision),
        )
        .join(
            changes,
            and_(changes.c.project_id == revisions.c.project_id, changes.c.revision == revisions.c.change),
        )
        .where(revisions.c.project_id == project_id, revisions.c.deleted.is_(True))
        .order_by(revisions.c.change.desc(), revisions.c.parent_id, revisions.c.position)
    ).all()
    gone = {row.object_id: row for row in rows}
    below: dict[str, int] = defaultdict(int)
    for row in rows:
        above = gone.get(row.parent_id)
        while above is not None and above.change == row.change:
            below[above.object_id] += 1
            above = gone.get(above.parent_id)

    def path(row: Row[Any]) -> str:
        if row.parent_id in project.objects:
            return f"{project.path_of(row.parent_id)}/{row.name}"
        above = gone.get(row.parent_id)
        return row.name if above is None else f"{path(above)}/{row.name}"

    tops = [row for row in rows if (above := gone.get(row.parent_id)) is None or above.change != row.change]
    return [
        DeletedObject(
            row.object_id,
            row.kind,
            object_of(row, row.object_id).subkind,
            row.name,
            path(row),
            row.revision,
            row.change,
            row.author,
            row.at,
            below[row.object_id],
        )
        for row in tops[:limit]
    ]


def project_revisions(
    connection: Connection, project_id: str, limit: int, before: int | None
) -> list[ProjectRevision]:
    """The newest changes of a project, or those before a revision, newest first."""
    query = (
        select(
            changes.c.revision,
            changes.c.action,
            changes.c.author,
            changes.c.at,
            changes.c.comment,
            changes.c.autosave,
        )
        .where(changes.c.project_id == project_id)
        .order_by(changes.c.revision.desc())
        .limit(limit)
    )
    if before is not None:
        query = query.where(changes.c.revision < before)
    rows = connection.execute(query).all()
    touched: dict[int, list[tuple[str, str]]] = defaultdict(list)
    if rows:
        named = connection.execute(
            select(revisions.c.change, revisions.c.object_id, revisions.c.name).where(
                revisions.c.project_id == project_id,
                revisions.c.change.between(rows[-1].revision, rows[0].revision),
            )
        )
        for change, object_id, name in named:
            touched[change].append((object_id, name))
    return [ProjectRevision(*row, objects=tuple(touched[row.revision])) for row in rows]


def project_at(connection: Connection, info: ProjectInfo, revision: int) -> Project:
    """A project as it was after a change, without its further files, which have no history.

    Raises UnknownRevisionError for a number that the project has not reached.
    """
    if not 1 <= revision <= info.revision:
        has = f"has the revisions 1 to {info.revision}" if info.revision else "has no revision yet"
        raise UnknownRevisionError(f"The project '{info.name}' {has}, not {revision}")
    newest = (
        select(revisions.c.object_id, func.max(revisions.c.revision).label("revision"))
        .where(revisions.c.project_id == info.id, revisions.c.change <= revision)
        .group_by(revisions.c.object_id)
        .subquery()
    )
    rows = connection.execute(
        select(
            revisions.c.object_id,
            revisions.c.parent_id,
            revisions.c.kind,
            revisions.c.name,
            revisions.c.position,
            revisions.c.revision,
            revisions.c.data,
        )
        .join(
            newest,
            and_(newest.c.object_id == revisions.c.object_id, newest.c.revision == revisions.c.revision),
        )
        .where(revisions.c.project_id == info.id, revisions.c.deleted.is_(False))
    ).all()
    return stored_project(info, rows, {}).project
