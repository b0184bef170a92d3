"""A worker process as the web server sees it: an order goes there, its outcome comes back.

What takes long or may crash is done there: builds, curves of cams. The program reads frames from its
standard input and writes one to its standard output for each; `crash` in an outcome says that it failed.
"""

from __future__ import annotations

import asyncio
from collections.abc import Sequence
from contextlib import suppress
from typing import Any

import msgpack

from tappet.server.frames import CANCEL, LARGEST_FRAME, LENGTH, pack_frame

GRACE_S = 3.0
"""A process that does not end a cancelled order within this time is killed."""


class WorkerCrashedError(RuntimeError):
    """The process died or failed; a fault of the product, not of what it was given."""


class WorkerProcess:
    """One process, started when it is first needed and again after it was killed."""

    def __init__(self, command: Sequence[str]) -> None:
        self._command = tuple(command)
        self._process: asyncio.subprocess.Process | None = None
        self._turn = asyncio.Lock()

    async def ask(self, order: dict[str, Any]) -> dict[str, Any]:
        """One order; when this call is cancelled, the process ends it and keeps its caches.

        Raises WorkerCrashedError.
        """
        async with self._turn:
            process = await self._start()
            exchange = asyncio.create_task(self._exchange(process, order))
            try:
                return await asyncio.shield(exchange)
            except asyncio.CancelledError:
                ready = False
                try:
                    ready = await _ends(process, exchange)
                finally:
                    if not ready:
                        await self._kill()
                raise
            except BaseException:
                await self._kill()
                raise

    async def warm(self) -> None:
        """Starts the process."""
        async with self._turn:
            await self._start()

    async def _start(self) -> asyncio.subprocess.Process:
        if self._process is None or self._process.returncode is not None:
            self._process = await asyncio.create_subprocess_exec(
                *self._command, stdin=asyncio.subprocess.PIPE, stdout=asyncio.subprocess.PIPE
            )
        return self._process

    async def _exchange(self, process: asyncio.subprocess.Process, order: dict[str, Any]) -> dict[str, Any]:
        assert process.stdin is not None
        assert process.stdout is not None
        frame = await asyncio.to_thread(pack_frame, order)
        try:
            process.stdin.write(frame)
            await process.stdin.drain()
            head = await process.stdout.readexactly(LENGTH.size)
            body = await process.stdout.readexactly(LENGTH.unpack(head)[0])
        except (OSError, asyncio.IncompleteReadError):
            raise WorkerCrashedError("its process ended") from None
        outcome: dict[str, Any] = await asyncio.to_thread(
            msgpack.unpackb, body, raw=False, max_bin_len=LARGEST_FRAME
        )
        if "crash" in outcome:
            raise WorkerCrashedError(outcome["crash"])
        return outcome

    async def _kill(self) -> None:
        process, self._process = self._process, None
        if process is not None and process.returncode is None:
            with suppress(ProcessLookupError):
                process.kill()
            await process.wait()

    async def close(self) -> None:
        """Ends the process."""
        await self._kill()


async def _ends(process: asyncio.subprocess.Process, exchange: asyncio.Task[dict[str, Any]]) -> bool:
    """Whether a process ends its order on request, and is ready for the next one."""
    with suppress(ProcessLookupError):
        process.send_signal(CANCEL)
    await asyncio.wait([exchange], timeout=GRACE_S)
    if not exchange.done():
        exchange.cancel()
        return False
    return exchange.exception() is None
