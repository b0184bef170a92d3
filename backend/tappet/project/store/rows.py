"""Between table rows and the values of the project model."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from sqlalchemy import Connection, Row, select

from tappet.project.model import DEVICE, Project, ProjectObject, is_pous_root
from tappet.project.naming import name_key
from tappet.project.objects import stored_object
from tappet.project.store.records import ObjectSummary, ProjectInfo, UnknownProjectError
from tappet.project.store.tables import files, objects, projects

PROJECT_COLUMNS = (
    projects.c.id,
    projects.c.name,
    projects.c.description,
    projects.c.revision,
    projects.c.created_at,
    projects.c.created_by,
    projects.c.changed_at,
    projects.c.changed_by,
    projects.c.deleted_at,
)
"""The columns of a ProjectInfo, in the order of its fields."""


@dataclass(frozen=True, slots=True)
class StoredProject:
    """A project as one transaction sees it, with the positions of its objects."""

    info: ProjectInfo
    project: Project
    positions: Mapping[str, int]


def read_info(connection: Connection, project_id: str, *, lock: bool = False) -> ProjectInfo:
    """The row of a project that is not deleted; `lock` keeps other writers of it out until the end of the
    transaction. Raises UnknownProjectError.
    """
    query = select(*PROJECT_COLUMNS).where(projects.c.id == project_id, projects.c.deleted_at.is_(None))
    row = connection.execute(query.with_for_update() if lock else query).one_or_none()
    if row is None:
        raise UnknownProjectError(f"There is no project with the id {project_id}")
    return ProjectInfo(*row)


def read_project(connection: Connection, info: ProjectInfo, *, with_files: bool = False) -> StoredProject:
    """All objects of a project; with its further files on demand."""
    rows = connection.execute(
        select(
            objects.c.id,
            objects.c.parent_id,
            objects.c.kind,
            objects.c.name,
            objects.c.position,
            objects.c.revision,
            objects.c.data,
        ).where(objects.c.project_id == info.id)
    ).all()
    return stored_project(info, rows, read_files(connection, info.id) if with_files else {})


def read_files(connection: Connection, project_id: str) -> dict[str, bytes]:
    """The further files of a project by path."""
    rows = connection.execute(select(files.c.path, files.c.content).where(files.c.project_id == project_id))
    return {row.path: row.content for row in rows}


def object_of(row: Row[Any], object_id: str, index: int = 0) -> ProjectObject:
    """The object in a row of the objects or of their revisions."""
    return stored_object(
        id=object_id,
        parent_id=row.parent_id,
        kind=row.kind,
        name=row.name,
        index=index,
        revision=row.revision,
        data=row.data,
    )


def stored_project(
    info: ProjectInfo, rows: Iterable[Sequence[Any]], extra: Mapping[str, bytes]
) -> StoredProject:
    """The project of rows of (id, parent_id, kind, name, position, revision, data)."""
    ordered = list(rows)
    ranks = ranks_of((row[0], row[1], row[2], row[4], row[3]) for row in ordered)
    items: dict[str, ProjectObject] = {}
    for object_id, parent_id, kind, name, _, revision, data in ordered:
        items[object_id] = stored_object(
            id=object_id,
            parent_id=parent_id,
            kind=kind,
            name=name,
            index=ranks[object_id],
            revision=revision,
            data=data,
        )
    project = Project(info.name, info.description, items, extra)
    return StoredProject(info, project, {row[0]: row[4] for row in ordered})


def read_summaries(connection: Connection, project_id: str) -> list[ObjectSummary]:
    """The tree without data; siblings in their order."""
    columns = (
        objects.c.id,
        objects.c.parent_id,
        objects.c.kind,
        objects.c.subkind,
        objects.c.name,
        objects.c.position,
        objects.c.revision,
        objects.c.excluded,
    )
    rows = connection.execute(select(*columns).where(objects.c.project_id == project_id)).all()
    ranks = ranks_of((row.id, row.parent_id, row.kind, row.position, row.name) for row in rows)
    found = [
        ObjectSummary(
            row.id,
            row.parent_id,
            row.kind,
            row.subkind,
            row.name,
            ranks[row.id],
            row.revision,
            row.excluded,
        )
        for row in rows
    ]
    return sorted(found, key=lambda item: (item.parent_id or "", item.kind != DEVICE, item.index))


def summary_of(item: ProjectObject) -> ObjectSummary:
    """The summary of an object."""
    return ObjectSummary(
        item.id,
        item.parent_id,
        item.kind,
        item.subkind,
        item.name,
        item.index,
        item.revision,
        item.excluded,
    )


def data_of(item: ProjectObject) -> dict[str, Any]:
    """The data of an object as JSON values, as they are stored."""
    return item.data.model_dump(mode="json")


def ranks_of(places: Iterable[tuple[str, str | None, str, int, str]]) -> dict[str, int]:
    """The index of each object among its siblings, from (id, parent, kind, position, name)."""
    siblings: dict[tuple[str | None, bool], list[tuple[int, str, str]]] = defaultdict(list)
    for object_id, parent_id, kind, position, name in places:
        group = parent_id, is_pous_root(parent_id, kind)
        siblings[group].append((position, name_key(name), object_id))
    return {
        object_id: index
        for members in siblings.values()
        for index, (_, _, object_id) in enumerate(sorted(members))
    }
