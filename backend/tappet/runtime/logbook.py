"""The log of the runtime (LOG-01): starts, stops, downloads, exceptions, what the host does not permit."""

from __future__ import annotations

import threading
import time
from collections import deque
from collections.abc import Callable
from dataclasses import dataclass
from typing import Literal

Severity = Literal["info", "warning", "error", "exception"]
LENGTH = 2000
"""Entries kept; older ones are dropped."""


@dataclass(frozen=True, slots=True)
class LogEntry:
    """One event; `number` counts up from 1 without gaps."""

    number: int
    timestamp_ns: int
    severity: Severity
    component: str
    message: str


class Logbook:
    """The newest entries, safe for several threads."""

    def __init__(self, echo: Callable[[LogEntry], None] | None = None) -> None:
        self._entries: deque[LogEntry] = deque(maxlen=LENGTH)
        self._lock = threading.Lock()
        self._count = 0
        self._echo = echo

    def add(self, severity: Severity, component: str, message: str) -> None:
        """Append an entry with the present time."""
        with self._lock:
            self._count += 1
            entry = LogEntry(self._count, time.time_ns(), severity, component, message)
            self._entries.append(entry)
        if self._echo is not None:
            self._echo(entry)

    def since(self, number: int = 0) -> list[LogEntry]:
        """Entries with a higher number, oldest first."""
        with self._lock:
            return [e for e in self._entries if e.number > number]
