"""Files of other systems into projects, and projects or parts of them as PLCopen XML or ST."""

from __future__ import annotations

from dataclasses import replace
from functools import partial
from typing import TYPE_CHECKING, Annotated

from fastapi import Form, UploadFile
from fastapi.responses import Response
from pydantic import TypeAdapter, ValidationError

from tappet.project.exchange.existing import Comparison, Decisions
from tappet.project.exchange.parts import st_files
from tappet.project.folder.archive import zip_files
from tappet.project.model import Project
from tappet.project.objects import describe
from tappet.project.project_file import PROJECT_FILE
from tappet.project.store import Store
from tappet.server.audit import Act
from tappet.server.audited import ActRecord, audited
from tappet.server.auth.roles import Role
from tappet.server.dependencies import Engineer, StoreDep, Viewer
from tappet.server.exchange.shapes import ImportFormats, ImportPreview, ImportResult
from tappet.server.problems import Problem
from tappet.server.projects.part import PartDep
from tappet.server.projects.replies import project_summary
from tappet.server.projects.routes import MAX_ARCHIVE_BYTES, download
from tappet.server.routing import Router
from tappet.server.spoken import LanguageDep, in_language

if TYPE_CHECKING:
    from tappet.project.exchange.importing import Imported
    from tappet.server.exchange.import_order import ImportOrder
    from tappet.server.exchange.uploads import Upload

router = Router(tags=["projects"])
MOST_ATTEMPTS = 5
_KEYS = TypeAdapter(list[str])


Chosen = Annotated[
    str | None, Form(description="JSON list: keys of the objects that are wanted; null: all of them.")
]
PlaceId = Annotated[
    str | None,
    Form(description="The application or folder that takes the objects, `pous` for the POUs view."),
]


@router.get("/import-formats")
def read_import_formats(who: Viewer) -> ImportFormats:
    """Which files of a folder are worth sending."""
    from tappet.server.exchange.uploads import ENDINGS  # as `_upload`

    return ImportFormats(endings=list(ENDINGS), project_file=PROJECT_FILE)


@router.post("/projects/preview-files", max_body_size=MAX_ARCHIVE_BYTES)
def preview_files(
    files: list[UploadFile],
    who: Engineer,
    store: StoreDep,
    language: LanguageDep,
    project_id: Annotated[
        str | None, Form(description="The project to import into; null: a new one.")
    ] = None,
    place: PlaceId = None,
) -> ImportPreview:
    """What an import of these files would bring, and what it would say; nothing is changed."""
    project = store.load(project_id) if project_id is not None else None
    found = _imported(replace(_upload(files).order(project, place=place), preview=True))
    preview = ImportPreview(name=found.project.name, nodes=found.nodes, report=found.report)
    return in_language(preview, language)


@router.post("/projects/{project_id}/compare-import", max_body_size=MAX_ARCHIVE_BYTES)
def compare_import(
    project_id: str,
    files: list[UploadFile],
    who: Engineer,
    store: StoreDep,
    key: Annotated[str, Form(max_length=200, description="Of the object, as the preview has it.")],
    place: PlaceId = None,
) -> Comparison:
    """An object of the files, the one of its name in the project, and both joined; nothing is changed."""
    order = replace(_upload(files).order(store.load(project_id), place=place), preview=True, compare=key)
    found = _imported(order, store, project_id).comparison
    if found is None:
        raise Problem(
            404, "nothing-to-compare", "The project has no object like this one; preview the files again."
        )
    return found


@router.post("/projects/import-files", status_code=201, max_body_size=MAX_ARCHIVE_BYTES)
def import_files_as_project(
    act: Annotated[ActRecord, audited("project-imported", Role.ENGINEER)],
    files: list[UploadFile],
    store: StoreDep,
    language: LanguageDep,
    name: Annotated[str | None, Form(description="Another name than the one in the files.")] = None,
    chosen: Chosen = None,
) -> ImportResult:
    """Make a project from PLCopen XML, TwinCAT, CoDeSys 2.3 or ST files, archives of them, or our own one."""
    imported = _imported(_upload(files).order(name=name or "", chosen=_keys(chosen)))
    content = imported.project
    act.begin(Act("project-imported", name or content.name, new_value=_named(files)))
    info = store.create_project(
        name or content.name,
        act.who.username,
        description=content.description,
        content=content,
        comment=_named(files),
        free_name=True,
    )
    act.resulted(subject=info.name, project_id=info.id)
    return in_language(ImportResult(project=project_summary(info), report=imported.report), language)


