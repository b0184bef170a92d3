"""`__VARINFO(x)`: a structure of constants and the address of the variable."""

from __future__ import annotations

from tappet.core import assign, ir, places
from tappet.core.body import BUILTIN_PLACES, Body
from tappet.core.scalars import convert, require_scalar
from tappet.lang import ast
from tappet.lang import types as t
from tappet.lang.analysis.expressions import text_of
from tappet.lang.symbols import BuiltinSymbol, VarSymbol
from tappet.lang.variable_info import VAR_INFO, facts


def variable_info(b: Body, e: ast.Call, symbol: BuiltinSymbol) -> ir.Place:
    """Memory with the `VAR_INFO` of the operand."""
    operand = e.args[0].value
    assert operand is not None
    assert operand.type is not None
    named = getattr(operand, "symbol", None)
    bit = operand.bit if isinstance(operand, ast.Member) else None
    variable = named if isinstance(named, VarSymbol) else None
    known = facts(text_of(operand), operand.type, variable, bit)
    local = ir.Place(b.space(VAR_INFO.size, VAR_INFO.align))
    with b.block_of() as fill:
        for key, member in VAR_INFO.members.items():
            place = places.at(local, member.offset)
            if isinstance(member.type, t.String):
                text = known[key]
                assert isinstance(text, bytes)
                source = assign.constant_string(b, text, wide=False)
                assign.copy_place(b, place, member.type, source, t.String(max(len(text), 1)))
                continue
            scalar = require_scalar(member.type)
            number = known.get(key)
            value = _address(b, operand, scalar) if number is None else ir.Const(scalar, int(number))
            b.emit(ir.Store(place, value))
    address = ir.Address(ir.PTR, local)
    return ir.Place(ir.Indirect(ir.Sequence(ir.PTR, fill, address)))


def _address(b: Body, operand: ast.Expr, scalar: ir.Scalar) -> ir.Expr:
    inner = operand.base if isinstance(operand, ast.Member) and operand.bit is not None else operand
    place = b.place(inner)
    b.program.expose(b.function, place, inner.type)
    return convert(places.address_of(place), scalar)


BUILTIN_PLACES["__VARINFO"] = variable_info
