"""The analysis service of a server: the open projects, and which of them have a process."""

from __future__ import annotations

import asyncio
import itertools
import logging
from collections.abc import Sequence
from contextlib import suppress

from tappet.project.store import Store
from tappet.project.store.records import ChangeEvent
from tappet.server.analysis.client import Client
from tappet.server.analysis.process import COMMAND, WorkerProcess
from tappet.server.analysis.project import AnalysedProject, Limits

IDLE_S = 300.0
"""The process of a project without clients ends after this time."""
MOST_IDLE = 2
"""Processes of projects without clients; of more, those that wait longest end at once."""

log = logging.getLogger(__name__)


class AnalysisService:
    """Made in the event loop that it lives in; `close` ends all processes."""

    def __init__(
        self, store: Store, limits: Limits, *, idle_s: float = IDLE_S, command: Sequence[str] = COMMAND
    ) -> None:
        self._store = store
        self._limits = limits
        self._idle_s = idle_s
        self._command = tuple(command)
        self._loop = asyncio.get_running_loop()
        self._numbers = itertools.count(1)
        self._projects: dict[str, AnalysedProject] = {}
        self._idle: dict[str, asyncio.TimerHandle] = {}
        """Ends of projects without clients, oldest first."""
        self._spare: WorkerProcess | None = None
        self._ending: set[asyncio.Task[None]] = set()
        self._stop = store.listen(self._stored)

    @property
    def projects(self) -> dict[str, AnalysedProject]:
        """The open projects by id."""
        return self._projects

    async def warm(self) -> None:
        """Start a process before anybody opens a project: the first one need not wait for it."""
        if self._spare is None:
            self._spare = await WorkerProcess.start(self._command)

    async def _process(self) -> WorkerProcess:
        spare, self._spare = self._spare, None
        if spare is not None:
            if spare.is_running:
                return spare
            await spare.end()
        return await WorkerProcess.start(self._command)

    def attach(self, project_id: str) -> Client:
        """A browser opens a project."""
        timer = self._idle.pop(project_id, None)
        if timer is not None:
            timer.cancel()
        project = self._projects.get(project_id)
        if project is None:
            project = AnalysedProject(project_id, self._store, self._limits, self._process)
            self._projects[project_id] = project
        client = Client(next(self._numbers))
        project.attach(client)
        return client

    async def receive(self, project_id: str, client: Client, text: str) -> None:
        """A message of a browser."""
        await self._projects[project_id].receive(client, text)

    def detach(self, project_id: str, client: Client) -> None:
        """A browser has gone."""
        project = self._projects.get(project_id)
        if project is None:
            return
        project.detach(client)
        if not project.clients and project_id not in self._idle:
            self._idle[project_id] = self._loop.call_later(self._idle_s, self._end, project_id)
            while len(self._idle) > MOST_IDLE:
                oldest = next(iter(self._idle))
                self._idle[oldest].cancel()
                self._end(oldest)

    def _end(self, project_id: str) -> None:
        self._idle.pop(project_id, None)
        project = self._projects.get(project_id)
        if project is not None and not project.clients:
            del self._projects[project_id]
            task = self._loop.create_task(project.close())
            self._ending.add(task)
            task.add_done_callback(self._ending.discard)

    def libraries_changed(self) -> None:
        """Libraries have been installed or removed. Any thread may say so."""

        def notify() -> None:
            for project in self._projects.values():
                project.libraries_changed()

        with suppress(RuntimeError):  # the loop has ended
            self._loop.call_soon_threadsafe(notify)

    def project_deleted(self, project_id: str) -> None:
        """A project is gone: its browsers are notified. Any thread may say so."""

        def notify() -> None:
            project = self._projects.get(project_id)
            if project is not None:
                project.deleted()

        with suppress(RuntimeError):  # the loop has ended
            self._loop.call_soon_threadsafe(notify)

    def _stored(self, event: ChangeEvent) -> None:
        """Called by the store, in the thread that has written."""
        with suppress(RuntimeError):  # the loop has ended
            self._loop.call_soon_threadsafe(self._changed, event)

    def _changed(self, event: ChangeEvent) -> None:
        project = self._projects.get(event.project_id)
        if project is not None:
            project.changed(event)

    async def close(self) -> None:
        """End all processes; none is left behind."""
        self._stop()
        for timer in self._idle.values():
            timer.cancel()
        spare, self._spare = self._spare, None
        await asyncio.gather(
            *(project.close() for project in self._projects.values()),
            *self._ending,
            *([spare.end()] if spare is not None else []),
        )
        self._projects.clear()
