"""Load: what a hundred browsers cost a runtime with a 1 ms task, and the server between them.

Each browser is a WebSocket client that watches 100 values at 10 Hz; the clients run in processes of their
own. Beside them a trace samples 64 variables in every cycle, whose long-term recording the server writes, and
the flight recorder keeps its past. The baseline is the same task in the same run with nobody there. Shown are
lateness of the task by percentiles of its histogram, and processor time of runtime and server in percent of a
processor.
"""

from __future__ import annotations

import asyncio
import json
import multiprocessing
import os
import re
import subprocess
import sys
import tempfile
import time
import urllib.request
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from http.cookiejar import CookieJar
from multiprocessing.connection import Connection
from pathlib import Path
from typing import Any

from websockets.asyncio.client import connect
from websockets.typing import Origin

from tappet.bench.report import Report, Row
from tappet.runtime.client import RuntimeClient
from tappet.runtime.operations.flight import GetFlightStatus
from tappet.runtime.operations.tasks import ListHistograms, ListTasks, ResetStatistics
from tappet.runtime.process import Endpoint, RuntimeProcess
from tappet.runtime.tasks import log_class_edge
from tappet.server.auth.origin import CLIENT_HEADER

BROWSERS = 100
VALUES = 100
INTERVAL_MS = 100
TRACED = 64
READ = 10_000
"""Samples of the recording that are read back at once."""
PROCESSES = 4
"""That the browsers run in; each has an account of its own, as one user has at most 64 sockets."""
SECONDS = 20.0
PATIENCE_S = 120.0
PASSWORD = "a long enough word 1"  # noqa: S105 - of an account that lives as long as the benchmark
BAR = "the runtime gives the same frames to 100 browsers once, not 100 times"
PROGRAM = f"""PROGRAM PLC_PRG
VAR
    aValues : ARRAY [1..{VALUES}] OF LREAL;
    i : INT;
END_VAR
FOR i := 1 TO {VALUES} DO
    aValues[i] := aValues[i] + INT_TO_LREAL(i);
END_FOR
END_PROGRAM"""


@dataclass(frozen=True, slots=True)
class Size:
    """How much is done."""

    browsers: int = BROWSERS
    processes: int = PROCESSES
    seconds: float = SECONDS


@dataclass(frozen=True, slots=True)
class Seen:
    """What the browsers of one process have seen."""

    frames: int
    wire_bytes: int
    least: int
    """Frames of the browser that got the fewest."""


@dataclass(frozen=True, slots=True)
class Measured:
    """One situation."""

    p50_us: float
    p99_us: float
    p999_us: float
    max_us: float
    runtime_percent: float
    server_percent: float


class Server:
    """`tappet serve` with its runtime, and an account of its own for each process of browsers."""

    def __init__(self, address: str, pid: int) -> None:
        self.address = address
        self.pid = pid
        self._opener = urllib.request.build_opener(urllib.request.HTTPCookieProcessor(CookieJar()))

    def log_in(self, link: str) -> None:
        """By the link that the server prints."""
        self._opener.open(link, timeout=PATIENCE_S).read()

    def ask(self, method: str, path: str, body: Any = None) -> Any:
        """An answer of the API."""
        data = None if body is None else json.dumps(body).encode()
        request = urllib.request.Request(f"{self.address}/api/v1{path}", data, method=method)  # noqa: S310
        request.add_header("Content-Type", "application/json")
        request.add_header("Origin", self.address)
        request.add_header(CLIENT_HEADER, "1")
        with self._opener.open(request, timeout=PATIENCE_S) as answer:
            text = answer.read()
        return json.loads(text) if text else None

    def bytes(self, path: str) -> bytes:
        """A binary answer of the API."""
        request = urllib.request.Request(f"{self.address}/api/v1{path}")  # noqa: S310
        with self._opener.open(request, timeout=PATIENCE_S) as answer:
            return bytes(answer.read())

    def cookie(self, username: str) -> str:
        """The session of a new account that may look."""
        self.ask("POST", "/users", {"username": username, "password": PASSWORD, "role": "viewer"})
        other = Server(self.address, self.pid)
        jar = CookieJar()
        other._opener = urllib.request.build_opener(urllib.request.HTTPCookieProcessor(jar))
        other.ask("POST", "/auth/login", {"username": username, "password": PASSWORD})
        return "; ".join(f"{one.name}={one.value}" for one in jar)


