"""What a documentation consists of, whatever it is written as."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from tappet.project.picture import Picture
from tappet.project.running_text import Piece

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
    path: str = ""
    """Of an object in the tree."""


@dataclass(frozen=True, slots=True)
class Sheet:
    """A page of paper; all in mm."""

    width: float
    height: float
    margins: tuple[float, float, float, float]
    """Top, right, bottom, left."""


@dataclass(frozen=True, slots=True)
class Logo:
    """A picture on the title page and at the head of the others."""

    picture: Picture
    on_title_page: bool
    in_header: Literal["none", "left", "right"]

    def size_on_title_page(self) -> tuple[float, float]:
        """Width and height in mm."""
        return self._size_within(80, 40)

    def size_in_header(self, margin: float) -> tuple[float, float]:
        """The same where the margin at the top of the page is so wide."""
        return self._size_within(40, min(10, margin * 0.6))

    def _size_within(self, width: float, height: float) -> tuple[float, float]:
        """As far as its shape allows."""
        scale = min(width / self.picture.width, height / self.picture.height)
        return round(self.picture.width * scale, 2), round(self.picture.height * scale, 2)


Running = tuple[tuple[Piece, ...], tuple[Piece, ...], tuple[Piece, ...]]
"""Left, centre and right of a head or foot; placeholders that are left are those whose text differs from page
to page: `object`, `path`, `page`, `pages`."""


@dataclass(frozen=True, slots=True)
class Document:
    """Title page, contents and sections."""

    title: str
    description: str
    facts: tuple[tuple[str, str], ...]
    """Lines of the title page."""
    language: Literal["en", "zh"]
    sheet: Sheet
    title_page: bool
    logo: Logo | None
    header: Running
    footer: Running
    contents: str
    """Title of the table of contents; empty: there is none."""
    sections: tuple[Section, ...]


def printable(text: str) -> str:
    """A text as it is printed: characters that nothing can print are shown as U+FFFD, tabs as blanks."""
    if text.isascii() and text.isprintable():
        return text
    expanded = text.expandtabs(4)
    return "".join(c if c.isprintable() or c in "\u00a0\u3000" else "\ufffd" for c in expanded)
