"""Views of CNC paths: a process each, with a viser server that only this server reaches."""

from __future__ import annotations

import asyncio
import secrets
import shutil
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from tappet.server.paths.shapes import PathLooks
from tappet.server.problems import Problem, not_found
from tappet.server.views.service import ViewRegistry
from tappet.server.worker_process import WorkerCrashedError, WorkerProcess
from tappet.translation.language import Language

WORKER = (sys.executable, "-m", "tappet.server.paths.worker")
PATIENCE_S = 600.0
"""Longest time of an answer: programs of many megabytes are decoded."""


class PathView:
    """A `ViewServer` in a process of its own."""

    def __init__(self, worker: WorkerProcess, socket: Path, loop: asyncio.AbstractEventLoop) -> None:
        self._worker = worker
        self._loop = loop
        self.socket = socket

    async def ask(self, do: str, **facts: Any) -> dict[str, Any]:
        """An outcome; raises WorkerCrashedError and TimeoutError."""
        async with asyncio.timeout(PATIENCE_S):
            return await self._worker.ask({"do": do, **facts})

    def stop(self) -> None:
        """Ends the process; called in a thread."""
        asyncio.run_coroutine_threadsafe(self._worker.close(), self._loop).result()
        shutil.rmtree(self.socket.parent, ignore_errors=True)  # it was killed: nobody else does


class PathViews:
    """Those that run; they are `views` like all 3D views."""

    def __init__(self, views: ViewRegistry, cache: Path, command: Sequence[str] = WORKER) -> None:
        """`cache` is a folder of compiled objects."""
        self._views = views
        self._cache = str(cache)
        self._command = command

    async def begin(self, looks: PathLooks) -> str:
        """Id of a new view, in which nothing is drawn yet."""
        view_id = secrets.token_hex(9)
        worker = WorkerProcess(self._command)
        order = {"do": "open", "cache": self._cache, "looks": looks.model_dump_json()}
        try:
            outcome = await worker.ask(order)
            view = PathView(worker, Path(outcome["socket"]), asyncio.get_running_loop())
        except WorkerCrashedError as error:
            await worker.close()
            raise _failed(error) from error
        except BaseException:
            await worker.close()
            raise
        try:
            await self._views.start_view(view_id, lambda: view)
        except BaseException:
            await asyncio.to_thread(view.stop)
            raise
        return view_id

    async def ask(self, view_id: str, do: str, language: Language, **facts: Any) -> bytes:
        """The JSON of an answer.

        Raises problems: 404 for a view that does not run, 422 for settings that do not fit the library, 500
        when the process died, 503 when it takes too long.
        """
        view = self._views.server_of(view_id)
        if not isinstance(view, PathView):
            raise not_found("open 3D view", view_id)
        try:
            outcome = await view.ask(do, language=language, **facts)
        except TimeoutError:
            detail = (
                f"The path could not be made within {PATIENCE_S:g} s; the program is too long for a view."
            )
            raise Problem(503, "path-too-large", detail) from None
        except WorkerCrashedError as error:
            await self._views.stop_view(view_id)
            raise _failed(error) from error
        if "refusal" in outcome:
            raise Problem(422, "path-settings", outcome["refusal"])
        body: bytes = outcome["body"]
        return body

    async def end(self, view_id: str) -> None:
        """Ends a view of a path; nothing happens when it does not run."""
        try:
            view = self._views.server_of(view_id)
        except Problem:
            return
        if isinstance(view, PathView):
            await self._views.stop_view(view_id)


def _failed(error: WorkerCrashedError) -> Problem:
    return Problem(500, "path-failed", f"The path could not be drawn: {error}.")
