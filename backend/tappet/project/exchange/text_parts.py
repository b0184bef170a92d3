"""Cutting texts: the types of a block, parts without the blank lines around them."""

from __future__ import annotations

from collections.abc import Iterator

from tappet.iec.sections import commented_line_end
from tappet.iec.tokens import COMMENT, NAME, Word


def type_parts(text: str, scan: list[Word]) -> Iterator[tuple[str, int, int]]:
    """Name, start and end of each type of a block."""
    i = 0
    while i < len(scan):
        if not NAME.fullmatch(scan[i].text):
            i += 1
            continue
        start = scan[i]
        depth, structures = 0, 0
        i += 1
        end = scan[i - 1].end
        while i < len(scan):
            symbol = scan[i].text
            end = scan[i].end
            depth += (symbol in "([") - (symbol in ")]") if len(symbol) == 1 else 0
            structures += symbol in ("STRUCT", "UNION")
            structures -= symbol in ("END_STRUCT", "END_UNION")
            closes = symbol == ";" or symbol in ("END_STRUCT", "END_UNION")
            i += 1
            if closes and depth <= 0 and structures <= 0:
                if symbol != ";" and i < len(scan) and scan[i].text == ";":
                    end = scan[i].end
                    i += 1
                break
        yield text[start.start : start.end], start.start, commented_line_end(text, end, (COMMENT,))


def trimmed(text: str) -> str:
    """A part without the blank lines around it and the blanks behind it."""
    lines = text.rstrip().split("\n")
    first = 0
    while first < len(lines) - 1 and not lines[first].strip():
        first += 1
    return "\n".join(lines[first:])
