"""Of which type an object is at run time: `__QUERYINTERFACE`, `__QUERYPOINTER`, assignment attempt `?=`.

An instance begins with the number of its type where others derive from it or it implements an interface; a
table per type that is asked for has a byte per number: 1 for those that fit.
"""

from __future__ import annotations

from tappet.core import assign, ir, places
from tappet.core.body import BUILTIN_VALUES, Body
from tappet.core.builtins import arguments
from tappet.core.scalars import NULL
from tappet.core.templates import VFTABLE
from tappet.core.virtual_calls import Static, fits
from tappet.lang import ast
from tappet.lang import types as t
from tappet.lang.analysis.attempts import object_of, referred
from tappet.lang.analysis.conversion import extends
from tappet.lang.symbols import BuiltinSymbol

_ANY_INTERFACE = t.Interface("")


def query(b: Body, e: ast.Call, symbol: BuiltinSymbol) -> ir.Expr:
    """`__QUERYINTERFACE(object, interface)` and `__QUERYPOINTER(object, pointer)`: whether there is such an
    object; the second operand gets its address, or NULL."""
    source, destination = arguments(e)
    instance = b.temp(ir.PTR)
    read = ir.Load(ir.PTR, ir.Place(instance))
    body: list[ir.Stmt] = [ir.Store(ir.Place(instance), _address(b, source))]
    slot = places.freeze(b, b.place(destination), body)
    b.touch(slot)
    if symbol.name == "__QUERYPOINTER":
        body.append(ir.Store(slot, read))
        return ir.Sequence(ir.BOOL, body, ir.Compare(ir.BOOL, "ne", read, NULL))
    found = b.temp(ir.BOOL)
    result = ir.Load(ir.BOOL, ir.Place(found))
    body.append(ir.Store(ir.Place(found), _is_of(b, read, source, destination)))
    body.append(ir.Store(slot, ir.Select(ir.PTR, result, read, NULL)))
    return ir.Sequence(ir.BOOL, body, result)


def attempt(b: Body, target: ast.Expr, source: ast.Expr) -> None:
    """`target ?= source`."""
    local = ir.Place(b.temp(ir.PTR))
    b.emit(ir.Store(local, _address(b, source)))
    read = ir.Load(ir.PTR, local)
    kept = ir.Place(b.temp(ir.PTR, once=False))
    b.emit(ir.Store(kept, ir.Select(ir.PTR, _is_of(b, read, source, target), read, NULL)))
    assign.assign(b, ":=", target, assign.held(b, kept, target))


def _address(b: Body, source: ast.Expr) -> ir.Expr:
    """Address of the object that an expression is or refers to."""
    return b.value_as(source, _ANY_INTERFACE)


def _is_of(b: Body, address: ir.Expr, source: ast.Expr, target: ast.Expr) -> ir.Expr:
    """Whether the object at `address`, which `source` names, is one that `target` may refer to."""
    assert source.type is not None
    assert target.type is not None
    static, wanted = object_of(source.type), referred(target.type)
    assert static is not None
    assert wanted is not None
    given = ir.Compare(ir.BOOL, "ne", address, NULL)
    if _derives(static, wanted):
        return given
    if isinstance(static, t.FunctionBlock) and VFTABLE not in static.members:
        return ir.Const(ir.BOOL, 0)
    number = ir.Load(ir.U32, ir.Place(ir.Indirect(address)))
    table = ir.Data(b.program.fitting(wanted))
    entry = ir.Place(table, 0, (ir.Subscript(number, 0, 1 << 31, 1, checked=False),))
    known = ir.Compare(ir.BOOL, "ne", ir.Load(ir.U8, entry), ir.Const(ir.U8, 0))
    return ir.ShortCircuit(ir.BOOL, "and", given, known)


def _derives(static: Static, wanted: Static) -> bool:
    """Whether every object behind `static` is one of `wanted`."""
    if isinstance(static, t.FunctionBlock):
        return fits(static, wanted)
    return isinstance(wanted, t.Interface) and extends(static, wanted)


BUILTIN_VALUES.update({"__QUERYINTERFACE": query, "__QUERYPOINTER": query})
