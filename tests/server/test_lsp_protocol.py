"""The protocol of the language server: order and edits, cancelling, messages that are none, faults."""

from __future__ import annotations

import asyncio
import json
from collections.abc import Mapping
from typing import Any

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from lsp_client import Client
from lsp_project import BODY, here, start

from tappet.lang.services.documents import Program
from tappet.server.lsp import project_analysis, rpc


async def test_positions_behind_characters_of_two_units() -> None:
    async with start() as client:
        await client.start()
        params = await client.open(BODY, "(* \U0001f600\U0001f600 *) iC|ount := 1;")
        found = await client.ask("textDocument/hover", params)
        assert found["range"] == here(0, 11, 17)
        change = {"range": here(0, 11, 17), "text": "motor.xOn"}
        await client.notify(
            "textDocument/didChange",
            {"textDocument": {"uri": BODY, "version": 2}, "contentChanges": [change]},
        )
        found = await client.ask(
            "textDocument/documentHighlight", {**params, "position": here(0, 12, 0)["start"]}
        )
        assert [f["range"] for f in found] == [here(0, 11, 16)]


async def test_each_request_sees_the_edits_before_it() -> None:
    async with start() as client:
        await client.start()
        await client.open(BODY, "")
        text = ""
        waiting = []
        for number, char in enumerate("motor.xOn := iCount > 5;"):
            change = {"range": here(0, len(text), len(text)), "text": char}
            identifier = {"uri": BODY, "version": number + 2}
            await client.notify(
                "textDocument/didChange", {"textDocument": identifier, "contentChanges": [change]}
            )
            text += char
            position = {"line": 0, "character": len(text)}
            params = {"textDocument": {"uri": BODY}, "position": position}
            waiting.append((await client.begin("textDocument/completion", params))[1])
        answers = await asyncio.wait_for(asyncio.gather(*waiting), 30)
        after_dot = [item["label"] for item in answers[text.index(".")]["result"]["items"]]
        assert after_dot == ["xOn", "xRuns"]


async def test_a_waiting_request_can_be_cancelled() -> None:
    async with start() as client:
        await client.start()
        await client.open(BODY, "")
        params = {"textDocument": {"uri": BODY}, "position": {"line": 0, "character": 0}}
        begun = [await client.begin("textDocument/completion", params) for _ in range(5)]
        await client.notify("$/cancelRequest", {"id": begun[-1][0]})
        answers = [await asyncio.wait_for(future, 20) for _, future in begun]
        assert answers[-1]["error"]["code"] == rpc.REQUEST_CANCELLED
        assert all("result" in answer for answer in answers[:-1])


@pytest.mark.parametrize(
    ("message", "code"),
    [
        ("{", rpc.PARSE_ERROR),
        ("[" * 100_000, rpc.PARSE_ERROR),
        ("[]", rpc.INVALID_REQUEST),
        ('{"id": 1}', rpc.INVALID_REQUEST),
        ('{"jsonrpc": "2.0", "id": {}, "method": "x"}', rpc.INVALID_REQUEST),
        ('{"jsonrpc": "2.0", "id": [1], "method": "x"}', rpc.INVALID_REQUEST),
        ('{"jsonrpc": "2.0", "id": true, "method": "x"}', rpc.INVALID_REQUEST),
        ('{"jsonrpc": "2.0", "method": 5}', rpc.INVALID_REQUEST),
    ],
)
async def test_what_is_no_message_is_told(message: str, code: int) -> None:
    async with start() as client:
        await client.raw(message)
        assert [error["code"] for error in client.errors] == [code]


@pytest.mark.parametrize(
    ("method", "params", "code"),
    [
        ("textDocument/nothing", {}, rpc.METHOD_NOT_FOUND),
        ("textDocument/hover", {}, rpc.INVALID_PARAMS),
        ("textDocument/hover", [1], rpc.INVALID_PARAMS),
        ("textDocument/hover", {"textDocument": {"uri": 5}, "position": "x"}, rpc.INVALID_PARAMS),
        (
            "textDocument/hover",
            {"textDocument": {"uri": "tappet:/p1/gone/declaration"}, "position": {"line": 0, "character": 0}},
            rpc.REQUEST_FAILED,
        ),
        (
            "textDocument/formatting",
            {"textDocument": {"uri": "x"}, "options": {"tabSize": 2, "insertSpaces": True}},
            rpc.REQUEST_FAILED,
        ),
    ],
)
async def test_bad_requests_are_answered_with_their_error(method: str, params: Any, code: int) -> None:
    async with start() as client:
        await client.start()
        error = await client.refused(method, params)
        assert error["code"] == code
        assert error["message"]


