"""Where the lines of a downloaded application come from: kept with its package, for call stacks."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import msgspec

from tappet.iec.places import Place, SourceMap, Span
from tappet.iec.source import Scope, Source


@dataclass(frozen=True, slots=True)
class EditorPlace:
    """A line in an editor, or the element there; `line` counts from 1."""

    object_id: str
    object_path: str
    part: str
    line: int
    element: str | None = None


class SourcePlaces(msgspec.Struct, frozen=True):
    """The maps of the texts of an application, and the names of its objects."""

    project_id: str
    maps: dict[str, SourceMap]
    """By upper-case uri."""
    paths: dict[str, str]
    """Path in the tree by object id."""

    @classmethod
    def of(cls, project_id: str, sources: tuple[Source, ...], paths: Mapping[str, str]) -> SourcePlaces:
        """An object of the application hides one of the POUs view with the same name."""
        ordered = sorted(sources, key=lambda source: source.scope is Scope.APPLICATION)
        return cls(project_id, {s.uri.upper(): s.map for s in ordered if s.map is not None}, dict(paths))

    def place(self, uri: str, span: Span) -> Place | None:
        """Where a range of a text comes from; None for library texts."""
        found = self.maps.get(uri.upper())
        return None if found is None else found.place(span)

    def locate(self, uri: str, line: int) -> EditorPlace | None:
        """The editor's place of a line (from 1) of a text; None for library texts and unknown lines."""
        found = self.place(uri, Span(line - 1, 0, line - 1, 0)) if line >= 1 else None
        if found is None:
            return None
        path = self.paths.get(found.object_id, "")
        return EditorPlace(found.object_id, path, found.part, found.span.line + 1, found.element)

    def to_json(self) -> bytes:
        """For the file beside the package."""
        return msgspec.json.encode(self, order="deterministic")

    @classmethod
    def from_json(cls, data: bytes) -> SourcePlaces:
        """Inverse of `to_json`; raises ValueError for anything else."""
        try:
            return msgspec.json.decode(data, type=cls)
        except msgspec.MsgspecError as error:
            raise ValueError(f"no table of source places: {error}") from error


def shown_line(places: SourcePlaces | None, uri: str, line: int) -> int:
    """A line of a compiled text as its editor counts it; as it is where the text is not of the project."""
    found = places.locate(uri, line) if places is not None else None
    return line if found is None else found.line
