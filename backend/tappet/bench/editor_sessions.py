"""Many browsers on one project: what the first and the last of them cost, and an edit that all hear of.

The sessions are those of the server: clients of the analysis service, whose worker process reads the
project from a database. Only the network is missing. An edit goes in at one client; what is timed is when
each of the others has the messages, the pause for the typing to stop taken off. One edit is timed while the
application is built, too.
"""

from __future__ import annotations

import asyncio
import json
import os
import tempfile
import time
from contextlib import suppress
from dataclasses import dataclass, field
from pathlib import Path
from statistics import median
from typing import Any

from tappet.bench.report import Row
from tappet.project.model import Project
from tappet.project.store import Store
from tappet.server.analysis.client import Client
from tappet.server.analysis.project import Limits
from tappet.server.analysis.service import AnalysisService
from tappet.server.builds.builder import Application, Builder
from tappet.server.lsp.project_analysis import DEBOUNCE_S
from tappet.server.lsp.project_programs import part_uri
from tappet.server.lsp.utf16 import units

SESSIONS = 10
EDITS = 10
"""Edits that all sessions hear of; every second one takes the one before back."""
PATIENCE_S = 120.0
LIMITS = Limits(memory_mib=8192, seconds=120.0)
GOOD, BAD = "diErrors := diErrors + 1;", "diErrors := diErrors + unknown;"


@dataclass(frozen=True, slots=True)
class Memory:
    """Of processes, in MB."""

    pss: float
    """With a share of the pages that they have in common with others."""
    uss: float
    """Their own pages only."""

    @classmethod
    def of(cls, *pids: int) -> Memory:
        """What the system says; zeros where it does not."""
        pss = uss = 0.0
        for pid in pids:
            with suppress(OSError):
                for line in Path(f"/proc/{pid}/smaps_rollup").read_text(encoding="ascii").splitlines():
                    name, _, rest = line.partition(":")
                    kib = float(rest.split()[0]) if rest.strip().endswith("kB") else 0.0
                    pss += kib / 1000 if name == "Pss" else 0.0
                    uss += kib / 1000 if name in ("Private_Clean", "Private_Dirty") else 0.0
        return cls(pss, uss)


def replaced(text: str, old: str, new: str) -> tuple[str, dict[str, Any]]:
    """`text` with `new` in place of the first `old`, and the change as the protocol tells it."""
    start = text.index(old)
    line = text.count("\n", 0, start)
    column = units(text[text.rfind("\n", 0, start) + 1 : start], 1 << 20)
    span = {
        "start": {"line": line, "character": column},
        "end": {"line": line, "character": column + len(old)},
    }
    return text.replace(old, new, 1), {"range": span, "text": new}


@dataclass(slots=True)
class Browser:
    """A client that reads what is published of one document."""

    service: AnalysisService
    project: str
    document: str
    text: str
    client: Client = field(init=False)
    version: int = 0
    published: asyncio.Queue[list[Any]] = field(default_factory=asyncio.Queue)
    reading: asyncio.Task[None] | None = None

    async def open(self) -> float:
        """Seconds from connecting to the first messages."""
        started = time.perf_counter()
        self.client = self.service.attach(self.project)
        self.reading = asyncio.create_task(self._read())
        hello: dict[str, Any] = {"processId": None, "rootUri": None, "capabilities": {}}
        await self._say({"id": 1, "method": "initialize", "params": hello})
        await self._say({"method": "initialized", "params": {}})
        item = {"uri": self.document, "languageId": "iec-st", "version": 0, "text": self.text}
        await self._say({"method": "textDocument/didOpen", "params": {"textDocument": item}})
        await self.messages()
        return time.perf_counter() - started

    async def messages(self) -> list[Any]:
        """The next messages of the document. Raises TimeoutError."""
        return await asyncio.wait_for(self.published.get(), PATIENCE_S)

    async def edit(self) -> None:
        """Make the mistake, or take it back."""
        old, new = (GOOD, BAD) if GOOD in self.text else (BAD, GOOD)
        self.version += 1
        self.text, change = replaced(self.text, old, new)
        document = {"uri": self.document, "version": self.version}
        params = {"textDocument": document, "contentChanges": [change]}
        await self._say({"method": "textDocument/didChange", "params": params})

    async def _say(self, message: dict[str, Any]) -> None:
        await self.service.receive(self.project, self.client, json.dumps({"jsonrpc": "2.0", **message}))

    async def _read(self) -> None:
        while (text := await self.client.outbox.take()) is not None:
            message = json.loads(text)
            params = message.get("params")
            published = message.get("method") == "textDocument/publishDiagnostics"
            if published and params["uri"] == self.document:
                self.published.put_nowait(params["diagnostics"])

    def close(self) -> None:
        """The browser goes."""
        if self.reading is not None:
            self.reading.cancel()
        self.service.detach(self.project, self.client)


