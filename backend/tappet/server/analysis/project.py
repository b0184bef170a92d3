"""A project with open editors: its clients, and the worker process that analyses it.

The process is started when the first client asks something, ends a while after the last one has gone, and
starts again with the next message when it has ended by itself. Its state is then replayed: the stored
objects from the database, everything else from what the clients keep.
"""

from __future__ import annotations

import asyncio
import logging
import time
from collections import deque
from collections.abc import Awaitable, Callable, Iterable
from contextlib import suppress
from dataclasses import dataclass

from tappet.project.errors import ProjectError
from tappet.project.model import ProjectObject
from tappet.project.store import Store
from tappet.project.store.records import ChangeEvent, ObjectSummary, UnknownProjectError
from tappet.project.store.rows import data_of, summary_of
from tappet.server.analysis.client import Client
from tappet.server.analysis.messages import (
    Begin,
    Detach,
    LibrariesChanged,
    Receive,
    Send,
    StoredObject,
    StoredTexts,
)
from tappet.server.analysis.process import WorkerProcess

CRASHES = 3
"""An analysis that ends so often within `WITHIN_S` is left alone for `PAUSE_S`."""
WITHIN_S = 60.0
PAUSE_S = 30.0
LOADED_ONE_BY_ONE = 20
"""Of more changed objects than these, the whole project is read."""
TRY_AGAIN = 1013
"""Close code of the WebSocket protocol."""
PROJECT_GONE = 4404
"""Close code: the project was deleted."""

log = logging.getLogger(__name__)


class AnalysisUnavailableError(RuntimeError):
    """The analysis has ended too often; the text says when it is tried again."""


@dataclass(frozen=True, slots=True)
class Limits:
    """What bounds a worker process."""

    memory_mib: int
    seconds: float


