"""Unary and binary operators: operand types, result types, folding (language_operators.md 2, 3, 6)."""

from __future__ import annotations

import math
from collections.abc import Callable

from tappet.lang import ast
from tappet.lang import types as t
from tappet.lang.analysis import constant_overflow, conversion, folding
from tappet.lang.analysis.adaptation import adapt_choice, as_zero, complain, narrow, retype
from tappet.lang.analysis.context import Body
from tappet.lang.types import Elementary, Kind, Type

_ORDER = frozenset({"<", ">", "<=", ">="})
COMPARISONS = _ORDER | {"=", "<>"}
_NUMBERS = frozenset({Kind.BITS, Kind.SIGNED, Kind.UNSIGNED, Kind.REAL})
_LONG_DATES = frozenset({"LDATE", "LTIME_OF_DAY", "LDATE_AND_TIME"})
_DAYS = (t.DATE, t.LDATE)
"""Dates without time of day: there is nothing a duration could be added to."""


def unary(b: Body, e: ast.Unary) -> None:
    """Resolves `-x`, `+x`, `NOT x` whose operand is analysed."""
    operand = e.operand
    e.type = e.operand_type = None
    e.is_constant = e.untyped = False
    e.constant = None
    if operand.type is None:
        return
    if e.op == "NOT" and operand.__class__ is ast.Call:
        as_zero(operand, t.BOOL)
    base = t.value_type(operand.type)
    if e.op == "NOT":
        if not isinstance(base, Elementary) or not (base.is_integer or base is t.BOOL):
            b.report("E0303", e.span, op="NOT", type=operand.type, hint="NOT needs BOOL or a bit string.")
            return
        e.type = e.operand_type = base
        if operand.is_constant:
            _fold_not(e, operand, base)
        return
    if not isinstance(base, Elementary) or base.kind in (Kind.BOOL, Kind.DATE):
        b.report("E0303", e.span, op=e.op, type=operand.type, hint="A number is needed.")
        return
    if base.kind is Kind.TIME and e.op == "-":
        b.report("E0303", e.span, op=e.op, type=operand.type, hint="There are no negative times.")
        return
    computed: Elementary = base
    if base.is_integer and base.size < 4:
        computed = t.DINT
    elif e.op == "-" and base in (t.UDINT, t.DWORD):
        computed = t.LINT
    e.type, e.operand_type = base, computed
    if operand.is_constant:
        value = operand.constant
        assert isinstance(value, (int, float))
        value = -value if e.op == "-" else value
        e.is_constant = True
        if operand.untyped:
            e.untyped, e.constant = True, value
            _name_untyped(b, e)
        else:
            e.constant = folding.wrap(value, computed)


def _fold_not(e: ast.Unary, operand: ast.Expr, base: Elementary) -> None:
    value = operand.constant
    e.is_constant = True
    if base is t.BOOL:
        e.constant = not value
        e.untyped = operand.untyped
        return
    assert isinstance(value, int)
    if operand.untyped:
        e.untyped = True
        width = conversion.smallest_bits(value) or base
        e.type = e.operand_type = width
        e.constant = folding.wrap(~value, width)
    else:
        e.constant = folding.wrap(~value, base)


def _name_untyped(b: Body, e: ast.Unary | ast.Binary) -> None:
    """Gives an untyped number its smallest type; reports one that no type holds."""
    value = e.constant
    if isinstance(value, float):
        e.type = e.operand_type = t.LREAL
        return
    if isinstance(value, bool) or not isinstance(value, int):
        return
    smallest = conversion.smallest_integer(value)
    if smallest is None:
        b.report("E0330", e.span, value=value, type="LINT" if value < 0 else "ULINT")
        e.type = None
        e.is_constant = e.untyped = False
        e.constant = None
    else:
        e.type = e.operand_type = smallest


def binary(b: Body, e: ast.Binary) -> None:
    """Resolves a binary expression whose operands are analysed."""
    e.type = e.operand_type = None
    e.is_constant = e.untyped = False
    e.constant = None
    left, right = e.left, e.right
    if left.type is None or right.type is None:
        if e.op in COMPARISONS:
            e.type = t.BOOL
        return
    for side, other in ((left, right), (right, left)):
        if side.__class__ is ast.Call:
            as_zero(side, t.BOOL if e.op in ("AND_THEN", "OR_ELSE") else other.type)  # type: ignore[arg-type]
    op = e.op
    if op in COMPARISONS:
        _comparison(b, e, left, right)
    else:
        _BINARY[op](b, e, left, right)
    if e.type is not None and left.is_constant and right.is_constant:
        _fold(b, e, left, right)


