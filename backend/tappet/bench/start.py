"""Start benchmark: processor time of commands and of first answers, as multiples of `python -c pass`.

Each command runs as a process of its own, with compiled bytecode, as an installation has it. What counts is
the processor time of the process and of those that it has started, the median of a few rounds. The cold cache
is an empty folder; the warm one is that which the rounds before have filled. The libraries of the product are
there always; the last rows refer to a made-up library of 500 blocks besides.
"""

from __future__ import annotations

import json
import os
import re
import signal
import subprocess
import sys
import tempfile
import time
import urllib.request
from collections.abc import Callable
from pathlib import Path
from shutil import rmtree
from statistics import median

from tappet.bench import large_library
from tappet.bench.report import Report, Row
from tappet.libraries.repository import LOCATION_VARIABLE

ROUNDS = 5
BLOCKS = 500
LINES = 30_000
BAR = "version and help at most 12 x, check and run of a small file with a warm cache at most 35 x"
PATIENCE_S = 60.0
PROGRAM = (
    "PROGRAM Main\nVAR n : INT; t : TON; END_VAR\nt(IN := TRUE, PT := T#1S);\nn := n + 1;\nEND_PROGRAM\n"
)
ON_LIBRARY = (
    "PROGRAM Main\nVAR axis : MX_AXIS_REF; m : MX_Move7; END_VAR\n"
    "m(Axis := axis, bExecute := TRUE, fTarget7 := 5);\nEND_PROGRAM\n"
)
_ADDRESS = re.compile(r"http://[\d.]+:\d+")


class Processes:
    """Processes in a folder of their own, with a cache of their own."""

    def __init__(self, folder: Path, rounds: int) -> None:
        self.rounds = rounds
        self.folder = folder
        self.cache = folder / "cache"
        self.environment = {k: v for k, v in os.environ.items() if k != "PYTHONDONTWRITEBYTECODE"}
        self.environment["XDG_CACHE_HOME"] = str(self.cache)
        self.environment[LOCATION_VARIABLE] = str(folder / "no libraries")

    def seconds(self, *words: object) -> float:
        """Processor time of a call of Python that goes well."""
        command = [sys.executable, *(str(word) for word in words)]
        process = subprocess.Popen(  # noqa: S603 - our own program and arguments
            command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, env=self.environment
        )
        _, status, used = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
        if process.returncode != 0:
            raise RuntimeError(f"{' '.join(command)} ended with {process.returncode}")
        return used.ru_utime + used.ru_stime

    def warm(self, *words: object) -> float:
        """The median of some calls, after one that fills the caches."""
        self.seconds(*words)
        return median(self.seconds(*words) for _ in range(self.rounds))

    def cold(self, *words: object) -> float:
        """The median of some calls without anything in the cache."""
        times = []
        for _ in range(self.rounds):
            rmtree(self.cache, ignore_errors=True)
            times.append(self.seconds(*words))
        return median(times)


def first_page(processes: Processes) -> float:
    """Processor time of a server without a runtime until it has served its first page."""
    data = processes.folder / "server"
    command = [sys.executable, "-m", "tappet", "serve", "--port", "0", "--no-runtime", "--data", str(data)]
    with subprocess.Popen(  # noqa: S603 - our own program and arguments
        command, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True, env=processes.environment
    ) as server:
        assert server.stdout is not None
        try:
            address = next(found[0] for line in server.stdout if (found := _ADDRESS.search(line)))
            with urllib.request.urlopen(f"{address}/api/v1/health", timeout=PATIENCE_S) as answer:  # noqa: S310
                answer.read()
            return _processor_seconds(server.pid)
        finally:
            server.send_signal(signal.SIGTERM)


