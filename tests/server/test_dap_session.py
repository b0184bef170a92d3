"""The debug adapter on a debuggee in memory: what a client asks for, and what it hears by itself."""

from __future__ import annotations

import asyncio
import json
from collections.abc import Awaitable, Callable
from typing import Any

import pytest
from dap_client import DapClient
from dap_debuggee import FILE, WalkingDebuggee
from hypothesis import given
from hypothesis import strategies as st

from tappet.runtime.debugger.shapes import Hits
from tappet.server.dap.debuggee import Refused
from tappet.server.dap.session import DebugSession

Talk = Callable[[DapClient, WalkingDebuggee], Awaitable[None]]


def talk(conversation: Talk) -> None:
    async def run() -> None:
        debuggee = WalkingDebuggee()
        clients: list[DapClient] = []

        async def begin(wanted: Any, say: Any) -> WalkingDebuggee:
            if wanted.program != "/machine":
                await say(f"{wanted.program}:1:1: error")
                raise Refused(f"{wanted.program} has errors")
            return debuggee

        session = DebugSession(lambda text: clients[0].take(text), begin)
        clients.append(DapClient(session.receive))
        await conversation(clients[0], debuggee)
        await session.close()

    asyncio.run(run())


async def halted(client: DapClient, debuggee: WalkingDebuggee) -> None:
    await client.begin({FILE: [7]}, program="/machine")
    debuggee.walk()
    stopped = await client.event("stopped")
    assert stopped == {
        "reason": "breakpoint",
        "threadId": 1,
        "allThreadsStopped": False,
        "hitBreakpointIds": [1],
    }


def test_a_breakpoint_is_moved_to_a_statement_hit_and_gone_on_from() -> None:
    async def conversation(client: DapClient, debuggee: WalkingDebuggee) -> None:
        await halted(client, debuggee)
        assert (await client.body("threads"))["threads"] == [
            {"id": 1, "name": "MainTask"},
            {"id": 2, "name": "Slow"},
        ]
        stack = await client.body("stackTrace", threadId=1, startFrame=0, levels=20)
        assert [(f["name"], f["line"]) for f in stack["stackFrames"]] == [
            ("TON (Main.fbDelay)", 12),
            ("Main", 8),
            ("?", 0),
        ]
        assert stack["stackFrames"][1]["source"] == {"name": "Main.st", "path": FILE}
        reference = stack["stackFrames"][0]["source"]["sourceReference"]
        assert (await client.body("source", sourceReference=reference))["content"] == "(* Standard/TON *)"
        assert await client.body("continue", threadId=1) == {"allThreadsContinued": True}
        assert await client.event("continued") == {"threadId": 1, "allThreadsContinued": True}
        assert "moved since" in await client.refusal("scopes", frameId=stack["stackFrames"][0]["id"])

    talk(conversation)


def test_steps_tell_where_the_task_stands_then() -> None:
    async def conversation(client: DapClient, debuggee: WalkingDebuggee) -> None:
        await halted(client, debuggee)
        lines = []
        for command in ("next", "stepIn", "stepOut"):
            await client.body(command, threadId=1)
            assert (await client.event("stopped"))["reason"] == "step"
            stack = await client.body("stackTrace", threadId=1, startFrame=1, levels=1)
            assert stack["totalFrames"] == 3
            lines.append(stack["stackFrames"][0]["line"])
        assert lines == [9, 5, 6]
        assert "not halted" in await client.refusal("next", threadId=2)
        assert "no thread 3" in await client.refusal("next", threadId=3)

    talk(conversation)


