"""The language server: texts that are being written, and messages of a client."""

from __future__ import annotations

import asyncio
import json
from collections.abc import Mapping
from random import Random
from typing import Any

from tappet.lang.services.documents import Program, whole_file
from tappet.lang.source import Source
from tappet.server.lsp import rpc
from tappet.server.lsp.project_analysis import ProjectAnalysis
from tappet.server.lsp.session import LanguageSession

URI = "tappet:/p/a.st"
PLACES = 4
AT_A_PLACE = (
    "completion", "hover", "signatureHelp", "definition", "typeDefinition", "implementation", "references",
    "documentHighlight", "prepareRename",
)  # fmt: skip
WHOLE = ("documentSymbol", "foldingRange", "semanticTokens/full", "formatting")
FORMAT = {"tabSize": 4, "insertSpaces": True}


def _programs(unsaved: Mapping[str, str]) -> list[Program]:
    return [Program("App", [whole_file(URI, Source(URI, unsaved.get(URI, ""), name="a"))])]


async def _talk(texts: list[str]) -> list[dict[str, Any]]:
    """What a session answers to messages, all of it."""
    answers: list[dict[str, Any]] = []

    async def send(message: rpc.Outgoing) -> None:
        answers.append(json.loads(message.text))

    analysis = ProjectAnalysis(_programs, debounce_s=0.0)
    session = LanguageSession(analysis, send)
    try:
        for text in texts:
            await session.receive(text)
        await session.endpoint.settle()
    finally:
        await session.close()
        await analysis.close()
    return answers


def _answers(texts: list[str]) -> None:
    for answer in asyncio.run(_talk(texts)):
        error = answer.get("error")
        assert not error or error["code"] != rpc.INTERNAL_ERROR, (error, texts)


def _message(number: int | None, method: str, params: Any) -> str:
    message = {"jsonrpc": "2.0", "method": method, "params": params}
    return json.dumps(message if number is None else message | {"id": number})


def _begin(text: str) -> list[str]:
    document = {"uri": URI, "languageId": "iecst", "version": 1, "text": text}
    return [
        _message(1, "initialize", {"capabilities": {}}),
        _message(None, "initialized", {}),
        _message(None, "textDocument/didOpen", {"textDocument": document}),
    ]


def editor(data: bytes) -> None:
    """Every question about a text, at a few places."""
    text = data.decode("utf-8", "replace")
    r = Random(len(data))
    document = {"textDocument": {"uri": URI}}
    said = _begin(text)
    for method in WHOLE:
        said.append(_message(len(said), f"textDocument/{method}", document | {"options": FORMAT}))
    lines = text.split("\n")
    for _ in range(PLACES):
        line = r.randrange(len(lines))
        at = {"position": {"line": line, "character": r.randint(0, len(lines[line]))}}
        for method in AT_A_PLACE:
            more = {"context": {"includeDeclaration": True}} if method == "references" else {}
            said.append(_message(len(said), f"textDocument/{method}", document | at | more))
        said.append(_message(len(said), "textDocument/rename", document | at | {"newName": "renamed"}))
        span = {"range": {"start": at["position"], "end": at["position"]}, "context": {"diagnostics": []}}
        said.append(_message(len(said), "textDocument/codeAction", document | span))
    _answers(said)


def messages(data: bytes) -> None:
    """Messages, one a line."""
    _answers(data.decode("utf-8", "replace").split("\n"))


def conversations() -> list[bytes]:
    text = "PROGRAM PLC_PRG\nVAR a : INT; END_VAR\na := a + 1;\nEND_PROGRAM\n"
    document = {"textDocument": {"uri": URI}}
    place = {"position": {"line": 2, "character": 1}}
    change = {"range": {"start": place["position"], "end": place["position"]}, "text": "b"}
    said = [
        *_begin(text),
        _message(
            None,
            "textDocument/didChange",
            {"textDocument": {"uri": URI, "version": 2}, "contentChanges": [change]},
        ),
        _message(2, "textDocument/hover", document | place),
        _message(3, "textDocument/completion", document | place),
        _message(4, "textDocument/rename", document | place | {"newName": "c"}),
        _message(5, "workspace/symbol", {"query": "a"}),
        _message(None, "$/cancelRequest", {"id": 5}),
        _message(None, "textDocument/didClose", document),
        _message(6, "shutdown", None),
        _message(None, "exit", None),
    ]
    return ["\n".join(said).encode()]
