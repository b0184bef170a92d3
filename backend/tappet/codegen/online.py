"""Plans an online change: which bytes move from the running image, which are reinitialised."""

from __future__ import annotations

from collections.abc import Iterator

from tappet.codegen.converted_values import Conversion, convertible, scalar
from tappet.codegen.layout import Layout
from tappet.codegen.online_constants import ChangedConstants, bits_without, without
from tappet.codegen.package import CodePackage, OnlineChange
from tappet.codegen.symbol_map import Root, SymbolMap
from tappet.codegen.symbol_types import MemberInfo, TypeInfo

Bounds = tuple[tuple[int, int], ...]
NO_COPY = "NO_COPY"
"""Flag of a variable that an online change does not copy (LPRG-35)."""
INIT = "INIT_ON_CHANGE"
"""Flag of a variable that every online change initialises (LPRG-28)."""
INIT_OTHER = "INIT_ON_CHANGE_FROM_"
"""Begin of a flag of a variable that an online change initialises from another one: the value of the
attribute follows, which stands for what the variable begins with."""


def plan_online_change(old: CodePackage, symbols: SymbolMap, placed: Layout, image: bytes) -> OnlineChange:
    """Moves and initialised ranges of the data objects that are new or changed, and of changed constants;
    `image` has the new initial values.
    """
    plan = _Plan(old.symbols, symbols)
    for symbol, place in placed.objects.items():
        if symbol in placed.kept:
            root = symbols.roots.get(root_name(symbol))
            if root is not None:
                plan.mark(old.symbols.roots.get(root_name(symbol)), root)
            continue
        before = old.data_objects.get(symbol)
        name = root_name(symbol)
        if symbol.startswith("tappet.area."):
            size = min(before.size, place.size) if before else 0
            if before is not None:
                plan.moves.append((before.offset, place.offset, size))
            plan.reasons.append(f"area %{symbol[-1]} has {place.size} bytes")
            continue
        old_root, new_root = old.symbols.roots.get(name), symbols.roots.get(name)
        if before is None or old_root is None or new_root is None:
            plan.reasons.append(f"{name} is new")
            plan.fresh.append((place.offset, place.size))
            continue
        plan.reasons.append(f"declaration of {name} changed")
        plan.fresh.append((place.offset, place.size))
        plan.members(
            plan.old.types[old_root.type], old_root.offset, plan.new.types[new_root.type], new_root.offset
        )
    for symbol in old.data_objects:
        if symbol not in placed.objects:
            plan.reasons.append(f"{root_name(symbol)} was removed")
    constants = ChangedConstants(old.symbols, old.initial_image, symbols, image).find()
    plan.moves = without(plan.moves, constants)
    plan.bits = bits_without(plan.bits, constants)
    plan.fresh += constants
    return OnlineChange(
        old.code_id,
        old.data_id,
        tuple(plan.moves),
        tuple(plan.uncovered()),
        tuple(plan.reasons),
        bits=tuple(plan.bits),
        conversions=tuple(
            c for c in plan.conversions if not any(at <= c.target.offset < at + n for at, n in constants)
        ),
    )


def code_change(old: CodePackage, symbols: SymbolMap) -> OnlineChange:
    """An online change of code alone: what is marked to be initialised at every change still is."""
    plan = _Plan(old.symbols, symbols)
    for name, root in symbols.roots.items():
        plan.mark(old.symbols.roots.get(name), root)
    initialise = tuple(sorted(plan.fresh))
    return OnlineChange(old.code_id, old.data_id, initialise=initialise, bits=tuple(plan.bits))


def root_name(symbol: str) -> str:
    """The root of the symbol map that a data object holds."""
    return symbol.rpartition("tappet.data.")[2]


def _is_initialised(before: MemberInfo | None, member: MemberInfo) -> bool:
    """Whether an online change initialises a variable wherever it is (LPRG-28)."""
    return INIT in member.flags or any(
        flag.startswith(INIT_OTHER) and (before is None or flag not in before.flags) for flag in member.flags
    )


