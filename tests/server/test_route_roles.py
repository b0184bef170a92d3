"""Every route states its minimum role, and enforces it."""

from __future__ import annotations

import re

import pytest
from fastapi import FastAPI
from fastapi.routing import RouteContext, iter_route_contexts
from fastapi.testclient import TestClient
from server_clients import PAGE, SOCKETS, bare, browser
from starlette.testclient import WebSocketDenialResponse

from tappet.server import openapi
from tappet.server.auth.roles import Role
from tappet.server.routing import least_role

OPEN = {
    "/api/v1/health",
    "/api/v1/auth/status",
    "/api/v1/auth/login",
    "/api/v1/auth/link",
    "/api/v1/auth/first-account",
    "/api/v1/openapi.json",
}
"""Routes that anybody may ask."""


def _guarded(app: FastAPI) -> list[RouteContext]:
    contexts = [c for c in iter_route_contexts(app.routes) if (c.path or "").startswith(("/api/", "/views"))]
    assert len(contexts) > 10
    return [c for c in contexts if c.path not in OPEN]


def _url(path: str) -> str:
    return re.sub(r"\{[^}]+\}", "x", path)


def test_every_route_states_a_role(app: FastAPI) -> None:
    silent = [c.path for c in _guarded(app) if least_role(c.dependant) is None]
    assert silent == []


OF_VIEWERS = {
    "/api/v1/auth/logout",
    "/api/v1/auth/password",
    "/api/v1/auth/tokens",
    "/api/v1/auth/tokens/{token_id}",
    "/api/v1/me/settings/{key}",
    "/api/v1/projects/{project_id}/applications/{application_id}/login",
    "/api/v1/projects/{project_id}/applications/{application_id}/logout",
    "/api/v1/projects/{project_id}/applications/{application_id}/versions/{code_id}/compare",
    "/api/v1/projects/{project_id}/cams/code",
    "/api/v1/projects/{project_id}/cams/curves",
    "/api/v1/projects/{project_id}/cams/text",
    "/api/v1/projects/{project_id}/cnc/code",
    "/api/v1/projects/{project_id}/cnc/info",
    "/api/v1/projects/{project_id}/comparisons",
    "/api/v1/projects/{project_id}/comparisons/files",
    "/api/v1/projects/{project_id}/comparisons/{comparison_id}",
    "/api/v1/projects/{project_id}/objects/{object_id}/view",
    "/api/v1/projects/{project_id}/objects/{object_id}/view/{view_id}/cycle",
    "/api/v1/projects/{project_id}/paths",
    "/api/v1/projects/{project_id}/paths/{view_id}",
    "/api/v1/projects/{project_id}/paths/{view_id}/line",
    "/api/v1/projects/{project_id}/paths/{view_id}/looks",
    "/api/v1/projects/{project_id}/paths/{view_id}/pick",
    "/api/v1/projects/{project_id}/paths/{view_id}/program",
    "/api/v1/projects/{project_id}/recipes/{definition_id}/file",
    "/api/v1/projects/{project_id}/recordings/{object_id}/open",
    "/api/v1/projects/{project_id}/search",
    "/api/v1/runtimes/{runtime_id}/cams/{name}/read",
    "/api/v1/runtimes/{runtime_id}/flight/read",
    "/api/v1/runtimes/{runtime_id}/recipes/compare",
    "/api/v1/runtimes/{runtime_id}/values/read",
    "/api/v1/traces/digest",
}
"""Who only looks may do these, too: read with a body, look after what is their own."""


def test_the_document_says_which_role_each_operation_needs(app: FastAPI) -> None:
    open_to_all, by_viewers = set(), set()
    for path, operations in openapi.document(app)["paths"].items():
        for method, operation in operations.items():
            roles = {role for way in operation["security"] for names in way.values() for role in names}
            if not roles:
                open_to_all.add(path)
                continue
            (role,) = roles
            assert [list(way) for way in operation["security"]] == [["session"], ["token"]]
            if method != "get" and role == "viewer":
                by_viewers.add(path)
            if path.startswith("/api/v1/users"):
                assert role == "admin", path
            if role == "operator":
                assert path.startswith("/api/v1/runtimes/{runtime_id}/"), "operators run machines"
    assert open_to_all == OPEN - {"/api/v1/openapi.json"}
    assert by_viewers == OF_VIEWERS


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


@pytest.mark.parametrize(
    "kind", ["application/json", "multipart/form-data; boundary=b", "x-www-form-urlencoded"]
)
def test_nothing_is_read_of_what_strangers_send(app: FastAPI, kind: str) -> None:
    client = bare(app)
    checked = 0
    for context in _guarded(app):
        for method in set(context.methods or ()) & {"POST", "PUT", "PATCH"}:
            answer = client.request(
                method, _url(context.path or ""), content=b"{no \xff", headers={"Content-Type": kind}
            )
            assert answer.status_code == 401, (method, context.path, answer.text)
            checked += 1
    assert checked > 20


def test_every_route_refuses_the_role_below(app: FastAPI, as_role: dict[str, TestClient]) -> None:
    below = {Role.OPERATOR: "viewer", Role.ENGINEER: "operator", Role.ADMIN: "engineer"}
    checked = 0
    for context in _guarded(app):
        role = least_role(context.dependant)
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
