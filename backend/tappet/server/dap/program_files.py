"""Places of the compiled application and lines of the client's files, in both directions."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Protocol

from tappet.project.folder.part_files import PartOfFile
from tappet.server.dap.debuggee import Location


@dataclass(frozen=True, slots=True)
class PlaceInCode:
    """A line of a part of an object, or of a text that is a document of its own; from 1."""

    object_id: str
    part: str
    line: int


class Texts(Protocol):
    """Where the client finds the texts of an application."""

    def place(self, path: str, line: int) -> PlaceInCode | None:
        """What a line of a text of the client shows; None for texts of something else."""

    def location(
        self, object_id: str | None, part: str | None, line: int, uri: str | None
    ) -> Location | None:
        """The line at which a place is shown; a text that the client does not have is named by its uri."""


class ProgramFiles(Texts):
    """The files that an application was built of: parts of objects of a project, or plain texts."""

    def __init__(self, parts: Sequence[PartOfFile] = (), texts: Sequence[str] = ()) -> None:
        """`texts`: uris of texts that are files, as they were given to the compiler."""
        self._parts = {(part.object_id, part.part): part for part in parts}
        self._by_path: dict[str, list[PartOfFile]] = {}
        for part in parts:
            self._by_path.setdefault(_key(part.path), []).append(part)
        self._texts = {_key(Path(uri)): uri for uri in texts}

    def place(self, path: str, line: int) -> PlaceInCode | None:
        """What a line of a file shows; None for files of something else."""
        key = _key(Path(path))
        uri = self._texts.get(key)
        if uri is not None:
            return PlaceInCode(uri, "", line)
        parts = self._by_path.get(key, ())
        found = [part for part in parts if part.line <= line - 1 < part.line + part.count]
        if not found and parts:  # the opening, or the end: the nearest part
            found = [min(parts, key=lambda part: abs(part.line - (line - 1)))]
        if not found:
            return None
        inside = min(max(line - 1 - found[0].line, 0), found[0].count - 1)
        return PlaceInCode(found[0].object_id, found[0].part, inside + 1)

    def location(
        self, object_id: str | None, part: str | None, line: int, uri: str | None
    ) -> Location | None:
        """The line of a file at which a place is shown; a text that is no file is named by its uri."""
        found = self._parts.get((object_id or "", part or ""))
        if found is not None:
            return Location(found.path.name, found.line + line, str(found.path))
        for text in (uri, object_id):
            if text and _key(Path(text)) in self._texts:
                return Location(Path(text).name, line, os.path.abspath(text))
        if uri:
            return Location(uri.rpartition("/")[2], line, reference=uri)
        return None


class ObjectDocuments(Texts):
    """The objects of a stored project, `tappet:/PROJECT/OBJECT/PART` as in the language server."""

    def __init__(self, project_id: str, names: Mapping[str, str]) -> None:
        """`names`: the paths of the objects in the project by their ids."""
        self._head = f"tappet:/{project_id}/"
        self._names = names

    def place(self, path: str, line: int) -> PlaceInCode | None:
        """What a line of a document shows; None for documents of another project."""
        steps = path.removeprefix(self._head).split("/")
        if not path.startswith(self._head) or len(steps) != 2 or steps[0] not in self._names:
            return None
        return PlaceInCode(steps[0], steps[1], line)

    def location(
        self, object_id: str | None, part: str | None, line: int, uri: str | None
    ) -> Location | None:
        """The document and line at which a place is shown."""
        name = self._names.get(object_id or "")
        if name is not None:
            document = f"{self._head}{object_id}/{part}"
            return Location(name, line, document, document)
        return Location(uri.rpartition("/")[2], line, reference=uri) if uri else None


def _key(path: Path) -> str:
    """One spelling of a path, whatever links lead to it."""
    return os.path.normcase(os.path.realpath(path))
