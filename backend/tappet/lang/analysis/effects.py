"""What texts that were declared again mean to others: names that stand for something else now, and the bodies
that can tell.

A body finds what others declare by the words of its text and by the types of what these name. So a change of
a global name concerns the bodies with this word. A change inside an object concerns a body with the word that
can have an instance: it holds a name that leads to one, or uses a variable of the type.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from typing import Any

from tappet.lang import types as t
from tappet.lang.analysis.collected import Collected
from tappet.lang.analysis.context import Key, Record
from tappet.lang.analysis.words import Words
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
"""What stands for the declarations of texts, by uri."""
_OF_SIZE = ("SIZEOF", "XSIZEOF")
_PINS = ("VAR_INPUT", "VAR_OUTPUT", "VAR_IN_OUT")


# -- what others can tell of a thing ----------------------------------------------------------------


def contents(made: Made) -> dict[tuple[str, Key], tuple[object, ...]]:
    """What others can tell of each thing but for the inside of its type; its place is not part of it."""
    return {(uri, key): _content(thing) for uri, table in made.items() for key, thing in table.items()}


def sizes(made: Made) -> dict[tuple[str, Key], int]:
    """Bytes of each type."""
    return {
        (uri, key): thing.size
        for uri, table in made.items()
        for key, thing in table.items()
        if isinstance(thing, (t.Struct, t.FunctionBlock, t.Enum))
    }


def _content(thing: object) -> tuple[object, ...]:
    if isinstance(thing, VarSymbol):
        return _content_of_variable(thing)
    if isinstance(thing, PouSymbol):
        return _content_of_pou(thing)
    if isinstance(thing, PropertySymbol):
        return (thing.name, thing.type, thing.getter is None, thing.setter is None)
    if isinstance(thing, EnumValueSymbol):
        return (thing.name, thing.type, thing.number)
    if isinstance(thing, TypeSymbol):
        decl = getattr(thing.type, "decl", None)
        return (thing.name, thing.type, _texts(decl.attributes) if decl is not None else ())
    if isinstance(thing, GvlSymbol):
        return (thing.name, thing.qualified_only)
    if isinstance(thing, InterfaceSymbol):
        return (thing.name, tuple(map(id, thing.bases)))
    if isinstance(thing, t.Enum):
        flags = (thing.qualified_only, thing.strict, thing.default)
        return (thing.name, thing.base, tuple(thing.values.items()), flags)
    if isinstance(thing, t.Struct):
        return (thing.name, thing.union, id(thing.base))
    if isinstance(thing, t.FunctionBlock):
        return (thing.name, id(thing.base))
    assert isinstance(thing, t.Interface)
    return (thing.name,)


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


@dataclass(slots=True)
class _Inside:
    """Changed names inside one object, and who can have an instance of it."""

    words: set[str]
    """Names of its members."""
    whole: bool
    """Whether those who name none of them are concerned, too."""
    texts: set[str]
    """Its own texts and those of derived objects."""
    leading: set[str] = field(default_factory=set)
    """Names that stand for it, or for what yields an instance."""
    variables: set[int] = field(default_factory=set)
    """id() of the variables that hold or refer to an instance."""

    def concerns(self, uri: str, words: frozenset[str], record: Record) -> bool:
        if not self.whole and self.words.isdisjoint(words):
            return False
        return (
            uri in self.texts
            or not self.leading.isdisjoint(words)
            or not self.variables.isdisjoint(record.used)
        )


class Effects:
    """What declaring texts again has changed for others."""

    def __init__(
        self,
        before: Mapping[tuple[str, Key], tuple[object, ...]],
        gone: Made,
        made: Made,
        found: Collected,
        edited: frozenset[str],
    ) -> None:
        """`before`: contents before; `gone`: what stands for nothing any more; `made`: what stands for the
        texts now; `found`: what they declare; `edited`: uris of the texts that are new."""
        self.edited = edited
        self.words: set[str] = set()
        """Global names that stand for something else, or for nothing."""
        self.pous: set[int] = set()
        """id() of POUs whose own variables have changed."""
        self._found = found
        self._things = [(key, thing) for table in made.values() for key, thing in table.items()]
        self._members: defaultdict[str, set[str]] = defaultdict(set)
        """Changed names inside objects, by upper-case name of the object."""
        self._shapes: set[int] = set()
        """id() of types that have changed as a whole."""
        self._told: set[int] = set()
        after = contents(made)
        for place, content in after.items():
            if before.get(place) != content:
                uri, key = place
                self._tell(key, made[uri][key])
        for table in gone.values():
            for key, thing in table.items():
                self._tell(key, thing)
        self._spread()
        self._enums_moved()
        self._inside = list(self._insides())

    def note(self, words: Iterable[str]) -> None:
        """Other global names that mean something else now."""
        self.words.update(words)

    def note_sizes(self, before: Mapping[tuple[str, Key], int], after: Mapping[tuple[str, Key], int]) -> None:
        """Sizes are constants where they are asked for."""
        if before != after:
            self.words.update(_OF_SIZE)

    def all_words(self) -> Iterator[str]:
        """Every name that has changed anywhere."""
        yield from self.words
        for names in self._members.values():
            yield from names

    def concern(self, pou: PouSymbol, record: Record, words: Words) -> bool:
        """Whether a body has to be analysed again."""
        uri = words.unit.source.uri
        if uri in self.edited or record.aggregates or id(pou) in self.pous:
            return True
        if not self.words.isdisjoint(words.all):
            return True
        for message in record.messages:
            if message.severity == "error" or any(r.uri in self.edited for r in message.related):
                return True
        return any(inside.concerns(uri, words.all, record) for inside in self._inside)

    # -- names

    def _tell(self, key: Key, thing: object) -> None:
        """Enters the names under which others know a thing that has changed."""
        self._told.add(id(thing))
        kind, owner, name = key
        if not issubclass(kind, Symbol):
            self._shapes.add(id(thing))
        elif not owner or kind is EnumValueSymbol or getattr(thing, "section", "") == "VAR_GLOBAL":
            self.words.add(name)
            if isinstance(thing, PouSymbol) and thing.instance is not None:
                self._shapes.add(id(thing.instance))
        else:
            self._members[_object_of(owner)].add(name.removeprefix("__GET").removeprefix("__SET"))
            if isinstance(thing, PouSymbol) and name == "FB_INIT" and thing.instance is not None:
                self._shapes.add(id(thing.instance))

    def _spread(self) -> None:
        """What has a part or parameter of a changed type is changed, too."""
        told = self._told
        size = -1
        while size != len(told) + len(self._shapes):
            size = len(told) + len(self._shapes)
            for key, thing in self._things:
                if id(thing) in told:
                    continue
                if isinstance(thing, PouSymbol):
                    changed = any(id(p) in told for p in thing.parameters)
                    changed = changed or mentions(thing.return_type, self._shapes)
                else:
                    type_ = getattr(thing, "type", None) if isinstance(thing, Symbol) else None
                    changed = type_ is not None and mentions(type_, self._shapes)
                if changed:
                    self._tell(key, thing)
        for pou, _ in self._found.pous:
            for part in pou.with_children():
                own = self._found.own[id(part)].variables.values()
                if any(id(v) in told for v in own) or (part.result is not None and id(part.result) in told):
                    self.pous.add(id(part))

    def _enums_moved(self) -> None:
        """`Type.Value` leads to the place of the type."""
        for symbol, _, source in self._found.types:
            if source.uri in self.edited and isinstance(symbol.type, t.Enum):
                self.words.add(symbol.name.upper())

    # -- who can have an instance

    def _insides(self) -> Iterator[_Inside]:
        objects: list[tuple[str, Type | None, set[str]]] = []
        for pou, _ in self._found.pous:
            objects.append((pou.name, pou.instance, _texts_of(pou)))
        for type_symbol, _, source in self._found.types:
            objects.append((type_symbol.name, type_symbol.type, {source.uri}))
        for interface, _, source in self._found.interfaces:
            texts = {source.uri} | {m.source.uri for m in interface.methods.values() if m.source is not None}
            objects.append((interface.name, interface.type, texts))
        for name, type_, texts in objects:
            words = self._members.get(name.upper(), set())
            whole = id(type_) in self._shapes
            if (words or whole) and type_ is not None:
                yield self._inside_of(name, type_, _Inside(words, whole, texts))

    def _inside_of(self, name: str, type_: Type, inside: _Inside) -> _Inside:
        types = {id(type_)}
        inside.leading.add(name.upper())
        for pou, _ in self._found.pous:
            if any(base.instance is type_ for base in _bases(pou)):
                types.add(id(pou.instance))
                inside.leading.add(pou.name.upper())
                inside.texts |= _texts_of(pou)
        for symbol, _, _ in self._found.types:
            base = symbol.type.base if isinstance(symbol.type, t.Struct) else None
            while base is not None:
                if base is type_:
                    types.add(id(symbol.type))
                base = base.base
        for interface, _, _ in self._found.interfaces:
            if any(base.type is type_ for base in _base_interfaces(interface)):
                types.add(id(interface.type))
                inside.leading.add(interface.name.upper())
        for key, thing in self._things:
            if isinstance(thing, VarSymbol):
                if thing.type is not None and mentions(thing.type, types):
                    inside.variables.add(id(thing))
            elif isinstance(thing, PouSymbol):
                if mentions(thing.return_type, types):
                    inside.leading.add(key[2].removeprefix("__GET"))
            elif isinstance(thing, (TypeSymbol, PropertySymbol)) and mentions(thing.type, types):
                inside.leading.add(key[2])
        return inside


def _object_of(owner: str) -> str:
    """The object that owns a thing: `FB_MOTOR` of `FB_Motor.Start result`."""
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


def mentions(type_: Type | None, types: set[int]) -> bool:
    """Whether a type is one of `types`, by id(), or is made of one: array, pointer, reference."""
    while True:
        if isinstance(type_, t.Array):
            type_ = type_.element
        elif isinstance(type_, (t.Pointer, t.Reference)):
            type_ = type_.base
        else:
            return id(type_) in types
