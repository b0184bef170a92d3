"""The server's own tables on PostgreSQL: what the other tests do on SQLite, in one run."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import pytest
from alembic.autogenerate import compare_metadata
from alembic.migration import MigrationContext
from fake_plc import FakePlc
from fastapi import FastAPI
from server_clients import PASSWORD, browser, script, serving
from tests.project import conftest as databases

from tappet.server import tables
from tappet.server.app import create_app
from tappet.server.settings import ServerSettings

postgres_server, postgres_url = databases.postgres_server, databases.postgres_url

pytestmark = pytest.mark.postgres


@pytest.fixture
def app(settings: ServerSettings, postgres_url: str) -> Iterator[FastAPI]:
    app = create_app(replace(settings, database_url=postgres_url), FakePlc().connect)
    with serving(app):
        yield app


def test_accounts_tokens_settings_audit_and_lockout(app: FastAPI) -> None:
    with app.state.services.database.engine.connect() as connection:
        assert compare_metadata(MigrationContext.configure(connection), tables.metadata) == []
    admin = browser(app)
    body = {"token": app.state.services.first_account_token, "username": "Ann", "password": PASSWORD}
    assert admin.post("/api/v1/auth/first-account", json=body).status_code == 201
    bob = {"username": "王工", "password": PASSWORD, "role": "operator"}
    assert admin.post("/api/v1/users", json=bob).status_code == 201
    assert admin.post("/api/v1/users", json=bob).status_code == 409
    made = admin.post("/api/v1/auth/tokens", json={"name": "ci", "role": "engineer"}).json()
    program = script(app, made["secret"])
    assert program.get("/api/v1/auth/me").json()["role"] == "engineer"
    for value in ({"a": ["ä", "\x00", None]}, [1], None):
        assert admin.put("/api/v1/me/settings/layout", json=value).status_code == 200
        assert admin.get("/api/v1/me/settings/layout").json() == value
    assert admin.post("/api/v1/projects", json={"name": "P"}).status_code == 201
    guest = browser(app)
    login = {"username": "ann", "password": "wrong password"}
    codes = [guest.post("/api/v1/auth/login", json=login).status_code for _ in range(6)]
    assert codes == [401] * 5 + [429]
    runtime = {"name": "r", "url": "ws://plc:1", "token": "t"}
    added = admin.post("/api/v1/runtimes", json=runtime).json()
    assert admin.delete(f"/api/v1/runtimes/{added['id']}").status_code == 204
    actions = [entry["action"] for entry in admin.get("/api/v1/audit").json()]
    assert actions[:3] == ["runtime-removed", "runtime-added", "login-locked-out"]
    assert "user-created" in actions


def test_refusals_are_counted_and_large_numbers_are_none(app: FastAPI) -> None:
    client = browser(app)
    token = app.state.services.first_account_token
    body = {"token": token, "username": "admin", "password": PASSWORD}
    assert client.post("/api/v1/auth/first-account", json=body).status_code == 201
    for _ in range(3):
        assert client.post("/api/v1/users/nobody/sign-out").status_code == 404
    (entry,) = client.get("/api/v1/audit", params={"action": "user-signed-out"}).json()
    assert (entry["result"], entry["count"]) == ("refused", 3)
    assert client.get("/api/v1/audit", params={"before": (1 << 31) - 1}).status_code == 200
    assert client.get("/api/v1/audit", params={"before": 1 << 31}).status_code == 422
