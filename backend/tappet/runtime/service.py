"""The WebSocket server of a runtime: authentication, requests, events, recorder frames.

All work on the PLC runs in worker threads, so that a download never delays the frames of a watch list; no
call of this module ever enters a task.
"""

from __future__ import annotations

import asyncio
import contextlib
import hmac
from collections import deque
from collections.abc import Awaitable, Callable
from dataclasses import asdict
from typing import Any

from websockets.asyncio.server import Server, ServerConnection, serve
from websockets.exceptions import ConnectionClosed

from tappet.runtime import flight_wire, protocol
from tappet.runtime.access import PlcError
from tappet.runtime.forces import PlacedValue
from tappet.runtime.places import Place
from tappet.runtime.plc import Event, SoftPlc
from tappet.runtime.protocol import Fields, ProtocolError
from tappet.runtime.recorder import Recorder
from tappet.runtime.task_group import TaskError

MOST_CONNECTIONS = 32
MOST_RECORDERS = 256
"""Recorders of one connection."""
PENDING_BYTES = 4 << 20
"""Recorder bytes kept for a slow client; older ones are dropped first."""
_MALFORMED_LIMIT = 10
_EVENT_LIMIT = 200
_DRAIN_S = 0.01
_POLL_S = 0.05
_SYNC_S = 1.0
_WRITE_TIMEOUT_S = 1.0


class Subscription:
    """A recorder of a client and what could not be sent to it yet."""

    def __init__(self, number: int, recorder: Recorder) -> None:
        self.number = number
        self.recorder = recorder
        self._pending: deque[tuple[int, bytes]] = deque()
        self._bytes = 0
        self.dropped = 0
        """Frames that were sampled but dropped because the client was slow."""

    def drain(self) -> bool:
        """Take new frames out of the ring; whether there are any to send."""
        count, data = self.recorder.take_raw()
        if count:
            self._pending.append((count, data))
            self._bytes += len(data)
        while self._bytes > PENDING_BYTES and len(self._pending) > 1:
            lost, old = self._pending.popleft()
            self.dropped += lost
            self._bytes -= len(old)
        return bool(self._pending)

    def message(self) -> bytes | None:
        """Everything pending as one message."""
        if not self._pending:
            return None
        count = sum(n for n, _ in self._pending)
        data = b"".join(d for _, d in self._pending)
        self._pending.clear()
        self._bytes = 0
        dropped = self.dropped + self.recorder.dropped
        return protocol.pack_frames(self.number, count, self.recorder.frame_size, dropped, data)


