"""Where the variables of an expression lie: fixed places, and addresses that steps compute."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Protocol

from msgspec.structs import replace as replace_type

from tappet.codegen.expressions.program import Base, Kind, Op, Step
from tappet.codegen.symbol_map import SymbolError, SymbolMap, VarRef
from tappet.codegen.symbol_types import TypeInfo
from tappet.lang import types as t
from tappet.lang.types import Elementary

_TIMES = {
    "time": t.TIME, "ltime": t.LTIME, "date": t.DATE, "tod": t.TOD, "dt": t.DT, "ldate": t.LDATE,
    "ltod": t.LTOD, "ldt": t.LDT,
}  # fmt: skip
_BITS = {1: t.BYTE, 2: t.WORD, 4: t.DWORD, 8: t.LWORD}
_SIGNED = {1: t.SINT, 2: t.INT, 4: t.DINT, 8: t.LINT}
_UNSIGNED = {1: t.USINT, 2: t.UINT, 4: t.UDINT, 8: t.ULINT}


class ExpressionError(ValueError):
    """The expression cannot be evaluated in the runtime; the message says what is wrong, and what would be
    right."""


@dataclass(frozen=True, slots=True)
class Place:
    """A variable at an offset of a base, or behind an address that `steps` compute."""

    info: TypeInfo
    offset: int = 0
    base: Base = Base.IMAGE
    bit: int | None = None
    steps: tuple[Step, ...] | None = None
    path: str = ""
    """For messages."""

    def address(self) -> tuple[Step, ...]:
        """Steps that push where it lies."""
        if self.steps is None:
            return (Step(Op.ADDRESS, a=self.offset, b=self.base),)
        return (*self.steps, Step(Op.OFFSET, a=self.offset)) if self.offset else self.steps

    def load(self) -> tuple[Step, ...]:
        """Steps that push its value."""
        kind = Kind.USINT if self.bit is not None else kind_of(elementary_of(self.info, self.path))
        if self.steps is None:
            found: tuple[Step, ...] = (Step(Op.LOAD, kind, self.offset, self.base),)
        else:
            found = (*self.address(), Step(Op.FETCH, kind))
        if self.bit is not None:
            mask = (Step(Op.PUSH, a=1 << self.bit), Step(Op.BIT_AND))
            found = (*found, *mask, Step(Op.PUSH, a=0), Step(Op.NOT_EQUAL, Kind.LINT))
        return found

    def target(self, types: Sequence[TypeInfo]) -> Place:
        """What a pointer or reference leads to."""
        if self.info.kind not in ("pointer", "reference") or self.info.elem is None:
            raise ExpressionError(f"'{self.path}' ({self.info.name}) is no pointer")
        return Place(types[self.info.elem], steps=self.load(), path=f"{self.path}^")


class Scope(Protocol):
    """What names mean where an expression stands, before the variables of the application are looked at."""

    def find(self, name: str) -> Place | None:
        """A local variable, input or member."""

    def this(self) -> Place | None:
        """The instance whose code runs."""


class ApplicationScope:
    """No names of its own: an expression over the variables of the application."""

    def find(self, name: str) -> Place | None:
        """None."""
        return None

    def this(self) -> Place | None:
        """None."""
        return None


def elementary_of(info: TypeInfo, path: str) -> Elementary:
    """The elementary type that holds the values of a type; ExpressionError for what is no single value."""
    kind = info.base or "int" if info.kind == "enum" else info.kind
    if kind == "bool":
        return t.BOOL
    if kind == "real":
        return t.REAL if info.size == 4 else t.LREAL
    if kind in _TIMES:
        return _TIMES[kind]
    if kind in ("pointer", "reference", "interface"):
        return t.LWORD
    table = {"bits": _BITS, "int": _SIGNED, "uint": _UNSIGNED}.get(kind)
    if table is None or info.size not in table:
        raise ExpressionError(
            f"'{path}' ({info.name}) is no single number; an expression takes BOOL, numbers, times, dates and"
            " enumerations, or a member or element of it"
        )
    return table[info.size]


_KINDS = {
    "BOOL": Kind.BOOL, "SINT": Kind.SINT, "INT": Kind.INT, "DINT": Kind.DINT, "LINT": Kind.LINT,
    "REAL": Kind.REAL, "LREAL": Kind.LREAL,
}  # fmt: skip
_BY_SIZE = {1: Kind.USINT, 2: Kind.UINT, 4: Kind.UDINT, 8: Kind.ULINT}


def kind_of(type_: Elementary) -> Kind:
    """How values of a type lie in memory: bit strings, times and dates are unsigned numbers."""
    return _KINDS.get(type_.name) or _BY_SIZE[type_.size] if type_.name != "BOOL" else Kind.BOOL


def static_place(symbols: SymbolMap, path: str) -> Place | None:
    """The variable of a path without computed parts; None when there is none."""
    try:
        ref = symbols.resolve(path)
    except SymbolError:
        return None
    return place_at(ref)


def place_at(ref: VarRef) -> Place:
    """The place of a variable that the symbol map has found."""
    return Place(_referred(ref.type, ref.section), ref.offset, bit=ref.bit, path=ref.path)


def _referred(info: TypeInfo, section: str) -> TypeInfo:
    """A VAR_IN_OUT is kept as pointer and read as what it leads to."""
    return replace_type(info, kind="reference") if section == "VAR_IN_OUT" else info


def member_place(symbols: SymbolMap, base: Place, name: str) -> Place:
    """A member, or a bit, of a place."""
    if base.info.kind == "reference":
        base = base.target(symbols.types)
    path = f"{base.path}.{name}"
    if name.isdigit():
        bit = int(name)
        if base.bit is not None or base.info.kind not in ("bits", "int", "uint"):
            raise ExpressionError(f"'{base.path}' ({base.info.name}) has no bits")
        if bit >= base.info.size * 8:
            raise ExpressionError(f"'{base.path}': bit {bit} is outside 0..{base.info.size * 8 - 1}")
        info = TypeInfo("BOOL", "bool", 1)
        return replace(base, info=info, offset=base.offset + bit // 8, bit=bit % 8, path=path)
    for member in base.info.members:
        if member.name.upper() == name.upper():
            info = _referred(symbols.types[member.type], member.section)
            if member.absolute:
                return Place(info, member.offset, bit=member.bit, path=path)
            return replace(base, info=info, offset=base.offset + member.offset, bit=member.bit, path=path)
    if base.info.kind == "pointer":
        raise ExpressionError(f"'{base.path}' is a pointer; write ^ before the member '{name}'")
    raise ExpressionError(f"'{base.path}' ({base.info.name}) has no member '{name}'")


def element_place(symbols: SymbolMap, base: Place, indices: Sequence[tuple[Step, ...] | int]) -> Place:
    """An element of an array, or of what a pointer leads to; an index is a number or computed by steps."""
    if base.info.kind == "reference":
        base = base.target(symbols.types)
    if base.info.kind == "pointer":
        return _pointed(symbols, base, indices)
    if base.info.kind != "array" or base.info.elem is None:
        raise ExpressionError(f"'{base.path}' ({base.info.name}) is no array")
    bounds = base.info.bounds
    if len(bounds) != len(indices):
        raise ExpressionError(f"'{base.path}' needs {len(bounds)} indices, not {len(indices)}")
    element = symbols.types[base.info.elem]
    stride = element.size
    strides = []
    for low, high in reversed(bounds):
        strides.append(stride)
        stride *= high - low + 1
    offset = base.offset
    computed: list[Step] = []
    for index, (low, high), stride in zip(indices, bounds, reversed(strides), strict=True):
        if isinstance(index, int):
            if not low <= index <= high:
                raise ExpressionError(f"'{base.path}': index {index} is outside {low}..{high}")
            offset += (index - low) * stride
        elif stride >= 1 << 31:
            raise ExpressionError(f"'{base.path}' is too large for a computed index")
        else:
            computed += [*index, Step(Op.INDEX, stride, low, high)]
    path = f"{base.path}[{', '.join(str(i) if isinstance(i, int) else '...' for i in indices)}]"
    if not computed and base.steps is None:
        return replace(base, info=element, offset=offset, path=path)
    steps = (*replace(base, offset=offset).address(), *computed)
    return Place(element, steps=steps, path=path)


def _pointed(symbols: SymbolMap, base: Place, indices: Sequence[tuple[Step, ...] | int]) -> Place:
    if len(indices) != 1:
        raise ExpressionError(f"'{base.path}' takes one index")
    target = base.target(symbols.types)
    (index,) = indices
    path = f"{base.path}[{index if isinstance(index, int) else '...'}]"
    if isinstance(index, int):
        return replace(target, offset=index * target.info.size, path=path)
    scale = (Step(Op.PUSH, a=target.info.size), Step(Op.MULTIPLY, Kind.LINT), Step(Op.ADD, Kind.LINT))
    return Place(target.info, steps=(*target.address(), *index, *scale), path=path)
