"""Positions of the protocol as the compiler counts them: code points instead of UTF-16 units."""

from __future__ import annotations

from collections.abc import Callable

from tappet.lang.services.documents import Position
from tappet.lang.source import Span, split_lines
from tappet.server.lsp.protocol import structures as lsp
from tappet.server.lsp.utf16 import column_of, units

Line = Callable[[int], str]
"""The text of a line of some document; '' behind its end."""


def to_position(line: Line, position: lsp.Position) -> Position:
    """A position of the client."""
    return Position(position.line, column_of(line(position.line), position.character))


def to_range(line: Line, span: Span) -> lsp.Range:
    """A span for the client."""
    return lsp.Range(
        lsp.Position(span.line, units(line(span.line), span.column)),
        lsp.Position(span.end_line, units(line(span.end_line), span.end_column)),
    )


def lines_of(text: str) -> Line:
    """Access to the lines of a text."""
    lines = split_lines(text)
    return lambda number: lines[number] if 0 <= number < len(lines) else ""
