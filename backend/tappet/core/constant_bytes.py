"""Constants as bytes of the memory image."""

from __future__ import annotations

import struct
import zlib
from base64 import b64decode

from tappet.core import ir
from tappet.core.program import LoweringError
from tappet.core.scalars import scalar_of
from tappet.lang import ast
from tappet.lang import types as t
from tappet.lang.attributes import attribute

INITIAL_BYTES = "initial_bytes"
"""Attribute of a variable whose first state is data that no literal could hold in reasonable time."""


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


def given_bytes(decl: ast.VarDecl, type_: t.Type) -> bytes | None:
    """What `{attribute 'initial_bytes' := '...'}` holds, compressed by zlib and in base 64; None without it.

    Text that is made of objects has it, such as that of a CNC program of 100,000 lines; nobody writes it by
    hand. Raises LoweringError where it is not as long as the variable.
    """
    text = attribute(decl.attributes, INITIAL_BYTES)
    if text is None:
        return None
    data = zlib.decompress(b64decode(text))
    if len(data) != type_.size:
        raise LoweringError(
            f"the data of {decl.name} have {len(data)} bytes, the variable has {type_.size}; "
            "the library has another structure than the one that the data were made for"
        )
    return data
