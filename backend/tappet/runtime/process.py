"""Runs a runtime as a child process and starts it again when it dies."""

from __future__ import annotations

import asyncio
import contextlib
import json
import os
import signal
import sys
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path

START_TIMEOUT_S = 60.0
"""A first start compiles the executive."""
STOP_TIMEOUT_S = 15.0
_FIRST_BACKOFF_S, _LONGEST_BACKOFF_S = 0.2, 30.0
_STABLE_S = 30.0
"""A process that lived so long is restarted without waiting."""


class StartError(RuntimeError):
    """The runtime process did not come up; the message carries what it printed last."""


@dataclass(frozen=True, slots=True)
class Endpoint:
    """How to reach a running runtime."""

    url: str
    token: str
    instance_id: str
    pid: int


class RuntimeProcess:
    """A supervised runtime on this machine. It ends when this process does, however that happens: a pipe of
    which this process holds the other end is its lifeline.

    `on_exit(reason)` is called, on the event loop, whenever the process ended by itself; `on_ready(endpoint)`
    whenever one is up, the first time included.
    """

    def __init__(
        self,
        folder: Path,
        port: int,
        *,
        options: Sequence[str] = (),
        on_exit: Callable[[str], None] | None = None,
        on_ready: Callable[[Endpoint], None] | None = None,
        restart: bool = True,
    ) -> None:
        self.folder = folder
        self.port = port
        self.options = tuple(options)
        self.on_exit = on_exit
        self.on_ready = on_ready
        self.restart = restart
        self.endpoint: Endpoint | None = None
        """None while no process is up."""
        self.last_lines: list[str] = []
        self._process: asyncio.subprocess.Process | None = None
        self._watch: asyncio.Task[None] | None = None
        self._reader: asyncio.Task[None] | None = None
        self._stopping = False
        self._lifeline: int | None = None

    @classmethod
    async def start(
        cls,
        data_dir: Path,
        port: int = 0,
        *,
        options: Sequence[str] = (),
        on_exit: Callable[[str], None] | None = None,
        on_ready: Callable[[Endpoint], None] | None = None,
        restart: bool = True,
    ) -> RuntimeProcess:
        """Start a runtime on `data_dir` and wait until it listens; StartError when it does not."""
        process = cls(data_dir, port, options=options, on_exit=on_exit, on_ready=on_ready, restart=restart)
        try:
            await process._spawn()
        except BaseException:
            process._cut_lifeline()
            raise
        process._watch = asyncio.create_task(process._supervise())
        return process

    async def _spawn(self) -> None:
        self._cut_lifeline()
        read_end, write_end = os.pipe()
        held, self._lifeline = os.pipe()
        try:
            process = await asyncio.create_subprocess_exec(
                sys.executable, "-m", "tappet.runtime", "--data", str(self.folder), "--port", str(self.port),
                "--ready-fd", str(write_end), "--lifeline-fd", str(held), *self.options,
                pass_fds=(write_end, held), stdin=asyncio.subprocess.DEVNULL, stderr=asyncio.subprocess.PIPE,
                stdout=asyncio.subprocess.DEVNULL,
            )  # fmt: skip
        except OSError:
            os.close(read_end)
            raise
        finally:
            os.close(write_end)
            os.close(held)
        self._process = process
        self._reader = asyncio.create_task(self._read_lines(process))
        try:
            async with asyncio.timeout(START_TIMEOUT_S):
                text = await asyncio.to_thread(_read_all, read_end)
        except TimeoutError:
            process.kill()
            await process.wait()
            raise StartError(f"the runtime did not come up within {START_TIMEOUT_S:g} s") from None
        try:
            ready = json.loads(text)
            self.endpoint = Endpoint(
                f"ws://127.0.0.1:{ready['port']}", ready["token"], ready["instance_id"], process.pid
            )
        except (ValueError, KeyError, TypeError):
            ended = await self._end_of(process)
            await asyncio.gather(self._reader, return_exceptions=True)
            said = " / ".join(self.last_lines[-3:]) or "no output"
            raise StartError(f"the runtime did not come up: {ended}: {said}") from None
        self.port = int(ready["port"])  # a restarted runtime is found at the same place
        if self.on_ready is not None:
            self.on_ready(self.endpoint)

    async def _end_of(self, process: asyncio.subprocess.Process) -> str:
        """Why a process ended that has closed its pipe; killed if it has not."""
        try:
            async with asyncio.timeout(STOP_TIMEOUT_S):
                return describe_exit(await process.wait())
        except TimeoutError:
            process.kill()
            await process.wait()
            return "it hung"

    async def _read_lines(self, process: asyncio.subprocess.Process) -> None:
        assert process.stderr is not None
        async for line in process.stderr:
            self.last_lines.append(line.decode("utf-8", "replace").rstrip())
            del self.last_lines[:-200]

    async def _supervise(self) -> None:
        loop = asyncio.get_running_loop()
        backoff = _FIRST_BACKOFF_S
        while True:
            begun = loop.time()
            assert self._process is not None
            code = await self._process.wait()
            self.endpoint = None
            if self._stopping:
                return
            if self.on_exit is not None:
                self.on_exit(describe_exit(code))
            if not self.restart:
                return
            backoff = _FIRST_BACKOFF_S if loop.time() - begun > _STABLE_S else backoff
            while not self._stopping:
                await asyncio.sleep(backoff)
                backoff = min(backoff * 2, _LONGEST_BACKOFF_S)
                try:
                    await self._spawn()
                    break
                except (StartError, OSError) as error:
                    if self.on_exit is not None:
                        self.on_exit(str(error))
            if self._stopping:
                return

    def _cut_lifeline(self) -> None:
        if self._lifeline is not None:
            os.close(self._lifeline)
            self._lifeline = None

    async def stop(self) -> None:
        """End the process properly: it stops the application, saves remanent values. Killed if it hangs."""
        self._stopping = True
        process = self._process
        if process is not None and process.returncode is None:
            with contextlib.suppress(ProcessLookupError):
                process.send_signal(signal.SIGTERM)
            try:
                async with asyncio.timeout(STOP_TIMEOUT_S):
                    await process.wait()
            except TimeoutError:
                process.kill()
                await process.wait()
        for task in (self._watch, self._reader):
            if task is not None:
                task.cancel()
                await asyncio.gather(task, return_exceptions=True)
        self._cut_lifeline()
        self.endpoint = None


def _read_all(fd: int) -> str:
    with os.fdopen(fd, "r") as pipe:
        return pipe.read()


def describe_exit(code: int) -> str:
    """Why a process ended, in words."""
    if code >= 0:
        return f"the runtime process ended with exit code {code}"
    try:
        name = signal.Signals(-code).name
    except ValueError:
        name = f"signal {-code}"
    return f"the runtime process was ended by {name}"
