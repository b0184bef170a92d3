"""Uploaded files read as projects: all formats with their tables, loaded with the first import."""

from __future__ import annotations

from collections.abc import Callable, Collection
from dataclasses import replace

from fastapi import UploadFile

from tappet.project.errors import FolderFormatError
from tappet.project.exchange.existing import Decisions, Histories
from tappet.project.exchange.importing import ARCHIVES, TAKEN, Imported, importable
from tappet.project.folder.archive import DEFAULT_LIMITS, unpack
from tappet.project.model import Project
from tappet.server.exchange.import_order import ImportOrder
from tappet.server.exchange.import_process import run_import

ENDINGS = (*TAKEN, *ARCHIVES)
"""Of the names of files and archives that an import takes, in lower case."""


class Upload:
    """Files of one request. Raises FolderFormatError for none that can be read, or too much."""

    def __init__(self, files: list[UploadFile]) -> None:
        self._files = _files_of(files)

    def order(
        self,
        project: Project | None = None,
        *,
        place: str | None = None,
        name: str = "",
        chosen: Collection[str] | None = None,
        decisions: Decisions | None = None,
    ) -> ImportOrder:
        """To read the files into a project, without one into a new one of this name.

        `place` is the id of an application or folder, or `pous`.
        """
        return ImportOrder(self._files, project, place, name, chosen, decisions or Decisions())

    def as_project(self, name: str) -> Imported:
        """The files as a project to compare with; one of our own as it is. Blocks."""
        return run_import(ImportOrder(self._files, None, None, name, None, as_project=True))


def imported(order: ImportOrder, pasts: Callable[[Collection[str]], Histories] | None = None) -> Imported:
    """What an order brings; blocks. The report names libraries that are missing.

    `pasts` tells the states of objects that both sides have changed; the files are then read again.
    """
    done = run_import(order)
    if pasts is not None and done.unknown_pasts:
        histories = {**{key: [] for key in done.unknown_pasts}, **pasts(done.unknown_pasts)}
        done = run_import(replace(order, histories=histories))
    return done


def _files_of(files: list[UploadFile]) -> dict[str, bytes]:
    """Uploaded files by path, archives unpacked; paths stay below a folder of their own."""
    found: dict[str, bytes] = {}
    for file in files:
        parts = (file.filename or "file").replace("\\", "/").split("/")
        path = "/".join(part for part in parts if part not in ("", ".", "..") and ":" not in part) or "file"
        if path.lower().endswith(ARCHIVES):
            found |= importable(unpack(file.file))
        else:
            found[path] = file.file.read()
    if not found:
        raise FolderFormatError("archive", "holds no file that can be imported")
    if len(found) > DEFAULT_LIMITS.files or sum(map(len, found.values())) > DEFAULT_LIMITS.total_bytes:
        raise FolderFormatError("files", "are too many or too large for one import")
    return found
