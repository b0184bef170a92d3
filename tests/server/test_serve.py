"""`tappet serve` as a process."""

from __future__ import annotations

import asyncio
import os
import re
import signal
import socket
import subprocess
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import httpx
import pytest

from tappet.server import serve
from tappet.server.projects.examples import UnknownExampleError, example_folders, find_example
from tappet.server.settings import ServerSettings


class Process:
    def __init__(self, process: subprocess.Popen[str], log: Path) -> None:
        self.process = process
        self.log = log

    def wait_for(self, pattern: str, count: int = 1, seconds: float = 60) -> re.Match[str]:
        end = time.monotonic() + seconds
        while True:
            found = list(re.finditer(pattern, self.log.read_text()))
            if len(found) >= count:
                return found[-1]
            assert self.process.poll() is None, self.log.read_text()
            assert time.monotonic() < end, self.log.read_text()
            time.sleep(0.05)


@contextmanager
def serving(tmp_path: Path, *arguments: str, name: str = "log") -> Iterator[Process]:
    log = tmp_path / name
    command = [sys.executable, "-m", "tappet", "serve", "--port", "0", "--data", str(tmp_path / "data")]
    environment = {k: v for k, v in os.environ.items() if k != "DATABASE_URL"}
    with log.open("w") as out:
        process = subprocess.Popen(
            [*command, *arguments], stdout=out, stderr=subprocess.STDOUT, env=environment
        )
        try:
            yield Process(process, log)
        finally:
            if process.poll() is None:
                process.send_signal(signal.SIGTERM)
            process.wait(30)


def test_first_account_token_is_printed_until_it_is_used(tmp_path: Path) -> None:
    with serving(tmp_path, "--no-runtime") as server:
        address = server.wait_for(r"serves (\S+)")[1]
        token = server.wait_for(r"\n    (\S{43})\n")[1]
        assert httpx.get(f"{address}/api/v1/auth/status").json()["first_account_needed"] is True
        body = {"token": token, "username": "ann", "password": "correct horse battery"}
        made = httpx.post(f"{address}/api/v1/auth/first-account", json=body)
        assert made.status_code == 201, made.text
        assert httpx.get(f"{address}/api/v1/health").json()["status"] == "ok"
    assert server.process.returncode == 0
    with serving(tmp_path, "--no-runtime", name="again") as server:
        server.wait_for(r"serves (\S+)")
    assert "token" not in server.log.read_text()


def test_local_link_logs_in_and_a_signal_prints_another(tmp_path: Path) -> None:
    with serving(tmp_path, "--no-runtime", "--local-link") as server:
        link = server.wait_for(r"(http\S+/auth/link\?token=\S+)")[1]
        assert "account" not in server.log.read_text(), "no first-account token beside the link"
        with httpx.Client() as browser:
            assert browser.get(link).status_code == 303
            me = browser.get(link.split("/auth/")[0] + "/auth/me").json()
            assert (me["username"], me["role"]) == ("local", "admin")
        assert httpx.get(link).status_code == 403
        server.process.send_signal(signal.SIGUSR1)
        second = server.wait_for(r"(http\S+/auth/link\?token=\S+)", 2)[1]
        assert second != link
        assert httpx.get(second).status_code == 303


def test_two_servers_do_not_share_a_data_folder(tmp_path: Path) -> None:
    with serving(tmp_path, "--no-runtime") as server:
        server.wait_for(r"serves (\S+)")
        with serving(tmp_path, "--no-runtime", name="second") as second:
            assert second.process.wait(30) == 1
        assert "another server works on" in second.log.read_text()


async def test_bodies_of_answers_do_not_wait_for_an_acknowledgement() -> None:
    accepted: asyncio.Queue[asyncio.StreamWriter] = asyncio.Queue()
    with serve._listening(ServerSettings(port=0)) as listener:
        async with await asyncio.start_server(lambda _, writer: accepted.put_nowait(writer), sock=listener):
            _, client = await asyncio.open_connection(*listener.getsockname())
            server = await accepted.get()
            socket_of = server.get_extra_info("socket")
            assert socket_of.getsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY)
            for writer in (client, server):
                writer.close()


def test_a_taken_port_is_named(tmp_path: Path) -> None:
    with socket.create_server(("127.0.0.1", 0)) as taken:
        port = taken.getsockname()[1]
        with serving(tmp_path, "--no-runtime", "--port", str(port)) as server:
            assert server.process.wait(30) == 1
        assert "--port" in server.log.read_text()
        assert "Traceback" not in server.log.read_text()


def test_example_runs_on_the_local_runtime(tmp_path: Path) -> None:
    with serving(tmp_path, "--local-link", "--example", "bottling") as server:
        link = server.wait_for(r"(http\S+/auth/link\?token=\S+)")[1]
        base = link.split("/auth/")[0]
        with httpx.Client() as browser:
            browser.get(link)
            end = time.monotonic() + 120
            while browser.get(f"{base}/runtimes/local").json()["state"] != "run":
                assert time.monotonic() < end, server.log.read_text()
                time.sleep(0.2)
            project = browser.get(f"{base}/projects").json()[0]
            assert project["name"] == "Bottling line"
            objects = browser.get(f"{base}/projects/{project['id']}/objects").json()
            application = next(o for o in objects if o["kind"] == "application")
            login = f"{base}/projects/{project['id']}/applications/{application['id']}/login"
            page = {"X-Tappet-Client": "1", "Origin": base.removesuffix("/api/v1")}
            answer = browser.post(login, json={"runtime_id": "local"}, headers=page, timeout=60)
            assert answer.json()["relation"] == "same", answer.text
    assert server.process.returncode == 0


def test_unknown_examples_are_refused_with_the_known_ones(tmp_path: Path) -> None:
    assert "bottling" in example_folders()
    with pytest.raises(UnknownExampleError, match="bottling"):
        find_example("nothing")
    with serving(tmp_path, "--no-runtime", "--example", "nothing") as server:
        assert server.process.wait(30) == 1
    assert "bottling" in server.log.read_text()
