"""Recordings of the flight recorder: from a runtime or a file into a project, to look at and to replay."""

from __future__ import annotations

from typing import Annotated, Any

from fastapi import Query, UploadFile
from starlette.concurrency import run_in_threadpool
from starlette.responses import Response

from tappet.runtime.flight_recording import MAX_FILE
from tappet.runtime.operations.flight import SaveFlight
from tappet.server.dependencies import CommissioningDep, Engineer, LinkDep, RuntimesDep, StoreDep, Viewer
from tappet.server.flight import recordings
from tappet.server.flight.recording_shapes import (
    NewRecording,
    OpenedRecording,
    RecordingFacts,
    ReplayReport,
    ReplayRequest,
)
from tappet.server.objects.replies import object_detail
from tappet.server.objects.shapes import ObjectDetail
from tappet.server.problems import Problem
from tappet.server.projects.routes import download
from tappet.server.routing import Router
from tappet.server.spoken import LanguageDep, in_language

router = Router(tags=["flight recorder"])
_FILE: dict[int | str, dict[str, Any]] = {200: {"content": {"text/plain": {"schema": {"type": "string"}}}}}
_ROOM = 64 * 1024
"""Of a request around the file."""


@router.post("/projects/{project_id}/applications/{application_id}/recordings", status_code=201)
async def save_recording(
    project_id: str,
    application_id: str,
    body: NewRecording,
    who: Engineer,
    store: StoreDep,
    runtimes: RuntimesDep,
) -> ObjectDetail:
    """Keep what the flight recorder of a runtime holds now as an object of the application."""
    async with runtimes.get(body.runtime_id).client() as client:
        text = await client.call(SaveFlight())
    return await _kept(store, project_id, application_id, body.name, text, who.username)


@router.post(
    "/projects/{project_id}/applications/{application_id}/recordings/file",
    status_code=201,
    max_body_size=MAX_FILE + _ROOM,
)
async def upload_recording(
    project_id: str,
    application_id: str,
    name: Annotated[str, Query(min_length=1, max_length=200)],
    file: UploadFile,
    who: Engineer,
    store: StoreDep,
) -> ObjectDetail:
    """Keep a `.flight` file as an object of the application."""
    try:
        text = (await file.read()).decode("ascii")
    except UnicodeDecodeError as error:
        raise Problem(422, "recording", "This is no recording of the flight recorder.") from error
    return await _kept(store, project_id, application_id, name, text, who.username)


async def _kept(
    store: StoreDep, project_id: str, application_id: str, name: str, text: str, username: str
) -> ObjectDetail:
    def keep() -> ObjectDetail:
        object_id = recordings.add(store, project_id, application_id, name, text, username)
        return object_detail(store.get(project_id, object_id))

    return await run_in_threadpool(keep)


@router.get("/runtimes/{runtime_id}/flight/file", response_class=Response, responses=_FILE)
async def download_flight(who: Engineer, link: LinkDep) -> Response:
    """What the flight recorder of a runtime holds now, as a `.flight` file."""
    async with link.client() as client:
        text = await client.call(SaveFlight())
    return download(text.encode(), f"{link.name}.flight", "text/plain")


@router.get("/projects/{project_id}/recordings/{object_id}")
def read_recording(project_id: str, object_id: str, who: Viewer, store: StoreDep) -> RecordingFacts:
    """What a recording holds."""
    return recordings.facts(recordings.text_of(store, project_id, object_id))


@router.get("/projects/{project_id}/recordings/{object_id}/file", response_class=Response, responses=_FILE)
def download_recording(project_id: str, object_id: str, who: Viewer, store: StoreDep) -> Response:
    """A recording as a `.flight` file."""
    item = store.get(project_id, object_id)
    text = recordings.text_of(store, project_id, object_id)
    return download(text.encode(), f"{item.name}.flight", "text/plain")


@router.post("/projects/{project_id}/recordings/{object_id}/open")
async def open_recording(
    project_id: str,
    object_id: str,
    who: Viewer,
    store: StoreDep,
    runtimes: RuntimesDep,
    commissioning: CommissioningDep,
) -> OpenedRecording:
    """Make a recording a runtime whose values can be looked at, in every cycle that it holds."""
    return await recordings.open_recording(store, runtimes, commissioning, project_id, object_id)


@router.post("/projects/{project_id}/recordings/{object_id}/replay")
async def replay_recording(
    project_id: str,
    object_id: str,
    body: ReplayRequest,
    who: Engineer,
    store: StoreDep,
    commissioning: CommissioningDep,
    language: LanguageDep,
) -> ReplayReport:
    """Run a recording again on virtual time, with the inputs, writes and forces that it had."""
    report = await recordings.replay(store, commissioning, project_id, object_id, today=body.today)
    return in_language(report, language)