def _adapt(left: ast.Expr, right: ast.Expr, lt: Elementary, rt: Elementary) -> tuple[Elementary, Elementary]:
    """Types of two values of which one is an untyped constant: it takes the type of the other if it can."""
    if left.untyped:
        return (rt, rt) if retype(left, rt) else (lt, rt)
    return (lt, lt) if retype(right, lt) else (lt, rt)


def _meet(b: Body, e: ast.Binary, left: ast.Expr, right: ast.Expr) -> conversion.Operands | None:
    """Common type of two numbers; literals adapt to the other side first. None when one is no number."""
    lt, rt = t.value_type(left.type), t.value_type(right.type)  # type: ignore[arg-type]
    if lt.__class__ is not Elementary or rt.__class__ is not Elementary:
        return None
    if left.untyped != right.untyped:
        lt, rt = _adapt(left, right, lt, rt)
    elif lt is not rt:
        if left.__class__ is ast.Call and adapt_choice(left, rt):
            lt = rt
        elif right.__class__ is ast.Call and adapt_choice(right, lt):
            rt = lt
    return conversion.OPERANDS.get((lt.name, rt.name))


def _warn(b: Body, left: ast.Expr, right: ast.Expr, meeting: conversion.Operands) -> None:
    for operand, code in zip((left, right), meeting.warnings, strict=True):
        if code and not operand.is_constant and operand.type is not None:
            complain(b, operand.span, operand.type, meeting.computed, code)


def _arithmetic(b: Body, e: ast.Binary, left: ast.Expr, right: ast.Expr) -> None:
    meeting = _meet(b, e, left, right)
    if meeting is None:
        _special_arithmetic(b, e, left, right)
        return
    if e.op == "MOD" and meeting.computed.kind is Kind.REAL:
        _incompatible(b, e, left, right, "MOD needs integers.")
        return
    if left.untyped and right.untyped:
        both_int = isinstance(left.constant, int) and isinstance(right.constant, int)
        e.type = e.operand_type = meeting.type if both_int else t.LREAL
        e.untyped = True
        return
    e.type, e.operand_type = meeting.type, meeting.computed
    if meeting.warnings != ("", ""):
        _warn(b, left, right, meeting)


def _scale(b: Body, e: ast.Binary, time: ast.Expr, type_: Elementary, factor: ast.Expr) -> None:
    """A time of this type multiplied with or divided by a number."""
    is_real = getattr(factor.type, "kind", None) is Kind.REAL
    if factor.untyped and not retype(factor, t.LREAL if is_real else t.DINT):
        _incompatible(b, e, e.left, e.right)
        return
    e.type = type_
    e.untyped = False
    time.untyped = False


def _special_arithmetic(b: Body, e: ast.Binary, left: ast.Expr, right: ast.Expr) -> None:
    """Times, dates and pointers."""
    lt, rt = t.value_type(left.type), t.value_type(right.type)  # type: ignore[arg-type]
    op = e.op
    if isinstance(lt, t.Pointer) or isinstance(rt, t.Pointer):
        _pointer_arithmetic(b, e, left, right, lt, rt)
        return
    if isinstance(lt, Elementary) and isinstance(rt, Elementary):
        times = (lt.kind is Kind.TIME, rt.kind is Kind.TIME)
        if times == (True, True) and op in "+-":
            for side, other in ((left, rt), (right, lt)):
                if side.untyped and side.type != other:
                    retype(side, other)
            lt, rt = t.value_type(left.type), t.value_type(right.type)  # type: ignore[arg-type]
            if lt == rt:
                e.type = e.operand_type = lt
                e.untyped = left.untyped and right.untyped
                return
        elif times == (True, False) and op in "*/" and (rt.is_integer or rt.kind is Kind.REAL):
            _scale(b, e, left, lt, right)
            return
        elif times == (False, True) and op == "*" and (lt.is_integer or lt.kind is Kind.REAL):
            _scale(b, e, right, rt, left)
            return
        elif lt.kind is Kind.DATE and rt.kind is Kind.TIME and op in "+-" and lt not in _DAYS:
            if right.untyped:
                retype(right, t.LTIME if lt.name in _LONG_DATES else t.TIME)
            left.untyped = right.untyped = False
            e.type = lt
            return
        elif lt.kind is Kind.DATE and rt.kind is Kind.DATE and op == "-" and lt == rt:
            left.untyped = right.untyped = False
            e.type = t.LTIME if lt.name in _LONG_DATES else t.TIME
            return
    _incompatible(b, e, left, right)


