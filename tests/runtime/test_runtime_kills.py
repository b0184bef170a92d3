"""SIGKILL at any moment, over and over: no remanent value is torn or older than it was seen, the boot
application starts again, and nothing is left behind.

Each round starts a soft PLC on the same folder and kills it: while it starts, while it runs, or during a
download or an online change. `TAPPET_KILLS` is the number of kills of the long version.
"""

from __future__ import annotations

import asyncio
import json
import os
import random
import signal
import subprocess
import sys
from collections import Counter
from contextlib import suppress
from dataclasses import dataclass, field
from functools import cache
from pathlib import Path
from typing import Literal

import pytest
from plc_programs import MS, build

from tappet.codegen.package import CodePackage
from tappet.iec.task import Task
from tappet.runtime.client import ConnectionLost, RuntimeClient
from tappet.runtime.operations.life_cycle import GetInfo, Start
from tappet.runtime.operations.reports import GetException
from tappet.runtime.operations.values import Read

FEW, MANY = 4, int(os.environ.get("TAPPET_KILLS", "500"))
SLOTS = 400
TEXT = f"""PROGRAM PLC_PRG
VAR RETAIN count : LINT; words : ARRAY[1..{SLOTS}] OF LINT; END_VAR
VAR n, first, firstHours, torn, i : LINT; END_VAR
IF n = 0 THEN
    first := count;
    firstHours := hours;
    FOR i := 1 TO {SLOTS} DO IF words[i] <> count * i THEN torn := torn + 1; END_IF END_FOR
    IF hours <> twin THEN torn := torn + 1000; END_IF
END_IF
n := n + 1;
count := count + 1;
hours := hours + 1;
FOR i := 1 TO {SLOTS} DO words[i] := count * i; END_FOR
twin := hours;
END_PROGRAM
PROGRAM Second
VAR RETAIN a : LINT; text : STRING(200); b : LINT; END_VAR
VAR n, torn : LINT; END_VAR
IF n = 0 AND (a <> b OR (a <> 0 AND text <> CONCAT('count ', LINT_TO_STRING(a)))) THEN torn := 1; END_IF
n := n + 1;
a := a + 1;
text := CONCAT('count ', LINT_TO_STRING(a));
b := a;
END_PROGRAM
"""
LISTS = {"Persistent": "VAR_GLOBAL PERSISTENT RETAIN hours, twin : LINT; END_VAR"}
TASKS = (
    Task("Main", interval_ns=1 * MS, priority=1, programs=("PLC_PRG",)),
    Task("Other", interval_ns=2 * MS, priority=2, programs=("Second",)),
)
NAMES = (
    "PLC_PRG.first", "PLC_PRG.firstHours", "PLC_PRG.torn", "Second.torn",
    "PLC_PRG.n", "PLC_PRG.count", "Persistent.hours",
)  # fmt: skip
KEPT_FILES = {"boot.tappet", "retain.live", "retain.saved", "token"}
WHILE_IT_RUNS = KEPT_FILES | {"running", "retain.new"}
Mode = Literal["download", "online_change"]


@cache
def packages() -> tuple[CodePackage, CodePackage]:
    """Two versions, each of which can be changed over to from the other."""
    first = build(TEXT, TASKS, gvls=LISTS)
    other = TEXT.replace("torn + 1000", "torn + 2000")
    return build(TEXT, TASKS, gvls=LISTS, previous=build(other, TASKS, gvls=LISTS)), build(
        other, TASKS, gvls=LISTS, previous=first
    )


