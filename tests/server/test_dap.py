"""`tappet dap` as an editor starts it: a process that speaks the protocol, with a runtime of its own."""

from __future__ import annotations

import asyncio
import sys
from collections.abc import AsyncIterator
from contextlib import asynccontextmanager
from pathlib import Path

from dap_client import DapClient

from tappet.server.framed_messages import frame, read_message

PROGRAM = """\
FUNCTION_BLOCK FB_Counter
VAR_INPUT nStep : INT; END_VAR
VAR_OUTPUT nCount : INT; END_VAR
VAR_TEMP nBefore : INT; END_VAR
nBefore := nCount;
nCount := nBefore + nStep;
END_FUNCTION_BLOCK

PROGRAM Main
VAR
    fbCounter : FB_Counter;
    fTotal : LREAL;
    aValues : ARRAY[1..5] OF INT := [1, 2, 3, 4, 5];
    nIndex : INT := 1;
END_VAR
fbCounter(nStep := 2);
fTotal := fTotal + fbCounter.nCount * 0.5;
aValues[nIndex] := 7;
END_PROGRAM
"""
BEFORE, ADD, CALL, TOTAL, INDEX = 5, 6, 16, 17, 18
"""Lines."""


@asynccontextmanager
async def adapter(folder: Path, program: str = PROGRAM) -> AsyncIterator[tuple[DapClient, str]]:
    """A client of a running `tappet dap`, and the path of the program."""
    path = folder / "Main.st"
    path.write_text(program)
    process = await asyncio.create_subprocess_exec(
        sys.executable, "-m", "tappet", "dap",
        stdin=asyncio.subprocess.PIPE, stdout=asyncio.subprocess.PIPE,
    )  # fmt: skip
    assert process.stdin is not None
    assert process.stdout is not None
    stdin, stdout = process.stdin, process.stdout

    async def send(text: str) -> None:
        stdin.write(frame(text))
        await stdin.drain()

    client = DapClient(send)

    async def read() -> None:
        while (text := await read_message(stdout)) is not None:
            await client.take(text)

    reading = asyncio.create_task(read())
    try:
        yield client, str(path)
    finally:
        stdin.close()
        async with asyncio.timeout(60):
            await process.wait()
        await reading
    assert process.returncode == 0


async def top(client: DapClient) -> tuple[str, int]:
    frame = (await client.body("stackTrace", threadId=1, levels=1))["stackFrames"][0]
    return frame["name"].partition(" ")[0], frame["line"]


async def test_a_session_from_the_first_breakpoint_to_the_end(tmp_path: Path) -> None:
    async with adapter(tmp_path) as (client, path):
        await client.begin({path: [CALL]}, program=path, values={"Main.nIndex": 3})
        stopped = await client.event("stopped")
        assert (stopped["reason"], stopped["threadId"]) == ("breakpoint", 1)
        assert await top(client) == ("Main", CALL)
        walked = []
        for command in ("stepIn", "next", "stepOut", "next"):
            await client.body(command, threadId=1)
            await client.event("stopped")
            walked.append(await top(client))
        assert walked == [("FB_Counter", BEFORE), ("FB_Counter", ADD), ("Main", TOTAL), ("Main", INDEX)]
        frames = (await client.body("stackTrace", threadId=1))["stackFrames"]
        main = frames[0]["id"]
        count = await client.body("evaluate", expression="fbCounter.nCount", frameId=main, context="watch")
        total = await client.body("evaluate", expression="Main.fTotal", frameId=main, context="hover")
        assert float(total["result"]) == int(count["result"]) * 0.5 == 1.0
        await client.body("evaluate", expression="fbCounter.nCount := 100", frameId=main, context="repl")
        await client.body("continue", threadId=1)
        await client.event("stopped")
        await client.body("stepIn", threadId=1)
        await client.event("stopped")
        frames = (await client.body("stackTrace", threadId=1))["stackFrames"]
        scopes = (await client.body("scopes", frameId=frames[0]["id"]))["scopes"]
        local = scopes[0]["variablesReference"]
        await client.body("next", threadId=1)
        await client.event("stopped")
        frames = (await client.body("stackTrace", threadId=1))["stackFrames"]
        local = (await client.body("scopes", frameId=frames[0]["id"]))["scopes"][0]["variablesReference"]
        values = {
            v["name"]: v["value"]
            for v in (await client.body("variables", variablesReference=local))["variables"]
        }
        assert values["nBefore"] == "100"
        await client.body("setVariable", variablesReference=local, name="nBefore", value="50")
        await client.body("stepOut", threadId=1)
        await client.event("stopped")
        frames = (await client.body("stackTrace", threadId=1))["stackFrames"]
        count = await client.body(
            "evaluate", expression="fbCounter.nCount", frameId=frames[0]["id"], context="watch"
        )
        assert count["result"] == "52"
        array = await client.body("evaluate", expression="aValues", frameId=frames[0]["id"], context="watch")
        assert array["indexedVariables"] == 5
        page = await client.body(
            "variables", variablesReference=array["variablesReference"], start=1, count=3
        )
        assert [(v["name"], v["value"]) for v in page["variables"]] == [
            ("[2]", "2"),
            ("[3]", "7"),
            ("[4]", "4"),
        ]
        await client.body("disconnect")


async def test_an_exception_stops_at_its_line_and_the_past_can_be_looked_at(tmp_path: Path) -> None:
    async with adapter(tmp_path) as (client, path):
        await client.begin({}, program=path)
        async with asyncio.timeout(60):
            total = "0"
            while total in ("0", "0.0"):  # until a cycle is recorded that is good
                total = (await client.body("evaluate", expression="Main.fTotal", context="watch"))["result"]
        await client.body("evaluate", expression="Main.nIndex := 6", context="repl")
        stopped = await client.event("stopped")
        assert (stopped["reason"], stopped["allThreadsStopped"]) == ("exception", True)
        assert await top(client) == ("Main", INDEX)
        assert f"line {INDEX}" in (await client.body("exceptionInfo", threadId=1))["description"]
        await client.body("stepBack", threadId=1)
        assert "cycle" in (await client.event("stopped"))["description"]
        await client.body("reverseContinue", threadId=1)
        await client.event("stopped")
        index = await client.body("evaluate", expression="Main.nIndex", context="watch")
        assert index["result"] == "1"
        await client.body("disconnect")


async def test_a_program_with_errors_is_told_by_its_messages(tmp_path: Path) -> None:
    async with adapter(tmp_path, PROGRAM.replace("0.5", "nFactor")) as (client, path):
        await client.body("initialize", adapterID="tappet")
        assert "has errors" in await client.refusal("launch", program=path)
        assert f"Main.st:{TOTAL}:" in (await client.event("output"))["output"]
        assert "does not exist" in await client.refusal("launch", program=f"{path}.no")
