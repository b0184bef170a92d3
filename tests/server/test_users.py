"""Accounts, tokens, settings, audit."""

from __future__ import annotations

import json

import pytest
from fastapi import FastAPI
from fastapi.testclient import TestClient
from server_clients import PASSWORD, browser, script
from sqlalchemy import select

from tappet.server import tables
from tappet.server.services import Services

USERS = "/api/v1/users"


def _make(admin: TestClient, username: str, role: str = "viewer") -> dict[str, str]:
    answer = admin.post(USERS, json={"username": username, "password": PASSWORD, "role": role})
    assert answer.status_code == 201, answer.text
    return answer.json()


def test_create_change_delete(admin: TestClient) -> None:
    bob = _make(admin, "bob")
    assert admin.patch(f"{USERS}/{bob['id']}", json={"role": "engineer"}).json()["role"] == "engineer"
    assert [u["username"] for u in admin.get(USERS).json()] == ["admin", "bob"]
    assert admin.delete(f"{USERS}/{bob['id']}").status_code == 204
    assert admin.patch(f"{USERS}/{bob['id']}", json={"role": "viewer"}).status_code == 404
    entries = [(e["action"], e["result"]) for e in admin.get("/api/v1/audit").json()]
    assert entries[:2] == [("user-changed", "refused"), ("user-deleted", "ok")]
    assert entries[2:4] == [("user-changed", "ok"), ("user-created", "ok")]
    changed = admin.get("/api/v1/audit", params={"action": "user-changed"}).json()[1]
    assert (changed["subject"], changed["old_value"], changed["new_value"]) == ("bob", "viewer", "engineer")


def test_names_differ_by_more_than_case(admin: TestClient) -> None:
    _make(admin, "bob")
    body = {"username": "BoB", "password": PASSWORD, "role": "viewer"}
    answer = admin.post(USERS, json=body)
    assert answer.status_code == 409
    assert answer.json()["type"] == "urn:tappet:problem:name-taken"


def test_chinese_names_are_names(admin: TestClient) -> None:
    assert _make(admin, "王工")["username"] == "王工"


def test_last_admin_stays(admin: TestClient) -> None:
    me = admin.get("/api/v1/auth/me").json()["id"]
    for body in ({"role": "viewer"}, {"disabled": True}):
        answer = admin.patch(f"{USERS}/{me}", json=body)
        assert answer.status_code == 409, answer.text
        assert answer.json()["type"] == "urn:tappet:problem:last-admin"
    assert admin.delete(f"{USERS}/{me}").status_code == 409


def test_admin_resets_a_password(app: FastAPI, admin: TestClient) -> None:
    bob = _make(admin, "bob")
    client = browser(app)
    login = {"username": "bob", "password": PASSWORD}
    assert client.post("/api/v1/auth/login", json=login).status_code == 200
    new = "quite another phrase"
    assert admin.patch(f"{USERS}/{bob['id']}", json={"password": new}).status_code == 200
    assert client.get("/api/v1/auth/me").status_code == 401
    assert client.post("/api/v1/auth/login", json={**login, "password": new}).status_code == 200


def test_unknown_fields_are_named(admin: TestClient) -> None:
    answer = admin.post(USERS, json={"username": "x", "password": PASSWORD, "role": "viewer", "rôle": 1})
    assert answer.status_code == 422
    assert answer.json()["errors"][0]["location"] == "body.rôle"
    role = admin.post(USERS, json={"username": "x", "password": PASSWORD, "role": "god"})
    assert "'engineer'" in role.json()["detail"]


def test_token_secret_is_shown_once_and_stored_as_digest(admin: TestClient, services: Services) -> None:
    made = admin.post(
        "/api/v1/auth/tokens", json={"name": "ci", "role": "viewer", "expires_in_days": 1}
    ).json()
    assert made["secret"].startswith("tappet_")
    assert "secret" not in admin.get("/api/v1/auth/tokens").json()[0]
    rows = services.database.write(
        lambda db: [dict(r) for r in db.execute(select(tables.api_tokens)).mappings()]
    )
    assert made["secret"] not in json.dumps(rows, default=str)


def test_token_never_exceeds_its_owner(app: FastAPI, admin: TestClient) -> None:
    bob = _make(admin, "bob", "engineer")
    client = browser(app)
    client.post("/api/v1/auth/login", json={"username": "bob", "password": PASSWORD})
    assert client.post("/api/v1/auth/tokens", json={"name": "t", "role": "admin"}).status_code == 403
    secret = client.post("/api/v1/auth/tokens", json={"name": "t", "role": "engineer"}).json()["secret"]
    program = script(app, secret)
    assert program.get("/api/v1/auth/me").json()["role"] == "engineer"
    assert program.post("/api/v1/auth/tokens", json={"name": "u", "role": "viewer"}).status_code == 403
    admin.patch(f"{USERS}/{bob['id']}", json={"role": "viewer"})
    assert program.get("/api/v1/auth/me").json()["role"] == "viewer"
    admin.patch(f"{USERS}/{bob['id']}", json={"disabled": True})
    assert program.get("/api/v1/auth/me").status_code == 401


