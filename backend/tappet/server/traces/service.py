"""Traces: download, state, snapshots and recordings, for the routes."""

from __future__ import annotations

import asyncio
from datetime import UTC, datetime, timedelta
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any

from tappet.project.trace import TraceData
from tappet.runtime.operations.tasks import ListTasks
from tappet.runtime.operations.traces import DownloadTrace, ListTraces, UploadTrace
from tappet.runtime.sampled import TraceSpec, TraceStatus
from tappet.runtime.trace_record import TraceRecordStatus
from tappet.server.database import Database
from tappet.server.problems import Problem
from tappet.server.runtimes.links import RuntimeLink
from tappet.server.traces.index import RecordingIndex
from tappet.server.traces.recorder import LongRecordings, record_infos
from tappet.server.traces.shapes import (
    Recording,
    RecordingInfo,
    RunningRecord,
    SampledChannel,
    TraceProblem,
    TraceState,
    TriggerState,
)
from tappet.server.traces.shown import Shown
from tappet.server.traces.store import RecordingStore, StoredRecording
from tappet.traces.recording import RecordInfo

if TYPE_CHECKING:
    from tappet.runtime.trace_compiler import TraceTask
    from tappet.server.traces.mirror import Mirrors, RecordMirror, TraceMirror


class Traces:
    """What the server knows of traces."""

    def __init__(
        self, folder: Path, quota_bytes: int, database: Database, keep: timedelta | None = None
    ) -> None:
        self.store = RecordingStore(folder, quota_bytes, RecordingIndex(database), keep)
        self.recordings = LongRecordings(self.store)

    @cached_property
    def mirrors(self) -> Mirrors:
        """Of the running traces; loaded, with numpy, when somebody looks at one."""
        from tappet.server.traces.mirror import Mirrors

        return Mirrors()

    async def close(self) -> None:
        """End what is being recorded."""
        await self.recordings.close()

    def state(self, link: RuntimeLink, status: TraceStatus) -> TraceState:
        """The state for clients."""
        long = self.recordings.of(link.id, status.name)
        lost = long.lost() if long is not None else [0] * len(status.records)
        recording = None if long is None else recording_info(self.store.get(long.id))
        return TraceState(
            name=status.name,
            application=status.application,
            data_digest=status.digest,
            running=any(record.state != "stopped" for record in status.records),
            downloaded_at=datetime.fromtimestamp(status.downloaded_ns / 1e9, UTC),
            downloaded_by=status.author,
            recording=recording,
            records=[_running(record, gone) for record, gone in zip(status.records, lost, strict=True)],
        )

    async def snapshot(self, mirror: TraceMirror, **fields: Any) -> StoredRecording:
        """Store what a trace holds now."""
        records = await mirror.records()
        status = mirror.status
        assert status is not None

        def work() -> StoredRecording:
            recording = self.store.create(records=record_infos(status), ended_at=datetime.now(UTC), **fields)
            for number, record in enumerate(records):
                recording.append(number, record.picture())
            self.store.flush(recording)
            return recording

        return await asyncio.to_thread(work)


async def running_traces(link: RuntimeLink) -> list[TraceStatus]:
    """All traces of a runtime; none without application."""
    async with link.client() as client:
        return await client.call(ListTraces())


def compiled(link: RuntimeLink, name: str, data: TraceData, tasks: list[TraceTask], author: str) -> TraceSpec:
    """What the runtime gets; raises a 422 problem that says what is wrong with the settings."""
    # The compiler of expressions is large, and few servers trace.
    from tappet.runtime.trace_compiler import TraceSettingsError, compile_trace

    symbols = link.loaded_symbols()
    code_id = link.info.code_id if link.info is not None else None
    try:
        return compile_trace(name, data, symbols, tasks, code_id or "", author)
    except TraceSettingsError as error:
        problems = [
            TraceProblem(record=p.record, channel=p.channel, field=p.field, message=p.message)
            for p in error.problems
        ]
        text = f"The trace '{name}' cannot be downloaded: {problems[0].message}."
        raise Problem(422, "trace-invalid", text, problems=problems) from error


async def tasks_of(link: RuntimeLink) -> list[TraceTask]:
    """The tasks of the loaded application."""
    async with link.client() as client:
        found = await client.call(ListTasks())
    from tappet.runtime.trace_compiler import TraceTask

    return [TraceTask(t.name, t.interval_ns if t.kind == "cyclic" else 0) for t in found]


async def download(link: RuntimeLink, spec: TraceSpec, *, start: bool) -> TraceStatus:
    """Give a trace to the runtime."""
    async with link.client() as client:
        return await client.call(DownloadTrace(spec, start))


async def settings_of(link: RuntimeLink, name: str) -> TraceData:
    """The settings that were downloaded with a trace; raises 404 and 409 problems."""
    async with link.client() as client:
        data = await client.call(UploadTrace(name))
    try:
        return TraceData.model_validate_json(data)
    except ValueError as error:
        text = f"The settings of the trace '{name}' are of another version."
        raise Problem(409, "trace-unreadable", text) from error


def _running(record: TraceRecordStatus, lost: int) -> RunningRecord:
    waits = record.state in ("waiting", "triggered", "done")
    percent = 0
    if record.trigger_sample is not None:
        percent = 100 if not record.after else round(100 * (record.after - record.remaining) / record.after)
    at = None if record.trigger_ns is None else str(record.trigger_ns)
    return RunningRecord(
        name=record.name,
        task=record.task,
        interval_ns=record.interval_ns,
        state=record.state,
        trigger=TriggerState(percent=percent, at_ns=at) if waits else None,
        samples=record.written,
        first=record.first,
        capacity=record.samples,
        lost=lost,
        channels=[SampledChannel(index=s.channel, name=s.name, type=s.type_name) for s in record.sources],
    )


def recording_info(recording: StoredRecording) -> RecordingInfo:
    """A recording for clients."""
    return RecordingInfo(**recording.row())


def recording_with_settings(recording: StoredRecording) -> Recording:
    """A recording with the settings of its trace."""
    return Recording(**recording.row(), data=TraceData.model_validate(recording.meta.settings))


def shown_mirror(record: RecordMirror) -> Shown:
    """The samples of a running record."""
    status = record.status
    info = RecordInfo(
        status.name, status.task, status.interval_ns, status.every, record.channels, status.trigger_ns
    )
    return Shown(record.samples(), info, record.first)


def shown_recording(recording: StoredRecording, record: int) -> Shown:
    """The samples of a stored record; raises a 404 problem."""
    if record >= len(recording.records):
        raise Problem(404, "not-found", f"The recording has no record number {record}.")
    samples = recording.records[record]
    return Shown(samples, recording.meta.records[record], samples.dropped, recording.lock)