def _pointer_arithmetic(b: Body, e: ast.Binary, left: ast.Expr, right: ast.Expr, lt: Type, rt: Type) -> None:
    if _refers(lt) or _refers(rt):
        _incompatible(b, e, left, right, "A REF_TO is compared with = and <>; arithmetic needs a POINTER TO.")
        return
    if isinstance(lt, t.Pointer) and isinstance(rt, t.Pointer):
        if e.op == "-":
            e.type, e.operand_type = t.UDINT, t.LINT
            return
    elif e.op in "+-" and isinstance(lt, t.Pointer) and isinstance(rt, Elementary) and rt.is_integer:
        if right.untyped:
            retype(right, t.LINT)
        e.type = e.operand_type = lt
        return
    elif e.op == "+" and isinstance(rt, t.Pointer) and isinstance(lt, Elementary) and lt.is_integer:
        if left.untyped:
            retype(left, t.LINT)
        e.type = e.operand_type = rt
        return
    elif e.op == "MOD" and isinstance(lt, t.Pointer) and isinstance(rt, Elementary) and rt.is_integer:
        if right.untyped:
            retype(right, t.LWORD)
        e.type = e.operand_type = t.LWORD
        return
    _incompatible(b, e, left, right, "Only pointer + integer, pointer - integer and pointer - pointer exist.")


def _bits(b: Body, e: ast.Binary, left: ast.Expr, right: ast.Expr) -> None:
    lt, rt = t.value_type(left.type), t.value_type(right.type)  # type: ignore[arg-type]
    if lt.__class__ is Elementary and rt.__class__ is Elementary:
        if left.untyped != right.untyped:
            lt, rt = _adapt(left, right, lt, rt)
        result = conversion.BIT_OPERANDS.get((lt.name, rt.name))
        if result is not None:
            e.type = e.operand_type = result
            e.untyped = left.untyped and right.untyped
            if e.untyped and result is not t.BOOL:
                lv, rv = left.constant, right.constant
                if isinstance(lv, int) and isinstance(rv, int) and lv >= 0 and rv >= 0:
                    e.type = e.operand_type = conversion.smallest_bits(max(lv, rv)) or result
            return
    elif isinstance(lt, t.Pointer) and isinstance(rt, Elementary) and rt.is_integer:
        if right.untyped:
            retype(right, t.LWORD)
        e.type = e.operand_type = t.LWORD
        return
    _incompatible(b, e, left, right)


def _lazy(b: Body, e: ast.Binary, left: ast.Expr, right: ast.Expr) -> None:
    for side in (left, right):
        if side.untyped:
            retype(side, t.BOOL)
    if t.value_type(left.type) is t.BOOL and t.value_type(right.type) is t.BOOL:  # type: ignore[arg-type]
        e.type = e.operand_type = t.BOOL
        return
    _incompatible(b, e, left, right, "Both sides must be BOOL.")


def _power(b: Body, e: ast.Binary, left: ast.Expr, right: ast.Expr) -> None:
    lt, rt = t.value_type(left.type), t.value_type(right.type)  # type: ignore[arg-type]
    if (str(lt), str(rt)) not in conversion.OPERANDS:
        _incompatible(b, e, left, right)
        return
    computed = t.REAL if lt is t.REAL and (right.untyped or rt is not t.LREAL) else t.LREAL
    e.untyped = left.untyped and right.untyped
    if not e.untyped:
        for side in (left, right):
            if side.untyped:
                retype(side, computed)
    e.type = e.operand_type = computed


_BINARY: dict[str, Callable[[Body, ast.Binary, ast.Expr, ast.Expr], None]] = {
    "+": _arithmetic,
    "-": _arithmetic,
    "*": _arithmetic,
    "/": _arithmetic,
    "MOD": _arithmetic,
    "AND": _bits,
    "OR": _bits,
    "XOR": _bits,
    "AND_THEN": _lazy,
    "OR_ELSE": _lazy,
    "**": _power,
}


