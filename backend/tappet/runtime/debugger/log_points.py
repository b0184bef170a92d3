"""What log points have written: from the ring that tasks fill into the log of the runtime."""

from __future__ import annotations

from collections.abc import Mapping

from tappet.runtime.debugger.breakpoints import Wanted
from tappet.runtime.debugger.variant import Variant
from tappet.runtime.executive.records import Record
from tappet.runtime.logbook import Logbook
from tappet.runtime.posix import read_memory

COMPONENT = "debugger"
ROOM = 256
"""Entries of DEBUG_LOG."""


def collect(variant: Variant, breakpoints: Mapping[int, Wanted], log: Logbook) -> None:
    """Move what is complete into the log."""
    executive = variant.executive
    ring = Record(executive.layouts["DEBUG_LOG"], variant.log.address)
    layout = executive.layouts["DEBUG_LOG_ENTRY"]
    taken = ring["taken"]
    while True:
        entry = Record(layout, ring.place("entries") + taken % ROOM * layout.size)
        if executive.load(entry.place("number")) != taken + 1:
            break
        wanted = breakpoints.get(entry["breakpoint"])
        if wanted is not None and wanted.text is not None:
            raw = memoryview(read_memory(entry.place("values"), entry.size_of("values"))).cast("q")
            log.add("info", COMPONENT, wanted.text.filled(variant.code.types, entry["valid"], list(raw)))
        taken += 1
        executive.store(ring.place("taken"), taken)
    lost = ring["lost"]
    if lost:
        ring["lost"] = 0
        log.add("warning", COMPONENT, f"{lost} messages of log points came faster than the log takes them")
