"""Source download and upload: archives of projects over the connection to a runtime."""

from __future__ import annotations

from tappet.project.errors import FolderFormatError
from tappet.project.folder import read_zip, write_zip
from tappet.project.kinds.application import ApplicationData
from tappet.project.model import Project
from tappet.runtime.errors import PlcError
from tappet.runtime.source_archive import SourceInfo
from tappet.runtime.source_transfer import SourceError, read_source
from tappet.server.problems import Problem
from tappet.server.runtimes.links import RuntimeLink
from tappet.server.source.shapes import StoredSource


def source_setting(project: Project, application_id: str) -> str:
    """When the application wants its source in the controller."""
    return project.get(application_id).data_as(ApplicationData).source_download


def check_wanted(project: Project, application_id: str) -> None:
    """Raises a 409 problem for a project that never stores its source."""
    if source_setting(project, application_id) == "never":
        raise Problem(
            409,
            "source-never",
            "The project settings say that the source of this application is never stored in a controller.",
        )


async def store_source(link: RuntimeLink, project: Project, stored_by: str, code_id: str) -> StoredSource:
    """Keep the archive of a project, with its further files, in the controller. Raises problems."""
    archive = write_zip(project)
    async with link.client() as client:
        try:
            stored = await client.store_source(
                archive, project=project.name, stored_by=stored_by, code_id=code_id
            )
        except SourceError as error:
            raise Problem(413, "source-too-large", str(error)) from error
    assert stored is not None, "what has just been stored is there"
    return StoredSource(project=stored.project, size=stored.size, current=stored.current)


async def fetch_source(link: RuntimeLink) -> tuple[SourceInfo, bytes]:
    """The archive in the controller. Raises problems: 404 for none, 409 for one that is damaged."""
    async with link.client() as client:
        try:
            return await read_source(client)
        except SourceError as error:
            raise Problem(404, "no-source", f"'{link.name}': {error}.") from error
        except PlcError as error:
            raise Problem(409, "refused", f"'{link.name}': {error}.") from error


def project_of(link: RuntimeLink, archive: bytes) -> Project:
    """The project in an archive. Raises a 422 problem; archives are checked like those that are uploaded."""
    try:
        return read_zip(archive)
    except FolderFormatError as error:
        raise Problem(422, "folder-format", f"The source in '{link.name}' cannot be read: {error}") from error
