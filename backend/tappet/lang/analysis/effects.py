"""What texts that were declared again mean to others: names that stand for something else now, and the bodies
that can tell.

A body finds what others declare by the words of its text and by the types of what these name. So a change of
a global name concerns the bodies with this word. A change inside an object concerns a body with the word that
can have an instance: it holds a name that leads to one, or uses a variable of the type.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from typing import Any

from tappet.lang import types as t
from tappet.lang.analysis.collected import Collected
from tappet.lang.analysis.context import Key, Record
from tappet.lang.analysis.relayout import Layout, together
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
_WITH_TYPE = (VarSymbol, PropertySymbol, TypeSymbol, EnumValueSymbol, InterfaceSymbol)
_MADE_OF_ANOTHER = (t.Array, t.Pointer, t.Reference)


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


@dataclass(frozen=True, slots=True, eq=False)
class _Inside:
    """Changed names inside one object."""

    words: set[str]
    """Names of its members."""
    whole: bool
    """Whether those who name none of them are concerned, too."""

    def concerns(self, words: frozenset[str]) -> bool:
        """Whether a body with these words, which can have an instance, can tell a difference."""
        return self.whole or not self.words.isdisjoint(words)


class Effects:
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
        """`before`: contents before; `gone`: what stands for nothing any more; `made`: what stands for the
        texts now; `found`: what they declare; `edited`: uris of the texts that are new; `layout`: of texts
        that are not declared again but have variables of types that are."""
        self.edited = edited
        self.words: set[str] = set()
        """Global names that stand for something else, or for nothing."""
        self.pous: set[int] = set()
        """id() of POUs whose own variables have changed."""
        self._found = together(found, layout.found)
        tables = [*made.values(), *layout.made.values()]
        self._things = [(key, thing) for table in tables for key, thing in table.items()]
        self._of_type: defaultdict[int, list[tuple[Key, Symbol]]] = defaultdict(list)
        """What has or returns values made of a type, by id() of it."""
        self._with_parameter: defaultdict[int, list[tuple[Key, Symbol]]] = defaultdict(list)
        """What has a parameter, by id() of it."""
        self._index()
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
        self._by_text: defaultdict[str, list[_Inside]] = defaultdict(list)
        self._by_word: defaultdict[str, list[_Inside]] = defaultdict(list)
        """Names that stand for a changed object, or for what yields an instance."""
        self._by_variable: defaultdict[int, list[_Inside]] = defaultdict(list)
        """id() of the variables that hold or refer to an instance."""
        self._find_instances()

    def _index(self) -> None:
        for key, thing in self._things:
            if isinstance(thing, PouSymbol):
                self._of_type[id(_inner(thing.return_type))].append((key, thing))
                for parameter in thing.parameters:
                    self._with_parameter[id(parameter)].append((key, thing))
            elif isinstance(thing, _WITH_TYPE):
                self._of_type[id(_inner(thing.type))].append((key, thing))

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
        reached = list(self._by_text.get(uri, ()))
        reached += [i for word in self._by_word.keys() & words.all for i in self._by_word[word]]
        reached += [i for key in self._by_variable.keys() & record.used for i in self._by_variable[key]]
        return any(inside.concerns(words.all) for inside in reached)

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
        told: set[int] = set()
        shapes: set[int] = set()
        while len(told) < len(self._told) or len(shapes) < len(self._shapes):
            fresh = [entry for i in self._shapes - shapes for entry in self._of_type.get(i, ())]
            fresh += [entry for i in self._told - told for entry in self._with_parameter.get(i, ())]
            shapes, told = set(self._shapes), set(self._told)
            for key, thing in fresh:
                if id(thing) not in self._told:
                    self._tell(key, thing)
        for pou, _ in self._found.pous:
            for part in pou.with_children():
                own = self._found.own[id(part)].variables.values()
                if not self._told.isdisjoint(map(id, own)) or id(part.result) in self._told:
                    self.pous.add(id(part))

    def _enums_moved(self) -> None:
        """`Type.Value` leads to the place of the type."""
        for symbol, _, source in self._found.types:
            if source.uri in self.edited and isinstance(symbol.type, t.Enum):
                self.words.add(symbol.name.upper())

    # -- who can have an instance

    def _find_instances(self) -> None:
        """Enters for each object that has changed inside how a body can have an instance of it."""
        inside: dict[int, _Inside] = {}
        for key, thing in self._things:
            words, whole = self._members.get(key[2], set()), id(thing) in self._shapes
            if (words or whole) and not isinstance(thing, Symbol):
                inside[id(thing)] = _Inside(words, whole)
        reach: defaultdict[int, list[_Inside]] = defaultdict(list)
        for name, types, texts in self._objects() if inside else ():
            found = [inside[id(type_)] for type_ in types if id(type_) in inside]
            if found:
                reach[id(types[0])] += found
                self._by_word[name.upper()] += found
                for text in texts:
                    self._by_text[text] += found
        for type_id, found in reach.items():
            for key, thing in self._of_type.get(type_id, ()):
                if isinstance(thing, VarSymbol):
                    self._by_variable[id(thing)] += found
                elif not isinstance(thing, (EnumValueSymbol, InterfaceSymbol)):
                    self._by_word[key[2].removeprefix("__GET")] += found

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


def _inner(type_: Type | None) -> Type | None:
    """What arrays, pointers and references are made of."""
    while type_.__class__ in _MADE_OF_ANOTHER:
        type_ = type_.element if isinstance(type_, t.Array) else type_.base
    return type_
