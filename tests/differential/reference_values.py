"""Values of the reference: one Python object per variable, and the places where they lie."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import typed_tree as tree
from arithmetic import convert, wrap
from bytes_in_memory import View
from typed_tree import Array, Block, Enum, Scalar, Struct, Subrange, Text, Type, Variable, base_of

BLOCK = ""
"""Where an instance records its type."""


BOUNDS = "bounds of "
"""Before the name of an open array: its bounds."""


def line(block: Block | None) -> list[Block]:
    """A block and what it extends."""
    return [] if block is None else [block, *line(block.base)]


class Exit(Exception):  # noqa: N818
    """EXIT."""


class Continue(Exception):  # noqa: N818
    """CONTINUE."""


class Return(Exception):  # noqa: N818
    """RETURN."""


class TooLong(Exception):  # noqa: N818
    """The program takes too many steps to be worth comparing."""


def default(type_: Type) -> Any:
    """Value of a variable without initial value."""
    if isinstance(type_, Text):
        return ""
    if isinstance(type_, Enum):
        return type_.members[0][1]
    if isinstance(type_, Subrange):
        return 0  # also where 0 is outside the limits
    if isinstance(type_, Array):
        low, high = type_.bounds[0]
        rest = Array(type_.element, type_.bounds[1:]) if len(type_.bounds) > 1 else type_.element
        return [default(rest) for _ in range(high - low + 1)]
    if isinstance(type_, Struct):
        return View.fresh(type_) if type_.union else {name: default(t) for name, t in type_.members}
    if isinstance(type_, Block):
        return {**fresh(type_.members), BLOCK: type_}
    if isinstance(type_, tree.Pointer | tree.Interface):
        return None
    if isinstance(type_, tree.BitMember):
        return False
    return {"bool": False, "real": 0.0}.get(type_.kind, 0)


def fresh(variables: list[Variable]) -> dict[str, Any]:
    """A set of variables with their initial values."""
    return {v.name: default(v.type) if v.initial is None else initial(v.type, v.initial) for v in variables}


def initial(type_: Type, given: Any) -> Any:
    """An initial value; what an array or structure leaves open has its default."""
    if isinstance(type_, Block):
        return default(type_)  # FB_Init comes first
    if isinstance(type_, Struct):
        return {n: initial(t, given[n]) if n in given else default(t) for n, t in type_.members}
    if not isinstance(type_, Array):
        return given
    found = default(type_)
    rest = type_.bounds[1:]
    width = rest[0][1] - rest[0][0] + 1 if rest else 1
    for number, value in enumerate(given):
        row = found[number // width] if rest else found
        row[number % width if rest else number] = initial(type_.element, value)
    return found


def copied(value: Any) -> Any:
    """Arrays and structures are assigned by value."""
    if isinstance(value, View):
        return value.copy()
    if isinstance(value, list):
        return [copied(v) for v in value]
    if isinstance(value, dict):
        return {k: copied(v) for k, v in value.items()}
    return value


def overwrite(place: Any, value: Any) -> None:
    """Puts the parts of an array or structure where they belong: pointers lead to them."""
    if isinstance(place, View) and isinstance(value, View):
        data = value.data()
        place.memory[place.offset : place.offset + len(data)] = data
        return
    for key in range(len(place)) if isinstance(place, list) else list(place.keys()):
        if isinstance(value, dict) and key not in value:
            continue  # a derived structure keeps what its base does not have
        if isinstance(place[key], list | dict | View):
            overwrite(place[key], value[key])
        else:
            place[key] = value[key]


def stored(value: Any, type_: Type) -> Any:
    """A value as a variable of a type holds it."""
    base = base_of(type_)
    if isinstance(type_, Subrange) and type_.checked:
        return min(max(convert(value, type_.base), type_.low), type_.high)
    if isinstance(base, Scalar):
        return convert(value, base)
    if isinstance(base, Text):
        return value[: base.length]
    if isinstance(base, Struct) and not base.union:
        return {name: copied(value[name]) for name, _ in base.members}
    return copied(value)


@dataclass
class Slot:
    """Where a value lies."""

    holder: Any
    key: Any
    bit: int | None = None

    def read(self) -> Any:
        value = self.holder[self.key]
        if isinstance(value, Slot):
            return value.read()
        return value if self.bit is None else bool(value >> self.bit & 1)

    def write(self, value: Any, type_: Type) -> None:
        inner = self.holder[self.key]
        if isinstance(inner, Slot):
            inner.write(value, type_)
        elif isinstance(inner, list | dict | View):
            overwrite(inner, copied(value))
        elif self.bit is None:
            self.holder[self.key] = stored(value, type_)
        else:
            base = base_of(type_)
            cleared = inner & ~(1 << self.bit)
            self.holder[self.key] = wrap(cleared | int(bool(value)) << self.bit, base)


@dataclass(frozen=True)
class Address:
    """Value of a pointer, a reference or an interface."""

    slot: Slot


@dataclass
class Frame:
    """Variables a body sees: its own first, then those of the instance."""

    scopes: list[dict[str, Any]]
    this: dict[str, Any] | None = None
    """The instance whose code runs."""

    def slot(self, name: str) -> Slot:
        for scope in self.scopes:
            if name in scope:
                return Slot(scope, name)
        raise KeyError(name)
