"""Random edits of the declarations of a random program, and what an online change keeps of its values.

A constant has its declared value after each edit, in memory as well.

Bodies that see an edited declaration are made again; a name in both programs means the same variable.
"""

from __future__ import annotations

import math
import re
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, replace
from random import Random
from typing import Any

import typed_tree as tree
from bytes_in_memory import Unsettled, View
from reference import Machine
from reference_values import copied, line, overwrite, stored

from programs import ProgramMaker, initialisable

LEVELS = ("bodies", "program", "blocks", "everything")
"""What an edit touches: the body of the program; its variables; blocks as well; types and globals too."""


_DECLARED = re.compile(r"(p|n|fb|gv|i|o|s|st)\d+$")
"""Names of variables; the others belong to a body: counters, guards, pointers."""


class EditMaker(ProgramMaker):
    """A program, and edits of it."""

    dynamic = False

    def __init__(self, r: Random, texts: bool = True, size: int = 10) -> None:
        super().__init__(r, texts, size)
        self.constants = Constants(self)
        self.renewed: dict[Any, Any] = {}

    def program(self) -> tree.Program:
        """A program with constants."""
        return self.constants.put_into(super().program())

    def edited(self, old: tree.Program) -> tree.Program:
        """The program after one edit."""
        with self.constants.left_out(old.blocks):
            made = self._edited_program(old)
        return self.constants.put_into(made)

    def _edited_program(self, old: tree.Program) -> tree.Program:
        level = self.r.choice(LEVELS)
        self.renewed = {}
        if level == "everything":
            self.types = []
            shared = [t for u in old.types if isinstance(u, tree.Struct) and u.union for _, t in u.members]
            for made in old.types:  # which of two changed members of a union stays is not settled
                self.renewed[made] = made if made in shared else self._edited_type(made)
                self.types.append(self.renewed[made])
            self.arrays = [tree.Array(self.renew(a.element), a.bounds) for a in self.arrays]
            self.globals = self._edited(old.globals, "gv")
            self.functions = []
            for _ in range(self.r.randint(0, 2)):
                self.functions.append(self.function())
        if level in ("blocks", "everything"):
            self._edit_blocks(old.blocks, level == "everything")
        return self.around(self._edited(old.variables, "p", level != "bodies"))

    def _edit_blocks(self, old: list[tree.Block], all_of_them: bool) -> None:
        """Blocks from the first edited one on are new ones: the later ones may use it."""
        first = 0 if all_of_them or not old else self.r.randrange(len(old))
        self.blocks = old[:first]
        self.interfaces = [i for b in self.blocks for i in b.interfaces]
        for block in old[first:]:
            made = tree.Block(block.name, self.renewed.get(block.base, block.base))
            edit = self.chance(60)
            for part in ("inputs", "outputs", "locals", "statics"):
                of = {"inputs": "i", "outputs": "o", "locals": "s", "statics": "st"}[part]
                setattr(made, part, self._edited(getattr(block, part), of, edit))
            if block.init is not None and (made.base is None or made.base.maker is None):
                made.init = self.first_code(made)
            self.renewed[block] = made
            self.bodies(made)
            self.blocks.append(made)

    def _edited(self, old: list[tree.Variable], prefix: str, edit: bool = True) -> list[tree.Variable]:
        """Some removed, some with another type, some new, some moved."""
        found = []
        for v in old:
            if not _DECLARED.match(v.name):
                continue
            if edit and self.chance(10):
                continue
            if edit and self.chance(10) and isinstance(v.type, tree.Scalar):
                other = self.r.choice([t for t in tree.INTEGERS if t != v.type])
                found.append(tree.Variable(v.name, other, self.plain.literal_value(other)))
                continue
            found.append(self._again(v))
        for _ in range(self.r.choice((0, 1, 2)) if edit else 0):
            found.insert(self.r.randint(0, len(found)), self.variable(prefix))
        if edit and self.chance(15):
            self.r.shuffle(found)
        return found or [self.variable(prefix)]

    def _again(self, v: tree.Variable) -> tree.Variable:
        """A variable with the edited form of its type."""
        type_ = self.renew(v.type)
        if isinstance(type_, tree.Block):
            return replace(self.instance(type_), name=v.name)
        if type_ == v.type:
            return v
        return tree.Variable(v.name, type_, self.initial(self.plain, type_) if initialisable(type_) else None)

    def renew(self, type_: tree.Type) -> tree.Type:
        """The edited form of a type."""
        if isinstance(type_, tree.Array):
            return tree.Array(self.renew(type_.element), type_.bounds)
        return self.renewed.get(type_, type_)  # type: ignore[no-any-return]

    def _edited_type(self, old: tree.Enum | tree.Struct) -> tree.Enum | tree.Struct:
        """The same name with other members."""
        if isinstance(old, tree.Enum):
            if self.chance(50):
                return old
            return replace(old, members=(*old.members, (self.fresh("v"), old.members[-1][1] + 1)))
        base = self.renewed.get(old.base, old.base)
        inherited = base.members if base is not None else ()
        own = old.members[len(old.base.members) if old.base is not None else 0 :]
        members = [(name, self.renew(t)) for name, t in own]
        if self.chance(60):
            if len(members) > 1 and self.chance(40):
                members.pop(self.r.randrange(len(members)))
            numbers = (*tree.INTEGERS, tree.BitMember()) if not old.union else tree.INTEGERS
            members.insert(self.r.randint(0, len(members)), (self.fresh("m"), self.r.choice(numbers)))
            if self.chance(20):
                self.r.shuffle(members)
        return replace(old, base=base, members=(*inherited, *members))


