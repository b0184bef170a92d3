"""Operators in functional form: selection, shifts, mathematics, addresses, memory, system intrinsics."""

from __future__ import annotations

from collections.abc import Callable

from tappet.core import assign, heap, ir, places
from tappet.core.body import BUILTIN_PLACES, BUILTIN_STATEMENTS, BUILTIN_VALUES, Body
from tappet.core.scalars import NULL, convert, require_scalar
from tappet.lang import ast
from tappet.lang import types as t
from tappet.lang.symbols import BuiltinSymbol, PouSymbol, VarSymbol

_LIBM = {
    "LN": "log", "LOG": "log10", "EXP": "exp", "SIN": "sin", "COS": "cos", "TAN": "tan",
    "ASIN": "asin", "ACOS": "acos", "ATAN": "atan", "ATAN2": "atan2",
}  # fmt: skip


def arguments(e: ast.Call) -> list[ast.Expr]:
    """The operands."""
    return [a.value for a in e.args if a.value is not None]


# -- selection --------------------------------------------------------------------------------------


def _sel(b: Body, e: ast.Call, symbol: BuiltinSymbol) -> ir.Expr:
    gate, first, second = arguments(e)
    type_ = symbol.return_type
    return ir.Select(
        require_scalar(type_), b.value_as(gate, t.BOOL), b.value_as(second, type_), b.value_as(first, type_)
    )


def _mux_of(b: Body, e: ast.Call, scalar: ir.Scalar, pick: Callable[[ast.Expr], ir.Expr]) -> ir.Expr:
    """Nested choices on the number; out of range takes the last (LOPR-44)."""
    number, *values = arguments(e)
    chosen = b.value(number)
    local = b.temp(chosen.type)
    result = pick(values[-1])
    for position in range(len(values) - 2, -1, -1):
        test = ir.Compare(
            ir.BOOL, "eq", ir.Load(chosen.type, ir.Place(local)), ir.Const(chosen.type, position)
        )
        result = ir.Select(scalar, test, pick(values[position]), result)
    return ir.Sequence(scalar, [ir.Store(ir.Place(local), chosen)], result)


def _mux(b: Body, e: ast.Call, symbol: BuiltinSymbol) -> ir.Expr:
    type_ = symbol.return_type
    return _mux_of(b, e, require_scalar(type_), lambda v: b.value_as(v, type_))


def _extreme(b: Body, e: ast.Call, symbol: BuiltinSymbol) -> ir.Expr:
    type_ = symbol.return_type
    scalar = require_scalar(type_)
    values = [b.value_as(v, type_) for v in arguments(e)]
    if symbol.name == "LIMIT":
        low, value, high = values
        return ir.Binary(scalar, "min", ir.Binary(scalar, "max", value, low), high)
    result = values[0]
    for value in values[1:]:
        result = ir.Binary(scalar, symbol.name.lower(), result, value)
    return result


def text_address(b: Body, value: ast.Expr, type_: t.Type) -> ir.Expr:
    """Address of an operand that is read as `type_`; shorter strings are copied to its length."""
    same = value.type == type_ and not (value.is_constant and not places.is_place(value))
    if same:
        return places.address_of(b.place(value))
    local = b.space(type_.size, type_.align)
    with b.block_of() as fill:
        assign.copy_value(b, ir.Place(local), type_, value)
    return ir.Sequence(ir.PTR, fill, ir.Address(ir.PTR, ir.Place(local)))


def _sel_place(b: Body, e: ast.Call, symbol: BuiltinSymbol) -> ir.Place:
    gate, first, second = arguments(e)
    type_ = symbol.return_type
    assert type_ is not None
    chosen = ir.Select(
        ir.PTR, b.value_as(gate, t.BOOL), text_address(b, second, type_), text_address(b, first, type_)
    )
    return ir.Place(ir.Indirect(chosen))


def _mux_place(b: Body, e: ast.Call, symbol: BuiltinSymbol) -> ir.Place:
    type_ = symbol.return_type
    assert type_ is not None
    return ir.Place(ir.Indirect(_mux_of(b, e, ir.PTR, lambda v: text_address(b, v, type_))))


def _extreme_place(b: Body, e: ast.Call, symbol: BuiltinSymbol) -> ir.Place:
    """MAX, MIN, LIMIT of strings by character code."""
    type_ = symbol.return_type
    assert isinstance(type_, t.String)
    operands = [text_address(b, v, type_) for v in arguments(e)]
    if symbol.name == "LIMIT":
        low, value, high = operands
        return ir.Place(ir.Indirect(_choose(b, type_, "lt", _choose(b, type_, "gt", value, low), high)))
    result = operands[0]
    for operand in operands[1:]:
        result = _choose(b, type_, "gt" if symbol.name == "MAX" else "lt", result, operand)
    return ir.Place(ir.Indirect(result))


