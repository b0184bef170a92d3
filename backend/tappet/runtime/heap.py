"""Memory of __NEW of one application: an arena of its own, with what is known of its blocks apart from it.

The allocator is native (executive/heap.st); docs/memory.md says what it finds.
"""

from __future__ import annotations

import secrets
from dataclasses import dataclass

from tappet.runtime.executive.loader import HEAP_SERVICES, Executive
from tappet.runtime.executive.records import Arena, Record
from tappet.runtime.link import LinkedCode
from tappet.runtime.posix import Mapping, create_mutex, map_memory, pages, write_memory

GRANULE = 32
"""GRANULE of heap_blocks.st."""
FENCE = 1 << 20
"""Bytes before and behind that nobody may touch: an index that is a little wrong ends in an exception."""
LEAST_BLOCK_SHARE = 2
"""Granules for each descriptor of a block: the arena holds at most so many blocks, free ones counted."""

_GENERATION, _MASK = 1 << 48, (1 << 64) - 1
"""Code addresses have at most 48 bits; above them stands which code of the application it was."""


@dataclass(frozen=True, slots=True)
class DamagedBlock:
    """Memory of __NEW that was written before or behind its bounds."""

    address: int
    size: int
    origin: int
    """Return address of the __NEW that made it, as `maker` understands it."""


class ApplicationHeap:
    """HEAP_ARENA of one application. It takes memory once code is linked that makes something."""

    def __init__(self, executive: Executive, limit: int, *, poison: bool) -> None:
        """At most `limit` bytes, guards included; with `poison` released memory is filled."""
        self._executive = executive
        self._limit = limit
        layouts = executive.layouts
        self._memory = Arena(layouts["HEAP_ARENA"].size)
        self._heap = Record(layouts["HEAP_ARENA"], self._memory.take(layouts["HEAP_ARENA"].size))
        self.poison(poison)
        self._mappings: list[Mapping] = []
        create_mutex(self._heap.place("lock"))

    @property
    def address(self) -> int:
        """HEAP_ARENA."""
        return self._heap.address

    @property
    def opened(self) -> bool:
        """Whether there is an arena."""
        return bool(self._heap["pArena"])

    @property
    def arena(self) -> tuple[int, int]:
        """Address and size of the memory that blocks lie in."""
        return self._heap["pArena"], self._heap["granules"] * GRANULE

    @property
    def low(self) -> bool:
        """Whether pointers into it fit into DWORD."""
        return all(m.low for m in self._mappings[:1])

    @property
    def limit(self) -> int:
        """Bytes that blocks and their guards may take."""
        return self._limit

    @property
    def used(self) -> tuple[int, int]:
        """Blocks that are not given back, and their bytes with guards."""
        return self._heap["usedBlocks"], self._heap["usedBytes"]

    def poison(self, wanted: bool) -> None:
        """Whether memory is filled from now on when it is given back."""
        self._heap["poison"] = int(wanted)

    def new_code(self) -> None:
        """What is made from now on is made by other code than before."""
        self._heap["generation"] = (self._heap["generation"] + _GENERATION) & _MASK

    def maker(self, origin: int) -> int:
        """Return address of the __NEW that made a block of this `origin`; 0 when its code is gone."""
        return origin % _GENERATION if origin - origin % _GENERATION == self._heap["generation"] else 0

    def serve(self, code: LinkedCode) -> None:
        """Have an arena when `code` makes something; OSError when there is no memory for it."""
        if self.opened or self._limit <= 0 or code.imported.isdisjoint(HEAP_SERVICES):
            return
        size = pages(self._limit)
        blocks = size // GRANULE // LEAST_BLOCK_SHARE + 2
        entry = self._executive.layouts["HEAP_BLOCK"].size
        sizes = (size, pages(size // GRANULE * 4), pages(blocks * entry))
        try:
            for i, room in enumerate(sizes):
                self._mappings.append(_fenced(room, low=i == 0))
        except OSError:
            self._unmap()
            raise
        heap = self._heap
        heap["granules"] = size // GRANULE
        heap["blockLimit"] = blocks
        arena, heap["pMap"], heap["pBlocks"] = (m.address + FENCE for m in self._mappings)
        heap["secret"] = secrets.randbits(64)
        heap["pArena"] = arena
        self._executive.begin_heap(self.address)

    def reset(self) -> None:
        """Nothing is made any more; only while no task runs."""
        if not self.opened:
            return
        for mapping in self._mappings:
            mapping.clear(FENCE, mapping.size - 2 * FENCE)
        heap = self._heap
        for name in ("present", "classes"):
            _zero(heap, name)
        for name in ("unused", "cursor", "usedBlocks", "usedBytes"):
            heap[name] = 0
        self._executive.begin_heap(self.address)

    def damaged(self) -> DamagedBlock | None:
        """A block that was written beyond its bounds."""
        number = self._executive.check_heap(self.address)
        if not number:
            return None
        layout = self._executive.layouts["HEAP_BLOCK"]
        block = Record(layout, self._heap["pBlocks"] + number * layout.size)
        start = self._heap["pArena"] + block["start"] * GRANULE
        return DamagedBlock(start + GRANULE // 2, block["bytes"], block["origin"])

    def free_blocks(self) -> int:
        """Into how many parts what is free falls; only while no task runs."""
        layout = self._executive.layouts["HEAP_BLOCK"]
        first, count, number = self._heap["pBlocks"], 0, 1
        while number:
            block = Record(layout, first + number * layout.size)
            count += block["element"] == 0
            number = block["above"]
        return count

    def _unmap(self) -> None:
        for mapping in self._mappings:
            mapping.close()
        self._mappings.clear()

    def close(self) -> None:
        """After the end of all threads: release everything."""
        self._unmap()
        self._memory.close()


def _zero(record: Record, name: str) -> None:
    write_memory(record.place(name), bytes(record.size_of(name)))


def _fenced(size: int, *, low: bool) -> Mapping:
    mapping = map_memory(size + 2 * FENCE, low=low)
    mapping.protect(0, FENCE, accessible=False)
    mapping.protect(mapping.size - FENCE, FENCE, accessible=False)
    return mapping