class Constants:
    """Constants of the program, of its list and of its blocks; edits change their values.

    Nothing but a copy into a variable reads them: what is computed with constants is folded, and may be
    refused.
    """

    def __init__(self, maker: EditMaker) -> None:
        self.maker = maker
        self.known: dict[str, list[tuple[tree.Variable, tree.Variable]]] = {}
        """Constants with the variables they are copied to, by the name of their owner."""
        self.added: set[int] = set()
        """The copies, by id(), in bodies that stay."""
        self.kept: list[tree.Assign] = []

    @contextmanager
    def left_out(self, blocks: list[tree.Block]) -> Iterator[None]:
        """Blocks without their constants: code that is made meanwhile does not see them."""
        kept = [(block, block.locals) for block in blocks]
        for block in blocks:
            block.locals = _without_constants(block.locals)
        try:
            yield
        finally:
            for block, variables in kept:
                block.locals = variables

    def put_into(self, made: tree.Program) -> tree.Program:
        """The program with its constants; half of the edits leave them as they are."""
        edit = self.maker.chance(50)
        for block in made.blocks:
            found = self._next(block.name, edit)
            block.locals = [*_without_constants(block.locals), *(v for pair in found for v in pair)]
            block.body = [*self._copies(found), *(s for s in block.body if id(s) not in self.added)]
            self.added |= {id(s) for s in self.kept}
        in_list, own_ones = self._next("", edit), self._next("PLC_PRG", edit)
        copies = [*(copy for _, copy in in_list), *(v for pair in own_ones for v in pair)]
        return replace(
            made,
            globals=[*made.globals, *(constant for constant, _ in in_list)],
            variables=[*made.variables, *copies],
            body=[*self._copies([*in_list, *own_ones]), *made.body],
        )

    def _copies(self, found: list[tuple[tree.Variable, tree.Variable]]) -> list[tree.Assign]:
        made = [
            tree.Assign(
                tree.Name(b.type, tree.base_of(b.type), False, b.name),
                tree.Name(a.type, tree.base_of(a.type), False, a.name),
            )
            for a, b in found
        ]
        self.kept += made
        return made

    def _next(self, owner: str, edit: bool) -> list[tuple[tree.Variable, tree.Variable]]:
        m, found = self.maker, []
        for constant, copy in self.known.get(owner, []):
            type_ = m.renew(constant.type)
            if not initialisable(type_) or (edit and m.chance(10)):
                continue
            if type_ != constant.type or (edit and m.chance(50)):
                constant = replace(constant, type=type_, initial=m.initial(m.plain, type_))
            found.append((constant, replace(copy, type=type_)))
        for _ in range(m.r.choice((0, 0, 1, 2)) if edit or owner not in self.known else 0):
            with_bits = [t for t in m.types if _has_bits(t)]
            type_ = m.r.choice(with_bits) if with_bits and m.chance(40) else m.type()
            if initialisable(type_):
                constant = tree.Variable(m.fresh("kc"), type_, m.initial(m.plain, type_), constant=True)
                found.append((constant, tree.Variable(m.fresh("kv"), type_)))
        self.known[owner] = found
        return found


def _has_bits(type_: tree.Type) -> bool:
    return isinstance(type_, tree.Struct) and any(isinstance(t, tree.BitMember) for _, t in type_.members)


