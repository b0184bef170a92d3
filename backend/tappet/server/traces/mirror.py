"""The picture of a running trace at the server: read from the runtime once for all who look at it."""

from __future__ import annotations

import asyncio
import time

from tappet.runtime.operations.traces import ListTraces
from tappet.runtime.sampled import TraceStatus
from tappet.runtime.trace_record import TraceRecordStatus
from tappet.server.problems import Problem
from tappet.server.runtimes.links import RuntimeLink
from tappet.server.runtimes.plc_client import PlcClient
from tappet.traces.reader import RecordReader
from tappet.traces.recording import channels_of
from tappet.traces.samples import Batch, BatchSamples, empty_batch, joined

FRESH_S = 0.05
"""What was read so short a time ago is given to the next one who asks."""
FORGOTTEN_S = 120.0
"""A mirror that nobody looks at is dropped."""


def no_trace(name: str) -> Problem:
    """A 404 problem."""
    return Problem(404, "not-found", f"No trace '{name}' runs in the controller; download it.")


class RecordMirror:
    """What the ring of a record shows."""

    def __init__(self, name: str, number: int, status: TraceRecordStatus) -> None:
        self.status = status
        self.channels = channels_of(status.sources)
        self._reader = RecordReader(name, number, status, status.first)
        self._batches: list[Batch] = []
        self._kept = 0

    async def update(self, client: PlcClient, status: TraceRecordStatus) -> None:
        """Read what is new."""
        self.status = status
        if status.first > self._reader.next:  # more has passed than the picture holds
            self._reader.next = status.first
            self._batches, self._kept = [], 0
        fresh = await self._reader.read(client, status.written)
        self._batches += fresh
        self._kept += sum(len(batch) for batch in fresh)
        if self._kept > 2 * status.samples and len(self._batches) > 1:
            self._batches = [self.picture()]
            self._kept = len(self._batches[0])

    def picture(self) -> Batch:
        """The samples that belong to it."""
        wanted = max(0, self._reader.next - self.status.first)
        if not self._batches:
            return empty_batch(self.channels)
        whole = joined(self._batches) if len(self._batches) > 1 else self._batches[0]
        return whole.part(max(0, len(whole) - wanted), len(whole))

    @property
    def first(self) -> int:
        """Number of the first sample of `samples`."""
        return self._reader.next - min(self._kept, max(0, self._reader.next - self.status.first))

    def samples(self) -> BatchSamples:
        """As they were read last."""
        return BatchSamples(self.channels, self.picture())


class TraceMirror:
    """One running trace."""

    def __init__(self, link: RuntimeLink, name: str) -> None:
        self._link = link
        self._name = name
        self._lock = asyncio.Lock()
        self._read_at = 0.0
        self.asked_at = time.monotonic()
        self.status: TraceStatus | None = None
        self._records: list[RecordMirror] = []

    async def record(self, number: int) -> RecordMirror:
        """A record as it is now; raises 404 problems."""
        await self.refresh()
        if not 0 <= number < len(self._records):
            raise Problem(404, "not-found", f"The trace '{self._name}' has no record number {number}.")
        return self._records[number]

    async def records(self) -> list[RecordMirror]:
        """All of them, as they are now."""
        await self.refresh()
        return self._records

    def expire(self) -> None:
        """Something was changed: what was read is old."""
        self._read_at = 0.0

    async def refresh(self) -> TraceStatus:
        """Read what is new, unless somebody just did."""
        self.asked_at = time.monotonic()
        async with self._lock:
            if self.status is not None and time.monotonic() - self._read_at < FRESH_S:
                return self.status
            async with self._link.client() as client:
                traces = await client.call(ListTraces())
                found = next((t for t in traces if t.name.upper() == self._name.upper()), None)
                if found is None:
                    self.status = None
                    raise no_trace(self._name)
                if self.status is None or found.downloaded_ns != self.status.downloaded_ns:
                    self._records = [
                        RecordMirror(found.name, number, record)
                        for number, record in enumerate(found.records)
                    ]
                for mirror, record in zip(self._records, found.records, strict=True):
                    await mirror.update(client, record)
            self.status = found
            self._read_at = time.monotonic()
            return found


class Mirrors:
    """The mirrors of all runtimes."""

    def __init__(self) -> None:
        self._mirrors: dict[tuple[str, str], TraceMirror] = {}

    def of(self, link: RuntimeLink, name: str) -> TraceMirror:
        """The one of a trace, made at first use."""
        now = time.monotonic()
        self._mirrors = {k: m for k, m in self._mirrors.items() if now - m.asked_at < FORGOTTEN_S}
        key = (link.id, name.upper())
        if key not in self._mirrors:
            self._mirrors[key] = TraceMirror(link, name)
        return self._mirrors[key]
