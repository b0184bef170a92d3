"""`<T1>_TO_<T2>`: numbers, times, dates; text through the conversion library in ST (LOPR-70..79)."""

from __future__ import annotations

from tappet.core import assign, calls, ir, places
from tappet.core.body import BUILTIN_PLACES, BUILTIN_VALUES, Body
from tappet.core.scalars import convert, require_scalar
from tappet.core.values import rescale, unit_ns
from tappet.lang import ast
from tappet.lang import types as t
from tappet.lang.symbols import BuiltinSymbol, PouSymbol
from tappet.lang.types import Kind

_DAY_NS = 86_400_000_000_000
_TO_TEXT = {
    Kind.BOOL: "BOOL_AS_TEXT", Kind.BITS: "UNSIGNED_AS_TEXT", Kind.UNSIGNED: "UNSIGNED_AS_TEXT",
    Kind.SIGNED: "SIGNED_AS_TEXT",
}  # fmt: skip
_FROM_TEXT = {
    Kind.BITS: "TEXT_AS_INTEGER", Kind.UNSIGNED: "TEXT_AS_INTEGER", Kind.SIGNED: "TEXT_AS_INTEGER",
    Kind.REAL: "TEXT_AS_REAL",
}  # fmt: skip
_CLOCK_TEXT = {
    "TIME": "TIME", "LTIME": "LTIME", "DATE": "DATE", "LDATE": "DATE", "TIME_OF_DAY": "TOD",
    "LTIME_OF_DAY": "TOD", "DATE_AND_TIME": "DT", "LDATE_AND_TIME": "DT",
}  # fmt: skip
_LARGEST = {32: 3.4028235677973362e38, 64: 1.7976931348623157e308}
"""The largest text of a REAL and LREAL: what follows is rounded to infinity."""
_LONG_PREFIX = {"LDATE", "LTIME_OF_DAY", "LDATE_AND_TIME"}


def _operand(e: ast.Call) -> ast.Expr:
    value = e.args[0].value
    assert value is not None
    return value


def conversion_value(b: Body, e: ast.Call, symbol: BuiltinSymbol) -> ir.Expr:
    """A conversion with a simple result."""
    source, target = symbol.parameter_types[0], symbol.return_type
    assert source is not None
    assert target is not None
    if isinstance(source, t.String):
        return _from_text(b, e, source, target)
    value = b.value_as(_operand(e), source) if not isinstance(source, t.Pointer) else b.value(_operand(e))
    return convert_number(value, source, target)


def convert_number(value: ir.Expr, source: t.Type, target: t.Type) -> ir.Expr:
    """Conversion between simple types."""
    scalar = require_scalar(target)
    if scalar is ir.BOOL:
        if value.type is ir.BOOL:
            return value
        if value.type.pointer:
            value = convert(value, ir.U64)
        return ir.Compare(ir.BOOL, "ne", value, ir.Const(value.type, 0))
    from_unit, to_unit = unit_ns(source), unit_ns(target)
    if from_unit and to_unit and source != target:
        return _convert_clock(value, source, target)
    return convert(value, scalar)


