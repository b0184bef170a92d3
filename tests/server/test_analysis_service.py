"""The analysis service: one process a project, many browsers, and what happens when the process ends."""

from __future__ import annotations

import asyncio
import contextlib
import json
import os
import random
import signal
import subprocess
import sys
from collections.abc import AsyncIterator, Callable
from contextlib import asynccontextmanager
from pathlib import Path
from typing import Any

import pytest

from tappet.lang.services.reports import reports
from tappet.lang.services.workspace import Workspace
from tappet.project.store import Store
from tappet.server.analysis import outbox as outboxes
from tappet.server.analysis.client import Client
from tappet.server.analysis.outbox import Outbox
from tappet.server.analysis.process import COMMAND, WorkerProcess
from tappet.server.analysis.project import CRASHES, PROJECT_GONE, TRY_AGAIN, Limits
from tappet.server.analysis.service import AnalysisService
from tappet.server.lsp.project_programs import ProjectPrograms, part_uri

FAILING = (sys.executable, str(Path(__file__).with_name("failing_worker.py")))
LIMITS = Limits(memory_mib=4096, seconds=60.0)
PATIENCE_S = 60.0
PUBLISHED = "textDocument/publishDiagnostics"
HEAD = "PROGRAM PLC_PRG\nVAR\n    iCount : INT;\nEND_VAR"


class Browser:
    """Speaks with the service as a browser does."""

    def __init__(self, service: AnalysisService, project: str, *, reads: bool = True) -> None:
        self.service, self.project = service, project
        self.client: Client = service.attach(project)
        self.number = 0
        self.answers: dict[int, dict[str, Any]] = {}
        self.published: dict[str, tuple[list[str], int | None]] = {}
        self.said: list[str] = []
        self.news = asyncio.Event()
        self.ended = False
        self.reading = asyncio.create_task(self._read()) if reads else None

    async def _read(self) -> None:
        while (text := await self.client.outbox.take()) is not None:
            self._heard(json.loads(text))
        self.ended = True
        self.news.set()

    def _heard(self, message: dict[str, Any]) -> None:
        params = message.get("params")
        if message.get("method") == PUBLISHED:
            errors = [d["code"] for d in params["diagnostics"] if d["severity"] == 1]
            self.published[params["uri"]] = errors, params.get("version")
        elif message.get("method") == "window/showMessage":
            self.said.append(params["message"])
        else:
            self.answers[message["id"]] = message
        self.news.set()

    async def until(self, met: Callable[[], bool]) -> None:
        async with asyncio.timeout(PATIENCE_S):
            while not met():
                self.news.clear()
                await self.news.wait()

    async def send(self, message: dict[str, Any]) -> None:
        text = json.dumps({"jsonrpc": "2.0", **message})
        await self.service.receive(self.project, self.client, text)

    async def notify(self, method: str, params: Any) -> None:
        await self.send({"method": method, "params": params})

    async def begin(self, method: str, params: Any) -> int:
        self.number += 1
        await self.send({"id": self.number, "method": method, "params": params})
        return self.number

    async def answer(self, method: str, params: Any) -> dict[str, Any]:
        number = await self.begin(method, params)
        await self.until(lambda: number in self.answers)
        return self.answers.pop(number)

    async def start(self, locale: str = "en") -> None:
        params = {"processId": None, "rootUri": None, "capabilities": {}, "locale": locale}
        assert "result" in await self.answer("initialize", params)
        await self.notify("initialized", {})

    async def open(self, document: str, text: str, version: int = 1) -> None:
        item = {"uri": document, "languageId": "iec-st", "version": version, "text": text}
        await self.notify("textDocument/didOpen", {"textDocument": item})

    async def change(self, document: str, edits: list[dict[str, Any]], version: int) -> None:
        identifier = {"uri": document, "version": version}
        await self.notify("textDocument/didChange", {"textDocument": identifier, "contentChanges": edits})

    async def until_published(self, document: str, errors: list[str], version: int | None = None) -> None:
        """Wait for just these errors of a document, of one version of its text if given."""

        def met() -> bool:
            found = self.published.get(document)
            return found is not None and found[0] == errors and version in (None, found[1])

        await self.until(met)

    def close(self) -> None:
        if self.reading is not None:
            self.reading.cancel()
        self.service.detach(self.project, self.client)


