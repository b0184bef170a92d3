"""Stored recordings of traces."""

from __future__ import annotations

import tempfile
from datetime import timedelta
from typing import TYPE_CHECKING, Annotated

from fastapi import Depends, Path, Query, Request
from fastapi.responses import Response
from pydantic import AwareDatetime
from starlette.concurrency import run_in_threadpool

from tappet.project.trace import TraceData
from tappet.server.audit import Act
from tappet.server.audited import ActRecord, audited
from tappet.server.auth.roles import Role
from tappet.server.dependencies import ServicesDep, Viewer
from tappet.server.problems import Problem
from tappet.server.routing import Router
from tappet.server.spoken import LanguageDep, in_language
from tappet.server.traces.index import Wanted
from tappet.server.traces.sample_routes import (
    FILE_ANSWER,
    Format,
    RecordNumber,
    WithFormulas,
    add_sample_routes,
)
from tappet.server.traces.service import recording_info, recording_with_settings, shown_recording
from tappet.server.traces.shapes import (
    Recording,
    RecordingChange,
    RecordingInfo,
    RecordingList,
    Title,
)
from tappet.server.traces.shown import Shown
from tappet.server.traces.store import RecordingStore, StoredRecording

if TYPE_CHECKING:
    from tappet.traces.formats import TraceReader

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
    runtime_id: Annotated[str | None, Query(max_length=32)] = None,
    trace: Annotated[str | None, Query(max_length=200)] = None,
    start: Annotated[AwareDatetime | None, Query(alias="from", description="Sampled later, too.")] = None,
    end: Annotated[AwareDatetime | None, Query(alias="to", description="Sampled earlier, too.")] = None,
) -> RecordingList:
    """Stored recordings, newest first: all, or those of a project, of a runtime, of a trace, of a time."""
    store = services.traces.store
    wanted = Wanted(project_id, runtime_id, trace, start, end)
    found = [in_language(RecordingInfo(**row), language) for row in store.found(wanted)]
    keep_days = None if store.keep is None else store.keep / timedelta(days=1)
    return RecordingList(
        recordings=found, used_bytes=store.used(), quota_bytes=store.quota_bytes, keep_days=keep_days
    )


@router.post("", status_code=201, max_body_size=LARGEST_UPLOAD, openapi_extra=_UPLOAD)
async def load_trace(
    request: Request,
    act: Annotated[ActRecord, audited("trace-loaded", Role.ENGINEER)],
    services: ServicesDep,
    title: Annotated[Title, Query()] = "",
    project_id: Annotated[str | None, Query(max_length=32)] = None,
) -> RecordingInfo:
    """Store the samples of a trace file (Load Trace). What is none is the problem `trace-file-invalid`."""
    from tappet.traces.formats import TraceFileError, TraceReader

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
    from tappet.traces.formats import TraceFileError

    try:
        return TraceData.model_validate(reader.head.settings)
    except ValueError as error:
        raise TraceFileError("its settings are no settings of a trace") from error


def _line(text: str) -> str:
    """A name of a file as the database keeps it."""
    return text.replace("\0", "")[:200]


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
        title=_line(title), comment="", trace=_line(head.name), application=_line(head.application),
        runtime_id=None, runtime="", project_id=project_id, started_by=author,
        settings=data.model_dump(mode="json"), records=head.records,
    )  # fmt: skip
    try:
        for number in range(len(head.records)):
            for batch in reader.batches(number):
                recording.append(number, batch)
                store.flush(recording)
                store.check_room()
    except BaseException:
        store.delete(recording.meta.id)
        raise
    store.flush(recording)
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


async def shown_record(recording: RecordingDep, record: RecordNumber = 0) -> Shown:
    """The samples of a record of it."""
    return shown_recording(recording, record)


add_sample_routes(router, "/{recording_id}", "recording", shown_record)


@router.get("/{recording_id}/export", response_class=Response, responses=FILE_ANSWER)
async def export_recording(
    who: Viewer,
    recording: RecordingDep,
    record: RecordNumber = 0,
    form: Format = "trace",
    formulas: WithFormulas = True,
) -> Response:
    """A recording as a file: CSV or Parquet of one record, or a trace file (Save Trace)."""
    from tappet.server.traces import answers

    shown_recording(recording, record)
    records = [shown_recording(recording, number) for number in range(len(recording.records))]
    meta = recording.meta
    return await answers.export(
        meta.title, meta.application, meta.settings, records, record, form, formulas=formulas
    )
