"""Texts at the head and foot of printed pages: plain text with placeholders in braces.

`{{` is a brace; a placeholder is one of `PLACEHOLDERS`.
"""

from __future__ import annotations

import re
from typing import Annotated, NamedTuple

from pydantic import AfterValidator

from tappet.project.data import Line

PLACEHOLDERS = (
    "project",
    "object",
    "path",
    "author",
    "company",
    "revision",
    "date",
    "time",
    "page",
    "pages",
    "page_of_pages",
)
"""`object` and `path` are those of the first object that begins on the page, else of the one that goes on;
`page_of_pages` is `Page 2 of 7` in the language of the document."""
MOST_CHARACTERS = 200

_PIECE = re.compile(r"\{\{|\{(?P<name>[^{}]*)\}|(?P<open>\{)|[^{]+")


class Piece(NamedTuple):
    """A part of such a text: plain, or a placeholder."""

    placeholder: str
    """Empty: `text` stands for itself."""
    text: str = ""


def pieces_of(text: str) -> tuple[Piece, ...]:
    """The parts. Raises ValueError, which names what would be right."""
    found: list[Piece] = []
    for match in _PIECE.finditer(text):
        name = match["name"]
        if match["open"]:
            raise ValueError(
                f"'{text[match.start() :]}' is not closed; a brace itself is written twice, {_known()}"
            )
        if name is None:
            plain = "{" if match[0] == "{{" else match[0]
            if found and not found[-1].placeholder:
                found[-1] = Piece("", found[-1].text + plain)
            else:
                found.append(Piece("", plain))
        elif name in PLACEHOLDERS:
            found.append(Piece(name))
        else:
            raise ValueError(f"'{match[0]}' is no placeholder; {_known()}; a brace itself is written twice")
    return tuple(found)


def _known() -> str:
    return "placeholders are " + ", ".join(f"{{{name}}}" for name in PLACEHOLDERS)


def _one_line(text: str) -> str:
    if len(text) > MOST_CHARACTERS:
        raise ValueError(f"a text on pages has at most {MOST_CHARACTERS} characters, not {len(text)}")
    if "\n" in text:
        raise ValueError("a text on pages is one line")
    return text


def _readable(text: str) -> str:
    pieces_of(text)
    return text


PlainLine = Annotated[Line, AfterValidator(_one_line)]
RunningText = Annotated[PlainLine, AfterValidator(_readable)]