@dataclass
class Machine:
    """A soft PLC on one folder, and what was seen of it."""

    folder: Path
    random: random.Random
    count: int = 0
    hours: int = 0
    """Remanent values that were seen last."""
    seen: Counter[str] = field(default_factory=Counter)
    process: subprocess.Popen[bytes] | None = None

    def spawn(self) -> int:
        """Starts the process; returns the pipe that says when it listens."""
        read, write = os.pipe()
        self.process = subprocess.Popen(
            [
                sys.executable, "-m", "tappet.runtime", "--data", str(self.folder), "--port", "0",
                "--no-realtime", "--flight-memory", "8", "--ready-fd", str(write),
            ],
            pass_fds=(write,), stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
            stderr=(self.folder.parent / "log").open("ab"),
            env={**os.environ, "TMPDIR": str(self.folder.parent / "tmp")},
        )  # fmt: skip
        os.close(write)
        return read

    def kill(self) -> None:
        """SIGKILL; nothing may be left of the process but the files of the next one."""
        process = self.process
        assert process is not None
        assert process.poll() is None, f"ended by itself: {(self.folder.parent / 'log').read_text()[-2000:]}"
        children = _children(process.pid)
        process.kill()
        assert process.wait() == -signal.SIGKILL
        assert [child for child in children if Path(f"/proc/{child}").exists()] == []
        self.seen["kills"] += 1

    def maps(self) -> str:
        """What its memory is."""
        assert self.process is not None
        return Path(f"/proc/{self.process.pid}/maps").read_text()

    async def ready(self, pipe: int) -> RuntimeClient:
        """The client of a process that has come up."""
        said = await asyncio.wait_for(asyncio.to_thread(_read_all, pipe), 60)
        told = json.loads(said)
        return await RuntimeClient.connect(f"ws://127.0.0.1:{told['port']}", told["token"])

    async def find(self, client: RuntimeClient) -> None:
        """Looks at what the start has found, and starts what waits for it."""
        info = await client.call(GetInfo())
        assert info.code_id in {package.code_id for package in packages()}
        if info.state == "exception":
            report = await client.call(GetException())
            assert report is not None
            assert report.name == "PROCESS_ENDED"
            assert "without a reason that is known" in report.message
            await client.call(Start())
            self.seen["waited for a start"] += 1
        else:
            self.seen["started by itself"] += 1
        assert (await client.call(GetInfo())).state == "run"
        values = await self.values(client)
        assert (values["PLC_PRG.torn"], values["Second.torn"]) == (0, 0), values
        # what a cycle has written is kept at its end: the one that was killed may be missing
        assert values["PLC_PRG.first"] >= self.count - 1, (values, self.count)
        assert values["PLC_PRG.firstHours"] >= self.hours - 1, (values, self.hours)

    async def values(self, client: RuntimeClient) -> dict[str, int]:
        """Values after the first cycle."""
        symbols = await client.symbols()
        places = [(symbols.resolve(name).offset, 8) for name in NAMES]
        while True:
            data = await client.call(Read(places))
            found = dict(zip(NAMES, (int.from_bytes(d, "little") for d in data), strict=True))
            if found["PLC_PRG.n"]:
                return found
            await asyncio.sleep(0.002)

    async def round(self) -> None:
        """One start and one kill."""
        pipe = self.spawn()
        if self.random.random() < 0.25:
            await asyncio.sleep(self.random.uniform(0, 0.8))
            os.close(pipe)
            self.kill()
            self.seen["while it started"] += 1
            return
        client = await self.ready(pipe)
        try:
            await self.find(client)
            changing = None
            if self.random.random() < 0.3:
                changing = asyncio.create_task(self.change(client))
            await asyncio.sleep(self.random.uniform(0, 0.15))
            if changing is None:
                values = await self.values(client)
                self.count, self.hours = values["PLC_PRG.count"], values["Persistent.hours"]
            self.kill()
            if changing is not None:
                await changing
        finally:
            await client.close()
        more = {path.name for path in self.folder.iterdir()} - WHILE_IT_RUNS
        unfinished = {name for name in more if name.startswith(".boot.tappet.")}
        assert (more - unfinished, len(unfinished) <= 1) == (set(), True), "the next start removes it"

    async def change(self, client: RuntimeClient) -> None:
        """Loads the other version; the kill may come at any time."""
        with suppress(ConnectionLost):
            info = await client.call(GetInfo())
            (other,) = [package for package in packages() if package.code_id != info.code_id]
            mode: Mode = self.random.choice(("download", "online_change"))
            self.seen[f"during a {mode}"] += 1
            if mode == "download":
                self.count = 0  # RETAIN variables begin anew, PERSISTENT ones do not
            await client.download(other.to_bytes(), mode)
            await client.call(Start())
            self.seen["of these after the answer"] += 1


def _read_all(fd: int) -> str:
    with os.fdopen(fd) as pipe:
        return pipe.read()


def _children(pid: int) -> list[str]:
    found = Path(f"/proc/{pid}/task").glob("*/children")
    return [child for path in found for child in path.read_text().split()]


@pytest.mark.parametrize("kills", [FEW, pytest.param(MANY, marks=pytest.mark.slow)])
async def test_a_killed_soft_plc_goes_on_where_it_was(tmp_path: Path, kills: int) -> None:
    folder = tmp_path / "plc"
    (tmp_path / "tmp").mkdir()
    machine = Machine(folder, random.Random(kills))
    folder.mkdir(mode=0o700)
    client = await machine.ready(machine.spawn())
    async with client:
        await client.download(packages()[0].to_bytes())
        await client.call(Start())
        assert "/dev/shm" not in machine.maps(), "shared memory with a name would outlive it"
    machine.kill()
    while machine.seen["kills"] < kills:
        await machine.round()
        print(dict(machine.seen), flush=True)
    client = await machine.ready(machine.spawn())
    async with client:
        await machine.find(client)
    assert machine.process is not None
    machine.process.terminate()
    assert await asyncio.to_thread(machine.process.wait, 30) == 0
    assert {path.name for path in folder.iterdir()} == KEPT_FILES
    assert list((tmp_path / "tmp").iterdir()) == []
    if kills > 100:
        least = {"while it started": 10, "during a download": 5, "during a online_change": 5}
        assert all(machine.seen[what] >= number for what, number in least.items()), machine.seen
