"""Accounts, tokens, settings, audit."""

from __future__ import annotations

import json
import unicodedata
from collections.abc import Callable

import pytest
from fastapi import FastAPI
from fastapi.testclient import TestClient
from hypothesis import given
from hypothesis import strategies as st
from server_clients import PASSWORD, SOCKETS, browser, script
from sqlalchemy import select
from starlette.testclient import WebSocketTestSession
from starlette.websockets import WebSocketDisconnect

from tappet.server import tables
from tappet.server.auth.confusables import look_alike, skeleton
from tappet.server.services import Services
from tappet.server.sockets import SESSION_ENDED

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


@pytest.mark.parametrize(
    "name",
    ["аdmin", "αdmin", "adm\u200din", "ａｄｍｉｎ", "ADMIN", "аԁміп", "admín", "ⓐdmin"],
)
def test_names_that_look_like_another_are_refused(admin: TestClient, name: str) -> None:
    answer = admin.post(USERS, json={"username": name, "password": PASSWORD, "role": "viewer"})
    assert answer.status_code in (409, 422), answer.text
    assert [user["username"] for user in admin.get(USERS).json()] == ["admin"]


@pytest.mark.parametrize(
    ("one", "other"), [("Ian", "lan"), ("root1", "rootl"), ("b0b", "bob"), ("Ольга", "Oльгa")]
)
def test_digits_and_letters_that_look_alike(admin: TestClient, one: str, other: str) -> None:
    _make(admin, one)
    answer = admin.post(USERS, json={"username": other, "password": PASSWORD, "role": "viewer"})
    assert (answer.status_code, one in answer.json()["detail"]) == (409, True)


@given(st.text(max_size=20))
def test_equal_names_have_equal_looks(name: str) -> None:
    assert skeleton(name) == skeleton(unicodedata.normalize("NFC", name)) == skeleton(skeleton(name))


@pytest.mark.parametrize(
    ("one", "other"),
    [
        ("maria", "rnaria"),  # a sequence that looks like a letter
        ("ivan", "\u0399VAN"),  # Greek capital iota
        ("paul", "pau\uff4c"),  # full width
        ("bob", "b\u0585b"),  # Armenian oh
        ("anna", "\U0001d41anna"),  # mathematical bold
        ("li", "l\u0456"),  # Cyrillic
        ("ab", "a\u200bb"),  # zero width
    ],
)
def test_what_unicode_calls_confusable_looks_alike(one: str, other: str) -> None:
    assert look_alike(one, other)


def test_different_names_look_different() -> None:
    names = ["ann", "anna", "bob", "王工", "李工", "Ольга", "Игорь", "Jörg", "Marie", "mario", "op1", "op2"]
    assert len({skeleton(name) for name in names}) == len(names)


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


def test_tokens_end_with_the_password(app: FastAPI, admin: TestClient) -> None:
    bob = _make(admin, "bob", "engineer")
    client = browser(app)
    client.post("/api/v1/auth/login", json={"username": "bob", "password": PASSWORD})
    token = {"name": "t", "role": "viewer"}
    first = script(app, client.post("/api/v1/auth/tokens", json=token).json()["secret"])
    assert first.get("/api/v1/auth/me").status_code == 200
    change = {"current": PASSWORD, "new": "quite another phrase"}
    assert client.post("/api/v1/auth/password", json=change).status_code == 204
    assert first.get("/api/v1/auth/me").status_code == 401
    second = script(app, client.post("/api/v1/auth/tokens", json=token).json()["secret"])
    admin.patch(f"{USERS}/{bob['id']}", json={"password": "a third good phrase"})
    assert second.get("/api/v1/auth/me").status_code == 401


