"""Where lines of one text stand in another: for clients that show another text than the analysed one."""

from __future__ import annotations

from bisect import bisect_right
from difflib import SequenceMatcher
from typing import Final, NamedTuple

from tappet.lang.source import Span, split_lines

MOST_COMPARED: Final = 2000
"""Lines between the equal beginning and end that are compared one by one; of more, all count as different."""


class _Block(NamedTuple):
    """Lines that both texts have."""

    here: int
    there: int
    lines: int


class TextDifference:
    """The lines that two texts, `here` and `there`, have in common."""

    def __init__(self, here: str, there: str) -> None:
        self._blocks = _common(split_lines(here), split_lines(there))
        self._here = [block.here for block in self._blocks]
        self._there = [block.there for block in self._blocks]

    def to_there(self, line: int) -> int | None:
        """A line of `here` in `there`; None for a line that only `here` has."""
        block = self._before(self._here, line)
        if block is None or line >= block.here + block.lines:
            return None
        return block.there + line - block.here

    def to_here(self, line: int) -> int | None:
        """A line of `there` in `here`; None for a line that only `there` has."""
        block = self._before(self._there, line)
        if block is None or line >= block.there + block.lines:
            return None
        return block.here + line - block.there

    def span_to_here(self, span: Span) -> Span | None:
        """A range of `there` in `here`; None when it begins or ends in a line that only `there` has."""
        first, last = self.to_here(span.line), self.to_here(span.end_line)
        if first is None or last is None:
            return None
        return Span(first, span.column, last, span.end_column)

    def _before(self, starts: list[int], line: int) -> _Block | None:
        number = bisect_right(starts, line) - 1
        return self._blocks[number] if number >= 0 else None


def _common(here: list[str], there: list[str]) -> list[_Block]:
    shorter = min(len(here), len(there))
    head = 0
    while head < shorter and here[head] == there[head]:
        head += 1
    tail = 0
    while tail < shorter - head and here[-1 - tail] == there[-1 - tail]:
        tail += 1
    blocks = [_Block(0, 0, head)] if head else []
    middle_here, middle_there = here[head : len(here) - tail], there[head : len(there) - tail]
    if middle_here and middle_there and len(middle_here) + len(middle_there) <= MOST_COMPARED:
        matcher = SequenceMatcher(None, middle_here, middle_there, autojunk=False)
        blocks += [
            _Block(match.a + head, match.b + head, match.size)
            for match in matcher.get_matching_blocks()
            if match.size
        ]
    if tail:
        blocks.append(_Block(len(here) - tail, len(there) - tail, tail))
    return blocks
