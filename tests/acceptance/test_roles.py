"""Who may do what with a running machine: viewer, operator, engineer, administrator, and nobody."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import pytest
from live_server import RUNTIME, Script, Station, station, until

PASSWORD = "correct horse battery"
ROLES = ("viewer", "operator", "engineer", "admin")


@dataclass
class Team:
    """A running application and one person of every role."""

    plant: Station
    people: dict[str, Script]


@pytest.fixture(scope="module")
def team(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Team]:
    with station(tmp_path_factory.mktemp("roles")) as plant:
        boss = plant.admin
        boss.create_project("Team")
        text = "PROGRAM PLC_PRG\nVAR\n    n : DINT;\n    k : INT;\nEND_VAR"
        boss.save("PLC_PRG", declaration=text, implementation="n := n + 1;")
        boss.download()
        boss.wait_for_state("run")
        people = {}
        for role in ROLES:
            name = f"the.{role}"
            boss.post("/users", {"username": name, "password": PASSWORD, "role": role}, 201)
            person = plant.browser()
            me = person.post("/auth/login", {"username": name, "password": PASSWORD})
            assert (me["username"], me["role"]) == (name, role)
            person.project_id, person.application_id, person.ids = (
                boss.project_id,
                boss.application_id,
                boss.ids,
            )
            people[role] = person
        yield Team(plant, people)


def _write(n: int) -> dict[str, object]:
    return {"values": [{"expression": "PLC_PRG.k", "value": n}]}


def _deeds(project: str, application: str, program: str) -> dict[str, list[tuple[str, str, object]]]:
    """Requests by the lowest role that may make them; all are good ones."""
    return {
        "viewer": [
            ("GET", "/projects", None),
            ("GET", f"{project}/objects/{program}", None),
            ("GET", f"{project}/export", None),
            ("GET", RUNTIME, None),
            ("GET", f"{RUNTIME}/tasks", None),
            ("GET", f"{RUNTIME}/forces", None),
            ("POST", f"{application}/login", {"runtime_id": "local"}),
            ("POST", f"{RUNTIME}/values/read", {"expressions": ["PLC_PRG.k"]}),
            ("PUT", "/me/settings/theme", "dark"),
        ],
        "operator": [
            ("POST", f"{RUNTIME}/values/write", _write(1)),
            ("POST", f"{RUNTIME}/values/force", _write(2)),
            ("POST", f"{RUNTIME}/values/unforce", {"expressions": None}),
            ("POST", f"{RUNTIME}/stop", None),
            ("POST", f"{RUNTIME}/start", None),
        ],
        "engineer": [
            ("POST", f"{application}/build", None),
            ("POST", f"{RUNTIME}/reset", {"kind": "warm"}),
            ("POST", f"{application}/download", {"runtime_id": "local", "mode": "download", "start": True}),
            ("PATCH", f"{project}/objects/{program}", {"index": 0}),
            ("GET", "/audit", None),
        ],
        "admin": [("GET", "/users", None)],
    }


@pytest.mark.parametrize("role", ROLES)
def test_everybody_may_do_what_their_role_says_and_no_more(team: Team, role: str) -> None:
    person = team.people[role]
    deeds = _deeds(person.project, person.application, person.ids["PLC_PRG"])
    for needed, requests in deeds.items():
        for method, path, body in requests:
            answer = person.http.request(method, path, json=body)
            allowed = ROLES.index(role) >= ROLES.index(needed)
            assert (answer.status_code < 300) is allowed, (role, method, path, answer.text)
            if not allowed:
                assert answer.status_code == 403
                assert answer.json()["required_role"] == needed
                assert needed in answer.json()["detail"]


def test_nobody_gets_in_without_login(team: Team) -> None:
    person = team.people["viewer"]
    deeds = _deeds(person.project, person.application, person.ids["PLC_PRG"])
    stranger = team.plant.anonymous()
    page = team.plant.browser()
    forged = team.plant.script("x" * 43)
    for requests in deeds.values():
        for method, path, body in requests:
            for client in (stranger, page, forged):
                client.call(method, path, body, 401)
    assert stranger.get("/health")["status"] == "ok"
    assert stranger.get("/auth/status") == {
        "first_account_needed": False,
        "authenticated": False,
        "user": None,
    }


def test_a_token_never_does_more_than_its_owner(team: Team) -> None:
    operator = team.people["operator"]
    refused = operator.post("/auth/tokens", {"name": "more", "role": "engineer"}, 403)
    assert "the.operator" in refused["detail"]
    made = operator.post("/auth/tokens", {"name": "watch", "role": "viewer"}, 201)
    program = team.plant.script(made["secret"])
    assert program.value("PLC_PRG.n") >= 0
    program.write("PLC_PRG.k", 1, status=403)
    program.post("/auth/tokens", {"name": "child", "role": "viewer"}, 403)
    operator.call("DELETE", f"/auth/tokens/{made['id']}", status=204)
    program.get("/projects", 401)


def test_a_foreign_page_cannot_use_the_session(team: Team) -> None:
    operator = team.people["operator"]
    body = _write(5)
    evil = {"Origin": "http://evil.example"}
    assert operator.http.post(f"{RUNTIME}/values/write", json=body, headers=evil).status_code == 403
    bare = team.plant.anonymous()
    bare.http.cookies.update(operator.http.cookies)
    assert bare.http.get("/auth/me").status_code == 200
    assert bare.http.post(f"{RUNTIME}/values/write", json=body).status_code == 403


def test_a_demoted_or_disabled_user_is_out_at_once(team: Team) -> None:
    boss = team.people["admin"]
    made = boss.post("/users", {"username": "temp", "password": PASSWORD, "role": "engineer"}, 201)
    temp = team.plant.browser()
    temp.post("/auth/login", {"username": "temp", "password": PASSWORD})
    token = team.plant.script(temp.post("/auth/tokens", {"name": "t", "role": "engineer"}, 201)["secret"])
    boss.call("PATCH", f"/users/{made['id']}", {"role": "viewer"})
    for client in (temp, token):
        assert client.http.post(f"{RUNTIME}/values/write", json=_write(1)).status_code in (401, 403)
    boss.call("PATCH", f"/users/{made['id']}", {"disabled": True})
    temp.get("/projects", 401)
    token.get("/projects", 401)
    temp.post("/auth/login", {"username": "temp", "password": PASSWORD}, 401)
    boss.call("DELETE", f"/users/{made['id']}", status=204)
    boss.call("DELETE", f"/users/{boss.get('/auth/me')['id']}", status=409)


def test_repeated_wrong_passwords_lock_the_account_out(team: Team) -> None:
    boss = team.people["admin"]
    boss.post("/users", {"username": "victim", "password": PASSWORD, "role": "operator"}, 201)
    guesser = team.plant.browser()
    answers = []
    for n in range(12):  # five are free; where a check takes longer than the first pauses, a longer one locks
        wrong = {"username": "victim", "password": f"guess number {n}"}
        answers.append(guesser.http.post("/auth/login", json=wrong))
        if answers[-1].status_code == 429:
            break
    assert [a.status_code for a in answers] == [401] * (len(answers) - 1) + [429]
    assert len(answers) >= 6
    assert int(answers[-1].headers["Retry-After"]) >= 1
    texts = {a.json()["detail"] for a in answers[:-1]}
    unknown = guesser.post("/auth/login", {"username": "no.such.user", "password": "guess"}, 401)
    assert texts == {unknown["detail"]}, "an answer does not tell whether the account exists"
    right = {"username": "victim", "password": PASSWORD}
    assert guesser.http.post("/auth/login", json=right).status_code in (200, 429)
    until(lambda: guesser.http.post("/auth/login", json=right).status_code == 200, "the pause ends")
    entries = boss.get("/audit?limit=200")
    failed = [e for e in entries if e["action"] == "login-failed" and e["subject"] == "victim"]
    assert [e["result"] for e in failed] == ["refused"]
    assert failed[0]["count"] >= 4
    assert any(e["action"] == "login-locked-out" for e in entries)
    assert not any(PASSWORD in str(e) or "guess number" in str(e) for e in entries)
    assert team.people["viewer"].get("/auth/me")["username"] == "the.viewer", "others are not locked out"
