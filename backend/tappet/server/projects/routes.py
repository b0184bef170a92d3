"""Projects: the list, their changes, import and export."""

from __future__ import annotations

from collections.abc import Callable
from typing import Annotated
from urllib.parse import quote

from fastapi import Form, Query, UploadFile
from fastapi.responses import Response

from tappet.iec.languages import languages
from tappet.project import folder
from tappet.project.folder import read_zip, write_zip
from tappet.project.model import Project
from tappet.project.motion_project import motion_project
from tappet.project.placement import PlacementRule, placement_rules
from tappet.server.audit import Act
from tappet.server.audited import ActRecord, audited
from tappet.server.auth.roles import Role
from tappet.server.dependencies import ServicesDep, StoreDep, Viewer
from tappet.server.projects.examples import example_content, example_folders, find_example
from tappet.server.projects.part import PartDep
from tappet.server.projects.replies import project_revision, project_summary
from tappet.server.projects.shapes import (
    BodyLanguage,
    Example,
    NewProject,
    ProjectChange,
    ProjectSummary,
    RevertTarget,
    Revision,
)
from tappet.server.routing import Router
from tappet.server.shapes import Number

router = Router(tags=["projects"])

_TEMPLATES: dict[str, Callable[[str, str], Project]] = {"motion": motion_project, "empty": Project}
"""What new projects begin with that are not the standard one of the store."""
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


@router.get("/examples")
def list_examples(who: Viewer) -> list[Example]:
    """The example projects that a new project can begin with."""
    found = []
    for name, path in example_folders().items():
        project = folder.load(path)
        found.append(Example(name=name, title=project.name, description=project.description))
    return sorted(found, key=lambda example: example.title)


@router.post("/projects", status_code=201)
def create_project(
    act: Annotated[ActRecord, audited("project-created", Role.ENGINEER)],
    body: NewProject,
    store: StoreDep,
) -> ProjectSummary:
    """Make a project: with a soft PLC, PLC_PRG and a task that calls it, with an axis that they move, empty,
    or as an example."""
    begin = _TEMPLATES.get(body.template)
    content = None if begin is None else begin(body.name, body.description)
    if body.example is not None:
        content = example_content(find_example(body.example))
    act.begin(Act("project-created", body.name))
    description = body.description or (content.description if content else "")
    info = store.create_project(body.name, act.who.username, description=description, content=content)
    act.resulted(subject=info.name, project_id=info.id)
    return project_summary(info)


@router.post("/projects/import", status_code=201, max_body_size=MAX_ARCHIVE_BYTES)
def import_project(
    act: Annotated[ActRecord, audited("project-imported", Role.ENGINEER)],
    file: UploadFile,
    store: StoreDep,
    name: Annotated[str | None, Form(description="Another name than the one in the archive.")] = None,
) -> ProjectSummary:
    """Make a project from a zip archive of a project folder. A name that is taken is counted on."""
    content = read_zip(file.file)
    act.begin(Act("project-imported", name or content.name, new_value=file.filename))
    info = store.create_project(
        name or content.name,
        act.who.username,
        description=content.description,
        content=content,
        comment=(file.filename or "")[:200],
        free_name=True,
    )
    act.resulted(subject=info.name, project_id=info.id)
    return project_summary(info)


@router.get("/projects/{project_id}")
def read_project(project_id: str, who: Viewer, store: StoreDep) -> ProjectSummary:
    """One project."""
    return project_summary(store.project(project_id))


@router.patch("/projects/{project_id}")
def change_project(
    act: Annotated[ActRecord, audited("project-changed", Role.ENGINEER)],
    project_id: str,
    body: ProjectChange,
    store: StoreDep,
) -> ProjectSummary:
    """Rename or describe a project."""
    old = store.project(project_id)
    if body.name is not None and body.name != old.name:
        act.begin(Act("project-renamed", old.name, old.name, body.name, project_id))
    else:
        act.begin(Act("project-described", old.name, old.description, body.description, project_id))
    return project_summary(
        store.change_project(project_id, act.who.username, name=body.name, description=body.description)
    )


@router.delete("/projects/{project_id}", status_code=204)
def delete_project(
    act: Annotated[ActRecord, audited("project-deleted", Role.ENGINEER)],
    project_id: str,
    store: StoreDep,
    services: ServicesDep,
) -> None:
    """Delete a project; it can be restored."""
    act.begin(Act("project-deleted", store.project(project_id).name, project_id=project_id))
    store.delete_project(project_id, act.who.username)
    services.analysis.project_deleted(project_id)


@router.post("/projects/{project_id}/restore")
def restore_project(
    act: Annotated[ActRecord, audited("project-restored", Role.ENGINEER)],
    project_id: str,
    store: StoreDep,
) -> ProjectSummary:
    """Bring a deleted project back; if its name is taken by now, it is counted on."""
    act.begin(Act("project-restored", "", project_id=project_id))
    info = store.restore_project(project_id, act.who.username)
    act.resulted(subject=info.name)
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
    part: PartDep,
    revision: Annotated[Number | None, Query(description="As it was after this change; null: now.")] = None,
) -> Response:
    """A project as a zip archive of its folder; the same content always gives the same bytes."""
    project = store.load(project_id, with_files=True)
    if revision is not None:
        then = store.project_at(project_id, revision)
        project = Project(project.name, project.description, then.objects, project.extra_files)
    return download(write_zip(part.of(project)), f"{project.name}.zip", "application/zip")


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
    before: Annotated[Number | None, Query(description="Only changes older than this revision.")] = None,
) -> list[Revision]:
    """The changes of a project, newest first."""
    return [
        project_revision(found) for found in store.project_revisions(project_id, limit=limit, before=before)
    ]


@router.post("/projects/{project_id}/revert")
def revert_project(
    act: Annotated[ActRecord, audited("project-reverted", Role.ENGINEER)],
    project_id: str,
    body: RevertTarget,
    store: StoreDep,
) -> ProjectSummary:
    """Make a project what it was after a change, as a new change; deleted objects come back."""
    name, wanted = store.project(project_id).name, f"revision {body.revision}"
    act.begin(Act("project-reverted", name, new_value=wanted, project_id=project_id))
    info = store.revert_project(project_id, body.revision, act.who.username, comment=body.comment)
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
