"""FB_Init, FB_Exit, FB_Reinit and the methods called after them (LDEC-100..LDEC-109)."""

from __future__ import annotations

from collections.abc import Iterable

from tappet.core.program import Program, attribute_value
from tappet.lang import types as t
from tappet.lang.parts import Holding
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


def life_cycle_of(types: Iterable[t.Type]) -> dict[str, tuple[str, ...]]:
    """Which blocks, by upper-case name, have which of the methods, of their own or from a base."""
    found = {}
    for type_ in types:
        if isinstance(type_, t.FunctionBlock):
            methods = tuple(n for n in ("FB_EXIT", "FB_INIT", "FB_REINIT") if life_cycle_methods(type_, n))
            if methods:
                found[type_.name.upper()] = methods
    return dict(sorted(found.items()))


def holding(program: Program, name: str) -> Holding[t.Type]:
    """Which types are or contain an instance with FB_EXIT or FB_REINIT, whichever is named."""
    return program.holds(
        name, lambda type_: isinstance(type_, t.FunctionBlock) and bool(life_cycle_methods(type_, name))
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
