"""Random well-typed programs: declarations and statements over the expressions of `expressions`."""

from __future__ import annotations

from dataclasses import dataclass, field
from random import Random
from typing import Any

import typed_tree as tree
from expressions import CLOCKS, Maker
from typed_tree import (
    BOOL,
    DINT,
    INT,
    INTEGERS,
    NUMBERS,
    REALS,
    SINT,
    UINT,
    USINT,
    Array,
    Block,
    Enum,
    Expr,
    Function,
    Literal,
    Name,
    Program,
    Scalar,
    Struct,
    Subrange,
    Text,
    Type,
    Variable,
    assignable,
    base_of,
)


@dataclass
class Body:
    """What may stand in the body that is being made."""

    maker: Maker
    room: list[Variable]
    """Where counters and guards of loops are declared."""
    functions: list[Function] = field(default_factory=list)
    returns: bool = False
    loops: int = 0


class ProgramMaker:
    """One random program."""

    def __init__(self, r: Random, texts: bool = True, size: int = 10) -> None:
        self.r = r
        self.texts = texts
        self.size = size
        self.number = 0
        self.types: list[Enum | Struct] = []
        self.functions: list[Function] = []
        self.blocks: list[Block] = []

    def fresh(self, prefix: str) -> str:
        self.number += 1
        return f"{prefix}{self.number}"

    # -- declarations -------------------------------------------------------------------------------

    def scalar(self) -> Scalar:
        choice = self.r.randrange(100)
        if choice < 60:
            return self.r.choice(INTEGERS)
        if choice < 75:
            return self.r.choice(REALS)
        return BOOL if choice < 88 else self.r.choice(CLOCKS)

    def simple(self) -> Type:
        choice = self.r.randrange(100)
        enums = [t for t in self.types if isinstance(t, Enum)]
        if choice < 8 and enums:
            return self.r.choice(enums)
        if choice < 16:
            base = self.r.choice((INT, DINT, USINT, UINT, SINT))
            low = self.r.choice([0, 1, 5, -10 if base.low < 0 else 2])
            return Subrange(base, low, low + self.r.choice([1, 10, 100]))
        if choice < 26 and self.texts:
            return Text(self.r.choice([3, 5, 12, 20]))
        return self.scalar()

    def type(self, depth: int = 2) -> Type:
        choice = self.r.randrange(100)
        structs = [t for t in self.types if isinstance(t, Struct)]
        if choice < 15 and depth:
            bounds = tuple(self.bound() for _ in range(1 if self.chance(70) else 2))
            return Array(self.type(depth - 1), bounds)
        if choice < 25 and structs and depth:
            return self.r.choice(structs)
        return self.simple()

    def bound(self) -> tuple[int, int]:
        low = self.r.choice([0, 0, 1, -2, 5])
        return low, low + self.r.randint(0, 4)

    def chance(self, percent: int) -> bool:
        return self.r.randrange(100) < percent

    def variable(self, prefix: str, type_: Type | None = None) -> Variable:
        type_ = type_ or self.type()
        maker = Maker(self.r)
        simple = not isinstance(type_, Array | Struct | Block)
        initial = maker.literal_value(type_) if simple and self.chance(75) else None
        return Variable(self.fresh(prefix), type_, initial)

    def declare_types(self) -> None:
        for _ in range(self.r.randint(0, 2)):
            name, number, members = self.fresh("E_"), -1, []
            for _ in range(self.r.randint(2, 4)):
                number += self.r.choice([1, 1, 2, 10])
                members.append((self.fresh("v"), number))
            self.types.append(Enum(name, self.r.choice((INT, INT, DINT, USINT)), tuple(members)))
        for _ in range(self.r.randint(0, 2)):
            members_ = tuple((self.fresh("m"), self.type(1)) for _ in range(self.r.randint(1, 4)))
            self.types.append(Struct(self.fresh("S_"), members_))

    def function(self, block: Block | None = None) -> Function:
        made = Function(self.fresh("M" if block else "F"), self.simple())
        made.inputs = [self.variable("a", self.simple()) for _ in range(self.r.randint(0, 3))]
        made.inputs = [Variable(v.name, v.type) for v in made.inputs]
        made.in_outs = [Variable(self.fresh("io"), self.type(1)) for _ in range(self.r.randint(0, 2))]
        made.locals = [self.variable("l") for _ in range(self.r.randint(0, 3))]
        result = Variable(made.name, made.result)
        maker = Maker(self.r, [*made.inputs, *made.in_outs, *made.locals, result], texts=self.texts)
        if block is not None:
            maker.variables += block.members
        body = Body(maker, made.locals, list(self.functions), returns=True)
        made.body = self.statements(body, self.r.randint(1, 4), 2)
        own = Name(made.result, base_of(made.result), False, made.name)
        made.body.append(tree.Assign(own, self.value(body, made.result, 2)))
        return made

    def block(self) -> Block:
        made = Block(self.fresh("FB_"))
        made.inputs = [self.variable("i", self.simple()) for _ in range(self.r.randint(1, 3))]
        made.outputs = [self.variable("o", self.simple()) for _ in range(self.r.randint(1, 2))]
        made.locals = [self.variable("s") for _ in range(self.r.randint(1, 3))]
        if self.blocks and self.chance(50):
            made.locals.append(Variable(self.fresh("fb"), self.r.choice(self.blocks)))
        for _ in range(self.r.randint(0, 2)):
            made.methods.append(self.function(made))
        body = Body(
            Maker(self.r, list(made.members), texts=self.texts),
            made.locals,
            list(self.functions),
            returns=True,
        )
        made.body = self.statements(body, self.r.randint(1, 5), 2)
        return made

    def program(self) -> Program:
        self.declare_types()
        for _ in range(self.r.randint(0, 2)):
            self.functions.append(self.function())
        for _ in range(self.r.randint(0, 2)):
            self.blocks.append(self.block())
        variables = [self.variable("p") for _ in range(self.r.randint(3, 8))]
        variables += [self.variable("n", t) for t in self.r.sample(NUMBERS, 3)]
        variables += [Variable(self.fresh("fb"), b) for b in self.blocks]
        body = Body(Maker(self.r, list(variables), texts=self.texts), variables, self.functions)
        statements = self.statements(body, self.r.randint(2, self.size), 3)
        return Program(self.types, self.functions, self.blocks, variables, statements, self.r.randint(1, 3))

    # -- statements ---------------------------------------------------------------------------------

    def value(self, b: Body, target: Type, depth: int) -> Expr:
        """A value that may be assigned to `target`."""
        m = b.maker
        if isinstance(target, Array | Struct):
            places = m.places(lambda t: t == target)
            return m.filled(self.r.choice(places), 1)
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
        simple = list(m.places(lambda t: not isinstance(t, Block), writable=True))
        return m.filled(self.r.choice(simple), 1) if simple else None

    def statements(self, b: Body, count: int, depth: int) -> list[Any]:
        found: list[Any] = []
        for _ in range(count):
            found += self.statement(b, depth)
        return found

    def statement(self, b: Body, depth: int) -> list[Any]:
        choice = self.r.randrange(100)
        if depth > 0 and choice < 40:
            if choice < 14:
                return [self._if(b, depth)]
            if choice < 20:
                return [self._case(b, depth)]
            return [self._for(b, depth) if choice < 32 else self._while(b, depth)]
        if choice < 52:
            called = self._call(b)
            if called is not None:
                return [called]
        if choice < 57 and (b.loops or b.returns):
            words = (["EXIT", "CONTINUE"] if b.loops else []) + (["RETURN"] if b.returns else [])
            return [tree.If([(b.maker.moving(BOOL, 2), [tree.Jump(self.r.choice(words))])], [])]
        target = self.target(b)
        if target is None:
            return []
        return [tree.Assign(target, self.value(b, target.type, 3))]

    def _if(self, b: Body, depth: int) -> tree.If:
        branches = [
            (b.maker.moving(BOOL, 3), self.statements(b, self.r.randint(1, 2), depth - 1))
            for _ in range(self.r.randint(1, 2))
        ]
        return tree.If(branches, self.statements(b, self.r.randint(0, 2), depth - 1))

    def _case(self, b: Body, depth: int) -> tree.Case:
        selector = b.maker.moving(self.r.choice((INT, USINT, DINT, SINT, tree.WORD, tree.LINT)), 2)
        if isinstance(selector.type, Subrange):  # labels outside its limits would be refused
            selector = tree.Unary(selector.held, DINT, False, "-", selector)
        branches, number = [], self.r.choice([0, 0, 1, -3 if base_of(selector.type).low < 0 else 2])
        for _ in range(self.r.randint(1, 3)):
            ranges = []
            for _ in range(self.r.randint(1, 2)):
                last = number + self.r.choice([0, 0, 3])
                ranges.append((number, last))
                number = last + self.r.randint(1, 3)
            branches.append((ranges, self.statements(b, 1, depth - 1)))
        return tree.Case(selector, branches, self.statements(b, self.r.randint(0, 1), depth - 1))

    def _loop_variable(self, b: Body, prefix: str, type_: Scalar) -> Name:
        made = Variable(self.fresh(prefix), type_)
        b.room.append(made)
        if b.room is not b.maker.variables:
            b.maker.variables.append(made)
        b.maker.fixed.add(made.name)
        return Name(type_, type_, False, made.name)

    def _for(self, b: Body, depth: int) -> tree.For:
        type_ = self.r.choice(INTEGERS)
        signed = type_.kind == "signed"
        step = self.r.choice([1, 1, 1, 2, *([-1, -3] if signed else [])])
        first, last = self.r.choice([0, 1, -2 if signed else 2]), self.r.randint(0, 5)
        if step < 0:
            first, last = last, first
        stop: Expr = b.maker.literal(type_, last)
        if self.chance(30):
            limits: list[Expr] = [b.maker.literal(type_, v) for v in (0, 5)]
            stop = tree.Builtin(
                type_, type_, False, "LIMIT", [limits[0], b.maker.moving(type_, 1), limits[1]], [type_] * 3
            )
        counter = self._loop_variable(b, "k", type_)
        b.loops += 1
        body = self.statements(b, self.r.randint(1, 3), depth - 1)
        b.loops -= 1
        return tree.For(counter, b.maker.literal(type_, first), stop, step, body)

    def _while(self, b: Body, depth: int) -> tree.While:
        condition = b.maker.moving(BOOL, 2)
        guard = self._loop_variable(b, "g", DINT)
        b.loops += 1
        body = self.statements(b, self.r.randint(1, 3), depth - 1)
        b.loops -= 1
        return tree.While(condition, guard, self.r.randint(1, 6), body, self.chance(50))

    def _call(self, b: Body) -> Any:
        m = b.maker
        instances = [v for v in m.variables if isinstance(v.type, Block)]
        instance = self.r.choice(instances) if instances and self.chance(60) else None
        functions = b.functions
        place: Expr | None = None
        if instance is not None:
            assert isinstance(instance.type, Block)
            place = Name(instance.type, None, False, instance.name)
            functions = instance.type.methods
            if not functions or self.chance(50):
                inputs = [v for v in instance.type.inputs if self.chance(80)]
                return tree.CallBlock(place, [(v.name, self.value(b, v.type, 2)) for v in inputs])
        if not functions:
            return None
        function = self.r.choice(functions)
        targets = m.places(lambda t: assignable(function.result, t), writable=True)
        places = [m.places(lambda t, v=v: t == v.type, writable=True) for v in function.in_outs]
        if not targets or not all(places):
            return None
        in_outs = [m.filled(self.r.choice(found), 1) for found in places]
        inputs_ = [self.value(b, v.type, 2) for v in function.inputs]
        return tree.CallFunction(m.filled(self.r.choice(targets), 1), function, inputs_, in_outs, place)
