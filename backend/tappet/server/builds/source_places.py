"""Where the lines of an application that was built come from, with the paths of its objects."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from tappet.iec.places import Place, SourceMap, Span
from tappet.iec.source import Source, source_maps


@dataclass(frozen=True, slots=True)
class EditorPlace:
    """A line in an editor, or the element there; `line` counts from 1."""

    object_id: str
    object_path: str
    part: str
    line: int
    element: str | None = None


@dataclass(frozen=True, slots=True)
class SourcePlaces:
    """The maps of the texts of an application, and the names of its objects."""

    maps: dict[str, SourceMap]
    """By upper-case uri."""
    paths: dict[str, str]
    """Path in the tree by object id."""

    @classmethod
    def of(cls, sources: tuple[Source, ...], paths: Mapping[str, str]) -> SourcePlaces:
        """Of an application as it was built."""
        return cls(source_maps(sources), dict(paths))

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
