"""Remanent variables on disk (PERS-01..PERS-05).

`retain.live` is mapped into memory: tasks copy their remanent variables into it at the end of each cycle, in
turn into one of two slots, so a process killed at any instruction loses at most the running cycle.
`retain.saved` is written as a whole at stop and exit and counts when the machine itself failed and the live
file is torn.
"""

from __future__ import annotations

import os
import struct
import zlib
from collections.abc import Mapping as MappingType
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

import msgpack

from tappet.codegen.package import CodePackage, RemanentRange
from tappet.runtime.executive.records import Block, Record
from tappet.runtime.logbook import Logbook
from tappet.runtime.posix import Mapping, map_memory, read_memory, write_memory
from tappet.whole_file import PRIVATE, replace_file, sync_folder

if TYPE_CHECKING:
    from tappet.runtime.application import LoadedApplication
    from tappet.runtime.executive.loader import Executive

MAGIC = b"TAPPETRT"
VERSION = 1
LIVE, SAVED = "retain.live", "retain.saved"
_HEAD = struct.Struct("<8sIII")  # magic, version, length and checksum of the table
_SLOT = struct.Struct("<qQ")  # sequence, checksum
_PAGE = 4096
_LARGEST = 256 << 20
_BASIS, _PRIME, _MASK = 0xCBF29CE484222325, 0x100000001B3, (1 << 64) - 1


class RetainError(ValueError):
    """The bytes are no valid retain file."""


def checksum(data: bytes) -> int:
    """The sum that `retain.st` computes: 64-bit words mixed by the FNV-1a step."""
    total = _BASIS
    for (word,) in struct.iter_unpack("<Q", data):
        total = (total ^ word) * _PRIME & _MASK
    return total


def slot_checksum(sequence: int, data: bytes) -> int:
    """Sum of a slot: its data, and its sequence, so that an old slot cannot pass for the newest."""
    return checksum(data) ^ sequence & _MASK


@dataclass(frozen=True, slots=True)
class Remanent:
    """One variable in a group: its range in the image and whether it is PERSISTENT."""

    variable: RemanentRange
    persistent: bool


@dataclass(frozen=True, slots=True)
class KeptValue:
    """A value from before: what it was and how it was declared."""

    type_signature: str
    data: bytes
    persistent: bool


Kept = dict[str, KeptValue]
"""By upper-case path."""


@dataclass(frozen=True, slots=True)
class GroupPlace:
    """A retain group in the file: its variables, bytes of data, and where its two slots begin."""

    variables: tuple[Remanent, ...]
    size: int
    slots: tuple[int, int]