class AnalysedProject:
    """Lives in the event loop of the server."""

    def __init__(
        self, project_id: str, store: Store, limits: Limits, start: Callable[[], Awaitable[WorkerProcess]]
    ) -> None:
        """`start` gives a process that waits for its project."""
        self.project_id = project_id
        self.clients: dict[int, Client] = {}
        self._store = store
        self._limits = limits
        self._start_process = start
        self._process: WorkerProcess | None = None
        self._starting: asyncio.Task[None] | None = None
        self._reading: asyncio.Task[None] | None = None
        self._feeding: asyncio.Task[None] | None = None
        self._touched: set[str] | None = None
        """Objects that changes have touched since the worker was notified last; None: nothing has changed."""
        self._known: dict[str, ObjectSummary] = {}
        """Objects as the worker has them."""
        self._crashes: deque[float] = deque(maxlen=CRASHES)
        self._closed = False

    @property
    def process(self) -> WorkerProcess | None:
        """The process at work."""
        return self._process

    # -- clients

    def attach(self, client: Client) -> None:
        """A browser has opened the project."""
        self.clients[client.number] = client
        if self._process is not None:
            self._process.put(client.attach())

    def detach(self, client: Client) -> None:
        """A browser has gone."""
        self.clients.pop(client.number, None)
        if self._process is not None:
            self._process.put(Detach(client.number))

    async def receive(self, client: Client, text: str) -> None:
        """A message of a browser. Raises UnknownProjectError when the project is gone."""
        try:
            await self._ensure()
        except AnalysisUnavailableError as error:
            client.note(text)
            client.refuse(str(error))
            if client.begun() is not None:  # it cannot do without an answer: it is to connect again
                client.outbox.close(TRY_AGAIN, "The analysis is not available now.")
            return
        if self._feeding is not None:  # the answer knows what was stored before the message
            await asyncio.wait({self._feeding})
        process = self._process
        if process is None:  # ended again at once: the next message tries it again
            client.note(text)
            client.refuse("The analysis ended unexpectedly")
            return
        client.note(text)
        process.put(Receive(client.number, text))
        await process.drain()

    # -- the process

    async def _ensure(self) -> None:
        if self._process is not None:
            return
        if self._starting is None:
            wait = self._pause()
            if wait > 0:
                raise AnalysisUnavailableError(
                    f"The analysis of this project ended {CRASHES} times within a minute; it is tried again "
                    f"in {wait:.0f} s. The last edits may be what it fails at"
                )
            self._starting = asyncio.create_task(self._start(), name=f"analysis of {self.project_id}")
            self._starting.add_done_callback(self._started)
        await asyncio.shield(self._starting)

    def _pause(self) -> float:
        if len(self._crashes) < CRASHES or self._crashes[-1] - self._crashes[0] > WITHIN_S:
            return 0.0
        return self._crashes[-1] + PAUSE_S - time.monotonic()

    def _started(self, task: asyncio.Task[None]) -> None:
        self._starting = None
        if not task.cancelled() and task.exception() is not None:
            log.error("the analysis of %s did not start", self.project_id, exc_info=task.exception())

    async def _start(self) -> None:
        self._touched = None  # what changes from here on is in the project that is read, or sent again
        info, project = await asyncio.to_thread(self._store.snapshot, self.project_id)
        process = await self._start_process()
        if self._closed:
            await process.end()
            return
        process.put(Begin(self.project_id, self._limits.memory_mib, self._limits.seconds))
        process.put(StoredTexts(info.name, [_stored(item) for item in project.objects.values()], []))
        self._known = {item.id: summary_of(item) for item in project.objects.values()}
        for client in self.clients.values():
            process.put(client.attach())
            begun = client.begun()
            if begun is not None:
                process.put(Receive(client.number, begun))
        self._process = process
        self._reading = asyncio.create_task(self._read(process))
        self._feed_soon()

    async def _read(self, process: WorkerProcess) -> None:
        """Take what the process says; when it ends by itself, notify the clients."""
        try:
            async for message in process.received():
                client = self.clients.get(message.session)
                if client is None:
                    continue
                if isinstance(message, Send):
                    client.take(message)
                else:
                    client.outbox.close(1000, "")
        except Exception:
            log.exception("what the analysis of %s says is not understood", self.project_id)
        if self._process is not process:
            return
        self._process = None
        self._crashes.append(time.monotonic())
        reason = await process.ending()
        log.error("the analysis of %s ended: %s", self.project_id, reason)
        for client in list(self.clients.values()):
            client.lost(reason)
        await process.end()
        if any(client.begun() is not None for client in self.clients.values()):
            with suppress(AnalysisUnavailableError):  # the next request reports it
                await self._ensure()

    async def end(self) -> None:
        """End the process; a client that asks starts it again."""
        process, self._process = self._process, None
        if process is not None:
            await process.end()
        if self._reading is not None:
            await self._reading

    async def close(self) -> None:
        """End everything."""
        self._closed = True
        for task in (self._starting, self._feeding):
            if task is not None:
                task.cancel()
                await asyncio.gather(task, return_exceptions=True)
        await self.end()

    # -- what is stored

    def changed(self, event: ChangeEvent) -> None:
        """The stored project has changed."""
        self._touched = (self._touched or set()) | {change.summary.id for change in event.objects}
        self._feed_soon()

    def libraries_changed(self) -> None:
        """Libraries have been installed or removed."""
        if self._process is not None:
            self._process.put(LibrariesChanged())

    def deleted(self) -> None:
        """The project is gone."""
        for client in self.clients.values():
            client.outbox.close(PROJECT_GONE, "The project was deleted.")

    def _feed_soon(self) -> None:
        if self._process is not None and self._touched is not None and self._feeding is None:
            self._feeding = asyncio.create_task(self._feed())

    async def _feed(self) -> None:
        """Send the worker what has changed, until it has everything."""
        try:
            while self._process is not None and self._touched is not None:
                process, touched, self._touched = self._process, self._touched, None
                changed, known = await asyncio.to_thread(self._changes, touched, self._known)
                if process is self._process:
                    self._known = known
                    process.put(changed)
        except UnknownProjectError:
            self.deleted()
        except Exception:
            log.exception("changes of %s do not reach its analysis", self.project_id)
        finally:
            self._feeding = None

    def _changes(
        self, touched: set[str], known: dict[str, ObjectSummary]
    ) -> tuple[StoredTexts, dict[str, ObjectSummary]]:
        """What a worker that has `known` does not know yet. Blocks."""
        name = self._store.project(self.project_id).name
        now = {summary.id: summary for summary in self._store.tree(self.project_id)}
        other = [id for id, summary in now.items() if id in touched or summary != known.get(id)]
        gone = [id for id in known if id not in now]
        found = [_stored(item) for item in self._objects(other)]
        return StoredTexts(name, found, gone), now

    def _objects(self, wanted: list[str]) -> Iterable[ProjectObject]:
        if len(wanted) > LOADED_ONE_BY_ONE:
            objects = self._store.load(self.project_id).objects
            return [objects[id] for id in wanted if id in objects]
        found = []
        for id in wanted:
            try:
                found.append(self._store.get(self.project_id, id))
            except UnknownProjectError:
                raise
            except ProjectError:
                continue  # deleted since; that change is sent next
        return found


def _stored(item: ProjectObject) -> StoredObject:
    return StoredObject(
        item.id, item.parent_id, item.kind, item.name, item.index, item.revision, data_of(item)
    )
