"""Opens recordings in place of runtimes, and replays them."""

from __future__ import annotations

from contextlib import suppress
from datetime import UTC, datetime

from starlette.concurrency import run_in_threadpool

from tappet.codegen.package import CodePackage
from tappet.project.errors import UnknownObjectError
from tappet.project.kinds.flight_recording import FlightRecordingData
from tappet.project.model import APPLICATION
from tappet.project.store import Store
from tappet.runtime.flight_recording import FlightRecording, RecordingError, read_recording
from tappet.runtime.operations.reports import exception_of
from tappet.runtime.replay_process import ReplayOrder
from tappet.server.builds.builder import Application, Built
from tappet.server.builds.commissioning import Commissioning
from tappet.server.builds.shapes import Relation
from tappet.server.flight.recorded_plc import RecordedApplication, RecordedPlc
from tappet.server.flight.recording_shapes import (
    DifferentValue,
    OpenedRecording,
    RecordingFacts,
    ReplayReport,
)
from tappet.server.flight.replay_process import run_replay
from tappet.server.problems import Problem, not_found
from tappet.server.runtimes.links import RuntimeRegistry


def text_of(store: Store, project_id: str, object_id: str) -> str:
    """The file of a recording in a project. Blocks; raises a 404 problem for another object."""
    item = store.get(project_id, object_id)
    if not isinstance(item.data, FlightRecordingData):
        raise not_found("recording", object_id)
    return item.data.recording


def read(text: str) -> FlightRecording:
    """The recording in a file. Blocks; raises a 422 problem that says what is wrong with it."""
    try:
        return read_recording(text)
    except RecordingError as error:
        raise Problem(422, "recording", f"{_sentence(error)}.") from error


def facts(text: str) -> RecordingFacts:
    """What a file holds. Blocks."""
    recording = read(text)
    first, last = recording.cycles[0], recording.cycles[-1]
    return RecordingFacts(
        application=recording.application,
        project=recording.project,
        code_id=recording.code_id,
        saved_at=_time(recording.saved_ns),
        size=len(text),
        cycles=len(recording.cycles),
        first_cycle=first.cycle,
        first_timestamp=_time(first.timestamp_ns),
        last_cycle=last.cycle,
        last_timestamp=_time(last.timestamp_ns),
        writes=len(recording.writes),
        exception=exception_of(recording.exception),
    )


def add(store: Store, project_id: str, application_id: str, name: str, text: str, username: str) -> str:
    """Keeps a file as an object of an application; returns its id. Blocks; raises problems."""
    read(text)
    if store.get(project_id, application_id).kind != APPLICATION:
        raise not_found("application", application_id)
    data = FlightRecordingData(recording=text).model_dump(mode="json")
    item = store.add(project_id, username, application_id, "flight_recording", name, data=data)
    return item.id


async def open_recording(
    store: Store, runtimes: RuntimeRegistry, commissioning: Commissioning, project_id: str, object_id: str
) -> OpenedRecording:
    """Makes a recording a runtime that can be looked at; the same one as long as it is not changed."""
    item = await run_in_threadpool(store.get, project_id, object_id)
    text = await run_in_threadpool(text_of, store, project_id, object_id)
    recording = await run_in_threadpool(read, text)
    link = await runtimes.open_recording(
        f"recording-{object_id}-{item.revision}",
        item.name,
        lambda: RecordedPlc(RecordedApplication(recording, _code(recording))),
    )
    relation = Relation.DOWNLOAD
    with suppress(Problem):
        built = await _built_on(store, commissioning, project_id, object_id, recording)
        relation = _relation(recording, built)
    return OpenedRecording(runtime=link.state(), relation=relation)


def _code(recording: FlightRecording) -> CodePackage:
    try:
        return recording.code()
    except RecordingError as error:
        raise Problem(422, "recording", f"{_sentence(error)}.") from error


def _relation(recording: FlightRecording, built: Built) -> Relation:
    if built.report.code_id == recording.code_id:
        return Relation.SAME
    return Relation.ONLINE_CHANGE if built.change_base == recording.code_id else Relation.DOWNLOAD


async def _built_on(
    store: Store, commissioning: Commissioning, project_id: str, object_id: str, recording: FlightRecording
) -> Built:
    """The present program of the application of a recording, built on top of the recorded one."""

    def application() -> Application:
        project = store.load(project_id)
        above = next((one for one in project.ancestors(object_id) if one.kind == APPLICATION), None)
        if above is None:
            raise UnknownObjectError("The recording belongs to no application")
        return Application.of(project_id, project, above.id)

    chosen = await run_in_threadpool(application)
    return await commissioning.builder.build(chosen, (recording.code_id, recording.package))


async def replay(
    store: Store, commissioning: Commissioning, project_id: str, object_id: str, *, today: bool
) -> ReplayReport:
    """Replays a recording, on the recorded or on the present program."""
    text = await run_in_threadpool(text_of, store, project_id, object_id)
    recording = await run_in_threadpool(read, text)
    code = None
    if today:
        built = await _built_on(store, commissioning, project_id, object_id, recording)
        if built.package is None:
            raise Problem(
                409, "build-errors", "The present program has errors; nothing can be replayed on it."
            )
        code = built.package
    result = await run_replay(ReplayOrder(text, code))
    difference = result.difference
    good = result.fault is None if today else result.same_fault and difference is None
    return ReplayReport(
        ok=good and result.problem is None,
        today=today,
        problem=result.problem,
        cycles=result.cycles,
        last_cycle=result.last_cycle,
        recorded=exception_of(result.recorded),
        fault=exception_of(result.fault),
        same_fault=result.same_fault,
        first_difference=difference.cycle if difference else None,
        variables=[DifferentValue.of(row) for row in difference.variables] if difference else [],
        notes=result.notes,
    )


def _time(timestamp_ns: int) -> datetime:
    return datetime.fromtimestamp(timestamp_ns / 1e9, UTC)


def _sentence(error: Exception) -> str:
    text = str(error)
    return text[:1].upper() + text[1:]
