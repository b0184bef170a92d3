"""3D views behind the server's own address and login: a reverse proxy to viser servers on UNIX sockets.

viser's page opens its WebSocket at the page's own URL without the trailing slash, so that it works below
`/views/<id>/` as it is.
"""

from __future__ import annotations

import asyncio
from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Protocol

import websockets
from starlette.concurrency import run_in_threadpool
from starlette.websockets import WebSocket
from websockets.asyncio.client import ClientConnection

from tappet.server.problems import Problem, not_found
from tappet.server.sockets import SessionWatch, close_with_session, until_one_ends

if TYPE_CHECKING:
    from tappet.server.views.pages import File

MOST_VIEWS = 16
"""Views that run at the same time; the oldest one that nobody looks at makes room."""
VIEW_POLICY = (
    "default-src 'self' data: blob:; "
    "script-src 'self' 'unsafe-inline' 'unsafe-eval' 'wasm-unsafe-eval' blob:; "
    "style-src 'self' 'unsafe-inline'; worker-src 'self' blob: data:; connect-src 'self' blob: data:; "
    "object-src 'none'; base-uri 'none'; form-action 'none'; frame-ancestors 'self'"
)
"""viser's page is one file that unpacks itself, which needs inline and evaluated scripts."""
LARGEST_MESSAGE = 50 * 1024 * 1024
"""viser's own limit."""


class ViewServer(Protocol):
    """A viser server; `private_viser.PrivateViser` is one."""

    @property
    def socket(self) -> Path:
        """The UNIX socket it listens on."""

    def stop(self) -> None:
        """Ends it."""


ViewFactory = Callable[[], ViewServer]
"""Makes a view; may block."""


@dataclass(slots=True)
class _View:
    server: ViewServer
    clients: int = 0


class ViewRegistry:
    """The running views by id."""

    def __init__(self) -> None:
        self._views: dict[str, _View] = {}
        self._starting = asyncio.Lock()

    def ids(self) -> list[str]:
        """Ids of the running views, oldest first."""
        return list(self._views)

    async def start_view(self, view_id: str, factory: ViewFactory) -> ViewServer:
        """The view's server, started by `factory` if it does not run; a 503 problem when too many do."""
        async with self._starting:
            known = self._views.get(view_id)
            if known is not None:
                return known.server
            if len(self._views) >= MOST_VIEWS:
                idle = next((id for id, view in self._views.items() if not view.clients), None)
                if idle is None:
                    raise Problem(
                        503, "too-many-views", f"{MOST_VIEWS} 3D views are open already; close one of them."
                    )
                await self.stop_view(idle)
            server = await run_in_threadpool(factory)
            self._views[view_id] = _View(server)
            return server

    def server_of(self, view_id: str) -> ViewServer:
        """The server of a running view; a 404 problem for another one."""
        return self._get(view_id).server

    async def stop_view(self, view_id: str) -> None:
        """Ends a view; nothing happens when it does not run."""
        view = self._views.pop(view_id, None)
        if view is not None:
            await run_in_threadpool(view.server.stop)

    async def close(self) -> None:
        """Ends all views."""
        for view_id in self.ids():
            await self.stop_view(view_id)

    async def fetch(self, view_id: str, path: str, accept_encoding: str) -> File:
        """A file of the view's page, still compressed. Cookies and tokens are not passed on."""
        from tappet.server.views import pages  # an HTTP client: only for 3D views

        view = self._get(view_id)
        try:
            return await pages.fetch(view.server.socket, path, accept_encoding)
        except pages.UnreachableError as error:
            raise _unreachable(view_id, error) from error

    async def connect(self, view_id: str, socket: WebSocket, session: SessionWatch) -> None:
        """Passes messages between a browser and the view until one of them leaves."""
        view = self._get(view_id)
        offered = [websockets.Subprotocol(p) for p in socket.scope.get("subprotocols", [])]
        try:
            upstream = await websockets.unix_connect(
                str(view.server.socket),
                subprotocols=offered or None,
                max_size=LARGEST_MESSAGE,
                compression=None,
            )
        except (OSError, websockets.WebSocketException) as error:
            raise _unreachable(view_id, error) from error
        view.clients += 1
        try:
            async with upstream:
                await socket.accept(upstream.subprotocol)
                await _pump(socket, upstream, session)
        finally:
            view.clients -= 1

    def _get(self, view_id: str) -> _View:
        view = self._views.get(view_id)
        if view is None:
            raise not_found("open 3D view", view_id)
        return view


def _unreachable(view_id: str, error: Exception) -> Problem:
    return Problem(502, "view-unreachable", f"The view '{view_id}' does not answer: {error}.")


async def _pump(socket: WebSocket, upstream: ClientConnection, session: SessionWatch) -> None:
    async def to_view() -> None:
        while True:
            message = await socket.receive()
            if message["type"] == "websocket.disconnect":
                return
            await upstream.send(message["bytes"] if message.get("bytes") is not None else message["text"])

    async def to_browser() -> None:
        async for message in upstream:
            await (socket.send_text(message) if isinstance(message, str) else socket.send_bytes(message))
        await socket.close(upstream.close_code or 1000)

    await until_one_ends(
        to_view,
        to_browser,
        partial(close_with_session, socket, session),
        gone=(websockets.ConnectionClosed, RuntimeError),
    )