class Site:
    """A store with a project, and the service that analyses it."""

    def __init__(self, store: Store, service: AnalysisService) -> None:
        self.store, self.service = store, service
        self.project = store.create_project("Press", "tester").id
        main = next(item for item in store.load(self.project).walk() if item.name == "PLC_PRG")
        self.main = main.id
        self.head = part_uri(self.project, main.id, "declaration")
        self.body = part_uri(self.project, main.id, "implementation")

    async def browser(self, locale: str = "en") -> Browser:
        browser = Browser(self.service, self.project)
        await browser.start(locale)
        return browser

    def process(self) -> WorkerProcess:
        process = self.service.projects[self.project].process
        assert process is not None
        return process


@asynccontextmanager
async def site(folder: Path, limits: Limits = LIMITS, **options: Any) -> AsyncIterator[Site]:
    store = Store(f"sqlite:///{folder}/store.sqlite")
    service = AnalysisService(store, limits, **options)
    try:
        yield Site(store, service)
    finally:
        await service.close()
        store.close()


def children() -> list[int]:
    """Processes that this one has started and not waited for."""
    text = Path(f"/proc/self/task/{os.getpid()}/children").read_text(encoding="ascii")
    return [int(pid) for pid in text.split()]


def is_alive(pid: int) -> bool:
    """Whether a process runs; one that has ended and waits to be asked about does not."""
    try:
        return "\nState:\tZ" not in Path(f"/proc/{pid}/status").read_text()
    except OSError:
        return False


async def until_gone(pid: int) -> None:
    async with asyncio.timeout(PATIENCE_S):
        while is_alive(pid):  # noqa: ASYNC110 - no child of this process
            await asyncio.sleep(0.02)


async def test_many_browsers_share_one_process(tmp_path: Path) -> None:
    async with site(tmp_path) as here:
        browsers = [await here.browser() for _ in range(5)]
        for browser in browsers[1:]:
            await browser.open(here.body, "iStep := 1;")
            await browser.until_published(here.body, ["E0201"])
        await browsers[0].open(here.head, HEAD.replace("iCount", "iStep"))
        for browser in browsers[1:]:
            await browser.until_published(here.body, [])
        pid = here.process().pid
        assert children().count(pid) == 1
        browsers[0].close()  # what its user typed goes with it
        for browser in browsers[1:]:
            await browser.until_published(here.body, ["E0201"])
        for browser in browsers[1:]:
            browser.close()
    assert pid not in children()


async def test_an_analysis_that_is_killed_starts_again_with_all_unsaved_texts(tmp_path: Path) -> None:
    async with site(tmp_path) as here:
        one, two = await here.browser(), await here.browser("zh-CN")
        await one.open(here.head, HEAD)
        edit = {"start": {"line": 2, "character": 4}, "end": {"line": 2, "character": 10}}
        await one.change(here.head, [{"range": edit, "text": "\U0001f600iStep"}, {"text": HEAD}], 2)
        await one.change(here.head, [{"range": edit, "text": "iStep"}], 3)
        await two.open(here.body, "iStep := iMissing;", 7)
        await two.until_published(here.body, ["E0201"], 7)
        first = here.process().pid
        os.kill(first, signal.SIGKILL)
        await one.until(lambda: bool(one.said))
        await two.until(lambda: bool(two.said))
        assert "SIGKILL" in one.said[0]
        assert "no text is lost" in one.said[0]
        assert "文本不会丢失" in two.said[0]
        two.published.clear()
        place = {"textDocument": {"uri": here.body}, "position": {"line": 0, "character": 1}}
        found = await two.answer("textDocument/definition", place)
        assert here.process().pid != first
        # the declaration is in the unsaved text of the other one, at a line that both show
        assert found["result"] is None or found["result"]["uri"] == here.head
        await two.until_published(here.body, ["E0201"], 7)
        edit = {"start": {"line": 0, "character": 9}, "end": {"line": 0, "character": 17}}
        await two.change(here.body, [{"range": edit, "text": "iStep"}], 8)
        await two.until_published(here.body, [], 8)


