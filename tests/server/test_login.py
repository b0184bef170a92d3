"""First account, login, lock-out, sessions, links."""

from __future__ import annotations

from datetime import UTC, datetime, timedelta
from itertools import count

import pytest
from fake_plc import FakePlc
from fastapi import FastAPI
from fastapi.testclient import TestClient
from server_clients import CHEAP, PAGE, PASSWORD, bare, browser, serving
from sqlalchemy import select, update

from tappet.server import tables
from tappet.server.app import create_app
from tappet.server.auth import lockout
from tappet.server.auth.login import LOCAL_LINK
from tappet.server.auth.passwords import WeakPasswordError, check
from tappet.server.services import Services
from tappet.server.settings import ServerSettings

LOGIN = "/api/v1/auth/login"
FIRST = "/api/v1/auth/first-account"


def _log_in(client: TestClient, password: str = PASSWORD, username: str = "admin"):
    return client.post(LOGIN, json={"username": username, "password": password})


def test_without_account_nobody_logs_in(app: FastAPI) -> None:
    client = browser(app)
    assert client.get("/api/v1/auth/status").json()["first_account_needed"] is True
    for username in ("admin", "root", "local", "tappet"):
        assert _log_in(client, "", username).status_code == 401


def test_first_account_needs_the_console_token_and_works_once(app: FastAPI, services: Services) -> None:
    client = browser(app)
    body = {"token": "guess", "username": "eve", "password": PASSWORD}
    assert client.post(FIRST, json=body).status_code == 403
    good = {**body, "token": services.first_account_token, "username": "Ann"}
    assert client.post(FIRST, json=good).json()["role"] == "admin"
    assert client.post(FIRST, json={**good, "username": "second"}).status_code == 403
    assert client.get("/api/v1/auth/status").json()["first_account_needed"] is False


def test_weak_password_does_not_use_up_the_token(app: FastAPI, services: Services) -> None:
    client = browser(app)
    body = {"token": services.first_account_token, "username": "ann", "password": "short"}
    answer = client.post(FIRST, json=body)
    assert answer.status_code == 422
    assert "at least 10 characters" in answer.json()["detail"]
    assert client.post(FIRST, json={**body, "password": PASSWORD}).status_code == 201


@pytest.mark.parametrize(
    ("password", "words"),
    [
        ("password123", "very common"),
        ("qwertzuiop", "very common"),
        ("Passw0rd!2024", "similar to a commonly used password"),
        ("aaaaaaaaaaaaaaaaaaaaaaaaaaa", "Repeats"),
        ("王工王工王工王工王工", "Repeats"),
        ("abcdefghijkl", "Sequences"),
        ("ｐａｓｓｗｏｒｄ１２３", "very common"),
        ("angelika.mueller", "guessed too soon"),
        ("tappetcodesys", "guessed too soon"),
        ("a" * 1024, "Repeats"),
        ("short", "at least 10"),
        ("x" * 1025, "at most 1024"),
    ],
)
def test_passwords_that_are_guessed_soon_are_refused(password: str, words: str) -> None:
    with pytest.raises(WeakPasswordError, match=words):
        check(password, "angelika.mueller")


@pytest.mark.parametrize(
    "password",
    [PASSWORD, "another good phrase", "蓝天白云下的小马过河", "Zk7#pQ-w9!vR", "\ud800 of no use at all"],
)
def test_others_are_taken(password: str) -> None:
    check(password, "angelika.mueller")


def test_token_is_gone_after_restart_with_accounts(
    app: FastAPI, admin: TestClient, settings: ServerSettings
) -> None:
    again = create_app(settings, FakePlc().connect)
    with serving(again):
        assert again.state.services.first_account_token is None


def test_cookie_is_protected(app: FastAPI, admin: TestClient) -> None:
    answer = _log_in(browser(app))
    cookie = answer.headers["set-cookie"].lower()
    assert "httponly" in cookie
    assert "samesite=strict" in cookie
    assert "secure" not in cookie
    secret = answer.cookies["tappet_session"]
    assert len(secret) >= 43


def test_cookie_is_secure_behind_https(settings: ServerSettings) -> None:
    secured = create_app(
        ServerSettings(data_dir=settings.data_dir, password_cost=CHEAP, https=True), FakePlc().connect
    )
    with serving(secured):
        client = bare(
            secured, base_url="https://127.0.0.1:8080", headers={**PAGE, "Origin": "https://127.0.0.1:8080"}
        )
        body = {"token": secured.state.services.first_account_token, "username": "a", "password": PASSWORD}
        answer = client.post(FIRST, json=body)
        assert "secure" in answer.headers["set-cookie"].lower()
        assert "max-age" in answer.headers["strict-transport-security"]


