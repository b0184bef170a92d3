"""Random __TRY parts, variables of __NEW, and the declarations that go with them."""

from __future__ import annotations

from typing import Any

import typed_tree as tree
from expressions import Maker
from statements import Body, Statements
from typed_tree import (
    BOOL,
    DWORD,
    INTEGERS,
    LREAL,
    REAL,
    UDINT,
    Array,
    BitMember,
    Block,
    Deref,
    Enum,
    Function,
    Name,
    OpenArray,
    Pointer,
    Struct,
    Type,
    Variable,
    base_of,
)
from typing_rules import assignable


class GuardedStatements(Statements):
    """What is made, guarded and laid out in memory."""

    types: list[Enum | Struct]
    blocks: list[Block]
    plain: Maker
    """Makes literals."""
    dynamic = True
    """Whether __NEW makes blocks, whose declarations no online change may edit (LOPR-101)."""

    def further(self, b: Body, depth: int) -> list[Any]:
        """A statement of this module, or nothing."""
        choice = self.r.randrange(100)
        if choice < 8:
            return [self._try(b, depth)]
        if choice < 11:
            return [self._new(b, depth)]
        return self._attempt(b, depth) if choice < 15 else []

    def _part(self, b: Body, depth: int) -> list[Any]:
        return self.statements(b, self.r.randint(1, 2), depth - 1)

    def _try(self, b: Body, depth: int) -> tree.Try:
        body = [*self._part(b, depth), *(self._faulty(b) if self.chance(50) else [])]
        kind = self.r.choice(("catch", "code", "code", "final", "both", "both"))
        code = None
        if kind in ("code", "both"):
            code = Variable(self.fresh("exc"), DWORD)
            b.room.append(code)
            if b.room is not b.maker.variables:
                b.maker.variables.append(code)
        final = self._part(b, depth) if kind in ("final", "both") else None
        handler = self._part(b, depth) if kind != "final" else None
        name = Name(DWORD, DWORD, False, code.name) if code else None
        return tree.Try([*body, *self._part(b, depth)], name, handler, final)

    def _faulty(self, b: Body) -> list[Any]:
        """A division that often is one by zero."""
        types = [t for t in INTEGERS if b.maker.variable(t, 0) is not None]
        if not types:
            return []
        type_ = self.r.choice(types)
        place = b.maker.places(lambda t: t == type_, writable=True)
        divisor = b.maker.variable(type_, 0)
        if not place or divisor is None:
            return []
        target = b.maker.filled(self.r.choice(place), 1)
        computed = base_of(type_) if type_.bits >= 32 else tree.DINT
        one = b.maker.literal(type_, 1)
        return [tree.Assign(target, tree.Binary(type_, computed, False, "/", one, divisor, computed))]

    def _new(self, b: Body, depth: int) -> Any:
        made: list[Block | Struct] = [
            *(self.blocks if self.dynamic else []),
            *(t for t in self.types if isinstance(t, Struct)),
        ]
        if not made:
            return self._try(b, depth)
        target = self.r.choice(made)
        pointer = Variable(self.fresh("heap"), Pointer(target))
        b.room.append(pointer)
        if b.room is not b.maker.variables:
            b.maker.variables.append(pointer)
        b.maker.heap.add(pointer.name)
        body = self.statements(b, self.r.randint(1, 3), depth - 1)
        b.maker.hidden.add(pointer.name)
        if isinstance(target, Block):
            target.dynamic = True
        arguments = self.arguments(target) if isinstance(target, Block) else None
        return tree.New(Name(pointer.type, None, False, pointer.name), arguments or (), body)

    def _attempt(self, b: Body, depth: int) -> list[Any]:
        """An assignment attempt, to a block that the source may lead to; another one would be refused."""
        # what is deleted later must not be led to
        sources = [e for e in self._owners(b) if not (isinstance(e, Deref) and e.base.name in b.maker.heap)]
        if not sources or not self.blocks:
            return []
        source = self.r.choice(sources)
        known = source.type
        wanted = [x for x in self.blocks if not isinstance(known, Block) or x.is_a(known) or known.is_a(x)]
        if not wanted:
            return []
        if isinstance(source, Deref) and source.base.type.ref_to and self.chance(60):
            source = source.base
        pointer = Variable(self.fresh("maybe"), Pointer(self.r.choice(wanted), ref_to=True))
        b.room.append(pointer)
        if b.room is not b.maker.variables:
            b.maker.variables.append(pointer)
        body = self._part(b, depth)
        b.maker.hidden.add(pointer.name)
        name = Name(pointer.type, None, False, pointer.name)
        return [tree.Attempt(name, source, body, self._part(b, depth) if self.chance(40) else [])]

    def arguments(self, block: Block) -> tuple[Any, ...] | None:
        """What FB_Init gets."""
        made = block.maker
        return None if made is None else tuple(self.plain.literal_value(v.type) for v in made.inputs)

    # -- declarations -------------------------------------------------------------------------------

    def union(self) -> Struct:
        """Members that share their memory: numbers, rows of them, bits, structures without gaps."""
        members: list[tuple[str, Type]] = []
        for _ in range(self.r.randint(2, 4)):
            kind = self.r.randrange(10)
            number = self.r.choice((*INTEGERS, *INTEGERS, REAL, LREAL))
            made: Type = number
            if kind < 3:
                made = Array(
                    number, tuple((0, self.r.randint(0, 3)) for _ in range(self.r.choice((1, 1, 2))))
                )
            elif kind < 6:
                parts = [(self.fresh("m"), self.r.choice(INTEGERS)) for _ in range(self.r.randint(1, 3))]
                made = Struct(self.fresh("S_"), tuple(parts), 1)
            elif kind < 8:
                bits = [(self.fresh("bit"), BitMember()) for _ in range(self.r.choice((2, 8, 11)))]
                made = Struct(self.fresh("S_"), tuple(bits))
            if isinstance(made, Struct):
                self.types.append(made)
            members.append((self.fresh("u"), made))
        return Struct(self.fresh("U_"), tuple(members), union=True)

    def packed(self, made: Struct) -> Struct:
        """A structure that may have a pack mode and single bits."""
        members = list(made.members)
        for _ in range(self.r.choice((0, 0, 0, 1, 3))):
            members.insert(self.r.randint(0, len(members)), (self.fresh("bit"), BitMember()))
        pack = self.r.choice((None, None, None, 0, 1, 2, 4, 8))
        return Struct(made.name, tuple(members), pack)

    def open_array(self) -> Type:
        """Type of an in-out whose bounds come from the argument."""
        return OpenArray(self.r.choice((*INTEGERS, REAL, BOOL)), self.r.choice((1, 1, 2)))

    def first_code(self, block: Block) -> Function:
        """FB_Init with arguments: simple assignments to the members."""
        made = Function("FB_Init", BOOL)
        made.inputs = [
            Variable(self.fresh("a"), self.r.choice((*INTEGERS, REAL, BOOL)))
            for _ in range(self.r.randint(1, 3))
        ]
        hidden = Block | Pointer | tree.Interface
        seen = [v for v in block.members if not isinstance(v.type, hidden)]
        maker = Maker(self.r, [*made.inputs, *seen], texts=self.plain.texts)
        maker.fixed |= {v.name for v in made.inputs}
        for _ in range(self.r.randint(1, 4)):
            places = maker.places(lambda t: not isinstance(t, Array | Struct | OpenArray), writable=True)
            if not places:
                break
            target = maker.filled(self.r.choice(places), 0)
            found = maker.places(lambda t, target=target: assignable(t, target.type))
            made.body.append(tree.Assign(target, maker.filled(self.r.choice(found), 0)))
        return made

    def sizes(self, b: Body) -> list[Any]:
        """SIZEOF of every structure."""
        found: list[Any] = []
        for made in self.types:
            if isinstance(made, Struct) and self.chance(60):
                place = Variable(self.fresh("size"), UDINT)
                b.room.append(place)
                name = Name(UDINT, UDINT, False, place.name)
                found.append(tree.Assign(name, tree.SizeOf(UDINT, UDINT, True, made)))
        return found
