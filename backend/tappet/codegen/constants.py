"""Where the constants of an application lie in its image.

Code has the values of simple constants built in; memory has them for monitoring, and arrays, structures and
texts are read from there.
"""

from __future__ import annotations

from bisect import bisect_left
from collections.abc import Iterable

from tappet.codegen.symbol_map import SymbolMap

CONSTANT = "CONSTANT"
"""Flag of a constant."""
Range = tuple[int, int]
"""Offset and size in an image."""


class TypesWithConstants:
    """Which types have constants inside."""

    def __init__(self, symbols: SymbolMap) -> None:
        self._types = symbols.types
        self._known: dict[int, bool] = {}

    def __contains__(self, number: int) -> bool:
        known = self._known.get(number)
        if known is None:
            self._known[number] = False  # a recursive mention, through pointers
            type_ = self._types[number]
            known = type_.kind == "array" and type_.elem is not None and type_.elem in self
            known = known or any(
                CONSTANT in m.flags or (not m.absolute and m.type in self) for m in type_.members
            )
            self._known[number] = known
        return known


def constants_within(symbols: SymbolMap, ranges: Iterable[Range]) -> list[Range]:
    """Places of all constants that lie inside of the ranges, which do not overlap."""
    search = _Search(symbols, sorted(ranges))
    for root in symbols.roots.values():
        search.value(root.type, root.offset)
    return search.found


class _Search:
    def __init__(self, symbols: SymbolMap, ranges: list[Range]) -> None:
        self.types = symbols.types
        self.with_constants = TypesWithConstants(symbols)
        self.ranges = ranges
        self.ends = [offset + size for offset, size in ranges]
        self.found: list[Range] = []

    def value(self, number: int, at: int) -> None:
        """A variable of a type: its constants, and those of what it consists of."""
        type_ = self.types[number]
        if number not in self.with_constants or not self._touches(at, type_.size):
            return
        if type_.kind == "array" and type_.elem is not None:
            size = self.types[type_.elem].size
            for start in range(at, at + type_.size if size else at, size or 1):
                self.value(type_.elem, start)
            return
        for member in type_.members:
            if member.absolute or member.section == "VAR_IN_OUT":
                continue
            size = self.types[member.type].size
            if CONSTANT not in member.flags:
                self.value(member.type, at + member.offset)
            elif self._touches(at + member.offset, size):
                self.found.append((at + member.offset, size))

    def _touches(self, at: int, size: int) -> bool:
        index = bisect_left(self.ends, at + 1)
        return index < len(self.ranges) and self.ranges[index][0] < at + size
