"""Values of variables whose type an online change replaces by another one that can hold them.

A number keeps its value when the new type has it (real numbers to the precision of the type); one that does
not fit, as 70000 in an INT, gives way to the initial value. Durations and dates convert between their 32 and
64 bit types, a BIT and a BOOL into each other.
"""

from __future__ import annotations

import math
import struct
from typing import Annotated, Literal

from msgspec import Meta, Struct

from tappet.codegen.symbol_types import Bit, MemberInfo, TypeInfo

ScalarKind = Literal[
    "bool", "bits", "int", "uint", "real", "time", "ltime", "date", "tod", "dt", "ldate", "ltod", "ldt"
]
_NUMBERS = frozenset({"bool", "bits", "int", "uint", "real"})
_TIMES = {
    "time": ("duration", 1_000_000), "ltime": ("duration", 1),
    "date": ("date", 1_000_000_000), "ldate": ("date", 1),
    "tod": ("time of day", 1_000_000), "ltod": ("time of day", 1),
    "dt": ("date and time", 1_000_000_000), "ldt": ("date and time", 1),
}  # fmt: skip
"""What the types of times mean, and the nanoseconds of their units (LTYP, section 4)."""
_CODES = {"int": {1: "b", 2: "h", 4: "i", 8: "q"}, "real": {4: "f", 8: "d"}}
_UNSIGNED = {1: "B", 2: "H", 4: "I", 8: "Q"}


class Scalar(Struct, frozen=True, array_like=True):
    """A number in an image."""

    offset: Annotated[int, Meta(ge=0)]
    kind: ScalarKind
    size: Literal[1, 2, 4, 8]
    bit: Bit | None = None
    range: tuple[int, int] | None = None
    """Bounds of a subrange."""


class Conversion(Struct, frozen=True, array_like=True):
    """The value at `source` of the running image comes to `target` of the new one, if it can."""

    source: Scalar
    target: Scalar


def convertible(old: TypeInfo, new: TypeInfo) -> bool:
    """Whether values of one type may be values of the other."""
    before, after = _number_kind(old), _number_kind(new)
    if "enum" in (old.kind, new.kind):
        return old.kind == new.kind or (old.kind == "enum" and after in _NUMBERS and after != "bool")
    if before in _NUMBERS:
        return after in _NUMBERS
    return before in _TIMES and after in _TIMES and _TIMES[before][0] == _TIMES[after][0]


def scalar(type_: TypeInfo, offset: int, member: MemberInfo | None = None) -> Scalar:
    """A variable of a convertible type."""
    bit = member.bit if member is not None else None
    kind = "bool" if bit is not None else _number_kind(type_)
    size = 1 if bit is not None else type_.size
    return Scalar(offset, kind, size, bit, type_.range)  # type: ignore[arg-type]


def _number_kind(type_: TypeInfo) -> str:
    return type_.base if type_.kind == "enum" else type_.kind


def convert(image: bytes, after: bytearray, conversion: Conversion) -> bool:
    """Bring one value from `image` to `after`; False when the new type cannot hold it."""
    source, target = conversion.source, conversion.target
    value = _read(image, source)
    if source.kind in _TIMES:
        ns = int(value) * _TIMES[source.kind][1]
        value, rest = divmod(ns, _TIMES[target.kind][1])
        if rest:
            return False
    return _write(after, target, value)


def _read(image: bytes, place: Scalar) -> int | float:
    if place.bit is not None:
        return image[place.offset] >> place.bit & 1
    codes = _CODES.get(place.kind, _UNSIGNED)
    value: int | float = struct.unpack_from("<" + codes[place.size], image, place.offset)[0]
    return int(value) & 1 if place.kind == "bool" else value


def _write(image: bytearray, place: Scalar, value: int | float) -> bool:
    if place.kind == "real":
        return _write_real(image, place, value)
    if not math.isfinite(value) or value != int(value):
        return False
    number, bits = int(value), 1 if place.kind == "bool" else place.size * 8
    low, high = (-(1 << bits - 1), (1 << bits - 1) - 1) if place.kind == "int" else (0, (1 << bits) - 1)
    if place.range is not None:
        low, high = max(low, place.range[0]), min(high, place.range[1])
    if not low <= number <= high:
        return False
    if place.bit is not None:
        image[place.offset] = image[place.offset] & ~(1 << place.bit) | number << place.bit
        return True
    codes = _CODES.get(place.kind, _UNSIGNED)
    struct.pack_into("<" + codes[place.size], image, place.offset, number)
    return True


def _write_real(image: bytearray, place: Scalar, value: int | float) -> bool:
    """A whole number comes as it is or not at all; a real number is rounded."""
    code = _CODES["real"][place.size]
    try:
        packed = struct.pack("<" + code, value)
    except OverflowError:  # too large for a REAL
        return False
    if isinstance(value, int) and struct.unpack("<" + code, packed)[0] != value:
        return False
    image[place.offset : place.offset + place.size] = packed
    return True
