"""What the editors of CNC programs and settings ask, stored or not."""

from __future__ import annotations

from fastapi.responses import Response
from starlette.concurrency import run_in_threadpool

from tappet.project.cnc.program import CncProgramData
from tappet.project.cnc.settings import CncSettingsData
from tappet.project.store import Store
from tappet.server.cnc.settings_beside import settings_beside
from tappet.server.cnc.shapes import CncBlocks, CncCode, CncInfo, CncOrder
from tappet.server.dependencies import ServicesDep, StoreDep, Viewer
from tappet.server.routing import Router
from tappet.server.spoken import LanguageDep

router = Router(prefix="/projects/{project_id}/cnc", tags=["cnc"])
JSON = "application/json"


@router.post("/info", response_model=CncInfo)
async def cnc_info(
    project_id: str,
    body: CncOrder,
    who: Viewer,
    store: StoreDep,
    services: ServicesDep,
    language: LanguageDep,
) -> Response:
    """Lines, objects, length and duration of a program, by the blocks of the library SM3_CNC (CNC-20)."""
    return await _asked("info", project_id, body, store, services, language)


@router.post("/code", response_model=CncCode)
async def cnc_code(
    project_id: str,
    body: CncOrder,
    who: Viewer,
    store: StoreDep,
    services: ServicesDep,
    language: LanguageDep,
) -> Response:
    """The ST of the variables that a program is (CNC-21); the problem `faulty-cnc` for one with errors."""
    return await _asked("code", project_id, body, store, services, language)


@router.get("/blocks", response_model=CncBlocks)
async def cnc_blocks(
    project_id: str, who: Viewer, store: StoreDep, services: ServicesDep, language: LanguageDep
) -> Response:
    """The blocks of path preprocessing that the library SM3_CNC offers (CNCS-08, CNCS-09)."""
    await run_in_threadpool(store.project, project_id)
    answer = await services.cnc.ask("blocks", CncProgramData(), CncSettingsData(), name="", language=language)
    return Response(answer, media_type=JSON)


async def _asked(
    do: str, project_id: str, body: CncOrder, store: StoreDep, services: ServicesDep, language: LanguageDep
) -> Response:
    name, settings = await run_in_threadpool(_place, store, project_id, body.object_id)
    answer = await services.cnc.ask(do, body.program, settings, name=name, language=language)
    return Response(answer, media_type=JSON)


def _place(store: Store, project_id: str, object_id: str) -> tuple[str, CncSettingsData]:
    """Name of a program and the settings of its application."""
    return store.get(project_id, object_id).name, settings_beside(store, project_id, object_id)
