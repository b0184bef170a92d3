"""What the code of each body depends on besides its own text: when it may be used again.

Contract: a body is lowered again when analysis has looked at it again, or when the content of one of its
dependencies differs from what it was when the body was lowered. Dependencies are all that its tree names,
each as far as it makes a difference to lowering:

- a variable: where it is stored, and its type by name;
- a POU that it calls: the head, with the initial values of parameters;
- a type as a whole, with the types inside it: where it is copied, initialised, handed over, or its address
  taken; a type that is only passed through on the way to a member is no dependency;
- the size of a type: where elements of an array or behind a pointer are reached;
- its own variables: their types and initial values.

Dependencies that the passes add (effects of callees, addresses that are known) are in `relower`, those that
emission adds (bodies for inlining, sizes of data objects) in `codegen.partition`. Library functions see
nothing of the project and have none. Cost: one walk over a body when it is lowered, one comparison of each
changed entity after an edit.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import Any

from tappet.core import calls, life_cycle
from tappet.core.program import Program
from tappet.lang import ast, walk
from tappet.lang import types as t
from tappet.lang.analysis.monitored import monitoring_name
from tappet.lang.ast.fields import tree_fields
from tappet.lang.parts import innermost
from tappet.lang.source import Scope
from tappet.lang.symbols import PouSymbol, Storage, TypeSymbol, VarSymbol

PLACE, VALUE, HEAD, SHAPE, SIZE = "place", "value", "head", "shape", "size"
"""As what a body depends on a variable (the first two), a POU or a type (the last two)."""

Key = tuple[str, int]
"""One of these, and id() of the symbol or type."""
Content = tuple[object, ...]

_OWN = (Storage.LOCAL, Storage.PARAMETER, Storage.RESULT)


@dataclass(slots=True)
class Dependency:
    """A symbol or type that bodies depend on."""

    entity: Any
    content: Content
    users: set[str] = field(default_factory=set)
    """Linkage names of the bodies."""


class Dependencies:
    """The dependencies of all bodies of one application."""

    def __init__(self, program: Program) -> None:
        self.program = program
        self.dependencies: dict[Key, Dependency] = {}
        self.keys: dict[str, set[Key]] = {}
        """Dependencies of each body, by linkage name."""
        self.objects = objects_of(program)

    def complete(self) -> None:
        """Take in the bodies that are new since the last time."""
        bodies = self.program.bodies
        for name in self.keys.keys() - bodies.keys():
            self.forget(name)
        for name, pou in bodies.items():
            if name not in self.keys:
                self.keys[name] = set()
                if pou.source is not None and pou.source.scope is not Scope.LIBRARY:
                    self._take(name, pou)

    def forget(self, name: str) -> None:
        """A body is about to be lowered again, or is gone."""
        for key in self.keys.pop(name, ()):
            dependency = self.dependencies[key]
            dependency.users.discard(name)
            if not dependency.users:
                del self.dependencies[key]

    def _take(self, name: str, pou: PouSymbol) -> None:
        found = DependencyCollector(self.program)
        found.pou(pou)
        self.keys[name] = set(found.entities)
        for key, entity in found.entities.items():
            dependency = self.dependencies.get(key)
            if dependency is None:
                dependency = self.dependencies[key] = Dependency(entity, _CONTENTS[key[0]](entity))
            dependency.users.add(name)

    def invalidated(self, entities: frozenset[int] | set[int]) -> set[str]:
        """Names of the bodies that depend on what has changed among `entities`, given by id()."""
        found: set[str] = set()
        for key, dependency in self.dependencies.items():
            if key[1] in entities:
                content = _CONTENTS[key[0]](dependency.entity)
                if content != dependency.content:
                    dependency.content = content
                    found |= dependency.users
        return found


def objects_of(program: Program) -> list[object]:
    """What must be the same for anything to be used again: objects, their methods, what they derive from."""
    analysis = program.analysis
    found: list[object] = [program_name(gvl) for gvl in analysis.gvls]
    for pou in analysis.pous:
        if pou.source is not None and pou.source.scope is Scope.LIBRARY:
            continue
        parts = [_Same(part) for part in pou.with_children()]
        table = [(name, _Same(method)) for name, method in pou.vtable.items()]
        found.append((parts, table, pou.kind, _Same(pou.base), [_Same(i) for i in pou.interfaces]))
        if pou.name.upper().startswith("CHECK"):  # implicit checks are called wherever they apply
            found += [_head(part) for part in pou.with_children()]
    return found


def program_name(entity: Any) -> str:
    """Names a list among those of the application."""
    return f"{entity.name.upper()} {entity.source.uri if entity.source is not None else ''}"


class _Same:
    """Compares by identity, and keeps what it refers to, so that its id() is nothing else's."""

    __slots__ = ("entity",)

    def __init__(self, entity: object) -> None:
        self.entity = entity

    def __eq__(self, other: object) -> bool:
        return isinstance(other, _Same) and other.entity is self.entity

    __hash__ = None  # type: ignore[assignment]


