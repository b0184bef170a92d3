"""The WebSocket server of a runtime: authentication, requests, events, recorder frames.

All work on the PLC runs in worker threads, so that a download never delays the frames of a watch list; no
call of this module ever enters a task.
"""

from __future__ import annotations

import asyncio
import contextlib
import hmac
import logging
from collections import deque
from typing import Any, TypeVar

from websockets.asyncio.server import Server, ServerConnection, serve
from websockets.exceptions import ConnectionClosed

from tappet.log_rate import RateLimit
from tappet.runtime import protocol
from tappet.runtime.errors import DiskFullError, NoApplicationError, NoTraceError, PlcError
from tappet.runtime.operations import registry
from tappet.runtime.operations.declaration import OperationError
from tappet.runtime.operations.life_cycle import Hello
from tappet.runtime.plc import SoftPlc
from tappet.runtime.protocol import ProtocolError
from tappet.runtime.state import Event
from tappet.runtime.subscriptions import Subscriptions
from tappet.runtime.task_group import TaskError

T = TypeVar("T")
MOST_CONNECTIONS = 32
MOST_OPEN = 128
"""With those that have not said hello yet."""
MOST_REASON = 100
"""Characters of the reason of a closed WebSocket, which has room for 123 bytes."""
_MALFORMED_LIMIT = 10
_EVENT_LIMIT = 200
_DRAIN_S = 0.01
_POLL_S = 0.05
_SYNC_S = 1.0
_LOAD_S = 1.0


class LimitedConnection(ServerConnection):
    """A connection from its first byte on; beyond `MOST_OPEN` it is ended at once."""

    def connection_made(self, transport: asyncio.BaseTransport) -> None:
        """Those that never say hello count, too, until their time is over."""
        super().connection_made(transport)
        if len(self.server.handlers) > MOST_OPEN:
            assert isinstance(transport, asyncio.Transport)
            transport.abort()


class Connection:
    """One authenticated client; the session of its operations."""

    def __init__(self, service: RuntimeService, socket: ServerConnection) -> None:
        self.service = service
        self.plc = service.plc
        self.socket = socket
        self.subscriptions = Subscriptions()
        self._events: deque[bytes] = deque()
        self._wake = asyncio.Event()
        self._owned: dict[type, Any] = {}

    def own(self, kind: type[T]) -> T:
        """State that an operation keeps with this connection."""
        state: T = self._owned[kind] if kind in self._owned else self._owned.setdefault(kind, kind())
        return state

    async def serve(self) -> None:
        """Answer requests until the client leaves."""
        sender = asyncio.create_task(self._send_loop())
        malformed = 0
        try:
            async for data in self.socket:
                try:
                    request = protocol.parse_request(data)
                except ProtocolError as error:
                    malformed += 1
                    await self.socket.send(protocol.pack_error(None, error.code, str(error)))
                    if malformed >= _MALFORMED_LIMIT:
                        await self.socket.close(protocol.CLOSE_PROTOCOL, "too many malformed messages")
                        return
                    continue
                await self.socket.send(await self._answer(request))
        finally:
            sender.cancel()
            with contextlib.suppress(asyncio.CancelledError, ConnectionClosed):
                await sender
            for recorder in self.subscriptions.clear():
                await asyncio.to_thread(self.plc.end_record, recorder)

    async def _answer(self, request: protocol.Request) -> bytes:
        try:
            operation = protocol.parse_arguments(request, registry.known())
            return protocol.pack_result(request.id, await operation.serve(self))
        except (OperationError, PlcError, TaskError, ValueError) as error:
            return protocol.pack_error(request.id, refusal_code(error), str(error))
        except Exception as error:
            self.plc.log.add("error", "service", f"{request.op} failed: {type(error).__name__}: {error}")
            return protocol.pack_error(request.id, "internal", f"{type(error).__name__}: {error}")

    # -- sending -----------------------------------------------------------------------------------------

    def drain(self) -> None:
        """Look for new frames of the recorders."""
        if self.subscriptions.drain():
            self._wake.set()

    def post(self, message: bytes) -> None:
        """Queue an event; a client that takes none is disconnected."""
        self._events.append(message)
        self._wake.set()
        if len(self._events) > _EVENT_LIMIT:
            self.service.drop(self)

    async def _send_loop(self) -> None:
        while True:
            await self._wake.wait()
            self._wake.clear()
            while self._events:
                await self.socket.send(self._events.popleft())
            for subscription in self.subscriptions:
                message = subscription.message()
                if message is not None:
                    await self.socket.send(message)

    def application_changed(self) -> None:
        """End the recorders whose application is gone."""
        application = self.plc.application
        alive = {id(r) for rs in application.recorders.values() for r in rs} if application else set()
        for number in self.subscriptions.ended(alive):
            self.post(protocol.pack({"event": "recorder_ended", "recorder": number}))


def refusal_code(error: Exception) -> str:
    """The code under which a client hears of an error that a handler raised."""
    if isinstance(error, OperationError):
        return error.code
    if isinstance(error, NoTraceError):
        return "not_found"
    if isinstance(error, NoApplicationError):
        return "no_application"
    if isinstance(error, DiskFullError):
        return "disk_full"
    return "refused" if isinstance(error, PlcError | TaskError) else "bad_request"


