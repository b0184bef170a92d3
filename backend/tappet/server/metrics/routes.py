"""Numbers for monitoring."""

from __future__ import annotations

import asyncio

from starlette.responses import PlainTextResponse

from tappet.runtime.operations.tasks import ListTasks
from tappet.runtime.tasks import TaskStatistics
from tappet.server.dependencies import ServicesDep, Viewer
from tappet.server.metrics.service import CONTENT_TYPE
from tappet.server.problems import Problem
from tappet.server.routing import Router
from tappet.server.runtimes.links import RuntimeLink

router = Router(tags=["health"])
PATIENCE_S = 2.0


@router.get("/metrics", response_class=PlainTextResponse)
async def metrics(who: Viewer, services: ServicesDep) -> PlainTextResponse:
    """Prometheus text format; scrape it with a viewer's token."""
    links = [link for link in services.runtimes.all() if link.connected and link.symbols is not None]
    found = await asyncio.gather(*(_tasks(link) for link in links))
    tasks = {link.name: statistics for link, statistics in zip(links, found, strict=True)}
    return PlainTextResponse(services.metrics.render(services.runtimes, tasks), media_type=CONTENT_TYPE)


async def _tasks(link: RuntimeLink) -> list[TaskStatistics]:
    """Statistics of a runtime; none when it does not answer soon, for the other numbers still count."""
    try:
        async with asyncio.timeout(PATIENCE_S), link.client() as client:
            return await client.call(ListTasks())
    except (Problem, TimeoutError):
        return []
