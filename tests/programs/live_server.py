"""A real `tappet serve` with its soft PLC, used the way a script uses it: processes, HTTP, a bearer token."""

from __future__ import annotations

import os
import re
import signal
import subprocess
import sys
import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import httpx

RUNTIME = "/runtimes/local"
FIRST_START_S = 90


def until(condition: Callable[[], Any], what: str, seconds: float = 60) -> Any:
    """The first true answer of `condition`."""
    end = time.monotonic() + seconds
    while True:
        found = condition()
        if found:
            return found
        assert time.monotonic() < end, f"did not happen: {what}"
        time.sleep(0.03)


@contextmanager
def process(
    command: list[str], log: Path, wrapped: Sequence[str] = (), **environment: str
) -> Iterator[subprocess.Popen[bytes]]:
    """`tappet ...` in the background, run by the command `wrapped` if there is one; ended as a user does."""
    inherited = {k: v for k, v in os.environ.items() if k not in ("DATABASE_URL", "TAPPET_RUNTIME_TOKEN")}
    with log.open("a") as out:
        started = subprocess.Popen(
            [*wrapped, sys.executable, "-m", "tappet", *command],
            stdin=subprocess.DEVNULL,
            stdout=out,
            stderr=subprocess.STDOUT,
            env={**inherited, **environment},
        )
    try:
        yield started
    finally:
        if started.poll() is None:
            started.send_signal(signal.SIGTERM)
        try:
            started.wait(30)
        except subprocess.TimeoutExpired:
            started.kill()
            started.wait()
            raise


@dataclass
class Script:
    """A program that talks to the server with a token of its own."""

    http: httpx.Client
    project_id: str = ""
    application_id: str = ""
    ids: dict[str, str] = field(default_factory=dict)
    """Object ids by name."""

    def call(self, method: str, path: str, body: Any = None, status: int = 200) -> Any:
        """The JSON answer; the request must end with `status`."""
        answer = self.http.request(method, path, json=body)
        assert answer.status_code == status, f"{method} {path}: {answer.status_code} {answer.text}"
        if status >= 400:
            assert answer.headers["content-type"] == "application/problem+json"
            assert answer.json()["status"] == status
            assert answer.json()["detail"]
        return answer.json() if answer.content else None

    def get(self, path: str, status: int = 200) -> Any:
        """GET."""
        return self.call("GET", path, None, status)

    def post(self, path: str, body: Any = None, status: int = 200) -> Any:
        """POST."""
        return self.call("POST", path, body, status)

    # -- project -------------------------------------------------------------------------------------

    @property
    def project(self) -> str:
        """Path of the project."""
        return f"/projects/{self.project_id}"

    @property
    def application(self) -> str:
        """Path of its application."""
        return f"{self.project}/applications/{self.application_id}"

    def create_project(self, name: str) -> None:
        """A new project of the standard template becomes the current one."""
        self.project_id = self.post("/projects", {"name": name}, 201)["id"]
        self.ids = {o["name"]: o["id"] for o in self.get(f"{self.project}/objects")}
        self.application_id = next(
            o["id"] for o in self.get(f"{self.project}/objects") if o["kind"] == "application"
        )

    def add(self, kind: str, name: str, **more: Any) -> Any:
        """A new object below the application."""
        body = {"parent_id": self.application_id, "kind": kind, "name": name, **more}
        made = self.post(f"{self.project}/objects", body, 201)
        self.ids[name] = made["id"]
        return made

    def read_object(self, name: str) -> Any:
        """An object of the current project."""
        return self.get(f"{self.project}/objects/{self.ids[name]}")

    def save(self, name: str, **changes: Any) -> Any:
        """Saves parts of an object over its newest revision."""
        now = self.read_object(name)
        body = {"base_revision": now["revision"], "data": {**now["data"], **changes}}
        return self.call("PUT", f"{self.project}/objects/{self.ids[name]}", body)

    def build(self) -> Any:
        """Report of a build."""
        return self.post(f"{self.application}/build")

    def relation(self) -> str:
        """How the project relates to what the local runtime has."""
        return str(self.post(f"{self.application}/login", {"runtime_id": "local"})["relation"])

    def download(self, mode: str = "download", status: int = 200) -> Any:
        """Loads the local runtime and starts it."""
        order = {"runtime_id": "local", "mode": mode, "start": True}
        return self.post(f"{self.application}/download", order, status)

    # -- values --------------------------------------------------------------------------------------

    def values(self, *paths: str) -> list[Any]:
        """Values of one moment."""
        found = self.post(f"{RUNTIME}/values/read", {"expressions": paths})["values"]
        assert [v["error"] for v in found] == [None] * len(paths)
        return [v["value"] for v in found]

    def value(self, path: str) -> Any:
        """One value."""
        return self.values(path)[0]

    def write(self, path: str, value: Any, status: int = 200, action: str = "write") -> Any:
        """Writes or forces one variable."""
        body = {"values": [{"expression": path, "value": value}]}
        return self.post(f"{RUNTIME}/values/{action}", body, status)

    def force(self, path: str, value: Any, status: int = 200) -> Any:
        """Forces one variable."""
        return self.write(path, value, status, "force")

    def state(self) -> Any:
        """State of the local runtime."""
        return self.get(RUNTIME)

    def wait_for_state(self, state: str, seconds: float = 60) -> Any:
        """Until the runtime is connected and in `state`."""

        def reached() -> Any:
            now = self.state()
            return now if now["connected"] and now["state"] == state else None

        return until(reached, f"runtime in state {state}", seconds)


