"""Initial values as data: constant bytes for the memory image, and what has to run because it is no constant.

`Template` holds both for one type or data object. Constants go into the bytes at build time; variables,
function calls, addresses and FB_Init become dynamic steps, in order of declaration (LDEC-40..LDEC-47).
`initial` makes their code.
"""

from __future__ import annotations

import struct
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace

from tappet.core import places
from tappet.core.constant_bytes import constant_bytes, given_bytes
from tappet.core.life_cycle import after_init_methods, init_methods
from tappet.core.program import Program
from tappet.lang import ast
from tappet.lang import types as t
from tappet.lang.analysis.initial import as_written
from tappet.lang.symbols import VarSymbol

InitArguments = Sequence[list[ast.Argument]]
"""Arguments of FB_Init: none, those of all instances, or those of each element of an array."""
VFTABLE = "__VFTABLE"


@dataclass(slots=True)
class Step:
    """One dynamic initialisation at `offset`."""

    offset: int
    type: t.Type
    value: ast.Expr | None = None
    """Assigned when not None; else the step constructs an FB instance."""
    reference: bool = False
    """Bind the address of `value` instead of copying it."""
    args: list[ast.Argument] = field(default_factory=list)
    """Arguments of FB_Init."""
    after: bool = False
    """Call the methods marked call_after_init instead of constructing."""
    count: int = 1
    stride: int = 0
    """Repeated for `count` elements of an array."""
    inner: list[Step] = field(default_factory=list)
    """Steps of each element, with offsets inside it."""


@dataclass(slots=True)
class Template:
    """Initial state of an object."""

    data: bytearray
    steps: list[Step] = field(default_factory=list)


class Initialiser:
    """Builds templates; caches those of types."""

    def __init__(self, program: Program) -> None:
        self.program = program
        self.types: dict[int, tuple[t.Type, Template]] = {}
        """By id() of the type."""

    def of_type(self, type_: t.Type) -> Template:
        """Template of a type without an initialiser of its own."""
        known = self.types.get(id(type_))
        found = known[1] if known is not None else None
        if found is None:
            found = Template(bytearray(type_.size))
            if isinstance(type_, t.Struct | t.FunctionBlock):
                self.types[id(type_)] = (type_, found)
                self._members(found, type_)
            elif isinstance(type_, t.Array):
                self._elements(found, 0, type_, None, ())
            elif isinstance(type_, t.Enum) and type_.default:
                found.data[:] = type_.default.to_bytes(type_.size, "little", signed=type_.default < 0)
        return found

    def forget(self, entities: frozenset[int] | set[int]) -> None:
        """Types given by id() may start with something else now."""
        for key in self.types.keys() & entities:
            del self.types[key]

    def _members(self, template: Template, type_: t.Struct | t.FunctionBlock) -> None:
        if isinstance(type_, t.FunctionBlock) and not type_.program:
            number = self.program.instantiate(type_)
            table = type_.members.get(VFTABLE)
            if table is not None:
                struct.pack_into("<I", template.data, table.offset, number)
        union = isinstance(type_, t.Struct) and type_.union
        for key, member in type_.members.items():
            if key == VFTABLE or member.section == "VAR_IN_OUT":
                continue
            decl = member.decl
            if union and (decl is None or decl.init is None):
                continue
            self.variable(template, member.offset, member.type, decl, member.bit)

    def variable(
        self,
        template: Template,
        offset: int,
        type_: t.Type,
        decl: ast.VarDecl | None,
        bit: int | None = None,
    ) -> None:
        """Add a declared variable at `offset`."""
        init = decl.init if decl is not None else None
        data = given_bytes(decl, type_) if decl is not None and decl.attributes else None
        if data is not None:
            template.data[offset : offset + type_.size] = data
            return
        given = _init_arguments(decl)
        if bit is not None:
            if init is not None and init.constant:
                template.data[offset] |= 1 << bit
            return
        if decl is not None and decl.initial_ref and init is not None:
            if not (init.is_constant and not places.is_place(init)):
                template.steps.append(Step(offset, type_, init, reference=True))
            return
        self.fill(template, offset, type_, init, given)

    def fill(
        self,
        template: Template,
        offset: int,
        type_: t.Type,
        init: ast.Expr | None,
        given: InitArguments = (),
    ) -> None:
        """Add a value of `type_` at `offset`."""
        if isinstance(type_, t.FunctionBlock):
            self._instance(template, offset, type_, init, given[0] if given else [])
        elif isinstance(type_, t.Array) and (init is None or isinstance(init, ast.ArrayInit)):
            self._elements(template, offset, type_, init, given)
        elif isinstance(type_, t.Struct) and (init is None or isinstance(init, ast.StructInit)):
            self._copy_in(template, offset, self.of_type(type_))
            if isinstance(init, ast.StructInit):
                self._fields(template, offset, init)
        elif init is None:
            if isinstance(type_, t.Enum) and type_.default:
                self._copy_in(template, offset, self.of_type(type_))
        else:
            data = constant_bytes(type_, init)
            if data is None:
                template.steps.append(Step(offset, type_, init))
            else:
                template.data[offset : offset + len(data)] = data

    def _copy_in(self, template: Template, offset: int, part: Template) -> None:
        template.data[offset : offset + len(part.data)] = part.data
        template.steps += [_moved(step, offset) for step in part.steps]

    def _fields(self, template: Template, offset: int, init: ast.StructInit) -> None:
        for item in init.fields:
            member = item.parameter
            if not isinstance(member, VarSymbol) or item.value is None or member.type is None:
                continue
            if member.bit is not None:
                mask = 1 << member.bit
                old = template.data[offset + member.offset]
                template.data[offset + member.offset] = old | mask if item.value.constant else old & ~mask
                continue
            self.fill(template, offset + member.offset, member.type, item.value)

    def _instance(
        self,
        template: Template,
        offset: int,
        type_: t.FunctionBlock,
        init: ast.Expr | None,
        args: list[ast.Argument],
    ) -> None:
        own = self.of_type(type_)
        template.data[offset : offset + len(own.data)] = own.data
        constructed = self.constructed(type_)
        if constructed:
            template.steps.append(Step(offset, type_, args=args))
        if isinstance(init, ast.StructInit):
            if constructed:
                # FB_Init runs first and does not see these values (LDEC-46)
                template.steps += self._field_steps(offset, init)
            else:
                self._fields(template, offset, init)
        elif init is not None:
            template.steps.append(Step(offset, type_, init))
        if after_init_methods(type_):
            template.steps.append(Step(offset, type_, after=True))

    def _field_steps(self, offset: int, init: ast.StructInit) -> list[Step]:
        steps = []
        for item in init.fields:
            member = item.parameter
            if isinstance(member, VarSymbol) and item.value is not None and member.type is not None:
                steps.append(Step(offset + member.offset, member.type, item.value))
        return steps

    def _elements(
        self,
        template: Template,
        offset: int,
        type_: t.Array,
        init: ast.ArrayInit | None,
        given: InitArguments,
    ) -> None:
        if init is not None or len(given) > 1:
            type_ = type_ if init is None else as_written(type_, init.elements)
            _ArrayFiller(self, template, type_, offset, given).run(init)
            return
        element, count = type_.element, type_.count
        part = Template(bytearray(element.size))
        self.fill(part, 0, element, None, given)
        if any(part.data):
            template.data[offset : offset + type_.size] = bytes(part.data) * count
        if part.steps:
            template.steps.append(Step(offset, element, count=count, stride=element.size, inner=part.steps))

    def constructed(self, type_: t.FunctionBlock) -> bool:
        """Whether instances need code at start: dynamic initial values or FB_Init."""
        return bool(self.of_type(type_).steps) or bool(init_methods(type_))


