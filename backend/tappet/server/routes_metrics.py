"""Numbers for monitoring."""

from __future__ import annotations

from fastapi import APIRouter
from starlette.responses import PlainTextResponse

from tappet.server.dependencies import ServicesDep, Viewer
from tappet.server.metrics import CONTENT_TYPE

router = APIRouter(tags=["health"])


@router.get("/metrics", response_class=PlainTextResponse)
async def metrics(who: Viewer, services: ServicesDep) -> PlainTextResponse:
    """Prometheus text format; scrape it with a viewer's token."""
    return PlainTextResponse(services.metrics.render(services.runtimes), media_type=CONTENT_TYPE)
