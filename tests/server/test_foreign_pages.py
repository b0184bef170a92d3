"""Requests that a page of another server makes the browser send."""

from __future__ import annotations

from dataclasses import replace

import pytest
from fake_plc import FakePlc
from fastapi import FastAPI
from fastapi.testclient import TestClient
from hypothesis import given
from hypothesis import strategies as st
from server_clients import HOST, PAGE, bare, serving
from starlette.requests import HTTPConnection

from tappet.server.app import create_app
from tappet.server.auth.origin import is_same_origin
from tappet.server.guard import host_name
from tappet.server.settings import ServerSettings


def _foreign(app: FastAPI, admin: TestClient, **headers: str) -> TestClient:
    client = bare(app, headers=headers)
    client.cookies.set("tappet_session", admin.cookies["tappet_session"])
    return client


PUT = "/api/v1/me/settings/theme"


@pytest.mark.parametrize(
    "headers",
    [
        {"Origin": HOST},
        {"X-Tappet-Client": "1"},
        {"X-Tappet-Client": "1", "Origin": "http://evil.example"},
        {"X-Tappet-Client": "1", "Origin": "http://127.0.0.1:9999"},
        {"X-Tappet-Client": "1", "Origin": "null"},
        {"X-Tappet-Client": "1", "Origin": "http://127.0.0.1:8080.evil.example"},
        {"X-Tappet-Client": "1", "Origin": "file://"},
    ],
)
def test_cookie_alone_changes_nothing(app: FastAPI, admin: TestClient, headers: dict[str, str]) -> None:
    answer = _foreign(app, admin, **headers).put(PUT, json="dark")
    assert answer.status_code == 403
    assert admin.get(PUT).json() is None


def test_own_page_may(admin: TestClient) -> None:
    assert admin.put(PUT, json="dark").status_code == 200
    assert admin.get(PUT).json() == "dark"


def test_reading_by_link_still_works(app: FastAPI, admin: TestClient) -> None:
    assert _foreign(app, admin).get("/api/v1/auth/me").status_code == 200


def test_foreign_page_cannot_log_the_browser_in(app: FastAPI, admin: TestClient) -> None:
    evil = bare(app, headers={"Origin": "http://evil.example"})
    body = {"username": "admin", "password": "correct horse battery"}
    assert evil.post("/api/v1/auth/login", json=body).status_code == 403
    form = bare(app).post(
        "/api/v1/auth/login",
        content='{"username":"admin","password":"x"}',
        headers={"Content-Type": "text/plain"},
    )
    assert form.status_code == 422


@pytest.mark.parametrize(
    "host", ["evil.example", "evil.example:8080", "10.0.0.5:8080", "localhost.evil.example", ""]
)
def test_rebound_names_are_refused_on_loopback(app: FastAPI, host: str) -> None:
    answer = bare(app).get("/api/v1/health", headers={"Host": host})
    assert answer.status_code == 421
    assert answer.headers["content-type"] == "application/problem+json"


@pytest.mark.parametrize("host", ["localhost:8080", "127.0.0.1", "[::1]:8080", "LOCALHOST"])
def test_loopback_names_pass(app: FastAPI, host: str) -> None:
    assert bare(app).get("/api/v1/health", headers={"Host": host}).status_code == 200


def test_configured_names_pass(settings: ServerSettings) -> None:
    named = create_app(replace(settings, host="0.0.0.0", allowed_hosts=("plc.plant",)), FakePlc().connect)
    with serving(named) as client:
        assert client.get("/api/v1/health", headers={"Host": "plc.plant"}).status_code == 200
        assert client.get("/api/v1/health", headers={"Host": "evil.example"}).status_code == 421


def test_answers_carry_security_headers(app: FastAPI) -> None:
    answer = bare(app, headers=PAGE).get("/api/v1/health")
    assert answer.headers["x-content-type-options"] == "nosniff"
    assert "script-src 'self'" in answer.headers["content-security-policy"]
    assert answer.headers["cache-control"] == "no-store"
    assert answer.headers["referrer-policy"] == "same-origin"


def _connection(origin: str, host: str) -> HTTPConnection:
    headers = [(b"origin", origin.encode("latin-1", "replace")), (b"host", host.encode("latin-1", "replace"))]
    return HTTPConnection({"type": "http", "headers": headers})


@pytest.mark.parametrize(
    ("origin", "host", "same"),
    [
        ("http://localhost:8080", "localhost:8080", True),
        ("http://LOCALHOST:8080", "localhost:8080", True),
        ("https://ide.plant", "ide.plant", True),
        ("http://ide.plant", "ide.plant:80", True),
        ("http://ide.plant:81", "ide.plant", False),
        ("http://[::1]:8080", "[::1]:8080", True),
        ("ftp://localhost:8080", "localhost:8080", False),
        ("http://user@localhost:8080", "localhost:8080", True),
        ("http://", "", False),
        ("http://a:99999", "a:99999", False),
    ],
)
def test_same_origin(origin: str, host: str, same: bool) -> None:
    assert is_same_origin(_connection(origin, host), ServerSettings()) is same


@given(st.text(max_size=60), st.text(max_size=60))
def test_strange_headers_never_crash(origin: str, host: str) -> None:
    is_same_origin(_connection(origin, host), ServerSettings())
    host_name(host)
