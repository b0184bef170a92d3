"""A server with a database of its own, and clients of every role."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest
from fastapi import FastAPI
from fastapi.testclient import TestClient
from server_clients import CHEAP, HOST, PASSWORD, ROLES, browser, script

from tappet.server.app import create_app
from tappet.server.services import Services
from tappet.server.settings import ServerSettings


@pytest.fixture
def settings(tmp_path: Path) -> ServerSettings:
    return ServerSettings(data_dir=tmp_path, password_cost=CHEAP)


@pytest.fixture
def app(settings: ServerSettings) -> Iterator[FastAPI]:
    app = create_app(settings)
    with TestClient(app, base_url=HOST):
        yield app


@pytest.fixture
def services(app: FastAPI) -> Services:
    services: Services = app.state.services
    return services


@pytest.fixture
def admin(app: FastAPI, services: Services) -> TestClient:
    """The first administrator, logged in."""
    client = browser(app)
    token = services.first_account_token
    body = {"token": token, "username": "admin", "password": PASSWORD}
    assert client.post("/api/v1/auth/first-account", json=body).status_code == 201
    return client


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
