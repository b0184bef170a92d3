"""Calls of methods, accessors and bodies that the type of the instance selects.

Which blocks an instance may be of follows from the static type: those derived from a block, those that
implement an interface. Where all of them share one body, and the instance is no interface variable that may
hold nothing, the call is a direct one.
"""

from __future__ import annotations

from tappet.core import ir
from tappet.core.body import Body
from tappet.core.program import Program
from tappet.lang import types as t
from tappet.lang.analysis.conversion import implements
from tappet.lang.symbols import PouSymbol

BODY = "__BODY"
"""Name of a block's body in its table of methods."""

Static = t.FunctionBlock | t.Interface
"""What the type of an instance is known from."""


def is_fixed(target: PouSymbol) -> bool:
    """Whether no derived block replaces `target`: an action of a block with no_virtual_actions (LSFC-26)."""
    owner = target.owner
    return target.kind == "ACTION" and owner is not None and target.name.upper() not in owner.vtable


def call_virtual(
    b: Body, name: str, static: Static, scalar: ir.Scalar, values: list[ir.Expr], declared: PouSymbol
) -> ir.Expr:
    """Call of what `name` denotes in the instance `values[0]`; `declared` is what its static type has."""
    program = b.program
    if isinstance(static, t.FunctionBlock):
        bodies = {id(method): method for method in _declared(program, name, static)}
        if len(bodies) < 2:
            only = next(iter(bodies.values()), declared)
            return ir.Call(scalar, program.function(only), values)
    program.dispatched.setdefault(name)
    return ir.CallVirtual(scalar, _method(program, name, static), values)


def _declared(program: Program, name: str, static: t.FunctionBlock) -> list[PouSymbol]:
    """Bodies of a name in all blocks that are a block or derived from it, instances or not."""
    return [
        pou.vtable[name]
        for pou in program.having.get(name, ())
        if pou.instance is not None and fits(pou.instance, static)
    ]


def fits(block: t.FunctionBlock, static: Static) -> bool:
    """Whether an instance of `block` can be behind a reference of type `static`."""
    if isinstance(static, t.Interface):
        return implements(block, static)
    walk: t.FunctionBlock | None = block
    while walk is not None and walk is not static:
        walk = walk.base
    return walk is not None


def _method(program: Program, name: str, static: Static) -> ir.VirtualMethod:
    found = program.virtual.get((id(static), name))
    if found is None:
        key = f"virtual {_static_name(program, static)}.{name}"
        while key in program.module.virtual:
            key += "'"
        method = program.module.virtual[key] = ir.VirtualMethod(key)
        found = program.virtual[(id(static), name)] = (method, name, static)
    return found[0]


def _static_name(program: Program, static: Static) -> str:
    if isinstance(static, t.FunctionBlock):
        return program.block_name(static)
    return static.name.upper()
