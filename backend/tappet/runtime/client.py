"""Client of a runtime: what the IDE server and the command line use.

    async with await RuntimeClient.connect("ws://127.0.0.1:11740", token) as client:
        await client.download(package.to_bytes())
        await client.call(Start())

A lost connection ends all waiting calls with ConnectionLost; connecting again is up to the caller.
"""

from __future__ import annotations

import asyncio
import itertools
from collections import deque
from collections.abc import Callable, Sequence
from contextlib import suppress
from dataclasses import dataclass
from types import TracebackType
from typing import Literal

from msgspec import Raw
from websockets.asyncio.client import ClientConnection, connect
from websockets.exceptions import ConnectionClosed, WebSocketException

from tappet.codegen.symbol_map import SymbolMap
from tappet.runtime import protocol
from tappet.runtime.debugger.shapes import DebugState
from tappet.runtime.operations.debugging import LoadVariant
from tappet.runtime.operations.declaration import Reply, WireOperation
from tappet.runtime.operations.download import CHUNK, BeginDownload, CommitDownload, DownloadChunk
from tappet.runtime.operations.life_cycle import GetInfo, Hello
from tappet.runtime.operations.recording import EndRecord, Record, Recording
from tappet.runtime.operations.symbols import GetSymbols, LoadedSymbols
from tappet.runtime.protocol import ProtocolError
from tappet.runtime.recorder import Frame
from tappet.runtime.source_archive import SourceInfo
from tappet.runtime.source_transfer import send_source
from tappet.runtime.state import RuntimeInfo

_LARGEST_REPLY = 1 << 30
_PENDING_FRAMES = 20_000
"""Frames kept in a recorder that nobody reads; older ones are dropped first."""


class ConnectionLost(ConnectionError):  # noqa: N818 - the event, not an error class of the field
    """The runtime closed the connection or is gone."""


class RuntimeRefused(RuntimeError):  # noqa: N818
    """The runtime answered with an error; `code` is refused, no_application, not_found,
    bad_request, unknown_op, bad_reply, internal, or one of the operation."""

    def __init__(self, code: str, message: str) -> None:
        super().__init__(message)
        self.code = code


@dataclass(frozen=True, slots=True)
class RuntimeEvent:
    """An event of a runtime: kind `state`, `exception`, `application`, `forces` or `lost`, and its state."""

    kind: str
    state: str


class Recorder:
    """Frames of a recorder, to be read with `async for`; ends when closed or when its application is gone."""

    def __init__(self, client: RuntimeClient, number: int, data_size: int) -> None:
        self._client = client
        self.number = number
        self.data_size = data_size
        self.dropped = 0
        """Frames lost at the runtime, because ring or connection were full."""
        self.skipped = 0
        """Frames dropped here, because nobody read them."""
        self._frames: deque[Frame] = deque()
        self._arrived = asyncio.Event()
        self._ended = False

    def __aiter__(self) -> Recorder:
        return self

    async def __anext__(self) -> Frame:
        while not self._frames:
            if self._ended:
                raise StopAsyncIteration
            self._arrived.clear()
            await self._arrived.wait()
        return self._frames.popleft()

    def take(self) -> list[Frame]:
        """All frames that have arrived, without waiting."""
        frames = list(self._frames)
        self._frames.clear()
        return frames

    async def close(self) -> None:
        """Stop recording."""
        if not self._ended:
            self.end()
            await self._client.end_record(self)

    def receive(self, batch: protocol.FrameBatch) -> None:
        """Frames from the wire."""
        self.dropped = batch.dropped
        self._frames.extend(batch.frames(self.data_size))
        while len(self._frames) > _PENDING_FRAMES:
            self._frames.popleft()
            self.skipped += 1
        self._arrived.set()

    def end(self) -> None:
        """No more frames will come."""
        self._ended = True
        self._arrived.set()


def _reason(error: Exception) -> str:
    """Why no connection came about, in the words of the operating system where it has some."""
    if isinstance(error, ConnectionRefusedError):
        return "nothing listens there; is `tappet runtime` running?"
    if isinstance(error, TimeoutError):
        return "no answer"
    if isinstance(error, OSError) and error.strerror:
        return error.strerror
    return str(error)


