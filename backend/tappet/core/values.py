"""Values of simple types: names, members, bits, operators, assignments inside expressions."""

from __future__ import annotations

from tappet.core import ir
from tappet.core.body import VALUES, Body
from tappet.core.places import address_of, check_call
from tappet.core.scalars import convert, require_scalar, scalar_of
from tappet.lang import ast
from tappet.lang import types as t
from tappet.lang.symbols import VarSymbol

_COMPARE = {"=": "eq", "<>": "ne", "<": "lt", "<=": "le", ">": "gt", ">=": "ge"}
_ARITHMETIC = {
    "+": "add",
    "-": "sub",
    "*": "mul",
    "/": "div",
    "MOD": "rem",
    "AND": "and",
    "OR": "or",
    "XOR": "xor",
}
# The names of CoDeSys 2.3, by the bytes of the divisor; a wider one takes what is narrower.
_DIVISION_CHECKS_23 = {1: "CheckDivByte", 2: "CheckDivWord", 4: "CheckDivDWord"}


def variable_value(b: Body, e: ast.Name | ast.Member) -> ir.Expr:
    """Value of a variable or member, single bits included."""
    symbol = e.symbol
    if isinstance(symbol, VarSymbol):
        if symbol.is_constant and isinstance(symbol.constant, int | float) and e.type is not None:
            return ir.Const(require_scalar(e.type), symbol.constant)
        place = b.place(e)
        if symbol.bit is not None:
            return bit_value(ir.Load(ir.U8, place), symbol.bit)
        return ir.Load(require_scalar(e.type), place)
    raise b.error(f"'{e.name}' has no value", e)


def member_value(b: Body, e: ast.Member) -> ir.Expr:
    """Value of a member, or of one bit of an integer."""
    if e.bit is not None:
        return bit_value(b.value(e.base), e.bit)
    return variable_value(b, e)


def bit_value(value: ir.Expr, bit: int) -> ir.Expr:
    """One bit of an integer as BOOL."""
    if bit:
        value = ir.Binary(value.type, "shr", value, ir.Const(ir.U32, bit))
    return ir.Convert(ir.BOOL, value)


def _load(b: Body, e: ast.Expr) -> ir.Expr:
    return ir.Load(require_scalar(e.type), b.place(e))


def _this(b: Body, e: ast.Expr) -> ir.Expr:
    if b.own_data is None:
        raise b.error("there is no own instance here", e)
    b.program.expose(b.function, b.own_data, b.block)
    return address_of(b.own_data)


def _literal(b: Body, e: ast.Literal) -> ir.Expr:
    scalar = scalar_of(e.type)
    if scalar is None or not isinstance(e.value, int | float):
        raise b.error("this literal has no simple value", e)
    return ir.Const(scalar, e.value)


# -- operators --------------------------------------------------------------------------------------


def _unary(b: Body, e: ast.Unary) -> ir.Expr:
    scalar = require_scalar(e.operand_type or e.type)
    operand = convert(b.value(e.operand), scalar)
    if e.op == "+":
        return operand
    return ir.Unary(scalar, "neg" if e.op == "-" else "not", operand)


def _binary(b: Body, e: ast.Binary) -> ir.Expr:
    op = e.op
    if op in _COMPARE:
        return _comparison(b, e)
    if op == "AND_THEN":
        return ir.ShortCircuit(ir.BOOL, "and", b.value(e.left), b.value(e.right))
    if op == "OR_ELSE":
        return ir.ShortCircuit(ir.BOOL, "or", b.value(e.left), b.value(e.right))
    if op == "**":
        scalar = require_scalar(e.operand_type or e.type)
        return ir.Intrinsic(
            scalar, "pow", [convert(b.value(e.left), scalar), convert(b.value(e.right), scalar)]
        )
    if e.operand_type is None:
        return _time_arithmetic(b, e)
    if isinstance(e.operand_type, t.Pointer):
        return _pointer_arithmetic(b, e)
    scalar = require_scalar(e.operand_type)
    left = convert(b.value(e.left), scalar)
    right = convert(b.value(e.right), scalar)
    if op in ("/", "MOD"):
        return _division(b, e, scalar, left, right)
    return ir.Binary(scalar, _ARITHMETIC[op], left, right)


