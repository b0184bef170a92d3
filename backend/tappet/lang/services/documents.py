"""Documents of an editor and the texts the compiler reads: which lines show which.

An object of a project is one text for the compiler but two documents in the editor, its declaration and its
implementation; the compiler's own lines (`END_PROGRAM`) are in none. A plain .st file is one document.
Positions in a document that is drawn are those of its listing.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Protocol

from tappet.iec.places import Place, Position, Segment, SourceMap, whole_text
from tappet.lang.coding_settings import NO_RULES, StaticAnalysis
from tappet.lang.source import Source, Span


@dataclass(frozen=True, slots=True)
class Text:
    """A text for the compiler and the documents it is made of."""

    source: Source
    map: SourceMap
    """Objects are named by the uris of their documents."""
    read_only: bool = False
    """Of a library: it can be looked at, not renamed in."""

    @property
    def segments(self) -> tuple[Segment, ...]:
        """What the lines show."""
        return self.map.segments

    def place(self, span: Span) -> Place:
        """Where a range of the text stands in its document; a range over several documents is cut."""
        return self.map.place(span)

    def position(self, document: str, position: Position) -> Position | None:
        """Where a position of a document stands in the text; None when it does not show the document."""
        return self.map.position(document, position)

    def lines_of(self, document: str) -> tuple[int, int] | None:
        """First and behind-the-last line of the text that show a document."""
        return self.map.lines_of(document, self.source.text.count("\n") + 1)


@dataclass(frozen=True, slots=True)
class Program:
    """What is compiled together: an application with its libraries, or the files of a folder."""

    name: str
    texts: Sequence[Text]
    tasks: Sequence[str] = ()
    defines: Mapping[str, str] = field(default_factory=dict)
    static: StaticAnalysis = NO_RULES
    """The optional coding rules that are switched on."""
    disabled_warnings: frozenset[str] = frozenset()
    """Codes of warnings that are not reported."""


class Programs(Protocol):
    """Where a workspace gets its programs from."""

    def __call__(self, unsaved: Mapping[str, str]) -> Sequence[Program]:
        """All programs, with the texts of `unsaved` in place of the stored ones, by document."""


def whole_file(uri: str, source: Source, read_only: bool = False) -> Text:
    """A text that one document shows as a whole."""
    return Text(source, whole_text(uri), read_only)


LIBRARY_SCHEME = "tappet-library:/"


def library_text(source: Source) -> Text:
    """The text of a library, in a document of its own scheme that can only be read."""
    return whole_file(f"{LIBRARY_SCHEME}{source.uri}", source, read_only=True)


__all__ = [
    "LIBRARY_SCHEME",
    "Place",
    "Position",
    "Program",
    "Programs",
    "Segment",
    "SourceMap",
    "Text",
    "library_text",
    "whole_file",
]