@contextmanager
def served(folder: Path) -> Iterator[Server]:
    """A server without a runtime of its own."""
    log = folder / "serve.log"
    command = [sys.executable, "-m", "tappet", "serve", "--port", "0", "--data", str(folder / "data")]
    environment = os.environ | {"PYTHONUNBUFFERED": "1"}
    with log.open("w") as out:
        process = subprocess.Popen(  # noqa: S603 - our own program and arguments
            [*command, "--no-runtime", "--local-link"], stdout=out, stderr=subprocess.STDOUT, env=environment
        )
        try:
            end = time.monotonic() + PATIENCE_S
            while not (links := re.findall(r"https?://\S+/auth/link\?token=\S+", log.read_text())):
                if process.poll() is not None or time.monotonic() > end:
                    raise RuntimeError(f"the server did not start: {log.read_text()}")
                time.sleep(0.1)
            server = Server(links[-1].split("/api/")[0], process.pid)
            server.log_in(links[-1])
            yield server
        finally:
            process.terminate()
            process.wait(PATIENCE_S)


def load_program(server: Server, runtime_id: str) -> None:
    """A project with one 1 ms task, downloaded and started."""
    project = server.ask("POST", "/projects", {"name": "Load"})["id"]
    objects = server.ask("GET", f"/projects/{project}/objects")
    by_kind = {item["kind"]: item["id"] for item in objects}
    place = f"/projects/{project}/objects"

    def change(object_id: str, **data: Any) -> None:
        item = server.ask("GET", f"{place}/{object_id}")
        body = {"base_revision": item["revision"], "data": item["data"] | data}
        server.ask("PUT", f"{place}/{object_id}", body)

    program = next(item["id"] for item in objects if item["name"] == "PLC_PRG")
    head, body = PROGRAM.removesuffix("END_PROGRAM").split("END_VAR\n")
    change(program, declaration=f"{head}END_VAR", implementation=body)
    change(by_kind["task"], interval="T#1ms")
    application = f"/projects/{project}/applications/{by_kind['application']}"
    server.ask("POST", f"{application}/download", {"runtime_id": runtime_id, "mode": "download"})


# -- browsers ---------------------------------------------------------------------------------------


async def _browse(address: str, runtime_id: str, cookie: str, count: int, pipe: Connection) -> None:
    """Opens sockets, watches, says when the first frames are there, counts until it is told to stop."""
    url = f"{address.replace('http', 'ws', 1)}/api/v1/online?runtime={runtime_id}"
    order = {
        "op": "subscribe",
        "id": 1,
        "expressions": [f"PLC_PRG.aValues[{number}]" for number in range(1, VALUES + 1)],
        "interval_ms": INTERVAL_MS,
    }
    frames, sizes = [0] * count, [0] * count
    first = [asyncio.Event() for _ in range(count)]

    async def one(number: int) -> None:
        async with connect(
            url, additional_headers={"Cookie": cookie}, origin=Origin(address), proxy=None
        ) as socket:
            await socket.send(json.dumps(order))
            async for message in socket:
                if isinstance(message, bytes):
                    frames[number] += 1
                    sizes[number] += len(message)
                    first[number].set()

    tasks = [asyncio.create_task(one(number)) for number in range(count)]
    await asyncio.wait_for(asyncio.gather(*(event.wait() for event in first)), PATIENCE_S)
    pipe.send(None)
    await asyncio.to_thread(pipe.recv)
    frames[:], sizes[:] = [0] * count, [0] * count
    await asyncio.to_thread(pipe.recv)
    pipe.send(Seen(sum(frames), sum(sizes), min(frames)))
    for task in tasks:
        task.cancel()
    await asyncio.gather(*tasks, return_exceptions=True)


