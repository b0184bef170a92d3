"""The protocol of the language server: order and edits, cancelling, messages that are none, faults."""

from __future__ import annotations

import asyncio
import json
import re
from collections.abc import Mapping
from typing import Any

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from lsp_client import Client
from lsp_project import BODY, here, start

from tappet.lang.services.documents import Program
from tappet.server.lsp import project_analysis, rpc
from tappet.server.lsp.utf16 import without_half_pairs


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
        ('{"jsonrpc": "2.0", "id": 1, "method": "x", "params": ' + "[" * 100_000, rpc.PARSE_ERROR),
        ('{"jsonrpc": "2.0", "id": 1, "method": "\ud800"}', rpc.PARSE_ERROR),
        ("[" * 100_000, rpc.INVALID_REQUEST),
        ("[]", rpc.INVALID_REQUEST),
        ('{"id": 1}', rpc.INVALID_REQUEST),
        ('{"jsonrpc": "2.0", "id": {}, "method": "x"}', rpc.INVALID_REQUEST),
        ('{"jsonrpc": "2.0", "id": [1], "method": "x"}', rpc.INVALID_REQUEST),
        ('{"jsonrpc": "2.0", "id": true, "method": "x"}', rpc.INVALID_REQUEST),
        ('{"jsonrpc": "2.0", "method": 5}', rpc.INVALID_REQUEST),
        ('{"jsonrpc": "2.0", "id": 1.5, "method": "x"}', rpc.INVALID_REQUEST),
        (f'{{"jsonrpc": "2.0", "id": {2**64}, "method": "x"}}', rpc.INVALID_REQUEST),
        ('{"jsonrpc": "2.0"}', rpc.INVALID_REQUEST),
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


@pytest.mark.parametrize(
    ("place", "named"),
    [
        ({"line": -1, "character": 0}, "`int` >= 0 - at `$.position.line`"),
        ({"line": 0, "character": 2**31}, "`int` <= 2147483647 - at `$.position.character`"),
        ({"line": 0, "character": 10**40}, "`int` <= 2147483647 - at `$.position.character`"),
        ({"line": 0, "character": 0.5}, "Expected `int`, got `float` - at `$.position.character`"),
        ({"line": 0, "character": True}, "Expected `int`, got `bool` - at `$.position.character`"),
        ({"line": "0", "character": 0}, "Expected `int`, got `str` - at `$.position.line`"),
        ({"line": 0}, "missing required field `character` - at `$.position`"),
        (None, "Expected `object`, got `null` - at `$.position`"),
    ],
)
async def test_wrong_params_are_named_with_what_is_expected(place: Any, named: str) -> None:
    async with start() as client:
        await client.start()
        error = await client.refused("textDocument/hover", {"textDocument": {"uri": BODY}, "position": place})
        assert error["code"] == rpc.INVALID_PARAMS
        assert named in error["message"]
        assert "textDocument/hover" in error["message"]


async def test_half_of_a_surrogate_pair_keeps_its_place() -> None:
    """Editors may hold one; JSON.stringify escapes it."""
    async with start() as client:
        await client.start()
        await client.open(BODY, "(* \ud83d \ude00 \\ud800 *) iCount := 1;")
        place = {"textDocument": {"uri": BODY}, "position": {"line": 0, "character": 19}}
        assert (await client.ask("textDocument/hover", place))["range"] == here(0, 17, 23)
        edits = await client.ask("tappet/document", {"uri": BODY})
        assert edits["text"] == "(* \ufffd \ufffd \\ud800 *) iCount := 1;"
        error = await client.refused("textDocument/rename", {**place, "newName": "a\ud800"})
        assert "'a\ufffd'" in error["message"]
        missing = await client.refused("tappet/document", {"uri": "tappet:/\udc00"})
        assert missing["code"] == rpc.REQUEST_FAILED


HALF_PAIRS = st.text(st.sampled_from("a\\u\ud800\udbff\udc00\udfff\U0001f600"), max_size=8)


@given(HALF_PAIRS)
def test_halves_of_surrogate_pairs_are_replaced_and_nothing_else(text: str) -> None:
    sent = json.dumps(text)
    shown = text.encode("utf-16-le", "surrogatepass").decode("utf-16-le", "surrogatepass")
    units = len(text.encode("utf-16-le", "surrogatepass"))
    got = json.loads(without_half_pairs(sent))
    assert got == re.sub("[\ud800-\udfff]", "\ufffd", shown)
    assert len(got.encode("utf-16-le")) == units


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
    st.none() | st.booleans() | st.integers() | st.floats(allow_nan=False) | HALF_PAIRS | st.text(max_size=5),
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
