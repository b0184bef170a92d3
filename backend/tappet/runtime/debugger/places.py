"""Between places in editors and lines of compiled texts, by the source maps of the package."""

from __future__ import annotations

from collections.abc import Mapping

from tappet.codegen.debug_code import DebugFunction, StatementSite
from tappet.iec.places import Position, SourceMap, Span
from tappet.runtime.debugger.shapes import CodeSpot, Spot

_LONGEST_LINE = 1 << 20


def code_spot(maps: Mapping[str, SourceMap], function: DebugFunction, site: StatementSite) -> CodeSpot:
    """Where a statement stands."""
    shown = maps.get(function.uri.upper())
    if shown is None:
        return CodeSpot(function.name, function.uri, site.line, site.end_line)
    place = shown.place(Span(site.line - 1, 0, site.end_line - 1, _LONGEST_LINE))
    return CodeSpot(
        function.name,
        function.uri,
        place.span.line + 1,
        place.span.end_line + 1,
        place.object_id,
        place.part or None,
        place.element,
    )


def line_of(maps: Mapping[str, SourceMap], spot: Spot) -> tuple[str, int] | str:
    """Uri and line, from 1, of the text that shows a place; the reason when there is none."""
    document = f"{spot.object_id}/{spot.part}" if spot.part else spot.object_id
    for uri, shown in maps.items():
        for segment in shown.segments:
            if segment.document != document:
                continue
            if spot.element is not None:
                first = dict(segment.elements).get(spot.element)
                return "there is no such element" if first is None else (uri, segment.line + first + 1)
            if spot.line is None:
                return "the place names neither a line nor an element"
            position = shown.position(document, Position(spot.line - 1, 0))
            if position is not None:
                return uri, position.line + 1
    if spot.line is not None:
        return spot.object_id, spot.line  # a text without project
    return "the object is no part of the loaded application"
