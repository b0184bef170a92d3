"""Values of unions in the reference: bytes, laid out as the specification says (LTYP-51, LTYP-105, LPRG-40).

Natural alignment unless `pack_mode` says less; neighbouring BIT members share bytes, the lowest bit first.
"""

from __future__ import annotations

import math
import struct
from typing import Any

from arithmetic import wrap
from typed_tree import Array, BitMember, Interface, Pointer, Scalar, Struct, Text, Type, base_of


class Unsettled(Exception):  # noqa: N818
    """The rules do not say which bytes come out: those of a NaN."""


def size_and_alignment(type_: Type) -> tuple[int, int]:
    """In bytes; raises TypeError for what has no fixed place in a union."""
    base = base_of(type_)
    if isinstance(base, Scalar):
        size = max(base.bits // 8, 1)
        return size, size
    if isinstance(base, Text):
        width = 2 if base.wide else 1
        return (base.length + 1) * width, width
    if isinstance(base, Pointer | Interface):
        return 8, 8
    if isinstance(base, Array):
        size, alignment = size_and_alignment(base.element)
        return size * count(base), alignment
    if isinstance(base, Struct):
        _places, size, alignment = layout(base)
        return size, alignment
    raise TypeError(base)


def count(type_: Array) -> int:
    return math.prod(high - low + 1 for low, high in type_.bounds)


def layout(type_: Struct) -> tuple[dict[str, tuple[int, int]], int, int]:
    """Byte and bit of each member, size, alignment."""
    places: dict[str, tuple[int, int]] = {}
    end = largest = 0
    alignment, bit = 1, 8
    inherited = 0
    if type_.base is not None:
        places, end, alignment = layout(type_.base)
        inherited = len(type_.base.members)
    for name, member in type_.members[inherited:]:
        if isinstance(member, BitMember):
            if type_.union:
                places[name], largest = (0, 0), max(largest, 1)
                continue
            if bit == 8:
                bit, end = 0, end + 1
            places[name] = end - 1, bit
            bit += 1
            continue
        bit = 8
        size, natural = size_and_alignment(member)
        natural = min(natural, max(type_.pack, 1)) if type_.pack is not None else natural
        alignment = max(alignment, natural)
        start = 0 if type_.union else _up(end, natural)
        places[name] = start, 0
        end = start + size
        largest = max(largest, end)
    return places, _up(largest if type_.union else end, alignment), alignment


def _up(offset: int, alignment: int) -> int:
    return -(-offset // alignment) * alignment


_REAL = {32: "<f", 64: "<d"}


class View:
    """Memory of a union, read and written like the dict of a structure or the list of an array."""

    def __init__(self, memory: bytearray, offset: int, type_: Any) -> None:
        self.memory, self.offset, self.type = memory, offset, type_

    @classmethod
    def fresh(cls, type_: Struct) -> View:
        return cls(bytearray(size_and_alignment(type_)[0]), 0, type_)

    def data(self) -> bytes:
        return bytes(self.memory[self.offset : self.offset + size_and_alignment(self.type)[0]])

    def copy(self) -> View:
        return View(bytearray(self.data()), 0, self.type)

    def keys(self) -> list[Any]:
        if isinstance(self.type, Struct):
            return [name for name, _ in self.type.members]
        first = self.type.bounds[0]
        return list(range(first[1] - first[0] + 1))

    def _part(self, key: Any) -> tuple[int, int, Any]:
        if isinstance(self.type, Struct):
            offset, bit = layout(self.type)[0][key]
            return self.offset + offset, bit, dict(self.type.members)[key]
        bounds = self.type.bounds
        rest = Array(self.type.element, bounds[1:]) if len(bounds) > 1 else self.type.element
        return self.offset + key * size_and_alignment(rest)[0], 0, rest

    def __getitem__(self, key: Any) -> Any:
        offset, bit, type_ = self._part(key)
        if isinstance(type_, BitMember):
            return bool(self.memory[offset] >> bit & 1)
        if isinstance(type_, Array | Struct):
            return View(self.memory, offset, type_)
        size = size_and_alignment(type_)[0]
        data = bytes(self.memory[offset : offset + size])
        if type_.kind == "real":
            return struct.unpack(_REAL[type_.bits], data)[0]
        return int.from_bytes(data, "little", signed=type_.kind == "signed")

    def __setitem__(self, key: Any, value: Any) -> None:
        offset, bit, type_ = self._part(key)
        if isinstance(type_, BitMember):
            self.memory[offset] = self.memory[offset] & ~(1 << bit) | int(bool(value)) << bit
            return
        size = size_and_alignment(type_)[0]
        if type_.kind == "real":
            if math.isnan(value):
                raise Unsettled
            data = struct.pack(_REAL[type_.bits], value)
        else:
            data = (wrap(value, type_) & (1 << type_.bits) - 1).to_bytes(size, "little")
        self.memory[offset : offset + size] = data
