"""The process that analyses one project: reads messages of the web server, writes those for its sessions.

It ends when its input ends, that is with the server, however that ended.
"""

from __future__ import annotations

import asyncio
import faulthandler
import gc
import os
import sys
from collections.abc import Callable
from concurrent.futures import Future, ThreadPoolExecutor
from contextlib import suppress
from typing import Any

from msgspec.structs import asdict

from tappet.project.model import Project, ProjectObject
from tappet.project.objects import make_object
from tappet.server.analysis import messages
from tappet.server.analysis.messages import Attach, Begin, Detach, Exit, Receive, Send, StoredTexts
from tappet.server.lsp.library_names import libraries_with
from tappet.server.lsp.open_documents import OpenDocument
from tappet.server.lsp.project_analysis import ProjectAnalysis
from tappet.server.lsp.project_programs import ProjectPrograms
from tappet.server.lsp.rpc import Outgoing
from tappet.server.lsp.session import Attached, LanguageSession

OUT_OF_MEMORY = 71
"""Exit code of a worker that has reached its limit."""
TOO_LONG = 1
"""Exit code of a worker whose work took too long: that of `faulthandler`, which ends it."""


class BoundedThread(ThreadPoolExecutor):
    """One thread whose work has a time limit; work without end, or out of memory, ends the process."""

    def __init__(self, seconds: float) -> None:
        super().__init__(max_workers=1, thread_name_prefix="analysis")
        self._seconds = seconds

    def submit(self, fn: Callable[..., Any], /, *args: Any, **kwargs: Any) -> Future[Any]:
        """Work to be done, in order."""
        return super().submit(self._bounded, fn, *args, **kwargs)

    def _bounded(self, fn: Callable[..., Any], *args: Any, **kwargs: Any) -> Any:
        # a watchdog in C: Python code that keeps the interpreter to itself cannot hold it up
        faulthandler.dump_traceback_later(self._seconds, exit=True)
        try:
            return fn(*args, **kwargs)
        except MemoryError:
            os._exit(OUT_OF_MEMORY)
        finally:
            faulthandler.cancel_dump_traceback_later()


class Worker:
    """The project and its sessions."""

    def __init__(self, writer: asyncio.StreamWriter) -> None:
        self._writer = writer
        self._objects: dict[str, ProjectObject] = {}
        self._name = ""
        self._programs: ProjectPrograms | None = None
        self._analysis: ProjectAnalysis | None = None
        self._sessions: dict[int, LanguageSession] = {}
        self._leaving: set[asyncio.Task[Any]] = set()

    async def take(self, message: messages.ToWorker) -> None:
        """Do what the server says."""
        match message:
            case Begin():
                self._begin(message)
            case StoredTexts():
                self._store(message)
            case messages.LibrariesChanged():
                self._changed()
            case Attach():
                self._attach(message)
            case Receive():
                if message.session in self._sessions:
                    await self._sessions[message.session].receive(message.text)
            case Detach():
                session = self._sessions.pop(message.session, None)
                if session is not None:
                    self._keep(session.close())

    def _begin(self, order: Begin) -> None:
        _limit_memory(order.memory_mib)
        self._programs = ProjectPrograms(order.project_id, lambda: Project(self._name, "", self._objects))
        self._analysis = ProjectAnalysis(
            self._programs, stored=self._programs.stored, thread=BoundedThread(order.seconds)
        )

    def _store(self, stored: StoredTexts) -> None:
        changed = {item.id: make_object(**asdict(item)) for item in stored.objects}
        kept = {id: item for id, item in self._objects.items() if id not in stored.gone}
        self._name, self._objects = stored.name, kept | changed
        self._changed()

    def _changed(self) -> None:
        assert self._programs is not None
        assert self._analysis is not None
        self._programs.changed()
        self._analysis.stored_texts_changed()

    def _attach(self, order: Attach) -> None:
        assert self._analysis is not None

        async def send(message: Outgoing) -> None:
            answer = Send(order.session, message.text, message.answers, message.replaces)
            self._writer.write(messages.frame(answer))
            await self._writer.drain()

        session = LanguageSession(self._analysis, send, offering=libraries_with)
        self._sessions[order.session] = session
        documents = tuple(OpenDocument(d.uri, d.version, d.text) for d in order.documents)
        if order.initialize is not None or documents:
            session.take_over(
                Attached(order.initialize, order.configuration, documents, tuple(order.published))
            )
        self._keep(self._report_exit(order.session, session))

    async def _report_exit(self, number: int, session: LanguageSession) -> None:
        await session.exit.wait()
        self._writer.write(messages.frame(Exit(number)))

    def _keep(self, work: Any) -> None:
        task = asyncio.ensure_future(work)
        self._leaving.add(task)
        task.add_done_callback(self._leaving.discard)


def _limit_memory(mib: int) -> None:
    """Bound the address space, where the system can."""
    with suppress(ImportError, ValueError, OSError):
        import resource  # not on every system

        resource.setrlimit(resource.RLIMIT_AS, (mib << 20, resource.getrlimit(resource.RLIMIT_AS)[1]))


async def _serve(input_: int, output: int) -> None:
    loop = asyncio.get_running_loop()
    reader = asyncio.StreamReader(limit=messages.LIMIT_BUFFERED)
    await loop.connect_read_pipe(lambda: asyncio.StreamReaderProtocol(reader), os.fdopen(input_, "rb", 0))
    transport, protocol = await loop.connect_write_pipe(
        asyncio.streams.FlowControlMixin, os.fdopen(output, "wb", 0)
    )
    worker = Worker(asyncio.StreamWriter(transport, protocol, None, loop))
    async for message in messages.messages_to_worker(reader):
        await worker.take(message)


def main() -> None:
    """Serves until the input ends."""
    input_, output = os.dup(0), os.dup(1)
    null = os.open(os.devnull, os.O_RDONLY)
    os.dup2(null, 0)
    os.dup2(2, 1)  # whatever prints in here must not get between the frames
    gc.freeze()  # what was imported stays
    code = 0
    try:
        asyncio.run(_serve(input_, output))
    except MemoryError:
        code = OUT_OF_MEMORY
    sys.stderr.flush()
    os._exit(code)  # at once: nobody waits for what the analysis does


if __name__ == "__main__":
    main()