async def test_order_of_life() -> None:
    async with start() as client:
        params = {"textDocument": {"uri": BODY}, "position": {"line": 0, "character": 0}}
        assert (await client.refused("textDocument/hover", params))["code"] == rpc.NOT_INITIALIZED
        await client.start()
        assert await client.ask("shutdown", None) is None
        assert (await client.refused("textDocument/hover", params))["code"] == rpc.NOT_INITIALIZED
        await client.notify("exit", None)
        await asyncio.wait_for(client.session.exit.wait(), 60)


async def test_a_fault_of_ours_is_an_answer_too(
    caplog: pytest.LogCaptureFixture, monkeypatch: pytest.MonkeyPatch
) -> None:
    def broken(unsaved: Mapping[str, str]) -> list[Program]:
        raise RuntimeError("database is away")

    async with Client(broken) as client:
        await client.start()
        params = {"textDocument": {"uri": BODY}, "position": {"line": 0, "character": 0}}
        error = await client.refused("textDocument/hover", params)
        assert error["code"] == rpc.INTERNAL_ERROR
        assert "database" not in error["message"]
        assert "database is away" in caplog.text
        client.analysis.stored_texts_changed()
        logged = asyncio.Event()
        monkeypatch.setattr(project_analysis.log, "exception", lambda *_: logged.set())
        await asyncio.wait_for(logged.wait(), 20)
        assert await client.refused("textDocument/hover", params)


async def test_positions_outside_of_the_text() -> None:
    async with start() as client:
        await client.start()
        await client.open(BODY, "iCount := 1;")
        for line, character in ((0, 9999), (999, 0), (4_000_000, 4_000_000)):
            params = {"textDocument": {"uri": BODY}, "position": {"line": line, "character": character}}
            await client.ask("textDocument/completion", params)
            await client.ask("textDocument/hover", params)
        far = {"start": {"line": 50, "character": 9}, "end": {"line": 2, "character": 0}}
        await client.notify(
            "textDocument/didChange",
            {
                "textDocument": {"uri": BODY, "version": 2},
                "contentChanges": [{"range": far, "text": "\nx();"}],
            },
        )
        symbols = await client.ask("textDocument/foldingRange", {"textDocument": {"uri": BODY}})
        assert isinstance(symbols, list)


METHODS = [
    *("initialize", "shutdown", "$/cancelRequest", "tappet/document", "tappet/shorthand"),
    *("tappet/completionIn", "tappet/operandFacts", "tappet/crossReferences"),
    "workspace/symbol",
    *(f"textDocument/{name}" for name in ("hover", "completion", "rename", "didChange", "didOpen")),
]
JSON = st.recursive(
    st.none() | st.booleans() | st.integers() | st.text(max_size=5),
    lambda inner: (
        st.lists(inner, max_size=3)
        | st.dictionaries(
            st.sampled_from(
                ["textDocument", "uri", "position", "line", "character", "text", "id", "contentChanges"]
            ),
            inner,
            max_size=4,
        )
    ),
    max_leaves=8,
)


@settings(max_examples=40, deadline=None, suppress_health_check=[HealthCheck.too_slow])
@given(st.lists(st.tuples(st.sampled_from(METHODS), JSON, st.booleans()), max_size=6))
def test_any_messages_leave_the_session_alive(messages: list[tuple[str, Any, bool]]) -> None:
    async def run() -> None:
        async with start() as client:
            await client.start()
            client.next_id = 1000
            for number, (method, params, request) in enumerate(messages):
                message: dict[str, Any] = {"jsonrpc": "2.0", "method": method, "params": params}
                if request:
                    message["id"] = number
                    client.answers[number] = asyncio.get_running_loop().create_future()
                await client.raw(json.dumps(message))
            await client.session.endpoint.settle()
            answer = await client.answer("workspace/symbol", {"query": "PLC"})
            assert "result" in answer or answer["error"]["code"] == rpc.NOT_INITIALIZED

    asyncio.run(run())
