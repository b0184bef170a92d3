"""Constant arithmetic as the compiled code does it: wrapped integers, single precision, cut quotients."""

from __future__ import annotations

import math
import operator
import struct
from collections.abc import Callable
from typing import Any

from tappet.lang.analysis.conversion import RANGES
from tappet.lang.ast import Constant
from tappet.lang.types import Elementary, Kind


class ConstantDivisionError(ArithmeticError):
    """A constant integer was divided by zero."""


def round_real(value: float) -> float:
    """`value` rounded to single precision, infinite beyond its range."""
    try:
        return float(struct.unpack("<f", struct.pack("<f", value))[0])
    except OverflowError:
        return math.copysign(math.inf, value)


def wrap_integer(value: int, size: int, signed: bool) -> int:
    """The low `size` bytes of `value` read as signed or unsigned number."""
    bits = 8 * size
    value &= (1 << bits) - 1
    return value - (1 << bits) if signed and value >> (bits - 1) else value


def wrap(value: Constant, to: Elementary) -> Constant:
    """A constant as a variable of type `to` would hold it; integers lose their upper bytes."""
    kind = to.kind
    if kind is Kind.REAL:
        if not isinstance(value, (int, float)):
            return value
        try:
            number = float(value)
        except OverflowError:
            number = math.inf if value > 0 else -math.inf
        return round_real(number) if to.size == 4 else number
    if kind is Kind.BOOL:
        return bool(value)
    if isinstance(value, float):
        return saturate(round_half_away(value), to)
    if isinstance(value, int):
        return wrap_integer(int(value), to.size, kind is Kind.SIGNED)
    return value


def round_half_away(value: float) -> float:
    """The nearest whole number, halves away from zero (LOPR-73)."""
    if not math.isfinite(value):
        return value
    whole = math.floor(abs(value))
    return math.copysign(whole + (abs(value) - whole >= 0.5), value)


def saturate(value: float, to: Elementary) -> int:
    """A whole number as integer, time or date; beyond the range the nearest limit, NaN gives 0 (LTYP-26)."""
    low, high = RANGES[to.name]
    if math.isnan(value):
        return 0
    return low if value <= low else high if value >= high else int(value)


def fits(value: int, to: Elementary) -> bool:
    """Whether an integer lies in the range of an integer, time or date type."""
    low, high = RANGES[to.name]
    return low <= value <= high


def divide_integers(left: int, right: int) -> int:
    """Quotient cut towards zero (LOPR-13). Raises ConstantDivisionError."""
    if right == 0:
        raise ConstantDivisionError
    quotient = abs(left) // abs(right)
    return quotient if (left < 0) == (right < 0) else -quotient


def modulo_integers(left: int, right: int) -> int:
    """Remainder with the sign of the dividend (LOPR-14). Raises ConstantDivisionError."""
    if right == 0:
        raise ConstantDivisionError
    remainder = abs(left) % abs(right)
    return -remainder if left < 0 else remainder


def divide_reals(left: float, right: float) -> float:
    """Quotient after IEEE 754: no exception, infinities and NaN instead."""
    if right != 0:
        return left / right
    if left == 0 or math.isnan(left) or math.isnan(right):
        return math.nan
    return math.copysign(math.inf, left) * math.copysign(1.0, right)


def power(base: float, exponent: float) -> float:
    """`base` to the power `exponent` after IEEE 754."""
    try:
        return math.pow(base, exponent)
    except OverflowError:
        negative = base < 0 and exponent == math.floor(exponent) and exponent % 2 == 1
        return -math.inf if negative else math.inf
    except ValueError:
        return math.inf if base == 0 else math.nan


def quiet(function: Callable[[float], float]) -> Callable[[float], float]:
    """`function` with NaN and infinities instead of exceptions (LOPR-92)."""

    def evaluate(x: float) -> float:
        try:
            return function(x)
        except OverflowError:
            return math.inf
        except ValueError:
            return -math.inf if x == 0 else math.nan

    return evaluate


MATHEMATICS: dict[str, Callable[[float], float]] = {
    "SQRT": quiet(math.sqrt),
    "LN": quiet(math.log),
    "LOG": quiet(math.log10),
    "EXP": quiet(math.exp),
    "SIN": quiet(math.sin),
    "COS": quiet(math.cos),
    "TAN": quiet(math.tan),
    "ASIN": quiet(math.asin),
    "ACOS": quiet(math.acos),
    "ATAN": quiet(math.atan),
}

_INTEGER: dict[str, Callable[[int, int], int]] = {
    "+": operator.add,
    "-": operator.sub,
    "*": operator.mul,
    "/": divide_integers,
    "MOD": modulo_integers,
    "AND": operator.and_,
    "OR": operator.or_,
    "XOR": operator.xor,
}
_REAL: dict[str, Callable[[float, float], float]] = {
    "+": operator.add,
    "-": operator.sub,
    "*": operator.mul,
    "/": divide_reals,
    "**": power,
}
_COMPARE: dict[str, Callable[[Any, Any], bool]] = {
    "=": operator.eq,
    "<>": operator.ne,
    "<": operator.lt,
    ">": operator.gt,
    "<=": operator.le,
    ">=": operator.ge,
}


def arithmetic(op: str, left: Constant, right: Constant, computed: Elementary | None) -> Constant:
    """`left op right` computed in `computed`; None means exact.

    Raises ConstantDivisionError.
    """
    if computed is not None:
        left, right = wrap(left, computed), wrap(right, computed)
    if isinstance(left, float) or isinstance(right, float) or op == "**":
        assert isinstance(left, (int, float))
        assert isinstance(right, (int, float))
        value: Constant = _REAL[op](float(left), float(right))
    else:
        assert isinstance(left, int)
        assert isinstance(right, int)
        value = _INTEGER[op](left, right)
        if isinstance(left, bool) and isinstance(right, bool):
            value = bool(value)
    return value if computed is None else wrap(value, computed)


def compare(op: str, left: Constant, right: Constant) -> bool:
    """Comparison of two constants of one type; characters compare by code."""
    if isinstance(left, str) and isinstance(right, str):
        return _COMPARE[op](left.encode("utf-16-be"), right.encode("utf-16-be"))
    return _COMPARE[op](left, right)
