"""Clients of a server under test."""

from __future__ import annotations

import asyncio
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

from fastapi import FastAPI
from fastapi.testclient import TestClient

from tappet.server.auth.passwords import HashCost

HOST = "http://127.0.0.1:8080"
SOCKETS = "ws://127.0.0.1:8080"
CHEAP = HashCost(rounds=1, memory_kib=8, lanes=1)
"""Argon2 that costs nothing: tests do not guard secrets."""
PASSWORD = "correct horse battery"
ROLES = ("viewer", "operator", "engineer", "admin")
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
