"""Projects: the list, their changes, import and export."""

from __future__ import annotations

from typing import Annotated
from urllib.parse import quote

from fastapi import APIRouter, Form, Query, UploadFile
from fastapi.responses import Response

from tappet.iec.languages import languages
from tappet.project.exchange.parts import part_of
from tappet.project.folder import read_zip, write_zip
from tappet.project.model import Project
from tappet.project.placement import PlacementRule, placement_rules
from tappet.server import audit
from tappet.server.audit import Act
from tappet.server.auth.identity import Identity
from tappet.server.database import Database
from tappet.server.dependencies import DatabaseDep, Engineer, ServicesDep, StoreDep, Viewer
from tappet.server.projects.replies import project_revision, project_summary
from tappet.server.projects.shapes import (
    BodyLanguage,
    NewProject,
    ProjectChange,
    ProjectSummary,
    RevertTarget,
    Revision,
)

router = APIRouter(tags=["projects"])

MAX_ARCHIVE_BYTES = 64 << 20
"""Largest archive that is taken; what it may unpack to is limited by `folder.archive`."""


@router.get("/projects")
def list_projects(
    who: Viewer,
    store: StoreDep,
    deleted: Annotated[bool, Query(description="Those that were deleted and can be restored.")] = False,
) -> list[ProjectSummary]:
    """All projects by name."""
    return [project_summary(info) for info in store.projects(deleted=deleted)]


@router.post("/projects", status_code=201)
def create_project(body: NewProject, who: Engineer, store: StoreDep, database: DatabaseDep) -> ProjectSummary:
    """Make a project: with a soft PLC, PLC_PRG and a task that calls it, or empty."""
    content = Project(body.name, body.description) if body.template == "empty" else None
    info = store.create_project(body.name, who.username, description=body.description, content=content)
    _note(database, who, Act("project-created", info.name, project_id=info.id))
    return project_summary(info)


@router.post("/projects/import", status_code=201, max_body_size=MAX_ARCHIVE_BYTES)
def import_project(
    file: UploadFile,
    who: Engineer,
    store: StoreDep,
    database: DatabaseDep,
    name: Annotated[str | None, Form(description="Another name than the one in the archive.")] = None,
) -> ProjectSummary:
    """Make a project from a zip archive of a project folder. A name that is taken is counted on."""
    content = read_zip(file.file)
    info = store.create_project(
        name or content.name,
        who.username,
        description=content.description,
        content=content,
        comment=(file.filename or "")[:200],
        free_name=True,
    )
    _note(database, who, Act("project-imported", info.name, new_value=file.filename, project_id=info.id))
    return project_summary(info)


@router.get("/projects/{project_id}")
def read_project(project_id: str, who: Viewer, store: StoreDep) -> ProjectSummary:
    """One project."""
    return project_summary(store.project(project_id))


@router.patch("/projects/{project_id}")
def change_project(
    project_id: str, body: ProjectChange, who: Engineer, store: StoreDep, database: DatabaseDep
) -> ProjectSummary:
    """Rename or describe a project."""
    old = store.project(project_id)
    new = store.change_project(project_id, who.username, name=body.name, description=body.description)
    if old.name != new.name:
        _note(database, who, Act("project-renamed", new.name, old.name, new.name, project_id))
    return project_summary(new)


@router.delete("/projects/{project_id}", status_code=204)
def delete_project(project_id: str, who: Engineer, store: StoreDep, services: ServicesDep) -> None:
    """Delete a project; it can be restored."""
    name = store.project(project_id).name
    store.delete_project(project_id, who.username)
    services.analysis.project_deleted(project_id)
    _note(services.database, who, Act("project-deleted", name, project_id=project_id))


@router.post("/projects/{project_id}/restore")
def restore_project(project_id: str, who: Engineer, store: StoreDep, database: DatabaseDep) -> ProjectSummary:
    """Bring a deleted project back; if its name is taken by now, it is counted on."""
    info = store.restore_project(project_id, who.username)
    _note(database, who, Act("project-restored", info.name, project_id=project_id))
    return project_summary(info)


@router.get(
    "/projects/{project_id}/export",
    response_class=Response,
    responses={200: {"content": {"application/zip": {"schema": {"type": "string", "format": "binary"}}}}},
)
def export_project(
    project_id: str,
    who: Viewer,
    store: StoreDep,
    revision: Annotated[int | None, Query(description="As it was after this change; null: now.")] = None,
    objects: Annotated[
        list[str],
        Query(alias="object", description="Only these objects with all below them; none: everything."),
    ] = [],  # noqa: B006
) -> Response:
    """A project as a zip archive of its folder; the same content always gives the same bytes."""
    project = store.load(project_id, with_files=True)
    if revision is not None:
        then = store.project_at(project_id, revision)
        project = Project(project.name, project.description, then.objects, project.extra_files)
    if objects:
        project = part_of(project, objects)
    return download(write_zip(project), f"{project.name}.zip", "application/zip")


def download(content: bytes, filename: str, media_type: str) -> Response:
    """A file to be saved by the browser under a name of any characters."""
    ending = filename.rpartition(".")[2]
    disposition = f"attachment; filename=\"project.{ending}\"; filename*=UTF-8''{quote(filename, safe='')}"
    return Response(content, media_type=media_type, headers={"Content-Disposition": disposition})


@router.get("/projects/{project_id}/revisions")
def list_project_revisions(
    project_id: str,
    who: Viewer,
    store: StoreDep,
    limit: Annotated[int, Query(ge=1, le=1000)] = 200,
    before: Annotated[int | None, Query(description="Only changes older than this revision.")] = None,
) -> list[Revision]:
    """The changes of a project, newest first."""
    return [
        project_revision(found) for found in store.project_revisions(project_id, limit=limit, before=before)
    ]


@router.post("/projects/{project_id}/revert")
def revert_project(
    project_id: str, body: RevertTarget, who: Engineer, store: StoreDep, database: DatabaseDep
) -> ProjectSummary:
    """Make a project what it was after a change, as a new change; deleted objects come back."""
    info = store.revert_project(project_id, body.revision, who.username, comment=body.comment)
    act = Act("project-reverted", info.name, new_value=f"revision {body.revision}", project_id=project_id)
    _note(database, who, act)
    return project_summary(info)


@router.get("/languages")
def read_languages(who: Viewer) -> list[BodyLanguage]:
    """The languages that bodies can be in, in the order of lists."""
    return [
        BodyLanguage(
            name=one.name,
            title=one.title,
            text=one.text,
            drawn=one.drawn,
            compiled=bool(one.reader),
            offered=one.offered,
        )
        for one in languages().values()
    ]


@router.get("/placement")
def read_placement(who: Viewer) -> list[PlacementRule]:
    """Which kind of object may be where, and how it may be named."""
    return placement_rules()


def _note(database: Database, who: Identity, act: Act) -> None:
    database.write(lambda db: audit.record(db, who, act))
