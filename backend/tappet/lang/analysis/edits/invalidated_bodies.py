"""The bodies that an edit of declarations invalidates: those that use a name or type which has changed.

A body finds what others declare by the identifiers of its text and by the types of what these name. So a
change of a global name invalidates the bodies with this identifier. A change inside an object invalidates a
body with the member's identifier that can have an instance: it holds a name that leads to one, or uses a
variable of the type.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from typing import Any

from tappet.lang import types as t
from tappet.lang.analysis.collected import Collected
from tappet.lang.analysis.context import Key, Record
from tappet.lang.analysis.edits.identifiers import Identifiers
from tappet.lang.analysis.edits.relayout import Layout, together
from tappet.lang.symbols import (
    EnumValueSymbol,
    GvlSymbol,
    InterfaceSymbol,
    PouSymbol,
    PropertySymbol,
    Storage,
    Symbol,
    TypeSymbol,
    VarSymbol,
)
from tappet.lang.types import Type

Made = Mapping[str, Mapping[Key, Any]]
"""Symbols and types of the declarations of texts, by uri."""
_OF_SIZE = ("SIZEOF", "XSIZEOF")
_WITH_TYPE = (VarSymbol, PropertySymbol, TypeSymbol, EnumValueSymbol, InterfaceSymbol)
_MADE_OF_ANOTHER = (t.Array, t.Pointer, t.Reference)


# -- what others see of an entity ----------------------------------------------------------------


def contents(made: Made) -> dict[tuple[str, Key], tuple[object, ...]]:
    """What others see of each entity but for the inside of its type; its place is not part of it."""
    return {(uri, key): _content(entity) for uri, table in made.items() for key, entity in table.items()}


def sizes(made: Made) -> dict[tuple[str, Key], int]:
    """Bytes of each type."""
    return {
        (uri, key): entity.size
        for uri, table in made.items()
        for key, entity in table.items()
        if isinstance(entity, (t.Struct, t.FunctionBlock, t.Enum))
    }


def _content(entity: object) -> tuple[object, ...]:
    if isinstance(entity, VarSymbol):
        return _content_of_variable(entity)
    if isinstance(entity, PouSymbol):
        return _content_of_pou(entity)
    if isinstance(entity, PropertySymbol):
        return (entity.name, entity.type, entity.getter is None, entity.setter is None)
    if isinstance(entity, EnumValueSymbol):
        return (entity.name, entity.type, entity.number)
    if isinstance(entity, TypeSymbol):
        decl = getattr(entity.type, "decl", None)
        return (entity.name, entity.type, _texts(decl.attributes) if decl is not None else ())
    if isinstance(entity, GvlSymbol):
        return (entity.name, entity.qualified_only)
    if isinstance(entity, InterfaceSymbol):
        return (entity.name, tuple(map(id, entity.bases)))
    if isinstance(entity, t.Enum):
        flags = (entity.qualified_only, entity.strict, entity.default)
        return (entity.name, entity.base, tuple(entity.values.items()), flags)
    if isinstance(entity, t.Struct):
        return (entity.name, entity.union, id(entity.base))
    if isinstance(entity, t.FunctionBlock):
        return (entity.name, id(entity.base))
    assert isinstance(entity, t.Interface)
    return (entity.name,)


def _content_of_variable(v: VarSymbol) -> tuple[object, ...]:
    decl = v.decl
    placed = v.home is Storage.DIRECT
    return (
        v.name,
        v.type,
        v.section,
        v.flags,
        v.storage,
        v.home,
        v.owner,
        v.area,
        (v.offset, v.bit, v.type.size if v.type is not None else 0) if placed else v.bit is None,
        v.is_constant,
        v.constant.__class__,
        repr(v.constant),
        decl is not None and decl.initial is not None,
        _texts(decl.attributes) if decl is not None and decl.attributes else (),
    )


def _content_of_pou(pou: PouSymbol) -> tuple[object, ...]:
    node = pou.pou
    head = (
        (_texts(node.attributes), node.access, frozenset(node.modifiers), node.return_type is None)
        if node is not None
        else ()
    )
    return (
        pou.name,
        pou.qualified_name,
        pou.kind,
        pou.return_type,
        tuple((id(p), *_content_of_variable(p)) for p in pou.parameters),
        head,
        pou.kind == "FUNCTION_BLOCK" and node is not None and bool(node.body),
        id(pou.base),
        tuple(map(id, pou.interfaces)),
    )


def _texts(pragmas: Iterable[Any]) -> tuple[str, ...]:
    return tuple(pragma.text for pragma in pragmas)


# -- what has changed -------------------------------------------------------------------------------


@dataclass(frozen=True, slots=True, eq=False)
class _ChangedMembers:
    """Changed names inside one object."""

    identifiers: set[str]
    """Names of its members."""
    whole: bool
    """Whether those who name none of them are concerned, too."""

    def are_used_by(self, identifiers: frozenset[str]) -> bool:
        """Whether a body with these identifiers, which can have an instance, is invalidated."""
        return self.whole or not self.identifiers.isdisjoint(identifiers)


class Invalidation:
    """What declaring texts again has changed for others."""

    def __init__(
        self,
        before: Mapping[tuple[str, Key], tuple[object, ...]],
        gone: Made,
        made: Made,
        found: Collected,
        edited: frozenset[str],
        layout: Layout,
    ) -> None:
        """`before`: contents before; `gone`: what denotes nothing any more; `made`: what denotes the
        texts now; `found`: what they declare; `edited`: uris of the texts that are new; `layout`: of texts
        that are not declared again but have variables of types that are."""
        self.edited = edited
        self.identifiers: set[str] = set()
        """Global names that denote something else, or nothing."""
        self.pous: set[int] = set()
        """id() of POUs whose own variables have changed."""
        self._found = together(found, layout.found)
        tables = [*made.values(), *layout.made.values()]
        self._entities = [(key, entity) for table in tables for key, entity in table.items()]
        self._of_type: defaultdict[int, list[tuple[Key, Symbol]]] = defaultdict(list)
        """What has or returns values made of a type, by id() of it."""
        self._with_parameter: defaultdict[int, list[tuple[Key, Symbol]]] = defaultdict(list)
        """What has a parameter, by id() of it."""
        self._index()
        self._members: defaultdict[str, set[str]] = defaultdict(set)
        """Changed names inside objects, by upper-case name of the object."""
        self._shapes: set[int] = set()
        """id() of types that have changed as a whole."""
        self._changed: set[int] = set()
        after = contents(made)
        for place, content in after.items():
            if before.get(place) != content:
                uri, key = place
                self._mark_changed(key, made[uri][key])
        for table in gone.values():
            for key, entity in table.items():
                self._mark_changed(key, entity)
        self._propagate()
        self._enums_moved()
        self._by_text: defaultdict[str, list[_ChangedMembers]] = defaultdict(list)
        self._by_identifier: defaultdict[str, list[_ChangedMembers]] = defaultdict(list)
        """Names that denote a changed object, or what yields an instance."""
        self._by_variable: defaultdict[int, list[_ChangedMembers]] = defaultdict(list)
        """id() of the variables that hold or refer to an instance."""
        self._find_instances()

    def _index(self) -> None:
        for key, entity in self._entities:
            if isinstance(entity, PouSymbol):
                self._of_type[id(_inner(entity.return_type))].append((key, entity))
                for parameter in entity.parameters:
                    self._with_parameter[id(parameter)].append((key, entity))
            elif isinstance(entity, _WITH_TYPE):
                self._of_type[id(_inner(entity.type))].append((key, entity))

    def note(self, identifiers: Iterable[str]) -> None:
        """Other global names that mean something else now."""
        self.identifiers.update(identifiers)

    def note_sizes(self, before: Mapping[tuple[str, Key], int], after: Mapping[tuple[str, Key], int]) -> None:
        """Sizes are constants where they are asked for."""
        if before != after:
            self.identifiers.update(_OF_SIZE)

    def all_names(self) -> Iterator[str]:
        """Every name that has changed anywhere."""
        yield from self.identifiers
        for names in self._members.values():
            yield from names

    def invalidates(self, pou: PouSymbol, record: Record, identifiers: Identifiers) -> bool:
        """Whether a body has to be analysed again."""
        uri = identifiers.unit.source.uri
        if uri in self.edited or record.aggregates or id(pou) in self.pous:
            return True
        if not self.identifiers.isdisjoint(identifiers.all):
            return True
        for message in record.messages:
            if message.severity == "error" or any(r.uri in self.edited for r in message.related):
                return True
        reached = list(self._by_text.get(uri, ()))
        named = self._by_identifier.keys() & identifiers.all
        reached += [inside for name in named for inside in self._by_identifier[name]]
        reached += [i for key in self._by_variable.keys() & record.used for i in self._by_variable[key]]
        return any(inside.are_used_by(identifiers.all) for inside in reached)

    # -- names

    def _mark_changed(self, key: Key, entity: object) -> None:
        """Enters the names under which others know an entity that has changed."""
        self._changed.add(id(entity))
        kind, owner, name = key
        if not issubclass(kind, Symbol):
            self._shapes.add(id(entity))
        elif not owner or kind is EnumValueSymbol or getattr(entity, "section", "") == "VAR_GLOBAL":
            self.identifiers.add(name)
            if isinstance(entity, PouSymbol) and entity.instance is not None:
                self._shapes.add(id(entity.instance))
        else:
            self._members[_object_of(owner)].add(name.removeprefix("__GET").removeprefix("__SET"))
            if isinstance(entity, PouSymbol) and name == "FB_INIT" and entity.instance is not None:
                self._shapes.add(id(entity.instance))

    def _propagate(self) -> None:
        """What has a part or parameter of a changed type is changed, too."""
        changed: set[int] = set()
        shapes: set[int] = set()
        while len(changed) < len(self._changed) or len(shapes) < len(self._shapes):
            fresh = [entry for i in self._shapes - shapes for entry in self._of_type.get(i, ())]
            fresh += [entry for i in self._changed - changed for entry in self._with_parameter.get(i, ())]
            shapes, changed = set(self._shapes), set(self._changed)
            for key, entity in fresh:
                if id(entity) not in self._changed:
                    self._mark_changed(key, entity)
        for pou, _ in self._found.pous:
            for part in pou.with_children():
                own = self._found.own[id(part)].variables.values()
                if not self._changed.isdisjoint(map(id, own)) or id(part.result) in self._changed:
                    self.pous.add(id(part))

    def _enums_moved(self) -> None:
        """`Type.Value` leads to the place of the type."""
        for symbol, _, source in self._found.types:
            if source.uri in self.edited and isinstance(symbol.type, t.Enum):
                self.identifiers.add(symbol.name.upper())

    # -- who can have an instance

    def _find_instances(self) -> None:
        """Enters for each object that has changed inside how a body can have an instance of it."""
        inside: dict[int, _ChangedMembers] = {}
        for key, entity in self._entities:
            identifiers, whole = self._members.get(key[2], set()), id(entity) in self._shapes
            if (identifiers or whole) and not isinstance(entity, Symbol):
                inside[id(entity)] = _ChangedMembers(identifiers, whole)
        reach: defaultdict[int, list[_ChangedMembers]] = defaultdict(list)
        for name, types, texts in self._objects() if inside else ():
            found = [inside[id(type_)] for type_ in types if id(type_) in inside]
            if found:
                reach[id(types[0])] += found
                self._by_identifier[name.upper()] += found
                for text in texts:
                    self._by_text[text] += found
        for type_id, found in reach.items():
            for key, entity in self._of_type.get(type_id, ()):
                if isinstance(entity, VarSymbol):
                    self._by_variable[id(entity)] += found
                elif not isinstance(entity, (EnumValueSymbol, InterfaceSymbol)):
                    self._by_identifier[key[2].removeprefix("__GET")] += found

    def _objects(self) -> Iterator[tuple[str, list[Type | None], set[str]]]:
        """Every object with its type, those of its bases, and its texts."""
        for pou, _ in self._found.pous:
            if pou.instance is not None:
                yield pou.name, [block.instance for block in (pou, *_bases(pou))], _texts_of(pou)
        for symbol, _, source in self._found.types:
            types: list[Type | None] = [symbol.type]
            while isinstance(types[-1], t.Struct):
                types.append(types[-1].base)
            yield symbol.name, types, {source.uri}
        for interface, _, source in self._found.interfaces:
            texts = {source.uri} | {m.source.uri for m in interface.methods.values() if m.source is not None}
            yield interface.name, [one.type for one in (interface, *_base_interfaces(interface))], texts


def _object_of(owner: str) -> str:
    """The object that owns an entity: `FB_MOTOR` of `FB_Motor.Start result`."""
    return owner.upper().removeprefix("__STAT_").partition(".")[0].partition(" ")[0]


def _texts_of(pou: PouSymbol) -> set[str]:
    return {part.source.uri for part in pou.with_children() if part.source is not None}


def _bases(pou: PouSymbol) -> Iterator[PouSymbol]:
    base = pou.base
    while base is not None:
        yield base
        base = base.base


def _base_interfaces(interface: InterfaceSymbol) -> Iterator[InterfaceSymbol]:
    for base in interface.bases:
        yield base
        yield from _base_interfaces(base)


def _inner(type_: Type | None) -> Type | None:
    """What arrays, pointers and references are made of."""
    while type_.__class__ in _MADE_OF_ANOTHER:
        type_ = type_.element if isinstance(type_, t.Array) else type_.base
    return type_
