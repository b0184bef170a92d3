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


def contains_instance_with(type_: t.Type, name: str, known: dict[tuple[str, int], bool]) -> bool:
    """Whether an object of a type is or contains an instance with FB_EXIT or FB_REINIT, whichever is named.

    `known` keeps answers.
    """
    if isinstance(type_, t.Array):
        return contains_instance_with(type_.element, name, known)
    if not isinstance(type_, t.FunctionBlock | t.Struct):
        return False
    found = known.get((name, id(type_)))
    if found is None:
        known[name, id(type_)] = False
        found = isinstance(type_, t.FunctionBlock) and bool(life_cycle_methods(type_, name))
        inside = (m.type for m in type_.members.values() if m.section != "VAR_IN_OUT")
        found = known[name, id(type_)] = found or any(
            contains_instance_with(inner, name, known) for inner in inside
        )
    return found


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
