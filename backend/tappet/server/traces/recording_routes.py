"""Stored recordings of traces."""

from __future__ import annotations

import tempfile
from typing import Annotated, Literal

from fastapi import Depends, Path, Query, Request
from fastapi.responses import Response
from starlette.concurrency import run_in_threadpool

from tappet.project.trace import TraceData
from tappet.server.audit import Act
from tappet.server.audited import ActRecord, audited
from tappet.server.auth.roles import Role
from tappet.server.dependencies import ServicesDep, Viewer
from tappet.server.problems import Problem
from tappet.server.routing import Router
from tappet.server.spoken import LanguageDep, in_language
from tappet.server.traces import answers
from tappet.server.traces.service import recording_info, recording_with_settings, shown_recording
from tappet.server.traces.shapes import (
    ChannelSpectrum,
    ChannelStatistics,
    ExportFormat,
    Recording,
    RecordingChange,
    RecordingInfo,
    RecordingList,
    Title,
)
from tappet.server.traces.store import RecordingStore, StoredRecording
from tappet.traces.formats import TraceFileError, TraceReader

router = Router(prefix="/recordings", tags=["traces"])
LARGEST_UPLOAD = 2 << 30
"""Bytes of a trace file."""
_IN_MEMORY = 8 << 20
_UPLOAD = {
    "requestBody": {
        "required": True,
        "content": {"application/octet-stream": {"schema": {"type": "string", "format": "binary"}}},
    }
}
RecordingId = Annotated[str, Path(pattern="^[0-9a-f]{32}$")]


async def recording_of(recording_id: RecordingId, services: ServicesDep) -> StoredRecording:
    """The recording that the path names; raises a 404 problem."""
    return await run_in_threadpool(services.traces.store.get, recording_id)


RecordingDep = Annotated[StoredRecording, Depends(recording_of)]


@router.get("")
def list_recordings(
    who: Viewer,
    services: ServicesDep,
    language: LanguageDep,
    project_id: Annotated[str | None, Query(max_length=32)] = None,
    trace: Annotated[str | None, Query(max_length=200)] = None,
) -> RecordingList:
    """Stored recordings, newest first: all, those of a project, or those of a trace."""
    store = services.traces.store
    found = [
        in_language(recording_info(one), language)
        for one in store.all()
        if (project_id is None or one.meta.project_id == project_id)
        and (trace is None or one.meta.trace.upper() == trace.upper())
    ]
    return RecordingList(recordings=found, used_bytes=store.used(), quota_bytes=store.quota_bytes)


@router.post("", status_code=201, max_body_size=LARGEST_UPLOAD, openapi_extra=_UPLOAD)
async def load_trace(
    request: Request,
    act: Annotated[ActRecord, audited("trace-loaded", Role.ENGINEER)],
    services: ServicesDep,
    title: Annotated[Title, Query()] = "",
    project_id: Annotated[str | None, Query(max_length=32)] = None,
) -> RecordingInfo:
    """Store the samples of a trace file (Load Trace). What is none is the problem `trace-file-invalid`."""
    with tempfile.SpooledTemporaryFile(_IN_MEMORY) as file:
        size = 0
        async for part in request.stream():
            size += len(part)
            if size > LARGEST_UPLOAD:
                raise Problem(413, "too-large", f"A trace file has at most {LARGEST_UPLOAD >> 20} MiB.")
            await run_in_threadpool(file.write, part)
        try:
            reader = await run_in_threadpool(TraceReader, file)
            data = _settings(reader)
            name = title or reader.head.name
            await act.begin_async(Act("trace-loaded", name, project_id=project_id))
            author = act.who.username
            stored = await run_in_threadpool(
                _store, services.traces.store, reader, data, name, project_id, author
            )
        except TraceFileError as error:
            raise Problem(422, "trace-file-invalid", f"The file was not read: {error}.") from error
    return recording_info(stored)


def _settings(reader: TraceReader) -> TraceData:
    try:
        return TraceData.model_validate(reader.head.settings)
    except ValueError as error:
        raise TraceFileError("its settings are no settings of a trace") from error


def _store(
    store: RecordingStore,
    reader: TraceReader,
    data: TraceData,
    title: str,
    project_id: str | None,
    author: str,
) -> StoredRecording:
    """The samples as a new recording; none where the file is damaged."""
    head = reader.head
    recording = store.create(
        title=title[:200], comment="", trace=head.name[:200], application=head.application[:200],
        runtime_id=None, runtime="", project_id=project_id, started_by=author,
        settings=data.model_dump(mode="json"), records=head.records,
    )  # fmt: skip
    try:
        for number in range(len(head.records)):
            for batch in reader.batches(number):
                recording.append(number, batch)
                store.check_room()
    except BaseException:
        store.delete(recording.meta.id)
        raise
    recording.flush()
    return recording


