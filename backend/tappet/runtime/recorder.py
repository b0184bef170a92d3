"""Recorders: values sampled by a task at the end of its cycles into a ring that Python empties.

See docs/architecture.md, decision 4.
"""

from __future__ import annotations

import struct
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

from tappet.runtime.executive.records import Block, Layout, Record

if TYPE_CHECKING:
    from tappet.runtime.executive.loader import Executive

HEADER_SIZE = 16
"""Cycle number (u64) and unix time in ns (i64) before the values of a frame."""
LARGEST_FRAME = 1 << 20
_RING_BYTES = 1 << 20
_LEAST_FRAMES, _MOST_FRAMES = 16, 8192
MOST_PER_TASK = 64
_HEAD = struct.Struct("<Qq")


@dataclass(frozen=True, slots=True)
class Frame:
    """Values of one cycle, packed in the order of the items."""

    cycle: int
    timestamp_ns: int
    data: bytes


@dataclass(frozen=True, slots=True)
class RecorderSpec:
    """What to record: (offset, size) in the image, every `divider`-th cycle, `min_interval_ns` apart at
    least.
    """

    items: tuple[tuple[int, int], ...]
    task: int
    divider: int = 1
    min_interval_ns: int = 0
    frames: int = 0
    """Wanted length of the ring in frames; 0 for as many as fit into a megabyte."""

    @property
    def data_size(self) -> int:
        """Bytes of values in a frame."""
        return sum(size for _, size in self.items)


def merge_ranges(items: Sequence[tuple[int, int]]) -> list[tuple[int, int]]:
    """Items that follow each other in memory become one copy; the order of the bytes stays."""
    merged: list[tuple[int, int]] = []
    for offset, size in items:
        if merged and merged[-1][0] + merged[-1][1] == offset:
            merged[-1] = (merged[-1][0], merged[-1][1] + size)
        elif size:
            merged.append((offset, size))
    return merged


class Recorder:
    """One running recorder. `take` empties its ring; the task never waits for that."""

    def __init__(self, executive: Executive, spec: RecorderSpec, image: int) -> None:
        if not spec.items or any(size <= 0 for _, size in spec.items):
            raise ValueError("a recorder needs items of at least one byte each")
        if spec.data_size > LARGEST_FRAME:
            raise ValueError(f"a frame of {spec.data_size} bytes; at most {LARGEST_FRAME} are possible")
        self.spec = spec
        self._executive = executive
        self.frame_size = HEADER_SIZE + -(-spec.data_size // 8) * 8
        fitting = max(_LEAST_FRAMES, min(_MOST_FRAMES, _RING_BYTES // self.frame_size))
        self.capacity = min(_MOST_FRAMES, max(_LEAST_FRAMES, spec.frames)) if spec.frames else fitting
        self._ring = Block(self.frame_size * self.capacity)
        self._view = self._ring.view()
        layout: Layout = executive.layouts["RECORDER"]
        self._block = Block(layout.size)
        self.record = Record(layout, self._block.address)
        self._ranges: Block | None = None
        self.located: tuple[tuple[int, int], ...] = ()
        """Where the items lie now, after online changes."""
        self._taken = 0
        record = self.record
        record["divider"] = max(1, spec.divider)
        record["skipped"] = max(1, spec.divider)  # the first cycle is sampled
        record["minInterval"] = max(0, spec.min_interval_ns)
        record["capacity"] = self.capacity
        record["frameSize"] = self.frame_size
        record["pRing"] = self._ring.address
        self.locate(spec.items, image)

    def locate(self, items: Sequence[tuple[int, int]], image: int) -> None:
        """Set where the values lie; after the first time only while the task stands."""
        ranges = merge_ranges(items)
        layout = self._executive.layouts["MEMORY_RANGE"]
        block = Block(layout.size * len(ranges))
        for entry, (offset, size) in zip(block.array(layout, len(ranges)), ranges, strict=True):
            entry["pMemory"] = image + offset
            entry["size"] = size
        self.record["pRanges"] = block.address
        self.record["rangeCount"] = len(ranges)
        self._ranges = block
        self.located = tuple(items)

    def restart(self) -> None:
        """The clock is reset: the next cycle is sampled; only while the task stands."""
        self.record["lastSample"] = -(1 << 62)
        self.record["skipped"] = self.record["divider"]

    @property
    def dropped(self) -> int:
        """Frames that found the ring full and were not stored."""
        return self.record["dropped"]

    def take_raw(self, limit: int | None = None) -> tuple[int, bytes]:
        """Number of new frames and their bytes, frame after frame, oldest first; at most `limit` frames."""
        written = self._executive.load(self.record.place("written"))
        count = written - self._taken
        if limit is not None:
            count = min(count, limit)
        if count <= 0:
            return 0, b""
        start = self._taken % self.capacity
        first = min(count, self.capacity - start)
        size = self.frame_size
        data = bytes(self._view[start * size : (start + first) * size])
        if count > first:
            data += bytes(self._view[: (count - first) * size])
        self._taken += count
        self._executive.store(self.record.place("taken"), self._taken)
        return count, data

    def take(self, limit: int | None = None) -> list[Frame]:
        """New frames, oldest first."""
        count, data = self.take_raw(limit)
        return split_frames(data, count, self.frame_size, self.spec.data_size)


def split_frames(data: bytes, count: int, frame_size: int, data_size: int) -> list[Frame]:
    """Frames out of the bytes of a ring."""
    frames = []
    for at in range(0, count * frame_size, frame_size):
        cycle, timestamp = _HEAD.unpack_from(data, at)
        frames.append(Frame(cycle, timestamp, data[at + HEADER_SIZE : at + HEADER_SIZE + data_size]))
    return frames


class RecorderList:
    """A RECORDER_LIST in native memory; never changed once a task may see it."""

    def __init__(self, executive: Executive, recorders: Sequence[Recorder]) -> None:
        if len(recorders) > MOST_PER_TASK:
            raise ValueError(f"a task samples at most {MOST_PER_TASK} recorders")
        layout = executive.layouts["RECORDER_LIST"]
        self._block = Block(layout.size)
        self._recorders = list(recorders)  # their memory must live as long as the list
        record = Record(layout, self._block.address)
        record["count"] = len(recorders)
        places = b"".join(r.record.address.to_bytes(8, "little") for r in recorders)
        at = layout.members["recorders"].offset
        self._block.view()[at : at + len(places)] = places
        self.address = self._block.address