class RuntimeClient:
    """One connection to a runtime."""

    def __init__(self, socket: ClientConnection) -> None:
        self._socket = socket
        self._numbers = itertools.count(1)
        self._waiting: dict[int, asyncio.Future[Raw]] = {}
        self._recorders: dict[int, Recorder] = {}
        self._orphans: dict[int, list[protocol.FrameBatch]] = {}
        self._endings: set[asyncio.Task[None]] = set()
        self._callbacks: list[Callable[[RuntimeEvent], None]] = []
        self._symbols: LoadedSymbols | None = None
        self._receiver: asyncio.Task[None] | None = None
        self._upload = asyncio.Lock()

    @classmethod
    async def connect(cls, url: str, token: str, *, timeout_s: float = 10.0) -> RuntimeClient:
        """Connect and authenticate; ConnectionLost when the runtime is not there or refuses the token."""
        try:
            socket = await connect(
                url, max_size=_LARGEST_REPLY, compression=None, open_timeout=timeout_s, proxy=None
            )
        except (OSError, TimeoutError, WebSocketException, ValueError) as error:
            raise ConnectionLost(f"no runtime at {url}: {_reason(error)}") from error
        client = cls(socket)
        client._receiver = asyncio.create_task(client._receive())
        try:
            await client.call(Hello(token))
        except RuntimeRefused as error:
            await client.close()
            raise ConnectionLost(str(error)) from error
        except BaseException:
            await client.close()
            raise
        return client

    async def __aenter__(self) -> RuntimeClient:
        return self

    async def __aexit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        await self.close()

    async def close(self) -> None:
        """Leave; recorders of this connection end."""
        await self._socket.close()
        if self._receiver is not None:
            await asyncio.gather(self._receiver, return_exceptions=True)

    @property
    def connected(self) -> bool:
        """Whether the connection stands."""
        return self._receiver is not None and not self._receiver.done()

    # -- wire --------------------------------------------------------------------------------------------

    async def call(self, operation: WireOperation[Reply]) -> Reply:
        """The reply to an operation. RuntimeRefused says why there is none."""
        if not self.connected:
            raise ConnectionLost("the connection to the runtime is closed")
        number = next(self._numbers)
        future: asyncio.Future[Raw] = asyncio.get_running_loop().create_future()
        self._waiting[number] = future
        try:
            await self._socket.send(protocol.pack_request(number, operation))
            result = await future
        except ConnectionClosed as error:
            raise self._lost(error) from error
        finally:
            self._waiting.pop(number, None)
        try:
            return protocol.parse_result(type(operation), result)
        except ProtocolError as error:
            raise RuntimeRefused(error.code, str(error)) from error

    @staticmethod
    def _lost(error: ConnectionClosed) -> ConnectionLost:
        code = error.rcvd.code if error.rcvd else None
        reason = {
            protocol.CLOSE_BAD_TOKEN: "the runtime refused the token",
            protocol.CLOSE_BUSY: "the runtime has too many connections",
            protocol.CLOSE_HELLO: "the runtime did not accept the greeting",
        }.get(code or 0, "the connection to the runtime was lost")
        return ConnectionLost(reason)

    async def _receive(self) -> None:
        lost: Exception = ConnectionLost("the connection to the runtime was closed")
        try:
            async for data in self._socket:
                try:
                    self._take(data)
                except ProtocolError:
                    continue  # a newer runtime may send what this client does not know
        except ConnectionClosed as error:
            lost = self._lost(error)
        finally:
            if self._socket.close_code in (
                protocol.CLOSE_BAD_TOKEN,
                protocol.CLOSE_BUSY,
                protocol.CLOSE_HELLO,
            ):
                lost = ConnectionLost(f"the runtime closed the connection: {self._socket.close_reason}")
            for future in self._waiting.values():
                if not future.done():
                    future.set_exception(lost)
            for recorder in self._recorders.values():
                recorder.end()
            self._emit(RuntimeEvent("lost", "unknown"))

    def _take(self, data: bytes | str) -> None:
        if protocol.is_frames(data):
            assert isinstance(data, bytes)
            batch = protocol.unpack_frames(data)
            recorder = self._recorders.get(batch.recorder)
            if recorder is not None:
                recorder.receive(batch)
            else:  # the reply to `record` is still on its way to its caller
                self._orphans.setdefault(batch.recorder, []).append(batch)
            return
        message = protocol.parse_message(data)
        if message.event is not None:
            self._take_event(message)
            return
        future = self._waiting.get(message.id or 0)
        if future is None or future.done():
            return
        if message.error is not None:
            future.set_exception(RuntimeRefused(message.error.code, message.error.message))
        else:
            future.set_result(message.result)

    def _take_event(self, message: protocol.Message) -> None:
        if message.event == "recorder_ended":
            recorder = self._recorders.pop(message.recorder, None)
            if recorder is not None:
                recorder.end()
        else:
            self._emit(RuntimeEvent(str(message.event), message.state))

    def _emit(self, event: RuntimeEvent) -> None:
        for callback in list(self._callbacks):
            callback(event)

    def on_event(self, callback: Callable[[RuntimeEvent], None]) -> None:
        """Call `callback` for every event, on the event loop; it must not block."""
        self._callbacks.append(callback)

    # -- more than one message ---------------------------------------------------------------------------

    async def download(
        self, package: bytes, mode: Literal["download", "online_change"] = "download"
    ) -> RuntimeInfo:
        """Load a package. RuntimeRefused when it does not fit; the old application then stays."""
        async with self._upload:
            await self.call(BeginDownload(len(package)))
            for at in range(0, len(package), CHUNK):
                await self.call(DownloadChunk(package[at : at + CHUNK]))
            return await self.call(CommitDownload(mode))

    async def load_variant(self, variant: bytes) -> DebugState:
        """Load the instrumented variant of the application. RuntimeRefused when it is not that."""
        async with self._upload:
            await self.call(BeginDownload(len(variant)))
            for at in range(0, len(variant), CHUNK):
                await self.call(DownloadChunk(variant[at : at + CHUNK]))
            return await self.call(LoadVariant())

    async def store_source(
        self, archive: bytes, *, project: str, stored_by: str, code_id: str
    ) -> SourceInfo | None:
        """Keep the archive of a project in the controller. Raises SourceError when it is too large."""
        async with self._upload:
            return await send_source(self, archive, project=project, stored_by=stored_by, code_id=code_id)

    async def symbols(self) -> SymbolMap:
        """Symbol map of the loaded application; fetched once per application."""
        info = await self.call(GetInfo())
        if self._symbols is None or self._symbols.code_id != info.code_id:
            self._symbols = await self.call(GetSymbols())
        return self._symbols.symbols

    async def record(
        self,
        items: Sequence[tuple[int, int]],
        task: str | None = None,
        divider: int = 1,
        min_interval_ns: int = 0,
        frames: int = 0,
        code_id: str = "",
    ) -> Recorder:
        """Frames of (offset, size) items (see the operation `Record`)."""
        order = Record(list(items), task, divider, min_interval_ns, frames, code_id)
        asked = asyncio.ensure_future(self.call(order))
        try:
            reply = await asyncio.shield(asked)
        except asyncio.CancelledError:  # the runtime makes it all the same
            ending = asyncio.create_task(self._end_unwanted(asked))
            self._endings.add(ending)
            ending.add_done_callback(self._endings.discard)
            raise
        recorder = Recorder(self, reply.recorder, reply.data_size)
        self._recorders[recorder.number] = recorder
        for batch in self._orphans.pop(recorder.number, []):
            recorder.receive(batch)
        return recorder

    async def _end_unwanted(self, asked: asyncio.Future[Recording]) -> None:
        """Ends a recorder that nobody waits for any more."""
        with suppress(ConnectionLost, RuntimeRefused):
            number = (await asked).recorder
            await self.call(EndRecord(number))
            self._orphans.pop(number, None)

    async def end_record(self, recorder: Recorder) -> None:
        """Stop a recorder."""
        self._recorders.pop(recorder.number, None)
        await self.call(EndRecord(recorder.number))
        self._orphans.pop(recorder.number, None)
