"""What an online change does to each variable, and why: for the person who decides about it.

A variable that keeps place, type and initial value is not mentioned. The rows follow the declarations; equal
elements of an array share one, as in `PLC_PRG.row[1..3].extra`. Pointers to what moves or goes come last.
"""

from __future__ import annotations

from collections.abc import Iterator
from itertools import chain
from typing import Literal

from tappet.codegen.constants import CONSTANT
from tappet.codegen.converted_values import convertible
from tappet.codegen.online import INIT, INIT_OTHER, NO_COPY, TypePairs
from tappet.codegen.package import CodePackage
from tappet.codegen.pointer_changes import pointer_rows
from tappet.codegen.symbol_types import MemberInfo, TypeInfo, user_members
from tappet.codegen.variable_changes import ChangeReport, Effect, Reason, VariableChange

MOST_ROWS = 5000
"""Rows of one report; the others are counted."""


def change_report(old: CodePackage, new: CodePackage) -> ChangeReport:
    """The rows for the change from `old` to `new`, which was built on it."""
    change = new.online_change
    same_data = old.data_id == new.data_id and old.initial_image == new.initial_image
    if change is None or (same_data and not change.initialise):
        return ChangeReport()
    rows: list[VariableChange] = []
    omitted = 0
    for row in chain(_Comparison(old, new).rows(), pointer_rows(old, new)):
        if len(rows) < MOST_ROWS:
            rows.append(row)
        else:
            omitted += 1
    return ChangeReport(tuple(rows), omitted)