def test_revoked_token_is_nothing(app: FastAPI, admin: TestClient) -> None:
    made = admin.post("/api/v1/auth/tokens", json={"name": "ci", "role": "viewer"}).json()
    program = script(app, made["secret"])
    assert program.get("/api/v1/auth/me").status_code == 200
    assert admin.delete(f"/api/v1/auth/tokens/{made['id']}").status_code == 204
    assert program.get("/api/v1/auth/me").status_code == 401
    assert program.get("/api/v1/auth/me", headers={"Authorization": "Basic eA=="}).status_code == 401


def test_tokens_belong_to_their_owner(app: FastAPI, admin: TestClient) -> None:
    made = admin.post("/api/v1/auth/tokens", json={"name": "ci", "role": "viewer"}).json()
    _make(admin, "bob", "admin")
    bob = browser(app)
    bob.post("/api/v1/auth/login", json={"username": "bob", "password": PASSWORD})
    assert bob.get("/api/v1/auth/tokens").json() == []
    assert bob.delete(f"/api/v1/auth/tokens/{made['id']}").status_code == 404


def test_settings_are_any_json_of_limited_size(admin: TestClient) -> None:
    url = "/api/v1/me/settings/layout.42"
    for value in ({"a": [1, None, "ä"]}, "text", 3, False, None):
        assert admin.put(url, json=value).status_code == 200
        assert admin.get(url).json() == value
    assert admin.put(url, json="x" * 300_000).status_code == 413
    assert admin.put("/api/v1/me/settings/..%2Fx", json=1).status_code in (404, 422)


@pytest.mark.parametrize(
    "text", ["NaN", "[Infinity]", '{"a": -Infinity}', '"\\ud800"', "[" * 100_000, "{", ""]
)
def test_what_is_no_json_is_refused(admin: TestClient, text: str) -> None:
    answer = admin.put("/api/v1/me/settings/a", content=text, headers={"Content-Type": "application/json"})
    assert answer.status_code in (400, 422) or (text == "" and answer.status_code == 200), answer.text
    assert admin.get("/api/v1/me/settings/a").json() is None


@pytest.mark.parametrize("name", ["a\x00b", "\ud800", "a\nb", "x" * 101])
def test_names_are_lines_of_text(admin: TestClient, name: str) -> None:
    body = json.dumps({"name": name, "role": "viewer"})
    answer = admin.post("/api/v1/auth/tokens", content=body, headers={"Content-Type": "application/json"})
    assert answer.status_code == 422, answer.text
    login = json.dumps({"username": name, "password": "\ud800"})
    answer = admin.post("/api/v1/auth/login", content=login, headers={"Content-Type": "application/json"})
    assert answer.status_code in (401, 422), answer.text


def test_language_and_theme_show_in_me(admin: TestClient) -> None:
    admin.put("/api/v1/me/settings/language", json="zh")
    admin.put("/api/v1/me/settings/theme", json="dark")
    me = admin.get("/api/v1/auth/me").json()
    assert (me["language"], me["theme"]) == ("zh", "dark")


def test_too_large_bodies_are_refused(app: FastAPI, admin: TestClient) -> None:
    answer = admin.put(
        "/api/v1/me/settings/a",
        content=b'"' + b"x" * 9_000_000 + b'"',
        headers={"Content-Type": "application/json"},
    )
    assert answer.status_code == 413
    assert answer.headers["content-type"] == "application/problem+json"


def test_audit_pages_backwards(admin: TestClient) -> None:
    for n in range(5):
        _make(admin, f"user{n}")
    first = admin.get("/api/v1/audit", params={"limit": 2}).json()
    second = admin.get("/api/v1/audit", params={"limit": 2, "before": first[-1]["id"]}).json()
    assert [e["subject"] for e in first + second] == ["user4", "user3", "user2", "user1"]
    assert admin.get("/api/v1/audit", params={"limit": 100000}).status_code == 422


def test_failed_logins_are_in_the_audit_log(app: FastAPI, admin: TestClient) -> None:
    browser(app).post("/api/v1/auth/login", json={"username": "mallory", "password": "guess"})
    entry = admin.get("/api/v1/audit").json()[0]
    assert (entry["action"], entry["username"], entry["address"]) == ("login-failed", "mallory", "127.0.0.1")
