"""IEC texts as coloured lines."""

from __future__ import annotations

from tappet.documentation.document import Listing, Run, Style, printable
from tappet.iec.tokens import COMMENT, NUMBER, PRAGMA, STRING, WORD, pieces
from tappet.iec.words import ELEMENTARY_TYPES, RESERVED

_STYLES: dict[str, Style] = {COMMENT: "comment", NUMBER: "number", PRAGMA: "pragma", STRING: "string"}


def listing(title: str, text: str) -> Listing:
    """A text of the language; one that does not compile is coloured as far as it is read."""
    lines: list[list[Run]] = [[]]

    def add(style: Style, part: str) -> None:
        first, *rest = part.split("\n")
        if first:
            lines[-1].append(Run(style, printable(first)))
        lines.extend([Run(style, printable(line))] if line else [] for line in rest)

    at = 0
    for kind, piece, begin, end in pieces(text):
        add("code", text[at:begin])
        style = _STYLES.get(kind, "code")
        if kind is WORD:
            upper = piece.upper()
            style = "type" if upper in ELEMENTARY_TYPES else "keyword" if upper in RESERVED else "code"
        add(style, text[begin:end])
        at = end
    add("code", text[at:])
    return Listing(title, tuple(map(tuple, lines)))


def plain_listing(title: str, lines: tuple[str, ...]) -> Listing:
    """Lines that are not coloured."""
    return Listing(title, tuple((Run("code", printable(line)),) if line else () for line in lines))
