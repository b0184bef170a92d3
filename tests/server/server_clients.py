"""Clients of a server under test."""

from __future__ import annotations

from fastapi import FastAPI
from fastapi.testclient import TestClient

from tappet.server.auth.passwords import HashCost

HOST = "http://127.0.0.1:8080"
CHEAP = HashCost(rounds=1, memory_kib=8, lanes=1)
"""Argon2 that costs nothing: tests do not guard secrets."""
PASSWORD = "correct horse battery"
ROLES = ("viewer", "operator", "engineer", "admin")
PAGE = {"X-Tappet-Client": "1", "Origin": HOST}
"""What the pages of the server send."""


def browser(app: FastAPI) -> TestClient:
    """A browser showing a page of the server."""
    return TestClient(app, base_url=HOST, headers=PAGE, client=("127.0.0.1", 50000))


def script(app: FastAPI, token: str) -> TestClient:
    """A program with a bearer token."""
    return TestClient(app, base_url=HOST, headers={"Authorization": f"Bearer {token}"})
