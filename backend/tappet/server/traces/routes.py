"""Traces that run in a controller."""

from __future__ import annotations

from typing import Annotated, Any

from fastapi import Path, Query
from fastapi.responses import Response
from msgspec import structs
from starlette.concurrency import run_in_threadpool

from tappet.project.naming import MAX_NAME
from tappet.project.trace import axis_channels
from tappet.runtime.operations.traces import CommandTrace, RemoveTrace
from tappet.runtime.trace_record import Command
from tappet.server.audit import Act
from tappet.server.audited import ActRecord, audited
from tappet.server.auth.roles import Role
from tappet.server.dependencies import LinkDep, ServicesDep, Viewer
from tappet.server.problems import Problem
from tappet.server.routing import Router
from tappet.server.runtimes.links import RuntimeLink
from tappet.server.services import Services
from tappet.server.traces.recorder import record_infos
from tappet.server.traces.sample_routes import (
    FILE_ANSWER,
    Format,
    RecordNumber,
    WithFormulas,
    add_sample_routes,
)
from tappet.server.traces.service import (
    compiled,
    download,
    recording_info,
    running_traces,
    settings_of,
    shown_mirror,
    tasks_of,
)
from tappet.server.traces.shapes import (
    AxisTemplate,
    RecordingInfo,
    RecordingOrder,
    SnapshotOrder,
    TraceDigest,
    TraceDownload,
    TraceSettings,
    TraceSettingsOrder,
    TraceState,
)
from tappet.server.traces.shown import Shown
from tappet.server.traces.store import RecordingOrigin

router = Router(prefix="/runtimes/{runtime_id}/traces", tags=["traces"])
settings_router = Router(prefix="/traces", tags=["traces"])
Name = Annotated[str, Path(min_length=1, max_length=MAX_NAME)]
AxisName = Annotated[str, Query(pattern="^[A-Za-z_][A-Za-z0-9_]*$", max_length=MAX_NAME)]


@settings_router.post("/digest")
async def digest_trace(body: TraceSettingsOrder, who: Viewer) -> TraceDigest:
    """What a running trace must have as `data_digest`; otherwise it has to be downloaded (trace EX-07)."""
    return TraceDigest(digest=body.data.digest())


@settings_router.get("/axis-template")
async def get_axis_trace(axis: AxisName, who: Viewer) -> AxisTemplate:
    """The channels of the device trace of an axis."""
    return AxisTemplate(channels=list(axis_channels(axis)))


@router.get("")
async def list_traces(who: Viewer, link: LinkDep, services: ServicesDep) -> list[TraceState]:
    """The traces that run in the controller, whoever has downloaded them (Online List)."""
    return [services.traces.state(link, status) for status in await running_traces(link)]


@router.put("/{name}")
async def download_trace(
    name: Name,
    body: TraceDownload,
    act: Annotated[ActRecord, audited("trace-download", Role.OPERATOR)],
    link: LinkDep,
    services: ServicesDep,
) -> TraceState:
    """Download a trace, in place of one of its name, and start it (TRC-70).

    Settings that cannot be are the problem `trace-invalid` with `problems`: record, channel, field, message.
    """
    spec = compiled(link, name, body.data, await tasks_of(link), act.who.username)
    await act.begin_async(Act("trace-download", name, project_id=body.project_id, runtime_id=link.id))
    status = await download(link, spec, start=body.start)
    services.traces.mirrors.of(link, name).expire()
    return services.traces.state(link, status)


@router.delete("/{name}", status_code=204)
async def remove_trace(
    name: Name,
    act: Annotated[ActRecord, audited("trace-removed", Role.OPERATOR, always=True)],
    link: LinkDep,
    services: ServicesDep,
) -> None:
    """End a trace; its samples are gone."""
    await act.begin_async(Act("trace-removed", name, runtime_id=link.id))
    async with link.client() as client:
        await client.call(RemoveTrace(name))
    services.traces.mirrors.of(link, name).expire()


@router.get("/{name}")
async def get_trace(name: Name, who: Viewer, link: LinkDep, services: ServicesDep) -> TraceState:
    """The state of a trace; it is gone after a download or an online change of the application."""
    return services.traces.state(link, await services.traces.mirrors.of(link, name).refresh())


@router.get("/{name}/configuration")
async def upload_trace(name: Name, who: Viewer, link: LinkDep) -> TraceSettings:
    """The settings that were downloaded with a trace (Upload Trace)."""
    return TraceSettings(data=await settings_of(link, name))


async def _commanded(
    act: ActRecord, link: RuntimeLink, services: Services, name: str, command: Command
) -> TraceState:
    await act.begin_async(Act(f"trace-{command}", name, runtime_id=link.id))
    async with link.client() as client:
        status = await client.call(CommandTrace(name, command))
    services.traces.mirrors.of(link, name).expire()
    return services.traces.state(link, status)