async def test_what_waits_is_answered_when_the_analysis_ends(tmp_path: Path) -> None:
    async with site(tmp_path, command=FAILING) as here:
        browser = await here.browser()
        await browser.open(here.body, "CRASH")
        place = {"textDocument": {"uri": here.body}, "position": {"line": 0, "character": 1}}
        answer = await browser.answer("textDocument/hover", place)
        assert answer["error"]["code"] == -32803
        assert "exit code 3" in answer["error"]["message"]


@pytest.mark.parametrize(
    ("text", "limits", "reason"),
    [
        ("HANG", Limits(4096, 5.0), "it took too long"),
        ("SPIN", Limits(4096, 5.0), "it took too long"),
        ("MEMORY", Limits(1024, 60.0), "more memory"),
    ],
)
async def test_a_worker_is_bounded(tmp_path: Path, text: str, limits: Limits, reason: str) -> None:
    async with site(tmp_path, limits, command=FAILING) as here:
        browser = await here.browser()
        await browser.open(here.body, text)
        await browser.until(lambda: bool(browser.said))
        assert reason in browser.said[0]
        await browser.change(here.body, [{"text": "iMissing := 1;"}], 2)
        await browser.until_published(here.body, ["E0201"], 2)


async def test_a_text_that_always_fails_is_left_alone_for_a_while(tmp_path: Path) -> None:
    async with site(tmp_path, command=FAILING) as here:
        browser = await here.browser()
        place = {"textDocument": {"uri": here.body}, "position": {"line": 0, "character": 1}}
        await browser.open(here.body, "CRASH")
        for number in range(CRASHES):
            await browser.until(lambda number=number: len(browser.said) > number)  # type: ignore[misc]
            if number < CRASHES - 1:
                await browser.answer("textDocument/hover", place)
        answer = await browser.answer("textDocument/hover", place)
        assert "it is tried again in" in answer["error"]["message"]
        late = Browser(here.service, here.project)
        await late.begin("initialize", {"processId": None, "rootUri": None, "capabilities": {}})
        await late.until(lambda: late.ended)
        assert late.client.outbox.closed is not None
        assert late.client.outbox.closed[0] == TRY_AGAIN


async def test_a_request_to_begin_outlives_the_process(tmp_path: Path) -> None:
    async with site(tmp_path) as here:
        await here.browser()
        late = Browser(here.service, here.project)
        os.kill(here.process().pid, signal.SIGSTOP)  # it cannot answer
        number = await late.begin("initialize", {"processId": None, "rootUri": None, "capabilities": {}})
        os.kill(here.process().pid, signal.SIGKILL)
        await late.until(lambda: number in late.answers)
        assert "capabilities" in late.answers[number]["result"]


async def test_a_browser_that_reads_nothing_keeps_nobody_waiting(tmp_path: Path) -> None:
    async with site(tmp_path) as here:
        quick, slow = await here.browser(), Browser(here.service, here.project, reads=False)
        await slow.begin("initialize", {"processId": None, "rootUri": None, "capabilities": {}})
        await slow.notify("initialized", {})
        await slow.open(here.body, "")
        await quick.open(here.body, "")
        for version in range(2, 12):
            await quick.change(here.body, [{"text": f"iMissing{version} := 1;" * version}], version)
            await quick.until_published(here.body, ["E0201"] * version, version)
        waiting = [json.loads(text) for text in slow.client.outbox._waiting.values()]
        published = [
            m["params"]["uri"] for m in waiting if m.get("method") == "textDocument/publishDiagnostics"
        ]
        assert len(published) == len(set(published))
        assert slow.client.outbox.replaced > 0


