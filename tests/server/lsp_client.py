"""A client of a language session under test: texts in which `|` marks the position asked about."""

from __future__ import annotations

import asyncio
import json
from collections.abc import Mapping
from typing import Any

from tappet.lang.services.documents import Program, Segment, SourceMap, Text, library_text
from tappet.lang.source import Scope, Source
from tappet.server.lsp.project_analysis import ProjectAnalysis
from tappet.server.lsp.rpc import Outgoing
from tappet.server.lsp.session import LanguageSession

TON = """(* On delay *)
FUNCTION_BLOCK TON
VAR_INPUT IN : BOOL; PT : TIME; END_VAR VAR_OUTPUT Q : BOOL; END_VAR
END_FUNCTION_BLOCK"""


def uri(name: str, part: str) -> str:
    return f"tappet:/p1/{name}/{part}"


def part(name: str, part: str, text: str, line: int) -> Segment:
    width = len(text) - text.rfind("\n") - 1
    return Segment(line, f"tappet:/p1/{name}", part, 0, text.count("\n") + 1, width)


class FakeProject:
    """Objects of two parts each, composed as the project composes them."""

    def __init__(self, **objects: tuple[str, str]) -> None:
        self.objects = objects

    def __call__(self, unsaved: Mapping[str, str]) -> list[Program]:
        texts: list[Text] = []
        for name, (declaration, implementation) in self.objects.items():
            declaration = unsaved.get(uri(name, "declaration"), declaration)
            implementation = unsaved.get(uri(name, "implementation"), implementation)
            head = declaration.split()[0].upper() if declaration.split() else "PROGRAM"
            body = declaration.count("\n") + 1
            if head in ("PROGRAM", "FUNCTION", "FUNCTION_BLOCK"):
                text = f"{declaration}\n{implementation}\nEND_{head}"
                segments = (
                    part(name, "declaration", declaration, 0),
                    part(name, "implementation", implementation, body),
                )
            else:
                text, segments = declaration, (part(name, "declaration", declaration, 0),)
            texts.append(Text(Source(name, text, name=name), SourceMap(segments)))
        library = Source("Standard/TON", TON, scope=Scope.LIBRARY, library="Standard", namespace="Standard")
        return [Program("App", [*texts, library_text(library)])]


class Client:
    """Speaks JSON-RPC with a session in the same event loop."""

    def __init__(self, programs: Any = None, analysis: ProjectAnalysis | None = None, **options: Any) -> None:
        self.answers: dict[Any, asyncio.Future[dict[str, Any]]] = {}
        self.notified: list[tuple[str, Any]] = []
        self.errors: list[dict[str, Any]] = []
        self.heard = asyncio.Event()
        self.shown: set[str] = set()
        """Documents that are open."""
        self.next_id = 0
        self.analysis = analysis or ProjectAnalysis(programs, debounce_s=0.0)
        self.session = LanguageSession(self.analysis, self._sent, **options)

    async def __aenter__(self) -> Client:
        return self

    async def __aexit__(self, *_: object) -> None:
        await self.session.close()
        await self.analysis.close()

    async def _sent(self, outgoing: Outgoing) -> None:
        message = json.loads(outgoing.text)
        assert message["jsonrpc"] == "2.0"
        if "method" in message:
            self.notified.append((message["method"], message["params"]))
            self.heard.set()
        elif message["id"] is None:
            self.errors.append(message["error"])
        else:
            self.answers.pop(message["id"]).set_result(message)

    async def raw(self, text: str) -> None:
        await self.session.receive(text)

    async def begin(self, method: str, params: Any) -> tuple[int, asyncio.Future[dict[str, Any]]]:
        self.next_id += 1
        future: asyncio.Future[dict[str, Any]] = asyncio.get_running_loop().create_future()
        self.answers[self.next_id] = future
        await self.raw(json.dumps({"jsonrpc": "2.0", "id": self.next_id, "method": method, "params": params}))
        return self.next_id, future

    async def answer(self, method: str, params: Any) -> dict[str, Any]:
        _, future = await self.begin(method, params)
        return await asyncio.wait_for(future, 20)

    async def ask(self, method: str, params: Any) -> Any:
        answer = await self.answer(method, params)
        assert "error" not in answer, answer
        return answer["result"]

    async def refused(self, method: str, params: Any) -> dict[str, Any]:
        answer = await self.answer(method, params)
        assert "error" in answer, answer
        return answer["error"]

    async def notify(self, method: str, params: Any) -> None:
        if method == "textDocument/didOpen":
            self.shown.add(params["textDocument"]["uri"])
        elif method == "textDocument/didClose":
            self.shown.discard(params["textDocument"]["uri"])
        await self.raw(json.dumps({"jsonrpc": "2.0", "method": method, "params": params}))

    async def start(self, locale: str = "en") -> dict[str, Any]:
        params = {"processId": None, "rootUri": None, "capabilities": {}, "locale": locale}
        result = await self.ask("initialize", params)
        await self.notify("initialized", {})
        return result

    async def open(self, document: str, text: str, version: int = 1) -> dict[str, Any]:
        """Open a text; gives the params that ask about its `|`."""
        before, mark, after = text.partition("|")
        item = {"uri": document, "languageId": "iec-st", "version": version, "text": before + after}
        await self.notify("textDocument/didOpen", {"textDocument": item})
        lines = before.split("\n")
        position = {
            "line": len(lines) - 1,
            "character": len(lines[-1].encode("utf-16-le", "surrogatepass")) // 2,
        }
        return {"textDocument": {"uri": document}, **({"position": position} if mark else {})}

    async def published(self, document: str) -> list[dict[str, Any]]:
        """The next messages published for a document, of an open one those of the opened text: the stored one
        may be published while the document is being opened."""
        while True:
            for index, (method, params) in enumerate(self.notified):
                if method != "textDocument/publishDiagnostics" or params["uri"] != document:
                    continue
                if "version" in params or document not in self.shown:
                    del self.notified[: index + 1]
                    found: list[dict[str, Any]] = params["diagnostics"]
                    return found
            self.heard.clear()
            await asyncio.wait_for(self.heard.wait(), 20)
