"""Documents of an editor and the texts the compiler reads: which lines show which.

An object of a project is one text for the compiler but two documents in the editor, its declaration and its
implementation; the compiler's own lines (`END_PROGRAM`) are in none. A plain .st file is one document.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import NamedTuple, Protocol

from tappet.lang.coding_settings import NO_RULES, StaticAnalysis
from tappet.lang.source import Source, Span


class Position(NamedTuple):
    """A place between two characters; line and column 0-based, in code points."""

    line: int
    column: int


@dataclass(frozen=True, slots=True)
class Place:
    """A range of a document."""

    document: str
    span: Span


@dataclass(frozen=True, slots=True)
class Segment:
    """From `line` of a text on (0-based), the lines are those of `document` from its line `first` on."""

    line: int
    document: str
    first: int = 0
    count: int | None = None
    """Number of lines; None for all that follow."""


@dataclass(frozen=True, slots=True)
class Text:
    """A text for the compiler and the documents it is made of."""

    source: Source
    segments: tuple[Segment, ...]
    read_only: bool = False
    """Of a library: it can be looked at, not renamed in."""

    def segment_at(self, line: int) -> Segment:
        """The segment that shows a line, or the nearest one before it."""
        found = self.segments[0]
        for segment in self.segments:
            if segment.line > line:
                break
            found = segment
        return found

    def place(self, span: Span) -> Place:
        """Where a range of the text stands in its document; a range over several documents is cut."""
        segment = self.segment_at(span.line)
        shift = segment.first - segment.line
        last = None if segment.count is None else segment.first + segment.count - 1
        line, column = span.line + shift, span.column
        end_line, end_column = span.end_line + shift, span.end_column
        if last is not None and line > last:  # a line of the compiler itself: the end before it
            return Place(segment.document, Span(last, _FAR, last, _FAR))
        if last is not None and end_line > last:
            end_line, end_column = last, _FAR
        return Place(segment.document, Span(line, column, end_line, end_column))

    def position(self, document: str, position: Position) -> Position | None:
        """Where a position of a document stands in the text; None when it does not show the document."""
        for segment in self.segments:
            if segment.document == document:
                return Position(position.line - segment.first + segment.line, position.column)
        return None

    def lines_of(self, document: str) -> tuple[int, int] | None:
        """First and behind-the-last line of the text that show a document."""
        for index, segment in enumerate(self.segments):
            if segment.document == document:
                if segment.count is not None:
                    return segment.line, segment.line + segment.count
                following = self.segments[index + 1].line if index + 1 < len(self.segments) else None
                return segment.line, self.source.text.count("\n") + 1 if following is None else following
        return None


_FAR = 1_000_000
"""A column behind every line; editors cut it to the end of the line."""


@dataclass(frozen=True, slots=True)
class Program:
    """What is compiled together: an application with its libraries, or the files of a folder."""

    name: str
    texts: Sequence[Text]
    tasks: Sequence[str] = ()
    defines: Mapping[str, str] = field(default_factory=dict)
    static: StaticAnalysis = NO_RULES
    """The optional coding rules that are switched on."""


class Programs(Protocol):
    """Where a workspace gets its programs from."""

    def __call__(self, unsaved: Mapping[str, str]) -> Sequence[Program]:
        """All programs, with the texts of `unsaved` in place of the stored ones, by document."""


def whole_file(uri: str, source: Source, read_only: bool = False) -> Text:
    """A text that one document shows as a whole."""
    return Text(source, (Segment(0, uri),), read_only)


LIBRARY_SCHEME = "tappet-library:/"


def library_text(source: Source) -> Text:
    """The text of a library, in a document of its own scheme that can only be read."""
    return whole_file(f"{LIBRARY_SCHEME}{source.uri}", source, read_only=True)
