"""The path of a CNC program in 3D, as its editor has it in its hands, stored or not."""

from __future__ import annotations

from typing import Any

from fastapi.responses import Response
from starlette.concurrency import run_in_threadpool

from tappet.project.cnc.program import CncProgramData
from tappet.project.store import Store
from tappet.server.cnc.settings_beside import settings_beside
from tappet.server.dependencies import ServicesDep, StoreDep, Viewer
from tappet.server.paths.shapes import (
    ChosenElements,
    ChosenLine,
    PathLooks,
    PathOrder,
    PathSamples,
    PathSummary,
    PathViewAddress,
    PathViewOrder,
    PickedElement,
    Ray,
)
from tappet.server.problems import Problem
from tappet.server.routing import Router
from tappet.server.spoken import LanguageDep

router = Router(prefix="/projects/{project_id}/paths", tags=["paths"])
JSON = "application/json"


@router.post("", status_code=201)
async def begin_path_view(
    project_id: str, body: PathViewOrder, who: Viewer, store: StoreDep, services: ServicesDep
) -> PathViewAddress:
    """Begin a view for one editor of a CNC program; nothing is drawn in it yet."""
    await run_in_threadpool(store.project, project_id)
    view_id = await services.paths.begin(body.looks)
    return PathViewAddress(view_id=view_id, path=f"/views/{view_id}/")


@router.delete("/{view_id}", status_code=204)
async def end_path_view(project_id: str, view_id: str, who: Viewer, services: ServicesDep) -> None:
    """End a view."""
    await services.paths.end(view_id)


@router.put("/{view_id}/program", response_model=PathSummary)
async def draw_path(
    project_id: str,
    view_id: str,
    body: PathOrder,
    who: Viewer,
    store: StoreDep,
    services: ServicesDep,
    language: LanguageDep,
) -> Response:
    """Draw a program, by the decoder of the library SM3_CNC and with the offline values of variables."""
    program, settings = await run_in_threadpool(_program, store, project_id, body)
    facts = {"program": program, "settings": settings, "looks": body.looks.model_dump_json()}
    return await _answer(services, view_id, "program", language, **facts)


@router.put("/{view_id}/looks", response_model=PathSummary)
async def draw_in_another_way(
    project_id: str, view_id: str, body: PathLooks, who: Viewer, services: ServicesDep, language: LanguageDep
) -> Response:
    """Draw the same program with other colours, with or without preprocessing and grid."""
    return await _answer(services, view_id, "look", language, looks=body.model_dump_json())


@router.put("/{view_id}/line", response_model=ChosenElements)
async def choose_line(
    project_id: str, view_id: str, body: ChosenLine, who: Viewer, services: ServicesDep, language: LanguageDep
) -> Response:
    """Show the elements of a line as chosen."""
    return await _answer(services, view_id, "choose", language, line=body.line)


@router.post("/{view_id}/pick", response_model=PickedElement)
async def pick_element(
    project_id: str, view_id: str, body: Ray, who: Viewer, services: ServicesDep, language: LanguageDep
) -> Response:
    """The element that is seen where somebody points."""
    return await _answer(services, view_id, "pick", language, **body.model_dump())


@router.get("/{view_id}/motion", response_model=PathSamples)
async def path_motion(
    project_id: str, view_id: str, who: Viewer, services: ServicesDep, language: LanguageDep
) -> Response:
    """The motion on the path that is drawn, by the interpolator of the library SM3_CNC."""
    return await _answer(services, view_id, "motion", language)


async def _answer(
    services: ServicesDep, view_id: str, do: str, language: LanguageDep, **facts: Any
) -> Response:
    return Response(await services.paths.ask(view_id, do, language, **facts), media_type=JSON)


def _program(store: Store, project_id: str, order: PathOrder) -> tuple[str, str]:
    """JSON of the program and of the settings of its application."""
    item = store.get(project_id, order.object_id)
    if not isinstance(item.data, CncProgramData):
        raise Problem(422, "no-cnc", f"'{item.name}' is a {item.kind}; only a CNC program has a path.")
    data = item.data if order.program is None else order.program
    return data.model_dump_json(), settings_beside(store, project_id, item.id).model_dump_json()
