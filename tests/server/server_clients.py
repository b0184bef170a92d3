"""Clients of a server under test."""

from __future__ import annotations

import asyncio
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import replace
from typing import Any

from fastapi import FastAPI
from fastapi.testclient import TestClient

from tappet.server.app import create_app
from tappet.server.auth.passwords import HashCost
from tappet.server.settings import LOCAL_RUNTIME, ServerSettings

HOST = "http://127.0.0.1:8080"
SOCKETS = "ws://127.0.0.1:8080"
CHEAP = HashCost(rounds=1, memory_kib=8, lanes=1)
"""Argon2 that costs nothing: tests do not guard secrets."""
PASSWORD = "correct horse battery"
ROLES = ("viewer", "operator", "engineer", "admin")
RUNTIME = f"/api/v1/runtimes/{LOCAL_RUNTIME}"
"""The soft PLC that the server starts itself."""
PAGE = {"X-Tappet-Client": "1", "Origin": HOST}
"""What the pages of the server send."""


def bare(app: FastAPI, **options: Any) -> TestClient:
    """A client that shares the event loop of the served app."""
    client = TestClient(app, **{"base_url": HOST, **options})
    client.portal = app.state.portal
    return client


def browser(app: FastAPI) -> TestClient:
    """A browser showing a page of the server."""
    return bare(app, headers=PAGE, client=("127.0.0.1", 50000))


def script(app: FastAPI, token: str) -> TestClient:
    """A program with a bearer token."""
    return bare(app, headers={"Authorization": f"Bearer {token}"})


@contextmanager
def serving(app: FastAPI) -> Iterator[TestClient]:
    """The app with its lifespan, in one event loop for all its clients."""
    with TestClient(app, base_url=HOST) as client:
        app.state.portal = client.portal
        app.state.loop = client.portal.call(asyncio.get_running_loop)
        yield client


def first_account(app: FastAPI, username: str = "ann") -> TestClient:
    """The first administrator, logged in."""
    client = browser(app)
    body = {"token": app.state.services.first_account_token, "username": username, "password": PASSWORD}
    answer = client.post("/api/v1/auth/first-account", json=body)
    assert answer.status_code == 201, answer.text
    return client


def real_app(settings: ServerSettings) -> FastAPI:
    """A server that starts a soft PLC as a process of its own."""
    return create_app(
        replace(settings, local_runtime=True, local_runtime_options=("--no-realtime",), reconnect_seconds=0.1)
    )


def connected(app: FastAPI) -> TestClient:
    """The first administrator, once the local soft PLC is there."""
    client = first_account(app)
    until(lambda: client.get(RUNTIME).json()["connected"], 90)
    return client


def until(condition: Callable[[], Any], seconds: float = 60) -> None:
    """Wait for what other processes do."""
    end = time.monotonic() + seconds
    while not condition():
        assert time.monotonic() < end, "did not happen"
        time.sleep(0.02)