def _browsers(address: str, runtime_id: str, cookie: str, count: int, pipe: Connection) -> None:
    asyncio.run(_browse(address, runtime_id, cookie, count, pipe))


class Browsers:
    """Many of them, in some processes."""

    def __init__(self, server: Server, runtime_id: str, size: Size) -> None:
        context = multiprocessing.get_context("spawn")
        self._pipes: list[Connection] = []
        self._processes = []
        for number in range(size.processes):
            mine, theirs = context.Pipe()
            count = size.browsers // size.processes + (number < size.browsers % size.processes)
            cookie = server.cookie(f"watcher{number}")
            process = context.Process(
                target=_browsers, args=(server.address, runtime_id, cookie, count, theirs), daemon=True
            )
            process.start()
            self._pipes.append(mine)
            self._processes.append(process)

    def ready(self) -> None:
        """Returns when each has seen values."""
        for pipe in self._pipes:
            if not pipe.poll(PATIENCE_S):
                raise RuntimeError("browsers got no values")
            pipe.recv()

    def tell(self) -> None:
        """The measurement begins, or ends."""
        for pipe in self._pipes:
            pipe.send(None)

    def seen(self) -> Seen:
        """What came in between."""
        found: list[Seen] = [pipe.recv() for pipe in self._pipes]
        for process in self._processes:
            process.join(PATIENCE_S)
        return Seen(
            sum(one.frames for one in found),
            sum(one.wire_bytes for one in found),
            min(one.least for one in found),
        )


# -- measuring --------------------------------------------------------------------------------------


def _processor_s(pid: int) -> float:
    """Processor time that a process has used."""
    fields = Path(f"/proc/{pid}/stat").read_text(encoding="ascii").rpartition(")")[2].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


def percentile_us(classes: Sequence[int], part: float) -> float:
    """Upper edge of the class of a histogram that `part` of the entries lie in or below."""
    wanted, seen = part * sum(classes), 0
    for number, count in enumerate(classes):
        seen += count
        if seen >= wanted:
            return log_class_edge(number + 1) / 1000.0
    return log_class_edge(len(classes)) / 1000.0


async def _measure(client: RuntimeClient, server: Server, endpoint: Endpoint, seconds: float) -> Measured:
    await client.call(ResetStatistics())
    before = _processor_s(endpoint.pid), _processor_s(server.pid)
    began = time.monotonic()
    await asyncio.sleep(seconds)
    lasted = time.monotonic() - began
    after = _processor_s(endpoint.pid), _processor_s(server.pid)
    (histogram,) = await client.call(ListHistograms())
    (task,) = await client.call(ListTasks())
    return Measured(
        percentile_us(histogram.jitters, 0.5),
        percentile_us(histogram.jitters, 0.99),
        percentile_us(histogram.jitters, 0.999),
        max(abs(task.jitter_min_ns), task.jitter_max_ns) / 1000.0,
        100 * (after[0] - before[0]) / lasted,
        100 * (after[1] - before[1]) / lasted,
    )


@dataclass(frozen=True, slots=True)
class Traced:
    """What the long-term recording of the trace holds."""

    samples: int
    lost: int
    gaps: int
    """Samples before which others are missing."""


