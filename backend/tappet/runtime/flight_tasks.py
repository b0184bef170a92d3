"""How far the tasks were around a recorded cycle of the bus cycle task.

The flight recorder keeps it beside each entry (FLIGHT_TASK of types.st), so that a replay runs the cycles of
the other tasks where they ran, and knows where two tasks ran at the same time.
"""

from __future__ import annotations

import struct
from typing import Annotated

from msgspec import Meta, Struct

_ROW = struct.Struct("<qqqqq")
ROW_SIZE = _ROW.size
"""Bytes of a FLIGHT_TASK."""
Natural = Annotated[int, Meta(ge=0, le=(1 << 62) - 1)]
Moment = Annotated[int, Meta(ge=-(1 << 62), le=1 << 62)]


class TaskProgress(Struct, frozen=True, array_like=True):
    """A task at the end of a recorded cycle. Progress is twice the number of completed cycles of the
    programs, and one more while one runs."""

    before: Natural
    """Progress when the recorded cycle began."""
    after: Natural
    cycle: Natural
    started_ns: Moment
    """When its last cycle began, by the clock of the application."""
    requested_ns: Moment
    """And when that was due."""

    @property
    def completed(self) -> int:
        """Cycles that had ended."""
        return self.after // 2

    @property
    def beside(self) -> bool:
        """Whether it ran while the recorded cycle did: what of the other one each has seen is not known."""
        return self.before != self.after or self.after % 2 == 1


def unpack_tasks(data: bytes) -> list[TaskProgress]:
    """All tasks of one entry."""
    return [TaskProgress(*row) for row in _ROW.iter_unpack(data)]
