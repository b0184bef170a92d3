"""Which projects refer to which libraries."""

from __future__ import annotations

from sqlalchemy import Connection, select

from tappet.project.data import LibraryManagerData, LibraryReferenceData
from tappet.project.store.records import ProjectInfo
from tappet.project.store.rows import PROJECT_COLUMNS
from tappet.project.store.tables import objects, projects


def read_library_references(connection: Connection) -> list[tuple[ProjectInfo, LibraryReferenceData]]:
    """The references of all projects that are not deleted, by project name."""
    rows = connection.execute(
        select(*PROJECT_COLUMNS, objects.c.data)
        .join(objects, objects.c.project_id == projects.c.id)
        .where(projects.c.deleted_at.is_(None), objects.c.kind == "library_manager")
        .order_by(projects.c.name_key, projects.c.id)
    )
    return [
        (ProjectInfo(*row[:-1]), reference)
        for row in rows
        for reference in LibraryManagerData.model_validate(row[-1]).references
    ]
