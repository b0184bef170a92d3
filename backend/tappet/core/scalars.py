"""Which scalar of the core IR holds a value of a language type."""

from __future__ import annotations

from tappet.core import ir
from tappet.lang import types as t

_SCALARS: dict[str, ir.Scalar] = {
    "BOOL": ir.BOOL,
    "BYTE": ir.U8, "WORD": ir.U16, "DWORD": ir.U32, "LWORD": ir.U64,
    "SINT": ir.I8, "INT": ir.I16, "DINT": ir.I32, "LINT": ir.I64,
    "USINT": ir.U8, "UINT": ir.U16, "UDINT": ir.U32, "ULINT": ir.U64,
    "REAL": ir.F32, "LREAL": ir.F64,
    "TIME": ir.U32, "DATE": ir.U32, "TIME_OF_DAY": ir.U32, "DATE_AND_TIME": ir.U32,
    "LTIME": ir.U64, "LDATE": ir.U64, "LTIME_OF_DAY": ir.U64, "LDATE_AND_TIME": ir.U64,
}  # fmt: skip


def scalar_of(type_: t.Type | None) -> ir.Scalar | None:
    """Scalar of a value of `type_`; None for strings and aggregates, which are handled by address."""
    cls = type_.__class__
    if cls is t.Elementary:
        return _SCALARS[type_.name]  # type: ignore[union-attr, index]
    if cls is t.Enum or cls is t.Subrange:
        return _SCALARS[type_.base.name]  # type: ignore[union-attr, index]
    if cls is t.Pointer or cls is t.Reference or cls is t.Interface:
        return ir.PTR
    return None


def require_scalar(type_: t.Type | None) -> ir.Scalar:
    """Scalar of a type that must have one."""
    scalar = scalar_of(type_)
    if scalar is None:
        raise TypeError(f"{type_} is no simple type")
    return scalar


NULL = ir.Const(ir.PTR, 0)


def convert(value: ir.Expr, target: ir.Scalar, mode: str = "round") -> ir.Expr:
    """`value` in `target`, folded when constant."""
    source = value.type
    if source is target:
        return value
    if isinstance(value, ir.Const) and not target.pointer and not source.pointer:
        folded = _fold(value.value, target)
        if folded is not None:
            return ir.Const(target, folded)
    if source.pointer and not target.pointer and (target.bits != 64 or target.floating):
        return ir.Convert(target, ir.Convert(ir.U64, value))
    if target.pointer and source.integer and source.bits < 64 and source.signed:
        return ir.Convert(target, ir.Convert(ir.I64, value))
    return ir.Convert(target, value, mode)


def _fold(value: int | float, target: ir.Scalar) -> int | float | None:
    if target.floating:
        return float(value)
    if isinstance(value, float):
        return None
    if target.bits == 1:
        return int(value) & 1
    cut = int(value) & ((1 << target.bits) - 1)
    if target.signed and cut >> (target.bits - 1):
        cut -= 1 << target.bits
    return cut
