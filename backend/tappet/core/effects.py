"""Which memory a function can touch, its callees included."""

from __future__ import annotations

from dataclasses import dataclass, field

from tappet.core import ir
from tappet.core.walk import visit


@dataclass(slots=True)
class Effects:
    """Memory a function reads or writes."""

    data: set[str] = field(default_factory=set)
    """Data objects, by symbol."""
    pointers: bool = False
    """Anything whose address is known (pointers, VAR_IN_OUT)."""
    unknown: bool = False
    """Anything at all: code that is not part of the module."""
    calls: set[str] = field(default_factory=set)


def effects_of(module: ir.Module) -> dict[str, Effects]:
    """Effects of all functions, closed over calls."""
    found = {name: _own(module, function) for name, function in module.functions.items()}
    changed = True
    while changed:
        changed = False
        for effects in found.values():
            for name in effects.calls:
                callee = found.get(name)
                if callee is not None and _merge(effects, callee):
                    changed = True
    return found


def _merge(effects: Effects, callee: Effects) -> bool:
    before = (len(effects.data), effects.pointers, effects.unknown)
    effects.data |= callee.data
    effects.pointers |= callee.pointers
    effects.unknown |= callee.unknown
    return before != (len(effects.data), effects.pointers, effects.unknown)


def _own(module: ir.Module, function: ir.Function) -> Effects:
    effects = Effects()
    fields = {
        ir.Load: ("place",), ir.Store: ("place",), ir.Copy: ("target", "source"), ir.Fill: ("target",),
        ir.For: ("counter",),
    }  # fmt: skip

    def note(node: ir.Expr | ir.Stmt) -> None:
        kind = type(node)
        if kind in fields:
            for name in fields[kind]:
                base = getattr(node, name).base
                if isinstance(base, ir.Data):
                    effects.data.add(base.symbol)
                elif isinstance(base, ir.Indirect) and not base.own:
                    effects.pointers = True
        elif isinstance(node, ir.Call):
            if node.function in module.functions:
                effects.calls.add(node.function)
            else:
                effects.unknown = True
        elif kind is ir.CallPointer:
            effects.unknown = True
        elif kind is ir.CopyBytes or kind is ir.FillBytes:
            effects.pointers = True
        elif isinstance(node, ir.Intrinsic) and node.op in _MACHINE:
            effects.unknown = True

    visit(function.body, note)
    return effects


_MACHINE = {"setjmp", "longjmp", "load_acquire", "store_release", "fetch_add", "compare_swap", "fence"}
"""Operations that other threads take part in."""
