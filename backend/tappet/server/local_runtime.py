"""The runtime that the server starts on its own machine, and starts again when it dies."""

from __future__ import annotations

import asyncio
import logging
from contextlib import suppress
from pathlib import Path

from tappet.runtime.process import Endpoint, RuntimeProcess, StartError
from tappet.server.runtimes import RuntimeLink

log = logging.getLogger(__name__)


class LocalRuntime:
    """Keeps the process alive and tells its link where it listens. Starting does not hold the server up."""

    def __init__(self, link: RuntimeLink, folder: Path, options: tuple[str, ...] = ()) -> None:
        self._link = link
        self._folder = folder
        self._options = options
        self._process: RuntimeProcess | None = None
        self._starting = asyncio.create_task(self._start(), name="start local runtime")

    async def _start(self) -> None:
        self._link.note("it is starting")
        try:
            self._process = await RuntimeProcess.start(
                self._folder, options=self._options, on_exit=self._on_exit, on_ready=self._on_ready
            )
        except (StartError, OSError) as error:
            log.exception("the local runtime did not start")
            self._link.note(str(error))

    def _on_ready(self, endpoint: Endpoint) -> None:
        self._link.move_to(endpoint.url, endpoint.token)

    def _on_exit(self, reason: str) -> None:
        log.warning("local runtime: %s", reason)
        self._link.note(reason)

    async def close(self) -> None:
        """Ends the process; it stops its application and keeps the remanent values."""
        if not self._starting.done():
            # A process that is just coming up is waited for, or it would be left behind.
            with suppress(asyncio.CancelledError):
                await self._starting
        if self._process is not None:
            await self._process.stop()
