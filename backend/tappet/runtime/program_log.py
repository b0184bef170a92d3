"""Messages that programs write (ADSLOGSTR and its like): the ring that tasks fill, read into the log."""

from __future__ import annotations

from tappet.runtime.executive.loader import Executive
from tappet.runtime.executive.records import Arena, Record
from tappet.runtime.logbook import Logbook, Severity
from tappet.runtime.posix import read_memory

COMPONENT = "program"
_HINT, _WARNING, _ERROR = 1, 2, 4
"""ADSLOG_MSGTYPE_* of Tc2_System."""


class ProgramLog:
    """The ring of one application. Filled by its tasks without waiting, emptied by one thread at a time."""

    def __init__(self, executive: Executive) -> None:
        self._executive = executive
        ring = executive.layouts["LOG_RING"]
        self._memory = Arena(ring.size)
        self._ring = Record(ring, self._memory.take(ring.size))
        self._layout = executive.layouts["LOG_MESSAGE"]
        self._room = self._ring.size_of("messages") // self._layout.size
        self._told = 0

    @property
    def address(self) -> int:
        """LOG_RING."""
        return self._ring.address

    def collect(self, log: Logbook) -> None:
        """Move what is complete into `log`."""
        taken = self._ring["taken"]
        while True:
            place = self._ring.place("messages") + taken % self._room * self._layout.size
            message = Record(self._layout, place)
            if self._executive.load(message.place("number")) != taken + 1:
                break
            raw = read_memory(message.place("text"), message.size_of("text"))
            text = raw[: raw.find(0)].decode("utf-8", "replace")
            log.add(_severity(message["kind"]), COMPONENT, text)
            taken += 1
            self._executive.store(self._ring.place("taken"), taken)
        lost = self._ring["lost"]
        if lost != self._told:
            log.add("warning", COMPONENT, f"{lost - self._told} messages came faster than the log takes them")
            self._told = lost

    def close(self) -> None:
        """Release the ring; no task runs any more."""
        self._memory.close()


def _severity(kind: int) -> Severity:
    if kind & _ERROR:
        return "error"
    return "warning" if kind & _WARNING else "info"
