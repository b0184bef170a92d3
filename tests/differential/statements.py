"""Random statements over the expressions of `expressions`."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from random import Random
from typing import Any

import typed_tree as tree
from counting_loops import counting_loop
from expressions import Maker
from typed_tree import (
    BOOL,
    DINT,
    INT,
    NUMBERS,
    SINT,
    USINT,
    Array,
    Block,
    Enum,
    Expr,
    Function,
    Interface,
    Literal,
    Name,
    Pointer,
    Scalar,
    Struct,
    Subrange,
    Text,
    Type,
    Variable,
    base_of,
    derives,
    same_shape,
)
from typing_rules import assignable


@dataclass
class Body:
    """What may stand in the body that is being made."""

    maker: Maker
    room: list[Variable]
    """Where counters and guards of loops are declared."""
    functions: list[Function] = field(default_factory=list)
    returns: bool = False
    loops: int = 0
    owner: Block | None = None
    """The block whose methods can be called on THIS."""
    rank: int = 1 << 30
    """Methods below it can be called on THIS."""
    overrides: Function | None = None
    """The method that SUPER^ calls."""
    effects: Callable[[Body, Type, int], Expr | None] | None = None
    """Makes calls inside expressions; None where they have no effects."""

    def __post_init__(self) -> None:
        effects = self.effects
        if effects is not None:
            self.maker.call = lambda type_, depth: effects(self, type_, depth)


class Statements:
    """Statements; declarations come with the subclass."""

    def __init__(self, r: Random) -> None:
        self.r = r
        self.number = 0

    def fresh(self, prefix: str) -> str:
        self.number += 1
        return f"{prefix}{self.number}"

    def chance(self, percent: int) -> bool:
        return self.r.randrange(100) < percent

    def value(self, b: Body, target: Type, depth: int) -> Expr:
        """A value that may be assigned to `target`."""
        m = b.maker
        if isinstance(target, Array | Struct):
            places = m.places(lambda t: assignable(t, target))
            return m.filled(self.r.choice(places), 1)
        if m.call is not None and self.chance(5):
            chained = m.places(lambda t: t == target, writable=True)
            if chained:
                place = m.filled(self.r.choice(chained), 1)
                return tree.Chained(target, base_of(target), False, place, self.value(b, target, depth - 1))
        wanted: Type = target
        base = base_of(target)
        if not isinstance(target, Enum) and base in NUMBERS and self.chance(35):
            wanted = self.r.choice([t for t in NUMBERS if assignable(t, base)])
        found = m.expr(wanted, depth)
        if found.constant and not (isinstance(found, Literal) and found.type == wanted == target):
            found = m.moving(wanted, depth)
            if found.constant:
                return m.literal(target)
        return found

    def target(self, b: Body) -> Expr | None:
        m = b.maker
        if self.chance(8):
            bit = m.bit_place(1, writable=True)
            if bit is not None:
                return bit
        other = Block | Pointer | Interface | tree.OpenArray
        simple = list(m.places(lambda t: not isinstance(t, other), writable=True))
        return m.filled(self.r.choice(simple), 1) if simple else None

    def statements(self, b: Body, count: int, depth: int) -> list[Any]:
        found: list[Any] = []
        for _ in range(count):
            found += self.statement(b, depth)
        return found

    def further(self, b: Body, depth: int) -> list[Any]:
        """A statement that a subclass knows, or nothing."""
        return []

    def statement(self, b: Body, depth: int) -> list[Any]:
        if depth > 0 and (found := self.further(b, depth)):
            return found
        choice = self.r.randrange(100)
        if depth > 0 and choice < 40:
            if choice < 14:
                return [self._if(b, depth)]
            if choice < 20:
                return [self._case(b, depth)]
            return [counting_loop(self, b, depth) if choice < 32 else self._while(b, depth)]
        if choice < 52:
            called = self._call(b)
            if called is not None:
                return [called]
        if choice < 57:
            accessed = self._property(b)
            if accessed is not None:
                return [accessed]
        if choice < 60:
            bound = self.bind(b)
            if bound is not None:
                return [bound]
        if choice < 65 and (b.loops or b.returns):
            words = (["EXIT", "CONTINUE"] if b.loops else []) + (["RETURN"] if b.returns else [])
            return [tree.If([(b.maker.moving(BOOL, 2), [tree.Jump(self.r.choice(words))])], [])]
        target = self.target(b)
        if target is None:
            return []
        if target.type == BOOL and self.chance(25):
            return [tree.Assign(target, b.maker.expr(BOOL, 2), self.r.choice(("S=", "R=")))]
        return [tree.Assign(target, self.value(b, target.type, 3))]

    def _if(self, b: Body, depth: int) -> tree.If:
        branches = [
            (b.maker.moving(BOOL, 3), self.statements(b, self.r.randint(1, 2), depth - 1))
            for _ in range(self.r.randint(1, 2))
        ]
        return tree.If(branches, self.statements(b, self.r.randint(0, 2), depth - 1))

    def _case(self, b: Body, depth: int) -> tree.Case:
        selector = b.maker.moving(self.r.choice((INT, USINT, DINT, SINT, tree.WORD, tree.LINT)), 2)
        limited = any(isinstance(v.type, Subrange) for v in b.maker.variables)
        if limited or isinstance(selector.type, Subrange):  # labels outside its limits would be refused
            selector = b.maker.negative(selector)
        branches, number = [], self.r.choice([0, 0, 1, -3 if base_of(selector.type).low < 0 else 2])
        for _ in range(self.r.randint(1, 3)):
            ranges = []
            for _ in range(self.r.randint(1, 2)):
                last = number + self.r.choice([0, 0, 3])
                ranges.append((number, last))
                number = last + self.r.randint(1, 3)
            branches.append((ranges, self.statements(b, 1, depth - 1)))
        return tree.Case(selector, branches, self.statements(b, self.r.randint(0, 1), depth - 1))

    def loop_variable(self, b: Body, prefix: str, type_: Scalar) -> Name:
        made = Variable(self.fresh(prefix), type_)
        b.room.append(made)
        if b.room is not b.maker.variables:
            b.maker.variables.append(made)
        b.maker.fixed.add(made.name)
        return Name(type_, type_, False, made.name)

    def _while(self, b: Body, depth: int) -> tree.While:
        condition = b.maker.moving(BOOL, 2)
        guard = self.loop_variable(b, "g", DINT)
        b.loops += 1
        body = self.statements(b, self.r.randint(1, 3), depth - 1)
        b.loops -= 1
        return tree.While(condition, guard, self.r.randint(1, 6), body, self.chance(50))

    def bind(self, b: Body, target: Variable | None = None) -> tree.Bind | None:
        """Makes a pointer, a reference or an interface of the body lead somewhere."""
        own = [v for v in b.room if isinstance(v.type, Pointer | Interface) and v.name not in b.maker.heap]
        if target is None and not own:
            return None
        target = target or self.r.choice(own)
        kind = target.type
        if isinstance(kind, Interface):
            found = self._blocks(b, lambda t: any(kind in x.interfaces for x in _line(t)))
        elif isinstance(kind, Pointer) and isinstance(kind.target, Block):
            found = self._blocks(b, lambda t: t.is_a(kind.target))
        else:
            assert isinstance(kind, Pointer)
            found = b.maker.places(lambda t: _leads_to(kind, t), writable=True)
            found = [e for e in found if not isinstance(e, tree.Deref) and _root(e) not in b.maker.heap]
        if not found:
            return None
        place = b.maker.filled(self.r.choice(found), 1)
        return tree.Bind(Name(kind, None, False, target.name), place)

    def _blocks(self, b: Body, wanted: Any) -> list[Expr]:
        """Instances that are variables of the body."""
        return [
            Name(v.type, None, False, v.name)
            for v in b.maker.variables
            if isinstance(v.type, Block) and wanted(v.type)
        ]

    def _owners(self, b: Body) -> list[Expr]:
        """Instances, interfaces, and what pointers to blocks lead to."""
        places: list[Expr] = []
        for v in b.maker.variables:
            name = Name(v.type, None, False, v.name)
            if v.name in b.maker.hidden:
                continue
            if isinstance(v.type, Block | Interface):
                places.append(name)
            elif isinstance(v.type, Pointer) and isinstance(v.type.target, Block):
                places.append(tree.Deref(v.type.target, None, False, name))
        return places

    def _callee(self, b: Body) -> tuple[list[Function], Expr | None, str]:
        """Functions to choose from, the instance they belong to, or THIS."""
        places = self._owners(b)
        if places and self.chance(60):
            place = self.r.choice(places)
            return list(_methods(place.type)), place, ""
        if b.owner is not None and self.chance(60):
            below = [m for m in b.owner.all_methods.values() if m.rank < b.rank]
            if below:
                return below, None, "THIS"
        return b.functions, None, ""

    def _call(self, b: Body) -> Any:
        m = b.maker
        if b.overrides is not None and self.chance(40):
            return self._call_function(b, [b.overrides], None, "SUPER")
        functions, place, via = self._callee(b)
        exact = isinstance(place, Name) and isinstance(place.type, Block)
        if exact and (not functions or self.chance(50)):
            assert place is not None
            assert isinstance(place.type, Block)
            inputs = [v for v in place.type.all_inputs if self.chance(80)]
            inputs = [v for v in inputs if self.can_give(m, v.type)]
            given = [(v.name, self.value(b, v.type, 2)) for v in inputs]
            called = tree.CallBlock(place, given, self._outputs(b, place.type.outputs))
            if self.chance(15):
                called.enable = m.moving(BOOL, 2)
            answers = m.places(lambda t: t == BOOL, writable=True)
            if answers and self.chance(15):
                called.success = m.filled(self.r.choice(answers), 1)
            return called
        return self._call_function(b, functions, place, via)

    def _property(self, b: Body) -> tree.Assign | None:
        """Reads or writes a property, also one whose Get has effects."""
        m = b.maker
        found: list[tuple[tree.Property, Expr | None, str]] = []
        for place in self._owners(b):
            known = place.type.properties if isinstance(place.type, Interface) else _properties(place.type)
            found += [(p, place, "") for p in known]
        if b.owner is not None:
            via = self.r.choice(("", "THIS"))
            found += [(p, None, via) for p in b.owner.all_properties.values() if p.rank < b.rank]
        if not found:
            return None
        p, owner, via = self.r.choice(found)
        place = tree.Get(p.type, base_of(p.type), False, owner, p.name, via)
        if self.chance(55) and self.can_give(m, p.type):
            if p.type == BOOL and self.chance(50):
                return tree.Assign(place, m.expr(BOOL, 2), self.r.choice(("S=", "R=")))
            return tree.Assign(place, self.value(b, p.type, 2))
        targets = m.places(lambda t: assignable(p.type, t), writable=True)
        return tree.Assign(m.filled(self.r.choice(targets), 1), place) if targets else None

    def can_give(self, m: Maker, type_: Type) -> bool:
        """Whether there is a value of a type: arrays and structures have no literals."""
        return not isinstance(type_, Array | Struct) or bool(m.places(lambda t: assignable(t, type_)))

    def _call_function(self, b: Body, functions: list[Function], place: Expr | None, via: str) -> Any:
        m = b.maker
        if not functions:
            return None
        function = self.r.choice(functions)
        targets = m.places(lambda t: assignable(function.result, t), writable=True)
        if not targets:
            return None
        call = self._with_arguments(b, function, place, via, 2)
        if call is not None:
            call.target = m.filled(self.r.choice(targets), 1)
        return call

    def _with_arguments(
        self, b: Body, function: Function, place: Expr | None, via: str, depth: int
    ) -> tree.CallFunction | None:
        m = b.maker
        places = [m.places(lambda t, v=v: _fits(t, v.type), writable=True) for v in function.in_outs]
        if not all(places) or not all(self.can_give(m, v.type) for v in function.inputs):
            return None
        in_outs = [m.filled(self.r.choice(found), 1) for found in places]
        inputs = [self.value(b, v.type, depth) for v in function.inputs]
        outputs = self._outputs(b, function.outputs)
        return tree.CallFunction(None, function, inputs, in_outs, place, via, outputs)

    def _outputs(self, b: Body, outputs: list[Variable]) -> list[tuple[str, Expr]]:
        """Where some outputs go."""
        found = []
        for v in outputs:
            places = b.maker.places(lambda t, v=v: t == v.type, writable=True)
            if places and self.chance(60):
                found.append((v.name, b.maker.filled(self.r.choice(places), 1)))
        return found

    def applied(self, b: Body, type_: Type, depth: int) -> Expr | None:
        """A call inside an expression, whose result counts as a type."""
        functions, place, via = self._callee(b)

        def counts(t: Type) -> bool:
            if isinstance(type_, Enum):
                return t is type_
            if isinstance(type_, Text):
                return isinstance(t, Text) and t.wide == type_.wide
            return base_of(t) == base_of(type_)

        fitting = [f for f in functions if counts(f.result)]
        if not fitting:
            return None
        function = self.r.choice(fitting)
        call = self._with_arguments(b, function, place, via, min(depth, 1))
        result = function.result
        return None if call is None else tree.Applied(result, base_of(result), False, call)


def _root(e: Expr) -> str:
    """The variable a place belongs to."""
    while not isinstance(e, Name):
        e = e.base  # type: ignore[attr-defined]
    return e.name


def _fits(given: Type, in_out: Type) -> bool:
    """Whether a place may stand for an in-out."""
    if isinstance(in_out, tree.OpenArray) and isinstance(given, Array):
        return given.element == in_out.element and len(given.bounds) == in_out.dimensions
    return same_shape(given, in_out) or derives(given, in_out)


def _leads_to(pointer: Pointer, given: Type) -> bool:
    """Whether a pointer may have the address of a place."""
    return derives(given, pointer.target) or (
        given == pointer.target if pointer.ref_to else same_shape(given, pointer.target)
    )


def _line(block: Block | None) -> list[Block]:
    """A block and what it extends."""
    return [] if block is None else [block, *_line(block.base)]


def _properties(type_: Type) -> list[tree.Property]:
    assert isinstance(type_, Block)
    return list(type_.all_properties.values())


def _methods(type_: Type) -> list[Function]:
    assert isinstance(type_, Block | Interface)
    return list(type_.all_methods.values()) if isinstance(type_, Block) else type_.methods