def test_session_secret_is_stored_as_digest_only(admin: TestClient, services: Services) -> None:
    secret = admin.cookies["tappet_session"]
    stored = services.database.write(lambda db: db.scalars(select(tables.sessions.c.secret_digest)).all())
    assert stored
    assert secret not in stored


def test_login_rotates_the_session(app: FastAPI, admin: TestClient) -> None:
    old = admin.cookies["tappet_session"]
    assert _log_in(admin).status_code == 200
    assert admin.cookies["tappet_session"] != old
    thief = browser(app)
    thief.cookies.set("tappet_session", old)
    assert thief.get("/api/v1/auth/me").status_code == 401


def test_logout_ends_the_session(app: FastAPI, admin: TestClient) -> None:
    secret = admin.cookies["tappet_session"]
    assert admin.post("/api/v1/auth/logout").status_code == 204
    thief = browser(app)
    thief.cookies.set("tappet_session", secret)
    assert thief.get("/api/v1/auth/me").status_code == 401


@pytest.mark.parametrize("column", ["seen_at", "created_at"])
def test_sessions_expire(admin: TestClient, services: Services, column: str) -> None:
    assert admin.get("/api/v1/auth/me").status_code == 200
    old = datetime.now(UTC) - timedelta(days=8)
    services.database.write(lambda db: db.execute(update(tables.sessions).values({column: old})))
    assert admin.get("/api/v1/auth/me").status_code == 401


def test_unknown_user_and_wrong_password_look_the_same(app: FastAPI, admin: TestClient) -> None:
    wrong = _log_in(browser(app), "not this one").json()
    unknown = _log_in(browser(app), "not this one", "nobody").json()
    assert wrong == unknown


def test_account_locks_with_growing_pause(app: FastAPI, admin: TestClient) -> None:
    client = browser(app)
    for _ in range(lockout.PAIR.free + 1):
        assert _log_in(client, "wrong password").status_code == 401
    locked = _log_in(client)
    assert locked.status_code == 429, "even the right password waits"
    assert int(locked.headers["retry-after"]) >= 1
    pauses = [lockout.PAIR.pause(n).total_seconds() for n in range(1, 20)]
    assert pauses[:7] == [0, 0, 0, 0, 1, 2, 4]
    assert max(pauses) == 300


def test_a_guesser_locks_only_the_own_address_out(app: FastAPI, admin: TestClient) -> None:
    guesser, owner = _from(app, "203.0.113.7"), _from(app, "203.0.113.8")
    while _log_in(guesser, "wrong password").status_code == 401:
        pass
    assert _log_in(guesser).status_code == 429
    assert _log_in(owner).status_code == 200


def test_who_works_behind_the_same_address_is_not_locked_out(app: FastAPI, admin: TestClient) -> None:
    """Of a plant with one public address; the administrator's session is from there."""
    guesser = browser(app)
    users = (f"user{n}" for n in count())
    while _log_in(guesser, "x", next(users)).status_code == 401:
        pass
    assert _log_in(guesser, "x", "nobody").status_code == 429
    assert _log_in(browser(app)).status_code == 200


def test_guessing_from_many_addresses_is_slowed(app: FastAPI, admin: TestClient) -> None:
    free = lockout.ACCOUNT.free
    codes = [_log_in(_from(app, f"198.51.100.{n}"), "wrong password").status_code for n in range(1, free + 3)]
    assert codes == [401] * (free + 1) + [429]
    assert _log_in(browser(app)).status_code == 200, "where the owner works, nothing is slower"


def test_a_network_of_ipv6_is_one_address() -> None:
    assert lockout.network("2001:db8:1:2::1") == lockout.network("2001:db8:1:2:ffff::9")
    assert lockout.network("2001:db8:1:3::1") != lockout.network("2001:db8:1:2::1")
    assert lockout.network("::ffff:203.0.113.7") == lockout.network("203.0.113.7") == "203.0.113.7"
    assert lockout.network("testclient") == "testclient"