def _is_reinitialised(before: MemberInfo | None, member: MemberInfo) -> bool:
    """Whether a variable is initialised where its object moves (LPRG-28, LPRG-35)."""
    return NO_COPY in member.flags or _is_initialised(before, member)


class TypePairs:
    """Compares types of two programs."""

    def __init__(self, old: SymbolMap, new: SymbolMap) -> None:
        self.old = old
        self.new = new
        self.same: dict[tuple[int, int], bool] = {}

    def equal(self, old_type: int, new_type: int) -> bool:
        """Whether two types lay out and mean the same."""
        key = (old_type, new_type)
        known = self.same.get(key)
        if known is None:
            self.same[key] = True  # a recursive mention, through pointers
            known = self.same[key] = self._equal(self.old.types[old_type], self.new.types[new_type])
        return known

    def _equal(self, old: TypeInfo, new: TypeInfo) -> bool:
        if (old.kind, old.size, old.bounds, old.length) != (new.kind, new.size, new.bounds, new.length):
            return False
        if old.kind in ("pointer", "reference", "interface"):
            return old.name == new.name
        if old.elem is not None and new.elem is not None and not self.equal(old.elem, new.elem):
            return False
        if len(old.members) != len(new.members):
            return False
        if old.kind == "fb" and old.name != new.name:
            return False
        return all(
            a.name.upper() == b.name.upper()
            and (a.offset, a.bit, a.absolute) == (b.offset, b.bit, b.absolute)
            and not _is_reinitialised(a, b)
            and self.equal(a.type, b.type)
            for a, b in zip(old.members, new.members, strict=True)
        )