def test_variables_of_frames_and_of_the_image_are_read_and_written() -> None:
    async def conversation(client: DapClient, debuggee: WalkingDebuggee) -> None:
        await halted(client, debuggee)
        frames = (await client.body("stackTrace", threadId=1))["stackFrames"]
        scopes = (await client.body("scopes", frameId=frames[0]["id"]))["scopes"]
        assert [scope["name"] for scope in scopes] == ["Locals", "Application"]
        local = scopes[0]["variablesReference"]
        variables = {
            v["name"]: v for v in (await client.body("variables", variablesReference=local))["variables"]
        }
        assert variables["nLocal"]["value"] == "7"
        point = variables["stPoint"]["variablesReference"]
        inside = {
            v["name"]: v for v in (await client.body("variables", variablesReference=point))["variables"]
        }
        assert inside["x"]["value"] == "1"
        array = inside["a"]["variablesReference"]
        elements = (await client.body("variables", variablesReference=array))["variables"]
        assert [(v["name"], v["value"]) for v in elements] == [("[0]", "2"), ("[1]", "3")]
        written = await client.body("setVariable", variablesReference=local, name="nLocal", value="12")
        assert (written["value"], debuggee.locals["nLocal"]) == ("12", "12")
        assert "no INT" in await client.refusal(
            "setVariable", variablesReference=local, name="nLocal", value="x"
        )
        programs = scopes[1]["variablesReference"]
        (main,) = (await client.body("variables", variablesReference=programs))["variables"]
        members = (await client.body("variables", variablesReference=main["variablesReference"]))["variables"]
        assert [v["name"] for v in members] == ["nCount", "xReady"]
        await client.body(
            "setVariable", variablesReference=main["variablesReference"], name="nCount", value="40"
        )
        assert debuggee.variables["Main.nCount"] == "40"

    talk(conversation)


def test_expressions_are_looked_for_where_the_statement_would_look() -> None:
    async def conversation(client: DapClient, debuggee: WalkingDebuggee) -> None:
        await halted(client, debuggee)
        frames = (await client.body("stackTrace", threadId=1))["stackFrames"]
        inner, main = frames[0]["id"], frames[1]["id"]

        async def value(expression: str, frame: int | None, context: str = "watch") -> str:
            answer = await client.body("evaluate", expression=expression, frameId=frame, context=context)
            return str(answer["result"])

        assert await value("nLocal", inner) == "7"
        assert await value("stPoint.a[1]", inner) == "3"
        assert await value("nCount", main) == await value("Main.nCount", None)
        assert await value("THIS^.nCount", main) == await value("main.NCOUNT", None)
        assert await value("nCount := 5", main, "repl") == "5"
        assert await value("nLocal := -3;", inner, "repl") == "-3"
        assert (debuggee.variables["Main.nCount"], debuggee.locals["nLocal"]) == ("5", "-3")
        assert "no program" in await client.refusal(
            "evaluate", expression="nWrong", frameId=main, context="hover"
        )
        assert "no 'b'" in (await client.refusal("evaluate", expression="stPoint.b", frameId=inner)).replace(
            ".b", "b"
        )

    talk(conversation)


def test_conditions_hits_and_log_points_reach_the_debuggee() -> None:
    async def conversation(client: DapClient, debuggee: WalkingDebuggee) -> None:
        await client.begin({}, program="/machine")
        answer = await client.body(
            "setBreakpoints",
            source={"path": FILE},
            breakpoints=[
                {"line": 5, "condition": "nCount > 3", "hitCondition": "% 4"},
                {"line": 6, "logMessage": "count {nCount}"},
                {"line": 8, "hitCondition": "often"},
                {"line": 99},
            ],
        )
        assert [b["verified"] for b in answer["breakpoints"]] == [True, True, False, False]
        assert "every fifth" in answer["breakpoints"][2]["message"]
        assert "no statement" in answer["breakpoints"][3]["message"]
        first, second = (wanted for wanted, _ in debuggee.breakpoints[:2])
        assert (first.condition, first.hits) == ("nCount > 3", Hits("every", 4))
        assert second.log == "count {nCount}"

    talk(conversation)


@pytest.mark.parametrize(
    ("text", "hits"),
    [("5", Hits("from", 5)), (">= 5", Hits("from", 5)), ("= 5", Hits("equal", 5)), ("==5", Hits("equal", 5)),
     ("%10", Hits("every", 10)), ("", Hits()), (" ", Hits())],
)  # fmt: skip
def test_hit_conditions(text: str, hits: Hits) -> None:
    async def conversation(client: DapClient, debuggee: WalkingDebuggee) -> None:
        await client.begin({}, program="/machine")
        breakpoints = [{"line": 5, "hitCondition": text}]
        await client.body("setBreakpoints", source={"path": FILE}, breakpoints=breakpoints)
        assert debuggee.breakpoints[0][0].hits == hits

    talk(conversation)


