"""The runtime as a process: boot, kill, restart, proper end."""

import asyncio
import os
import signal
import stat
import sys
from pathlib import Path

import pytest
from plc_programs import MS, build, until

from tappet.iec.task import Task
from tappet.runtime.__main__ import read_token
from tappet.runtime.client import RuntimeClient
from tappet.runtime.operations.life_cycle import GetInfo, Start
from tappet.runtime.operations.values import Read
from tappet.runtime.owned_folder import owned
from tappet.runtime.process import Endpoint, RuntimeProcess, StartError, describe_exit

TEXT = """
PROGRAM PLC_PRG
VAR RETAIN count : LINT; END_VAR
VAR n : LINT; END_VAR
count := count + 1;
n := n + 1;
hours := hours + 1;
END_PROGRAM
"""
TASKS = (Task("Main", interval_ns=2 * MS, programs=("PLC_PRG",)),)
LISTS = {"Persistent": "VAR_GLOBAL PERSISTENT RETAIN hours : LINT; END_VAR"}
NAMES = ("PLC_PRG.count", "PLC_PRG.n", "Persistent.hours")
OPTIONS = ("--no-realtime",)


async def values(client: RuntimeClient) -> list[int]:
    symbols = await client.symbols()
    data = await client.call(Read([(symbols.resolve(n).offset, 8) for n in NAMES]))
    return [int.from_bytes(d, "little") for d in data]


async def counted(client: RuntimeClient, cycles: int) -> bool:
    return (await values(client))[0] >= cycles


async def connect(endpoint: Endpoint | None) -> RuntimeClient:
    assert endpoint is not None
    return await RuntimeClient.connect(endpoint.url, endpoint.token)


async def test_killed_runtime_comes_back_with_its_application(tmp_path: Path) -> None:
    reasons: list[str] = []
    ready: asyncio.Queue[Endpoint] = asyncio.Queue()
    process = await RuntimeProcess.start(
        tmp_path / "plc", options=OPTIONS, on_exit=reasons.append, on_ready=ready.put_nowait
    )
    try:
        first = await ready.get()
        async with await connect(first) as client:
            await client.download(build(TEXT, TASKS, gvls=LISTS).to_bytes())
            await client.call(Start())
            await until(lambda: counted(client, 100))
            before = await values(client)
        os.kill(first.pid, signal.SIGKILL)
        second = await asyncio.wait_for(ready.get(), 60)
        assert second.url == first.url
        assert second.instance_id != first.instance_id
        assert reasons == ["the runtime process was ended by SIGKILL"]
        async with await connect(second) as client:
            assert (await client.call(GetInfo())).state == "run"
            after = await values(client)
            assert after[0] - after[1] >= before[0] - 1  # what was counted before the kill, less one cycle
            assert after[2] == after[0]
            assert after[1] < after[0]
    finally:
        await process.stop()


async def test_proper_end_saves_and_exits_with_zero(tmp_path: Path) -> None:
    process = await RuntimeProcess.start(tmp_path / "plc", options=OPTIONS, restart=False)
    async with await connect(process.endpoint) as client:
        await client.download(build(TEXT, TASKS, gvls=LISTS).to_bytes())
        await client.call(Start())
        await until(lambda: counted(client, 20))
    await process.stop()
    assert process._process is not None
    assert process._process.returncode == 0
    names = sorted(p.name for p in (tmp_path / "plc").iterdir())
    assert names == ["boot.tappet", "retain.live", "retain.saved", "token"]
    for name in names:
        assert stat.S_IMODE((tmp_path / "plc" / name).stat().st_mode) == 0o600


async def test_a_folder_that_cannot_be_used_is_reported(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("no folder")
    with pytest.raises(StartError, match="error: "):
        await RuntimeProcess.start(tmp_path / "file", options=OPTIONS)


def test_token_is_made_once_and_private(tmp_path: Path) -> None:
    path = tmp_path / "token"
    token = read_token(path)
    assert len(token) > 30
    assert read_token(path) == token
    assert stat.S_IMODE(path.stat().st_mode) == 0o600
    path.write_text("short")
    with pytest.raises(ValueError, match="at least 16"):
        read_token(path)


def test_exit_reasons() -> None:
    assert describe_exit(1).endswith("exit code 1")
    assert describe_exit(-9).endswith("SIGKILL")
    assert describe_exit(-60).endswith("signal 60")


ORPHAN = """
import asyncio, os, signal, sys
from pathlib import Path
from tappet.runtime.owned_folder import owned
from tappet.runtime.process import RuntimeProcess

async def main():
    process = await RuntimeProcess.start(Path(sys.argv[1]), options=("--no-realtime",))
    print(process.endpoint.pid, process.endpoint.url, process.endpoint.token, flush=True)
    await asyncio.sleep(600)

asyncio.run(main())
"""


async def test_a_runtime_ends_properly_when_the_server_that_started_it_is_killed(tmp_path: Path) -> None:
    """Nobody would look after it, and the next server starts one of its own on the same folder."""
    folder = tmp_path / "plc"
    parent = await asyncio.create_subprocess_exec(
        sys.executable, "-c", ORPHAN, str(folder), stdout=asyncio.subprocess.PIPE
    )
    assert parent.stdout is not None
    pid, url, token = (await parent.stdout.readline()).decode().split()
    async with await RuntimeClient.connect(url, token) as client:
        await client.download(build(TEXT, TASKS, gvls=LISTS).to_bytes())
        await client.call(Start())
        await until(lambda: counted(client, 20))
    parent.kill()
    await parent.wait()

    left = (Path(f"/proc/{pid}"), folder / "running")

    async def gone() -> bool:
        return not any(map(os.path.exists, left))

    await until(gone)
    assert (folder / "retain.saved").exists(), "a proper end"


async def test_two_runtimes_never_share_a_folder(tmp_path: Path) -> None:
    with owned(tmp_path), pytest.raises(OSError, match="used by another soft PLC"), owned(tmp_path, 0.1):
        pass
    with owned(tmp_path):
        pass
    held = await asyncio.create_subprocess_exec(
        "flock", str(tmp_path), sys.executable, "-c", "print(1, flush=True); input()",
        stdin=asyncio.subprocess.PIPE, stdout=asyncio.subprocess.PIPE,
    )  # fmt: skip
    assert held.stdout is not None
    await held.stdout.readline()
    waiting = asyncio.create_task(RuntimeProcess.start(tmp_path, options=OPTIONS, restart=False))
    await asyncio.sleep(0.5)
    assert not waiting.done()
    await held.communicate(b"\n")
    process = await waiting
    assert process.endpoint is not None
    await process.stop()