class _Plan:
    """Matches old and new variables by path and type."""

    def __init__(self, old: SymbolMap, new: SymbolMap) -> None:
        self.old = old
        self.new = new
        self.moves: list[tuple[int, int, int]] = []
        self.bits: list[tuple[int, int, int, int]] = []
        self.conversions: list[Conversion] = []
        self.fresh: list[tuple[int, int]] = []
        self.reasons: list[str] = []
        self.equal = TypePairs(old, new).equal

    def mark(self, old: Root | None, new: Root) -> None:
        """Initialise what an online change initialises inside an object that stays (LPRG-28)."""
        before = self.old.types[old.type] if old is not None else None
        self._mark(before, self.new.types[new.type], new.offset)

    def _mark(self, old: TypeInfo | None, type_: TypeInfo, at: int) -> None:
        known = {m.name.upper(): m for m in old.members} if old is not None else {}
        for member in type_.members:
            inner = self.new.types[member.type]
            if member.absolute or member.section == "VAR_IN_OUT":
                continue
            start = at + member.offset
            before = known.get(member.name.upper())
            if _is_initialised(before, member):
                self.fresh.append((start, 1 if member.bit is not None else inner.size))
                if member.bit is not None:
                    # bytes are initialised: the other bits of this one get back what they had
                    self.bits += [
                        (start, m.bit, start, m.bit)
                        for m in type_.members
                        if m.offset == member.offset
                        and m.bit is not None
                        and not _is_initialised(known.get(m.name.upper()), m)
                    ]
                continue
            inner_before = self.old.types[before.type] if before is not None else None
            if inner.kind == "array" and inner.elem is not None:
                element = self.new.types[inner.elem]
                was = inner_before.elem if inner_before is not None else None
                for offset in range(0, inner.size, element.size) if element.members else ():
                    self._mark(self.old.types[was] if was is not None else None, element, start + offset)
            elif inner.members:
                self._mark(inner_before, inner, start)

    def members(self, old: TypeInfo, old_at: int, new: TypeInfo, new_at: int) -> None:
        """Move the members that both types have."""
        known = {m.name.upper(): m for m in old.members}
        for member in new.members:
            before = known.get(member.name.upper())
            if before is None or member.absolute or before.absolute:
                continue
            if _is_reinitialised(before, member):
                continue
            if member.bit is not None and before.bit is not None:
                self.bits.append((old_at + before.offset, before.bit, new_at + member.offset, member.bit))
                continue
            if member.name.upper() == "__VFTABLE":
                continue
            if member.bit is not None or before.bit is not None:
                self.convert(before, old_at, member, new_at)
                continue
            if new.kind == "union" and not self.equal(before.type, member.type):
                continue  # other members that stay say what the bytes are
            self.value(before.type, old_at + before.offset, member.type, new_at + member.offset)

    def value(self, old_type: int, old_at: int, new_type: int, new_at: int) -> None:
        """Move a value, as a whole when its type is the same, else part by part."""
        old, new = self.old.types[old_type], self.new.types[new_type]
        if self.equal(old_type, new_type):
            self.move(old_at, new_at, new.size)
        elif old.kind == new.kind and new.members:
            self.members(old, old_at, new, new_at)
        elif old.kind == new.kind == "array":
            self.elements(old, old_at, new, new_at)
        elif old.kind == new.kind and new.kind in ("string", "wstring"):
            # one unit stays free, so that a shortened text ends in a zero
            unit = 2 if new.kind == "wstring" else 1
            self.move(old_at, new_at, min(old.size, new.size - unit))
        elif convertible(old, new):
            self.conversions.append(Conversion(scalar(old, old_at), scalar(new, new_at)))

    def convert(self, old: MemberInfo, old_at: int, new: MemberInfo, new_at: int) -> None:
        """A BIT that becomes a number, or the other way round."""
        old_type, new_type = self.old.types[old.type], self.new.types[new.type]
        if convertible(old_type, new_type):
            source = scalar(old_type, old_at + old.offset, old)
            self.conversions.append(Conversion(source, scalar(new_type, new_at + new.offset, new)))

    def elements(self, old: TypeInfo, old_at: int, new: TypeInfo, new_at: int) -> None:
        """Move the elements whose indices both arrays have."""
        if old.elem is None or new.elem is None or len(old.bounds) != len(new.bounds):
            return
        size = self.old.types[old.elem].size, self.new.types[new.elem].size
        for before, after in _shared_elements(old.bounds, new.bounds):
            self.value(old.elem, old_at + before * size[0], new.elem, new_at + after * size[1])

    def move(self, old_at: int, new_at: int, size: int) -> None:
        """Note a move, joined to the one before it where they touch."""
        if size <= 0:
            return
        if self.moves:
            last_old, last_new, last_size = self.moves[-1]
            if last_old + last_size == old_at and last_new + last_size == new_at:
                self.moves[-1] = (last_old, last_new, last_size + size)
                return
        self.moves.append((old_at, new_at, size))

    def uncovered(self) -> list[tuple[int, int]]:
        """The fresh ranges without what moves fill."""
        filled = sorted((target, target + size) for _, target, size in self.moves)
        result: list[tuple[int, int]] = []
        for start, length in sorted(self.fresh):
            at, end = start, start + length
            for low, high in filled:
                if high <= at or low >= end:
                    continue
                if low > at:
                    result.append((at, low - at))
                at = max(at, high)
            if at < end:
                result.append((at, end - at))
        return result


def _shared_elements(old: Bounds, new: Bounds) -> Iterator[tuple[int, int]]:
    """Numbers, in the old and in the new array, of the elements that both have, in storage order."""
    if not old:
        yield 0, 0
        return
    (old_low, old_high), (new_low, new_high) = old[-1], new[-1]
    before, after = old_high - old_low + 1, new_high - new_low + 1
    for old_row, new_row in _shared_elements(old[:-1], new[:-1]):
        for index in range(max(old_low, new_low), min(old_high, new_high) + 1):
            yield old_row * before + index - old_low, new_row * after + index - new_low