class Trace:
    """64 variables traced in each cycle, and recorded by the server for as long as it lasts."""

    def __init__(self, server: Server, runtime_id: str) -> None:
        self._server = server
        self._path = f"/runtimes/{runtime_id}/traces/Load"
        channels = [{"variable": f"PLC_PRG.aValues[{number}]"} for number in range(1, TRACED + 1)]
        data = {"records": [{"name": "Record1", "buffer": 10_000, "channels": channels}]}
        server.ask("PUT", self._path, {"data": data})
        server.ask("POST", f"{self._path}/recording", {"title": "Load"})

    def end(self) -> Traced:
        """Ends the recording and reads it back."""
        recording = self._server.ask("DELETE", f"{self._path}/recording")
        samples = recording["records"][0]["samples"]
        gaps, first = 0, 0
        while first < samples:
            data = self._server.bytes(f"/recordings/{recording['id']}/samples?first={first}&count={READ}")
            flags = data[-min(READ, samples - first) :]
            gaps += sum(flags[1 if first == 0 else 0 :])
            first += READ
        return Traced(samples, recording["lost"], gaps)


@dataclass(frozen=True, slots=True)
class Outcome:
    """Both situations, and what came through."""

    idle: Measured
    loaded: Measured
    seen: Seen
    traced: Traced
    past: int
    """Cycles that the flight recorder holds."""
    lasted: float
    """Seconds that the browsers counted."""


async def outcome(size: Size) -> Outcome:
    """Measures with nobody there, then with all of them."""
    with tempfile.TemporaryDirectory(prefix="tappet-load-") as name, served(Path(name)) as server:
        process = await RuntimeProcess.start(Path(name) / "runtime")
        try:
            assert process.endpoint is not None
            endpoint = process.endpoint
            body = {"name": "Load", "url": endpoint.url, "token": endpoint.token}
            runtime_id = (await asyncio.to_thread(server.ask, "POST", "/runtimes", body))["id"]
            await asyncio.to_thread(load_program, server, runtime_id)
            client = await RuntimeClient.connect(endpoint.url, endpoint.token)
            try:
                idle = await _measure(client, server, endpoint, size.seconds)
                browsers = await asyncio.to_thread(Browsers, server, runtime_id, size)
                await asyncio.to_thread(browsers.ready)
                trace = await asyncio.to_thread(Trace, server, runtime_id)
                began = time.monotonic()
                browsers.tell()
                loaded = await _measure(client, server, endpoint, size.seconds)
                browsers.tell()
                lasted = time.monotonic() - began
                seen = await asyncio.to_thread(browsers.seen)
                past = (await client.call(GetFlightStatus())).count
                traced = await asyncio.to_thread(trace.end)
            finally:
                await client.close()
            return Outcome(idle, loaded, seen, traced, past, lasted)
        finally:
            await process.stop()


def report(found: Outcome, size: Size) -> Report:
    """The rows: with all browsers, beside nobody."""
    idle, loaded, seen = found.idle, found.loaded, found.seen
    rows = [
        Row("lateness, 50 %", loaded.p50_us, idle.p50_us, "us"),
        Row("lateness, 99 %", loaded.p99_us, idle.p99_us, "us"),
        Row("lateness, 99.9 %", loaded.p999_us, idle.p999_us, "us"),
        Row("lateness, largest", loaded.max_us, idle.max_us, "us"),
        Row("processor, runtime", loaded.runtime_percent, idle.runtime_percent, "%"),
        Row("processor, server", loaded.server_percent, idle.server_percent, "%"),
    ]
    a_second = seen.frames / size.browsers / found.lasted
    each = f"{a_second:.1f} frames a second each (wanted {1000 / INTERVAL_MS:g})"
    remarks = (
        f"{size.browsers} browsers in {size.processes} processes on the same machine: {each}, at least "
        f"{seen.least / found.lasted:.1f}; {seen.wire_bytes / found.lasted / 1e6:.2f} MB/s in all",
        f"{TRACED} variables traced in every cycle and recorded by the server: "
        f"{found.traced.samples} samples, {found.traced.lost} lost, {found.traced.gaps} gaps; "
        f"the flight recorder holds {found.past} cycles",
    )
    return Report("load", "the same task with nobody there, same run", rows, BAR, remarks)


def run() -> Report:
    """A hundred browsers."""
    size = Size()
    return report(asyncio.run(outcome(size)), size)
