"""The runtime that the server starts on its own machine, and starts again when it dies."""

from __future__ import annotations

import asyncio
import logging
from contextlib import suppress
from pathlib import Path

from tappet.runtime.process import Endpoint, RuntimeProcess, StartError
from tappet.server.runtimes.links import RuntimeLink

log = logging.getLogger(__name__)
LONGEST_PAUSE_S = 30.0
"""Between two attempts to start the process: as long as it waits itself when it keeps dying."""


class LocalRuntime:
    """Keeps the process alive and gives its link the address. Starting does not hold the server up.

    A start that fails is repeated after `first_pause_s`, then after twice that, and so on; until one succeeds
    the link says what the process printed last and when the next attempt follows.
    """

    def __init__(
        self, link: RuntimeLink, folder: Path, options: tuple[str, ...] = (), first_pause_s: float = 1.0
    ) -> None:
        self._link = link
        self._folder = folder
        self._options = options
        self._first_pause_s = first_pause_s
        self._process: RuntimeProcess | None = None
        self._closing = asyncio.Event()
        self._starting = asyncio.create_task(self._start(), name="start local runtime")

    async def _start(self) -> None:
        self._link.note("it is starting")
        pause = self._first_pause_s
        while not self._closing.is_set():
            try:
                self._process = await RuntimeProcess.start(
                    self._folder, options=self._options, on_exit=self._on_exit, on_ready=self._on_ready
                )
                return
            except (StartError, OSError) as error:
                log.error("the local runtime did not start: %s", error)
                self._link.note(f"{error}; the next attempt follows in {pause:g} s")
            with suppress(TimeoutError):
                async with asyncio.timeout(pause):
                    await self._closing.wait()
            pause = min(pause * 2, LONGEST_PAUSE_S)

    def _on_ready(self, endpoint: Endpoint) -> None:
        self._link.move_to(endpoint.url, endpoint.token)

    def _on_exit(self, reason: str) -> None:
        info = self._link.info
        if info is not None and info.application is not None:
            reason = f"{reason} while '{info.application}' was loaded (state {info.state})"
        log.warning("local runtime: %s", reason)
        self._link.note(reason)

    async def close(self) -> None:
        """Ends the process; it stops its application and keeps the remanent values."""
        self._closing.set()
        if not self._starting.done():
            # A process that is just coming up is waited for, or it would be left behind.
            with suppress(asyncio.CancelledError):
                await self._starting
        if self._process is not None:
            await self._process.stop()