def _convert_clock(value: ir.Expr, source: t.Type, target: t.Type) -> ir.Expr:
    """Between times and dates: units are scaled, DATE drops the time of day, TOD keeps only it."""
    wide: ir.Expr = convert(value, ir.U64)
    kinds = (_CLOCK_TEXT[str(source)], _CLOCK_TEXT[str(target)])
    if kinds[1] in ("DATE", "TOD") and kinds[0] == "DT":
        day = ir.Const(ir.U64, _DAY_NS // unit_ns(source))
        rest = ir.Binary(ir.U64, "rem", wide, day)
        wide = (
            rest if kinds[1] == "TOD" else ir.Binary(ir.U64, "sub", wide, ir.Binary(ir.U64, "rem", wide, day))
        )
    return convert(rescale(wide, unit_ns(source), unit_ns(target)), require_scalar(target))


# -- text -------------------------------------------------------------------------------------------


def library_function(b: Body, name: str, node: ast.Node) -> PouSymbol:
    """A function of the conversion library."""
    found = b.program.library_function(name)
    if found is None:
        raise b.error(f"function {name} of the conversion library is missing", node)
    return found


def _call(b: Body, name: str, args: list[ir.Expr], node: ast.Node) -> calls.Prepared:
    """Call of a library function with ready values; a text result goes to fresh memory."""
    target = library_function(b, name, node)
    prepared = calls.Prepared()
    values: list[ir.Expr] = []
    result = target.return_type
    scalar = ir.VOID
    if isinstance(result, t.String):
        prepared.result = ir.Place(b.space(result.size, result.align))
        values.append(ir.Address(ir.PTR, prepared.result))
    else:
        scalar = require_scalar(result)
    for arg, parameter in zip(args, target.parameters, strict=True):
        aggregate = isinstance(parameter.type, t.String)
        values.append(arg if aggregate else convert(arg, require_scalar(parameter.type)))
    prepared.call = ir.Call(scalar, b.program.function(target), values)
    return prepared


def conversion_place(b: Body, e: ast.Call, symbol: BuiltinSymbol) -> ir.Place:
    """A conversion to STRING or WSTRING."""
    source, target = symbol.parameter_types[0], symbol.return_type
    assert source is not None
    assert isinstance(target, t.String)
    if isinstance(source, t.String):
        if source.wide == target.wide:
            return b.place(_operand(e))
        name = "WIDE_AS_TEXT" if source.wide else "TEXT_AS_WIDE"
        return calls.as_place(b, _call(b, name, [_text_argument(b, e, source)], e))
    prepared = _text_of(b, e, source)
    if not target.wide:
        return calls.as_place(b, prepared)
    long = t.String(255)
    local = ir.Place(b.space(long.size, long.align))
    with b.block_of() as fill:
        assign.copy_place(b, local, long, calls.as_place(b, prepared), t.String(80))
    text = ir.Sequence(ir.PTR, fill, ir.Address(ir.PTR, local))
    return calls.as_place(b, _call(b, "TEXT_AS_WIDE", [text], e))


def _text_of(b: Body, e: ast.Call, source: t.Type) -> calls.Prepared:
    value = b.value_as(_operand(e), source) if not isinstance(source, t.Pointer) else b.value(_operand(e))
    if isinstance(source, t.Pointer):
        return _call(b, "UNSIGNED_AS_TEXT", [value], e)
    name = str(source)
    clock = _CLOCK_TEXT.get(name)
    if clock is not None:
        wide = rescale(convert(value, ir.U64), unit_ns(source), 1)
        if clock in ("TIME", "LTIME"):
            return _call(b, f"{clock}_AS_TEXT", [wide], e)
        return _call(b, f"{clock}_AS_TEXT", [wide, ir.Const(ir.BOOL, int(name in _LONG_PREFIX))], e)
    assert isinstance(source, t.Elementary)
    if source.kind is Kind.REAL:
        digits = 7 if source is t.REAL else 16
        return _call(b, "REAL_AS_TEXT", [convert(value, ir.F64), ir.Const(ir.I32, digits)], e)
    return _call(b, _TO_TEXT[source.kind], [value], e)


def _text_argument(b: Body, e: ast.Call, source: t.String) -> ir.Expr:
    """Address of the operand as STRING(255), which the library functions take."""
    from tappet.core.builtins import text_address

    return text_address(b, _operand(e), t.String(255, source.wide))


def _from_text(b: Body, e: ast.Call, source: t.String, target: t.Type) -> ir.Expr:
    """Text that is no valid literal of the target type gives 0 (LOPR-76)."""
    text = _text_argument(b, e, source)
    if source.wide:
        text = places.address_of(calls.as_place(b, _call(b, "WIDE_AS_TEXT", [text], e)))
    scalar = require_scalar(target)
    if scalar is ir.BOOL:
        return calls.as_value(b, _call(b, "TEXT_AS_BOOL", [text], e))
    clock = _CLOCK_TEXT.get(str(target))
    if clock is not None:
        name = "TEXT_AS_TIME" if clock in ("TIME", "LTIME") else f"TEXT_AS_{clock}"
        unit = unit_ns(target)
        limit = ir.Const(ir.U64, min((1 << scalar.bits) * unit, 1 << 64) - 1)
        value = calls.as_value(b, _call(b, name, [text, limit], e))
        return convert(rescale(convert(value, ir.U64), 1, unit), scalar)
    assert isinstance(target, t.Elementary)
    args = [text, ir.Const(ir.F64, _LARGEST[scalar.bits])] if target.kind is Kind.REAL else [text]
    return convert(calls.as_value(b, _call(b, _FROM_TEXT[target.kind], args, e)), scalar)


BUILTIN_VALUES["CONVERT"] = conversion_value
BUILTIN_PLACES["CONVERT"] = conversion_place