def _choose(b: Body, type_: t.String, op: str, left: ir.Expr, right: ir.Expr) -> ir.Expr:
    first, second = b.temp(ir.PTR), b.temp(ir.PTR)
    a, z = ir.Load(ir.PTR, ir.Place(first)), ir.Load(ir.PTR, ir.Place(second))
    order = ir.Intrinsic(ir.I32, "wstrcompare" if type_.wide else "strcompare", [a, z])
    store: list[ir.Stmt] = [ir.Store(ir.Place(first), left), ir.Store(ir.Place(second), right)]
    chosen = ir.Select(ir.PTR, ir.Compare(ir.BOOL, op, order, ir.Const(ir.I32, 0)), a, z)
    return ir.Sequence(ir.PTR, store, chosen)


# -- numbers ----------------------------------------------------------------------------------------


def _shift(b: Body, e: ast.Call, symbol: BuiltinSymbol) -> ir.Expr:
    operand, count = arguments(e)
    scalar = require_scalar(symbol.return_type)
    steps = b.value(count)
    if steps.type.bits == 64 and not isinstance(steps, ir.Const):
        steps = ir.Binary(ir.U64, "min", convert(steps, ir.U64), ir.Const(ir.U64, 255))
        if symbol.name in ("ROL", "ROR"):
            mask = ir.Const(ir.U64, 63)
            steps = ir.Binary(ir.U64, "and", convert(b.value(count), ir.U64), mask)
    elif isinstance(steps, ir.Const):
        number = int(steps.value) % (1 << 64)
        wide = number % scalar.bits if symbol.name in ("ROL", "ROR") else min(number, 255)
        steps = ir.Const(ir.U32, wide)
    value = convert(b.value(operand), scalar)
    return ir.Binary(scalar, symbol.name.lower(), value, convert(steps, ir.U32))


def _mathematics(b: Body, e: ast.Call, symbol: BuiltinSymbol) -> ir.Expr:
    scalar = require_scalar(symbol.return_type)
    values = [convert(b.value(v), scalar) for v in arguments(e)]
    if symbol.name == "SQRT":
        return ir.Unary(scalar, "sqrt", values[0])
    return ir.Intrinsic(scalar, _LIBM[symbol.name], values)


def _abs(b: Body, e: ast.Call, symbol: BuiltinSymbol) -> ir.Expr:
    scalar = require_scalar(symbol.return_type)
    value = convert(b.value(arguments(e)[0]), scalar)
    return ir.Unary(scalar, "abs", value) if scalar.signed else value


def _trunc(b: Body, e: ast.Call, symbol: BuiltinSymbol) -> ir.Expr:
    return convert(b.value(arguments(e)[0]), require_scalar(symbol.return_type), "trunc")


def _time(b: Body, e: ast.Call, symbol: BuiltinSymbol) -> ir.Expr:
    now = ir.Intrinsic(ir.I64, "now_ns", [])
    if symbol.name == "LTIME":
        return ir.Convert(ir.U64, now)
    return ir.Convert(ir.U32, ir.Binary(ir.I64, "div", now, ir.Const(ir.I64, 1_000_000)))


# -- addresses --------------------------------------------------------------------------------------


def _adr(b: Body, e: ast.Call, symbol: BuiltinSymbol) -> ir.Expr:
    operand = arguments(e)[0]
    target = getattr(operand, "symbol", None)
    if isinstance(target, PouSymbol):
        if target.kind == "PROGRAM":
            place = places.program_data(target)
            b.program.expose(b.function, place, target.instance)
            return ir.Address(ir.PTR, place)
        return ir.FunctionAddress(ir.PTR, b.program.function(target))
    place = b.place(operand)
    b.program.expose(b.function, place, operand.type)
    b.touch(place)
    return places.address_of(place)


def _adrinst(b: Body, e: ast.Call, symbol: BuiltinSymbol) -> ir.Expr:
    if b.own_data is None:
        raise b.error("there is no own instance here", e)
    b.program.expose(b.function, b.own_data, b.block)
    return places.address_of(b.own_data)


def _isvalidref(b: Body, e: ast.Call, symbol: BuiltinSymbol) -> ir.Expr:
    """Whether a reference is bound: a variable, a VAR_IN_OUT, what a property or call returns (LOPR-104)."""
    operand = arguments(e)[0]
    variable = getattr(operand, "symbol", None)
    if isinstance(variable, VarSymbol) and isinstance(variable.type, t.Reference):
        address: ir.Expr = ir.Load(ir.PTR, assign.reference_slot(b, operand))
    else:
        address = places.address_of(b.place(operand))
    return ir.Compare(ir.BOOL, "ne", address, NULL)


def _bound(b: Body, e: ast.Call, symbol: BuiltinSymbol) -> ir.Expr:
    array, dimension = arguments(e)
    number = dimension.constant
    assert isinstance(number, int)
    first = 8 if symbol.name == "LOWER_BOUND" else 16
    limit = ir.Load(ir.I64, places.at(b.place(array), first + 16 * (number - 1)))
    return ir.Convert(ir.I32, limit)


