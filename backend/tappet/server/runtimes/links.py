"""The runtimes this server works with: connections that mend themselves, and their state for everybody."""

from __future__ import annotations

import asyncio
import logging
import uuid
from collections.abc import AsyncIterator, Callable
from contextlib import asynccontextmanager, suppress
from datetime import UTC, datetime
from enum import StrEnum

from tappet.codegen.symbol_map import SymbolMap
from tappet.runtime.client import RuntimeEvent, RuntimeRefused
from tappet.runtime.exception_report import ExceptionReport
from tappet.runtime.operations.life_cycle import GetInfo
from tappet.runtime.operations.reports import GetException, exception_of
from tappet.runtime.operations.values import ForcedValue, ListForces
from tappet.runtime.state import RuntimeInfo
from tappet.server.problems import Problem, disk_full, not_found
from tappet.server.runtimes.plc_client import Connect, PlcClient
from tappet.server.runtimes.shapes import RuntimeState

log = logging.getLogger(__name__)
LONGEST_PAUSE_S = 15.0
"""Between two attempts to reach a lost runtime."""
MOST_RECORDINGS = 8
"""Open at a time."""
PATIENCE_S = 10.0
"""How long an attempt to connect may take."""


"""From a code id; may block."""


class Change(StrEnum):
    """What changed about a runtime."""

    STATE = "state"
    """Connection, operating state or exception."""
    APPLICATION = "application"
    """Places of variables known before hold no longer: another application, or a new connection."""
    FORCES = "forces"


