"""Taking back one change of a project, whatever other objects have become since."""

from __future__ import annotations

from typing import Any

from sqlalchemy import Connection, Select, select

from tappet.project import edit
from tappet.project.errors import ProjectError
from tappet.project.model import Project
from tappet.project.store.records import ProjectInfo, UnknownRevisionError
from tappet.project.store.rows import StoredProject, object_of
from tappet.project.store.tables import revisions


class ChangedSinceError(ProjectError):
    """An object of the change that is to be taken back has been changed again; nothing has been written."""

    code = "changed_since"


class NotUndoableError(ProjectError):
    """The change added or deleted objects."""

    code = "not_undoable"


def without_change(connection: Connection, stored: StoredProject, revision: int) -> Project:
    """A locked project whose objects have the names and data again that they had before a change.

    Raises UnknownRevisionError, ChangedSinceError naming what was changed again, NotUndoableError.
    """
    project = stored.project
    touched = connection.execute(_states(stored.info).where(revisions.c.change == revision)).all()
    if not touched:
        raise UnknownRevisionError(f"The project '{stored.info.name}' has no change {revision} of objects")
    again = [
        row.name
        for row in touched
        if row.object_id not in project.objects or project.get(row.object_id).revision != row.revision
    ]
    if again:
        names = ", ".join(f"'{name}'" for name in sorted(again)[:5])
        raise ChangedSinceError(f"{names} changed since; take the objects back one by one in their history")
    for row in touched:
        before = connection.execute(
            _states(stored.info)
            .where(revisions.c.object_id == row.object_id, revisions.c.revision < row.revision)
            .order_by(revisions.c.revision.desc())
            .limit(1)
        ).one_or_none()
        if before is None or before.deleted:
            raise NotUndoableError(
                f"The change {revision} added '{row.name}'; delete it, or revert the project"
            )
        project = edit.give_content(project, object_of(before, row.object_id))
    return project


def _states(info: ProjectInfo) -> Select[Any]:
    return select(revisions).where(revisions.c.project_id == info.id)