class _ArrayFiller:
    """Writes an array initialiser in storage order; nested arrays may be flat (LTYP-91)."""

    def __init__(
        self,
        initialiser: Initialiser,
        template: Template,
        type_: t.Array,
        offset: int,
        given: InitArguments,
    ) -> None:
        self.initialiser = initialiser
        self.template = template
        self.type = type_
        self.offset = offset
        self.given = given
        self.each = _instances_in(type_.element)
        """Lists of arguments that concern one element."""
        self.next = 0

    def run(self, init: ast.ArrayInit | None) -> None:
        for element in init.elements if init is not None else ():
            self._put(element)
        self._repeated(self.type.count - self.next, lambda: self._one(None))

    def _repeated(self, count: int, put: Callable[[], None]) -> None:
        """Put something `count` times; bytes that need no code are copied."""
        template, size = self.template, self.type.element.size
        while count > 0 and self.next < self.type.count:
            first, steps = self.next, len(template.steps)
            put()
            count -= 1
            length = self.next - first
            if len(template.steps) == steps and length and count:
                times = min(count, (self.type.count - self.next) // length)
                start, end = self.offset + first * size, self.offset + self.next * size
                template.data[end : end + (end - start) * times] = template.data[start:end] * times
                self.next += length * times
                count -= times

    def _put(self, element: ast.Expr) -> None:
        if isinstance(element, ast.Repeat):
            count = element.count.constant
            assert isinstance(count, int)
            self._repeated(min(count, self.type.count), lambda: self._values(element))
        elif isinstance(element, ast.ArrayInit) and not isinstance(self.type.element, t.Array):
            for inner in element.elements:
                self._put(inner)
        else:
            self._one(element)

    def _values(self, repeat: ast.Repeat) -> None:
        for value in repeat.values:
            self._put(value)
        if not repeat.values:
            self._one(None)

    def _one(self, value: ast.Expr | None) -> None:
        if self.next >= self.type.count:
            return
        element = self.type.element
        given = self.given
        if len(given) > 1:
            given = given[self.next * self.each : (self.next + 1) * self.each]
        self.initialiser.fill(self.template, self.offset + self.next * element.size, element, value, given)
        self.next += 1


def _instances_in(type_: t.Type) -> int:
    """Elements of an array and of the arrays in it; 1 for anything else."""
    return type_.count * _instances_in(type_.element) if isinstance(type_, t.Array) else 1


def _moved(step: Step, offset: int) -> Step:
    return replace(step, offset=step.offset + offset)


def _init_arguments(decl: ast.VarDecl | None) -> InitArguments:
    ref = decl.type_ref if decl is not None else None
    while isinstance(ref, ast.ArrayType):
        ref = ref.element
    if not isinstance(ref, ast.NamedType):
        return ()
    if ref.elements:
        return [element.args for element in ref.elements]
    return [ref.args] if ref.args else ()


def initialiser_of(program: Program) -> Initialiser:
    """The initialiser of an application."""
    if program.initialiser is None:
        program.initialiser = Initialiser(program)
    assert isinstance(program.initialiser, Initialiser)
    return program.initialiser
