"""Lines of a log that repeat are counted instead of written. May be imported by every room."""

from __future__ import annotations

import logging
import time
from collections.abc import Callable

MOST_KINDS = 1000
"""Of lines that are counted."""


class RateLimit(logging.Filter):
    """Lets a kind of line pass `most` times in `seconds`, and says afterwards how many were left out.

    Lines are of one kind when they come from one place and begin alike before values are put in. Whoever
    makes the server complain does not fill its disk.
    """

    def __init__(
        self, most: int = 20, seconds: float = 10.0, clock: Callable[[], float] | None = None
    ) -> None:
        super().__init__()
        self._most = most
        self._seconds = seconds
        self._clock = clock or time.monotonic
        self._kinds: dict[tuple[str, int, str], tuple[float, int]] = {}

    def filter(self, record: logging.LogRecord) -> bool:
        """Whether the line is written."""
        kind = (record.name, record.lineno, str(record.msg)[:60])
        now = self._clock()
        begun, count = self._kinds.get(kind, (now, 0))
        if now - begun >= self._seconds:
            if count > self._most:
                record.msg = f"{record.getMessage()} ({count - self._most} lines like this were left out)"
                record.args = ()
            begun, count = now, 0
        if len(self._kinds) >= MOST_KINDS and kind not in self._kinds:
            self._kinds.clear()
        self._kinds[kind] = (begun, count + 1)
        return count < self._most
