"""The debugger over REST, with the compiler and the runtime as processes of their own."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import pytest
from fastapi import FastAPI
from fastapi.testclient import TestClient
from server_clients import RUNTIME, connected, real_app, serving, until

from tappet.server.settings import LOCAL_RUNTIME, ServerSettings

DEBUG = f"{RUNTIME}/debug"
DECLARATION = "PROGRAM PLC_PRG\nVAR\n  n : DINT;\n  half : DINT;\nEND_VAR\nVAR_TEMP\n  t : DINT;\nEND_VAR"
BODY = "t := n + 1;\nn := t;\nhalf := n / 2;"


@pytest.fixture
def app(settings: ServerSettings) -> Iterator[FastAPI]:
    app = real_app(settings)
    with serving(app):
        yield app


@pytest.fixture
def engineer(app: FastAPI) -> TestClient:
    return connected(app)


def ask(client: TestClient, method: str, path: str, **given: Any) -> Any:
    answer = client.request(method, f"{DEBUG}{path}", **given)
    assert answer.status_code < 300, answer.text
    return answer.json() if answer.content else None


def halted(client: TestClient) -> dict[str, Any]:
    until(lambda: client.get(RUNTIME).json()["halted"] == ["MainTask"])
    (halt,) = ask(client, "GET", "")["halted"]
    return halt


def test_a_day_of_debugging(app: FastAPI, engineer: TestClient) -> None:
    store = app.state.services.store
    info = store.create_project("Debugged", "ann")
    item = next(o for o in store.load(info.id).objects.values() if o.name == "PLC_PRG")
    application = store.load(info.id).applications()[0]

    def save(body: str) -> None:
        now = store.load(info.id).objects[item.id]
        store.save(
            info.id, item.id, now.revision, {"declaration": DECLARATION, "implementation": body}, "ann"
        )

    def load(mode: str) -> None:
        url = f"/api/v1/projects/{info.id}/applications/{application.id}/download"
        order = {"runtime_id": LOCAL_RUNTIME, "mode": mode, "start": True}
        done = engineer.post(url, json=order)
        assert done.status_code == 200, done.text

    assert engineer.post(f"{DEBUG}/control", json={"command": "pause"}).status_code == 409
    save(BODY)
    load("download")
    place = {"object_id": item.id, "part": "implementation", "line": 2}
    first = ask(engineer, "POST", "/breakpoints", json={"breakpoint": {"place": place}})
    assert first["verified"]
    assert (first["actual"]["object_id"], first["actual"]["line"]) == (item.id, 2)
    before = engineer.get(RUNTIME).json()["debug_sequence"]

    halt = halted(engineer)
    assert (halt["reason"], halt["breakpoint_id"]) == ("breakpoint", first["id"])
    assert halt["place"]["object_id"] == item.id
    assert (halt["place"]["part"], halt["place"]["line"]) == ("implementation", 2)
    (frame,) = ask(engineer, "GET", "/stack", params={"task": "MainTask"})["frames"]
    assert frame["place"]["line"] == 2
    found = ask(engineer, "GET", "/stack/0/variables", params={"task": "MainTask"})["variables"]
    values = {v["name"]: v["value"] for v in found}
    assert values["t"] == values["n"] + 1
    written = ask(
        engineer, "POST", "/stack/0/write", json={"task": "MainTask", "name": "t", "value": "DINT#500"}
    )
    assert written["literal"] == "500"
    state = ask(engineer, "POST", "/control", json={"command": "step_over"})
    assert state["halted"][0]["place"]["line"] == 3
    until(lambda: engineer.get(RUNTIME).json()["debug_sequence"] > before)
    read = engineer.post(f"{RUNTIME}/values/read", json={"expressions": ["PLC_PRG.n"]}).json()
    assert read["values"][0]["value"] == 500

    ask(engineer, "PUT", "/flow", json={"object_ids": [item.id]})
    ask(engineer, "POST", "/control", json={"command": "continue"})
    halted(engineer)
    flow = ask(engineer, "GET", "/flow", params={"object_id": item.id})
    executed = {s["line"]: {v["name"] for v in s["values"]} for s in flow["statements"]}
    assert executed[1] == {"t", "n"}
    ask(engineer, "PUT", "/flow", json={"object_ids": []})

    save(f"// moved down\n{BODY}")
    load("online_change")
    until(lambda: ask(engineer, "GET", "")["breakpoints"][0]["verified"])
    assert halted(engineer)["place"]["line"] == 2, "a breakpoint stays at its line"

    versions = f"/api/v1/projects/{info.id}/applications/{application.id}/versions"
    oldest = engineer.get(versions, params={"runtime_id": LOCAL_RUNTIME}).json()[-1]["code_id"]
    order = {"runtime_id": LOCAL_RUNTIME, "mode": "online_change"}
    assert engineer.post(f"{versions}/{oldest}/restore", json=order).status_code == 200
    until(lambda: ask(engineer, "GET", "")["breakpoints"][0]["verified"])
    assert halted(engineer)["place"]["line"] == 2, "and holds in the version that is back"

    wrong = engineer.put(f"{DEBUG}/breakpoints/77", json={"breakpoint": {"place": place}})
    assert wrong.status_code == 404
    assert engineer.post(f"{DEBUG}/breakpoints", json={"breakpoint": {"kind": "line"}}).status_code == 409
    for enabled in (False, True):
        state = ask(engineer, "PUT", "/breakpoints", json={"enabled": enabled})
        assert [one["order"]["enabled"] for one in state["breakpoints"]] == [enabled]
    ask(engineer, "DELETE", f"/breakpoints/{first['id']}")
    ask(engineer, "POST", "/control", json={"command": "continue"})
    until(lambda: not engineer.get(RUNTIME).json()["halted"])
    until(lambda: not ask(engineer, "GET", "")["active"])
    log = engineer.get("/api/v1/audit").json()
    actions = {row["action"] for row in log["rows"]} if isinstance(log, dict) and "rows" in log else str(log)
    assert "breakpoint-added" in actions