async def test_an_outbox_replaces_and_is_bounded(monkeypatch: pytest.MonkeyPatch) -> None:
    box = Outbox()
    for text, key in (("a1", "a"), ("answer", ""), ("b1", "b"), ("a2", "a")):
        box.put(text, key)
    assert [await box.take() for _ in range(3)] == ["answer", "b1", "a2"]
    assert box.replaced == 1
    monkeypatch.setattr(outboxes, "MOST_WAITING", 10)
    box.put("x" * 11)
    assert await box.take() is None
    assert box.closed is not None
    assert box.closed[0] == 4408
    box.put("more")
    assert len(box) == 0


async def test_an_idle_process_ends_and_another_one_takes_over(tmp_path: Path) -> None:
    async with site(tmp_path, idle_s=0.05) as here:
        browser = await here.browser()
        pid = here.process().pid
        browser.close()
        await until_gone(pid)
        assert here.service.projects == {}
        again = await here.browser()
        await again.open(here.body, "iMissing := 1;")
        await again.until_published(here.body, ["E0201"])
        assert here.process().pid != pid


@pytest.mark.parametrize("leaves", [False, True], ids=["stays", "comes back"])
async def test_a_request_sees_what_was_stored_before_it(tmp_path: Path, leaves: bool) -> None:
    """A table requests the operands of an object that was added just before it was opened, also where no
    browser had the project open meanwhile."""
    async with site(tmp_path) as here:
        browser = await here.browser()
        application = here.store.load(here.project).applications()[0].id
        for number in range(5):
            name = f"Lamp{number}"
            if leaves:
                browser.close()
            head = f"PROGRAM {name}\nVAR\n    bOn AT %QX{number}.3 : BOOL;\nEND_VAR"
            texts = {"declaration": head, "implementation": ""}
            add = asyncio.to_thread(
                here.store.add, here.project, "tester", application, "pou", name, data=texts
            )
            body = part_uri(here.project, (await add).id, "implementation")
            if leaves:
                browser = await here.browser()
            order = {"textDocument": {"uri": body}, "operands": ["bOn"]}
            found = await browser.answer("tappet/operandFacts", order)
            assert "error" not in found
            assert found["result"][0]["address"] == f"%QX{number}.3"


async def test_stored_changes_reach_the_analysis(tmp_path: Path) -> None:
    async with site(tmp_path) as here:
        browser = await here.browser()
        await browser.open(here.body, "iStep := F_New(1);")
        await browser.until_published(here.body, ["E0201", "E0201"])
        item = here.store.get(here.project, here.main)
        data = item.data.model_copy(update={"declaration": HEAD.replace("iCount", "iStep")})
        here.store.save(here.project, here.main, item.revision, data, "tester")
        await browser.until_published(here.body, ["E0201"])
        application = here.store.load(here.project).applications()[0].id
        texts = {
            "declaration": "FUNCTION F_New : INT\nVAR_INPUT\n    a : INT;\nEND_VAR",
            "implementation": "F_New := a;",
        }
        made = here.store.add(here.project, "tester", application, "pou", "F_New", data=texts)
        await browser.until_published(here.body, [])
        here.store.delete(here.project, "tester", made.id)
        await browser.until_published(here.body, ["E0201"])
        here.store.delete_project(here.project, "tester")
        here.service.project_deleted(here.project)
        await browser.until(lambda: browser.ended)
        assert browser.client.outbox.closed is not None
        assert browser.client.outbox.closed[0] == PROJECT_GONE


