"""Who wants flow control of which objects, and the tables of the loaded code that record it.

Contract: what several clients want is recorded for all of them. A client that gives itself a name has to read
now and then, or what it wants is no longer recorded: a browser that is gone leaves no slower code behind.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Collection
from dataclasses import dataclass
from typing import TYPE_CHECKING

from tappet.runtime.debugger.shapes import FlowSnapshot
from tappet.runtime.debugger.variant import Variant
from tappet.runtime.errors import DebugError

if TYPE_CHECKING:
    from tappet.runtime.debugger.flow import Flow

LEASE_S = 10.0
"""Seconds for which a named client may be silent."""
MOST_HOLDERS = 100


@dataclass(slots=True)
class _Holder:
    objects: frozenset[str]
    heard: float


class FlowControl:
    """One a debugger, which serialises the calls."""

    def __init__(self, clock: Callable[[], float] = time.monotonic) -> None:
        self._clock = clock
        self._holders: dict[str, _Holder] = {}
        self._flow: Flow | None = None

    @property
    def objects(self) -> frozenset[str]:
        """All that are wanted."""
        return frozenset[str]().union(*(holder.objects for holder in self._holders.values()))

    @property
    def armed(self) -> Collection[int]:
        """Statements of the loaded code where the executive has to be called."""
        return self._flow.armed if self._flow is not None else ()

    def hold(self, holder: str, objects: Collection[str]) -> None:
        """What a client wants from now on; nothing with an empty list. `place` makes it true."""
        if not objects:
            self._holders.pop(holder, None)
            return
        if holder not in self._holders and len(self._holders) >= MOST_HOLDERS:
            raise DebugError(f"{MOST_HOLDERS} clients use flow control already")
        self._holders[holder] = _Holder(frozenset(objects), self._clock())

    def expired(self) -> bool:
        """Forget clients that are gone; whether there were any."""
        limit = self._clock() - LEASE_S
        gone = [name for name, holder in self._holders.items() if name and holder.heard < limit]
        for name in gone:
            del self._holders[name]
        return bool(gone)

    def place(self, variant: Variant) -> None:
        """Let the tasks record what is wanted in the loaded code."""
        self._flow, objects = None, self.objects
        if objects:
            from tappet.runtime.debugger.flow import Flow  # the parser, which few runtimes need

            self._flow = Flow(variant, objects)
        tables = self._flow.tables if self._flow is not None else [None] * len(variant.tasks)
        for task, table in zip(variant.tasks, tables, strict=True):
            address = table.address if table is not None else 0
            variant.application.tasks.publish(task.place("pFlow"), address, table)

    def dropped(self) -> None:
        """The code is another one."""
        self._flow = None

    def snapshot(self, object_id: str, holder: str) -> FlowSnapshot:
        """What a cycle has executed of an object."""
        found = self._holders.get(holder)
        if found is not None:
            found.heard = self._clock()
        if self._flow is None or object_id not in self.objects:
            raise DebugError("the object is not under flow control")
        return self._flow.snapshot(object_id)
