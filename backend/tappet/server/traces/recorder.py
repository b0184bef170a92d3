"""Long-term recording: reads the rings of a running trace without loss and writes them to a recording."""

from __future__ import annotations

import asyncio
import logging
import time
from datetime import UTC, datetime

from msgspec.structs import replace

from tappet.runtime.client import RuntimeRefused
from tappet.runtime.operations.traces import ListTraces
from tappet.runtime.sampled import TraceStatus
from tappet.server.problems import Problem
from tappet.server.runtimes.links import RuntimeLink
from tappet.server.traces.store import RecordingStore, StoredRecording
from tappet.traces.recording import RecordInfo, channels_of

log = logging.getLogger(__name__)
READ_S = 0.5
"""Between two readings; the rings hold 20 s more than they show."""
FLUSH_S = 2.0
"""What a killed server loses at the most."""
QUOTA_S = 10.0
PATIENCE_S = 60.0
"""How long a lost connection is waited for."""


def record_infos(status: TraceStatus) -> list[RecordInfo]:
    """What a recording knows of the records of a trace."""
    return [
        RecordInfo(r.name, r.task, r.interval_ns, r.every, channels_of(r.sources), r.trigger_ns)
        for r in status.records
    ]


class LongRecording:
    """One recording that is being made."""

    def __init__(
        self, store: RecordingStore, link: RuntimeLink, status: TraceStatus, recording: StoredRecording,
        seconds: int | None,
    ) -> None:  # fmt: skip
        from tappet.traces.reader import RecordReader

        self._store = store
        self._link = link
        self._name = status.name
        self._downloaded_ns = status.downloaded_ns
        self.id = recording.meta.id
        self._recording = recording
        self._readers = [
            RecordReader(status.name, number, record, record.written)
            for number, record in enumerate(status.records)
        ]
        self._end = None if seconds is None else time.monotonic() + seconds
        self._ending = asyncio.Event()
        self._task = asyncio.create_task(self._record(), name=f"recording {self._name}")

    @property
    def ended(self) -> bool:
        """Whether nothing is read any more."""
        return self._task.done()

    def lost(self) -> list[int]:
        """Samples of each record that were overwritten before they were read."""
        return [reader.lost for reader in self._readers]

    async def end(self) -> None:
        """Read what is there, then end."""
        self._ending.set()
        await asyncio.wait([self._task])

    async def abandon(self) -> None:
        """The server ends."""
        await self.end()

    async def _record(self) -> None:
        problem: str | None = None
        try:
            problem = await self._run()
        except Exception:
            log.exception("recording %s failed", self._name)
            problem = "The recording failed; the log of the server says why."
        state = "complete" if problem is None else "interrupted"
        await asyncio.to_thread(self._store.flush, self._recording)
        lost = sum(self.lost())
        await asyncio.to_thread(
            self._store.change, self.id, state=state, problem=problem, ended_at=datetime.now(UTC), lost=lost
        )

    async def _run(self) -> str | None:
        """Reads until it is ended; why it ended early."""
        reached = flushed = checked = time.monotonic()
        while True:
            last = self._ending.is_set() or (self._end is not None and time.monotonic() >= self._end)
            try:
                gone = await self._read()
                reached = time.monotonic()
            except (Problem, OSError, TimeoutError, RuntimeRefused):
                if time.monotonic() - reached > PATIENCE_S or last:
                    return "The connection to the controller was lost."
                gone = False
            if gone:
                return "The trace was ended, or downloaded again."
            if last:
                return None
            now = time.monotonic()
            if now - flushed > FLUSH_S:
                await asyncio.to_thread(self._store.flush, self._recording)
                flushed = now
            if now - checked > QUOTA_S:
                checked = now
                try:
                    await asyncio.to_thread(self._store.check_room)
                except Problem as error:
                    return error.detail
            wait = READ_S if self._end is None else max(0.0, min(READ_S, self._end - now))
            try:
                await asyncio.wait_for(self._ending.wait(), wait)
            except TimeoutError:
                continue

    async def _read(self) -> bool:
        """Take what is new; whether the trace is gone."""
        async with self._link.client() as client:
            traces = await client.call(ListTraces())
            status = next((t for t in traces if t.name == self._name), None)
            if status is None or status.downloaded_ns != self._downloaded_ns:
                return True
            for number, (reader, record) in enumerate(zip(self._readers, status.records, strict=True)):
                for batch in await reader.read(client, record.written):
                    await asyncio.to_thread(self._recording.append, number, batch)
            triggers = [record.trigger_ns for record in status.records]
        known = self._recording.meta.records
        if triggers != [record.trigger_ns for record in known]:
            changed = [replace(k, trigger_ns=t) for k, t in zip(known, triggers, strict=True)]
            await asyncio.to_thread(self._store.change, self.id, records=changed)
        return False


class LongRecordings:
    """All that are being made, one a trace at the most."""

    def __init__(self, store: RecordingStore) -> None:
        self._store = store
        self._running: dict[tuple[str, str], LongRecording] = {}

    def of(self, link_id: str, name: str) -> LongRecording | None:
        """The one of a trace."""
        found = self._running.get((link_id, name.upper()))
        if found is not None and found.ended:
            del self._running[link_id, name.upper()]
            return None
        return found

    def begin(
        self, link: RuntimeLink, status: TraceStatus, recording: StoredRecording, seconds: int | None
    ) -> LongRecording:
        """Record from now on; raises a 409 problem when that is being done."""
        if self.of(link.id, status.name) is not None:
            raise Problem(409, "still-recording", f"The trace '{status.name}' is being recorded already.")
        made = LongRecording(self._store, link, status, recording, seconds)
        self._running[link.id, status.name.upper()] = made
        return made

    async def close(self) -> None:
        """End all of them."""
        for recording in self._running.values():
            await recording.abandon()
