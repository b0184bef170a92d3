"""Reads the samples of a running record one after the other, and counts those it came too late for."""

from __future__ import annotations

from typing import Protocol

from tappet.runtime.operations.declaration import Reply, WireOperation
from tappet.runtime.operations.traces import TakeTrace
from tappet.runtime.trace_record import TraceFrames, TraceRecordStatus
from tappet.traces.samples import Batch, batch_of


class Caller(Protocol):
    """A connection to a runtime."""

    async def call(self, operation: WireOperation[Reply]) -> Reply:
        """The reply to an operation."""


class RecordReader:
    """What was read of a record so far."""

    def __init__(self, name: str, number: int, status: TraceRecordStatus, first: int) -> None:
        self._name = name
        self._number = number
        self._status = status
        self.next = first
        """Number of the sample to be read next."""
        self.lost = 0
        """Samples that were overwritten before they were read."""
        self._last_cycle: int | None = None

    async def read(self, client: Caller, until: int) -> list[Batch]:
        """Those up to number `until`."""
        batches = []
        while self.next < until:
            order = TakeTrace(self._name, self._number, self.next, until - self.next)
            batch = self.take(await client.call(order), until)
            if batch is None:
                break
            batches.append(batch)
        return batches

    def take(self, frames: TraceFrames, until: int) -> Batch | None:
        """Frames that were asked for from number `next` on; None where there are none."""
        self.lost += max(0, min(frames.first, until) - self.next)
        self.next = max(self.next, min(frames.first, until))
        if not frames.count:
            return None
        status = self._status
        batch = batch_of(frames.data, status.sources, status.frame_size, status.every, self._last_cycle)
        self._last_cycle = int(batch.cycle[-1])
        self.next = frames.first + frames.count
        return batch