def _plan(groups: Sequence[Sequence[Remanent]]) -> tuple[list[GroupPlace], bytes]:
    """Places of all groups and the table that describes them; slots begin on page boundaries."""
    sizes = [-(-sum(r.variable.size for r in group) // 8) * 8 for group in groups]

    def table(places: list[GroupPlace]) -> bytes:
        rows = [
            [
                [
                    [r.variable.path, r.variable.type_signature, r.variable.size, r.persistent]
                    for r in p.variables
                ],
                p.size,
                list(p.slots),
            ]
            for p in places
        ]
        packed: bytes = msgpack.packb(rows, use_bin_type=True)
        return packed

    largest = [GroupPlace(tuple(g), s, (1 << 40, 1 << 40)) for g, s in zip(groups, sizes, strict=True)]
    at = _round_up(_HEAD.size + len(table(largest)) + 8)
    places = []
    for group, size in zip(groups, sizes, strict=True):
        first = at
        second = _round_up(first + _SLOT.size + size)
        at = _round_up(second + _SLOT.size + size)
        places.append(GroupPlace(tuple(group), size, (first, second)))
    return places, table(places)


def _round_up(size: int) -> int:
    return -(-size // _PAGE) * _PAGE


def _size(places: list[GroupPlace], table: bytes) -> int:
    return max((p.slots[1] + _SLOT.size + p.size for p in places), default=_HEAD.size + len(table))


def _allocate(path: Path, size: int) -> int:
    """A new file with room on the disk: a full one is an error now, not a fault in a task."""
    fd = os.open(path, os.O_RDWR | os.O_CREAT | os.O_TRUNC | os.O_CLOEXEC, PRIVATE)
    try:
        os.posix_fallocate(fd, 0, _round_up(size))
    except OSError:
        os.close(fd)
        path.unlink(missing_ok=True)
        raise
    return fd


def check_retain_room(path: Path, groups: Sequence[Sequence[Remanent]]) -> None:
    """Raises OSError when the disk has no room for a file of these groups beside the one that is there."""
    temporary = path.with_suffix(".new")
    os.close(_allocate(temporary, _size(*_plan(groups))))
    temporary.unlink()


class RetainFile:
    """The mapped file and the groups that tasks save into it."""

    def __init__(
        self, executive: Executive, path: Path, groups: Sequence[Sequence[Remanent]], image: int
    ) -> None:
        self.path = path
        places, table = _plan(groups)
        self.size = _size(places, table)
        temporary = path.with_suffix(".new")
        fd = _allocate(temporary, self.size)
        try:
            os.pwrite(fd, _HEAD.pack(MAGIC, VERSION, len(table), zlib.crc32(table)) + table, 0)
            self._mapping: Mapping = map_memory(_round_up(self.size), fd)
        finally:
            os.close(fd)
        self._blocks: list[Block] = []
        self.groups = [self._group(executive, place, image) for place in places]
        self._mapping.sync()
        os.replace(temporary, path)
        sync_folder(path.parent)

    def _group(self, executive: Executive, place: GroupPlace, image: int) -> Record:
        layout, ranges = executive.layouts["RETAIN_GROUP"], executive.layouts["MEMORY_RANGE"]
        merged: list[tuple[int, int]] = []
        for r in place.variables:
            if merged and sum(merged[-1]) == r.variable.offset:
                merged[-1] = (merged[-1][0], merged[-1][1] + r.variable.size)
            else:
                merged.append((r.variable.offset, r.variable.size))
        block, list_block = Block(layout.size), Block(max(1, len(merged)) * ranges.size)
        self._blocks += [block, list_block]
        for entry, (offset, size) in zip(list_block.array(ranges, len(merged)), merged, strict=True):
            entry["pMemory"] = image + offset
            entry["size"] = size
        record = Record(layout, block.address)
        record["rangeCount"] = len(merged)
        record["pRanges"] = list_block.address
        record["dataSize"] = place.size
        slots = struct.pack("<QQ", *(self._mapping.address + slot for slot in place.slots))
        at = layout.members["slots"].offset
        block.view()[at : at + 16] = slots
        data = b"".join(read_memory(image + offset, size) for offset, size in merged)
        data += bytes(place.size - len(data))
        slot = _SLOT.pack(1, slot_checksum(1, data)) + data
        write_memory(self._mapping.address + place.slots[0], slot)
        record["sequence"] = 1
        return record

    def sync(self) -> None:
        """Bring the live file to the disk itself; a service thread does this from time to time.

        It works on the path, so that it needs no lock against `close`.
        """
        fd = os.open(self.path, os.O_RDONLY | os.O_CLOEXEC)
        try:
            os.fdatasync(fd)
        finally:
            os.close(fd)

    def save(self) -> None:
        """Write the saved copy: complete or not at all."""
        data = self.path.read_bytes()
        replace_file(self.path.with_name(SAVED), data, mode=PRIVATE, to_disk=True)

    def close(self) -> None:
        """Unmap; no task may use the groups any more."""
        self._mapping.close()


def parse_retain(data: bytes) -> Kept:
    """Values of a retain file; RetainError when it is damaged or a group has no complete slot."""
    if len(data) < _HEAD.size:
        raise RetainError("shorter than its header")
    magic, version, length, crc = _HEAD.unpack_from(data)
    if magic != MAGIC:
        raise RetainError("not a retain file")
    if version != VERSION:
        raise RetainError(f"version {version} is not {VERSION}")
    table = data[_HEAD.size : _HEAD.size + length]
    if len(table) != length or zlib.crc32(table) != crc:
        raise RetainError("its table is damaged")
    kept: Kept = {}
    try:
        for variables, size, slots in msgpack.unpackb(table, raw=False):
            content = _newest_slot(data, size, slots)
            at = 0
            for path, signature, length, persistent in variables:
                value = content[at : at + length]
                if len(value) != length:
                    raise RetainError(f"variable {path} is cut off")
                kept[path.upper()] = KeptValue(signature, value, bool(persistent))
                at += length
    except RetainError:
        raise
    except (ValueError, TypeError, KeyError, AttributeError, struct.error, msgpack.UnpackException) as error:
        raise RetainError(f"its table is malformed: {error}") from error
    return kept


def _newest_slot(data: bytes, size: int, slots: list[int]) -> bytes:
    if not isinstance(size, int) or not 0 <= size <= _LARGEST or size % 8:
        raise RetainError(f"group of {size!r} bytes")
    best: tuple[int, bytes] | None = None
    for slot in slots:
        if not isinstance(slot, int) or slot < _HEAD.size or slot + _SLOT.size + size > len(data):
            raise RetainError(f"slot at {slot!r} lies outside the file")
        sequence, expected = _SLOT.unpack_from(data, slot)
        content = data[slot + _SLOT.size : slot + _SLOT.size + size]
        if (
            sequence > 0
            and slot_checksum(sequence, content) == expected
            and (best is None or sequence > best[0])
        ):
            best = (sequence, content)
    if best is None:
        raise RetainError("no slot of a group is complete")
    return best[1]


def load_retain(folder: Path) -> tuple[Kept, list[str]]:
    """Values kept in `folder`, of the live file or else of the saved one, and what was wrong on the way."""
    problems: list[str] = []
    for name in (LIVE, SAVED):
        path = folder / name
        try:
            if path.stat().st_size > _LARGEST:
                raise RetainError("too large")
            return parse_retain(path.read_bytes()), problems
        except FileNotFoundError:
            continue
        except (OSError, RetainError) as error:
            problems.append(f"{name}: {error}")
    return {}, problems


def remove_retain(folder: Path) -> None:
    """Forget everything (reset origin)."""
    for name in (LIVE, SAVED):
        (folder / name).unlink(missing_ok=True)


def matching(
    kept: MappingType[str, KeptValue], variables: Sequence[Remanent]
) -> tuple[list[tuple[RemanentRange, bytes]], list[str]]:
    """Kept values that fit a variable of the application by path and type, and the paths that found no
    place.
    """
    restored = []
    used = set()
    for r in variables:
        key = r.variable.path.upper()
        value = kept.get(key)
        if value is None or value.type_signature != r.variable.type_signature:
            continue
        if len(value.data) == r.variable.size:
            restored.append((r.variable, value.data))
            used.add(key)
    return restored, [path for path in kept if path not in used]


def note_lost(kept: MappingType[str, KeptValue], variables: Sequence[Remanent], log: Logbook) -> None:
    """Persistent values that found no place in the application."""
    lost = [path for path in matching(kept, variables)[1] if kept[path].persistent]
    if lost:
        names = ", ".join(lost[:5]) + (" ..." if len(lost) > 5 else "")
        log.add("warning", "retain", f"persistent variables without a place in the application: {names}")


def persistent_of(old: LoadedApplication | None, package: CodePackage, folder: Path | None) -> Kept:
    """Persistent values survive a download of the application of the same name (PERS-05); ends its tasks."""
    if old is not None:
        if old.package.application != package.application:
            return {}
        old.tasks.stop()
        return old.kept_values(retain=False)
    if folder is None:
        return {}
    kept, _ = load_retain(folder)  # left by a boot application that could not be loaded
    return {path: value for path, value in kept.items() if value.persistent}
