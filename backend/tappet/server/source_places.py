"""Where the lines of a downloaded application come from: kept with its package, for call stacks."""

from __future__ import annotations

import json
from dataclasses import dataclass
from typing import Any

from tappet.project.sources import Segment, SourceText


@dataclass(frozen=True, slots=True)
class EditorPlace:
    """A line in an editor; `line` counts from 1."""

    object_id: str
    object_path: str
    part: str
    line: int


@dataclass(frozen=True, slots=True)
class SourcePlaces:
    """The texts of an application without their words."""

    project_id: str
    segments: dict[str, tuple[Segment, ...]]
    """By upper-case uri."""
    paths: dict[str, str]
    """Path in the tree by object id."""

    @classmethod
    def of(cls, project_id: str, sources: tuple[SourceText, ...], paths: dict[str, str]) -> SourcePlaces:
        """An object of the application hides one of the POUs view with the same name."""
        ordered = sorted(sources, key=lambda source: source.scope == "application")
        return cls(project_id, {source.uri.upper(): source.segments for source in ordered}, paths)

    def locate(self, uri: str, line: int) -> EditorPlace | None:
        """The editor's place of a line (from 1) of a text; None for library texts and unknown lines."""
        segments = self.segments.get(uri.upper())
        if not segments or line < 1:
            return None
        found = segments[0]
        for segment in segments:
            if segment.line > line - 1:
                break
            found = segment
        within = max(0, line - 1 - found.line) + found.part_line
        return EditorPlace(found.object_id, self.paths.get(found.object_id, ""), found.part, within + 1)

    def to_json(self) -> bytes:
        """For the file beside the package."""
        rows = {
            uri: [[s.line, s.object_id, s.part, s.part_line] for s in segments]
            for uri, segments in self.segments.items()
        }
        content = {"project_id": self.project_id, "segments": rows, "paths": self.paths}
        return json.dumps(content, sort_keys=True).encode()

    @classmethod
    def from_json(cls, data: bytes) -> SourcePlaces:
        """Inverse of `to_json`; raises ValueError for anything else."""
        try:
            content: dict[str, Any] = json.loads(data)
            segments = {
                str(uri): tuple(Segment(int(a), str(b), c, int(d)) for a, b, c, d in rows)
                for uri, rows in content["segments"].items()
            }
            return cls(str(content["project_id"]), segments, dict(content["paths"]))
        except (KeyError, TypeError, AttributeError) as error:
            raise ValueError(f"no table of source places: {error!r}") from error


def shown_line(places: SourcePlaces | None, uri: str, line: int) -> int:
    """A line of a compiled text as its editor counts it; as it is where the text is not of the project."""
    found = places.locate(uri, line) if places is not None else None
    return line if found is None else found.line