def test_a_disabled_account_comes_back_without_its_tokens(app: FastAPI, admin: TestClient) -> None:
    bob = _make(admin, "bob")
    client = browser(app)
    client.post("/api/v1/auth/login", json={"username": "bob", "password": PASSWORD})
    secret = client.post("/api/v1/auth/tokens", json={"name": "t", "role": "viewer"}).json()["secret"]
    for disabled in (True, False):
        admin.patch(f"{USERS}/{bob['id']}", json={"disabled": disabled})
    assert script(app, secret).get("/api/v1/auth/me").status_code == 401


def test_an_administrator_signs_a_user_out(app: FastAPI, admin: TestClient) -> None:
    bob = _make(admin, "bob")
    client = browser(app)
    client.post("/api/v1/auth/login", json={"username": "bob", "password": PASSWORD})
    secret = client.post("/api/v1/auth/tokens", json={"name": "t", "role": "viewer"}).json()["secret"]
    assert client.post(f"{USERS}/{bob['id']}/sign-out").status_code == 403
    assert admin.post(f"{USERS}/{bob['id']}/sign-out").status_code == 204
    for one in (client, script(app, secret)):
        assert one.get("/api/v1/auth/me").status_code == 401
    me = admin.get("/api/v1/auth/me").json()["id"]
    assert admin.post(f"{USERS}/{me}/sign-out").status_code == 204
    assert admin.get("/api/v1/auth/me").status_code == 200, "the session that asks for it stays"
    assert admin.post(f"{USERS}/nobody/sign-out").status_code == 404
    entry = admin.get("/api/v1/audit", params={"action": "user-signed-out"}).json()[-2]
    assert (entry["subject"], entry["result"]) == ("bob", "ok")


def _sign_out(admin: TestClient, client: TestClient, user_id: str) -> None:
    admin.post(f"{USERS}/{user_id}/sign-out")


def _log_out(admin: TestClient, client: TestClient, user_id: str) -> None:
    client.post("/api/v1/auth/logout")


def _reset_password(admin: TestClient, client: TestClient, user_id: str) -> None:
    admin.patch(f"{USERS}/{user_id}", json={"password": "quite another phrase"})


def _delete(admin: TestClient, client: TestClient, user_id: str) -> None:
    admin.delete(f"{USERS}/{user_id}")


def _end_of(socket: WebSocketTestSession) -> int:
    """The code with which the server closes."""
    try:
        while True:
            socket.receive_text()
    except WebSocketDisconnect as closed:
        return closed.code


@pytest.mark.parametrize(
    "path", ["online?runtime={runtime}", "events?project={project}", "lsp?project={project}"]
)
@pytest.mark.parametrize("end", [_sign_out, _log_out, _reset_password, _delete])
def test_open_sockets_end_with_the_session(
    app: FastAPI,
    admin: TestClient,
    runtime_id: str,
    end: Callable[[TestClient, TestClient, str], None],
    path: str,
) -> None:
    bob = _make(admin, "bob", "engineer")
    client = browser(app)
    client.post("/api/v1/auth/login", json={"username": "bob", "password": PASSWORD})
    project = admin.post("/api/v1/projects", json={"name": "Press"}).json()["id"]
    url = f"{SOCKETS}/api/v1/" + path.format(runtime=runtime_id, project=project)
    online = f"{SOCKETS}/api/v1/online?runtime={runtime_id}"
    with admin.websocket_connect(online) as other, client.websocket_connect(url) as socket:
        end(admin, client, bob["id"])
        assert _end_of(socket) == SESSION_ENDED
        other.send_text("no order")
        while other.receive_json()["op"] != "error":
            pass


def test_open_sockets_end_with_their_token(app: FastAPI, admin: TestClient, runtime_id: str) -> None:
    made = admin.post("/api/v1/auth/tokens", json={"name": "ci", "role": "viewer"}).json()
    url = f"{SOCKETS}/api/v1/online?runtime={runtime_id}"
    with script(app, made["secret"]).websocket_connect(url) as socket:
        admin.delete(f"/api/v1/auth/tokens/{made['id']}")
        assert _end_of(socket) == SESSION_ENDED


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
