"""The variables that a declaration declares, as rows of a table; read from any text, as far as it goes."""

from __future__ import annotations

from typing import NamedTuple

from tappet.iec.tokens import COMMENT, PRAGMA, pieces
from tappet.iec.words import SECTION_FLAGS, SECTIONS


class Declared(NamedTuple):
    """A variable."""

    name: str
    scope: str
    """Such as `VAR_INPUT CONSTANT`."""
    type: str
    initial: str
    address: str
    comment: str


def declared_variables(text: str) -> list[Declared]:
    """The variables of all sections, in their order."""
    found: list[Declared] = []
    scope = ""
    waiting: list[tuple[str, int, int]] = []
    behind: list[int] = []
    """Indexes of what the last declaration declared: a comment in its line is about them."""
    ended = -1
    """Where the last declaration ends."""
    above = ""
    for kind, piece, begin, end in pieces(text):
        upper = piece.upper()
        if kind == COMMENT:
            if ended >= 0 and "\n" not in text[ended:begin]:
                for index in behind:
                    found[index] = found[index]._replace(comment=_said(piece))
            elif not waiting:
                above = _said(piece)
        elif kind == PRAGMA:
            continue
        elif upper in SECTIONS:
            scope, waiting, above, ended = upper, [], "", -1
        elif upper == "END_VAR":
            scope, waiting = "", []
        elif scope and not waiting and upper in SECTION_FLAGS:
            scope += f" {upper}"
        elif scope and piece == ";":
            behind = []
            for row in _rows(text, waiting, scope, above):
                behind.append(len(found))
                found.append(row)
            waiting, above, ended = [], "", end
        elif scope:
            waiting.append((upper, begin, end))
    return found


def _rows(text: str, words: list[tuple[str, int, int]], scope: str, comment: str) -> list[Declared]:
    """The variables of one declaration `a, b AT %MW0 : INT := 1`."""
    colon = next((at for at, word in enumerate(words) if word[0] == ":"), None)
    if colon is None:
        return []
    head = words[:colon]
    at = next((index for index, word in enumerate(head) if word[0] == "AT"), None)
    address = _between(text, head[at + 1 :]) if at is not None else ""
    names = [text[begin:end] for word, begin, end in head[:at] if word != ","]
    rest = words[colon + 1 :]
    assigned = next((index for index, word in enumerate(rest) if word[0] in (":=", "REF=")), len(rest))
    shown_type, initial = _between(text, rest[:assigned]), _between(text, rest[assigned + 1 :])
    return [Declared(name, scope, shown_type, initial, address, comment) for name in names]


def _between(text: str, words: list[tuple[str, int, int]]) -> str:
    return " ".join(text[words[0][1] : words[-1][2]].split()) if words else ""


def _said(comment: str) -> str:
    """A comment without its marks."""
    for begin, end in (("(*", "*)"), ("/*", "*/"), ("//", "")):
        if comment.startswith(begin):
            inner = comment[len(begin) :]
            return " ".join((inner.removesuffix(end) if end else inner).strip("/*").split())
    return " ".join(comment.split())
