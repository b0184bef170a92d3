"""`tappet deploy` to a soft PLC that was started by itself, and that soft PLC in the list of a server."""

from __future__ import annotations

import asyncio
import json
import os
import re
import signal
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

import pytest
from live_server import FIRST_START_S, process, until

from tappet.project import folder
from tappet.project.new_project import new_project
from tappet.runtime.client import RuntimeClient
from tappet.runtime.operations.values import Read

COUNTER = """PROGRAM Main
VAR
    n : DINT;
END_VAR
VAR RETAIN
    k : DINT := 4;
END_VAR
n := n + 1;
END_PROGRAM
"""


@dataclass
class SoftPlc:
    """`tappet runtime` as a process."""

    url: str
    token_file: Path
    folder: Path
    process: subprocess.Popen[bytes]

    async def value(self, path: str) -> int:
        """A number of the running application."""
        async with await RuntimeClient.connect(self.url, self.token_file.read_text().strip()) as client:
            symbols = await client.symbols()
            ref = symbols.resolve(path)
            (data,) = await client.call(Read([(ref.offset, ref.size)]))
            return int.from_bytes(data, "little", signed=True)


@pytest.fixture(scope="module")
def plc(tmp_path_factory: pytest.TempPathFactory) -> Iterator[SoftPlc]:
    with soft_plc(tmp_path_factory.mktemp("plc")) as running:
        yield running


@contextmanager
def soft_plc(folder: Path) -> Iterator[SoftPlc]:
    log = folder / "runtime.log"
    already = len(log.read_text()) if log.exists() else 0
    token_file = folder / "token"
    token_file.write_text("a token that the operator chose 0123456789\n")
    token_file.chmod(0o600)
    command = ["runtime", "--port", "0", "--data", str(folder / "data"), "--token-file", str(token_file)]
    with process(command, log) as started:

        def address() -> str | None:
            assert started.poll() is None, log.read_text()
            found = re.search(r"ws://\S+:\d+", log.read_text()[already:])
            return found[0] if found else None

        url = until(address, "address of the runtime", FIRST_START_S)
        yield SoftPlc(url, token_file, folder, started)


def deploy(*arguments: object, **environment: str) -> subprocess.CompletedProcess[str]:
    return subprocess.run(
        [sys.executable, "-m", "tappet", "deploy", *(str(argument) for argument in arguments)],
        capture_output=True,
        text=True,
        timeout=120,
        check=False,
        env={**os.environ, **environment},
    )


@pytest.fixture
def file(tmp_path: Path) -> Path:
    found = tmp_path / "counter.st"
    found.write_text(COUNTER)
    return found


def test_deploy_builds_loads_and_starts(plc: SoftPlc, file: Path) -> None:
    done = deploy(file, "--runtime", plc.url, "--token-file", plc.token_file)
    assert (done.returncode, done.stderr) == (0, "")
    assert done.stdout == f"counter on {plc.url}: run\n"
    first = asyncio.run(plc.value("Main.n"))
    until(lambda: asyncio.run(plc.value("Main.n")) > first, "the program runs")

    secret = plc.token_file.read_text().strip()
    done = deploy(file, "--runtime", plc.url, "--no-start", "--format", "json", TAPPET_RUNTIME_TOKEN=secret)
    assert done.returncode == 0, done.stderr
    answer = json.loads(done.stdout)
    assert (answer["ok"], answer["application"], answer["state"]) == (True, "counter", "stop")
    assert asyncio.run(plc.value("Main.n")) == 0, "a download begins again"


def test_a_program_with_errors_is_not_deployed(plc: SoftPlc, file: Path) -> None:
    file.write_text(COUNTER.replace("n + 1", "m + 1"))
    done = deploy(file, "--runtime", plc.url, "--token-file", plc.token_file)
    assert done.returncode == 1
    assert f"{file}:8:6: error E0201: " in done.stderr
    assert "Traceback" not in done.stderr


def test_whoever_has_no_token_deploys_nothing(plc: SoftPlc, file: Path, tmp_path: Path) -> None:
    wrong = tmp_path / "wrong"
    wrong.write_text("another token")
    refusals = {
        "wrong token": deploy(file, "--runtime", plc.url, "--token-file", wrong),
        "--token-file": deploy(file, "--runtime", plc.url, "--token-file", tmp_path / "none"),
        "TAPPET_RUNTIME_TOKEN": deploy(file, "--runtime", plc.url, TAPPET_RUNTIME_TOKEN=""),
        "isn't a valid URI": deploy(file, "--runtime", "nonsense", "--token-file", plc.token_file),
    }
    for says, done in refusals.items():
        assert done.returncode == 2, done.stdout
        assert says in done.stderr
        assert "Traceback" not in done.stderr


def test_the_source_goes_to_another_process_and_comes_back(plc: SoftPlc, tmp_path: Path) -> None:
    def tappet(*arguments: object) -> subprocess.CompletedProcess[str]:
        runtime = ("--runtime", plc.url, "--token-file", plc.token_file)
        return subprocess.run(
            [sys.executable, "-m", "tappet", *map(str, (*arguments, *runtime))],
            capture_output=True,
            text=True,
            timeout=120,
            check=False,
        )

    project = tmp_path / "press"
    folder.save(new_project("Press"), project)
    assert tappet("source", "show").returncode == 1
    missing = tappet("source", "upload", "--to", tmp_path / "none")
    assert (missing.returncode, "there is no source" in missing.stderr) == (2, True)
    stored = tappet("source", "download", project)
    assert stored.returncode == 0, stored.stderr
    assert "source of 'Press'" in stored.stdout
    assert "from another version" in stored.stdout
    deployed = tappet("deploy", project, "--source")
    assert deployed.returncode == 0, deployed.stderr
    shown = json.loads(tappet("source", "show", "--format", "json").stdout)
    assert (shown["project"], shown["current"]) == ("Press", True)
    back = tappet("source", "upload", "--to", tmp_path / "back")
    assert back.returncode == 0, back.stderr
    left, right = (
        {path.relative_to(top): path.read_bytes() for path in top.rglob("*") if path.is_file()}
        for top in (project, tmp_path / "back")
    )
    assert left == right
    assert "is not empty" in tappet("source", "upload", "--to", project).stderr


def test_a_soft_plc_that_stops_takes_its_program_up_again(plc: SoftPlc, file: Path) -> None:
    """Last here: it ends the runtime of this module."""
    assert deploy(file, "--runtime", plc.url, "--token-file", plc.token_file).returncode == 0
    plc.process.send_signal(signal.SIGTERM)
    assert plc.process.wait(30) == 0
    with soft_plc(plc.folder) as again:
        until(lambda: asyncio.run(again.value("Main.n")) > 0, "the boot application runs")
        done = deploy(file, "--runtime", plc.url, "--token-file", plc.token_file)
        assert done.returncode == 2, "nobody listens at the old address"
        assert "no runtime at" in done.stderr