@router.post("/projects/{project_id}/import-files", max_body_size=MAX_ARCHIVE_BYTES)
def import_files_into_project(
    act: Annotated[ActRecord, audited("files-imported", Role.ENGINEER)],
    project_id: str,
    files: list[UploadFile],
    store: StoreDep,
    language: LanguageDep,
    place: PlaceId = None,
    chosen: Chosen = None,
    existing: Annotated[
        str | None,
        Form(
            description="JSON `Decisions`: `all` (overwrite, rename, merge or skip) says what becomes of "
            "objects whose names exist, `objects` the same by key; null: they come in under counted names."
        ),
    ] = None,
) -> ImportResult:
    """Import files into a project, as one change, which can be undone.

    Without a place, the first application takes the objects.
    """
    upload, keys, decisions = _upload(files), _keys(chosen), _decisions(existing)
    info, project = store.snapshot(project_id)
    act.begin(Act("files-imported", info.name, new_value=_named(files), project_id=project_id))
    for _ in range(MOST_ATTEMPTS):  # reading takes its time, and must not hold up who writes
        order = upload.order(project, place=place, chosen=keys, decisions=decisions)
        imported = _imported(order, store, project_id)
        grown = partial(_unless_changed, project, imported.project)
        if store.edit(project_id, act.who.username, "import", grown, _named(files)):
            summary = project_summary(store.project(project_id))
            return in_language(ImportResult(project=summary, report=imported.report), language)
        project = store.load(project_id)
    raise Problem(409, "project-busy", f"'{info.name}' is changed by others all the time; try again.")


def _unless_changed(before: Project, wanted: Project, now: Project) -> tuple[Project, bool]:
    """What shall be, if the project is still what `wanted` was made from."""
    return (wanted, True) if now.objects == before.objects else (now, False)


def _upload(files: list[UploadFile]) -> Upload:
    from tappet.server.exchange.uploads import Upload  # all formats: only for who imports and exports

    return Upload(files)


def _imported(order: ImportOrder, store: Store | None = None, project_id: str = "") -> Imported:
    from tappet.server.exchange.uploads import imported  # as `_upload`

    return imported(order, None if store is None else partial(store.past_data, project_id))


def _decisions(text: str | None) -> Decisions:
    try:
        return Decisions() if text is None else Decisions.model_validate_json(text)
    except ValidationError as error:
        raise Problem(422, "invalid-request", f"`existing`: {describe(error)}") from None


def _keys(text: str | None) -> list[str] | None:
    try:
        return None if text is None else _KEYS.validate_json(text)
    except ValidationError:
        raise Problem(422, "invalid-request", "`chosen` should be a JSON list of texts.") from None


@router.get(
    "/projects/{project_id}/export/plcopen",
    response_class=Response,
    responses={200: {"content": {"application/xml": {"schema": {"type": "string", "format": "binary"}}}}},
)
def export_plcopen(project_id: str, who: Viewer, store: StoreDep, part: PartDep) -> Response:
    """A project as PLCopen XML (TC6 0201); the same content always gives the same bytes."""
    from tappet.project.exchange.plcopen_write import write_plcopen  # as `_upload`

    project = part.of(store.load(project_id))
    return download(write_plcopen(project), f"{project.name}.xml", "application/xml")


@router.get(
    "/projects/{project_id}/export/st",
    response_class=Response,
    responses={
        200: {
            "content": {
                "application/zip": {"schema": {"type": "string", "format": "binary"}},
                "text/plain": {"schema": {"type": "string"}},
            }
        }
    },
)
def export_st(project_id: str, who: Viewer, store: StoreDep, part: PartDep) -> Response:
    """POUs, types and variable lists as ST: the text of a single one, else an archive of texts."""
    project = part.of(store.load(project_id))
    texts = st_files(project)
    if len(texts) == 1:
        path, text = next(iter(texts.items()))
        return download(text.encode(), path.rpartition("/")[2], "text/plain; charset=utf-8")
    content = zip_files({path: text.encode() for path, text in texts.items()})
    return download(content, f"{project.name} ST.zip", "application/zip")


def _named(files: list[UploadFile]) -> str:
    return ", ".join(file.filename or "file" for file in files)[:200]
