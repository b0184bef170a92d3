"""What the tokens around a position say: the word being typed, the chain before a dot, the call around it.

Services that help while typing work on tokens, because the text is rarely right at that moment.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from tappet.iec.words import OBJECT_ENDS, OBJECT_HEADS, SECTIONS
from tappet.lang import ast
from tappet.lang.lexer import COMMENT, END, ID, PRAGMA, STRING, Lexed
from tappet.lang.parser_declarations import Parser
from tappet.lang.services.documents import Position
from tappet.lang.source import Source, Span

Region = Literal["outside", "head", "variables", "type", "code"]

_OPENING = {")": "(", "]": "["}
_OBJECT_CLOSED = frozenset(OBJECT_ENDS[word] for word in OBJECT_HEADS - {"TYPE"})


@dataclass(frozen=True, slots=True)
class Cursor:
    """A position between tokens."""

    inside: Literal["code", "comment", "string", "pragma"]
    text: str
    """The comment, string or pragma up to the position; '' in code."""
    word: str
    """The identifier or keyword up to the position, '' if none is being typed."""
    previous: int
    """Index of the last token before the word, -1 if there is none."""


def cursor_at(lexed: Lexed, position: Position) -> Cursor:
    """What stands at a position."""
    low = token_before(lexed, position)
    for item in (*lexed.trivia.get(low + 1, ()), *lexed.trivia.get(low, ())):
        if _inside(item.span, item.text, position):
            kind: Literal["comment", "pragma"] = "comment" if item.kind is COMMENT else "pragma"
            return Cursor(kind, _up_to(item.text, item.span, position), "", low)
    if low >= 0 and lexed.lines[low] == position.line:
        kind_, text, column = lexed.kinds[low], lexed.texts[low], lexed.columns[low]
        end = column + len(text)
        if kind_ is STRING and position.column < end:
            return Cursor("string", text[: position.column - column], "", low - 1)
        if (kind_ is ID or text[:1].isidentifier()) and position.column <= end:
            return Cursor("code", "", text[: position.column - column], low - 1)
    return Cursor("code", "", "", low)


def _inside(span: Span, text: str, position: Position) -> bool:
    start, end = (span.line, span.column), (span.end_line, span.end_column)
    if text.startswith("//"):
        return start < position <= end
    return start < position < end


def _up_to(text: str, span: Span, position: Position) -> str:
    lines = text.split("\n")
    taken = lines[: position.line - span.line + 1]
    shift = span.column if position.line == span.line else 0
    taken[-1] = taken[-1][: position.column - shift]
    return "\n".join(taken)


def token_before(lexed: Lexed, position: Position) -> int:
    """Index of the last token that begins before a position, -1 if none does."""
    low, high = 0, len(lexed.kinds) - 1  # END is no token
    lines, columns = lexed.lines, lexed.columns
    while low < high:
        middle = (low + high) // 2
        if (lines[middle], columns[middle]) < position:
            low = middle + 1
        else:
            high = middle
    return low - 1


def token_at(lexed: Lexed, position: Position) -> int | None:
    """Index of the token that a position touches; of two that meet there, the name."""
    low = token_before(lexed, position)
    found: int | None = None
    for index in (low, low + 1):
        if 0 <= index < len(lexed.kinds) - 1 and lexed.lines[index] == position.line:
            start = lexed.columns[index]
            if start <= position.column <= start + len(lexed.texts[index]):
                if lexed.kinds[index] is ID:
                    return index
                found = index if found is None else found
    return found


def matching_open(lexed: Lexed, index: int) -> int | None:
    """Index of the bracket that the one at `index` closes."""
    level = 0
    closing = lexed.kinds[index]
    opening = _OPENING[closing]
    for at in range(index, -1, -1):
        kind = lexed.kinds[at]
        if kind == closing:
            level += 1
        elif kind == opening:
            level -= 1
            if level == 0:
                return at
        elif kind == ";":
            return None
    return None


def chain_before(lexed: Lexed, end: int) -> int:
    """Index where the chain `a.b[1]^.c(...)` begins whose last token is `end - 1`; `end` if there is none."""
    start = end
    at = end - 1
    while at >= 0:
        kind = lexed.kinds[at]
        if kind in (")", "]"):
            opening = matching_open(lexed, at)
            if opening is None:
                return start
            before = lexed.kinds[opening - 1] if opening else END
            if kind == ")" and before is not ID and before not in (")", "]", "^"):
                return opening  # `(expression).member`
            at = opening - 1
        elif kind == "^":
            at -= 1
        elif kind is ID or kind in ("THIS", "SUPER") or lexed.texts[at][:1].isidentifier():
            start = at
            if at and lexed.kinds[at - 1] == ".":
                if at >= 2 and _ends_operand(lexed, at - 2):
                    at -= 2
                    continue
                return at - 1  # `.global`
            return start
        else:
            return start
    return start


def _ends_operand(lexed: Lexed, index: int) -> bool:
    kind = lexed.kinds[index]
    return kind is ID or kind in (")", "]", "^") or lexed.texts[index][:1].isidentifier()


def operand(lexed: Lexed, source: Source, start: int, end: int) -> ast.Expr | None:
    """The tree of the tokens from `start` up to `end`."""
    if start >= end:
        return None
    part = Lexed()
    part.kinds = [*lexed.kinds[start:end], END]
    part.texts = [*lexed.texts[start:end], ""]
    part.lines = [*lexed.lines[start:end], lexed.lines[end - 1]]
    part.columns = [*lexed.columns[start:end], lexed.columns[end - 1] + len(lexed.texts[end - 1])]
    return Parser(source, part).operand()


@dataclass(frozen=True, slots=True)
class EnclosingCall:
    """The innermost open parenthesis behind a name."""

    callee: ast.Expr
    opening: int
    """Index of the `(`."""
    count: int
    """Number of commas between it and the position."""
    named: str
    """Name of the argument that is being written, '' without one."""
    given: frozenset[str]
    """Upper-case names of the other arguments that are written with a name."""


def enclosing_call(lexed: Lexed, source: Source, index: int) -> EnclosingCall | None:
    """The call whose arguments hold the place behind token `index`."""
    level = 0
    count = 0
    named = ""
    given: set[str] = set()
    at = index
    while at >= 0:
        kind = lexed.kinds[at]
        if kind in (")", "]"):
            level += 1
        elif kind == "[" or kind == "(":
            if level:
                level -= 1
            elif kind == "(":
                break
        elif kind == ";" or kind in ("THEN", "DO", "OF", "END_VAR"):
            return None
        elif level == 0:
            if kind == ",":
                count += 1
            elif kind in (":=", "=>") and at and lexed.texts[at - 1][:1].isidentifier():
                if count == 0 and not named:
                    named = lexed.texts[at - 1]
                else:
                    given.add(lexed.texts[at - 1].upper())
        at -= 1
    if at <= 0:
        return None
    start = chain_before(lexed, at)
    callee = operand(lexed, source, start, at)
    if callee is None:
        return None
    level = 0
    for ahead in range(index + 1, len(lexed.kinds)):  # arguments that are written behind the position
        kind = lexed.kinds[ahead]
        if kind in ("(", "["):
            level += 1
        elif kind in (")", "]"):
            level -= 1
            if level < 0:
                break
        elif kind == ";":
            break
        elif level == 0 and kind in (":=", "=>"):
            given.add(lexed.texts[ahead - 1].upper())
    return EnclosingCall(callee, at, count, named, frozenset(given))


def region_at(lexed: Lexed, index: int) -> Region:
    """In what part of an object the place behind token `index` lies."""
    region: Region = "outside"
    outer: list[Region] = []
    for at in range(index + 1):
        kind = lexed.kinds[at]
        if kind in SECTIONS:
            region = "variables"
        elif kind == "END_VAR":
            region = "code" if outer else "outside"
        elif kind == "TYPE":
            region = "type"
        elif kind in ("STRUCT", "UNION"):
            region = "variables"
        elif kind in ("END_STRUCT", "END_UNION"):
            region = "type"
        elif kind in OBJECT_HEADS:
            outer.append("code")
            region = "head"
        elif kind in _OBJECT_CLOSED:
            if outer:
                outer.pop()
            region = "code" if outer else "outside"
        elif kind == "END_TYPE":
            region = "outside"
        elif region == "head" and at and lexed.lines[at] != lexed.lines[at - 1]:
            region = "code"
    return region


def in_pragma(cursor: Cursor) -> bool:
    """Whether attribute names can be proposed."""
    return cursor.inside == PRAGMA and "attribute" in cursor.text.lower()
