"""Random well-typed programs: declarations around the statements of `statements`."""

from __future__ import annotations

from random import Random
from typing import Any

import typed_tree as tree
from expressions import CLOCKS, Maker
from guarded_statements import GuardedStatements
from statements import Body
from typing_rules import assignable


class ProgramMaker(GuardedStatements):
    """One random program."""

    def __init__(self, r: Random, texts: bool = True, size: int = 10) -> None:
        super().__init__(r)
        self.texts = texts
        self.size = size
        self.types: list[tree.Enum | tree.Struct] = []
        self.arrays: list[tree.Array] = []
        self.functions: list[tree.Function] = []
        self.blocks: list[tree.Block] = []
        self.interfaces: list[tree.Interface] = []
        self.globals: list[tree.Variable] = []
        self.plain = Maker(r, texts=texts)
        self.bits: list[tuple[str, int]] = []
        self.checks = self.chance(25)

    # -- declarations -------------------------------------------------------------------------------

    def scalar(self) -> tree.Scalar:
        choice = self.r.randrange(100)
        if choice < 60:
            return self.r.choice(tree.INTEGERS)
        if choice < 75:
            return self.r.choice(tree.REALS)
        return tree.BOOL if choice < 88 else self.r.choice(CLOCKS)

    def simple(self) -> tree.Type:
        choice = self.r.randrange(100)
        enums = [t for t in self.types if isinstance(t, tree.Enum)]
        if choice < 8 and enums:
            return self.r.choice(enums)
        if choice < 16:
            base = self.r.choice((tree.INT, tree.DINT, tree.USINT, tree.UINT, tree.SINT))
            low = self.r.choice([0, 1, 5, -10 if base.low < 0 else 2])
            return tree.Subrange(base, low, low + self.r.choice([1, 10, 100]), self.checks)
        if choice < 26 and self.texts:
            return tree.Text(self.r.choice([3, 5, 12, 20]), self.chance(30))
        return self.scalar()

    def type(self, depth: int = 2) -> tree.Type:
        choice = self.r.randrange(100)
        structs = [t for t in self.types if isinstance(t, tree.Struct)]
        if choice < 15 and depth:
            if self.arrays and self.chance(40):
                return self.moved(self.r.choice(self.arrays))
            bounds = tuple(self.bound() for _ in range(1 if self.chance(70) else 2))
            self.arrays.append(tree.Array(self.type(depth - 1), bounds))
            return self.arrays[-1]
        if choice < 25 and structs and depth:
            return self.r.choice(structs)
        return self.simple()

    def moved(self, known: tree.Array) -> tree.Array:
        """An array type with the elements of another one, and perhaps other bounds."""
        shifts = [self.r.choice((0, 1, -3, 7)) for _ in known.bounds]
        bounds = ((low + s, high + s) for (low, high), s in zip(known.bounds, shifts, strict=True))
        return tree.Array(known.element, tuple(bounds))

    def bound(self) -> tuple[int, int]:
        low = self.r.choice([0, 0, 1, -2, 5])
        return low, low + self.r.randint(0, 4)

    def variable(self, prefix: str, type_: tree.Type | None = None) -> tree.Variable:
        type_ = type_ or self.type()
        maker = Maker(self.r)
        simple = not isinstance(type_, tree.Block | tree.Pointer | tree.Interface) and initialisable(type_)
        initial = self.initial(maker, type_) if simple and self.chance(75) else None
        return tree.Variable(self.fresh(prefix), type_, initial)

    def initial(self, maker: Maker, type_: tree.Type) -> Any:
        """An initial value; arrays and structures may leave parts open."""
        if isinstance(type_, tree.Struct):
            fitting = [(n, t) for n, t in type_.members if initialisable(t)]
            given = [m for m in fitting if self.chance(70)] or fitting[:1]
            return {n: self.initial(maker, t) for n, t in given}
        if not isinstance(type_, tree.Array):
            return maker.literal_value(type_)
        size = 1
        for low, high in type_.bounds:
            size *= high - low + 1
        value = self.initial(maker, type_.element)
        return [
            value if self.chance(40) else self.initial(maker, type_.element)
            for _ in range(self.r.randint(1, size))
        ]

    def declare_types(self) -> None:
        for _ in range(self.r.randint(0, 2)):
            name, number, members = self.fresh("E_"), -1, []
            for _ in range(self.r.randint(2, 4)):
                number += self.r.choice([1, 1, 2, 10])
                members.append((self.fresh("v"), number))
            self.types.append(
                tree.Enum(name, self.r.choice((tree.INT, tree.INT, tree.DINT, tree.USINT)), tuple(members))
            )
        for _ in range(self.r.randint(0, 2)):
            members_ = tuple((self.fresh("m"), self.type(1)) for _ in range(self.r.randint(1, 4)))
            self.types.append(self.packed(tree.Struct(self.fresh("S_"), members_)))
            if self.chance(50):
                self.types.append(self.derived(self.types[-1]))
            if self.chance(50):
                self.types.append(self.union())

    def derived(self, base: tree.Enum | tree.Struct) -> tree.Struct:
        """A structure that extends another one."""
        assert isinstance(base, tree.Struct)
        own = tuple((self.fresh("m"), self.type(1)) for _ in range(self.r.randint(1, 3)))
        return tree.Struct(self.fresh("S_"), base.members + own, base=base)

    def given(self) -> tree.Type:
        """Type of an input or a result: arrays and structures, too, are handed over by value."""
        return self.type(1) if self.chance(25) else self.simple()

    def function(
        self, block: tree.Block | None = None, overrides: tree.Function | None = None
    ) -> tree.Function:
        if overrides is not None:
            made = tree.Function(overrides.name, overrides.result, overrides.inputs, overrides.in_outs)
            made.outputs = overrides.outputs
            made.rank = overrides.rank
        else:
            made = tree.Function(self.fresh("M" if block else "F"), self.given())
            made.inputs = [tree.Variable(self.fresh("a"), self.given()) for _ in range(self.r.randint(0, 3))]
            made.in_outs = [
                tree.Variable(self.fresh("io"), self.open_array() if self.chance(30) else self.type(1))
                for _ in range(self.r.randint(0, 2))
            ]
            made.outputs = [
                tree.Variable(self.fresh("o"), self.given()) for _ in range(self.r.choice((0, 0, 1, 2)))
            ]
            made.rank = self.number
        made.locals = [self.variable("l") for _ in range(self.r.randint(0, 3))]
        made.statics = [self.variable("st") for _ in range(self.r.choice((0, 0, 1, 2)))]
        if block is not None:
            made.kept = [self.variable("vi") for _ in range(self.r.choice((0, 0, 1)))]
        result = tree.Variable(made.name, made.result)
        seen = [*made.inputs, *made.in_outs, *made.outputs, *made.locals, *made.statics, *made.kept, result]
        maker = Maker(self.r, [*seen, *self.globals], texts=self.texts, bits=self.bits)
        if block is not None:
            known = block.all_properties.values()
            maker.properties = [p for p in known if p.pure and p.rank < made.rank]
            hidden = tree.Pointer | tree.Interface  # whether they lead somewhere by now is not known
            maker.variables += [v for v in block.members if not isinstance(v.type, hidden)]
        body = Body(
            maker, made.locals, list(self.functions), True, 0, block, made.rank, overrides, self.applied
        )
        made.body = [*self.pointers(body), *self.statements(body, self.r.randint(1, 4), 2)]
        own = tree.Name(made.result, tree.base_of(made.result), False, made.name)
        made.body.append(tree.Assign(own, self.value(body, made.result, 2)))
        return made

    def property(self, block: tree.Block, overrides: tree.Property | None = None) -> tree.Property:
        """A property; what it overrides keeps its type and whether Get has effects."""
        if overrides is not None:
            name, type_, pure, rank = overrides.name, overrides.type, overrides.pure, overrides.rank
        else:
            name, type_, pure = self.fresh("Q"), self.given(), self.chance(60)
            rank = self.number
        value = tree.Variable(name, type_)
        getter, setter = tree.Function(name, type_), tree.Function(name, type_, [value])
        for made in (getter, setter):
            made.rank = rank
            shown = [v for v in block.members if not isinstance(v.type, tree.Pointer | tree.Interface)]
            own = [p for p in block.all_properties.values() if p.pure and p.rank < rank]
            maker = Maker(self.r, [value, *shown, *self.globals], texts=self.texts, properties=own)
            effects = None if pure and made is getter else self.applied
            body = Body(maker, made.locals, list(self.functions), True, 0, block, rank, None, effects)
            if made is setter:
                maker.fixed.add(name)
                made.body = self.statements(body, self.r.randint(1, 3), 1)
                targets = maker.places(lambda t: assignable(type_, t), writable=True)
                if targets:
                    place = maker.filled(self.r.choice(targets), 1)
                    made.body.append(tree.Assign(place, tree.Name(type_, tree.base_of(type_), False, name)))
                continue
            if not pure:
                made.locals.append(self.variable("l"))
                maker.variables += made.locals
                made.body = self.statements(body, self.r.randint(1, 3), 1)
            result = tree.Name(type_, tree.base_of(type_), False, name)
            made.body.append(tree.Assign(result, self.value(body, type_, 2)))
            if overrides is not None and self.chance(30):
                base = tree.Get(type_, tree.base_of(type_), False, None, name, "SUPER", overrides)
                made.body.append(tree.Assign(result, base))
        return tree.Property(name, type_, getter, setter, pure)

    def pointers(self, b: Body) -> list[Any]:
        """Declares a few pointers and references in the room of a body, and makes them lead somewhere."""
        bound: list[Any] = []
        for _ in range(self.r.choice((0, 0, 1, 2))):
            places = b.maker.places(self.pointed_at, writable=True)
            if not places:
                continue
            target = self.r.choice(places).type
            kind = self.r.randrange(3)
            pointer = tree.Variable(self.fresh("ptr"), tree.Pointer(target, kind == 0, kind == 1))
            bound += self.lead(b, pointer)
        return bound

    def lead(self, b: Body, pointer: tree.Variable) -> list[Any]:
        """Declares a pointer; nothing is done through it before it leads somewhere."""
        first = self.bind(b, pointer)
        if first is None:
            return []
        b.room.append(pointer)
        if b.room is not b.maker.variables:
            b.maker.variables.append(pointer)
        return [first]

    def to_block(self, block: tree.Block) -> tree.Pointer:
        kind = self.r.randrange(3)
        return tree.Pointer(block, kind == 0, kind == 1)

    def pointed_at(self, type_: tree.Type) -> bool:
        return not isinstance(
            type_, tree.Block | tree.Pointer | tree.Interface | tree.BitMember | tree.OpenArray
        )

    def block(self) -> tree.Block:
        base = self.r.choice(self.blocks) if self.blocks and self.chance(50) else None
        made = tree.Block(self.fresh("FB_"), base)
        made.inputs = [self.variable("i", self.given()) for _ in range(self.r.randint(1, 3))]
        made.outputs = [self.variable("o", self.simple()) for _ in range(self.r.randint(1, 2))]
        made.locals = [self.variable("s") for _ in range(self.r.randint(1, 3))]
        if self.blocks and self.chance(50):
            made.locals.append(self.instance(self.r.choice(self.blocks)))
        made.statics = [self.variable("st") for _ in range(self.r.choice((0, 0, 1)))]
        if (base is None or base.maker is None) and self.chance(40):
            made.init = self.first_code(made)
        self.bodies(made)
        return made

    def bodies(self, made: tree.Block) -> None:
        """Methods, properties, interfaces and body of a block that has its variables."""
        base = made.base
        inherited = list(base.all_methods.values()) if base else []
        for method in inherited:
            if self.chance(60):
                made.methods.append(self.function(made, method))
        for inherited_property in list(base.all_properties.values()) if base else []:
            if self.chance(60):
                made.properties.append(self.property(made, inherited_property))
        for _ in range(self.r.randint(0, 2)):
            made.methods.append(self.function(made))
        for _ in range(self.r.choice((0, 0, 1, 2))):
            made.properties.append(self.property(made))
        methods, properties = list(made.all_methods.values()), list(made.all_properties.values())
        if methods + properties and self.chance(50):
            some = self.r.sample(methods, self.r.randint(min(1, len(methods)), len(methods)))
            known = self.r.sample(properties, self.r.randint(min(1, len(properties)), len(properties)))
            self.interfaces.append(tree.Interface(self.fresh("I_"), some, known))
            made.interfaces.append(self.interfaces[-1])
        seen = [*(v for v in made.members if not isinstance(v.type, tree.Pointer)), *made.all_statics]
        maker = Maker(self.r, [*seen, *self.globals], texts=self.texts, bits=self.bits)
        maker.properties = [p for p in made.all_properties.values() if p.pure]
        body = Body(maker, made.locals, list(self.functions), returns=True, owner=made, effects=self.applied)
        made.body = [*self.pointers(body), *self.statements(body, self.r.randint(1, 5), 2)]
        if base is not None and self.chance(60):
            made.body.insert(self.r.randint(0, len(made.body)), tree.CallBase(base))

    def program(self) -> tree.Program:
        self.declare_types()
        self.bits = [(self.fresh("nBit"), self.r.randrange(16)) for _ in range(self.r.choice((0, 0, 2)))]
        self.globals = [self.variable("gv") for _ in range(self.r.choice((0, 1, 3)))]
        for _ in range(self.r.randint(0, 2)):
            self.functions.append(self.function())
        for _ in range(self.r.randint(0, 3)):
            self.blocks.append(self.block())
        variables = [self.variable("p") for _ in range(self.r.randint(3, 8))]
        variables += [self.variable("n", t) for t in self.r.sample(tree.NUMBERS, 3)]
        variables += [self.instance(b) for b in self.blocks]
        return self.around(variables)

    def around(self, variables: list[tree.Variable]) -> tree.Program:
        """The program that has these variables, and all that was declared before."""
        maker = Maker(self.r, [*variables, *self.globals], texts=self.texts, bits=self.bits)
        body = Body(maker, variables, self.functions, effects=self.applied)
        first = self.pointers(body)
        for block in self.blocks:
            if self.chance(40):
                first += self.lead(body, tree.Variable(self.fresh("pfb"), self.to_block(block)))
        for interface in self.interfaces:
            first += self.lead(body, tree.Variable(self.fresh("itf"), interface))
        statements = [*first, *self.statements(body, self.r.randint(2, self.size), 3)]
        statements = [*self.sizes(body), *statements]
        cycles = self.r.randint(1, 3)
        return tree.Program(
            self.types,
            self.functions,
            self.blocks,
            variables,
            statements,
            cycles,
            self.interfaces,
            self.globals,
            self.bits,
            self.checks,
        )

    def instance(self, block: tree.Block) -> tree.Variable:
        """A variable that is an instance, with what FB_Init needs and perhaps values of its inputs."""
        known = block.all_inputs  # what a list leaves open in an array that has values is not settled
        given = [v for v in known if not isinstance(v.type, tree.Array | tree.Struct) and self.chance(60)]
        values = {v.name: self.initial(self.plain, v.type) for v in given} if self.chance(40) else {}
        return tree.Variable(self.fresh("fb"), block, values or None, self.arguments(block))


def initialisable(type_: tree.Type) -> bool:
    """Whether an initial value can be written: not of a UNION."""
    if isinstance(type_, tree.Array):
        return initialisable(type_.element)
    return not isinstance(type_, tree.Struct) or (
        not type_.union and any(initialisable(t) for _, t in type_.members)
    )
