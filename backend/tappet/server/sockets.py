"""What the sockets of the server have in common: they end as a whole, and with the session behind them."""

from __future__ import annotations

from collections.abc import Awaitable, Callable
from contextlib import suppress

import anyio
from starlette.websockets import WebSocket, WebSocketDisconnect

CHECK_EVERY_S = 30.0
"""How soon a socket notices that its session has ended."""
SESSION_ENDED = 4401
"""Close code when the session behind the socket has ended."""

Part = Callable[[], Awaitable[None]]
StillAllowed = Callable[[], Awaitable[bool]]
"""Asked now and then by open sockets; False: close."""


async def until_one_ends(*parts: Part, gone: tuple[type[Exception], ...] = ()) -> None:
    """Run the parts of a socket until one of them ends.

    A browser that went away is no error, nor are the exceptions `gone`, by which others signal the same.
    """
    async with anyio.create_task_group() as group:

        async def run(part: Part) -> None:
            with suppress(WebSocketDisconnect, OSError, *gone):
                await part()
            group.cancel_scope.cancel()

        for part in parts:
            group.start_soon(run, part)


async def close_with_session(socket: WebSocket, still_allowed: StillAllowed) -> None:
    """Close the socket once its session has ended."""
    while True:
        await anyio.sleep(CHECK_EVERY_S)
        if not await still_allowed():
            await socket.close(SESSION_ENDED, "The session has ended.")
            return
