"""Editor check: from an edit in one text of a large project to the messages that the editor gets for it.

What is timed is the language server as the browser talks to it: the notification `didChange` goes in, the
messages of the edited document come out. Only the pause that the server waits for the typing to stop is not
counted; it is kept between two edits, because the server prepares the next check then. The baseline is the
check of the whole project when its first document is opened.

The project is that of the build benchmark with a list of global variables, a recipe and a counter: each block
uses one of the variables and has a counter, each tenth calls a method of the recipe. An edit of the counter
concerns all: there the messages of the edited text and those of the last other text are timed.
"""

from __future__ import annotations

import asyncio
import gc
import json
import time
from dataclasses import dataclass, field, replace
from statistics import median
from typing import Any, NamedTuple

from tappet.bench import build as build_bench
from tappet.bench import editor_sessions
from tappet.bench.editor_sessions import replaced
from tappet.bench.report import Report, Row
from tappet.lang.source import Source
from tappet.project.model import Project, new_id
from tappet.project.new_project import new_project
from tappet.project.objects import make_object
from tappet.server.lsp.project_analysis import DEBOUNCE_S, ProjectAnalysis
from tappet.server.lsp.project_programs import ProjectPrograms, part_uri
from tappet.server.lsp.rpc import Outgoing
from tappet.server.lsp.session import LanguageSession

EDITS = 20
"""Edits of each kind; every second one takes the one before back."""
PATIENCE_S = 60.0
"""Without messages for so long, the measurement has failed."""
BAR = (
    "one edit of a project of 550 POUs checked under 100 ms, also with 10 sessions open; "
    "the 10th session takes under 20 MB"
)
_ID = "bench"


@dataclass(frozen=True, slots=True)
class Edit:
    """A change of one part of an object that makes messages; taking it back takes them away.

    `{n}` is the number of a block in the middle of the project.
    """

    name: str
    """What is edited, for people."""
    edited: str
    """Object that is edited."""
    part: str
    good: str
    bad: str
    reported: str
    """Object that the messages are about."""
    reported_part: str = "implementation"
    last: str = ""
    """Object that the messages are about which come last; '' where nothing comes later."""

    def at(self, number: int) -> Edit:
        """The edit for a project with this block in its middle."""
        fill = {"n": number}
        return replace(
            self,
            edited=self.edited.format(**fill),
            reported=self.reported.format(**fill),
            last=self.last.format(**fill),
            good=self.good.format(**fill),
            bad=self.bad.format(**fill),
        )


_UNIT = "FB_Unit{n}"
BODY = Edit(
    "body edited",
    _UNIT,
    "implementation",
    "diErrors := diErrors + 1;",
    "diErrors := diErrors + unknown;",
    _UNIT,
)
EDITED = (
    BODY,
    Edit(
        "variable added",
        _UNIT,
        "declaration",
        "diCount : DINT;",
        "diCount, unused : DINT;",
        _UNIT,
        "declaration",
    ),
    Edit("variable renamed", _UNIT, "declaration", "diErrors : DINT;", "diFaults : DINT;", _UNIT),
    Edit("input of another type", _UNIT, "declaration", "lrSet : LREAL;", "lrSet : BOOL;", "Main"),
    Edit(
        "global variable of another type",
        "GVL_Plant",
        "declaration",
        "diPart{n} : DINT;",
        "diPart{n} : WSTRING;",
        _UNIT,
    ),
    Edit(
        "block that all use",
        "FB_Counter",
        "declaration",
        "diCount : DINT;",
        "diNumber : DINT;",
        "FB_Counter",
        last=_UNIT,
    ),
    Edit("signature of a method", "Load", "declaration", "iNumber : INT;", "iNumber : WSTRING;", "FB_Unit2"),
)

_COUNTER = (
    "FUNCTION_BLOCK FB_Counter\nVAR_INPUT\n    bCount : BOOL;\nEND_VAR\n"
    "VAR_OUTPUT\n    diCount : DINT;\nEND_VAR"
)
_RECIPE = "FUNCTION_BLOCK FB_Recipe\nVAR\n    iLoaded : INT;\nEND_VAR"
_LOAD = "METHOD Load : BOOL\nVAR_INPUT\n    iNumber : INT;\nEND_VAR"


def project(pous: int = build_bench.POUS) -> tuple[Project, dict[str, str]]:
    """The project as the server stores it, and its object ids by name."""
    empty = new_project("Bench")
    application = empty.applications()[0].id
    objects = {i: item for i, item in empty.objects.items() if item.kind != "task" and item.name != "PLC_PRG"}
    ids = {}

    def add(kind: str, name: str, parent: str = application, **parts: str) -> None:
        item = make_object(
            id=new_id(), parent_id=parent, kind=kind, name=name, index=100 + len(objects), data=dict(parts)
        )
        objects[item.id] = item
        ids[name] = item.id

    variables = "".join(f"    diPart{n} : DINT;\n" for n in range(1, pous))
    add("gvl", "GVL_Plant", declaration=f"VAR_GLOBAL\n{variables}    fbRecipe : FB_Recipe;\nEND_VAR")
    add("pou", "FB_Recipe", declaration=_RECIPE, implementation="")
    add("method", "Load", ids["FB_Recipe"], declaration=_LOAD, implementation="Load := iNumber > iLoaded;")
    add(
        "pou",
        "FB_Counter",
        declaration=_COUNTER,
        implementation="IF bCount THEN diCount := diCount + 1; END_IF",
    )
    for number, source in enumerate(build_bench.project(pous), start=1):
        declaration, implementation = _parts(source)
        if number < pous:
            implementation += f"\nGVL_Plant.diPart{number} := diErrors;"
            implementation += "\nGVL_Plant.fbRecipe.Load(iMode);" if number % 10 == 2 else ""
            declaration += "\nVAR\n    fbCounter : FB_Counter;\nEND_VAR"
            implementation += "\nfbCounter(bCount := diErrors > fbCounter.diCount);"
        add("pou", str(source.name), declaration=declaration, implementation=implementation)
    return Project("Bench", "", objects), ids