@pytest.mark.parametrize("seed", range(2))
async def test_random_edits_and_a_crash_leave_the_messages_of_a_fresh_analysis(
    tmp_path: Path, seed: int
) -> None:
    rng = random.Random(seed)
    words = ("iCount", "iMissing", " := ", "1", ";", "\n", "IF ", "END_IF;", "\U0001f600", "(* x *)")
    async with site(tmp_path) as here:
        browsers = [await here.browser() for _ in range(3)]
        texts: dict[str, str] = {here.head: HEAD, here.body: "iCount := 1;"}
        owner = {here.head: browsers[0], here.body: browsers[1]}
        for document, browser in owner.items():
            await browser.open(document, texts[document])
        for version in range(2, 30):
            document = rng.choice([here.head, here.body])
            text = texts[document]
            lines = text.split("\n")
            line = rng.randrange(len(lines))
            units = len(lines[line].encode("utf-16-le")) // 2
            at = rng.randrange(units + 1)
            before = lines[line].encode("utf-16-le")
            word = rng.choice(words)
            with contextlib.suppress(UnicodeDecodeError):
                lines[line] = (
                    before[: 2 * at].decode("utf-16-le") + word + before[2 * at :].decode("utf-16-le")
                )
                texts[document] = "\n".join(lines)
                place = {"line": line, "character": at}
                await owner[document].change(
                    document, [{"range": {"start": place, "end": place}, "text": word}], version
                )
            if version == 15:
                os.kill(here.process().pid, signal.SIGKILL)
                await browsers[2].until(lambda: bool(browsers[2].said))
        last = "iLast;"
        for document, browser in owner.items():
            texts[document] += last
            end = {"line": 10_000, "character": 0}
            await browser.change(document, [{"range": {"start": end, "end": end}, "text": last}], 100)
        programs = ProjectPrograms(here.project, lambda: here.store.load(here.project))
        workspace = Workspace(programs)
        for document, text in texts.items():
            workspace.open(document, text)
        (snapshot,) = workspace.snapshots()
        expected: dict[str, list[str]] = {document: [] for document in texts}
        for document, found in reports(snapshot).items():
            expected[document] = [report.code for report in found if report.severity == "error"]
        for document, browser in owner.items():
            await browser.until_published(document, expected[document], 100)


SERVER = """
import asyncio, json, sys
from tappet.project.store import Store
from tappet.server.analysis.project import Limits
from tappet.server.analysis.service import AnalysisService

async def main():
    store = Store(f"sqlite:///{sys.argv[1]}/store.sqlite")
    service = AnalysisService(store, Limits(4096, 60.0), command=sys.argv[2:])
    project = store.create_project("Press", "tester").id
    main = next(item.id for item in store.load(project).walk() if item.name == "PLC_PRG")
    client = service.attach(project)

    async def say(**message):
        await service.receive(project, client, json.dumps({"jsonrpc": "2.0"} | message))

    await say(id=1, method="initialize", params={"processId": None, "rootUri": None, "capabilities": {}})
    await client.outbox.take()
    item = {"uri": f"tappet:/{project}/{main}/implementation", "languageId": "", "version": 1, "text": "HANG"}
    await say(method="textDocument/didOpen", params={"textDocument": item})
    await service.warm()
    print(service.projects[project].process.pid, service._spare.pid, flush=True)
    await asyncio.sleep(1000)

asyncio.run(main())
"""


@pytest.mark.parametrize("command", [COMMAND, FAILING], ids=["idle", "at work"])
async def test_workers_end_with_a_server_that_is_killed(tmp_path: Path, command: tuple[str, ...]) -> None:
    server = await asyncio.create_subprocess_exec(
        sys.executable, "-c", SERVER, str(tmp_path), *command, stdout=asyncio.subprocess.PIPE
    )
    try:
        assert server.stdout is not None
        workers = [int(pid) for pid in (await server.stdout.readline()).split()]
        assert len(workers) == 2
        assert all(is_alive(pid) for pid in workers)
    finally:
        server.kill()
        await server.wait()
    for pid in workers:
        await until_gone(pid)


def test_the_web_servers_side_imports_no_analysis() -> None:
    rooms = ("tappet.lang", "tappet.core", "tappet.codegen", "tappet.libraries", "lsprotocol")
    shown = f"print([name for name in sys.modules if name.startswith({rooms})])"
    code = f"import sys, tappet.server.analysis.service; {shown}"
    found = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert found.stdout.strip() == "[]"