# -- contents ---------------------------------------------------------------------------------------


def _type(type_: t.Type | None) -> object:
    """A type by name, with what is known of it where it is only named."""
    if isinstance(type_, t.Enum):
        return type_, type_.base, type_.default
    return (type_, _type(type_.element)) if isinstance(type_, t.Array) else type_


def _place(v: VarSymbol) -> Content:
    return (_type(v.type), v.storage, v.home, v.section, v.owner, v.area, v.offset, v.bit)


def _value(v: VarSymbol) -> Content:
    return (*_place(v), *initial_content(v.decl))


def initial_content(decl: ast.VarDecl | None) -> Content:
    """What a variable starts with: the expressions, and the values of the constants in them."""
    if decl is None:
        return ()
    values: list[ast.Expr | None] = [decl.init]
    ref: object = decl.type_ref
    while isinstance(ref, ast.ArrayType):
        ref = ref.element
    if isinstance(ref, ast.NamedType):
        for args in (ref.args or (), *(e.args for e in ref.elements)):
            values += [a.value for a in args]
    content: list[object] = [decl.initial_ref]
    for value in values:
        if value is not None:
            content.append(_Same(value))
            content += [repr(e.constant) for e in walk.expressions(value) if e.is_constant]
    return tuple(content)


def _head(pou: PouSymbol) -> Content:
    placed = pou.kind in ("FUNCTION_BLOCK", "PROGRAM")
    pins: list[object] = []
    for p in pou.parameters:
        pins += [_Same(p), p.section, _type(p.type)]
        if calls.initialised_on_call(p):
            pins.append(_value(p))
        elif not placed:
            pins.append(initial_content(p.decl))
    node = pou.pou
    texts = tuple(pragma.text for pragma in node.attributes) if node is not None else ()
    head = (node.access, frozenset(node.modifiers), bool(node.body)) if node is not None else ()
    own = (
        pou.kind,
        pou.qualified_name,
        _type(pou.return_type),
        _Same(pou.owner),
        _Same(pou.base),
        texts,
        head,
    )
    return (*own, *pins)


def _shape(type_: t.Struct | t.FunctionBlock) -> Content:
    content: list[object] = [type_.size, type_.align, _Same(type_.base)]
    if isinstance(type_, t.Struct):
        content.append(type_.union)
    else:
        content += [_Same(m) for m in _methods(type_)]
    for name, m in type_.members.items():
        content += [name, _type(m.type), m.offset, m.section, m.bit, m.flags, initial_content(m.decl)]
    return tuple(content)


def _methods(type_: t.FunctionBlock) -> Iterator[PouSymbol]:
    """Methods that are called when an instance comes and goes."""
    for name in ("FB_INIT", "FB_EXIT", "FB_REINIT"):
        yield from life_cycle.life_cycle_methods(type_, name)
    yield from life_cycle.after_init_methods(type_)


_CONTENTS: dict[str, Any] = {
    PLACE: _place,
    VALUE: _value,
    HEAD: _head,
    SHAPE: _shape,
    SIZE: lambda type_: (type_.size,),
}


# -- what a body names ------------------------------------------------------------------------------


def _inner(type_: t.Type | None) -> t.Struct | t.FunctionBlock | None:
    """The structure or block that a variable of a type consists of."""
    inner = None if type_ is None else innermost(type_)
    return inner if isinstance(inner, t.Struct | t.FunctionBlock) else None