# -- system sources ---------------------------------------------------------------------------------


def _call_address(b: Body, e: ast.Call, symbol: BuiltinSymbol) -> ir.Expr:
    address, *rest = arguments(e)
    values = []
    for operand in rest:
        value = b.value(operand)
        if value.type.integer or value.type is ir.BOOL:
            value = convert(value, ir.I64 if value.type.signed else ir.U64)
        values.append(value)
    b.foreign_writes = True
    return ir.CallPointer(ir.I64, convert(b.value(address), ir.PTR), values)


def _setjmp(b: Body, e: ast.Call, symbol: BuiltinSymbol) -> ir.Expr:
    b.function.returns_twice = True
    return ir.Intrinsic(ir.I32, "setjmp", [convert(b.value(arguments(e)[0]), ir.PTR)])


def _longjmp(b: Body, e: ast.Call, symbol: BuiltinSymbol) -> None:
    buffer, value = arguments(e)
    b.emit(
        ir.Evaluate(
            ir.Intrinsic(ir.VOID, "longjmp", [convert(b.value(buffer), ir.PTR), b.value_as(value, t.DINT)])
        )
    )


def _frame_address(b: Body, e: ast.Call, symbol: BuiltinSymbol) -> ir.Expr:
    return ir.Intrinsic(ir.U64, "frame_address", [])


def _memcpy(b: Body, e: ast.Call, symbol: BuiltinSymbol) -> None:
    target, source, count = (b.value(v) for v in arguments(e))
    b.foreign_writes = True
    b.emit(ir.CopyBytes(convert(target, ir.PTR), convert(source, ir.PTR), convert(count, ir.U64)))


def _memset(b: Body, e: ast.Call, symbol: BuiltinSymbol) -> None:
    target, value, count = (b.value(v) for v in arguments(e))
    b.foreign_writes = True
    b.emit(ir.FillBytes(convert(target, ir.PTR), convert(value, ir.U8), convert(count, ir.U64)))


def _load_acquire(b: Body, e: ast.Call, symbol: BuiltinSymbol) -> ir.Expr:
    operand = arguments(e)[0]
    return ir.Intrinsic(require_scalar(operand.type), "load_acquire", [places.address_of(b.place(operand))])


def _store_release(b: Body, e: ast.Call, symbol: BuiltinSymbol) -> None:
    target, value = arguments(e)
    b.foreign_writes = True
    args = [places.address_of(b.place(target)), b.value_as(value, target.type)]
    b.emit(ir.Evaluate(ir.Intrinsic(ir.VOID, "store_release", args)))


def _exchange(b: Body, e: ast.Call, symbol: BuiltinSymbol) -> ir.Expr:
    pointer, *values = arguments(e)
    assert isinstance(pointer.type, t.Pointer)
    b.foreign_writes = True
    operands = [b.value(pointer), *(b.value_as(v, pointer.type.base) for v in values)]
    if symbol.name == "__XADD":
        return ir.Intrinsic(require_scalar(pointer.type.base), "fetch_add", operands)
    return ir.Intrinsic(ir.BOOL, "compare_swap", operands)


def _fence(b: Body, e: ast.Call, symbol: BuiltinSymbol) -> None:
    b.emit(ir.Evaluate(ir.Intrinsic(ir.VOID, "fence", [])))


BUILTIN_VALUES.update(
    {
        "SEL": _sel,
        "MUX": _mux,
        "MAX": _extreme,
        "MIN": _extreme,
        "LIMIT": _extreme,
        "SHL": _shift,
        "SHR": _shift,
        "ROL": _shift,
        "ROR": _shift,
        "SQRT": _mathematics,
        "ABS": _abs,
        "TRUNC": _trunc,
        "TRUNC_INT": _trunc,
        "TIME": _time,
        "LTIME": _time,
        "ADR": _adr,
        "ADRINST": _adrinst,
        "LOWER_BOUND": _bound,
        "UPPER_BOUND": _bound,
        "__ISVALIDREF": _isvalidref,
        "__NEW": heap.new,
        "__CALL": _call_address,
        "__SETJMP": _setjmp,
        "__FRAME_ADDRESS": _frame_address,
        "__LOAD_ACQUIRE": _load_acquire,
        "__XADD": _exchange,
        "__COMPARE_AND_SWAP": _exchange,
    }
)
BUILTIN_VALUES.update(dict.fromkeys(_LIBM, _mathematics))
BUILTIN_PLACES.update(
    {
        "SEL": _sel_place,
        "MUX": _mux_place,
        "MAX": _extreme_place,
        "MIN": _extreme_place,
        "LIMIT": _extreme_place,
    }
)
BUILTIN_STATEMENTS.update(
    {
        "__DELETE": heap.delete,
        "__LONGJMP": _longjmp,
        "__MEMCPY": _memcpy,
        "__MEMSET": _memset,
        "__STORE_RELEASE": _store_release,
        "__FENCE": _fence,
    }
)
