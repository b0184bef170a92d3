"""The flight recorder: the whole image at the end of the last cycles (docs/architecture.md, decision 5).

`executive/flight.st` writes it, at the end of the cycles of the bus cycle task that called programs; this
side sets it up and reads it without stopping a task.
"""

from __future__ import annotations

import ctypes
import time
from bisect import bisect_left
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, TypeVar

from tappet.runtime.errors import PlcError
from tappet.runtime.executive.records import Record
from tappet.runtime.flight_deltas import BLOCK, ENTRY_SIZE, Entry, FlightError, rebuild, unpack_entries
from tappet.runtime.flight_holds import ANYBODY, FlightHolds
from tappet.runtime.flight_tasks import ROW_SIZE, TaskProgress, unpack_tasks
from tappet.runtime.image import Image
from tappet.runtime.logbook import Logbook
from tappet.runtime.posix import map_memory, pages, read_memory

if TYPE_CHECKING:
    from tappet.runtime.application import LoadedApplication
    from tappet.runtime.executive.loader import Executive

LEAST_MEMORY = 64 << 10
T = TypeVar("T")
_CHUNK = 4096
_MARGIN = 64
_TRIES = 20
_BOUNDARY_TIMEOUT_S = 5.0


@dataclass(frozen=True, slots=True)
class FlightSettings:
    """How much is kept. ValueError for what is not possible."""

    memory: int = 16 << 20
    """Bytes for entries; a copy of the image is needed besides. 0 turns the recorder off."""
    seconds: float = 10.0
    """Older entries are dropped even where there is memory for them."""
    divider: int = 1
    """Every how many cycles an entry is taken."""
    scan_limit: int = 1 << 20
    """Most bytes compared in one cycle; of a larger image each entry covers the next part."""

    def __post_init__(self) -> None:
        if self.memory and not LEAST_MEMORY <= self.memory <= 1 << 34:
            raise ValueError(
                f"the flight recorder needs at least {LEAST_MEMORY} bytes, at most 16 GiB; 0: off"
            )
        if not 0 < self.seconds <= 86_400:
            raise ValueError("the flight recorder keeps more than 0 and at most 86,400 seconds")
        if self.divider < 1 or self.scan_limit < _CHUNK:
            raise ValueError(f"divider at least 1, scan limit at least {_CHUNK} bytes")


@dataclass(frozen=True, slots=True)
class FlightStatus:
    """What is recorded. Cycles are those of the bus cycle task, as in recorder frames."""

    frozen: bool
    frozen_by: str | None
    """`request` or `exception`."""
    count: int
    first_cycle: int | None
    first_timestamp_ns: int | None
    last_cycle: int | None
    last_timestamp_ns: int | None
    period: int
    """An entry every so many cycles."""
    parts: int
    """1: all values of an entry are of its cycle. More: each entry covers one part of a large image in turn,
    so that a value may be up to `parts - 1` entries old."""
    memory: int
    """Budget in bytes."""
    used: int
    """Bytes of it that hold entries."""


@dataclass(frozen=True, slots=True)
class Capture:
    """Copies from which the image of one cycle is rebuilt, whatever the recorder does meanwhile."""

    entry: Entry
    base: bytes
    deltas: Sequence[tuple[Entry, bytes]]
    size: int