def _division(b: Body, e: ast.Binary, scalar: ir.Scalar, left: ir.Expr, right: ir.Expr) -> ir.Expr:
    """Division and MOD: CheckDiv functions see the divisor (LOPR-18); integers fault on zero without them."""
    constant = isinstance(right, ir.Const) and right.value != 0
    if not constant:
        right = _checked_divisor(b, e.right, right)
    op = _ARITHMETIC[e.op]
    if scalar.floating:
        return ir.Binary(scalar, op, left, right)
    return ir.Binary(scalar, op, left, right, checked=not constant)


def _checked_divisor(b: Body, e: ast.Expr, divisor: ir.Expr) -> ir.Expr:
    """The divisor as the application's check function for its type returns it; without one as it is."""
    scalar = divisor.type
    wide = "L" if scalar.size == 8 else ""
    check = b.check_function(f"CheckDiv{wide}{'Real' if scalar.floating else 'Int'}")
    if check is not None:
        return convert(check_call(b, check, [divisor]), scalar)
    if scalar.floating or wide:
        return divisor
    # The functions of 2.3 have no sign: what comes back is read in the divisor's own type.
    own = require_scalar(e.type)
    earlier = (b.check_function(name) for size, name in _DIVISION_CHECKS_23.items() if size >= own.size)
    check = next((found for found in earlier if found is not None), None)
    if check is None:
        return divisor
    return convert(convert(check_call(b, check, [convert(divisor, own)]), own), scalar)


def _comparison(b: Body, e: ast.Binary) -> ir.Expr:
    op = _COMPARE[e.op]
    type_ = e.operand_type or e.left.type
    if isinstance(type_, t.String):
        name = "wstrcompare" if type_.wide else "strcompare"
        order = ir.Intrinsic(ir.I32, name, [address_of(b.place(e.left)), address_of(b.place(e.right))])
        return ir.Compare(ir.BOOL, op, order, ir.Const(ir.I32, 0))
    scalar = require_scalar(type_)
    return ir.Compare(ir.BOOL, op, _comparable(b, e.left, scalar), _comparable(b, e.right, scalar))


def _comparable(b: Body, e: ast.Expr, scalar: ir.Scalar) -> ir.Expr:
    if isinstance(e.type, t.FunctionBlock):
        return convert(address_of(b.place(e)), scalar)
    return convert(b.value(e), scalar)


def _pointer_arithmetic(b: Body, e: ast.Binary) -> ir.Expr:
    """Pointer plus or minus bytes (LTYP-72)."""
    left, right = e.left, e.right
    if not isinstance(t.value_type(left.type), t.Pointer):  # type: ignore[arg-type]
        left, right = right, left
    count = convert(b.value(right), ir.I64)
    if e.op == "-":
        count = (
            ir.Const(ir.I64, -count.value) if isinstance(count, ir.Const) else ir.Unary(ir.I64, "neg", count)
        )
    return ir.Binary(ir.PTR, "offset", convert(b.value(left), ir.PTR), count)


_UNIT_NS = {
    "TIME": 1_000_000, "TIME_OF_DAY": 1_000_000, "DATE": 1_000_000_000, "DATE_AND_TIME": 1_000_000_000,
    "LTIME": 1, "LDATE": 1, "LTIME_OF_DAY": 1, "LDATE_AND_TIME": 1,
}  # fmt: skip
"""Nanoseconds per unit of the date and time types."""


def unit_ns(type_: t.Type | None) -> int:
    """Nanoseconds per unit of a date or time type; 0 for other types."""
    return _UNIT_NS.get(str(type_), 0)


