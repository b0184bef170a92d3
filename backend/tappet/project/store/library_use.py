"""Which projects refer to which libraries."""

from __future__ import annotations

from sqlalchemy import Connection, select

from tappet.project.kind_registry import kind_of, kinds
from tappet.project.library_reference import LibraryReference
from tappet.project.objects import stored_object
from tappet.project.store.records import ProjectInfo
from tappet.project.store.rows import PROJECT_COLUMNS
from tappet.project.store.tables import objects, projects


def read_library_references(connection: Connection) -> list[tuple[ProjectInfo, LibraryReference]]:
    """The references of all projects that are not deleted, by project name."""
    giving = [name for name, kind in kinds().items() if kind.compiled.libraries is not None]
    rows = connection.execute(
        select(*PROJECT_COLUMNS, objects.c.id, objects.c.kind, objects.c.name, objects.c.data)
        .join(objects, objects.c.project_id == projects.c.id)
        .where(projects.c.deleted_at.is_(None), objects.c.kind.in_(giving))
        .order_by(projects.c.name_key, projects.c.id)
    )
    found = []
    for *info, object_id, kind_name, name, data in rows:
        item = stored_object(id=object_id, kind=kind_name, name=name, data=data)
        kind = kind_of(item)
        if kind is not None and kind.compiled.libraries is not None:
            given = kind.compiled.libraries(item.data, item.name)
            found += [(ProjectInfo(*info), reference) for reference in given]
    return found
