"""Every route states its minimum role, and enforces it."""

from __future__ import annotations

import re
from collections.abc import Iterator

import pytest
from fastapi import FastAPI
from fastapi.dependencies.models import Dependant
from fastapi.routing import RouteContext, iter_route_contexts
from fastapi.testclient import TestClient
from server_clients import PAGE, SOCKETS, bare, browser
from starlette.testclient import WebSocketDenialResponse

from tappet.server.audited import Audited
from tappet.server.dependencies import RequireRole

OPEN = {
    "/api/v1/health",
    "/api/v1/auth/status",
    "/api/v1/auth/login",
    "/api/v1/auth/link",
    "/api/v1/auth/first-account",
    "/api/v1/openapi.json",
}
"""Routes that anybody may ask."""


def _dependants(dependant: Dependant) -> Iterator[Dependant]:
    yield dependant
    for inner in dependant.dependencies:
        yield from _dependants(inner)


def _minimum_role(context: RouteContext) -> str | None:
    guards = (d.call for d in _dependants(context.dependant))
    roles = [guard.role for guard in guards if isinstance(guard, RequireRole | Audited)]
    return max(roles, key=lambda role: role.rank).value if roles else None


def _guarded(app: FastAPI) -> list[RouteContext]:
    contexts = [c for c in iter_route_contexts(app.routes) if (c.path or "").startswith(("/api/", "/views"))]
    assert len(contexts) > 10
    return [c for c in contexts if c.path not in OPEN]


def _url(path: str) -> str:
    return re.sub(r"\{[^}]+\}", "x", path)


def test_every_route_states_a_role(app: FastAPI) -> None:
    silent = [c.path for c in _guarded(app) if _minimum_role(c) is None]
    assert silent == []


def test_every_route_refuses_strangers(app: FastAPI) -> None:
    client = bare(app, follow_redirects=False)
    for context in _guarded(app):
        url = _url(context.path or "")
        if not context.methods:
            with (
                pytest.raises(WebSocketDenialResponse) as refusal,
                client.websocket_connect(SOCKETS + url, headers=PAGE),
            ):
                pass
            assert refusal.value.status_code == 401, url
            continue
        for method in context.methods:
            answer = client.request(method, url, headers=PAGE)
            assert answer.status_code == 401, (method, url, answer.text)
            if method != "HEAD":
                assert answer.json()["type"] == "urn:tappet:problem:unauthenticated"


def test_every_route_refuses_the_role_below(app: FastAPI, as_role: dict[str, TestClient]) -> None:
    below = {"operator": "viewer", "engineer": "operator", "admin": "engineer"}
    checked = 0
    for context in _guarded(app):
        role = _minimum_role(context)
        if role not in below or not context.methods:
            continue
        for method in context.methods - {"HEAD"}:
            answer = as_role[below[role]].request(method, _url(context.path or ""))
            assert answer.status_code == 403, (method, context.path, answer.text)
            assert answer.json()["required_role"] == role
            checked += 1
    assert checked > 3


def test_a_forged_cookie_is_nobody(app: FastAPI) -> None:
    client = browser(app)
    client.cookies.set("tappet_session", "x" * 43)
    assert client.get("/api/v1/auth/me").status_code == 401
    assert client.get("/api/v1/auth/status").json()["authenticated"] is False


def test_methods_that_a_path_does_not_have_are_refused_with_those_it_has(app: FastAPI) -> None:
    contexts = [
        c for c in iter_route_contexts(app.routes) if (c.path or "").startswith("/api/") and c.methods
    ]
    assert len(contexts) > 50
    for url in {_url(context.path or "") for context in contexts}:
        fitting = [c for c in contexts if re.fullmatch(re.sub(r"\{[^}]+\}", "[^/]+", c.path or ""), url)]
        methods = {method for c in fitting for method in c.methods or ()} - {"HEAD"}
        for method in {"GET", "POST", "PUT", "PATCH", "DELETE", "TRACE", "QUERY"} - methods:
            answer = bare(app).request(method, url)
            assert answer.status_code == 405, (method, url)
            assert set(answer.headers["allow"].split(", ")) == methods
            assert answer.json()["type"] == "urn:tappet:problem:method-not-allowed"
    assert bare(app).get("/api/v1/nothing").status_code == 404
