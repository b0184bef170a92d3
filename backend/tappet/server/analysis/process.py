"""A worker process as the web server sees it: its two pipes, how it ended and how to end it."""

from __future__ import annotations

import asyncio
import signal
import sys
from collections.abc import AsyncIterator, Sequence
from contextlib import suppress

from tappet.server.analysis import messages
from tappet.server.analysis.messages import FromWorker, ToWorker

COMMAND = (sys.executable, "-m", "tappet.server.analysis.worker")
GRACE_S = 2.0
"""A process that does not end with its input within this time is killed."""
OUT_OF_MEMORY = 71
TOO_LONG = 1
"""Exit codes, see `worker`."""


class WorkerProcess:
    """Made by `start`; `end` must be called."""

    def __init__(self, process: asyncio.subprocess.Process) -> None:
        self._process = process
        assert process.stdin is not None
        assert process.stdout is not None
        self._input, self._output = process.stdin, process.stdout

    @classmethod
    async def start(cls, command: Sequence[str] = COMMAND) -> WorkerProcess:
        """A process that waits for its project."""
        return cls(
            await asyncio.create_subprocess_exec(
                *command,
                stdin=asyncio.subprocess.PIPE,
                stdout=asyncio.subprocess.PIPE,
                limit=messages.LIMIT_BUFFERED,
            )
        )

    @property
    def pid(self) -> int:
        """Of the system."""
        return self._process.pid

    @property
    def is_running(self) -> bool:
        """Whether it has not ended yet."""
        return self._process.returncode is None

    def put(self, message: ToWorker) -> None:
        """Send a message; one to a process that has ended is lost."""
        if not self._input.is_closing():
            self._input.write(messages.frame(message))

    async def drain(self) -> None:
        """Wait until the process has taken most of what was sent."""
        with suppress(ConnectionError):
            await self._input.drain()

    def received(self) -> AsyncIterator[FromWorker]:
        """What the process says, until it ends."""
        return messages.messages_from_worker(self._output)

    async def ending(self) -> str:
        """Why the process ended, for people. Call when it has said its last."""
        try:
            async with asyncio.timeout(GRACE_S):
                code = await self._process.wait()
        except TimeoutError:
            return "it closed its output"
        if code == OUT_OF_MEMORY:
            return "it needed more memory than it may have"
        if code == TOO_LONG:
            return "it took too long, or failed"
        if code < 0:
            return f"it was ended by {signal.Signals(-code).name}"
        return f"exit code {code}"

    async def end(self) -> None:
        """End the process; it is gone afterwards."""
        self._input.close()
        try:
            async with asyncio.timeout(GRACE_S):
                await self._process.wait()
        except TimeoutError:
            with suppress(ProcessLookupError):
                self._process.kill()
            await self._process.wait()
