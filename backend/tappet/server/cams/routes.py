"""What the cam editor asks of a cam that it has in its hands, stored or not."""

from __future__ import annotations

from fastapi.responses import Response
from starlette.concurrency import run_in_threadpool

from tappet.server.cams.shapes import CamDrawing, CurvesOrder
from tappet.server.dependencies import ServicesDep, StoreDep, Viewer
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
