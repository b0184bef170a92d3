"""Texts that need no more of an edited type than its size: they are laid out again and not declared again.

A text whose declarations hold the name of a block or structure only as the type of variables, without initial
value, depends on nothing else of it. So the variables and their symbols stay; offsets and sizes are new.
"""

from __future__ import annotations

from tappet.lang import ast
from tappet.lang import types as t
from tappet.lang.analysis.collected import Collected
from tappet.lang.analysis.context import Key, Session
from tappet.lang.analysis.declarations import Declarations
from tappet.lang.analysis.declare import lay_out_lists
from tappet.lang.analysis.heads import plain_body
from tappet.lang.source import Source
from tappet.lang.symbols import PouSymbol


class Layout:
    """The layout of the texts of which only that is made again."""

    def __init__(
        self, session: Session, whole: Collected, declarations: Declarations, texts: frozenset[str]
    ) -> None:
        self._session = session
        self._declarations = declarations
        self.found = _part(whole, texts)
        """What the texts declare."""
        self.made: dict[str, dict[Key, object]] = {
            uri: session.made[uri] for uri in texts if uri in session.made
        }
        """Its symbols and types."""
        self._types: list[t.Type] = []

    def forget(self) -> None:
        """From here on the layout is made when it is asked for."""
        for pou, _ in self.found.pous:
            if pou.instance is not None:
                pou.instance.members = {}
                self._declarations.blocks[id(pou.instance)] = pou
                self._types.append(pou.instance)
        for symbol, declaration, source in self.found.types:
            ref = declaration.type_ref
            if isinstance(symbol.type, t.Struct) and isinstance(ref, ast.StructType):
                body = plain_body(self._session, source)
                symbol.type.members = {}
                self._declarations.structs[id(symbol.type)] = (symbol.type, ref, body, declaration)
                self._declarations.laid_again.add(id(symbol.type))
                self._types.append(symbol.type)

    def complete(self) -> None:
        """Makes what nobody has asked for."""
        for type_ in self._types:
            self._declarations.complete(type_)
        lay_out_lists(self._session, self.found)
        self._declarations.laid_again.clear()


def _part(whole: Collected, texts: frozenset[str]) -> Collected:
    """What some texts declare; a block with all its methods when one of them has such a text."""

    def holds(source: Source | None) -> bool:
        return source is not None and source.uri in texts

    def concerns(pou: PouSymbol) -> bool:
        return any(holds(part.source) for part in pou.with_children())

    if not texts:
        return Collected(own=whole.own)
    return Collected(
        pous=[entry for entry in whole.pous if concerns(entry[0])],
        types=[entry for entry in whole.types if holds(entry[2])],
        gvls=[entry for entry in whole.gvls if holds(entry[1])],
        interfaces=[entry for entry in whole.interfaces if holds(entry[2])],
        own=whole.own,
    )


def together(one: Collected, other: Collected) -> Collected:
    """What two parts of the program declare."""
    return Collected(
        pous=[*one.pous, *other.pous],
        types=[*one.types, *other.types],
        gvls=[*one.gvls, *other.gvls],
        interfaces=[*one.interfaces, *other.interfaces],
        own=one.own | other.own,
    )
