"""FB_Init, FB_Exit, FB_Reinit and the methods called after them (LDEC-100..LDEC-109)."""

from __future__ import annotations

from tappet.core.program import attribute_value
from tappet.lang import types as t
from tappet.lang.symbols import PouSymbol


def init_methods(type_: t.FunctionBlock) -> list[PouSymbol]:
    """User-written FB_Init methods, base first (LDEC-107)."""
    return life_cycle_methods(type_, "FB_INIT")


def life_cycle_methods(type_: t.FunctionBlock, name: str) -> list[PouSymbol]:
    """FB_Init, FB_Exit or FB_Reinit of a type and its bases, base first."""
    found: list[PouSymbol] = []
    walk = type_.pou.symbol if type_.pou is not None else None
    while isinstance(walk, PouSymbol):
        method = walk.methods.get(name)
        if method is not None:
            found.insert(0, method)
        walk = walk.base
    return found


def contains_instance_with(type_: t.Type, name: str, seen: set[int] | None = None) -> bool:
    """Whether an object of a type is or contains an instance with FB_Exit or FB_Reinit. `seen`: id() of the
    types that were looked at."""
    seen = set() if seen is None else seen
    if isinstance(type_, t.Array):
        return contains_instance_with(type_.element, name, seen)
    if not isinstance(type_, t.FunctionBlock | t.Struct) or id(type_) in seen:
        return False
    seen.add(id(type_))
    if isinstance(type_, t.FunctionBlock) and life_cycle_methods(type_, name):
        return True
    return any(
        contains_instance_with(m.type, name, seen)
        for m in type_.members.values()
        if m.section != "VAR_IN_OUT"
    )


def after_init_methods(type_: t.FunctionBlock) -> list[PouSymbol]:
    """Methods with attribute call_after_init of a block that has it too (LDEC-109)."""
    found: list[PouSymbol] = []
    walk = type_.pou.symbol if type_.pou is not None else None
    while isinstance(walk, PouSymbol):
        if walk.pou is not None and attribute_value(walk.pou.attributes, "call_after_init") is not None:
            found += [
                m
                for m in walk.methods.values()
                if m.pou is not None and attribute_value(m.pou.attributes, "call_after_init") is not None
            ]
        walk = walk.base
    return found[::-1]