def _parts(source: Source) -> tuple[str, str]:
    head, end, body = source.text.rpartition("END_VAR\n")
    return head + end.rstrip("\n"), body[: body.rindex("END_")].rstrip("\n")


class Seconds(NamedTuple):
    """Time from an edit to messages."""

    passed: float
    worked: float
    """Processor time."""


@dataclass(slots=True)
class Editor:
    """A client with one open document."""

    session: LanguageSession
    document: str
    reported: str
    """Document whose messages are published."""
    last: str
    """Document whose messages are published when everything is checked."""
    text: str
    version: int = 0
    published: dict[str, asyncio.Queue[list[Any]]] = field(default_factory=dict)

    def __post_init__(self) -> None:
        self.published = {document: asyncio.Queue() for document in (self.reported, self.last)}

    async def take(self, message: str) -> None:
        """A message of the server."""
        content = json.loads(message)
        params = content.get("params")
        if content.get("method") == "textDocument/publishDiagnostics" and params["uri"] in self.published:
            self.published[params["uri"]].put_nowait(params["diagnostics"])

    async def notify(self, method: str, params: object) -> None:
        """Send a notification."""
        await self.session.receive(json.dumps({"jsonrpc": "2.0", "method": method, "params": params}))

    async def messages(self, document: str) -> list[Any]:
        """The next messages of a document. Raises TimeoutError."""
        return await asyncio.wait_for(self.published[document].get(), PATIENCE_S)

    async def open(self) -> float:
        """Seconds from opening the document to its first messages: everything is checked."""
        started = time.perf_counter()
        hello: dict[str, Any] = {"processId": None, "rootUri": None, "capabilities": {}}
        request = {"jsonrpc": "2.0", "id": 1, "method": "initialize", "params": hello}
        await self.session.receive(json.dumps(request))
        await self.notify("initialized", {})
        item = {"uri": self.document, "languageId": "iec-st", "version": 0, "text": self.text}
        await self.notify("textDocument/didOpen", {"textDocument": item})
        for document in self.published:
            await self.messages(document)
        return time.perf_counter() - started

    async def edit(self, edit: Edit) -> list[Seconds]:
        """Times from a change of the text to the messages on it, and to those that come last."""
        old, new = (edit.good, edit.bad) if edit.good in self.text else (edit.bad, edit.good)
        self.version += 1
        self.text, change = replaced(self.text, old, new)
        document = {"uri": self.document, "version": self.version}
        params = {"textDocument": document, "contentChanges": [change]}
        started, worked = time.perf_counter(), time.process_time()
        await self.notify("textDocument/didChange", params)
        times = []
        for published in self.published:
            await self.messages(published)
            times.append(Seconds(time.perf_counter() - started, time.process_time() - worked))
        return times


async def measure(edit: Edit, pous: int = build_bench.POUS) -> tuple[float, list[list[Seconds]]]:
    """Seconds of the first check, and the times of each edit in the middle of the project."""
    content, ids = project(pous)
    edit = edit.at(pous // 2)
    found = content.objects[ids[edit.edited]].data
    editor: Editor

    async def send(message: Outgoing) -> None:
        await editor.take(message.text)

    analysis = ProjectAnalysis(ProjectPrograms(_ID, lambda: content), debounce_s=0.0)
    session = LanguageSession(analysis, send)
    # with its message from the beginning: of a text without any, nothing would be published when it is opened
    text = str(getattr(found, edit.part)).replace(edit.good, edit.bad, 1)
    reported = part_uri(_ID, ids[edit.reported], edit.reported_part)
    last = part_uri(_ID, ids[edit.last], "implementation") if edit.last else reported
    editor = Editor(session, part_uri(_ID, ids[edit.edited], edit.part), reported, last, text)
    try:
        first = await editor.open()
        seconds = []
        for _ in range(EDITS):
            await asyncio.sleep(DEBOUNCE_S)
            seconds.append(await editor.edit(edit))
        return first, seconds
    finally:
        await session.close()
        await analysis.close()


def run(pous: int = build_bench.POUS) -> Report:
    """Edits of a body and of declarations."""
    rows = []
    for edit in EDITED:
        gc.collect()  # of the session before
        first, edits = asyncio.run(measure(edit, pous))
        for name, times in zip(("", ": all messages"), zip(*edits, strict=True), strict=False):
            spent = [seconds.passed for seconds in times]
            worked = median(seconds.worked for seconds in times)
            note = (
                f"median of {len(edits)}, slowest {max(spent) * 1e3:.0f} ms, "
                f"processor time {worked * 1e3:.0f} ms"
            )
            rows.append(Row(edit.name + name, median(spent) * 1e3, first * 1e3, "ms", note))
    content, _ = project(pous)
    rows += editor_sessions.rows(content, f"FB_Unit{pous // 2}")
    return Report("editor", "the check of the whole project", rows, BAR)
