"""What an object of a type consists of: the one walk over members and elements.

`composed` is one level, `Holding` answers whether something lies anywhere inside (kept by type, for a program
has few types and many instances), `walk` goes through the parts with their paths and places. What looks for
remanent variables, instances with FB_Exit, monitored properties or texts with a path asks here.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Set
from dataclasses import dataclass, field
from typing import Generic, TypeVar

from tappet.lang import ast
from tappet.lang import types as t
from tappet.lang.symbols import GvlSymbol, PouSymbol, Storage

N = TypeVar("N")


def stored(type_: t.Type | None) -> Iterator[t.Member]:
    """Members whose bytes lie in an object of a type; of VAR_IN_OUT only the address does."""
    if isinstance(type_, t.FunctionBlock | t.Struct):
        for member in type_.members.values():
            if member.section != "VAR_IN_OUT":
                yield member


def composed(type_: t.Type | None) -> Iterator[t.Type]:
    """Types of the members or elements that lie in an object of a type."""
    if isinstance(type_, t.Array):
        yield type_.element
    else:
        for member in stored(type_):
            yield member.type


class Holding(Generic[N]):
    """Whether something wanted lies in a node or anywhere inside it; answers are kept."""

    def __init__(
        self,
        wanted: Callable[[N], bool],
        inside: Callable[[N], Iterable[N]],
        key: Callable[[N], int] = id,
        represented_by: Callable[[N], N] = lambda node: node,
    ) -> None:
        self._wanted = wanted
        self._inside = inside
        self._key = key
        self._represented_by = represented_by
        self._known: dict[int, bool] = {}

    def holds(self, node: N) -> bool:
        """Whether it is so; each node is looked into once."""
        node = self._represented_by(node)
        key = self._key(node)
        found = self._known.get(key)
        if found is None:
            self._known[key] = False  # a type that mentions itself has been refused already
            found = self._wanted(node) or any(self.holds(inner) for inner in self._inside(node))
            self._known[key] = found
        return found

    def forget(self, keys: Set[int]) -> None:
        """These nodes look different now."""
        for key in self._known.keys() & keys:
            del self._known[key]


def types_holding(wanted: Callable[[t.Type], bool]) -> Holding[t.Type]:
    """Whether an object of a type is, or has inside, one that is wanted."""
    return Holding(wanted, composed, represented_by=innermost)


def innermost(type_: t.Type) -> t.Type:
    """The type that the elements of an array have in the end, any other type itself."""
    while isinstance(type_, t.Array):
        type_ = type_.element
    return type_


@dataclass(frozen=True, slots=True)
class Part:
    """A variable, or a member or element inside it."""

    path: str
    offset: int
    type: t.Type
    flags: frozenset[str] = frozenset()
    decl: ast.VarDecl | None = field(default=None, compare=False)


def variables_of(owner: GvlSymbol | PouSymbol, path: str, offset: int) -> Iterator[Part]:
    """The variables of a list, or a program as a whole; `path` and `offset` are those of the owner."""
    if isinstance(owner, PouSymbol):
        if owner.instance is not None:
            yield Part(path, offset, owner.instance)
        return
    for v in owner.members.values():
        if v.storage is Storage.GLOBAL and v.type is not None:
            yield Part(f"{path}.{v.name}", offset + v.offset, v.type, v.flags, v.decl)


def walk(part: Part, visit: Callable[[Part], bool]) -> None:
    """Visit a variable and its parts in the order of memory, outer ones first; `visit` says whether to go
    inside."""
    if visit(part):
        for inner in _inside(part):
            walk(inner, visit)


def _inside(part: Part) -> Iterator[Part]:
    type_ = part.type
    if isinstance(type_, t.Array):
        for number, index in enumerate(type_.indices()):
            text = ", ".join(map(str, index))
            yield Part(f"{part.path}[{text}]", part.offset + number * type_.element.size, type_.element)
    for m in stored(type_):
        yield Part(f"{part.path}.{m.name}", part.offset + m.offset, m.type, m.flags, m.decl)
