"""IEC texts to pieces by one expression: words, literals, addresses, signs, comments and pragmas.

Contract: any text is read; pieces do not overlap, and only blanks and line ends stand between them.
Everything that reads IEC texts goes through `TOKEN`: the lexer of the compiler, which makes keywords and
messages of the pieces, and what must understand texts that do not compile. The editors in the browser
have the same expression (`iec.typescript`).
Cost: linear in the length of the text.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import Final, NamedTuple

from tappet.iec import trivia as patterns
from tappet.iec.literals import (
    BASED_OR_REAL,
    DATE_OR_TIME,
    QUOTED,
    TYPED,
    quoted_is_closed,
    quoted_over_lines,
)
from tappet.iec.trivia import block_comment_end, unnested

IDENTIFIER: Final = r"[^\W\d]\w*+"
ADDRESS_OR_PERCENT: Final = r"%[A-Za-z]*+(?:\*|\d++(?:\.\d++)*+)?+"
LINE_END: Final = r"\r?\n|\r"

PARTS: Final = (
    IDENTIFIER + r"(?![\w#])",
    r"[;,)\[\]^+&-]",
    ":=",
    r"\?=",
    patterns.BLOCK_COMMENT,
    r"\(\*?+",
    LINE_END,
    BASED_OR_REAL,
    r"\.\.?+",
    ":",
    patterns.LINE_COMMENT,
    patterns.C_COMMENT,
    "/",
    QUOTED,
    "=>|=|<=|<>|<|>=|>",
    r"\*\*?+",
    patterns.PRAGMA,
    DATE_OR_TIME,
    TYPED,
    ADDRESS_OR_PERCENT,
    r"\S",
)
"""What a piece can be, frequent ones first; the first that fits counts, and the last takes any character."""
BLANKS: Final = r"[^\S\r\n]*+"
TOKEN: Final = re.compile(f"{BLANKS}({'|'.join(PARTS)})")
"""Blanks, and a piece as group 1. Behind `(*` a comment may go on: `extent`."""
NAME: Final = re.compile(IDENTIFIER)
"""A word that can be a name."""

NOT_CODE: Final = "|".join(
    [QUOTED, patterns.LINE_COMMENT, patterns.C_COMMENT, r"\(\*", f"(?:{patterns.PRAGMA})"]
)
"""What holds text that is no code; it can be searched for: no other piece has its first characters."""
_NOT_CODE = re.compile(NOT_CODE)

Kind = str
WORD: Final = "word"
NUMBER: Final = "number"
"""Numbers and literals with a prefix: `12`, `16#FF`, `T#1s`, `STRING#'a'`, `Colour#Red`."""
STRING: Final = "string"
ADDRESS: Final = "address"
SIGN: Final = "sign"
COMMENT: Final = "comment"
PRAGMA: Final = "pragma"
NEWLINE: Final = "newline"
TRIVIA: Final = frozenset([COMMENT, PRAGMA])

_QUOTES = frozenset("'\"")
_DIGITS = frozenset("0123456789")


class Piece(NamedTuple):
    """A piece of a text: what it is, its characters, and its offsets."""

    kind: Kind
    text: str
    start: int
    end: int


class Word(NamedTuple):
    """A piece that counts: a word in upper case, a sign or a literal; with its offsets."""

    text: str
    start: int
    end: int


def kind_of(piece: str) -> Kind:
    """What a match of `TOKEN` is."""
    first = piece[0]
    if first == "_" or first.isalnum():
        return NUMBER if "#" in piece or first in _DIGITS or first.isdecimal() else WORD
    if first in _QUOTES:
        return STRING
    if first == "{":
        return PRAGMA
    if first in "\r\n":
        return NEWLINE
    if first == "%" and len(piece) > 1:
        return ADDRESS
    return COMMENT if piece[:2] in ("(*", "//", "/*") else SIGN


def extent(text: str, piece: str, start: int, *, nested: bool = True) -> int:
    """Where a match of `TOKEN` really ends: comments nest, and a string may go on in the next line.

    `nested` is False for dialects whose comments end at the first `*)`.
    """
    if piece == "(*":
        end = block_comment_end(text, start) if nested else text.find("*)", start + 2) + 2
        return len(text) if end is None or end < start + 2 else end
    if piece[0] in _QUOTES and not quoted_is_closed(piece):
        return start + (len(quoted_over_lines(text, start)) or len(piece))
    return start + len(piece)


def pieces(text: str, start: int = 0, *, nested: bool = True) -> Iterator[Piece]:
    """Everything in a text from offset `start`, without blanks and line ends; `nested` as in `extent`."""
    known: dict[str, str] = {"\n": NEWLINE}
    position = start
    size = len(text)
    if text[-1:].isspace():  # so that blanks at the end belong to a match
        text += " \n" if text.endswith("\r") else "\n"
    while True:
        for match in TOKEN.finditer(text, position):
            piece = match[1]
            kind = known.get(piece)
            if kind is None:
                kind = kind_of(piece)
                if piece == "(*" or (kind is STRING and not quoted_is_closed(piece)):
                    begin = match.start(1)
                    position = min(extent(text, piece, begin, nested=nested), size)
                    yield Piece(kind, text[begin:position], begin, position)
                    break
                if match.end() > size:  # an open comment, or the line end that was added
                    if kind is not NEWLINE:
                        yield Piece(kind, text[match.start(1) : size], match.start(1), size)
                    return
                known[piece] = kind
            if kind is not NEWLINE:
                yield Piece(kind, piece, match.start(1), match.end())
        else:
            return


def words(text: str, start: int = 0) -> Iterator[Word]:
    """The words, signs and literals of a text from offset `start`."""
    for kind, piece, begin, end in pieces(text, start):
        if kind is WORD:
            yield Word(piece.upper(), begin, end)
        elif kind not in TRIVIA:
            yield Word(piece, begin, end)


def code_of(text: str) -> str:
    """A text with a blank for each comment and string; pragmas stay."""
    kept: list[str] = []
    position = 0
    while (match := _NOT_CODE.search(text, position)) is not None:
        begin = match.start()
        end = extent(text, match[0], begin)
        kept.append(text[position : end if text[begin] == "{" else begin])
        position = end
    return " ".join([*kept, text[position:]])


def blanked(text: str, *kinds: Kind) -> str:
    """A text with blanks for pieces of these kinds; lines and offsets stay."""
    kept: list[str] = []
    position = 0
    for kind, piece, start, end in pieces(text):
        if kind in kinds:
            kept += [text[position:start], *(char if char == "\n" else " " for char in piece)]
            position = end
    return "".join([*kept, text[position:]])


def unnested_comments(text: str) -> str:
    """A text of a dialect whose comments do not nest, with comments that begin no other inside."""
    kept: list[str] = []
    position = 0
    for kind, piece, start, end in pieces(text, nested=False):
        if kind is COMMENT:
            kept += [text[position:start], unnested(piece)]
            position = end
    return "".join([*kept, text[position:]])


def trivia(text: str, start: int, end: int) -> Iterator[Word]:
    """The comments and pragmas between two offsets, the first of which is no middle of one."""
    for kind, piece, begin, stop in pieces(text, start):
        if begin >= end:
            return
        if kind in TRIVIA:
            yield Word(piece, begin, stop)
