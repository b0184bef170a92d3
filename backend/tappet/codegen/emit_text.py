"""LLVM spelling of types, constants and names."""

from __future__ import annotations

import math
import re
import struct

from tappet.core import ir

_PLAIN = re.compile(rb"[ !#-\[\]-~]*")
"""Bytes that need no escape in names and constants."""
_TYPES = {"bool": "i1", "f32": "float", "f64": "double", "ptr": "ptr", "void": "void"}
_TYPES |= {f"{s}{n}": f"i{n}" for s in "iu" for n in (8, 16, 32, 64)}


def llvm_type(t: ir.Scalar) -> str:
    """Type of a value."""
    return _TYPES[t.name]


def memory_type(t: ir.Scalar) -> str:
    """Type in memory: BOOL is a byte there."""
    return "i8" if t.bits == 1 else _TYPES[t.name]


def constant(t: ir.Scalar, value: int | float) -> str:
    """Operand text of a constant."""
    if t.floating:
        return float_text(float(value), t.bits)
    if t.bits == 1:
        return "true" if value else "false"
    if t.pointer:
        return "null" if value == 0 else f"inttoptr (i64 {int(value)} to ptr)"
    return str(wrap(int(value), t.bits))


def wrap(value: int, bits: int) -> int:
    """`value` cut to `bits`, as the signed number LLVM prints."""
    value &= (1 << bits) - 1
    return value - (1 << bits) if value >> (bits - 1) else value


def float_text(value: float, bits: int) -> str:
    """Exact hexadecimal spelling; a float constant is written with the bits of the equal double."""
    if bits == 32:
        value = single(value)
    raw = struct.unpack("<Q", struct.pack("<d", value))[0]
    return f"0x{raw:016X}"


def single(value: float) -> float:
    """`value` rounded to REAL; too large numbers become infinite."""
    try:
        result: float = struct.unpack("<f", struct.pack("<f", value))[0]
    except OverflowError:
        return math.copysign(math.inf, value)
    return result


def quoted(data: bytes) -> str:
    """Bytes as the inside of an LLVM `c"..."` constant or name."""
    if _PLAIN.fullmatch(data):
        return data.decode("ascii")
    return "".join(chr(b) if 32 <= b < 127 and b not in (34, 92) else f"\\{b:02X}" for b in data)


def symbol(name: str) -> str:
    """A global name, quoted."""
    return f'@"{quoted(name.encode())}"'


PREFIX = "st."
"""Set before the linkage names of compiled bodies, so that no POU takes the name of a C function."""


def function_symbol(function: ir.Function) -> str:
    """Global name of a compiled body."""
    return symbol(function.name if function.exported else PREFIX + function.name)
