"""Structures of the executive in native memory, read and written member by member."""

from __future__ import annotations

import ctypes
from collections.abc import Mapping as MappingType
from dataclasses import dataclass

from tappet.runtime.posix import Mapping, map_memory

_SIGNED: dict[int, type] = {1: ctypes.c_int8, 2: ctypes.c_int16, 4: ctypes.c_int32, 8: ctypes.c_int64}
_UNSIGNED: dict[int, type] = {1: ctypes.c_uint8, 2: ctypes.c_uint16, 4: ctypes.c_uint32, 8: ctypes.c_uint64}


@dataclass(frozen=True, slots=True)
class MemberPlace:
    """A member: byte offset, size, and whether its value carries a sign."""

    offset: int
    size: int
    signed: bool = False


@dataclass(frozen=True, slots=True)
class Layout:
    """A structure of `types.st` as the compiler laid it out."""

    name: str
    size: int
    members: MappingType[str, MemberPlace]


class Record:
    """One structure at a native address; `record["due"]` reads, `record["due"] = 5` stores in one
    instruction.
    """

    __slots__ = ("address", "layout")

    def __init__(self, layout: Layout, address: int) -> None:
        self.layout = layout
        self.address = address

    def _cell(self, name: str) -> ctypes.c_int64:
        place = self.layout.members[name]
        kind = (_SIGNED if place.signed else _UNSIGNED).get(place.size)
        if kind is None:
            raise TypeError(f"{self.layout.name}.{name} is no scalar; use `place`")
        cell: ctypes.c_int64 = kind.from_address(self.address + place.offset)  # type: ignore[attr-defined]
        return cell

    def __getitem__(self, name: str) -> int:
        return self._cell(name).value

    def __setitem__(self, name: str, value: int) -> None:
        self._cell(name).value = value

    def place(self, name: str) -> int:
        """Address of a member."""
        return self.address + self.layout.members[name].offset

    def size_of(self, name: str) -> int:
        """Bytes of a member."""
        return self.layout.members[name].size

    def part(self, name: str, layout: Layout) -> Record:
        """A member that is a structure itself."""
        return Record(layout, self.place(name))


class Block:
    """A piece of native memory that Python owns: list headers, values, rings. Lives as long as the object."""

    __slots__ = ("_memory", "address", "size")

    def __init__(self, size: int) -> None:
        self.size = size
        words = (ctypes.c_uint64 * (max(size, 1) // 8 + 1))()  # eight-byte aligned, zero
        self._memory = words
        self.address = ctypes.addressof(words)

    def view(self) -> memoryview:
        """The bytes, writable."""
        return memoryview(self._memory).cast("B")

    def array(self, layout: Layout, count: int) -> list[Record]:
        """The block as an array of structures."""
        if layout.size * count > self.size:
            raise ValueError(f"{count} x {layout.name} do not fit into {self.size} bytes")
        return [Record(layout, self.address + i * layout.size) for i in range(count)]


class Arena:
    """Memory for the contexts of one application, released as a whole."""

    def __init__(self, size: int) -> None:
        self._mapping: Mapping = map_memory(size)
        self._used = 0

    def take(self, size: int) -> int:
        """Address of `size` zeroed bytes on a 64-byte boundary, so that tasks share no cache line."""
        start = -(-self._used // 64) * 64
        if start + size > self._mapping.size:
            raise MemoryError("the arena of the application is full")
        self._used = start + size
        return self._mapping.address + start

    def close(self) -> None:
        """Release everything that was taken."""
        self._mapping.close()