def first_message(processes: Processes, folder: Path, then: Callable[[], None] | None = None) -> float:
    """Processor time of a language server until the messages of the first document come.

    Before the server ends, `then` is called.
    """
    command = [sys.executable, "-m", "tappet", "lsp", str(folder), "--stdio"]
    (document,) = folder.glob("*.st")
    item = {
        "uri": document.as_uri(),
        "languageId": "iec-st",
        "version": 0,
        "text": document.read_text(encoding="utf-8").replace("END_PROGRAM", "x := ;\nEND_PROGRAM"),
    }
    hello: dict[str, object] = {"processId": None, "rootUri": folder.as_uri(), "capabilities": {}}
    with subprocess.Popen(  # noqa: S603 - our own program and arguments
        command,
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        stderr=subprocess.DEVNULL,
        env=processes.environment,
    ) as server:
        assert server.stdin is not None
        assert server.stdout is not None
        try:
            server.stdin.write(_framed({"id": 1, "method": "initialize", "params": hello}))
            server.stdin.write(_framed({"method": "initialized", "params": {}}))
            server.stdin.write(_framed({"method": "textDocument/didOpen", "params": {"textDocument": item}}))
            server.stdin.flush()
            while True:
                size = 0
                while (line := server.stdout.readline().strip()) != b"":
                    name, _, value = line.partition(b":")
                    size = int(value) if name.lower() == b"content-length" else size
                message = json.loads(server.stdout.read(size))
                if (
                    message.get("method") == "textDocument/publishDiagnostics"
                    and message["params"]["diagnostics"]
                ):
                    seconds = _processor_seconds(server.pid)
                    if then is not None:
                        then()
                    return seconds
        finally:
            server.kill()


def _framed(message: dict[str, object]) -> bytes:
    data = json.dumps({"jsonrpc": "2.0", **message}).encode()
    return b"Content-Length: %d\r\n\r\n%s" % (len(data), data)


def _processor_seconds(pid: int) -> float:
    """Processor time of a process that runs, and of its processes that have ended or run."""
    ticks = 0
    for folder in Path("/proc").glob("[0-9]*"):
        try:
            fields = (folder / "stat").read_text().rpartition(")")[2].split()
        except OSError:
            continue
        if int(folder.name) == pid or int(fields[1]) == pid:
            ticks += sum(int(field) for field in fields[11:15])
    return ticks / os.sysconf("SC_CLK_TCK")


def run(rounds: int = ROUNDS, blocks: int = BLOCKS, lines: int = LINES) -> Report:
    """Commands, the first page of the server and the first message of the language server."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        processes = Processes(folder, rounds)
        plain = _program(folder / "plain", PROGRAM)
        large = _program(folder / "large", ON_LIBRARY)
        base = median(processes.seconds("-c", "pass") for _ in range(4 * rounds))
        tappet = ("-m", "tappet")
        rows: list[Row] = []

        def row(what: str, seconds: float, note: str = "") -> None:
            rows.append(Row(what, seconds * 1e3, base * 1e3, "ms", note))

        row("version", processes.warm(*tappet, "--version"))
        row("help", processes.warm(*tappet, "--help"))
        for cache, measure in (("cold", processes.cold), ("warm", processes.warm)):
            row(f"check, {cache} cache", measure(*tappet, "check", plain))
            row(f"run, {cache} cache", measure(*tappet, "run", plain, "--virtual"))
        row("library show", processes.warm(*tappet, "library", "show", "Standard"))
        first_page(processes)  # makes the database
        row("first page of the server", median(first_page(processes) for _ in range(rounds)))
        for cache, messages in (("cold", _cold_messages), ("warm", _warm_messages)):
            row(f"first message of the language server, {cache} cache", messages(processes, plain.parent))
        large_library.install(folder / "libraries", blocks, lines)
        processes.environment[LOCATION_VARIABLE] = str(folder / "libraries")
        note = f"library of {blocks} blocks"
        row("check, cold cache", processes.cold(*tappet, "check", large), note)
        row("check, warm cache", processes.warm(*tappet, "check", large), note)
        row("run, warm cache", processes.warm(*tappet, "run", large, "--virtual"), note)
        for cache, messages in (("cold", _cold_messages), ("warm", _warm_messages)):
            row(
                f"first message of the language server, {cache} cache",
                messages(processes, large.parent),
                note,
            )
        return Report("start", "python -c pass", rows, BAR)


def _cold_messages(processes: Processes, folder: Path) -> float:
    times = []
    for _ in range(processes.rounds):
        rmtree(processes.cache, ignore_errors=True)
        times.append(first_message(processes, folder))
    return median(times)


def _warm_messages(processes: Processes, folder: Path) -> float:
    indexes = processes.cache / "tappet" / "libraries"

    def until_indexed() -> None:
        """The server makes the index of its libraries after the messages."""
        started = time.monotonic()
        while not any(indexes.glob("*")) and time.monotonic() < started + PATIENCE_S:
            time.sleep(0.05)

    rmtree(processes.cache, ignore_errors=True)
    first_message(processes, folder, until_indexed)
    return median(first_message(processes, folder) for _ in range(processes.rounds))


def _program(folder: Path, text: str) -> Path:
    folder.mkdir()
    file = folder / "main.st"
    file.write_text(text, encoding="utf-8")
    return file
