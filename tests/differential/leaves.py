"""Leaves of random expressions: literals, and places over the variables of one scope."""

from __future__ import annotations

import struct
from collections.abc import Callable, Iterable
from dataclasses import dataclass, field
from random import Random
from typing import Any

import typed_tree as tree
from typed_tree import (
    BOOL,
    DATE,
    DINT,
    INT,
    INTEGERS,
    LDATE,
    LDT,
    LINT,
    LTOD,
    NUMBERS,
    REAL,
    TOD,
    Array,
    Block,
    Builtin,
    Deref,
    Enum,
    Expr,
    Get,
    Index,
    Literal,
    Member,
    Name,
    Pointer,
    Scalar,
    Struct,
    Text,
    Type,
    Variable,
    base_of,
)

_FLOATS = [0.0, -0.0, 1.0, -1.0, 0.5, 1.5, -2.5, 0.1, 3.0, 100.0, 1e10, 16777217.0, -1e-3, 127.5, 65535.5]
_SINGLE = [1.1754944e-38, 1.4e-45, 3.4028235e38, -3.4028235e38, 2147483648.0]
_DOUBLE = [5e-324, 2.2250738585072014e-308, 1.7976931348623157e308, -1e300, 9007199254740993.0, 9.3e18]
_WIDE = ["", "a", "\u00e4", "\u0162x", "\u4e2d\u6587", "abc", "zz\u25e6", "hello w\u00f6rld"]
_TEXTS = ["", "a", "A", "abc", "12", "TRUE", "x y", "zz9", "hello world", "0"]


DAY_NS = 86_400_000_000_000


def single(value: float) -> float:
    return float(struct.unpack("<f", struct.pack("<f", value))[0])