class RuntimeLink:
    """One runtime. Listeners are called in the event loop, after the facts are up to date."""

    def __init__(
        self,
        id: str,
        name: str,
        url: str,
        token: str,
        connect: Connect,
        first_pause_s: float,
    ) -> None:
        self.id = id
        self.name = name
        self.url = url
        self.info: RuntimeInfo | None = None
        self.exception: ExceptionReport | None = None
        self.symbols: SymbolMap | None = None
        self.forced: dict[tuple[int, int | None], str] = {}
        """Paths of the forced variables by (offset, bit)."""
        self.forced_sizes: dict[tuple[int, int | None], int] = {}
        """Bytes that each force holds."""
        self.since = datetime.now(UTC)
        self.problem: str | None = None
        self._token = token
        self._connect = connect
        self._first_pause_s = first_pause_s
        self._client: PlcClient | None = None
        self._listeners: list[Callable[[Change], None]] = []
        self._dirty = asyncio.Event()
        self._moved = asyncio.Event()
        if url:
            self._moved.set()
        self._task: asyncio.Task[None] | None = None
        self._refreshing = asyncio.Lock()

    @property
    def connected(self) -> bool:
        """Whether the runtime answers."""
        return self._client is not None

    def start(self) -> None:
        """Begin to keep the connection."""
        self._task = asyncio.create_task(self._keep(), name=f"runtime {self.name}")

    def move_to(self, url: str, token: str) -> None:
        """The runtime listens elsewhere now."""
        self.url, self._token = url, token
        self._moved.set()

    def note(self, problem: str) -> None:
        """Says why there is no connection, where that is known better than from trying."""
        self._set_problem(problem)

    async def close(self) -> None:
        """Give the connection up."""
        if self._task is not None:
            self._task.cancel()
            with suppress(asyncio.CancelledError):
                await self._task
            self._task = None

    def listen(self, listener: Callable[[Change], None]) -> Callable[[], None]:
        """Calls `listener` at every change; returns what ends that."""
        self._listeners.append(listener)

        def end() -> None:
            if listener in self._listeners:
                self._listeners.remove(listener)

        return end

    @asynccontextmanager
    async def client(self) -> AsyncIterator[PlcClient]:
        """The connection; its errors become problems: 503 not connected, 409 refused by the runtime."""
        if self._client is None:
            raise self._not_connected()
        try:
            yield self._client
        except (ConnectionError, TimeoutError, OSError):
            raise self._not_connected() from None
        except RuntimeRefused as error:
            raise self._refused(error) from error

    def loaded_symbols(self) -> SymbolMap:
        """Symbols of the loaded application; raises 503 and 409 problems."""
        if self._client is None:
            raise self._not_connected()
        if self.symbols is None:
            raise self._no_application()
        return self.symbols

    @property
    def code_id(self) -> str:
        """Of the application whose symbols are known; empty when there is none.

        Orders by place carry it: what a place means may change at any time.
        """
        return (self.info.code_id if self.info is not None else None) or ""

    async def refresh(self) -> None:
        """Reads the state of the runtime now, and notifies the listeners of changes."""
        async with self._refreshing:
            client = self._client
            if client is not None:
                await self._read_facts(client)

    def state(self) -> RuntimeState:
        """The state for clients."""
        info = self.info
        return RuntimeState(
            id=self.id,
            name=self.name,
            url=self.url,
            connected=self.connected,
            since=self.since,
            state=info.state if info else None,
            application=info.application if info else None,
            code_id=info.code_id if info else None,
            data_id=info.data_id if info else None,
            exception=exception_of(self.exception),
            scheduling="; ".join(info.scheduling) or None if info else None,
            problem=self.problem,
            halted=info.halted if info else (),
            debug_sequence=info.debug_sequence if info else 0,
        )

    # -- keeping the connection ----------------------------------------------------------------------

    async def _keep(self) -> None:
        pause = self._first_pause_s
        while True:
            await self._moved.wait()  # the local runtime has no address before it is up
            try:
                # wait_for would forget that it was cancelled when what it waits for ends in that moment.
                async with asyncio.timeout(PATIENCE_S):
                    client = await self._connect(self.url, self._token)
            except (OSError, RuntimeRefused, TimeoutError) as error:
                self._set_problem(_reason(error))
            else:
                pause = self._first_pause_s
                try:
                    await self._serve(client)
                except (OSError, RuntimeRefused, TimeoutError) as error:
                    self._set_problem(_reason(error))
                finally:
                    self._drop()
                    with suppress(OSError, RuntimeRefused):
                        await client.close()
            await asyncio.sleep(pause)
            pause = min(pause * 2, LONGEST_PAUSE_S)

    async def _serve(self, client: PlcClient) -> None:
        """Follows the events of a fresh connection until it is lost."""
        lost = asyncio.Event()

        def on_event(event: RuntimeEvent) -> None:
            if event.kind == "lost":
                lost.set()
            self._dirty.set()

        client.on_event(on_event)
        self.info = None  # the runtime may be another one now: whatever was known must be asked again
        await self._read_facts(client, connecting=True)
        while not lost.is_set():
            await self._dirty.wait()
            self._dirty.clear()
            if not lost.is_set():
                async with self._refreshing:
                    await self._read_facts(client)
        self._set_problem("The connection was lost")

    async def _read_facts(self, client: PlcClient, *, connecting: bool = False) -> None:
        old = self.info
        before = (self.state().model_dump(exclude={"since"}), set(self.forced.values()))
        info = await client.call(GetInfo())
        exception = await client.call(GetException()) if info.state == "exception" else None
        other = old is None or (old.instance_id, old.code_id, old.data_id) != (
            info.instance_id,
            info.code_id,
            info.data_id,
        )
        symbols = self.symbols
        if other:
            symbols = await client.symbols() if info.code_id else None
        forces = await client.call(ListForces()) if symbols is not None else []
        self.info, self.exception, self.symbols = info, exception, symbols
        self.forced = {(force.offset, force.bit): path_of(force) for force in forces}
        self.forced_sizes = {(force.offset, force.bit): len(force.data) for force in forces}
        if connecting:
            self._client = client
            self.since = datetime.now(UTC)
            self.problem = None
        state, forced = before
        if other or connecting:
            self._notify(Change.APPLICATION)
        if state != self.state().model_dump(exclude={"since"}):
            self._notify(Change.STATE)
        if other or connecting or forced != set(self.forced.values()):
            self._notify(Change.FORCES)

    def _drop(self) -> None:
        if self._client is not None:
            self._client = None
            self.since = datetime.now(UTC)
            self._notify(Change.STATE)

    def _set_problem(self, text: str) -> None:
        if text != self.problem:
            self.problem = text
            log.info("runtime %s: %s", self.name, text)
            if self._client is None:
                self._notify(Change.STATE)

    def _notify(self, change: Change) -> None:
        for listener in tuple(self._listeners):
            listener(change)

    def _no_application(self) -> Problem:
        return Problem(409, "no-application", f"There is no application in '{self.name}'; download one.")

    def _refused(self, error: RuntimeRefused) -> Problem:
        if error.code == "no_application":
            return self._no_application()
        if error.code == "disk_full":
            return disk_full(f"'{self.name}': {error}")
        if error.code == "not_found":
            return Problem(404, "not-found", f"'{self.name}': {error}.")
        return Problem(409, "runtime-refused", f"'{self.name}' refused: {error}")

    def _not_connected(self) -> Problem:
        return Problem(
            503,
            "runtime-not-connected",
            f"The runtime '{self.name}' is not connected since {self.since:%Y-%m-%d %H:%M:%S} UTC"
            + (f": {self.problem}." if self.problem else "."),
            since=self.since,
        )


