"""Positions of the protocol: lines and UTF-16 units, where the compiler counts code points."""

from __future__ import annotations

import re
from collections.abc import Callable

from lsprotocol import types as lsp

from tappet.lang.services.documents import Position
from tappet.lang.source import Span, split_lines

Line = Callable[[int], str]
"""The text of a line of some document; '' behind its end."""

_NOT_SPLIT = re.compile("[\U00010000-\U0010ffff]")


def units(line: str, column: int) -> int:
    """UTF-16 units before a code point column of a line."""
    column = min(column, len(line))
    if line.isascii():
        return column
    return column + len(_NOT_SPLIT.findall(line, 0, column))


def column_of(line: str, character: int) -> int:
    """Code point column of a UTF-16 unit; a unit inside a character counts as its begin."""
    if character <= 0:
        return 0
    if line.isascii() or not _NOT_SPLIT.search(line):
        return min(character, len(line))
    count = 0
    for column, char in enumerate(line):
        count += 2 if char > "\uffff" else 1
        if count > character:
            return column
    return len(line)


def to_position(line: Line, position: lsp.Position) -> Position:
    """A position of the client."""
    return Position(position.line, column_of(line(position.line), position.character))


def to_range(line: Line, span: Span) -> lsp.Range:
    """A span for the client."""
    return lsp.Range(
        lsp.Position(span.line, units(line(span.line), span.column)),
        lsp.Position(span.end_line, units(line(span.end_line), span.end_column)),
    )


def apply_change(text: str, change: lsp.TextDocumentContentChangeEvent) -> str:
    """The text after an edit of the client; positions outside of it count as its end."""
    if isinstance(change, lsp.TextDocumentContentChangeWholeDocument):
        return change.text
    start = _offset(text, change.range.start)
    end = max(start, _offset(text, change.range.end))
    return text[:start] + change.text + text[end:]


_LINE_END = re.compile(r"\r\n|\n|\r")


def _offset(text: str, position: lsp.Position) -> int:
    start = 0
    for _ in range(position.line):
        match = _LINE_END.search(text, start)
        if match is None:
            return len(text)
        start = match.end()
    match = _LINE_END.search(text, start)
    line = text[start : match.start() if match else len(text)]
    return start + column_of(line, position.character)


def lines_of(text: str) -> Line:
    """Access to the lines of a text."""
    lines = split_lines(text)
    return lambda number: lines[number] if 0 <= number < len(lines) else ""