@dataclass
class Station:
    """A running server."""

    base: str
    """Address with /api/v1."""
    process: subprocess.Popen[bytes]
    log: Path
    admin: Script

    @property
    def origin(self) -> str:
        """Address without path."""
        return self.base.removesuffix("/api/v1")

    def anonymous(self) -> Script:
        """Somebody without login."""
        return Script(httpx.Client(base_url=self.base, timeout=60))

    def browser(self, address: str = "127.0.0.1") -> Script:
        """A client that sends what the pages of the server send, and keeps cookies."""
        headers = {"X-Tappet-Client": "1", "Origin": self.origin}
        transport = httpx.HTTPTransport(local_address=address)
        return Script(httpx.Client(base_url=self.base, headers=headers, timeout=60, transport=transport))

    def script(self, secret: str) -> Script:
        """A program with a token."""
        headers = {"Authorization": f"Bearer {secret}"}
        return Script(httpx.Client(base_url=self.base, headers=headers, timeout=120))

    def runtime_pid(self) -> int:
        """Process of the local runtime: the child of the server that runs the module."""
        children = Path(f"/proc/{self.process.pid}/task/{self.process.pid}/children")
        found = [c for c in _children(self.process.pid) if "tappet.runtime" in _command(c)]
        assert len(found) == 1, children.read_text()
        return found[0]


def _children(pid: int) -> list[int]:
    return [
        int(child)
        for task in Path(f"/proc/{pid}/task").iterdir()
        for child in (task / "children").read_text().split()
    ]


def _command(pid: int) -> str:
    try:
        return Path(f"/proc/{pid}/cmdline").read_text().replace("\0", " ")
    except OSError:
        return ""


@contextmanager
def station(
    folder: Path, *options: str, wrapped: Sequence[str] = (), **environment: str
) -> Iterator[Station]:
    """A server on a free port; logged in by its local link, working with a token made from that."""
    log = folder / "server.log"
    already = len(log.read_text()) if log.exists() else 0
    command = ["serve", "--port", "0", "--data", str(folder / "data"), "--local-link", *options]
    with process(command, log, wrapped, **environment) as started:

        def printed_link() -> str | None:
            assert started.poll() is None, log.read_text()
            found = re.search(r"(http\S+/auth/link\?token=\S+)", log.read_text()[already:])
            return found[1] if found else None

        link = until(printed_link, "login link", FIRST_START_S)
        result = Station(link.split("/auth/")[0], started, log, Script(httpx.Client()))
        page = result.browser()
        assert page.http.get(link).status_code == 303
        body = {"name": f"acceptance {already}", "role": "admin"}
        result.admin = result.script(page.post("/auth/tokens", body, 201)["secret"])
        if "--no-runtime" not in options:
            until(lambda: result.admin.state()["connected"], "local runtime", FIRST_START_S)
        yield result
