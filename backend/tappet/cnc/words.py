"""The model of a CNC program: lines of words, and what is wrong with them."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal, NamedTuple

Severity = Literal["error", "warning"]


class Word(NamedTuple):
    """An address and its value. Spec GC-03."""

    address: str
    """`G`, `X`, `FF`, `FZ` ... in capital letters."""
    value: float
    """0 where the word has a variable."""
    variable: str | None = None
    """Name between the $ signs, as written."""
    column: int = 0
    """Of the address in its line, from 0."""
    length: int = 0
    """Characters, with the value."""


@dataclass(frozen=True, slots=True)
class Problem:
    """What is wrong at a place of the text, and what would be right."""

    line: int
    """From 0."""
    column: int
    """From 0."""
    length: int
    message: str
    severity: Severity = "error"


@dataclass(frozen=True, slots=True)
class Line:
    """A line of a program. Spec GC-02."""

    place: int
    """In the text, from 0."""
    suppressed: bool = False
    """It begins with `/`: step suppression leaves it out."""
    number: int | None = None
    """Behind N."""
    words: tuple[Word, ...] = ()
    """Without N."""
    comments: tuple[str, ...] = ()
    problems: tuple[Problem, ...] = ()
    header: str | None = None
    """Of the header line `% name`: the name of the program. Spec GC-01."""

    @property
    def is_empty(self) -> bool:
        """Nothing but comments, or the header line."""
        return not (self.words or self.suppressed or self.number is not None)


@dataclass(frozen=True, slots=True)
class Program:
    """A program as it was read."""

    lines: tuple[Line, ...] = ()
    """Empty ones too: the line at place n of the text is `lines[n]`."""

    @property
    def name(self) -> str:
        """Of the header line; empty where there is none."""
        return next((line.header for line in self.lines if line.header is not None), "")

    @property
    def problems(self) -> tuple[Problem, ...]:
        """Of all lines, in the order of the text."""
        return tuple(problem for line in self.lines for problem in line.problems)