class FlightRecorder:
    """The recorder of one application. Its owner serialises the calls; the task writes beside them."""

    def __init__(
        self,
        executive: Executive,
        settings: FlightSettings,
        image: Image,
        interval_ns: int,
        *,
        tasks: int,
        faulted: Callable[[], bool],
        touch: bool,
    ) -> None:
        """`interval_ns` of the sampling task, 0 when it has none; `tasks`: how many there are; `touch` takes
        the memory from the system now, so that no cycle waits for a page. OSError when there is no memory."""
        self.settings = settings
        self._executive = executive
        self._image = image
        self._faulted = faulted
        self._limit_ns = int(settings.seconds * 1e9)
        self._row = ROW_SIZE * tasks
        most = settings.memory // 4 // (ENTRY_SIZE + self._row)
        step = interval_ns * settings.divider
        self.capacity = min(most, self._limit_ns // step + _MARGIN) if step else most
        entries = -(-self.capacity * ENTRY_SIZE // _CHUNK) * _CHUNK
        rows = pages((self.capacity + 1) * self._row)
        ring = (settings.memory - entries - rows) // _CHUNK * _CHUNK
        layout = executive.layouts["FLIGHT_RECORDER"]
        self._memory = map_memory(pages(layout.size) + entries + ring + rows)
        try:
            self._shadow = map_memory(pages(image.capacity))
        except OSError:
            self._memory.close()
            raise
        if touch:
            ctypes.memset(self._memory.address, 0, self._memory.size)
        self.record = record = Record(layout, self._memory.address)
        self.address = record.address
        record["capacity"] = self.capacity
        record["pEntries"] = self._memory.address + pages(layout.size)
        record["ringSize"] = self._ring_size = ring
        record["pRing"] = self._ring = record["pEntries"] + entries
        record["taskCount"] = tasks
        record["pTasks"] = self._rows = self._ring + ring
        record["divider"] = settings.divider
        record["ageLimit"] = self._limit_ns
        record["pImage"] = image.address
        record["pShadow"] = self._shadow.address
        self.parts = 1
        self._size = 0
        self._renew = True
        self._last: tuple[int, bytes] | None = None
        self.holds = FlightHolds()
        self.relocate()

    # -- life cycle --------------------------------------------------------------------------------------

    def relocate(self) -> None:
        """Drop everything and begin again with the image as it is now; only while no task runs."""
        record = self.record
        self._size = -(-self._image.size // BLOCK) * BLOCK
        limit = min(self.settings.scan_limit, self._ring_size // 4) // _CHUNK * _CHUNK
        self.parts = max(1, -(-self._size // limit))
        part = self._size
        if self.parts > 1:  # about equal, so that no cycle has more to do than another one
            part = -(-self._size // self.parts // _CHUNK) * _CHUNK
        record["imageSize"] = self._size
        record["partSize"] = part
        record["partStart"] = 0
        record["reserve"] = part // BLOCK * (BLOCK + 8)
        record["first"] = record["next"]  # numbers continue: an entry is never mistaken for another one
        record["head"] = 0
        record["skipped"] = self.settings.divider
        self._thaw()
        ctypes.memmove(self._shadow.address, self._image.address, self._size)
        self._last = None
        self._renew = False

    def renew(self) -> None:
        """The variables got their initial values: the next start drops what is kept, until then it can be
        read."""
        self._renew = True

    def begin(self) -> None:
        """Record again; before the programs start."""
        if self._renew:
            self.relocate()
        self._thaw()

    def _thaw(self) -> None:
        self.holds.clear()
        self.record["frozen"] = 0

    def freeze(self, on: bool, owner: str = ANYBODY, lease_s: float | None = None) -> None:
        """Stop recording, so that nothing kept is dropped any more, or continue when no other owner holds
        it. After `lease_s` it continues by itself, unless that was renewed."""
        if on:
            self.holds.take(owner, lease_s)
        else:
            self.holds.release(owner)
        self._follow_holds()

    def renew_freeze(self, owner: str, lease_s: float) -> None:
        """Hold it further; PlcError when it was let go."""
        if not self.holds.renew(owner, lease_s):
            raise PlcError("the flight recorder is not frozen any more by who wants to keep it so")

    def let_go(self) -> None:
        """Continue when the last owner has not renewed in time. Called again and again."""
        if self.holds.lapse():
            self._follow_holds()

    def _follow_holds(self) -> None:
        self._executive.store_flag(self.record.place("frozen"), int(bool(self.holds)))
        self._await_boundary()

    def close(self) -> None:
        """Release the memory; no task may run any more."""
        self._memory.close()
        self._shadow.close()

    # -- reading -----------------------------------------------------------------------------------------

    def status(self) -> FlightStatus:
        """What is kept now."""
        faulted, requested = self._faulted(), bool(self.record["frozen"])
        entries, head = self._steady(lambda: (self._ends(), self.record["head"]))
        first, last = entries if entries else (None, None)
        return FlightStatus(
            frozen=faulted or requested,
            frozen_by="exception" if faulted else "request" if requested else None,
            count=last.number - first.number + 1 if first and last else 0,
            first_cycle=first.cycle if first else None,
            first_timestamp_ns=first.timestamp_ns if first else None,
            last_cycle=last.cycle if last else None,
            last_timestamp_ns=last.timestamp_ns if last else None,
            period=self.settings.divider,
            parts=self.parts,
            memory=self.settings.memory,
            used=head - first.position + (last.number - first.number + 1) * ENTRY_SIZE
            if first and last
            else 0,
        )

    def history(self) -> list[tuple[int, int]]:
        """(cycle, unix time in ns) of everything that is kept, oldest first."""
        return [(e.cycle, e.timestamp_ns) for e in self._steady(self._entries)]

    def capture(self, cycle: int) -> Capture:
        """Copy what is needed to rebuild the image at `cycle`; FlightError when it is not kept."""
        entries, base = self._steady(lambda: (self._entries(), read_memory(self._shadow.address, self._size)))
        at = bisect_left(entries, cycle, key=lambda e: e.cycle)
        if at == len(entries) or entries[at].cycle != cycle:
            raise FlightError(_not_kept(cycle, entries, at))
        wanted, newest = entries[at], entries[-1].number
        last = self._last
        if last is not None and wanted.number <= last[0] <= newest:
            newest, base = last
        deltas = [(e, self._bytes(e)) for e in reversed(entries[at + 1 : at + 1 + newest - wanted.number])]
        if self._executive.load(self.record.place("first")) > wanted.number:
            raise FlightError(f"cycle {cycle} was dropped while it was being read; freeze the recorder first")
        return Capture(wanted, base, deltas, self._image.size)

    def newest(self) -> bytes:
        """The image at the newest entry; only while no task runs."""
        return read_memory(self._shadow.address, self._image.size)

    def export(self) -> tuple[bytes, list[tuple[Entry, bytes, list[TaskProgress]]]]:
        """The image at the newest entry, and all entries with their bytes and how far the tasks were, oldest
        first. An entry that was dropped meanwhile is missing, as are those before it."""
        entries, base = self._steady(lambda: (self._entries(), read_memory(self._shadow.address, self._size)))
        found = [(entry, self._bytes(entry), self._tasks(entry)) for entry in entries]
        first = self._executive.load(self.record.place("first"))
        return base, [one for one in found if one[0].number >= first]

    def rebuild(self, capture: Capture) -> bytes:
        """The image out of a capture; may run beside all other calls."""
        image = rebuild(capture.base, capture.deltas)
        self._last = (capture.entry.number, image)  # stepping back continues from here
        return image[: capture.size]

    # -- details -----------------------------------------------------------------------------------------

    def _entry_bytes(self, start: int, count: int) -> bytes:
        table = self.record["pEntries"]
        at = start % self.capacity
        ahead = min(count, self.capacity - at)
        data = read_memory(table + at * ENTRY_SIZE, ahead * ENTRY_SIZE)
        return data + read_memory(table, (count - ahead) * ENTRY_SIZE)

    def _entries(self) -> list[Entry]:
        first, behind = self.record["first"], self.record["next"]
        return unpack_entries(first, self._entry_bytes(first, behind - first))

    def _ends(self) -> tuple[Entry, Entry] | None:
        first, behind = self.record["first"], self.record["next"]
        if first == behind:
            return None
        oldest = unpack_entries(first, self._entry_bytes(first, 1))
        newest = unpack_entries(behind - 1, self._entry_bytes(behind - 1, 1))
        return oldest[0], newest[0]

    def _bytes(self, entry: Entry) -> bytes:
        at = entry.position % self._ring_size
        if not 0 <= entry.size <= self._ring_size - at:
            raise FlightError(
                f"the flight recorder's entry of cycle {entry.cycle} is damaged: {entry.size} bytes at {at}"
            )
        return read_memory(self._ring + at, entry.size)

    def _tasks(self, entry: Entry) -> list[TaskProgress]:
        at = self._rows + entry.number % self.capacity * self._row
        return unpack_tasks(read_memory(at, self._row))

    def _steady(self, copy: Callable[[], T]) -> T:
        """What `copy` returns, called while no entry is being written. When the task is too fast for that, it
        leaves out a few entries."""
        cell = self.record.place("sequence")
        for _ in range(_TRIES):
            before = self._executive.load(cell)
            if before % 2 == 0:
                result = copy()
                if self._executive.load(cell) == before:
                    return result
            time.sleep(0)
        hold = self.record.place("hold")
        self._executive.store_flag(hold, 1)
        try:
            self._await_boundary()
            return copy()
        finally:
            self._executive.store_flag(hold, 0)

    def _await_boundary(self) -> None:
        cell = self.record.place("sequence")
        due = time.monotonic() + _BOUNDARY_TIMEOUT_S
        while self._executive.load(cell) % 2:
            if time.monotonic() > due:
                raise FlightError("the task does not come to the end of its entry")
            time.sleep(0.0001)


def _not_kept(cycle: int, entries: Sequence[Entry], at: int) -> str:
    if not entries:
        return f"cycle {cycle} is not kept: the flight recorder holds no cycle"
    near = [str(entries[i].cycle) for i in (at - 1, at) if 0 <= i < len(entries)]
    return (
        f"cycle {cycle} is not kept; the flight recorder holds cycles {entries[0].cycle} to "
        f"{entries[-1].cycle}, next to it {' and '.join(near)}"
    )


def make_flight(application: LoadedApplication, settings: FlightSettings) -> FlightRecorder | None:
    """The flight recorder, at the bus cycle task; None without task, memory or wish for it."""
    from tappet.runtime.contexts import FAULTED  # what only reads recordings does without tasks

    bus = application.ownership.bus
    if bus is None or not settings.memory:
        return None
    try:
        return FlightRecorder(
            application.executive,
            settings,
            application.image,
            application.package.tasks[bus].interval_ns,
            tasks=len(application.package.tasks),
            faulted=lambda: application.tasks.state == FAULTED,
            touch=not application.virtual,
        )
    except OSError:
        return None


def note_flight(application: LoadedApplication, settings: FlightSettings, log: Logbook) -> None:
    """Log what of past cycles is not kept."""
    recorder = application.flight
    if recorder is None:
        if settings.memory and application.contexts.tasks:
            log.add("error", "flight", "no memory for the flight recorder; past cycles are not kept")
    elif recorder.parts > 1:
        log.add("info", "flight", f"large image: each cycle records one of {recorder.parts} parts in turn")