def rescale(value: ir.Expr, source: int, target: int) -> ir.Expr:
    """A U64 count of `source` ns as count of `target` ns; fractions are dropped."""
    if source > target:
        return ir.Binary(ir.U64, "mul", value, ir.Const(ir.U64, source // target))
    if source < target:
        return ir.Binary(ir.U64, "div", value, ir.Const(ir.U64, target // source))
    return value


def _time_arithmetic(b: Body, e: ast.Binary) -> ir.Expr:
    """Dates with durations, durations with numbers: operands of different units."""
    left_type, right_type = t.value_type(e.left.type), t.value_type(e.right.type)  # type: ignore[arg-type]
    result = require_scalar(e.type)
    left, right = b.value(e.left), b.value(e.right)
    if e.op in ("*", "/"):
        if not unit_ns(left_type):
            left, right = right, left
        if e.op == "/" and not isinstance(right, ir.Const):
            right = _checked_divisor(b, e.right, right)
        if right.type.floating:
            product = ir.Binary(ir.F64, _ARITHMETIC[e.op], convert(left, ir.F64), convert(right, ir.F64))
            return convert(convert(product, ir.I64), result)
        if e.op == "/" and 64 in (left.type.bits, 0 if right.type.signed else right.type.bits):
            return convert(_divided_long_time(b, convert(left, ir.U64), right), result)
        wide = convert(right, ir.I64)
        checked = e.op == "/" and not (isinstance(wide, ir.Const) and wide.value)
        return convert(ir.Binary(ir.I64, _ARITHMETIC[e.op], convert(left, ir.I64), wide, checked), result)
    wide_left, wide_right = convert(left, ir.U64), convert(right, ir.U64)
    left_unit, right_unit, unit = unit_ns(left_type), unit_ns(right_type), unit_ns(t.value_type(e.type))  # type: ignore[arg-type]
    if left_unit == right_unit:
        difference = ir.Binary(ir.U64, _ARITHMETIC[e.op], wide_left, wide_right)
        return convert(rescale(difference, left_unit, unit), result)
    wide_right = rescale(wide_right, right_unit, unit)
    return convert(ir.Binary(ir.U64, _ARITHMETIC[e.op], wide_left, wide_right), result)


def _divided_long_time(b: Body, left: ir.Expr, right: ir.Expr) -> ir.Expr:
    """A 64 bit time or divisor without sign; the quotient by a negative number wraps."""
    if isinstance(right, ir.Const) or not right.type.signed:
        divisor = convert(right, ir.U64)
        if not isinstance(right, ir.Const):
            return ir.Binary(ir.U64, "div", left, divisor, True)
        if right.value >= 0:
            return ir.Binary(ir.U64, "div", left, divisor, not right.value)
        size = ir.Const(ir.U64, -int(right.value))
        return ir.Unary(ir.U64, "neg", ir.Binary(ir.U64, "div", left, size))
    local = b.temp(ir.I64)
    number = ir.Load(ir.I64, ir.Place(local))
    negative = ir.Compare(ir.BOOL, "lt", number, ir.Const(ir.I64, 0))
    size_of = convert(ir.Unary(ir.I64, "abs", number), ir.U64)
    held = b.temp(ir.U64)
    quotient = ir.Load(ir.U64, ir.Place(held))
    steps: list[ir.Stmt] = [
        ir.Store(ir.Place(local), convert(right, ir.I64)),
        ir.Store(ir.Place(held), ir.Binary(ir.U64, "div", left, size_of, True)),
    ]
    return ir.Sequence(
        ir.U64, steps, ir.Select(ir.U64, negative, ir.Unary(ir.U64, "neg", quotient), quotient)
    )


VALUES.update(
    {
        ast.Literal: _literal,
        ast.Name: variable_value,
        ast.Member: member_value,
        ast.Index: _load,
        ast.Deref: _load,
        ast.This: _this,
        ast.Super: _this,
        ast.Unary: _unary,
        ast.Binary: _binary,
    }
)
