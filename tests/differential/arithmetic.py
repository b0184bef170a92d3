"""Values of the machine in plain Python: wrapped integers, IEEE numbers through numpy."""

from __future__ import annotations

import math
from typing import Any, ClassVar

import numpy as np
from typed_tree import BOOL, Scalar


class Fault(Exception):  # noqa: N818 - a fault of the program
    """The program ends here, or goes on in a handler, which gets the number of the exception."""

    NUMBERS: ClassVar = {"division by zero": 0x102, "array index": 0x101}
    """Numbers of __SYSTEM.ExceptionCode; access through nothing is ACCESS_VIOLATION."""

    @property
    def number(self) -> int:
        return self.NUMBERS.get(str(self), 0x51)


def wrap(value: int, to: Scalar) -> int:
    """The low bits, read as signed or unsigned."""
    value &= (1 << to.bits) - 1
    return value - (1 << to.bits) if to.kind == "signed" and value >> (to.bits - 1) else value


def single(value: float | int) -> float:
    """The nearest number of single precision; integers are rounded once."""
    with np.errstate(all="ignore"):
        if isinstance(value, int):
            exact = np.uint64(value) if value >= 0 else np.int64(value)
            return float(exact.astype(np.float32))
        return float(np.float32(value))


def real(value: float | int, to: Scalar) -> float:
    """A number in REAL or LREAL."""
    return single(value) if to.bits == 32 else float(value)


def round_away(value: float) -> float:
    """The nearest whole number, halves away from zero."""
    if not math.isfinite(value):
        return value
    whole = math.trunc(value)
    rest = abs(value - whole)
    return whole + math.copysign(1, value) if rest >= 0.5 else float(whole)


def saturate(value: float, to: Scalar) -> int:
    """A whole number within the limits of a type; NaN is 0."""
    if math.isnan(value):
        return 0
    if math.isinf(value):
        return to.high if value > 0 else to.low
    return min(max(int(value), to.low), to.high)


def convert(value: Any, to: Scalar) -> Any:
    """A value where something of type `to` is needed."""
    if to == BOOL:
        return bool(value)
    if to.kind == "real":
        return real(int(value) if isinstance(value, bool) else value, to)
    if isinstance(value, float):
        return saturate(round_away(value), to)
    return wrap(int(value), to)


def divide(a: int, b: int) -> int:
    """Quotient towards zero."""
    if b == 0:
        raise Fault("division by zero")
    quotient = abs(a) // abs(b)
    return quotient if (a < 0) == (b < 0) else -quotient


def arithmetic(op: str, a: Any, b: Any, to: Scalar) -> Any:
    """`a op b`, both already in `to`."""
    if to.kind == "real":
        kind = np.float32 if to.bits == 32 else np.float64
        x, y = kind(a), kind(b)
        with np.errstate(all="ignore"):
            return float({"+": x + y, "-": x - y, "*": x * y, "/": x / y}[op])
    if op == "+":
        return wrap(a + b, to)
    if op == "-":
        return wrap(a - b, to)
    if op == "*":
        return wrap(a * b, to)
    quotient = divide(a, b)
    return wrap(quotient if op == "/" else a - quotient * b, to)


def bitwise(op: str, a: Any, b: Any, to: Scalar) -> Any:
    """AND, OR, XOR."""
    if to == BOOL:
        return {"AND": a and b, "OR": a or b, "XOR": a != b}[op]
    return wrap({"AND": a & b, "OR": a | b, "XOR": a ^ b}[op], to)


def compare(op: str, a: Any, b: Any) -> bool:
    return bool({"=": a == b, "<>": a != b, "<": a < b, ">": a > b, "<=": a <= b, ">=": a >= b}[op])


def shift(name: str, value: int, count: int, to: Scalar) -> int:
    """SHL, SHR (arithmetic for signed types), ROL, ROR; a negative count is a very large one."""
    pattern = value & ((1 << to.bits) - 1)
    if name in ("ROL", "ROR"):
        count %= to.bits
        count = count if name == "ROL" else (to.bits - count) % to.bits
        return wrap(pattern << count | pattern >> (to.bits - count), to)
    count = to.bits if count < 0 else min(count, to.bits)
    if name == "SHL":
        return wrap(pattern << count, to)
    return wrap(value >> count, to)


def square_root(value: float, to: Scalar) -> float:
    kind = np.float32 if to.bits == 32 else np.float64
    with np.errstate(all="ignore"):
        return float(np.sqrt(kind(value)))


def same(a: Any, b: Any) -> bool:
    """Equal values, the sign of zero included; NaN equals NaN."""
    if isinstance(a, float) and isinstance(b, float):
        if math.isnan(a) or math.isnan(b):
            return math.isnan(a) and math.isnan(b)
        return a == b and math.copysign(1, a) == math.copysign(1, b)
    return bool(a == b)