def _without_constants(variables: list[tree.Variable]) -> list[tree.Variable]:
    return [v for v in variables if not v.name.startswith(("kc", "kv"))]


def changed_over(old: Machine, program: tree.Program) -> Machine:
    """The machine of a program after an online change: what kept name and type has its value (LDEC-47)."""
    new = Machine(program)
    keep = _Keeping(old, new)
    keep.all(old.program.variables, old.variables, program.variables, new.variables)
    keep.all(old.program.globals, old.globals, program.globals, new.globals)
    blocks = {b.name: b for b in old.program.blocks}
    for block in program.blocks:
        before = blocks.get(block.name)
        if before is not None and id(before) in old.kept:
            kept = new._static(block, block.statics)
            keep.all(before.statics, old.kept[id(before)][1], block.statics, kept)
    if program.functions is old.program.functions:
        for function in program.functions:
            if id(function) in old.kept:
                new.kept[id(function)] = old.kept[id(function)]
    return new


@dataclass
class _Keeping:
    """Values go from one machine to the next."""

    old: Machine
    new: Machine
    with_init: bool = False
    """Whether a block with FB_Init was met."""

    def _of_methods(self, block: tree.Block, value: Any, place: Any) -> None:
        """VAR_INST of methods that are still there."""
        if id(value) in self.old.kept:
            names = {v.name for b in line(block) for m in b.methods for v in m.kept}
            kept = self.old.kept[id(value)][1]
            self.new.kept[id(place)] = place, {n: x for n, x in kept.items() if n in names}

    def all(
        self, old: list[tree.Variable], before: dict[str, Any], new: list[tree.Variable], now: dict[str, Any]
    ) -> None:
        types = {v.name: v.type for v in old}
        for v in new:
            if v.name in types and v.name in before and not v.constant:
                self.one(types[v.name], before[v.name], v.type, now, v.name)

    def one(self, old: tree.Type, value: Any, new: tree.Type, holder: Any, key: Any) -> None:
        """One variable, element or member."""
        if isinstance(new, tree.Block) and isinstance(old, tree.Block):
            if new.name == old.name:
                self._of_methods(new, value, holder[key])
                self.with_init = self.with_init or any(b.init is not None for b in line(new))
                self.all(old.members, value, new.members, holder[key])
        elif isinstance(new, tree.Struct) and isinstance(old, tree.Struct):
            if new.name == old.name:
                self.members(old, value, new, holder[key])
        elif isinstance(new, tree.Array) and isinstance(old, tree.Array):
            self.elements(old, value, new, holder[key])
        elif isinstance(new, tree.Text) and isinstance(old, tree.Text):
            if new.wide == old.wide:
                holder[key] = stored(value, new)
        elif isinstance(new, tree.Pointer | tree.Interface):
            return
        elif new == old or (
            isinstance(new, tree.Enum) and isinstance(old, tree.Enum) and new.name == old.name
        ):
            holder[key] = value
        elif isinstance(new, tree.Scalar) and isinstance(old, tree.Scalar):
            holder[key] = self._converted(old, value, new, holder[key])

    def _converted(self, old: tree.Scalar, value: Any, new: tree.Scalar, initial: Any) -> Any:
        """A number in an integer type if it has it, else the initial value: not what FB_Init makes of it."""
        if not new.integer or not (old.integer or old.kind in ("bool", "real")):
            return initial
        if math.isfinite(value) and new.low <= value <= new.high and value == int(value):
            return int(value)
        if self.with_init:
            raise Unsettled
        return initial

    def members(self, old: tree.Struct, value: Any, new: tree.Struct, place: Any) -> None:
        if old == new:
            overwrite(place, copied(value))
            return
        types = dict(old.members)
        for name, type_ in new.members:
            if (
                name in types
                and isinstance(place, View)
                and types[name] == type_
                and isinstance(place[name], View)
            ):
                overwrite(place[name], value[name])
            elif name in types:
                self.one(types[name], value[name], type_, place, name)

    def elements(self, old: tree.Array, value: Any, new: tree.Array, place: Any) -> None:
        if old.bounds != new.bounds:
            return
        for i in range(len(place) if isinstance(place, list) else len(place.keys())):
            rest = new.bounds[1:]
            before = tree.Array(old.element, rest) if rest else old.element
            after = tree.Array(new.element, rest) if rest else new.element
            self.one(before, value[i], after, place, i)