def test_data_breakpoints_are_for_variables_that_stay() -> None:
    async def conversation(client: DapClient, debuggee: WalkingDebuggee) -> None:
        await halted(client, debuggee)
        frames = (await client.body("stackTrace", threadId=1))["stackFrames"]
        scopes = (await client.body("scopes", frameId=frames[0]["id"]))["scopes"]
        local = scopes[0]["variablesReference"]
        refused = await client.body("dataBreakpointInfo", variablesReference=local, name="nLocal")
        assert refused["dataId"] is None
        found = await client.body("dataBreakpointInfo", variablesReference=local, name="IN")
        assert found["dataId"] == "Main.fbDelay.IN"
        by_name = await client.body("dataBreakpointInfo", name="main.ncount", frameId=frames[1]["id"])
        assert by_name["dataId"] == "Main.nCount"
        answer = await client.body(
            "setDataBreakpoints", breakpoints=[{"dataId": "Main.nCount", "hitCondition": "3"}]
        )
        assert answer["breakpoints"][0]["verified"]
        assert [(w.variable, w.hits) for w in debuggee.data] == [("Main.nCount", Hits("from", 3))]

    talk(conversation)


def test_the_next_statement_is_set() -> None:
    async def conversation(client: DapClient, debuggee: WalkingDebuggee) -> None:
        await halted(client, debuggee)
        (target,) = (await client.body("gotoTargets", source={"path": FILE}, line=5))["targets"]
        await client.body("goto", threadId=1, targetId=target["id"])
        await client.event("stopped")
        assert (await client.body("stackTrace", threadId=1))["stackFrames"][1]["line"] == 5
        (target,) = (await client.body("gotoTargets", source={"path": FILE}, line=7))["targets"]
        assert "no statement" in await client.refusal("goto", threadId=1, targetId=target["id"])

    talk(conversation)


def test_steps_back_lead_through_recorded_cycles_and_going_on_back_to_the_present() -> None:
    async def conversation(client: DapClient, debuggee: WalkingDebuggee) -> None:
        await halted(client, debuggee)
        await client.body("stepBack", threadId=1)
        assert "cycle 104" in (await client.event("stopped"))["description"]
        await client.body("stepBack", threadId=1)
        assert "cycle 103, 0.010 s before the last" in (await client.event("stopped"))["description"]
        assert debuggee.frozen
        (frame,) = (await client.body("stackTrace", threadId=1))["stackFrames"]
        (scope,) = (await client.body("scopes", frameId=frame["id"]))["scopes"]
        (main,) = (await client.body("variables", variablesReference=scope["variablesReference"]))[
            "variables"
        ]
        members = (await client.body("variables", variablesReference=main["variablesReference"]))["variables"]
        assert members[1]["value"] == "FALSE at 103"
        assert members[1]["presentationHint"] == {"attributes": ["readOnly"]}
        refusal = await client.refusal(
            "setVariable", variablesReference=main["variablesReference"], name="nCount", value="1"
        )
        assert "past" in refusal
        await client.body("reverseContinue", threadId=1)
        assert "cycle 100" in (await client.event("stopped"))["description"]
        await client.body("continue", threadId=1)
        assert (await client.event("stopped"))["reason"] == "breakpoint"
        assert not debuggee.frozen

    talk(conversation)


def test_an_exception_is_a_halt_with_its_reason() -> None:
    async def conversation(client: DapClient, debuggee: WalkingDebuggee) -> None:
        await client.begin({}, program="/machine", stopOnEntry=True, values={"Main.nCount": 3})
        assert (await client.event("stopped"))["reason"] == "pause"
        assert debuggee.variables["Main.nCount"] == "3"
        debuggee.log.append(("exception", "task MainTask: division by zero"))
        debuggee.fail()
        stopped = await client.event("stopped")
        assert (stopped["reason"], stopped["text"], stopped["allThreadsStopped"]) == (
            "exception",
            "division by zero",
            True,
        )
        assert "line 6" in (await client.body("exceptionInfo", threadId=1))["description"]
        outputs = [m["body"]["output"] for m in client.messages if m.get("event") == "output"]
        assert outputs == ["task MainTask: division by zero\n"]

    talk(conversation)


@pytest.mark.parametrize(("arguments", "terminated"), [({}, True), ({"terminateDebuggee": False}, False)])
def test_what_was_launched_ends_with_the_session_unless_the_client_wants_it_to_stay(
    arguments: dict[str, bool], terminated: bool
) -> None:
    async def conversation(client: DapClient, debuggee: WalkingDebuggee) -> None:
        await halted(client, debuggee)
        await client.body("disconnect", **arguments)
        assert debuggee.closed is terminated

    talk(conversation)