@router.get("/{recording_id}")
def get_recording(who: Viewer, recording: RecordingDep, language: LanguageDep) -> Recording:
    """A recording with the settings of its trace."""
    return in_language(recording_with_settings(recording), language)


@router.patch("/{recording_id}")
def change_recording(
    recording_id: RecordingId,
    body: RecordingChange,
    act: Annotated[ActRecord, audited("recording-changed", Role.ENGINEER)],
    services: ServicesDep,
) -> RecordingInfo:
    """Give a recording another title or comment."""
    store = services.traces.store
    meta = store.get(recording_id).meta
    act.begin(Act("recording-changed", meta.title, meta.title, body.title, meta.project_id))
    return recording_info(store.change(recording_id, **body.model_dump(exclude_none=True)))


@router.delete("/{recording_id}", status_code=204)
def delete_recording(
    recording_id: RecordingId,
    act: Annotated[ActRecord, audited("recording-deleted", Role.ENGINEER)],
    services: ServicesDep,
) -> None:
    """Delete a recording with its samples."""
    meta = services.traces.store.get(recording_id).meta
    act.begin(Act("recording-deleted", meta.title, project_id=meta.project_id))
    services.traces.store.delete(recording_id)


@router.get("/{recording_id}/window", response_class=Response, responses=answers.BINARY_ANSWER)
async def get_recording_window(
    who: Viewer,
    recording: RecordingDep,
    record: answers.RecordNumber = 0,
    start: answers.Start = None,
    end: answers.End = None,
    width: answers.Width = 1000,
    channels: answers.Chosen = None,
) -> Response:
    """Samples of a time, or the least and largest values where they are many."""
    return await answers.window(shown_recording(recording, record), start, end, width, channels)


@router.get("/{recording_id}/samples", response_class=Response, responses=answers.BINARY_ANSWER)
async def get_recording_samples(
    who: Viewer,
    recording: RecordingDep,
    record: answers.RecordNumber = 0,
    first: answers.First = 0,
    count: answers.Count = 10_000,
) -> Response:
    """Samples by number."""
    return await answers.samples(shown_recording(recording, record), first, count)


@router.get("/{recording_id}/statistics")
async def get_recording_statistics(
    who: Viewer,
    recording: RecordingDep,
    channel: answers.ChannelNumber,
    record: answers.RecordNumber = 0,
    start: answers.Start = None,
    end: answers.End = None,
) -> ChannelStatistics:
    """Least, largest and mean values."""
    return await answers.statistics(shown_recording(recording, record), channel, start, end)


@router.get("/{recording_id}/spectrum")
async def get_recording_spectrum(
    who: Viewer,
    recording: RecordingDep,
    channel: answers.ChannelNumber,
    record: answers.RecordNumber = 0,
    start: answers.Start = None,
    end: answers.End = None,
    window: answers.Smoothing = "hann",
) -> ChannelSpectrum:
    """Amplitudes of the sines that a span consists of."""
    return await answers.spectrum(shown_recording(recording, record), channel, start, end, window)


@router.get("/{recording_id}/derived", response_class=Response, responses=answers.BINARY_ANSWER)
async def get_recording_derived(
    who: Viewer,
    recording: RecordingDep,
    channel: answers.ChannelNumber,
    operation: Literal["derivative", "integral"],
    record: answers.RecordNumber = 0,
    start: answers.Start = None,
    end: answers.End = None,
    width: answers.Width = 1000,
) -> Response:
    """The derivative or the integral of a channel."""
    return await answers.derived(shown_recording(recording, record), channel, operation, start, end, width)


@router.get("/{recording_id}/export", response_class=Response, responses=answers.FILE_ANSWER)
async def export_recording(
    who: Viewer,
    recording: RecordingDep,
    record: answers.RecordNumber = 0,
    form: Annotated[ExportFormat, Query(alias="format")] = "trace",
) -> Response:
    """A recording as a file: CSV or Parquet of one record, or a trace file (Save Trace)."""
    shown_recording(recording, record)
    records = [shown_recording(recording, number) for number in range(len(recording.records))]
    meta = recording.meta
    return await answers.export(meta.title, meta.application, meta.settings, records, record, form)