def _quiet_log() -> logging.Logger:
    """Tells of handshakes that fail, but not of each of very many."""
    log = logging.getLogger(__name__)
    if not log.filters:
        log.addFilter(RateLimit())
    return log


class RuntimeService:
    """Listens for clients and looks after the PLC between cycles."""

    def __init__(self, plc: SoftPlc, token: str) -> None:
        self.plc = plc
        self._token = token.encode()
        self._connections: set[Connection] = set()
        self._open = 0
        self._server: Server | None = None
        self._background: list[asyncio.Task[None]] = []
        self._closing: set[asyncio.Task[None]] = set()
        self._loop: asyncio.AbstractEventLoop | None = None

    async def start(self, host: str, port: int) -> int:
        """Listen; returns the port (a free one for 0)."""
        self._loop = asyncio.get_running_loop()
        self.plc.on_event = self._on_event
        self._server = await serve(
            self._handle,
            host,
            port,
            max_size=protocol.MAX_MESSAGE,
            compression=None,
            origins=[None],  # a browser page has no business here: clients are servers and tools
            open_timeout=protocol.HELLO_TIMEOUT_S,
            create_connection=LimitedConnection,
            logger=_quiet_log(),
        )
        self._background = [
            asyncio.create_task(self._drain_loop()),
            asyncio.create_task(self._poll_loop()),
            asyncio.create_task(self._sync_loop()),
            asyncio.create_task(self._load_loop()),
        ]
        number: int = next(iter(self._server.sockets)).getsockname()[1]
        return number

    async def close(self) -> None:
        """Disconnect everybody."""
        self.plc.on_event = None
        for task in self._background:
            task.cancel()
        await asyncio.gather(*self._background, return_exceptions=True)
        if self._server is not None:
            self._server.close()
            await self._server.wait_closed()

    async def _handle(self, socket: ServerConnection) -> None:
        if self._open >= MOST_CONNECTIONS:
            await socket.close(protocol.CLOSE_BUSY, "too many connections")
            return
        self._open += 1
        connection: Connection | None = None
        try:
            if not await self._greet(socket):
                return
            connection = Connection(self, socket)
            self._connections.add(connection)
            await connection.serve()
        except ConnectionClosed:
            pass
        finally:
            self._open -= 1
            if connection is not None:
                self._connections.discard(connection)

    async def _greet(self, socket: ServerConnection) -> bool:
        """The first message must be a proper hello with the token, in time."""
        try:
            async with asyncio.timeout(protocol.HELLO_TIMEOUT_S):
                request = protocol.parse_request(await socket.recv())
                hello = protocol.parse_arguments(request, {Hello.op: Hello})
        except (ProtocolError, TimeoutError) as error:
            await socket.close(protocol.CLOSE_HELLO, f"expected hello: {error}"[:MOST_REASON])
            return False
        assert isinstance(hello, Hello)
        if not hmac.compare_digest(hello.token.encode(), self._token):
            self.plc.log.add("warning", "service", "a client with a wrong token was refused")
            await socket.close(protocol.CLOSE_BAD_TOKEN, "wrong token")
            return False
        await socket.send(protocol.pack_result(request.id, await asyncio.to_thread(hello.run, self.plc)))
        return True

    def drop(self, connection: Connection) -> None:
        """Disconnect a client that does not take its messages."""
        task = asyncio.ensure_future(connection.socket.close(protocol.CLOSE_PROTOCOL, "client too slow"))
        self._closing.add(task)
        task.add_done_callback(self._closing.discard)

    # -- background --------------------------------------------------------------------------------------

    def _on_event(self, event: Event) -> None:
        """Called from whichever thread changed the PLC."""
        if self._loop is not None and not self._loop.is_closed():
            self._loop.call_soon_threadsafe(self._broadcast, event)

    def _broadcast(self, event: Event) -> None:
        message = protocol.pack({"event": event.kind, "state": event.state})
        for connection in list(self._connections):
            if event.kind == "application":
                connection.application_changed()
            connection.post(message)

    async def _drain_loop(self) -> None:
        while True:
            busy = any(c.subscriptions for c in self._connections)
            await asyncio.sleep(_DRAIN_S if busy else _POLL_S)
            for connection in list(self._connections):
                connection.drain()

    async def _poll_loop(self) -> None:
        while True:
            await asyncio.sleep(_POLL_S)
            try:
                await asyncio.to_thread(self.plc.poll)
            except Exception as error:  # the loop that reports exceptions must not end by one
                self.plc.log.add("error", "service", f"{type(error).__name__}: {error}")
                await asyncio.sleep(_SYNC_S)

    async def _sync_loop(self) -> None:
        while True:
            await asyncio.sleep(_SYNC_S)
            try:
                await asyncio.to_thread(self.plc.sync_retain)
            except OSError as error:
                self.plc.log.add("error", "retain", f"remanent variables could not reach the disk: {error}")
                await asyncio.sleep(60)

    async def _load_loop(self) -> None:
        while True:
            await asyncio.sleep(_LOAD_S)
            await asyncio.to_thread(self.plc.sample_load)