def test_what_was_attached_to_stays() -> None:
    async def conversation(client: DapClient, debuggee: WalkingDebuggee) -> None:
        await client.begin({}, command="attach", program="/machine", runtime="ws://plc:11740")
        await client.body("disconnect")
        assert debuggee.closed is False

    talk(conversation)


def test_a_program_with_errors_and_a_lost_runtime_are_told() -> None:
    async def conversation(client: DapClient, debuggee: WalkingDebuggee) -> None:
        assert "launch or attach first" in await client.refusal("threads")
        assert "has errors" in await client.refusal("launch", program="/wrong")
        assert (await client.event("output"))["output"] == "/wrong:1:1: error\n"
        await client.begin({}, program="/machine")
        debuggee.lost = True
        debuggee.walk()
        debuggee._call()
        await client.event("terminated")

    talk(conversation)


def test_refusals_are_said_in_the_language_of_the_editor() -> None:
    async def conversation(client: DapClient, debuggee: WalkingDebuggee) -> None:
        await client.body("initialize", adapterID="tappet", locale="zh-cn")
        assert await client.refusal("threads") == "没有调试任何应用：请先发送 launch 或 attach"
        await client.body("launch", program="/machine")
        await client.body("configurationDone")
        assert await client.refusal("next", threadId=3) == "没有线程 3"
        await client.body("stepBack", threadId=1)
        assert (await client.event("stopped"))["description"].startswith("周期 104")

    talk(conversation)


def test_what_is_no_request_is_answered_and_ends_nothing() -> None:
    async def conversation(client: DapClient, debuggee: WalkingDebuggee) -> None:
        for text in ("", "{", "[]", "7", '{"seq": 1}', '{"type": "response", "request_seq": 1}', '"\\ud800"'):
            await client._send(text)
        assert "no request 'fly'" in await client.refusal("fly")
        assert "`int`" in await client.refusal("next", threadId="one")
        await halted(client, debuggee)

    talk(conversation)


_JSON = st.recursive(
    st.none() | st.booleans() | st.integers() | st.floats(allow_nan=False, allow_infinity=False) | st.text(),
    lambda inner: st.lists(inner, max_size=3) | st.dictionaries(st.text(), inner, max_size=4),
    max_leaves=8,
)
_COMMANDS = st.sampled_from(
    [
        *("initialize", "threads", "stackTrace", "scopes", "variables", "source", "exceptionInfo"),
        *("setBreakpoints", "setDataBreakpoints", "setExceptionBreakpoints", "dataBreakpointInfo"),
        *("next", "continue", "pause", "goto", "gotoTargets", "stepBack", "reverseContinue", "terminate"),
        *("setVariable", "evaluate", "setExpression"),
    ]
)
_NUMBERS = st.integers(-1, 5)
_ARGUMENTS = st.fixed_dictionaries(
    {},
    optional={
        **dict.fromkeys(
            ["threadId", "frameId", "variablesReference", "targetId", "sourceReference"], _NUMBERS
        ),
        **dict.fromkeys(["startFrame", "levels", "start", "count", "line"], _NUMBERS),
        "name": st.sampled_from(["nLocal", "Main", "stPoint", "IN", "", "a"]),
        "value": st.text(max_size=5),
        "expression": st.sampled_from(["nLocal", "nCount", "stPoint.a[9]", "a := 1", "[", "stPoint[x]", ""]),
        "source": st.just({"path": FILE}) | _JSON,
        "breakpoints": st.lists(st.just({"line": 5}) | _JSON, max_size=3),
        "context": st.sampled_from(["repl", "watch"]),
    },
)


@given(st.lists(st.tuples(_COMMANDS, _ARGUMENTS | _JSON), max_size=12))
def test_every_request_is_answered_once_whatever_it_says(requests: list[tuple[str, Any]]) -> None:
    async def conversation(client: DapClient, debuggee: WalkingDebuggee) -> None:
        await halted(client, debuggee)
        for number, (command, arguments) in enumerate(requests, 1000):
            await client._send(
                json.dumps({"seq": number, "type": "request", "command": command, "arguments": arguments})
            )
        answered = [
            m["request_seq"] for m in client.messages if m["type"] == "response" and m["request_seq"] >= 1000
        ]
        assert answered == list(range(1000, 1000 + len(requests)))

    talk(conversation)
