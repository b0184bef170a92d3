"""Which projects there are, and who is notified of changes."""

from __future__ import annotations

import logging
import uuid
from collections.abc import Callable
from datetime import UTC, datetime
from typing import Any

from sqlalchemy import Engine, insert, select, update
from sqlalchemy.exc import IntegrityError

from tappet.project.errors import NameTakenError
from tappet.project.library_reference import LibraryReference
from tappet.project.model import Project
from tappet.project.naming import check_project_name, name_key, normal_name, unique_name
from tappet.project.new_project import new_project
from tappet.project.placement import check_project
from tappet.project.store.changes import apply_project
from tappet.project.store.engine import migrate, open_engine, reading
from tappet.project.store.history_reader import HistoryReader
from tappet.project.store.library_use import read_library_references
from tappet.project.store.records import ChangeEvent, ProjectInfo, UnknownProjectError
from tappet.project.store.rows import PROJECT_COLUMNS, StoredProject, read_info
from tappet.project.store.tables import files, projects

Listener = Callable[[ChangeEvent], None]
log = logging.getLogger(__name__)


class ProjectList(HistoryReader):
    """The projects of a database: made, renamed, put away and brought back."""

    def __init__(self, database: str | Engine) -> None:
        """Open `sqlite:///file` or `postgresql://...` and bring its schema up to date. Raises StoreError."""
        self.engine = open_engine(database) if isinstance(database, str) else database
        migrate(self.engine)
        super().__init__(reading(self.engine))
        self._listeners: list[Listener] = []

    def close(self) -> None:
        """Close all connections."""
        self.engine.dispose()

    def listen(self, listener: Listener) -> Callable[[], None]:
        """Call `listener` after each stored change, in the thread that made it; returns how to stop that."""
        self._listeners.append(listener)
        return lambda: self._listeners.remove(listener)

    def projects(self, *, deleted: bool = False) -> list[ProjectInfo]:
        """All projects by name; with `deleted` those that were deleted instead."""
        condition = projects.c.deleted_at.is_not(None) if deleted else projects.c.deleted_at.is_(None)
        with self._reading.begin() as connection:
            rows = connection.execute(
                select(*PROJECT_COLUMNS).where(condition).order_by(projects.c.name_key, projects.c.id)
            )
            return [ProjectInfo(*row) for row in rows]

    def library_references(self) -> list[tuple[ProjectInfo, LibraryReference]]:
        """The libraries that the projects refer to, by project."""
        with self._reading.begin() as connection:
            return read_library_references(connection)

    def project(self, project_id: str) -> ProjectInfo:
        """One project. Raises UnknownProjectError."""
        with self._reading.begin() as connection:
            return read_info(connection, project_id)

    def create_project(
        self,
        name: str,
        author: str,
        *,
        description: str = "",
        content: Project | None = None,
        comment: str = "",
        free_name: bool = False,
    ) -> ProjectInfo:
        """Make a project, from `content` or with a soft PLC and PLC_PRG.

        `free_name` counts the name on instead of refusing one that is taken. Raises NameTakenError,
        InvalidNameError, and what check_project finds in the content.
        """
        name = normal_name(name)
        check_project_name(name)
        action = "create" if content is None else "import"
        content = content if content is not None else new_project(name, description)
        check_project(content)
        while True:
            wanted = unique_name(name, (info.name for info in self.projects())) if free_name else name
            try:
                return self._insert_project(wanted, description, content, action, author, comment)
            except NameTakenError:
                if not free_name:
                    raise

    def _insert_project(
        self, name: str, description: str, content: Project, action: str, author: str, comment: str
    ) -> ProjectInfo:
        now = datetime.now(UTC)
        info = ProjectInfo(uuid.uuid4().hex, name, description, 0, now, author, now, author, None)
        try:
            with self.engine.begin() as connection:
                connection.execute(
                    insert(projects).values(
                        id=info.id,
                        name=name,
                        name_key=name_key(name),
                        description=description,
                        revision=0,
                        created_at=now,
                        created_by=author,
                        changed_at=now,
                        changed_by=author,
                    )
                )
                for path, content_bytes in content.extra_files.items():
                    connection.execute(
                        insert(files).values(project_id=info.id, path=path, content=content_bytes)
                    )
                empty = StoredProject(info, Project(name, description), {})
                _, event = apply_project(connection, empty, content, action, author, comment)
                stored = read_info(connection, info.id)
        except IntegrityError as error:
            raise NameTakenError(f"There is a project named '{name}' already") from error
        self._notify(event)
        return stored

    def change_project(
        self, project_id: str, author: str, *, name: str | None = None, description: str | None = None
    ) -> ProjectInfo:
        """Rename or describe a project. Raises UnknownProjectError, NameTakenError, InvalidNameError."""
        values: dict[str, Any] = {"changed_at": datetime.now(UTC), "changed_by": author}
        if name is not None:
            name = normal_name(name)
            check_project_name(name)
            values |= {"name": name, "name_key": name_key(name)}
        if description is not None:
            values["description"] = description
        try:
            with self.engine.begin() as connection:
                read_info(connection, project_id, lock=True)
                connection.execute(update(projects).where(projects.c.id == project_id).values(values))
                return read_info(connection, project_id)
        except IntegrityError as error:
            raise NameTakenError(f"There is a project named '{name}' already") from error

    def delete_project(self, project_id: str, author: str) -> None:
        """Put a project away; `restore_project` brings it back. Raises UnknownProjectError."""
        now = datetime.now(UTC)
        with self.engine.begin() as connection:
            read_info(connection, project_id, lock=True)
            connection.execute(
                update(projects)
                .where(projects.c.id == project_id)
                .values(deleted_at=now, changed_at=now, changed_by=author)
            )

    def restore_project(self, project_id: str, author: str) -> ProjectInfo:
        """Bring a deleted project back, under a free name. Raises UnknownProjectError."""
        with self.engine.begin() as connection:
            row = connection.execute(
                select(*PROJECT_COLUMNS)
                .where(projects.c.id == project_id, projects.c.deleted_at.is_not(None))
                .with_for_update()
            ).one_or_none()
            if row is None:
                raise UnknownProjectError(f"There is no deleted project with the id {project_id}")
            taken = connection.scalars(select(projects.c.name).where(projects.c.deleted_at.is_(None)))
            name = unique_name(row.name, taken)
            connection.execute(
                update(projects)
                .where(projects.c.id == project_id)
                .values(
                    deleted_at=None,
                    name=name,
                    name_key=name_key(name),
                    changed_at=datetime.now(UTC),
                    changed_by=author,
                )
            )
            return read_info(connection, project_id)

    def _notify(self, event: ChangeEvent | None) -> None:
        if event is None:
            return
        for listener in tuple(self._listeners):
            try:
                listener(event)
            except Exception:
                log.exception(
                    "a listener failed on change %d of project %s", event.revision, event.project_id
                )