class _Comparison:
    """Walks the variables of two programs side by side."""

    def __init__(self, old: CodePackage, new: CodePackage) -> None:
        self.before = old
        self.after = new
        self.old = old.symbols
        self.new = new.symbols
        self.pairs = TypePairs(old.symbols, new.symbols)
        self.stays = False
        """Whether the program or list that is looked at stays where it is."""

    def rows(self) -> Iterator[VariableChange]:
        for name, root in self.new.roots.items():
            if root.name.startswith("__"):
                continue
            type_, before = self.new.types[root.type], self.old.roots.get(name)
            if before is None:
                yield from self._all(root.name, type_, "initialised", "new", self.after)
                continue
            self.stays = self._stays(f"tappet.data.{name}")
            yield from self._members(
                root.name, self.old.types[before.type], before.offset, type_, root.offset
            )
        for name, root in self.old.roots.items():
            if name not in self.new.roots and not root.name.startswith("__"):
                yield from self._all(root.name, self.old.types[root.type], "lost", "removed", self.before)

    def _stays(self, symbol: str) -> bool:
        signatures = self.before.facts.signatures.get(symbol), self.after.facts.signatures.get(symbol)
        places = self.before.data_objects.get(symbol), self.after.data_objects.get(symbol)
        return signatures[0] == signatures[1] and places[0] == places[1]

    def _all(
        self, path: str, type_: TypeInfo, effect: Effect, reason: Reason, package: CodePackage
    ) -> Iterator[VariableChange]:
        for member in user_members(type_.members):
            yield self._row(f"{path}.{member.name}", package, member.type, effect, reason, member)

    def _row(
        self,
        path: str,
        package: CodePackage,
        number: int,
        effect: Effect,
        reason: Reason,
        member: MemberInfo | None,
        before: str = "",
    ) -> VariableChange:
        flags = member.flags if member is not None else ()
        type_ = package.symbols.types[number]
        calls: list[str] = []
        if (block := self._block(package.symbols.types, type_)) is not None:
            if effect in ("moved", "lost") and "FB_EXIT" in self.before.facts.life_cycle.get(block, ()):
                calls.append("FB_Exit")
            mine = self.after.facts.life_cycle.get(block, ())
            if effect in ("moved", "initialised") and "FB_INIT" in mine:
                calls.append("FB_Init")
            if effect == "moved" and "FB_REINIT" in mine:
                calls.append("FB_Reinit")
        remanent = "RETAIN" in flags or "PERSISTENT" in flags
        return VariableChange(path, effect, reason, type_.name, before, tuple(calls), remanent)

    @staticmethod
    def _block(types: list[TypeInfo], type_: TypeInfo) -> str | None:
        """The block that a variable or the elements of an array are instances of."""
        while type_.kind == "array" and type_.elem is not None:
            type_ = types[type_.elem]
        return type_.name.upper() if type_.kind == "fb" else None

    def _members(
        self, path: str, old: TypeInfo, old_at: int, new: TypeInfo, new_at: int
    ) -> Iterator[VariableChange]:
        known = {m.name.upper(): m for m in old.members}
        for member in user_members(new.members):
            name = f"{path}.{member.name}"
            before = known.pop(member.name.upper(), None)
            if before is None:
                yield self._row(name, self.after, member.type, "initialised", "new", member)
                continue
            yield from self._member(name, before, old_at, member, new_at)
        for gone in user_members(known.values()):
            yield self._row(f"{path}.{gone.name}", self.before, gone.type, "lost", "removed", gone)

    def _member(
        self, path: str, old: MemberInfo, old_at: int, new: MemberInfo, new_at: int
    ) -> Iterator[VariableChange]:
        old_place = old.offset + (0 if old.absolute else old_at)
        new_place = new.offset + (0 if new.absolute else new_at)
        reason = self._initialised(old, old_place, new, new_place)
        if reason is not None:
            yield self._row(path, self.after, new.type, "initialised", reason, new)
        elif old.absolute and new.absolute:
            return
        elif old.absolute or new.absolute:
            yield self._row(path, self.after, new.type, "initialised", "address", new)
        elif (old.bit is None) != (new.bit is None) and convertible(
            self.old.types[old.type], self.new.types[new.type]
        ):
            before = self.old.types[old.type].name
            yield self._row(path, self.after, new.type, "converted", "type_changed", new, before)
        elif new.bit is not None and old.bit is not None:
            if self._bit(self.before, old_place, old.bit) != self._bit(self.after, new_place, new.bit):
                yield self._row(path, self.after, new.type, "kept", "initial_value", new)
        else:
            yield from self._value(path, (old.type, old_place), (new.type, new_place), new)

    def _initialised(
        self, old: MemberInfo, old_at: int, new: MemberInfo, new_at: int
    ) -> Literal["init_on_change", "no_copy", "constant"] | None:
        others = (flag for flag in new.flags if flag.startswith(INIT_OTHER))
        if INIT in new.flags or any(flag not in old.flags for flag in others):
            return "init_on_change"
        if NO_COPY in new.flags and not self.stays:
            return "no_copy"
        if CONSTANT in new.flags:
            size, new_size = self.old.types[old.type].size, self.new.types[new.type].size
            same = self._initial(self.before, old_at, size) == self._initial(self.after, new_at, new_size)
            return None if same and CONSTANT in old.flags else "constant"
        return None

    def _value(
        self, path: str, before: tuple[int, int], after: tuple[int, int], member: MemberInfo | None
    ) -> Iterator[VariableChange]:
        """A variable, by number of its type and place before and after."""
        (old_type, old_at), (new_type, new_at) = before, after
        old, new = self.old.types[old_type], self.new.types[new_type]
        if self.pairs.equal(old_type, new_type):
            if not self.stays:
                yield self._row(path, self.after, new_type, "moved", "place", member)
            if member is None or CONSTANT not in member.flags:
                yield from self._initial_values(path, (old, old_at), (new_type, new_at), member)
        elif old.kind == new.kind and new.members:
            if not self.stays and new.kind == "fb":
                yield self._row(path, self.after, new_type, "moved", "place", member)
            yield from self._members(path, old, old_at, new, new_at)
        elif old.kind == new.kind == "array" and len(old.bounds) == len(new.bounds):
            yield from self._elements(path, (old, old_at), (new_type, new_at), member)
        elif old.kind == new.kind and new.kind in ("string", "wstring"):
            shorter = new.length < old.length
            effect, reason = ("converted", "string_shortened") if shorter else ("moved", "place")
            yield self._row(path, self.after, new_type, effect, reason, member, old.name)  # type: ignore[arg-type]
        elif convertible(old, new):
            yield self._row(path, self.after, new_type, "converted", "type_changed", member, old.name)
        else:
            yield self._row(path, self.after, new_type, "initialised", "type_changed", member, old.name)

    def _elements(
        self, path: str, before: tuple[TypeInfo, int], after: tuple[int, int], member: MemberInfo | None
    ) -> Iterator[VariableChange]:
        (old, old_at), (new_type, new_at) = before, after
        new = self.new.types[new_type]
        assert old.elem is not None
        assert new.elem is not None
        pairs = list(zip(old.bounds, new.bounds, strict=True))
        shared = [(max(a[0], b[0]), min(a[1], b[1])) for a, b in pairs]
        if any(low > high for low, high in shared):
            yield self._row(path, self.after, new_type, "initialised", "type_changed", member, old.name)
            return
        if old.bounds != new.bounds:
            if any(b[0] < a[0] or b[1] > a[1] for a, b in pairs):
                yield self._row(path, self.after, new_type, "initialised", "new_elements", member, old.name)
            if any(a[0] < b[0] or a[1] > b[1] for a, b in pairs):
                yield self._row(path, self.after, new_type, "lost", "elements_removed", member, old.name)
        part = (
            path + "[" + ", ".join(f"{low}..{high}" if low < high else str(low) for low, high in shared) + "]"
        )
        yield from self._value(part, (old.elem, old_at), (new.elem, new_at), member)

    def _initial_values(
        self, path: str, before: tuple[TypeInfo, int], after: tuple[int, int], member: MemberInfo | None
    ) -> Iterator[VariableChange]:
        """Variables whose declared initial value is another one, which an online change does not apply."""
        (old, old_at), (number, new_at) = before, after
        new = self.new.types[number]
        one, other = self._initial(self.before, old_at, old.size), self._initial(self.after, new_at, new.size)
        if one == other or new.kind in ("pointer", "reference", "interface"):
            return
        if not new.members:
            yield self._row(path, self.after, number, "kept", "initial_value", member)
            return
        known = {m.name.upper(): m for m in old.members}
        for inner in user_members(new.members):
            past = known[inner.name.upper()]
            if inner.absolute or CONSTANT in inner.flags:
                continue
            name = f"{path}.{inner.name}"
            if inner.bit is not None and past.bit is not None:
                places = old_at + past.offset, new_at + inner.offset
                if self._bit(self.before, places[0], past.bit) != self._bit(self.after, places[1], inner.bit):
                    yield self._row(name, self.after, inner.type, "kept", "initial_value", inner)
            else:
                yield from self._initial_values(
                    name,
                    (self.old.types[past.type], old_at + past.offset),
                    (inner.type, new_at + inner.offset),
                    inner,
                )

    @staticmethod
    def _initial(package: CodePackage, at: int, size: int) -> bytes:
        return package.initial_image[at : at + size]

    @staticmethod
    def _bit(package: CodePackage, at: int, bit: int) -> int:
        return package.initial_image[at] >> bit & 1