class Connection:
    """One authenticated client."""

    def __init__(self, service: RuntimeService, socket: ServerConnection) -> None:
        self.service = service
        self.plc = service.plc
        self.socket = socket
        self.subscriptions: dict[int, Subscription] = {}
        self._next_recorder = 1
        self._events: deque[bytes] = deque()
        self._wake = asyncio.Event()
        self._upload: bytearray | None = None
        self._upload_size = 0
        self._operations: dict[str, Callable[[Fields], Awaitable[Any]]] = {
            "info": self._info, "start": self._start, "stop": self._stop, "reset": self._reset,
            "single_cycle": self._single_cycle,
            "download_begin": self._download_begin, "download_chunk": self._download_chunk,
            "download_commit": self._download_commit, "symbols": self._symbols, "read": self._read,
            "write": self._write, "force": self._force, "unforce": self._unforce, "forces": self._forces,
            "record": self._record, "end_record": self._end_record, "tasks": self._tasks,
            "reset_statistics": self._reset_statistics, "exception": self._exception, "log": self._log,
            **flight_wire.operations(service.plc),
        }  # fmt: skip

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
            for subscription in self.subscriptions.values():
                await asyncio.to_thread(self.plc.end_record, subscription.recorder)
            self.subscriptions.clear()

    async def _answer(self, request: protocol.Request) -> bytes:
        operation = self._operations.get(request.op)
        if operation is None:
            return protocol.pack_error(request.id, "unknown_op", f"unknown operation '{request.op[:40]}'")
        try:
            return protocol.pack_result(request.id, await operation(request.fields))
        except ProtocolError as error:
            return protocol.pack_error(request.id, error.code, str(error))
        except (PlcError, TaskError) as error:
            return protocol.pack_error(request.id, "refused", str(error))
        except ValueError as error:
            return protocol.pack_error(request.id, "bad_request", str(error))
        except Exception as error:
            self.plc.log.add("error", "service", f"{request.op} failed: {type(error).__name__}: {error}")
            return protocol.pack_error(request.id, "internal", f"{type(error).__name__}: {error}")

    # -- sending -----------------------------------------------------------------------------------------

    def drain(self) -> None:
        """Empty the rings of this client's recorders."""
        if sum(s.drain() for s in self.subscriptions.values()):
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
            for subscription in list(self.subscriptions.values()):
                message = subscription.message()
                if message is not None:
                    await self.socket.send(message)

    def application_changed(self) -> None:
        """End the recorders whose application is gone."""
        application = self.plc.application
        alive = {id(r) for rs in application.recorders.values() for r in rs} if application else set()
        for number, subscription in list(self.subscriptions.items()):
            if id(subscription.recorder) not in alive:
                del self.subscriptions[number]
                self.post(protocol.pack({"event": "recorder_ended", "recorder": number}))

    # -- operations --------------------------------------------------------------------------------------

    async def _info(self, fields: Fields) -> Any:
        return asdict(await asyncio.to_thread(self.plc.info))

    async def _start(self, fields: Fields) -> Any:
        await asyncio.to_thread(self.plc.start)

    async def _stop(self, fields: Fields) -> Any:
        await asyncio.to_thread(self.plc.stop)

    async def _single_cycle(self, fields: Fields) -> Any:
        await asyncio.to_thread(self.plc.single_cycle)

    async def _reset(self, fields: Fields) -> Any:
        await asyncio.to_thread(self.plc.reset, fields.text("kind"))

    async def _download_begin(self, fields: Fields) -> Any:
        self._upload_size = fields.integer("size", high=protocol.MAX_PACKAGE)
        self._upload = bytearray()

    async def _download_chunk(self, fields: Fields) -> Any:
        if self._upload is None:
            raise ProtocolError("bad_request", "download_chunk: no download has begun")
        data = fields.data("data")
        if len(self._upload) + len(data) > self._upload_size:
            self._upload = None
            raise ProtocolError(
                "bad_request", f"download_chunk: more than the announced {self._upload_size} bytes"
            )
        self._upload += data

    async def _download_commit(self, fields: Fields) -> Any:
        upload, self._upload = self._upload, None
        if upload is None or len(upload) != self._upload_size:
            got = 0 if upload is None else len(upload)
            raise ProtocolError("bad_request", f"download_commit: {got} of {self._upload_size} bytes arrived")
        mode = fields.text("mode")
        if mode not in ("download", "online_change"):
            raise ProtocolError("bad_request", "download_commit: 'mode' must be download or online_change")
        await asyncio.to_thread(self.plc.download, bytes(upload), mode)
        return asdict(await asyncio.to_thread(self.plc.info))

    async def _symbols(self, fields: Fields) -> Any:
        application = self.plc.application
        if application is None:
            raise PlcError("no application is loaded; download one first")
        return {"code_id": application.package.code_id, "table": application.package.symbols.to_table()}

    async def _read(self, fields: Fields) -> Any:
        return await asyncio.to_thread(self.plc.read, fields.places("places"))

    async def _write(self, fields: Fields) -> Any:
        values = _placed(fields.values("values"))
        done = await asyncio.to_thread(self.plc.write, values)
        waited = 0.0
        while not (finished := await asyncio.to_thread(done)) and waited < _WRITE_TIMEOUT_S:
            await asyncio.sleep(0.001)
            waited += 0.001
        return finished

    async def _force(self, fields: Fields) -> Any:
        await asyncio.to_thread(self.plc.force, _placed(fields.values("values")))

    async def _unforce(self, fields: Fields) -> Any:
        keys, restore = fields.keys("keys"), fields.flag("restore")
        return await asyncio.to_thread(lambda: self.plc.unforce(keys, restore=restore))

    async def _forces(self, fields: Fields) -> Any:
        rows = await asyncio.to_thread(self.plc.forces)
        return [[f.value.place.offset, f.value.place.bit, f.value.data, f.before, path] for f, path in rows]

    async def _record(self, fields: Fields) -> Any:
        if len(self.subscriptions) >= MOST_RECORDERS:
            raise PlcError(f"a connection has at most {MOST_RECORDERS} recorders")
        recorder = await asyncio.to_thread(
            self.plc.record,
            fields.places("items"),
            fields.optional_text("task"),
            fields.integer("divider", 1, low=1),
            fields.integer("min_interval_ns", 0),
            fields.integer("frames", 0),
        )
        number = self._next_recorder
        self._next_recorder += 1
        self.subscriptions[number] = Subscription(number, recorder)
        return {"recorder": number, "data_size": recorder.spec.data_size, "task": recorder.spec.task}

    async def _end_record(self, fields: Fields) -> Any:
        subscription = self.subscriptions.pop(fields.integer("recorder"), None)
        if subscription is not None:
            await asyncio.to_thread(self.plc.end_record, subscription.recorder)

    async def _tasks(self, fields: Fields) -> Any:
        return [asdict(t) for t in await asyncio.to_thread(self.plc.tasks)]

    async def _reset_statistics(self, fields: Fields) -> Any:
        await asyncio.to_thread(self.plc.reset_statistics, fields.optional_text("task"))

    async def _exception(self, fields: Fields) -> Any:
        report = await asyncio.to_thread(self.plc.exception)
        return None if report is None else report.to_dict()

    async def _log(self, fields: Fields) -> Any:
        return [asdict(e) for e in self.plc.log.since(fields.integer("since", 0))]


def _placed(rows: list[tuple[int, bytes, int | None]]) -> list[PlacedValue]:
    return [PlacedValue(Place(offset, len(data), bit), data) for offset, data, bit in rows]


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
        )
        self._background = [
            asyncio.create_task(self._drain_loop()),
            asyncio.create_task(self._poll_loop()),
            asyncio.create_task(self._sync_loop()),
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
                token = request.fields.text("token").encode() if request.op == "hello" else b""
        except (ProtocolError, TimeoutError):
            await socket.close(protocol.CLOSE_HELLO, "expected hello")
            return False
        if not hmac.compare_digest(token, self._token):
            self.plc.log.add("warning", "service", "a client with a wrong token was refused")
            await socket.close(protocol.CLOSE_BAD_TOKEN, "wrong token")
            return False
        info = asdict(await asyncio.to_thread(self.plc.info))
        await socket.send(protocol.pack_result(request.id, info))
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