@router.post("/{name}/start")
async def start_trace(
    name: Name,
    act: Annotated[ActRecord, audited("trace-start", Role.OPERATOR)],
    link: LinkDep,
    services: ServicesDep,
) -> TraceState:
    """Record again (TRC-74)."""
    return await _commanded(act, link, services, name, "start")


@router.post("/{name}/stop")
async def stop_trace(
    name: Name,
    act: Annotated[ActRecord, audited("trace-stop", Role.OPERATOR, always=True)],
    link: LinkDep,
    services: ServicesDep,
) -> TraceState:
    """Record nothing more; what is recorded stays."""
    return await _commanded(act, link, services, name, "stop")


@router.post("/{name}/reset-trigger")
async def reset_trigger(
    name: Name,
    act: Annotated[ActRecord, audited("trace-rearm", Role.OPERATOR)],
    link: LinkDep,
    services: ServicesDep,
) -> TraceState:
    """Arm the trigger again."""
    return await _commanded(act, link, services, name, "rearm")


async def shown_trace(name: Name, link: LinkDep, services: ServicesDep, record: RecordNumber = 0) -> Shown:
    """The samples that the ring of a record holds now."""
    return shown_mirror(await services.traces.mirrors.of(link, name).record(record))


add_sample_routes(router, "/{name}", "trace", shown_trace)


@router.get("/{name}/export", response_class=Response, responses=FILE_ANSWER)
async def export_trace(
    name: Name,
    who: Viewer,
    link: LinkDep,
    services: ServicesDep,
    record: RecordNumber = 0,
    form: Format = "trace",
    formulas: WithFormulas = True,
) -> Response:
    """What a trace holds, as a file: CSV or Parquet of one record, or a trace file (Save Trace)."""
    from tappet.server.traces import answers

    mirror = services.traces.mirrors.of(link, name)
    await mirror.record(record)
    status = mirror.status
    assert status is not None
    settings: dict[str, Any] = (await settings_of(link, name)).model_dump(mode="json")
    shown = [shown_mirror(one) for one in await mirror.records()]
    return await answers.export(
        status.name, status.application, settings, shown, record, form, formulas=formulas
    )


@router.post("/{name}/snapshot", status_code=201)
async def store_trace(
    name: Name,
    body: SnapshotOrder,
    act: Annotated[ActRecord, audited("trace-stored", Role.OPERATOR)],
    link: LinkDep,
    services: ServicesDep,
) -> RecordingInfo:
    """Store what a trace holds now as a recording."""
    mirror = services.traces.mirrors.of(link, name)
    fields = await _recording_fields(link, services, name, body, act.who.username)
    await act.begin_async(Act("trace-stored", name, None, body.title, body.project_id, link.id))
    return recording_info(await services.traces.snapshot(mirror, **fields))


async def _recording_fields(
    link: RuntimeLink, services: Services, name: str, order: SnapshotOrder, author: str
) -> dict[str, Any]:
    """What is known of a recording before its samples."""
    status = await services.traces.mirrors.of(link, name).refresh()
    settings = await settings_of(link, name)
    origin = RecordingOrigin(
        title=order.title or status.name,
        comment="",
        trace=status.name,
        application=status.application,
        runtime_id=link.id,
        runtime=link.name,
        project_id=order.project_id,
        started_by=author,
        settings=settings.model_dump(mode="json"),
    )
    return structs.asdict(origin)


@router.post("/{name}/recording", status_code=201)
async def begin_recording(
    name: Name,
    body: RecordingOrder,
    act: Annotated[ActRecord, audited("trace-recording", Role.OPERATOR)],
    link: LinkDep,
    services: ServicesDep,
) -> RecordingInfo:
    """Record every sample from now on, until it is ended, `seconds` have passed or the trace ends."""
    traces = services.traces
    limits = {
        "keep_bytes": None if body.keep_mib is None else body.keep_mib << 20,
        "keep_seconds": body.keep_seconds,
    }
    fields = await _recording_fields(link, services, name, body, act.who.username) | limits
    if traces.recordings.of(link.id, name) is not None:
        raise Problem(409, "still-recording", f"The trace '{name}' is being recorded already.")
    await act.begin_async(Act("trace-recording", name, None, body.title, body.project_id, link.id))
    status = await traces.mirrors.of(link, name).refresh()
    records = record_infos(status)
    recording = await run_in_threadpool(traces.store.create, records=records, state="recording", **fields)
    traces.recordings.begin(link, status, recording, body.seconds)
    return recording_info(recording)


@router.delete("/{name}/recording")
async def end_recording(
    name: Name,
    act: Annotated[ActRecord, audited("trace-recording-ended", Role.OPERATOR, always=True)],
    link: LinkDep,
    services: ServicesDep,
) -> RecordingInfo:
    """End the long-term recording of a trace; it stays stored."""
    found = services.traces.recordings.of(link.id, name)
    if found is None:
        raise Problem(404, "not-found", f"The trace '{name}' is not being recorded.")
    await act.begin_async(Act("trace-recording-ended", name, runtime_id=link.id))
    await found.end()
    return recording_info(services.traces.store.get(found.id))
