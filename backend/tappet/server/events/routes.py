"""The WebSocket of changes and presence in a project."""

from __future__ import annotations

from typing import Annotated

from fastapi import Query, WebSocket
from starlette.concurrency import run_in_threadpool

from tappet.server.dependencies import ServicesDep, SessionDep, Viewer
from tappet.server.routing import Router

router = Router(tags=["projects"])


@router.websocket("/events")
async def events(
    socket: WebSocket,
    who: Viewer,
    services: ServicesDep,
    session: SessionDep,
    project: Annotated[str, Query(description="Id of the project.")],
) -> None:
    """Changes of objects and who looks at which; `shapes` has the messages."""
    await run_in_threadpool(services.store.project, project)
    await services.events.serve(socket, project, who.username, session)
