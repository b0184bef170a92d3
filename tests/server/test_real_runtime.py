"""The whole way with nothing replaced: store, compiler process, runtime process, online channel."""

from __future__ import annotations

import os
import signal
import struct
import time
from collections.abc import Iterator
from dataclasses import replace
from typing import Any

import pytest
from fastapi import FastAPI
from fastapi.testclient import TestClient
from server_clients import RUNTIME, SOCKETS, connected, first_account, real_app, serving, until

from tappet.project.cams.table import CamTable
from tappet.server.app import create_app
from tappet.server.settings import LOCAL_RUNTIME, ServerSettings

DECLARATION = "PROGRAM PLC_PRG\nVAR\n  n : DINT;\n  half : DINT;\n  d : DINT := 1;\nEND_VAR"


@pytest.fixture
def app(settings: ServerSettings) -> Iterator[FastAPI]:
    app = real_app(settings)
    with serving(app):
        yield app


@pytest.fixture
def engineer(app: FastAPI) -> TestClient:
    return connected(app)


def _value(client: TestClient, path: str):
    answer = client.post(f"{RUNTIME}/values/read", json={"expressions": [path]})
    assert answer.status_code == 200, answer.text
    return answer.json()["values"][0]["value"]


def _save(app: FastAPI, project_id: str, implementation: str, declaration: str = DECLARATION) -> None:
    store = app.state.services.store
    item = next(o for o in store.load(project_id).objects.values() if o.name == "PLC_PRG")
    data = {"declaration": declaration, "implementation": implementation}
    store.save(project_id, item.id, item.revision, data, "ann")


