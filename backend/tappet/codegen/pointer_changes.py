"""Pointers, references and interfaces at an online change: which of them may point to data that move or go.

Where a pointer points is known to the running application alone; here counts where it may by its type.
"""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Iterable, Iterator

from tappet.codegen.online_code import relocation_ranges
from tappet.codegen.package import CodePackage
from tappet.codegen.symbol_map import SymbolError, SymbolMap
from tappet.codegen.symbol_types import TypeInfo, user_members
from tappet.codegen.variable_changes import VariableChange

_KINDS = ("pointer", "reference", "interface")
_ANYTHING = ("BYTE", "SINT", "USINT")
"""A pointer to one of these is what bytes of any variable are reached by."""
_GONE = 0xFFFF_FFFF
_MOST_PARTS = 1000
"""Parts of an array that are looked at one by one; of a longer one all count as touched."""


def pointer_rows(old: CodePackage, new: CodePackage) -> Iterator[VariableChange]:
    """A row for each pointer that both programs have and that may point to data which move or go."""
    change = new.online_change
    ranges = relocation_ranges(old, change, new.data_objects) if change is not None else []
    if not ranges:
        return
    targets = _Targets(old.symbols, ranges)
    pointers = _Pointers(old.symbols, new.symbols)
    for path, type_ in pointers.walk():
        if targets.hit(targets.gone, type_, new.symbols):
            yield VariableChange(path, "cleared", "target_lost", type_.name)
        elif targets.hit(targets.moved, type_, new.symbols):
            yield VariableChange(path, "follows", "target_moved", type_.name)


class _Targets:
    """Types of the data of the running program that move or go."""

    def __init__(self, symbols: SymbolMap, ranges: Iterable[tuple[int, int, int]]) -> None:
        self._symbols = symbols
        self._ranges = sorted(ranges)
        self._starts = [start for start, _, _ in self._ranges]
        self._within: dict[int, frozenset[int]] = {}
        self.gone: set[int] = set()
        self.moved: set[int] = set()
        for root in symbols.roots.values():
            self._look(root.type, root.offset)

    def hit(self, touched: set[int], pointer: TypeInfo, names: SymbolMap) -> bool:
        """Whether something of these types may be what a pointer points to."""
        types = [self._symbols.types[number] for number in touched]
        if pointer.kind == "interface":
            return any(type_.kind == "fb" for type_ in types)
        if pointer.elem is None:
            return bool(types)
        target = names.types[pointer.elem]
        if target.name.upper() in _ANYTHING:
            return bool(types)
        return any(_is(type_, target) for type_ in types)

    def _look(self, number: int, at: int) -> None:
        size = self._symbols.types[number].size
        over = self._over(at, at + size)
        if not over:
            return
        whole = len(over) == 1 and over[0][0] <= at and at + size <= over[0][1]
        parts = [] if whole else list(self._symbols.parts(number))
        if whole or len(parts) > _MOST_PARTS:
            for _, _, target in over:
                self._set(target).update(self._all(number))
            return
        for _, _, target in over:
            self._set(target).add(number)
        for part, offset in parts:
            self._look(part, at + offset)

    def _set(self, target: int) -> set[int]:
        return self.gone if target == _GONE else self.moved

    def _over(self, start: int, end: int) -> list[tuple[int, int, int]]:
        found = []
        for one in self._ranges[max(bisect_right(self._starts, start) - 1, 0) :]:
            if one[0] >= end:
                break
            if one[1] > start:
                found.append(one)
        return found

    def _all(self, number: int) -> frozenset[int]:
        """A type and those of its parts."""
        known = self._within.get(number)
        if known is None:
            type_ = self._symbols.types[number]
            inner = {type_.elem} if type_.kind == "array" and type_.elem is not None else set()
            inner |= {member.type for member in type_.members}
            known = frozenset({number}.union(*(self._all(part) for part in inner)))
            self._within[number] = known
        return known


def _is(type_: TypeInfo, target: TypeInfo) -> bool:
    """Whether a variable of a type may be a pointer's target: it is one, or a block derived from it."""
    if type_.name.upper() == target.name.upper():
        return True
    if type_.kind != "fb" or target.kind != "fb" or len(type_.members) < len(target.members):
        return False
    pairs = zip(type_.members, target.members, strict=False)
    return all(mine.name.upper() == other.name.upper() for mine, other in pairs)


class _Pointers:
    """The pointers that two programs have in common."""

    def __init__(self, old: SymbolMap, new: SymbolMap) -> None:
        self._old = old
        self._new = new
        self._holds: dict[int, bool] = {}

    def walk(self) -> Iterator[tuple[str, TypeInfo]]:
        """Path and type; elements of an array share one path, as in `PLC_PRG.row[1..3]`."""
        for root in self._new.roots.values():
            if not root.name.startswith("__"):
                yield from self._members(root.name, root.name, self._new.types[root.type])

    def _members(self, path: str, first: str, type_: TypeInfo) -> Iterator[tuple[str, TypeInfo]]:
        for member in user_members(type_.members):
            yield from self._value(f"{path}.{member.name}", f"{first}.{member.name}", member.type)

    def _value(self, path: str, first: str, number: int) -> Iterator[tuple[str, TypeInfo]]:
        """`first` names the first one of several elements."""
        if not self._has_pointer(number):
            return
        type_ = self._new.types[number]
        if type_.kind in _KINDS:
            if self._before(first) == type_.name:
                yield path, type_
        elif type_.kind == "array" and type_.elem is not None:
            spans = ", ".join(f"{low}..{high}" if low < high else str(low) for low, high in type_.bounds)
            begin = ", ".join(str(low) for low, _ in type_.bounds)
            yield from self._value(f"{path}[{spans}]", f"{first}[{begin}]", type_.elem)
        else:
            yield from self._members(path, first, type_)

    def _before(self, path: str) -> str | None:
        try:
            return self._old.resolve(path).type.name
        except SymbolError:
            return None

    def _has_pointer(self, number: int) -> bool:
        known = self._holds.get(number)
        if known is None:
            self._holds[number] = False  # a type does not contain itself
            type_ = self._new.types[number]
            inner = [type_.elem] if type_.kind == "array" and type_.elem is not None else []
            inner += [member.type for member in user_members(type_.members)]
            known = self._holds[number] = type_.kind in _KINDS or any(map(self._has_pointer, inner))
        return known
