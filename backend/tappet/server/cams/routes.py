"""What the cam editor asks of a cam that it has in its hands, stored or not."""

from __future__ import annotations

from fastapi.responses import Response
from starlette.concurrency import run_in_threadpool

from tappet.server.cams.shapes import (
    CamCodeOrder,
    CamDrawing,
    CamImport,
    CamText,
    CamTextOrder,
    CurvesOrder,
    ImportedCam,
    OptimisedCam,
    OptimiseOrder,
)
from tappet.server.dependencies import Engineer, ServicesDep, StoreDep, Viewer
from tappet.server.routing import Router
from tappet.server.spoken import LanguageDep

router = Router(prefix="/projects/{project_id}/cams", tags=["cams"])
JSON = "application/json"


@router.post("/curves", response_model=CamDrawing)
async def draw_cam(
    project_id: str,
    body: CurvesOrder,
    who: Viewer,
    store: StoreDep,
    services: ServicesDep,
    language: LanguageDep,
) -> Response:
    """The curves of a cam by the compiled library SM3_Basic, its extremes and what is wrong with it."""
    await run_in_threadpool(store.project, project_id)
    answer = await services.cams.ask("curves", body.cam, samples=body.samples, at=body.at, language=language)
    return Response(answer, media_type=JSON)


@router.post("/text", response_model=CamText)
async def write_cam_text(
    project_id: str, body: CamTextOrder, who: Viewer, store: StoreDep, services: ServicesDep
) -> Response:
    """A cam as ASCII table, CSV or cam file (CAM-81, CAM-82).

    Sines and other laws have no place in a cam file: the problem `no-cam-file` names the segment.
    """
    await run_in_threadpool(store.project, project_id)
    facts = body.model_dump(exclude={"cam"})
    return Response(await services.cams.ask("text", body.cam, **facts), media_type=JSON)


@router.post("/from-text", response_model=ImportedCam)
async def read_cam_text(
    project_id: str, body: CamImport, who: Engineer, store: StoreDep, services: ServicesDep
) -> Response:
    """The cam with the points of a text (CAM-80, CAM-82); nothing is stored.

    A text that is no cam is the problem `cam-text`, with the number of the wrong line. Points without
    derivatives get those of the cubic spline through them.
    """
    await run_in_threadpool(store.project, project_id)
    return Response(await services.cams.ask("from-text", body.cam, text=body.text), media_type=JSON)


@router.post("/optimise", response_model=OptimisedCam)
async def optimise_cam(
    project_id: str, body: OptimiseOrder, who: Engineer, store: StoreDep, services: ServicesDep
) -> Response:
    """The cam with the chosen points moved so that a peak beside them becomes least; nothing is stored.

    Points keep their X. Those that cannot be moved are the problem `cam-optimisation`.
    """
    await run_in_threadpool(store.project, project_id)
    facts = body.model_dump(exclude={"cam"})
    return Response(await services.cams.ask("optimise", body.cam, **facts), media_type=JSON)


@router.post("/code", response_model=CamText)
async def show_cam_code(
    project_id: str, body: CamCodeOrder, who: Viewer, store: StoreDep, services: ServicesDep
) -> Response:
    """The declarations that a cam is compiled into (CAM-83, CAM-90); one with errors is refused."""
    await run_in_threadpool(store.project, project_id)
    return Response(await services.cams.ask("code", body.cam, name=body.name), media_type=JSON)
