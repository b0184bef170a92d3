"""What came from outside into the variables of an application, and in which cycle: for a replay."""

from __future__ import annotations

from collections import deque
from collections.abc import Sequence
from dataclasses import dataclass

from tappet.runtime.forces import PlacedValue, ValueList

MOST_BATCHES = 4096
MOST_VALUES = 100_000
"""What is remembered; older writes are older than what a flight recorder keeps, in practice."""


@dataclass(frozen=True, slots=True)
class Write:
    """Values that were written together. `task` is the number of the task in whose cycles they count; None:
    the bus cycle task."""

    task: int | None
    batch: ValueList
    values: tuple[PlacedValue, ...]


@dataclass(frozen=True, slots=True)
class Forcing:
    """All forces from this cycle of the bus cycle task on."""

    cycle: int
    values: tuple[PlacedValue, ...]


class OutsideValues:
    """The last writes, and the forces over time."""

    def __init__(self) -> None:
        self.writes: deque[Write] = deque()
        self.forcings: deque[Forcing] = deque(maxlen=MOST_BATCHES)
        self._values = 0

    def wrote(self, task: int | None, batch: ValueList, values: Sequence[PlacedValue]) -> None:
        """A batch was stored, or waits for a cycle of its task."""
        self.writes.append(Write(task, batch, tuple(values)))
        self._values += len(values)
        while len(self.writes) > MOST_BATCHES or self._values > MOST_VALUES:
            self._values -= len(self.writes.popleft().values)

    def forced(self, cycle: int, values: Sequence[PlacedValue]) -> None:
        """The table of forces is another one."""
        self.forcings.append(Forcing(cycle, tuple(values)))

    def clear(self) -> None:
        """Places stand for other variables now."""
        self.writes.clear()
        self._values = 0
        self.forcings.clear()