def _comparison(b: Body, e: ast.Binary, left: ast.Expr, right: ast.Expr) -> None:
    e.type = t.BOOL
    lt, rt = t.value_type(left.type), t.value_type(right.type)  # type: ignore[arg-type]
    if lt.__class__ is Elementary and rt.__class__ is Elementary:
        if left.untyped != right.untyped:
            lt, rt = _adapt(left, right, lt, rt)
        if lt == rt:
            # a narrow result of arithmetic is held in DINT and not stored here (LOPR-03)
            e.operand_type = t.DINT if lt.is_integer and lt.size < 4 else lt
            return
        meeting = conversion.OPERANDS.get((lt.name, rt.name))
        if meeting is not None:
            e.operand_type = meeting.computed
            if left.untyped and right.untyped:
                e.operand_type = t.LREAL if meeting.computed.kind is Kind.REAL else meeting.computed
            elif meeting.warnings != ("", ""):
                _warn(b, left, right, meeting)
            return
        if _bool_with_number(b, e, left, right, lt, rt):
            return
    elif isinstance(lt, t.String) and isinstance(rt, t.String) and _same_width(b, left, right, lt, rt):
        e.operand_type = lt if lt.length >= rt.length else rt
        return
    elif _holds_address(lt, rt) and _addresses(e, left, right, lt, rt):
        return
    _incompatible(b, e, left, right)


def _bool_with_number(
    b: Body, e: ast.Binary, left: ast.Expr, right: ast.Expr, lt: Elementary, rt: Elementary
) -> bool:
    """`a < b < c`: the result of a comparison counts as 0 or 1; a BOOL does against a literal (LOPR-50)."""
    chained = e.op in _ORDER and isinstance(left, ast.Binary) and left.op in _ORDER
    if chained and lt is t.BOOL and rt.kind in _NUMBERS:
        e.operand_type = rt
        if not right.is_constant:
            b.report("W1146", e.span, op=e.op, type=rt)
        return True
    for side, own, other in ((left, rt, lt), (right, lt, rt)):
        if side.untyped and other.is_integer and own is t.BOOL and isinstance(side.constant, int):
            e.operand_type = t.LINT
            return True
    return False


def _same_width(b: Body, left: ast.Expr, right: ast.Expr, lt: t.String, rt: t.String) -> bool:
    return lt.wide == rt.wide or narrow(b, left if lt.wide else right)


def _refers(type_: Type) -> bool:
    return isinstance(type_, t.Pointer) and type_.ref_to


def _holds_address(lt: Type, rt: Type) -> bool:
    return isinstance(lt, (t.Pointer, t.Interface)) or isinstance(rt, (t.Pointer, t.Interface))


def _addresses(e: ast.Binary, left: ast.Expr, right: ast.Expr, lt: Type, rt: Type) -> bool:
    if e.op in _ORDER and (_refers(lt) or _refers(rt)):
        return False
    for side, own, other in ((left, lt, rt), (right, rt, lt)):
        if isinstance(own, (t.Pointer, t.Interface, t.FunctionBlock)):
            continue
        if not isinstance(own, Elementary) or not own.is_integer:
            return False
        if isinstance(other, t.Interface) and side.constant != 0:
            return False
        if side.untyped:
            retype(side, t.LWORD)
    e.operand_type = t.LWORD
    return True


def _incompatible(b: Body, e: ast.Binary, left: ast.Expr, right: ast.Expr, hint: str = "") -> None:
    if not hint:
        hint = "Convert one side so that both have the same type."
    b.report("E0304", e.span, op=e.op, left=left.type, right=right.type, hint=hint)
    if e.op not in COMPARISONS:
        e.type = None


def _fold(b: Body, e: ast.Binary, left: ast.Expr, right: ast.Expr) -> None:
    lv, rv, op = left.constant, right.constant, e.op
    if lv is None or rv is None:
        return
    try:
        if op in COMPARISONS:
            computed = e.operand_type
            if computed is None:
                return  # not comparable, which has been reported
            if isinstance(computed, Elementary) and not (left.untyped and right.untyped):
                lv, rv = folding.wrap(lv, computed), folding.wrap(rv, computed)
            e.constant = folding.compare(op, lv, rv)
        elif op == "AND_THEN":
            e.constant = bool(lv and rv)
        elif op == "OR_ELSE":
            e.constant = bool(lv or rv)
        else:
            computed = e.operand_type
            if (
                not isinstance(computed, Elementary)
                or isinstance(lv, (str, bytes))
                or isinstance(rv, (str, bytes))
            ):
                return
            e.constant = folding.arithmetic(op, lv, rv, None if e.untyped else computed)
            if not e.untyped and computed.is_integer:
                constant_overflow.of_integers(b, e, op, lv, rv, computed)
            if e.untyped and op not in ("AND", "OR", "XOR"):
                e.is_constant = True
                if computed.kind is Kind.TIME:
                    exact, e.constant = e.constant, folding.wrap(e.constant, computed)
                    constant_overflow.of_time(b, e, exact, computed)
                else:
                    _name_untyped(b, e)
                return
    except folding.ConstantDivisionError:
        b.report("E0316", right.span)
        e.type = None
        return
    except OverflowError:
        e.constant = math.inf
    e.is_constant = True
