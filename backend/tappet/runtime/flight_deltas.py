"""Entries of the flight recorder and how they take an image back by one cycle.

An entry's bytes are runs of `u32 offset, u32 size, size bytes`, little endian: what these bytes of the image
were before the cycle. Everything is checked before the image is touched.
"""

from __future__ import annotations

import struct
from collections.abc import Iterable
from dataclasses import dataclass

BLOCK = 64
"""Bytes that are compared and kept as one, and alignment of runs."""
ENTRY_SIZE = 48
"""Bytes of a FLIGHT_ENTRY of types.st."""
_ENTRY = struct.Struct("<qqqqqQ")
_RUN = struct.Struct("<II")
_WORD = (1 << 64) - 1


class FlightError(ValueError):
    """A cycle is not kept, or what is kept of it is damaged."""


@dataclass(frozen=True, slots=True)
class Entry:
    """One recorded cycle: where its bytes lie and what they must add up to."""

    number: int
    position: int
    size: int
    cycle: int
    timestamp_ns: int
    checksum: int
    due_ns: int = 0
    """When the cycle was to begin, by the clock of the application."""


def unpack_entries(first: int, data: bytes) -> list[Entry]:
    """Entries out of their memory, oldest first; `first` is the number of the oldest."""
    if len(data) % ENTRY_SIZE:
        raise FlightError(f"{len(data)} bytes are no entries of {ENTRY_SIZE} bytes each")
    rows = enumerate(_ENTRY.iter_unpack(data), first)
    return [
        Entry(n, position, size, cycle, stamp, check, due)
        for n, (position, size, cycle, stamp, due, check) in rows
    ]


def xor_words(data: bytes) -> int:
    """All 64-bit words of `data`, XOR; a whole number of words."""
    words = len(data) // 8
    value = int.from_bytes(data, "little")
    while words > 1:
        half = -(-words // 2)
        value = (value >> half * 64) ^ (value & (1 << half * 64) - 1)
        words = half
    return value


def checksum(position: int, cycle: int, timestamp_ns: int, data: bytes) -> int:
    """What `Entry.checksum` must be."""
    head = (position & _WORD) ^ len(data) ^ (cycle & _WORD) ^ (timestamp_ns & _WORD)
    return head ^ xor_words(data)


def _damaged(entry: Entry, what: str) -> FlightError:
    return FlightError(f"the flight recorder's entry of cycle {entry.cycle} is damaged: {what}")


def runs(entry: Entry, data: bytes, image_size: int) -> list[tuple[int, int, int]]:
    """(offset in the image, place in `data`, size) of all runs; FlightError when they are not as written."""
    if len(data) != entry.size or len(data) % 8:
        raise _damaged(entry, f"{len(data)} bytes instead of {entry.size}")
    if checksum(entry.position, entry.cycle, entry.timestamp_ns, data) != entry.checksum:
        raise _damaged(entry, "its checksum does not fit")
    try:
        return delta_runs(data, image_size)
    except FlightError as error:
        raise _damaged(entry, str(error)) from error


def delta_runs(data: bytes, image_size: int) -> list[tuple[int, int, int]]:
    """(offset in the image, place in `data`, size) of all runs of an entry's bytes."""
    found = []
    at = behind = 0
    while at < len(data):
        if at + _RUN.size > len(data):
            raise FlightError(f"{len(data) - at} bytes behind the last run")
        offset, size = _RUN.unpack_from(data, at)
        at += _RUN.size
        if size == 0 or size % BLOCK or offset % BLOCK or at + size > len(data):
            raise FlightError(f"a run of {size} bytes for offset {offset} in {len(data)} bytes")
        if offset < behind or offset + size > image_size:
            raise FlightError(f"a run of {size} bytes for offset {offset}, image of {image_size} bytes")
        found.append((offset, at, size))
        at += size
        behind = offset + size
    return found


def undo(image: bytearray, entry: Entry, data: bytes) -> None:
    """Take `image` from what it was at `entry` back to the entry before; unchanged when this raises."""
    for offset, at, size in runs(entry, data, len(image)):
        image[offset : offset + size] = data[at : at + size]


def rebuild(base: bytes, deltas: Iterable[tuple[Entry, bytes]]) -> bytes:
    """The image before the last of `deltas`, which go from the newest to the oldest, beginning at `base`."""
    image = bytearray(base)
    for entry, data in deltas:
        undo(image, entry, data)
    return bytes(image)
