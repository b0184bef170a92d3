"""What the sockets of the server have in common: they end as a whole, and with the session behind them."""

from __future__ import annotations

import asyncio
from collections.abc import Awaitable, Callable, Iterator
from contextlib import contextmanager, suppress

import anyio
from starlette.websockets import WebSocket, WebSocketDisconnect

CHECK_EVERY_S = 30.0
"""How soon a socket notices that its session has ended by itself; what a user ends is noticed at once."""
SESSION_ENDED = 4401
"""Close code when the session behind the socket has ended."""

Part = Callable[[], Awaitable[None]]


class EndedSessions:
    """Tells open sockets that sessions or tokens have ended; each looks whether its own is among them."""

    def __init__(self) -> None:
        self._loop: asyncio.AbstractEventLoop | None = None
        self._waiting: set[asyncio.Event] = set()

    def tell(self) -> None:
        """From any thread."""
        if self._loop is not None and not self._loop.is_closed():
            self._loop.call_soon_threadsafe(self._wake)

    def _wake(self) -> None:
        for event in self._waiting:
            event.set()

    @contextmanager
    def heard(self) -> Iterator[asyncio.Event]:
        """An event that is set whenever some have ended."""
        self._loop = asyncio.get_running_loop()
        event = asyncio.Event()
        self._waiting.add(event)
        try:
            yield event
        finally:
            self._waiting.discard(event)


class SessionWatch:
    """The session or token behind an open socket."""

    def __init__(self, allowed: Callable[[], Awaitable[bool]], ended: EndedSessions) -> None:
        self._allowed = allowed
        self._ended = ended

    async def end(self) -> None:
        """Returns once the session has ended."""
        with self._ended.heard() as some:
            while await self._allowed():
                with anyio.move_on_after(CHECK_EVERY_S):
                    await some.wait()
                some.clear()


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


async def close_with_session(socket: WebSocket, session: SessionWatch) -> None:
    """Close the socket once its session has ended."""
    await session.end()
    await socket.close(SESSION_ENDED, "The session has ended.")
