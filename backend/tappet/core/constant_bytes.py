"""Constants as bytes of the memory image."""

from __future__ import annotations

import struct

from tappet.core import ir
from tappet.core.scalars import scalar_of
from tappet.lang import ast
from tappet.lang import types as t


def constant_bytes(type_: t.Type, init: ast.Expr) -> bytes | None:
    """Bytes of a constant initialiser of a simple type or string, None when it is no constant."""
    if not init.is_constant or init.constant is None:
        return None
    value = init.constant
    if isinstance(type_, t.String):
        return _string_bytes(type_, value)
    scalar = scalar_of(type_)
    if scalar is None or isinstance(value, str | bytes):
        return None
    return scalar_bytes(scalar, value)


def _string_bytes(type_: t.String, value: ast.Constant) -> bytes | None:
    if isinstance(value, str):
        raw = value.encode("utf-16-le", "surrogatepass") if type_.wide else value.encode("latin-1", "replace")
    elif isinstance(value, bytes):
        raw = value
    else:
        return None
    raw = raw[: type_.length * (2 if type_.wide else 1)]
    return raw + bytes(type_.size - len(raw))


def scalar_bytes(scalar: ir.Scalar, value: int | float) -> bytes:
    """A number in memory."""
    if scalar.floating:
        try:
            return struct.pack("<f" if scalar.bits == 32 else "<d", value)
        except OverflowError:
            return struct.pack("<f", float("inf") if value > 0 else float("-inf"))
    bits = scalar.size * 8
    return (int(value) & ((1 << bits) - 1)).to_bytes(scalar.size, "little")
