"""The WebSocket of live values."""

from __future__ import annotations

from typing import Annotated

from fastapi import Query, WebSocket

from tappet.server.dependencies import ServicesDep, SessionDep, Viewer
from tappet.server.online.channel import OnlineChannel
from tappet.server.routing import Router

router = Router(tags=["online"])


@router.websocket("/online")
async def online(
    socket: WebSocket,
    who: Viewer,
    services: ServicesDep,
    session: SessionDep,
    runtime: Annotated[str, Query(description="Id of the runtime.")],
) -> None:
    """Live values of a runtime; `shapes` has the messages."""
    link = services.runtimes.get(runtime)
    quota = services.quotas.open(who.user_id)
    try:
        channel = OnlineChannel(socket, link, services.samplers(link), session, quota)
        services.metrics.online_channels.add(channel)
        try:
            await channel.run()
        finally:
            services.metrics.channel_closed(channel)
    finally:
        services.quotas.close(who.user_id)
