"""The WebSocket of live values."""

from __future__ import annotations

from typing import Annotated

from fastapi import APIRouter, Query, WebSocket
from starlette.concurrency import run_in_threadpool

from tappet.server.auth import identity
from tappet.server.dependencies import ServicesDep, Viewer
from tappet.server.online.channel import OnlineChannel

router = APIRouter(tags=["online"])


@router.websocket("/online")
async def online(
    socket: WebSocket,
    who: Viewer,
    services: ServicesDep,
    runtime: Annotated[str, Query(description="Id of the runtime.")],
) -> None:
    """Live values of a runtime; `schemas.online` has the messages."""
    link = services.runtimes.get(runtime)
    credential = identity.credential_of(socket)

    async def still_allowed() -> bool:
        return credential is not None and (
            await run_in_threadpool(
                identity.resolve, services.database, credential, who.address, services.settings
            )
            is not None
        )

    channel = OnlineChannel(socket, link, services.samplers(link), still_allowed)
    services.metrics.online_channels.add(channel)
    try:
        await channel.run()
    finally:
        services.metrics.channel_closed(channel)