def test_from_text_to_live_values_and_back(app: FastAPI, engineer: TestClient) -> None:
    store = app.state.services.store
    info = store.create_project("Real", "ann")
    application = store.load(info.id).applications()[0]
    url = f"/api/v1/projects/{info.id}/applications/{application.id}"
    target = {"runtime_id": LOCAL_RUNTIME}
    _save(app, info.id, "n := n + 1;\nhalf := n / 2;")

    assert engineer.post(f"{url}/login", json=target).json()["relation"] == "empty"
    order = {**target, "mode": "download", "start": True}
    done = engineer.post(f"{url}/download", json=order)
    assert done.status_code == 200, done.text
    assert done.json()["state"] == "run"
    until(lambda: _value(engineer, "PLC_PRG.n") > 3)

    with engineer.websocket_connect(f"{SOCKETS}/api/v1/online?runtime={LOCAL_RUNTIME}") as socket:
        wish = {"op": "subscribe", "id": 4, "expressions": ["PLC_PRG.n", "PLC_PRG.half"], "interval_ms": 50}
        socket.send_json(wish)
        frames = []
        while len(frames) < 4:
            data = socket.receive().get("bytes")
            if data is not None:
                frames.append(struct.unpack("<IIQqii", data))
        assert {frame[0] for frame in frames} == {4}
        assert all(half == n // 2 for *_, n, half in frames), "values of one cycle belong together"
        assert frames[-1][4] > frames[0][4]
        assert abs(frames[-1][3] / 1e9 - time.time()) < 60

    write = {"values": [{"expression": "PLC_PRG.d", "value": "16#10"}]}
    assert engineer.post(f"{RUNTIME}/values/write", json=write).json()["values"][0]["value"] == 16
    force = {"values": [{"expression": "PLC_PRG.n", "value": 100}]}
    assert engineer.post(f"{RUNTIME}/values/force", json=force).json()["values"][0]["literal"] == "100"
    until(lambda: _value(engineer, "PLC_PRG.n") in (100, 101))
    assert engineer.post(f"{RUNTIME}/values/unforce", json={"expressions": None}).json()["values"] == []

    _save(app, info.id, "n := n - 1;\nhalf := n / 2;")
    assert engineer.post(f"{url}/login", json=target).json()["relation"] == "online_change"
    changed = engineer.post(f"{url}/download", json={**order, "mode": "online_change"})
    assert changed.status_code == 200, changed.text
    assert changed.json()["state"] == "run"
    assert _value(engineer, "PLC_PRG.d") == 16, "an online change keeps values"
    before = _value(engineer, "PLC_PRG.n")
    until(lambda: _value(engineer, "PLC_PRG.n") < before)
    assert engineer.post(f"{url}/login", json=target).json()["relation"] == "same"
    tasks = engineer.get(f"{RUNTIME}/tasks").json()
    assert tasks[0]["iec_cycles"] > 0
    (times,) = engineer.get(f"{RUNTIME}/tasks/histograms").json()
    assert times["name"] == tasks[0]["name"]
    assert sum(one["cycles"] for one in times["classes"]) >= tasks[0]["iec_cycles"]
    until(lambda: engineer.get(f"{RUNTIME}/tasks/load").json()["samples"])
    load = engineer.get(f"{RUNTIME}/tasks/load").json()
    assert load["tasks"] == [tasks[0]["name"]]
    assert 0 < load["samples"][-1]["tasks"][0] <= 100

    _save(app, info.id, "d := 0;\nn := n / d;")
    assert engineer.post(f"{url}/download", json={**order, "mode": "online_change"}).status_code == 200
    until(lambda: engineer.get(RUNTIME).json()["state"] == "exception")
    report = engineer.get(RUNTIME).json()["exception"]
    assert report["name"] == "DIV_ZERO"
    assert report["pou"] == "PLC_PRG"
    assert report["object_id"]
    assert (report["part"], report["line"]) == ("implementation", 2)
    flight = engineer.get(f"{RUNTIME}/flight").json()
    assert (flight["frozen"], flight["frozen_by"]) == (True, "exception")
    last = flight["entries"]["last_cycle"]
    values = []
    for cycle in (last - 1, last):
        past = {"cycle": cycle, "expressions": ["PLC_PRG.d", "PLC_PRG.n"]}
        answer = engineer.post(f"{RUNTIME}/flight/read", json=past)
        assert answer.status_code == 200, answer.text
        values.append([value["value"] for value in answer.json()["values"]])
    assert values[0][0] == 16, "the cycle before the fault"
    assert values[1] == [0, _value(engineer, "PLC_PRG.n")]


def test_a_killed_runtime_comes_back_with_its_application(app: FastAPI, engineer: TestClient) -> None:
    store = app.state.services.store
    info = store.create_project("Boot", "ann")
    application = store.load(info.id).applications()[0]
    url = f"/api/v1/projects/{info.id}/applications/{application.id}"
    _save(app, info.id, "n := n + 1;")
    order = {"runtime_id": LOCAL_RUNTIME, "mode": "download", "start": True}
    assert engineer.post(f"{url}/download", json=order).status_code == 200
    first = engineer.get(RUNTIME).json()
    os.kill(app.state.services.local_runtime._process.endpoint.pid, signal.SIGKILL)
    until(lambda: not engineer.get(RUNTIME).json()["connected"])
    assert "SIGKILL" in engineer.get(RUNTIME).json()["problem"]
    until(lambda: engineer.get(RUNTIME).json()["connected"], 60)
    again = engineer.get(RUNTIME).json()
    assert (again["state"], again["code_id"]) == ("run", first["code_id"])
    assert engineer.post(f"{url}/login", json={"runtime_id": LOCAL_RUNTIME}).json()["relation"] == "same"


def test_a_runtime_that_does_not_start_is_tried_again_and_says_why(settings: ServerSettings) -> None:
    """A file stands where its folder should be: the list says so. It comes up once that is mended."""
    folder = settings.data_dir / "runtime"
    settings.data_dir.mkdir(parents=True, exist_ok=True)
    folder.write_text("no folder")
    app = real_app(settings)
    with serving(app):
        client = first_account(app)

        def listed() -> dict[str, Any]:
            (one,) = client.get("/api/v1/runtimes").json()
            return one

        until(lambda: "next attempt" in (listed()["problem"] or ""), 90)
        shown = listed()
        assert not shown["connected"]
        assert "did not come up: " in shown["problem"]
        assert "runtime" in shown["problem"]
        until(lambda: listed()["problem"] != shown["problem"], 90)  # tried again, after a longer pause
        folder.unlink()
        until(lambda: listed()["connected"], 90)
        assert listed()["problem"] is None


def test_a_server_ends_while_its_runtime_does_not_start(settings: ServerSettings) -> None:
    settings.data_dir.mkdir(parents=True, exist_ok=True)
    (settings.data_dir / "runtime").write_text("no folder")
    app = create_app(replace(settings, local_runtime=True, reconnect_seconds=3600.0))
    with serving(app):
        link = app.state.services.runtimes.get(LOCAL_RUNTIME)
        until(lambda: "next attempt" in (link.problem or ""), 90)


def test_an_axis_is_moved_by_hand_and_let_go_when_nobody_is_there(app: FastAPI, engineer: TestClient) -> None:
    made = engineer.post("/api/v1/projects", json={"name": "axes", "template": "motion"}).json()
    application = app.state.services.store.load(made["id"]).applications()[0]
    url = f"/api/v1/projects/{made['id']}/applications/{application.id}"
    order = {"runtime_id": LOCAL_RUNTIME, "mode": "download", "start": True}
    assert engineer.post(f"{url}/download", json=order).status_code == 200
    until(lambda: _value(engineer, "Drive.fSetVelocity") != 0.0)
    panel = f"{RUNTIME}/axes/Drive/panel"

    def alive() -> str:
        answer = engineer.post(f"{panel}/alive", json={"holder": 5})
        assert answer.status_code == 200, answer.text
        return str(answer.json()["state"])

    assert engineer.post(panel, json={"holder": 5, "action": "force"}).status_code == 200
    until(lambda: alive() == "Control")
    refused = engineer.post(panel, json={"holder": 6, "action": "power_on"})
    assert refused.status_code == 409
    assert "another page controls the axis 'Drive'" in refused.json()["detail"]
    assert engineer.post(panel, json={"holder": 5, "action": "fly"}).status_code == 422
    missing = engineer.post(f"{RUNTIME}/axes/Nobody/panel", json={"holder": 5, "action": "take"})
    assert missing.status_code == 404
    until(lambda: engineer.post(f"{panel}/alive", json={"holder": 6}).json()["state"] == "Free")
    assert _value(engineer, "Drive.fSetVelocity") == 0.0  # what the program had begun has failed
    back = {"expression": "PLC_PRG.xBack", "value": not _value(engineer, "PLC_PRG.xBack")}
    assert engineer.post(f"{RUNTIME}/values/write", json={"values": [back]}).status_code == 200
    until(lambda: _value(engineer, "Drive.fSetVelocity") != 0.0)  # it has the axis again
    acts = [entry for entry in engineer.get("/api/v1/audit").json() if entry["action"] == "axis-panel"]
    assert {(entry["subject"], entry["new_value"]) for entry in acts} >= {("Drive", "force 0.0")}
    assert all("alive" not in str(entry["new_value"]) for entry in acts)
    assert engineer.post(f"{RUNTIME}/stop").status_code == 200
    assert _value(engineer, "Drive.fSetVelocity") == 0.0


def test_a_cam_of_the_application_is_read_and_written(app: FastAPI, engineer: TestClient) -> None:
    """CAM-94: the curve that runs is that of the variables, not that of the project."""
    store = app.state.services.store
    info = store.create_project("Cams", "ann")
    application = store.load(info.id).applications()[0]
    objects = f"/api/v1/projects/{info.id}/objects"
    for kind, name in (("axis_pool", None), ("cam", "Lift")):
        body = {"parent_id": application.id, "kind": kind, "name": name}
        made = engineer.post(objects, json=body)
        assert made.status_code == 201, made.text
    declaration = """PROGRAM PLC_PRG
VAR
    stValues : SMC_CAMValues;
    nElement : INT;
    fX : LREAL := 60;
END_VAR"""
    _save(app, info.id, "stValues := SMC_CAMEvaluate(Lift, fX, nElement);", declaration)
    url = f"/api/v1/projects/{info.id}/applications/{application.id}"
    order = {"runtime_id": LOCAL_RUNTIME, "mode": "download", "start": True}
    done = engineer.post(f"{url}/download", json=order)
    assert done.status_code == 200, done.text
    until(lambda: _value(engineer, "PLC_PRG.stValues.dY") == 41.25)

    cam = CamTable().model_dump(mode="json")
    lift = f"{RUNTIME}/cams/Lift"
    read = engineer.post(f"{lift}/read", json={"cam": cam})
    assert read.status_code == 200, read.text
    assert read.json() == {"cam": cam, "same": True}

    cam["points"][1] |= {"y": 60, "v": 0.5}
    cam["tracks"][0]["tappets"][0]["x"] = 95
    assert engineer.post(f"{lift}/write", json={"cam": cam}).status_code == 204
    # half way: 10/8 - 15/16 + 6/32 of the rise, 4/8 - 7/16 + 3/32 of the slope at the end less
    until(lambda: _value(engineer, "PLC_PRG.stValues.dY") == 60 * 0.5 - 0.5 * 120 * 0.15625)
    read = engineer.post(f"{lift}/read", json={"cam": CamTable().model_dump(mode="json")}).json()
    assert not read["same"]
    assert read["cam"]["points"] == cam["points"]
    assert read["cam"]["tracks"] == cam["tracks"][:1]
    acts = [entry for entry in engineer.get("/api/v1/audit").json() if entry["subject"] == "Lift"]
    assert [(one["action"], one["old_value"], one["new_value"]) for one in acts] == [
        ("write", "4 elements, 4 tappets", "4 elements, 4 tappets")
    ]

    fifth = {**cam, "points": [*cam["points"], {"x": 400, "y": 360}], "segments": [{}] * 4}
    refused = engineer.post(f"{lift}/write", json={"cam": fifth})
    assert (refused.status_code, refused.json()["type"]) == (422, "urn:tappet:problem:running-cam")
    assert "room for 4 elements of 'Lift', and the cam has 5" in refused.json()["detail"]
    missing = engineer.post(f"{RUNTIME}/cams/Drop/read", json={"cam": cam})
    assert missing.status_code == 404
    assert "no cam 'Drop'" in missing.json()["detail"]

    _save(app, info.id, "Lift.pce := ADR(stValues);", declaration)
    assert engineer.post(f"{url}/download", json=order).status_code == 200
    until(lambda: engineer.post(f"{lift}/read", json={"cam": cam}).status_code == 409)