@dataclass
class Leaves:
    """Literals and variables; the subclass makes larger expressions of them."""

    r: Random
    variables: list[Variable] = field(default_factory=list)
    fixed: set[str] = field(default_factory=set)
    """Variables nothing is assigned to: counters and guards of loops."""
    texts: bool = True
    call: Callable[[Type, int], Expr | None] | None = None
    """Makes a call whose result counts as a type; None where expressions have no effects."""
    hidden: set[str] = field(default_factory=set)
    """Pointers that lead nowhere any more."""
    heap: set[str] = field(default_factory=set)
    """Pointers of __NEW: nothing else leads to where they lead."""
    bits: list[tuple[str, int]] = field(default_factory=list)
    """Constants that name bits."""
    properties: list[tree.Property] = field(default_factory=list)
    """Properties of the own instance that may be read in expressions."""

    def chance(self, percent: int) -> bool:
        return self.r.randrange(100) < percent

    # -- leaves -------------------------------------------------------------------------------------

    def literal_value(self, type_: Type) -> Any:
        """A value of a simple type; limits and small numbers are frequent."""
        r = self.r
        if isinstance(type_, Enum):
            return r.choice(type_.members)[1]
        if isinstance(type_, Text):
            return r.choice(_WIDE if type_.wide else _TEXTS)[: type_.length]
        if isinstance(type_, tree.Subrange):
            return r.randint(type_.low, type_.high)
        if isinstance(type_, tree.BitMember):
            return bool(r.randrange(2))
        assert isinstance(type_, Scalar)
        if type_ == BOOL:
            return bool(r.randrange(2))
        if type_.kind == "real":
            value = r.choice(_FLOATS + (_SINGLE if type_ == REAL else _SINGLE + _DOUBLE))
            return single(value) if type_ == REAL else value
        if type_.kind in ("time", "date"):
            number = r.choice(
                [0, 1, 7, 999, 1000, 12345, 86_399_999, 100_000, type_.high // type_.unit_ns // 3]
            )
            if type_ == DATE:
                return number // 86_400 * 86_400
            if type_.bits == 64:
                number = r.choice([0, 1, 999_999, 1_000_000, 123_456_789_012, 86_400_000_000_000, 2**40])
                step = {LDT: 1_000_000_000, LDATE: DAY_NS}.get(type_, 1)
                return number // step * step % (DAY_NS if type_ == LTOD else 1 << 64)
            return number % 86_400_000 if type_ == TOD else number
        near = [0, 1, 2, 3, 7, 100, type_.high, type_.low, type_.high - 1, type_.low + 1, type_.high // 2]
        if type_.low < 0:
            near += [-1, -2, -7]
        return r.choice(near) if self.chance(70) else r.randint(type_.low, type_.high)

    def literal(self, type_: Type, value: Any = None) -> Literal:
        if value is None:
            value = self.literal_value(type_)
        return Literal(type_, base_of(type_), True, value)

    def places(self, wanted: Any, writable: bool = False, depth: int = 2) -> list[Expr]:
        """All places of a kind: `wanted` is a test of the type."""
        found: list[Expr] = []
        for v in self.variables:
            if v.name in self.hidden or (writable and v.name in self.fixed):
                continue
            self._descend(Name(v.type, base_of(v.type), False, v.name), wanted, depth, found, writable)
        if not writable:
            for p in self.properties:
                own = Get(p.type, base_of(p.type), False, None, p.name, self.own_prefix())
                self._descend(own, wanted, depth, found, False)
        return found

    def _read(
        self, e: Expr, properties: Iterable[tree.Property], wanted: Any, depth: int, found: list[Expr]
    ) -> None:
        """Properties of an instance whose Get changes nothing, and their parts."""
        for p in properties:
            if p.pure:
                self._descend(Get(p.type, base_of(p.type), False, e, p.name), wanted, depth, found, False)

    def own_prefix(self) -> str:
        return self.r.choice(("", "THIS"))

    def _descend(self, e: Expr, wanted: Any, depth: int, found: list[Expr], writable: bool) -> None:
        if wanted(e.type):
            found.append(e)
        if depth == 0:
            return
        if isinstance(e.type, Struct):
            for name, type_ in e.type.members:
                self._descend(
                    Member(type_, base_of(type_), False, e, name), wanted, depth - 1, found, writable
                )
        elif isinstance(e.type, Array | tree.OpenArray):
            element = Index(e.type.element, base_of(e.type.element), False, e, [])
            self._descend(element, wanted, depth - 1, found, writable)
        elif isinstance(e.type, Pointer) and not isinstance(e.type.target, Block):
            inner = Deref(e.type.target, base_of(e.type.target), False, e)
            self._descend(inner, wanted, depth - 1, found, writable)
        elif isinstance(e.type, Pointer) and isinstance(e.type.target, Block) and not writable:
            inner = Deref(e.type.target, None, False, e)
            self._read(inner, e.type.target.all_properties.values(), wanted, depth - 1, found)
        elif isinstance(e.type, tree.Interface) and not writable:
            self._read(e, e.type.properties, wanted, depth - 1, found)
        elif isinstance(e.type, Block) and not writable:
            self._read(e, e.type.all_properties.values(), wanted, depth - 1, found)
            for v in e.type.outputs:
                self._descend(
                    Member(v.type, base_of(v.type), False, e, v.name), wanted, depth - 1, found, writable
                )

    def filled(self, e: Expr, depth: int) -> Expr:
        """A place with the indices its arrays need."""
        if isinstance(e, Member):
            return Member(e.type, e.held, False, self.filled(e.base, depth), e.name)
        if isinstance(e, Deref):
            return Deref(e.type, e.held, False, self.filled(e.base, depth))
        if isinstance(e, Index):
            base = self.filled(e.base, depth)
            if isinstance(base.type, tree.OpenArray):
                assert isinstance(base, Name)
                indices = [self.open_index(base, d, depth) for d in range(base.type.dimensions)]
                return Index(e.type, e.held, False, base, indices)
            assert isinstance(base.type, Array)
            return Index(e.type, e.held, False, base, [self.index(*b, depth) for b in base.type.bounds])
        return e

    def index(self, low: int, high: int, depth: int) -> Expr:
        """An index, nearly always inside the bounds."""
        if depth <= 0 or self.chance(40):
            return self.literal(DINT, self.r.randint(low, high))
        if self.chance(4):
            return self.moving(self.r.choice(INTEGERS), depth - 1)
        type_ = self.r.choice((INT, DINT, LINT))
        args: list[Expr] = [
            self.literal(type_, low),
            self.moving(type_, depth - 1),
            self.literal(type_, high),
        ]
        return Builtin(type_, type_, False, "LIMIT", args, [type_] * 3)

    def open_index(self, array: Name, dimension: int, depth: int) -> Expr:
        """An index of an open array, nearly always inside the bounds."""
        low, high = (tree.Bound(DINT, DINT, False, array, dimension, upper) for upper in (False, True))
        if depth <= 0 or self.chance(40):
            return self.r.choice((low, high))
        if self.chance(10):
            return self.literal(DINT, self.r.randint(-1, 3))
        args = [low, self.moving(DINT, 0), high]
        return Builtin(DINT, DINT, False, "LIMIT", args, [DINT] * 3)

    def variable(self, type_: Type, depth: int) -> Expr | None:
        """A place whose type counts as `type_`."""
        base = base_of(type_)
        exact = isinstance(type_, Enum)
        found = self.places(lambda t: t is type_ if exact else base_of(t) == base)
        return self.filled(self.r.choice(found), depth) if found else None

    def leaf(self, type_: Type, depth: int = 0) -> Expr:
        if self.chance(75):
            found = self.variable(type_, depth)
            if found is not None:
                return found
        return self.literal(type_)

    def moving(self, type_: Type, depth: int) -> Expr:
        """An expression that is no constant."""
        for _ in range(2):
            e = self.expr(type_, depth)
            if not e.constant:
                return e
        found = self.variable(type_, 0)
        if found is not None:
            return found
        other = self.places(lambda t: base_of(t) in NUMBERS)
        if isinstance(type_, Scalar) and type_ in (*NUMBERS, BOOL) and other:
            return self.converted(self.filled(self.r.choice(other), 0), type_)
        return self.literal(type_)

    def expr(self, type_: Type, depth: int) -> Expr:
        """An expression whose static type counts as `type_`."""
        return self.leaf(type_, depth)

    def converted(self, operand: Expr, target: Scalar) -> Expr:
        source = base_of(operand.type)
        return Builtin(target, target, operand.constant, "convert", [operand], [source])
