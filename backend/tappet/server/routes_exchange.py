"""Files of other systems into projects, and projects as PLCopen XML."""

from __future__ import annotations

from typing import Annotated
from urllib.parse import quote

from fastapi import APIRouter, Form, UploadFile
from fastapi.responses import Response

from tappet.project.errors import FolderFormatError, UnknownObjectError
from tappet.project.exchange import ImportReport, import_files, is_importable
from tappet.project.exchange.plcopen_write import write_plcopen
from tappet.project.folder.archive import DEFAULT_LIMITS, unpack
from tappet.project.model import Project
from tappet.server import audit
from tappet.server.audit import Act
from tappet.server.dependencies import DatabaseDep, Engineer, StoreDep, Viewer
from tappet.server.project_shapes import project_summary
from tappet.server.routes_projects import MAX_ARCHIVE_BYTES
from tappet.server.schemas.exchange import ImportResult

router = APIRouter(tags=["projects"])


@router.post("/projects/import-files", status_code=201, max_body_size=MAX_ARCHIVE_BYTES)
def import_files_as_project(
    files: list[UploadFile],
    who: Engineer,
    store: StoreDep,
    database: DatabaseDep,
    name: Annotated[str | None, Form(description="Another name than the one in the files.")] = None,
) -> ImportResult:
    """Make a project from PLCopen XML, TwinCAT, CoDeSys 2.3 or ST files, or zip archives of them."""
    imported = import_files(_uploaded(files), name=name or "")
    content = imported.project
    info = store.create_project(
        name or content.name,
        who.username,
        description=content.description,
        content=content,
        comment=_named(files),
        free_name=True,
    )
    act = Act("project-imported", info.name, new_value=_named(files), project_id=info.id)
    database.write(lambda db: audit.record(db, who, act))
    return ImportResult(project=project_summary(info), report=imported.report)


@router.post("/projects/{project_id}/import-files", max_body_size=MAX_ARCHIVE_BYTES)
def import_files_into_project(
    project_id: str,
    files: list[UploadFile],
    who: Engineer,
    store: StoreDep,
    database: DatabaseDep,
    application_id: Annotated[
        str | None, Form(description="The application that takes the objects; null: the first one.")
    ] = None,
) -> ImportResult:
    """Import files of other systems into a project, as one change; nothing in the project is overwritten."""
    content = _uploaded(files)

    def grown(project: Project) -> tuple[Project, ImportReport]:
        if application_id is not None and project.get(application_id).kind != "application":
            raise UnknownObjectError(f"'{project.get(application_id).name}' is no application")
        imported = import_files(content, project, application_id=application_id)
        return imported.project, imported.report

    report = store.edit(project_id, who.username, "import", grown, _named(files))
    info = store.project(project_id)
    act = Act("files-imported", info.name, new_value=_named(files), project_id=project_id)
    database.write(lambda db: audit.record(db, who, act))
    return ImportResult(project=project_summary(info), report=report)


@router.get(
    "/projects/{project_id}/export/plcopen",
    response_class=Response,
    responses={200: {"content": {"application/xml": {"schema": {"type": "string", "format": "binary"}}}}},
)
def export_plcopen(project_id: str, who: Viewer, store: StoreDep) -> Response:
    """A project as PLCopen XML (TC6 0201); the same content always gives the same bytes."""
    project = store.load(project_id)
    filename = quote(f"{project.name}.xml", safe="")
    return Response(
        write_plcopen(project),
        media_type="application/xml",
        headers={"Content-Disposition": f"attachment; filename=\"project.xml\"; filename*=UTF-8''{filename}"},
    )


def _uploaded(files: list[UploadFile]) -> dict[str, bytes]:
    """The uploaded files by path, archives unpacked; paths stay below a folder of their own."""
    found: dict[str, bytes] = {}
    for file in files:
        parts = (file.filename or "file").replace("\\", "/").split("/")
        path = "/".join(part for part in parts if part not in ("", ".", "..") and ":" not in part) or "file"
        if path.lower().endswith(".zip"):
            unpacked = unpack(file.file)
            found |= {name: content for name, content in unpacked.items() if is_importable(name)}
        else:
            found[path] = file.file.read()
    if not found:
        raise FolderFormatError("archive", "holds no file that can be imported")
    if len(found) > DEFAULT_LIMITS.files or sum(map(len, found.values())) > DEFAULT_LIMITS.total_bytes:
        raise FolderFormatError("files", "are too many or too large for one import")
    return found


def _named(files: list[UploadFile]) -> str:
    return ", ".join(file.filename or "file" for file in files)[:200]
