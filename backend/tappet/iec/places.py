"""Places in projects: the object, part and range of text, or the drawn element, a line comes from.

Contract: the compiler knows texts, lines and columns only. Each text has one `SourceMap`, which says what its
lines show; `SourceMap.place` turns any span of the compiler into a `Place`. Messages, cross references, call
stacks, monitoring and the results of unit tests all go through it, and the map travels with the code package.
A part that is drawn is in the text as its listing (`iec.listing`): there the place names the element, and the
span is one of the listing. Lines and columns are 0-based, in code points; columns end before `end_column`.
Cost: a map has an entry a part and a number an element; a question is one bisection.
Reason: line tables, statement hooks and messages work with lines, whatever the language; only maps know
elements.
"""

from __future__ import annotations

from bisect import bisect_right
from dataclasses import dataclass
from typing import NamedTuple

from msgspec import Struct


class Span(NamedTuple):
    """A half-open range of a source text; lines and columns are 0-based, in UTF-16-free code points.

    A named tuple because the parser makes one per node: a frozen dataclass costs three times as much.
    """

    line: int
    column: int
    end_line: int
    end_column: int

    def to(self, other: Span) -> Span:
        """The span from the start of this one to the end of `other`."""
        return Span(self.line, self.column, other.end_line, other.end_column)


NOWHERE = Span(0, 0, 0, 0)


class Position(NamedTuple):
    """A place between two characters."""

    line: int
    column: int


@dataclass(frozen=True, slots=True)
class Place:
    """A range of a part of an object, or one of its drawn elements."""

    object_id: str
    """As who asks names objects: the id in the project, the uri in the language server."""
    part: str
    """`declaration` or `implementation`; empty where the object is one text."""
    span: Span
    """In the text of the part, or in its listing."""
    element: str | None = None
    """Id of the element in a drawn part."""

    @property
    def document(self) -> str:
        """The text that an editor shows as one."""
        return f"{self.object_id}/{self.part}" if self.part else self.object_id


class Segment(Struct, frozen=True, array_like=True):
    """From `line` of a text on, the lines are those of a part of an object."""

    line: int
    object_id: str
    part: str
    part_line: int = 0
    """Line of the part that stands at `line`."""
    count: int | None = None
    """Number of lines; None for all that follow."""
    width: int = 0
    """Columns of the last line, where `count` says which one that is."""
    elements: tuple[tuple[str, int], ...] = ()
    """Of a drawn part: the elements in order, each with its first line in the listing, from 0."""
    drawn: bool = False
    """Whether the lines are a listing."""
    about: tuple[int, int] | None = None
    """The line does not show the part, it says something about these columns of it: from, to."""

    @property
    def document(self) -> str:
        """The text that an editor shows as one."""
        return f"{self.object_id}/{self.part}" if self.part else self.object_id


class SourceMap(Struct, frozen=True, array_like=True):
    """What the lines of one compiled text show, in order of the lines."""

    segments: tuple[Segment, ...]

    def segment_at(self, line: int) -> Segment:
        """The segment that shows a line, or the nearest one before it, or the first one."""
        segments = self.segments
        if len(segments) < 3:
            return segments[-1] if segments[-1].line <= line else segments[0]
        return segments[max(0, bisect_right(segments, line, key=_line) - 1)]

    def place(self, span: Span) -> Place:
        """Where a range of the text comes from; a range over several parts is cut at the end of the first.

        A line of no part, such as `END_PROGRAM`, is at the end of the part before it.
        """
        found = self.segment_at(span.line)
        line, column = span.line - found.line, span.column
        end_line, end_column = span.end_line - found.line, span.end_column
        if line < 0:
            line, column, end_line, end_column = 0, 0, max(end_line, 0), end_column if end_line >= 0 else 0
        if found.count is not None and end_line >= found.count:
            end_line, end_column = found.count - 1, found.width
            if line >= found.count:
                line, column = end_line, end_column
        shift = found.part_line
        if found.about is not None:
            line = end_line = 0
            column, end_column = found.about
        shown = Span(line + shift, column, end_line + shift, end_column)
        return Place(found.object_id, found.part, shown, _element_at(found, line) if found.drawn else None)

    def position(self, document: str, position: Position) -> Position | None:
        """Where a position of a document stands in the text; None when it does not show the document."""
        for segment in self.segments:
            if segment.document == document and segment.about is None:
                return Position(position.line - segment.part_line + segment.line, position.column)
        return None

    def lines_of(self, document: str, total: int) -> tuple[int, int] | None:
        """First and behind-the-last line that show a document, in a text of `total` lines."""
        for index, segment in enumerate(self.segments):
            if segment.document == document and segment.about is None:
                if segment.count is not None:
                    return segment.line, segment.line + segment.count
                following = self.segments[index + 1].line if index + 1 < len(self.segments) else total
                return segment.line, following
        return None

    def is_drawn(self, document: str) -> bool:
        """Whether a document is drawn: its lines are those of its listing."""
        return any(segment.drawn for segment in self.segments if segment.document == document)

    def shows(self, document: str) -> bool:
        """Whether lines of the text show a document."""
        return any(segment.document == document and segment.about is None for segment in self.segments)


def _element_at(drawn: Segment, line: int) -> str | None:
    """The element that has a line of a listing; None where the body has none."""
    number = bisect_right(drawn.elements, line, key=_first) - 1
    return drawn.elements[number][0] if number >= 0 else None


def _line(segment: Segment) -> int:
    return segment.line


def _first(element: tuple[str, int]) -> int:
    return element[1]


def whole_text(object_id: str) -> SourceMap:
    """The map of a text that is one document from its first line to its last."""
    return SourceMap((Segment(0, object_id, ""),))


class BodyText(Struct, frozen=True, array_like=True):
    """Bodies of a text from a line on, where their language does not show in their first words."""

    line: int
    language: str
    drawn: str | None = None
    """What is stored of a drawn body, whose listing begins at `line`; None for text."""
