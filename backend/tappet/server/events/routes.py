"""The WebSocket of changes and presence in a project."""

from __future__ import annotations

from typing import Annotated

from fastapi import APIRouter, Query, WebSocket
from starlette.concurrency import run_in_threadpool

from tappet.server.auth import identity
from tappet.server.dependencies import ServicesDep, Viewer

router = APIRouter(tags=["projects"])


@router.websocket("/events")
async def events(
    socket: WebSocket,
    who: Viewer,
    services: ServicesDep,
    project: Annotated[str, Query(description="Id of the project.")],
) -> None:
    """Changes of objects and who looks at which; `shapes` has the messages."""
    await run_in_threadpool(services.store.project, project)
    credential = identity.credential_of(socket)

    async def still_allowed() -> bool:
        return credential is not None and (
            await run_in_threadpool(
                identity.resolve, services.database, credential, who.address, services.settings
            )
            is not None
        )

    await services.events.serve(socket, project, who.username, still_allowed)