class DependencyCollector:
    """Collects the dependencies of one body."""

    def __init__(self, program: Program) -> None:
        self.entities: dict[Key, Any] = {}
        self.checks_pointers = program.check("CheckPointer") is not None

    def pou(self, pou: PouSymbol) -> None:
        """A body with its own variables."""
        owner: PouSymbol | None = pou
        while owner is not None:
            self.head(owner)
            owner = owner.owner
        owner = pou.owner
        if owner is not None and pou.name.startswith(("__get", "__set")):
            kept = owner.locals.get(monitoring_name(owner.name, pou.name[len("__get") :]).upper())
            if kept is not None:
                self.entities[PLACE, id(kept)] = kept
        node = pou.pou
        assert node is not None
        for block in node.blocks:
            for decl in block.variables:
                variable = decl.symbol
                if isinstance(variable, VarSymbol) and (variable.home in _OWN or variable.storage in _OWN):
                    self.variable(variable)
        for variable in pou.parameters:
            if variable.storage in _OWN:
                self.variable(variable)
        if pou.result is not None:
            self.variable(pou.result)
        self.tree(node.body, False)

    def head(self, pou: PouSymbol) -> None:
        """A POU that is called, or the body itself."""
        key = (HEAD, id(pou))
        if key in self.entities:
            return
        self.entities[key] = pou
        if pou.kind in ("FUNCTION_BLOCK", "PROGRAM"):
            for parameter in pou.parameters:
                if calls.initialised_on_call(parameter):
                    self.variable(parameter)
            return
        self.shape(pou.return_type)
        for parameter in pou.parameters:
            self.shape(parameter.type)
            self.initial(parameter.decl)

    def variable(self, variable: VarSymbol) -> None:
        """A variable that the body gives its initial value."""
        self.entities[VALUE, id(variable)] = variable
        self.shape(variable.type)
        self.initial(variable.decl)

    def initial(self, decl: ast.VarDecl | None) -> None:
        """What an initial value names, that of FB_Init included."""
        if decl is not None:
            if decl.init is not None:
                self.tree(decl.init, True)
            ref: object = decl.type_ref
            while isinstance(ref, ast.ArrayType):
                ref = ref.element
            if isinstance(ref, ast.NamedType):
                self.tree(ref.args, True)
                self.tree(ref.elements, True)

    def shape(self, type_: t.Type | None) -> None:
        """A type as a whole, and what is inside it."""
        if isinstance(type_, t.Reference | t.Pointer):
            return
        inner = _inner(type_)
        if inner is None or (SHAPE, id(inner)) in self.entities:
            return
        self.entities[SHAPE, id(inner)] = inner
        if isinstance(inner, t.FunctionBlock):
            for method in _methods(inner):
                self.head(method)
        self.shape(inner.base)
        for member in inner.members.values():
            self.shape(member.type)
            self.initial(member.decl)

    def size(self, type_: t.Type | None) -> None:
        """The bytes of a type."""
        inner = _inner(type_)
        if inner is not None:
            self.entities[SIZE, id(inner)] = inner

    # -- trees

    def tree(self, node: object, placed: bool) -> None:
        """Everything below a node or list of nodes; `placed`: where it lies matters, not only its value."""
        if isinstance(node, list | tuple):
            for part in node:
                self.tree(part, placed)
        elif isinstance(node, ast.Expr):
            self.expression(node, placed, False)
        elif isinstance(node, ast.Node):
            for name in tree_fields(node.__class__):
                part = getattr(node, name)
                if part is not None:
                    self.tree(part, placed or (name == "value" and getattr(node, "op", "") == "REF="))

    def expression(self, e: ast.Expr, placed: bool, through: bool) -> None:
        """An expression; `through`: only a part of what it denotes is used."""
        kind = e.__class__
        if kind is ast.Literal:
            return
        if not placed and not through and e.is_constant and isinstance(e.constant, int | float):
            return
        if kind is ast.Call:
            self._call(e)  # type: ignore[arg-type]
        elif kind is ast.Member:
            assert isinstance(e, ast.Member)
            self.expression(e.base, placed, True)
            self._symbol(e.symbol, through)
        elif kind is ast.Name:
            self._symbol(e.symbol, through)  # type: ignore[attr-defined]
        elif kind is ast.Index:
            assert isinstance(e, ast.Index)
            self.expression(e.base, placed, True)
            self.size(e.base.type if isinstance(e.base.type, t.Array) else e.type)
            self.tree(e.indices, False)
        elif kind is ast.Deref:
            assert isinstance(e, ast.Deref)
            own = isinstance(e.base, ast.This | ast.Super)
            if not own:
                self.expression(e.base, placed, False)
            if not own and self.checks_pointers:
                self.shape(e.type)
        else:
            for name in tree_fields(kind):
                part = getattr(e, name)
                if part is not None:
                    self.tree(part, placed)
        if not through:
            self.shape(e.type)

    def _symbol(self, symbol: object, through: bool) -> None:
        if isinstance(symbol, VarSymbol):
            self.entities[PLACE, id(symbol)] = symbol
        elif isinstance(symbol, TypeSymbol):
            self.shape(symbol.type)
        elif isinstance(symbol, PouSymbol):
            self.head(symbol)
            if not through:
                self.shape(symbol.instance)
        elif symbol is not None:
            for name in ("getter", "setter"):
                accessor = getattr(symbol, name, None)
                if accessor is not None:
                    self.head(accessor)

    def _call(self, e: ast.Call) -> None:
        if e.expansion is not None:
            self.expression(e.expansion, True, False)
        if isinstance(e.target, PouSymbol):
            self.head(e.target)
            self.expression(e.callee, True, True)
        else:
            self.expression(e.callee, True, False)
        for argument in (*e.args, *((e.accumulator,) if e.accumulator is not None else ())):
            if isinstance(argument.parameter, VarSymbol):
                self.entities[PLACE, id(argument.parameter)] = argument.parameter
            if argument.value is not None:
                self.expression(argument.value, True, False)
