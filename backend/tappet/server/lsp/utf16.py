"""Positions of the Language Server Protocol in plain texts: lines and UTF-16 units, and edits at them."""

from __future__ import annotations

import re

from tappet.server.lsp.protocol.structures import Position
from tappet.server.lsp.protocol.synchronization import TextDocumentContentChangeEvent

_NOT_SPLIT = re.compile("[\U00010000-\U0010ffff]")
_LINE_END = re.compile(r"\r\n|\n|\r")
_ESCAPE = re.compile(
    r"\\(?:[^u]|u[dD][89abAB][0-9a-fA-F]{2}\\u[dD][c-fC-F][0-9a-fA-F]{2}"
    r"|(u[dD][89a-fA-F][0-9a-fA-F]{2})|u)"
)


def without_half_pairs(json: str) -> str:
    """JSON with U+FFFD for each escape of half a surrogate pair: editors may hold one, no text of ours can.

    Both are one UTF-16 unit, so the positions behind it stay.
    """
    if "\\u" not in json:
        return json
    return _ESCAPE.sub(lambda found: "\\ufffd" if found[1] else found[0], json)


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


def edited(text: str, edit: TextDocumentContentChangeEvent) -> str:
    """The text after an edit; positions outside of it count as its end."""
    if edit.range is None:
        return edit.text
    start = _offset(text, edit.range.start)
    end = max(start, _offset(text, edit.range.end))
    return text[:start] + edit.text + text[end:]


def _offset(text: str, at: Position) -> int:
    start = 0
    for _ in range(at.line):
        match = _LINE_END.search(text, start)
        if match is None:
            return len(text)
        start = match.end()
    match = _LINE_END.search(text, start)
    line = text[start : match.start() if match else len(text)]
    return start + column_of(line, at.character)
