"""What projects and objects have been: read without a lock of their project."""

from __future__ import annotations

from collections.abc import Collection
from typing import Any

from sqlalchemy import Engine

from tappet.project.model import Project, ProjectObject
from tappet.project.store import history
from tappet.project.store.records import DeletedObject, ObjectRevision, ProjectRevision
from tappet.project.store.rows import read_info, read_project
from tappet.project.store.undoing import Steps, steps_of


class HistoryReader:
    """Revisions of a database of projects. All methods block for it; call them from threads."""

    def __init__(self, reading: Engine) -> None:
        self._reading = reading

    def object_revisions(self, project_id: str, object_id: str) -> list[ObjectRevision]:
        """The states of an object, newest first. Raises UnknownProjectError, UnknownRevisionError."""
        with self._reading.begin() as connection:
            read_info(connection, project_id)
            return history.object_revisions(connection, project_id, object_id)

    def object_at(self, project_id: str, object_id: str, revision: int) -> ProjectObject:
        """An object as it was. Raises UnknownProjectError, UnknownRevisionError."""
        with self._reading.begin() as connection:
            read_info(connection, project_id)
            return history.object_at(connection, project_id, object_id, revision)[0]

    def past_data(self, project_id: str, object_ids: Collection[str]) -> dict[str, list[dict[str, Any]]]:
        """The data that objects have had, newest first; at most the last 200 states of each."""
        with self._reading.begin() as connection:
            return {one: history.past_data(connection, project_id, one) for one in object_ids}

    def project_revisions(
        self, project_id: str, *, limit: int = 100, before: int | None = None
    ) -> list[ProjectRevision]:
        """The changes of a project, newest first. Raises UnknownProjectError."""
        with self._reading.begin() as connection:
            read_info(connection, project_id)
            return history.project_revisions(connection, project_id, limit, before)

    def project_at(self, project_id: str, revision: int) -> Project:
        """A project as it was after a change. Raises UnknownProjectError, UnknownRevisionError."""
        with self._reading.begin() as connection:
            return history.project_at(connection, read_info(connection, project_id), revision)

    def deleted_objects(self, project_id: str, *, limit: int = 1000) -> list[DeletedObject]:
        """What was deleted and is not back, latest first. Raises UnknownProjectError."""
        with self._reading.begin() as connection:
            stored = read_project(connection, read_info(connection, project_id))
            return history.deleted_objects(connection, stored.project, project_id, limit)

    def steps(self, project_id: str, author: str) -> Steps:
        """What `undo` and `redo` of an author would do next. Raises UnknownProjectError."""
        with self._reading.begin() as connection:
            read_info(connection, project_id)
            return steps_of(connection, project_id, author)
