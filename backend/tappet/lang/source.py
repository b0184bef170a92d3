"""Source texts and places in them."""

from __future__ import annotations

import re
from dataclasses import dataclass, field
from enum import StrEnum

from tappet.iec.places import NOWHERE, BodyText, SourceMap, Span


class Scope(StrEnum):
    """Where an object lives; an inner scope hides an outer one (spec CON-06..CON-09)."""

    APPLICATION = "application"
    POUS = "pous"
    LIBRARY = "library"


@dataclass(frozen=True, slots=True)
class GivenValue:
    """The value that a library reference gives to a parameter of the list that a text declares."""

    name: str
    """The parameter."""
    value: str
    """An expression as written."""
    place: str
    """Where it stands, for messages: the path of the library manager."""


@dataclass(frozen=True, slots=True)
class Source:
    """One text the compiler reads: a whole POU, DUT, GVL, or a method, property or action of a POU.

    `uri` names the text in diagnostics: a file path, or an object path such as `FB_Motor.Start`.
    """

    uri: str
    text: str
    scope: Scope = Scope.APPLICATION
    owner: str | None = None
    """Name of the POU a METHOD / PROPERTY / ACTION text belongs to, None for whole objects."""
    name: str | None = None
    """Name of the object where the text carries none: a GVL, or an action given as bare body."""
    library: str | None = None
    """Name of the library the text comes from (scope LIBRARY)."""
    namespace: str | None = None
    """Namespace under which the library is referenced; its objects are visible with and without it."""
    body_line: int = 0
    """0-based line where the implementation begins, when declaration and body are edited apart; 0 = one
    text."""
    bodies: tuple[BodyText, ...] = ()
    """Where bodies do not tell their language by their first words, or are drawn, in order of the lines."""
    uses: tuple[tuple[str, str], ...] = ()
    """Libraries that the text's library needs: the name it gives to one, and the namespace that is here."""
    private: bool = False
    """Only libraries that use this one see it: the application has another version of it."""
    given: tuple[GivenValue, ...] = ()
    """Values that the reference to the library gives to parameters of this list, in place of its own."""
    map: SourceMap | None = field(default=None, compare=False)
    """Which parts of which objects the lines show; None for a text that is a document of its own."""


_LINE_END = re.compile(r"\r\n|\n|\r")


def split_lines(text: str) -> list[str]:
    """The lines of a text as spans count them: without the rarer line ends that `str.splitlines` knows."""
    return _LINE_END.split(text)


def text_at(source: Source, span: Span) -> str:
    """The text of a span on one line, with single spaces."""
    lines = split_lines(source.text)[span.line : span.end_line + 1]
    if not lines:
        return ""
    lines[-1] = lines[-1][: span.end_column]
    lines[0] = lines[0][span.column :]
    return " ".join(" ".join(lines).split())


__all__ = [
    "NOWHERE",
    "BodyText",
    "GivenValue",
    "Scope",
    "Source",
    "SourceMap",
    "Span",
    "split_lines",
    "text_at",
]
