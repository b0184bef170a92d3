"""Project folders and archives of our own, as drafts: parts of another project into this one."""

from __future__ import annotations

from collections.abc import Mapping

from tappet.project.errors import FolderFormatError
from tappet.project.exchange.drafts import Batch, Draft
from tappet.project.exchange.report import ExchangeError
from tappet.project.folder.codec import decode
from tappet.project.model import Project, ProjectObject
from tappet.project.project_file import PROJECT_FILE


def project_tops(files: Mapping[str, bytes]) -> list[str]:
    """Paths of the folders among the files that hold a project, each with its `/`; outer ones first."""
    found: list[str] = []
    for path in sorted(files, key=lambda path: (path.count("/"), path)):
        if path.rpartition("/")[2] == PROJECT_FILE and not any(path.startswith(top) for top in found):
            found.append(path.removesuffix(PROJECT_FILE))
    return found


def project_in(top: str, files: Mapping[str, bytes]) -> Project:
    """The project of a folder. Raises ExchangeError."""
    inside = {path.removeprefix(top): content for path, content in files.items() if path.startswith(top)}
    try:
        return decode(inside).project
    except FolderFormatError as error:
        path, _, text = str(error).partition(": ")
        raise ExchangeError(f"{top}{path}", text or path) from error


def read_folder(top: str, files: Mapping[str, bytes], batch: Batch) -> None:
    """Take the objects of a project folder in. Raises ExchangeError."""
    project = project_in(top, files)
    batch.name = batch.name or project.name
    batch.description = batch.description or project.description
    batch.complete = True
    source = f"{top}{PROJECT_FILE}"
    for item in project.children(None):
        tops = batch.devices if item.kind == "device" else batch.pous.children
        tops.append(_draft(project, item, source))


def _draft(project: Project, item: ProjectObject, source: str) -> Draft:
    data = item.data.model_dump(mode="json")
    children = [_draft(project, child, source) for child in project.children(item.id)]
    return Draft(item.kind, item.name, data, source, None, children, item.id)
