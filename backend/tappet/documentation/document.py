"""What a documentation consists of, whatever it is written as."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

Style = Literal["code", "keyword", "type", "comment", "string", "number", "pragma"]


@dataclass(frozen=True, slots=True)
class Run:
    """A piece of a line in one colour."""

    style: Style
    text: str


@dataclass(frozen=True, slots=True)
class Listing:
    """A text with line numbers."""

    title: str
    lines: tuple[tuple[Run, ...], ...]


@dataclass(frozen=True, slots=True)
class Table:
    """Rows below heads."""

    title: str
    heads: tuple[str, ...]
    rows: tuple[tuple[str, ...], ...]


@dataclass(frozen=True, slots=True)
class Note:
    """A sentence about what is not printed."""

    text: str


@dataclass(frozen=True, slots=True)
class Section:
    """An object, or a list of the whole project."""

    level: int
    """1 for the roots of the tree."""
    title: str
    about: str
    """What it is: `function block`."""
    blocks: tuple[Listing | Table | Note, ...]


@dataclass(frozen=True, slots=True)
class Document:
    """Title page, contents and sections."""

    title: str
    description: str
    facts: tuple[tuple[str, str], ...]
    """Lines of the title page."""
    language: Literal["en", "zh"]
    paper: Literal["a4", "us-letter"]
    footer: str
    contents: str
    """Title of the table of contents; empty: there is none."""
    page: str
    """`Page {page} of {pages}`."""
    sections: tuple[Section, ...]


def printable(text: str) -> str:
    """A text as it is printed: characters that nothing can print are shown as U+FFFD, tabs as blanks."""
    if text.isascii() and text.isprintable():
        return text
    expanded = text.expandtabs(4)
    return "".join(c if c.isprintable() or c in "\u00a0\u3000" else "\ufffd" for c in expanded)
