"""A real server with a real runtime, and a real browser to drive it."""

from __future__ import annotations

import os
import re
import shutil
import signal
import sqlite3
import subprocess
import sys
import time
from collections.abc import Generator, Iterator
from contextlib import closing, contextmanager, suppress
from dataclasses import dataclass
from pathlib import Path
from typing import NoReturn

import pytest
from playwright.sync_api import (
    APIRequestContext,
    Browser,
    BrowserContext,
    Page,
    Playwright,
    ViewportSize,
    expect,
    sync_playwright,
)
from playwright.sync_api import Error as PlaywrightError

ROOT = Path(__file__).resolve().parents[2]
START_LIMIT_S = 90.0
expect.set_options(timeout=30_000)
EXAMPLE = "Bottling line"
CHROMIUM_FLAGS = [
    "--no-sandbox",
    "--disable-gpu",
    "--use-gl=swiftshader",
    "--enable-unsafe-swiftshader",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
    "--no-first-run",
    # A page lives for seconds: what the optimising compilers cost does not come back. A quarter of its time.
    "--js-flags=--no-opt --no-maglev",
]
BROWSERS = ("chromium-headless-shell", "chromium", "chromium-browser", "google-chrome")
"""Debian's names. The headless shell, which has no window to leave out, needs a fifth less processor time."""
VIEWPORT: ViewportSize = {"width": 1440, "height": 900}

TRIES_AGAIN = 2
"""A browser on a busy machine may miss a moment; what fails three times is broken. The summary names it."""


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Tests of this folder may be repeated, and come last: beside a browser no asynchronous test can run."""
    here = Path(__file__).parent
    for item in items:
        if item.path.is_relative_to(here):
            item.add_marker(pytest.mark.flaky(reruns=TRIES_AGAIN))
    items.sort(key=lambda item: item.path.is_relative_to(here))


FAILED = pytest.StashKey[bool]()


@pytest.hookimpl(wrapper=True)
def pytest_runtest_makereport(
    item: pytest.Item, call: pytest.CallInfo[None]
) -> Generator[None, pytest.TestReport, pytest.TestReport]:
    """A page under test knows at its end whether the test failed."""
    report = yield
    item.stash[FAILED] = report.failed or (report.when != "setup" and item.stash.get(FAILED, False))
    return report


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

    def forget_settings(self) -> None:
        """Windows, opened rows, watch lists, theme, language and test results as a new user has them."""
        with closing(sqlite3.connect(self.data / "data" / "tappet.sqlite", timeout=30.0)) as database:
            database.execute("DELETE FROM user_settings")
            database.execute("DELETE FROM test_runs")
            database.commit()


def _links(text: str) -> list[str]:
    return re.findall(r"https?://\S+/auth/link\?token=\S+", text)


def as_delivered(request: APIRequestContext, address: str) -> None:
    """Undoes what an earlier test did to the projects and the machine: nothing of it reaches the next."""

    api = f"{address}/api/v1"

    def send(method: str, path: str, body: object = None) -> None:
        answer = request.fetch(
            api + path,
            method=method,
            headers={"X-Tappet-Client": "1", "Origin": address},
            data=body,
        )
        assert answer.ok, f"{method} {path}: {answer.status} {answer.text()}"

    projects = request.get(f"{api}/projects").json()
    (example,) = (project for project in projects if project["name"] == EXAMPLE)
    for project in projects:
        if project is not example:
            send("DELETE", f"/projects/{project['id']}")
    path = f"/projects/{example['id']}"
    if example["revision"] > 1:
        send("POST", f"{path}/revert", {"revision": 1})
    objects = request.get(f"{api}{path}/objects").json()
    application = next(each for each in objects if each["kind"] == "application")
    send("POST", "/runtimes/local/values/unforce", {"expressions": None})
    send("DELETE", "/runtimes/local/debug/breakpoints")
    send(
        "POST",
        f"{path}/applications/{application['id']}/download",
        {"runtime_id": "local", "mode": "download", "start": True},
    )


@pytest.fixture(scope="session")
def playwright() -> Iterator[Playwright]:
    """What drives browsers: there can be one in a process."""
    with sync_playwright() as started:
        yield started


@contextmanager
def launched(playwright: Playwright, flags: list[str]) -> Iterator[Browser]:
    """Chromium without a window."""
    found = next(filter(None, map(shutil.which, BROWSERS)), None)
    if found is None:
        pytest.fail("Chromium is missing; `make system` installs it")
    chromium = playwright.chromium.launch(executable_path=found, args=flags)
    yield chromium
    chromium.close()


@pytest.fixture(scope="session")
def browser(playwright: Playwright) -> Iterator[Browser]:
    """The browser of all tests."""
    with launched(playwright, CHROMIUM_FLAGS) as chromium:
        yield chromium


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


@contextmanager
def new_profile(browser: Browser, language: str = "en", theme: str = "light") -> Iterator[BrowserContext]:
    """Storage and cache of their own, and the language and colours that a browser gives the workbench."""
    profile = browser.new_context(
        viewport=VIEWPORT,
        locale={"en": "en-US", "zh": "zh-CN"}[language],
        color_scheme="dark" if theme == "dark" else "light",
    )
    profile.set_default_timeout(30_000)
    yield profile
    profile.close()


def _refuse_socket_route(*_: object) -> NoReturn:
    pytest.fail("the route of a WebSocket stays as long as its page: take `page.context.new_page()`")


@contextmanager
def start_page(profile: BrowserContext, server: Server) -> Iterator[Page]:
    """The start page as a new user sees it, everything as delivered, logged in by a one-time link.

    One page serves all tests of a profile: the workbench is compiled once, no process is started again.
    """
    profile.clear_cookies()
    profile.request.get(server.fresh_link())
    as_delivered(profile.request, server.address)
    server.forget_settings()
    opened = profile.pages[0] if profile.pages else profile.new_page()
    opened.__dict__["route_web_socket"] = _refuse_socket_route
    opened.set_viewport_size(VIEWPORT)
    opened.mouse.move(0, 0)
    opened.goto(server.address)
    yield opened
    for another in profile.pages[1:]:
        another.close()
    opened.unroute_all()
    # The workbench keeps drafts when it is left: they go as well, from another page of its origin.
    opened.goto(f"{server.address}/favicon.svg")
    opened.evaluate("() => { localStorage.clear(); sessionStorage.clear(); }")


@pytest.fixture(scope="session")
def profile(browser: Browser) -> Iterator[BrowserContext]:
    """One for all tests: what is kept of it is the cache of the workbench's code."""
    with new_profile(browser) as fresh:
        yield fresh


@pytest.fixture
def page(profile: BrowserContext, server: Server, request: pytest.FixtureRequest) -> Iterator[Page]:
    """The workbench. After a failure its last picture is kept, and the next test gets another page."""
    with start_page(profile, server) as opened:
        yield opened
        failed = request.node.stash.get(FAILED, True)
        if failed:
            with suppress(PlaywrightError):
                opened.screenshot(path=server.data / f"{request.node.name}.png", timeout=5_000)
    if failed:
        opened.close()
