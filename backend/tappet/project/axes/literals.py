"""Values of settings as IEC literals."""

from __future__ import annotations


def flag(value: bool) -> str:
    """As BOOL."""
    return "TRUE" if value else "FALSE"


def real(value: float) -> str:
    """As LREAL."""
    text = repr(float(value)).upper()
    mantissa, exponent, power = text.partition("E")
    if "." not in mantissa:
        mantissa += ".0"
    return mantissa + exponent + power
