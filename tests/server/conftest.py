"""A server with a database of its own, and clients of every role."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest
from fake_plc import FakePlc
from fastapi import FastAPI
from fastapi.testclient import TestClient
from server_clients import CHEAP, ROLES, first_account, script, serving, until

from tappet.server.app import create_app
from tappet.server.services import Services
from tappet.server.settings import ServerSettings


@pytest.fixture
def settings(tmp_path: Path) -> ServerSettings:
    return ServerSettings(data_dir=tmp_path, password_cost=CHEAP, reconnect_seconds=0.02)


@pytest.fixture
def plc() -> FakePlc:
    """A soft PLC with an application, stopped."""
    return FakePlc()


@pytest.fixture
def app(settings: ServerSettings, plc: FakePlc) -> Iterator[FastAPI]:
    app = create_app(settings, plc.connect)
    with serving(app):
        yield app


@pytest.fixture
def runtime_id(app: FastAPI, admin: TestClient) -> str:
    """The soft PLC, known to the server and connected."""
    body = {"name": "test stand", "url": "ws://plc:11740", "token": "t"}
    answer = admin.post("/api/v1/runtimes", json=body)
    assert answer.status_code == 201, answer.text
    url = f"/api/v1/runtimes/{answer.json()['id']}"
    until(lambda: admin.get(url).json()["connected"])
    return answer.json()["id"]


@pytest.fixture
def services(app: FastAPI) -> Services:
    services: Services = app.state.services
    return services


@pytest.fixture
def admin(app: FastAPI) -> TestClient:
    """The first administrator, logged in."""
    return first_account(app, "admin")


@pytest.fixture
def tokens(admin: TestClient) -> dict[str, str]:
    """A bearer token of every role."""
    result = {}
    for role in ROLES:
        answer = admin.post("/api/v1/auth/tokens", json={"name": role, "role": role})
        assert answer.status_code == 201, answer.text
        result[role] = answer.json()["secret"]
    return result


@pytest.fixture
def as_role(app: FastAPI, tokens: dict[str, str]) -> dict[str, TestClient]:
    """A script client of every role."""
    return {role: script(app, token) for role, token in tokens.items()}
