"""Who may use what: PUBLIC, PROTECTED, PRIVATE, INTERNAL (LDEC-127; variables: IEC 61131-3:2013, 6.6.5)."""

from __future__ import annotations

from typing import Final

from tappet.lang.source import Source
from tappet.lang.symbols import PouSymbol, PropertySymbol, Symbol, VarSymbol

_DEEPEST: Final = 1000
"""Blocks that extend one another; more are a cycle, which is reported elsewhere."""


def may_use(symbol: Symbol, block: PouSymbol | None, source: Source) -> bool:
    """Whether a text of `source` may use a symbol; `block` is the program or function block it belongs to.

    PRIVATE: in the block that declares it. PROTECTED: there and in what extends it. INTERNAL: in its library;
    of an application: everywhere in it.
    """
    access = symbol.access
    if access == "INTERNAL":
        return symbol.source is None or symbol.source.library == source.library
    if access == "PRIVATE":
        return block is not None and _declares(block, symbol) and not _inherits(block, symbol)
    if access == "PROTECTED":
        return block is not None and _declares(block, symbol)
    return True


def _declares(block: PouSymbol, symbol: Symbol) -> bool:
    """Whether a block or one of its bases has this variable, method or property."""
    key = symbol.name.upper()
    if isinstance(symbol, VarSymbol):
        return block.locals.get(key) is symbol
    owner = _owner(symbol)
    walk: PouSymbol | None = block
    for _ in range(_DEEPEST):
        if walk is None or walk is owner:
            break
        walk = walk.base
    return walk is not None


def _inherits(block: PouSymbol, symbol: Symbol) -> bool:
    return block.base is not None and _declares(block.base, symbol)


def _owner(symbol: Symbol) -> PouSymbol | None:
    """The block of a method or property."""
    head = (symbol.getter or symbol.setter) if isinstance(symbol, PropertySymbol) else symbol
    return head.owner if isinstance(head, PouSymbol) else None


def home_of(symbol: Symbol) -> str | None:
    """Name of the block that declares a member, else of the library."""
    owner = _owner(symbol)
    if owner is not None:
        return owner.name
    if isinstance(symbol, VarSymbol) and symbol.owner is not None:
        return symbol.owner
    return symbol.source.library if symbol.source is not None else None