class RuntimeRegistry:
    """All runtimes by id."""

    def __init__(self, connect: Connect, first_pause_s: float) -> None:
        self._connect = connect
        self._first_pause_s = first_pause_s
        self._links: dict[str, RuntimeLink] = {}
        self._recordings: dict[str, RuntimeLink] = {}
        """What is looked at in place of a runtime, the one opened last at the end."""

    def add(self, name: str, url: str, token: str, id: str | None = None) -> RuntimeLink:
        """Begins to keep a connection."""
        link = RuntimeLink(id or uuid.uuid4().hex, name, url, token, self._connect, self._first_pause_s)
        self._links[link.id] = link
        link.start()
        return link

    def all(self) -> list[RuntimeLink]:
        """In the order they were added."""
        return list(self._links.values())

    def find(self, runtime_id: str) -> RuntimeLink | None:
        """The runtime, or None."""
        return self._links.get(runtime_id) or self._recordings.get(runtime_id)

    def get(self, runtime_id: str) -> RuntimeLink:
        """The runtime; raises a 404 problem."""
        link = self.find(runtime_id)
        if link is None:
            raise not_found("runtime", runtime_id)
        return link

    async def open_recording(self, id: str, name: str, make: Callable[[], PlcClient]) -> RuntimeLink:
        """The link to a recording, which `make` reads on a thread unless it is open. No runtime is one of
        these: they are found by their id alone, and the oldest goes when there are many."""
        link = self._recordings.pop(id, None)
        if link is None:
            client = await asyncio.to_thread(make)

            async def connect(url: str, token: str) -> PlcClient:
                return client

            link = RuntimeLink(id, name, "recording:", "", connect, self._first_pause_s)
            connected = asyncio.Event()
            ended = link.listen(lambda _: connected.set())
            link.start()
            async with asyncio.timeout(PATIENCE_S):
                await connected.wait()
            ended()
        self._recordings[id] = link
        while len(self._recordings) > MOST_RECORDINGS:
            await self._recordings.pop(next(iter(self._recordings))).close()
        return link

    async def remove(self, runtime_id: str) -> RuntimeLink:
        """Gives a runtime up; it continues to run by itself."""
        link = self.get(runtime_id)
        (self._links if runtime_id in self._links else self._recordings).pop(runtime_id)
        await link.close()
        return link

    async def close(self) -> None:
        """Gives all up."""
        links = (*self._links.values(), *self._recordings.values())
        await asyncio.gather(*(link.close() for link in links))


def path_of(force: ForcedValue) -> str:
    """Path of a forced variable, or its place when it has none."""
    bit = "" if force.bit is None else f".{force.bit}"
    return force.path or f"image offset {force.offset}{bit}"


def _reason(error: Exception) -> str:
    if isinstance(error, TimeoutError):
        return "It does not answer"
    return str(error) or type(error).__name__
