"""What is not known of a block, interface or structure: a name behind EXTENDS or IMPLEMENTS is not.

That name has its message; whether such a block has a member or fits a type is not known, and not reported.
"""

from __future__ import annotations

from tappet.lang import types as t
from tappet.lang.symbols import InterfaceSymbol, PouSymbol

_DEPTH_LIMIT = 1000


def has_unknown_base(block: PouSymbol | None) -> bool:
    """Whether a block, or a base of it, extends something unknown, and so may have any member."""
    for _ in range(_DEPTH_LIMIT):
        if block is None:
            return False
        if block.base is None:
            return block.pou is not None and bool(block.pou.extends)
        block = block.base
    return False


def has_unknown_heritage(block: PouSymbol | None) -> bool:
    """Whether a block may implement any interface: a base or an interface of it is unknown."""
    if has_unknown_base(block):
        return True
    for _ in range(_DEPTH_LIMIT):
        if block is None:
            return False
        declared = block.pou.implements if block.pou is not None else []
        if len(declared) > len(block.interfaces) or any(is_open(i) for i in block.interfaces):
            return True
        block = block.base
    return False


def is_open(interface: InterfaceSymbol | None) -> bool:
    """Whether an interface, or one that it extends, extends something unknown."""
    todo = [interface] if interface is not None else []
    seen: set[int] = set()
    while todo:
        current = todo.pop()
        if id(current) in seen:
            continue
        seen.add(id(current))
        node = current.type.pou if current.type is not None else None
        if node is not None and len(node.extends) > len(current.bases):
            return True
        todo += current.bases
    return False


def is_unknown_at_heart(type_: t.Type) -> bool:
    """Whether a type is a block, interface or structure of which a part is not known."""
    if isinstance(type_, t.Struct):
        base: t.Struct | None = type_
        while base is not None:
            if base.base is None:
                return base.decl is not None and bool(base.decl.extends)
            base = base.base
        return False
    symbol = type_.pou.symbol if isinstance(type_, (t.FunctionBlock, t.Interface)) and type_.pou else None
    if isinstance(symbol, PouSymbol):
        return has_unknown_heritage(symbol)
    return isinstance(symbol, InterfaceSymbol) and is_open(symbol)