@dataclass(slots=True)
class Measured:
    """What was found."""

    first: list[float] = field(default_factory=list)
    """Seconds to the first messages of each session."""
    memory: list[Memory] = field(default_factory=list)
    """Of server and worker: before, and with each session."""
    edits: list[float] = field(default_factory=list)
    """Seconds from an edit until the last session has its messages."""
    building: list[float] = field(default_factory=list)
    """The same while the application is built."""


async def measure(content: Project, edited: str, sessions: int = SESSIONS, edits: int = EDITS) -> Measured:
    """Open sessions on a project one after the other, then edit a block in one of them."""
    found = Measured()
    with tempfile.TemporaryDirectory() as folder:
        store = Store(f"sqlite:///{folder}/bench.sqlite")
        service = AnalysisService(store, LIMITS)
        builder = Builder(1, Path(folder) / "objects")
        try:
            info = store.create_project("Bench", "bench", content=content)
            item = next(item for item in store.load(info.id).walk() if item.name == edited)
            document = part_uri(info.id, item.id, "implementation")
            text = str(vars(item.data)["implementation"])
            await asyncio.gather(service.warm(), builder.warm())
            found.memory.append(Memory.of(os.getpid()))
            browsers: list[Browser] = []
            for _ in range(sessions):
                browser = Browser(service, info.id, document, text)
                found.first.append(await browser.open())
                browsers.append(browser)
                await asyncio.sleep(DEBOUNCE_S)
                process = service.projects[info.id].process
                assert process is not None
                found.memory.append(Memory.of(os.getpid(), process.pid))
            found.edits = await _edit(browsers, edits)
            application = store.load(info.id).applications()[0].id
            order = Application.of(info.id, store.load(info.id), application)
            build = asyncio.create_task(builder.build(order, None))
            await asyncio.sleep(DEBOUNCE_S)
            while not build.done():
                found.building += await _edit(browsers, 2)
            await build
            for browser in browsers:
                browser.close()
        finally:
            await service.close()
            await builder.close()
            store.close()
    return found


async def _edit(browsers: list[Browser], edits: int) -> list[float]:
    seconds = []
    for _ in range(edits):
        await asyncio.sleep(DEBOUNCE_S)
        started = time.perf_counter()
        await browsers[0].edit()
        await asyncio.gather(*(browser.messages() for browser in browsers))
        seconds.append(time.perf_counter() - started - DEBOUNCE_S)
    return seconds


def rows(content: Project, edited: str) -> list[Row]:
    """Ten sessions on a project: first messages, edits and memory; the baseline is the first session."""
    found = asyncio.run(measure(content, edited))
    first, last = found.first[0] * 1e3, found.first[-1] * 1e3
    before, one, many = found.memory[0], found.memory[1], found.memory[-1]
    number = len(found.first)
    each = (many.uss - one.uss) / (number - 1)
    slowest = max(found.edits) * 1e3
    last_uss = many.uss - found.memory[-2].uss
    return [
        Row("first messages, 1st session", first, first, "ms", "its process was started before"),
        Row(f"first messages, {number}th session", last, first, "ms"),
        Row(
            f"body edited, messages of {number} sessions",
            median(found.edits) * 1e3,
            first,
            "ms",
            f"median of {len(found.edits)}, slowest {slowest:.0f} ms",
        ),
        Row(
            "the same while the application is built",
            median(found.building) * 1e3,
            first,
            "ms",
            f"median of {len(found.building)}, slowest {max(found.building) * 1e3:.0f} ms",
        ),
        Row(
            "memory of the 1st session (USS)",
            one.uss - before.uss,
            one.uss - before.uss,
            "MB",
            f"PSS of server and worker {one.pss:.0f} MB",
        ),
        Row(
            f"memory of the {number}th session (USS)",
            last_uss,
            one.uss - before.uss,
            "MB",
            f"mean of the 2nd to {number}th {each:.1f} MB, PSS of all {many.pss:.0f} MB",
        ),
    ]
