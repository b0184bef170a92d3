"""Numbers in the types of IEC 61131-3 and how two types meet: by the words of LOPR-01..LOPR-03, not by the
tables of the compiler, with numpy's scalars."""

from __future__ import annotations

from typing import Any

import numpy as np

INTEGERS: dict[str, tuple[str, int]] = {
    "SINT": ("signed", 8), "INT": ("signed", 16), "DINT": ("signed", 32), "LINT": ("signed", 64),
    "USINT": ("unsigned", 8), "UINT": ("unsigned", 16), "UDINT": ("unsigned", 32), "ULINT": ("unsigned", 64),
    "BYTE": ("bits", 8), "WORD": ("bits", 16), "DWORD": ("bits", 32), "LWORD": ("bits", 64),
}  # fmt: skip
REALS = ("REAL", "LREAL")
TIMES = {"TIME": 32, "LTIME": 64}
DATES = {"DATE": 32, "TOD": 32, "DT": 32, "LDATE": 64, "LTOD": 64, "LDT": 64}
NUMPY: dict[str, type[np.floating[Any]]] = {"REAL": np.float32, "LREAL": np.float64}


class ImpossibleError(Exception):
    """The types do not meet so."""


def wrapped(value: int, type_: str) -> int:
    """What the bits of a type hold of a number."""
    if type_ == "BOOL":
        return value
    family, bits = INTEGERS.get(type_) or ("unsigned", (TIMES | DATES)[type_])
    value &= (1 << bits) - 1
    return value - (1 << bits) if family == "signed" and value >> bits - 1 else value


def fits(value: int | float, type_: str) -> bool:
    """Whether a literal can be of a type of numbers."""
    if type_ in REALS:
        return True
    return type_ in INTEGERS and isinstance(value, int) and wrapped(value, type_) == value


def smallest(value: int | float) -> str:
    """The type of a literal that meets nothing which holds it (LTYP-31)."""
    if isinstance(value, float):
        return "LREAL"
    order = ("SINT", "USINT", "INT", "UINT", "DINT", "UDINT", "LINT", "ULINT")
    return next(name for name in order if fits(value, name))


def real_of(value: int | float, type_: str) -> float:
    """In a real type, rounded once."""
    if isinstance(value, int):
        whole = np.int64(value) if value < 1 << 63 else np.uint64(value)
        return float(whole.astype(NUMPY[type_]))
    with np.errstate(over="ignore"):
        return float(NUMPY[type_](value))


def common(a: str, b: str) -> tuple[str, str]:
    """Type of the result, and type in which it is computed."""
    if a in REALS or b in REALS:
        if not all(one in REALS or one in INTEGERS for one in (a, b)):
            raise ImpossibleError
        real = "LREAL" if "LREAL" in (a, b) else "REAL"
        return real, real
    if a not in INTEGERS or b not in INTEGERS:
        raise ImpossibleError
    families, sizes = {INTEGERS[a][0], INTEGERS[b][0]}, [INTEGERS[a][1], INTEGERS[b][1]]
    largest = max(sizes)
    wide = [one for one, size in zip((a, b), sizes, strict=True) if size == largest]
    result = min(wide, key=lambda one: ("signed", "unsigned", "bits").index(INTEGERS[one][0]))
    if largest < 32:
        return result, "DINT"
    if "signed" not in families or len(families) == 1:
        return result, result
    unsigned = max(size for one, size in zip((a, b), sizes, strict=True) if INTEGERS[one][0] != "signed")
    if unsigned == 64:
        return result, result
    return result, "LINT" if unsigned == 32 or largest == 64 else "DINT"


def _quotient(a: int, b: int) -> int:
    return abs(a) // abs(b) * (-1 if (a < 0) != (b < 0) else 1)


def computed_by(op: str, a: Any, b: Any, type_: str) -> int | float | None:
    """+ - * / MOD of two values of a type, by IEEE 754 or in the bits of the type; None for a whole number by
    zero."""
    if type_ in REALS:
        x, y = NUMPY[type_](a), NUMPY[type_](b)
        with np.errstate(all="ignore"):
            match op:
                case "+":
                    return float(x + y)
                case "-":
                    return float(x - y)
                case "*":
                    return float(x * y)
                case "/":
                    return float(x / y)
        raise ImpossibleError
    if op in "/MOD" and b == 0:
        return None
    match op:
        case "+":
            found = a + b
        case "-":
            found = a - b
        case "*":
            found = a * b
        case "/":
            found = _quotient(a, b)
        case _:
            found = a - _quotient(a, b) * b
    return wrapped(found, type_)