def test_the_console_gets_in_however_much_is_guessed(app: FastAPI, services: Services) -> None:
    services.login.ensure_local_user()
    token = services.one_time.issue(LOCAL_LINK, timedelta(minutes=10))
    client = browser(app)
    link = "/api/v1/auth/link"
    for n in range(60):
        _log_in(client, "wrong password", f"user{n}")
        assert client.get(link, params={"token": f"guess{n}"}).status_code == 403
    assert _log_in(client, "wrong password").status_code == 429
    assert client.get(link, params={"token": token}, follow_redirects=False).status_code == 303
    refused = [e for e in client.get("/api/v1/audit").json() if e["action"] == "link-refused"]
    assert [e["count"] for e in refused] == [60]


def test_address_locks_over_many_accounts(app: FastAPI, admin: TestClient) -> None:
    client = _from(app, "203.0.113.7")
    codes = [_log_in(client, "x", f"user{n}").status_code for n in range(lockout.ADDRESS.free + 2)]
    assert codes[-1] == 429
    assert codes[: lockout.ADDRESS.free] == [401] * lockout.ADDRESS.free


def _from(app: FastAPI, address: str) -> TestClient:
    return bare(app, headers=PAGE, client=(address, 50000))


def test_a_right_password_frees_the_pair_only(app: FastAPI, admin: TestClient, services: Services) -> None:
    client = _from(app, "203.0.113.7")
    for _ in range(3):
        _log_in(client, "wrong password")
    assert _log_in(client).status_code == 200
    counts = services.database.write(
        lambda db: dict(db.execute(select(tables.login_failures.c.key, tables.login_failures.c.count)).all())
    )
    pair, address, account = lockout.Attempt("admin", "203.0.113.7").keys()
    assert pair not in counts
    assert (counts[address], counts[account]) == (3, 3)


def test_disabled_user_is_out_at_once(app: FastAPI, admin: TestClient) -> None:
    user = admin.post(
        "/api/v1/users", json={"username": "bob", "password": PASSWORD, "role": "engineer"}
    ).json()
    bob = browser(app)
    assert _log_in(bob, username="BOB").status_code == 200, "names ignore case"
    admin.patch(f"/api/v1/users/{user['id']}", json={"disabled": True})
    assert bob.get("/api/v1/auth/me").status_code == 401
    assert _log_in(bob, username="bob").status_code == 401


def test_local_link_works_once_for_an_account_without_password(app: FastAPI, services: Services) -> None:
    services.login.ensure_local_user()
    token = services.one_time.issue(LOCAL_LINK, timedelta(minutes=10))
    client = browser(app)
    answer = client.get("/api/v1/auth/link", params={"token": token}, follow_redirects=False)
    assert answer.status_code == 303
    assert answer.headers["location"] == "/"
    me = client.get("/api/v1/auth/me").json()
    assert (me["username"], me["role"], me["has_password"]) == ("local", "admin", False)
    other = browser(app)
    assert other.get("/api/v1/auth/link", params={"token": token}, follow_redirects=False).status_code == 403
    assert _log_in(other, "", "local").status_code == 401
    assert client.post("/api/v1/auth/password", json={"current": "", "new": PASSWORD}).status_code == 204
    assert _log_in(other, PASSWORD, "local").status_code == 200


def test_local_link_expires(app: FastAPI, services: Services) -> None:
    services.login.ensure_local_user()
    token = services.one_time.issue(LOCAL_LINK, timedelta(seconds=-1))
    assert browser(app).get("/api/v1/auth/link", params={"token": token}).status_code == 403


def test_local_link_only_from_this_machine(app: FastAPI, services: Services) -> None:
    services.login.ensure_local_user()
    token = services.one_time.issue(LOCAL_LINK, timedelta(minutes=10))
    stranger = bare(app, client=("192.168.1.20", 50000))
    assert stranger.get("/api/v1/auth/link", params={"token": token}).status_code == 403
    here = browser(app).get("/api/v1/auth/link", params={"token": token}, follow_redirects=False)
    assert here.status_code == 303, "a refused attempt does not use it up"


def test_password_change_needs_the_current_and_ends_other_sessions(app: FastAPI, admin: TestClient) -> None:
    other = browser(app)
    _log_in(other)
    change = "/api/v1/auth/password"
    assert admin.post(change, json={"current": "wrong", "new": "another good phrase"}).status_code == 403
    assert admin.post(change, json={"current": PASSWORD, "new": "another good phrase"}).status_code == 204
    assert admin.get("/api/v1/auth/me").status_code == 200
    assert other.get("/api/v1/auth/me").status_code == 401
    assert _log_in(other).status_code == 401
    assert _log_in(other, "another good phrase").status_code == 200
