"""The installed libraries: what they offer, installing and removing them, and projects saved as libraries."""

from __future__ import annotations

from functools import lru_cache
from typing import Annotated

from fastapi import Query, UploadFile
from fastapi.responses import Response
from pydantic import TypeAdapter
from starlette.concurrency import run_in_threadpool

from tappet import libraries
from tappet.libraries import UnknownLibraryError, archive, repository
from tappet.libraries.archive import LibraryFileError
from tappet.libraries.library import Library
from tappet.project.errors import ProjectError
from tappet.project.library_texts import library_requirements, library_texts, requirements
from tappet.server.audit import Act
from tappet.server.audited import ActRecord, audited
from tappet.server.auth.roles import Role
from tappet.server.builds.builder import Application
from tappet.server.builds.shapes import BuildReport, Severity
from tappet.server.dependencies import CommissioningDep, ServicesDep, StoreDep, Viewer
from tappet.server.libraries.shapes import (
    LibraryDetail,
    LibraryItem,
    LibrarySource,
    LibrarySummary,
    LibraryUse,
    NewLibrary,
)
from tappet.server.problems import Problem, not_found
from tappet.server.projects.routes import download
from tappet.server.routing import Router
from tappet.server.services import Services
from tappet.server.spoken import LanguageDep
from tappet.translation.language import Language

router = Router(tags=["libraries"])
_ITEMS = TypeAdapter(list[LibraryItem])
Version = Annotated[str, Query(description="A version, or * for the newest one.")]


def _load(name: str, version: str = "*") -> Library:
    try:
        return libraries.load(name, version)
    except UnknownLibraryError as error:
        raise Problem(404, "not-found", f"{error}.") from None


@lru_cache(maxsize=32)
def _items(library: Library, language: Language) -> list[LibraryItem]:
    from tappet.libraries import catalog  # parses: only a server whose libraries are looked at needs that

    items = _ITEMS.validate_python(catalog.items(library), from_attributes=True)
    return [item.in_language(library.name, language) for item in items]


@router.get("/libraries")
def list_libraries(who: Viewer) -> list[LibrarySummary]:
    """All libraries a project may refer to, in all versions, newest first."""
    return [LibrarySummary.of(library) for library in libraries.every_version()]


@router.get("/libraries/{name}")
def get_library(name: str, who: Viewer, language: LanguageDep, version: Version = "*") -> LibraryDetail:
    """A library with its POUs and types, their pins, defaults and comments.

    Comments of `SM3_Basic` come in the language of the request.
    """
    library = _load(name, version)
    return LibraryDetail(**LibrarySummary.of(library).model_dump(), items=_items(library, language))


@router.get("/libraries/{name}/sources/{item}")
def get_library_source(name: str, item: str, who: Viewer, version: Version = "*") -> LibrarySource:
    """The ST text of an item: libraries are open."""
    for source in _load(name, version).sources:
        if (source.name or "").upper() == item.upper():
            return LibrarySource(uri=source.uri, text=source.text)
    raise not_found(f"item of library {name}", item)


@router.get("/libraries/{name}/{version}/projects")
def list_library_uses(name: str, version: str, who: Viewer, store: StoreDep) -> list[LibraryUse]:
    """The projects that refer to a version of a library, or to its newest version when it is that."""
    wanted = _load(name, version)
    newest = _load(wanted.name).version == wanted.version
    return [
        LibraryUse(project_id=info.id, project_name=info.name, version=reference.version)
        for info, reference in store.library_references()
        if reference.name.upper() == wanted.name.upper()
        and (reference.version == wanted.version or (newest and reference.version == "*"))
    ]


@router.get(
    "/libraries/{name}/{version}/file",
    response_class=Response,
    responses={200: {"content": {"application/zip": {"schema": {"type": "string", "format": "binary"}}}}},
)
def get_library_file(name: str, version: str, who: Viewer) -> Response:
    """A library as a file, to be installed elsewhere."""
    found = _load(name, version)
    facts, texts = archive.read(repository.find(found.name, found.version).folder)
    filename = f"{found.name} {found.version}{archive.SUFFIX}"
    return download(archive.pack(facts, texts), filename, "application/zip")


@router.post("/libraries", status_code=201, max_body_size=archive.MAX_BYTES)
def install_library(
    act: Annotated[ActRecord, audited("library-installed", Role.ENGINEER)],
    file: UploadFile,
    services: ServicesDep,
) -> LibrarySummary:
    """Install a library file; the same version of a library is replaced."""
    try:
        facts, texts = archive.unpack(file.file.read())
        act.begin(Act("library-installed", f"{facts['name']} {facts['version']}"))
        found = archive.install(facts, texts)
    except LibraryFileError as error:
        raise Problem(422, "library-file", f"{error}.") from None
    return _installed(services, found.name, found.version)


@router.delete("/libraries/{name}/{version}", status_code=204)
def remove_library(
    act: Annotated[ActRecord, audited("library-removed", Role.ENGINEER)],
    name: str,
    version: str,
    services: ServicesDep,
) -> None:
    """Uninstall one version of a library; those of the product stay."""
    library = _load(name, version)
    act.begin(Act("library-removed", f"{library.name} {library.version}"))
    try:
        archive.remove(library.name, library.version)
    except LibraryFileError as error:
        raise Problem(409, "library-stays", f"{error}.") from None
    services.analysis.libraries_changed()


@router.post("/projects/{project_id}/library", status_code=201)
async def save_as_library(
    act: Annotated[ActRecord, audited("library-installed", Role.ENGINEER)],
    project_id: str,
    body: NewLibrary,
    store: StoreDep,
    services: ServicesDep,
    commissioning: CommissioningDep,
) -> LibrarySummary:
    """Make a library of a project, everything but its programs, and install it.

    A project with errors is refused: the problem `library-errors` has them in `diagnostics`.
    """
    project = await run_in_threadpool(store.load, project_id)
    try:
        texts = library_texts(project)
        facts = archive.manifest(
            body.name or project.name,
            body.version,
            namespace=body.namespace,
            company=body.company,
            description=body.description or project.description,
            requires=requirements(library_requirements(project)),
            qualified_only=body.qualified_only,
        )
        report = await commissioning.builder.check(Application.library(project_id, project))
        if not report.ok:
            raise _with_errors(report)
        subject = f"{facts['name']} {facts['version']}"
        await act.begin_async(Act("library-installed", subject, project_id=project_id))
        found = await run_in_threadpool(archive.install, facts, texts)
    except (ProjectError, LibraryFileError) as error:
        raise Problem(422, "no-library", f"{error}.") from None
    return await run_in_threadpool(_installed, services, found.name, found.version)


def _with_errors(report: BuildReport) -> Problem:
    errors = [diagnostic for diagnostic in report.diagnostics if diagnostic.severity is Severity.ERROR]
    return Problem(
        422,
        "library-errors",
        f"The project has {len(errors)} error(s), so no library was made of it.",
        diagnostics=[diagnostic.model_dump(mode="json") for diagnostic in report.diagnostics],
    )


def _installed(services: Services, name: str, version: str) -> LibrarySummary:
    services.analysis.libraries_changed()
    return LibrarySummary.of(libraries.load(name, version))
