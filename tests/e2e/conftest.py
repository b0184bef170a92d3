"""A real server with a real runtime, and a real browser to drive it."""

from __future__ import annotations

import os
import re
import shutil
import signal
import subprocess
import sys
import time
from collections.abc import Iterator
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path

import pytest
from playwright.sync_api import Browser, BrowserContext, Page, expect, sync_playwright
from playwright.sync_api import Error as PlaywrightError

ROOT = Path(__file__).resolve().parents[2]
START_LIMIT_S = 90.0
expect.set_options(timeout=30_000)
AS_DELIVERED = """async () => {
    const headers = {'X-Tappet-Client': '1', 'Content-Type': 'application/json'};
    const send = (path, body, method = 'POST') =>
        fetch('/api/v1' + path, {method, headers, body: JSON.stringify(body)});
    const read = async (path) => (await fetch('/api/v1' + path)).json();
    for (const project of await read('/projects')) {
        await send(`/me/settings/layout.${project.id}`, null, 'PUT');
        if (project.revision > 1) await send(`/projects/${project.id}/revert`, {revision: 1});
        const objects = await read(`/projects/${project.id}/objects`);
        const application = objects.find((object) => object.kind === 'application');
        await send('/runtimes/local/values/unforce', {expressions: null});
        await send(`/projects/${project.id}/applications/${application.id}/download`,
            {runtime_id: 'local', mode: 'download', start: true});
    }
}"""
"""Undoes what an earlier test did to the example, the machine and the windows: a 3D view slows all others."""
CHROMIUM_FLAGS = [
    "--no-sandbox",
    "--disable-gpu",
    "--use-gl=swiftshader",
    "--enable-unsafe-swiftshader",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
    "--no-first-run",
]


@dataclass
class Server:
    """A running `tappet serve` with the bottling example loaded."""

    address: str
    link: str
    process: subprocess.Popen[str]
    log: Path
    data: Path

    def fresh_link(self) -> str:
        """A new one-time login link for another browser."""
        before = self.log.read_text().count("/auth/link?token=")
        self.process.send_signal(signal.SIGUSR1)
        deadline = time.monotonic() + 10.0
        while time.monotonic() < deadline:
            links = _links(self.log.read_text())
            if len(links) > before:
                return links[-1]
            time.sleep(0.05)
        raise AssertionError("the server printed no new login link")


def _links(text: str) -> list[str]:
    return re.findall(r"https?://\S+/auth/link\?token=\S+", text)


@pytest.fixture(scope="module")
def browser() -> Iterator[Browser]:
    """Chromium without a window. It ends with its module: while it is there, no asynchronous test can run."""
    found = shutil.which("chromium") or shutil.which("chromium-browser") or shutil.which("google-chrome")
    if found is None:
        pytest.fail("Chromium is missing; `make system` installs it")
    with sync_playwright() as playwright:
        chromium = playwright.chromium.launch(
            executable_path=found,
            args=CHROMIUM_FLAGS,
        )
        yield chromium
        chromium.close()


@pytest.fixture(scope="session")
def server(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Server]:
    """One server for all tests of a process, on a free port, with data of its own."""
    data = tmp_path_factory.mktemp("serve")
    log = data / "serve.log"
    command = [sys.executable, "-m", "tappet", "serve", "--port", "0", "--data", str(data / "data")]
    command += ["--example", "bottling", "--local-link"]
    environment = os.environ | {"PYTHONUNBUFFERED": "1"}
    with log.open("w") as out:
        process = subprocess.Popen(
            command, cwd=ROOT, stdout=out, stderr=subprocess.STDOUT, text=True, env=environment
        )
        deadline = time.monotonic() + START_LIMIT_S
        while "runs on the local runtime" not in log.read_text():
            if process.poll() is not None or time.monotonic() > deadline:
                process.kill()
                pytest.fail(f"tappet serve did not start:\n{log.read_text()}")
            time.sleep(0.1)
        link = _links(log.read_text())[-1]
        yield Server(link.split("/api/")[0], link, process, log, data)
        process.send_signal(signal.SIGTERM)
        try:
            process.wait(20)
        except subprocess.TimeoutExpired:
            process.kill()


@pytest.fixture
def context(browser: Browser) -> Iterator[BrowserContext]:
    """A browser profile of its own, so that each test has its own login."""
    fresh = browser.new_context(viewport={"width": 1440, "height": 900}, locale="en-US")
    fresh.set_default_timeout(30_000)
    yield fresh
    fresh.close()


@pytest.fixture
def page(context: BrowserContext, server: Server, request: pytest.FixtureRequest) -> Iterator[Page]:
    """The workbench, logged in by a one-time link; its last picture is kept for whoever mends a failure."""
    opened = context.new_page()
    opened.goto(server.fresh_link())
    opened.evaluate(AS_DELIVERED)
    yield opened
    with suppress(PlaywrightError):
        opened.screenshot(path=server.data / f"{request.node.name}.png", timeout=5_000)
