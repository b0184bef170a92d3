"""Compiles modules in several processes: llvmlite has one lock for all threads of a process.

The processes stay for the next build and end with this one.
"""

from __future__ import annotations

import atexit
import json
import os
import subprocess
import sys
import threading
from concurrent.futures import Future
from dataclasses import asdict
from queue import SimpleQueue

from tappet.codegen.compile_options import LlvmError, OptimiseOptions
from tappet.codegen.object_cache import ObjectCache

MAX_WORKERS = 8
"""More processes than this gain nothing for applications of usual size."""

_Job = tuple[str, OptimiseOptions, "Future[bytes]"]


class WorkerLostError(RuntimeError):
    """A compiler process ended without an answer: out of memory, or killed."""


class CompilePool:
    """Worker processes, each fed by a thread."""

    def __init__(self, workers: int) -> None:
        self._jobs: SimpleQueue[_Job | None] = SimpleQueue()
        self._threads = [
            threading.Thread(target=self._feed, name=f"compile-{n}", daemon=True) for n in range(workers)
        ]
        for thread in self._threads:
            thread.start()

    def submit(self, text: str, options: OptimiseOptions) -> Future[bytes]:
        """Object of a module; the future raises LlvmError or WorkerLostError."""
        future: Future[bytes] = Future()
        self._jobs.put((text, options, future))
        return future

    def close(self) -> None:
        """End the processes once their jobs are done."""
        for _ in self._threads:
            self._jobs.put(None)
        for thread in self._threads:
            thread.join()

    def _feed(self) -> None:
        process = _start()
        try:
            while (job := self._jobs.get()) is not None:
                text, options, future = job
                if not future.set_running_or_notify_cancel():
                    continue
                try:
                    future.set_result(_compile(process, text, options))
                except LlvmError as error:
                    future.set_exception(error)
                except (OSError, ValueError, EOFError) as error:
                    future.set_exception(WorkerLostError(f"a compiler process ended: {error}"))
                    process.kill()
                    process.wait()
                    process = _start()
        finally:
            if process.stdin is not None:
                process.stdin.close()
            process.wait()


def _start() -> subprocess.Popen[bytes]:
    return subprocess.Popen(
        [sys.executable, "-m", "tappet.codegen.compile_worker"], stdin=subprocess.PIPE, stdout=subprocess.PIPE
    )


def _compile(process: subprocess.Popen[bytes], text: str, options: OptimiseOptions) -> bytes:
    assert process.stdin is not None
    assert process.stdout is not None
    data = text.encode()
    head = json.dumps(asdict(options)).encode() + b"\n" + len(data).to_bytes(8, "little")
    process.stdin.write(head + data)
    process.stdin.flush()
    status = process.stdout.read(1)
    if not status:
        raise EOFError("no answer")
    size = int.from_bytes(process.stdout.read(8), "little")
    answer = process.stdout.read(size)
    if len(answer) != size:
        raise EOFError("half an answer")
    if status == b"\1":
        raise LlvmError(answer.decode(), text)
    return answer


class _Shared:
    """The pool of this process."""

    pool: CompilePool | None = None
    lock = threading.Lock()


def is_warm() -> bool:
    """Whether the pool of this process has been started."""
    return _Shared.pool is not None


def shared_pool() -> CompilePool:
    """The pool of this process, started at the first call."""
    with _Shared.lock:
        if _Shared.pool is None:
            _Shared.pool = CompilePool(min(os.cpu_count() or 1, MAX_WORKERS))
            atexit.register(_Shared.pool.close)
        return _Shared.pool


class Compilation:
    """The modules of one build on their way to objects; work begins with the first module added."""

    def __init__(self, cache: ObjectCache, options: OptimiseOptions, parallel: bool) -> None:
        self.cache = cache
        self.options = options
        self.parallel = parallel
        self._results: list[tuple[str, bytes | Future[bytes]]] = []

    def add(self, text: str) -> str:
        """Take a module: from the cache, or compiled here or in another process. Its key in the cache."""
        name = self.cache.key(text, self.options)
        self._add(name, text)
        return name

    def _add(self, name: str, text: str) -> None:
        if not self.parallel:
            self._results.append((name, self.cache.compile(text, self.options)))
            return
        data = self.cache.read(name)
        if data is not None:
            self.cache.hits += 1
            self._results.append((name, data))
            return
        self._results.append((name, shared_pool().submit(text, self.options)))

    def objects(self) -> list[bytes]:
        """All objects in the order of their modules; raises LlvmError or WorkerLostError."""
        try:
            return [self._take(name, result) for name, result in self._results]
        except BaseException:
            self._give_up()
            raise

    def _take(self, name: str, result: bytes | Future[bytes]) -> bytes:
        if isinstance(result, bytes):
            return result
        data = result.result()
        self.cache.write(name, data)
        return data

    def _give_up(self) -> None:
        """Keep what is done, and leave out what has not begun."""
        for name, result in self._results:
            if isinstance(result, bytes) or result.cancel() or not result.done():
                continue
            if result.exception() is None:
                self.cache.write(name, result.result())
