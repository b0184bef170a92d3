"""Constants with other values: an online change brings them to memory, where they are monitored and read.

A constant keeps what it has when its declared value is the same: FB_Init may have set a VAR_INPUT CONSTANT.
"""

from __future__ import annotations

from tappet.codegen.constants import CONSTANT, Range, TypesWithConstants
from tappet.codegen.symbol_map import SymbolMap
from tappet.codegen.symbol_types import MemberInfo, TypeInfo


class ChangedConstants:
    """Walks old and new variables of the same name side by side."""

    def __init__(self, old: SymbolMap, old_image: bytes, new: SymbolMap, new_image: bytes) -> None:
        self.old = old
        self.old_image = old_image
        self.new = new
        self.new_image = new_image
        self.ranges: list[Range] = []
        self._with_constants = TypesWithConstants(new)

    def find(self) -> list[Range]:
        """Places of all constants whose value is another one than in the old program."""
        for name, root in self.new.roots.items():
            before = self.old.roots.get(name)
            if before is not None:
                self._value(before.type, before.offset, root.type, root.offset)
        return self.ranges

    def _value(self, old_type: int, old_at: int, new_type: int, new_at: int) -> None:
        if new_type not in self._with_constants:
            return
        old, new = self.old.types[old_type], self.new.types[new_type]
        if old.kind != new.kind:
            return
        if new.kind == "array":
            self._elements(old, old_at, new, new_at)
            return
        known = {m.name.upper(): m for m in old.members}
        for member in new.members:
            before = known.get(member.name.upper())
            if before is None or member.section == "VAR_IN_OUT":
                continue
            old_start = before.offset + (0 if before.absolute else old_at)
            new_start = member.offset + (0 if member.absolute else new_at)
            if CONSTANT in member.flags:
                self._constant(before, old_start, member, new_start)
            elif not member.absolute:
                self._value(before.type, old_start, member.type, new_start)

    def _elements(self, old: TypeInfo, old_at: int, new: TypeInfo, new_at: int) -> None:
        if old.elem is None or new.elem is None or old.bounds != new.bounds:
            return  # those that are new have initial values anyway
        old_size, new_size = self.old.types[old.elem].size, self.new.types[new.elem].size
        for number in range(new.size // new_size if new_size else 0):
            self._value(old.elem, old_at + number * old_size, new.elem, new_at + number * new_size)

    def _constant(self, old: MemberInfo, old_at: int, new: MemberInfo, new_at: int) -> None:
        old_size, size = self.old.types[old.type].size, self.new.types[new.type].size
        same = self.old_image[old_at : old_at + old_size] == self.new_image[new_at : new_at + size]
        if not same or CONSTANT not in old.flags:
            self.ranges.append((new_at, size))


def without(moves: list[tuple[int, int, int]], ranges: list[Range]) -> list[tuple[int, int, int]]:
    """Moves (old offset, new offset, size) that leave ranges of the new image alone."""
    if not ranges:
        return moves
    found = []
    ordered = sorted(ranges)
    for old, new, size in moves:
        at, end = new, new + size
        for start, length in ordered:
            if start + length <= at or start >= end:
                continue
            if start > at:
                found.append((old + at - new, at, start - at))
            at = max(at, start + length)
        if at < end:
            found.append((old + at - new, at, end - at))
    return found


def bits_without(
    bits: list[tuple[int, int, int, int]], ranges: list[Range]
) -> list[tuple[int, int, int, int]]:
    """Moves of bits (old offset, bit, new offset, bit) that leave ranges of the new image alone."""
    return [move for move in bits if not any(at <= move[2] < at + size for at, size in ranges)]
