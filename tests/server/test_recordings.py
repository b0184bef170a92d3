"""Recordings over REST: kept in a project, opened in place of a runtime, replayed on old and new code."""

from __future__ import annotations

import json
import struct
from collections.abc import Callable
from typing import Any

import pytest
from failing_press import BUG, DECLARATION, MENDED, recording_of
from fake_plc import FakePlc
from fastapi.testclient import TestClient
from server_clients import SOCKETS

from tappet.runtime.flight_recording import read_recording
from tappet.server.services import Services

API = "/api/v1"


@pytest.fixture
def press(admin: TestClient) -> dict[str, str]:
    """A project with the bug; ids of what is in it."""
    project = admin.post(f"{API}/projects", json={"name": "Press"}).json()["id"]
    objects = {item["name"]: item for item in admin.get(f"{API}/projects/{project}/objects").json()}
    ids = {
        "project": project,
        "application": objects["Application"]["id"],
        "program": objects["PLC_PRG"]["id"],
    }
    _write(admin, ids, BUG)
    return ids


def _write(admin: TestClient, ids: dict[str, str], text: str) -> None:
    url = f"{API}/projects/{ids['project']}/objects/{ids['program']}"
    revision = admin.get(url).json()["revision"]
    data = {"declaration": DECLARATION, "implementation": text}
    answer = admin.put(url, json={"base_revision": revision, "data": data})
    assert answer.status_code == 200, answer.text


@pytest.fixture
def recording(services: Services, press: dict[str, str]) -> str:
    """What the program of the project has recorded."""
    return recording_of(services.store.load(press["project"]))


def _at(ids: dict[str, str]) -> str:
    return f"{API}/projects/{ids['project']}/applications/{ids['application']}/recordings"


def _upload(client: TestClient, ids: dict[str, str], text: str, name: str = "Monday") -> Any:
    files = {"file": ("monday.flight", text.encode(), "text/plain")}
    return client.post(f"{_at(ids)}/file", params={"name": name}, files=files)


@pytest.fixture
def kept(admin: TestClient, press: dict[str, str], recording: str) -> str:
    answer = _upload(admin, press, recording)
    assert answer.status_code == 201, answer.text
    return f"{API}/projects/{press['project']}/recordings/{answer.json()['id']}"


def test_a_runtime_s_recording_becomes_an_object_and_a_file(
    admin: TestClient, press: dict[str, str], recording: str, runtime_id: str, plc: FakePlc
) -> None:
    order = {"runtime_id": runtime_id, "name": "Stop of Monday"}
    empty = admin.post(_at(press), json=order)
    assert (empty.status_code, "has not run" in empty.json()["detail"]) == (409, True)
    plc.recording = read_recording(recording)
    made = admin.post(_at(press), json=order)
    assert made.status_code == 201, made.text
    url = f"{API}/projects/{press['project']}/recordings/{made.json()['id']}"
    facts = admin.get(url).json()
    assert (facts["application"], facts["cycles"], facts["last_cycle"]) == ("Application", 21, 21)
    assert (facts["exception"]["name"], facts["writes"]) == ("DIV_ZERO", 1)
    file = admin.get(f"{url}/file")
    assert read_recording(file.text) == plc.recording
    assert "Stop%20of%20Monday.flight" in file.headers["content-disposition"]
    assert read_recording(admin.get(f"{API}/runtimes/{runtime_id}/flight/file").text) == plc.recording


def test_only_engineers_keep_and_replay(
    as_role: dict[str, TestClient], press: dict[str, str], recording: str, kept: str
) -> None:
    operator, viewer = as_role["operator"], as_role["viewer"]
    assert _upload(operator, press, recording).status_code == 403
    assert operator.post(f"{kept}/replay", json={}).status_code == 403
    assert viewer.get(kept).status_code == 200
    assert viewer.post(f"{kept}/open").status_code == 200


def test_what_is_no_recording_is_refused(
    admin: TestClient, press: dict[str, str], recording: str, kept: str
) -> None:
    for text, says in (
        ("", "first line"),
        ("PROGRAM é", "no recording"),
        (recording[:-9], "damaged"),
        (recording.replace("FLIGHT 2", "FLIGHT 9"), "version 9"),
    ):
        answer = _upload(admin, press, text)
        assert answer.status_code == 422, answer.text
        assert says in answer.json()["detail"]
    program = f"{API}/projects/{press['project']}/recordings/{press['program']}"
    for answer in (admin.get(program), admin.post(f"{program}/open"), admin.get(f"{program}/file")):
        assert answer.status_code == 404


def test_an_opened_recording_shows_its_cycles_and_takes_nothing(
    admin: TestClient, kept: str, press: dict[str, str]
) -> None:
    opened = admin.post(f"{kept}/open").json()
    runtime = opened["runtime"]
    assert (runtime["state"], runtime["connected"], opened["relation"]) == ("exception", True, "same")
    assert runtime["exception"]["object_id"] == press["program"]
    assert admin.post(f"{kept}/open").json()["runtime"]["id"] == runtime["id"]
    assert runtime["id"] not in [one["id"] for one in admin.get(f"{API}/runtimes").json()]
    url = f"{API}/runtimes/{runtime['id']}"
    assert admin.get(f"{url}/flight").json()["frozen"] is True
    cycles = [row["cycle"] for row in admin.get(f"{url}/flight/cycles").json()]
    assert cycles == list(range(1, 22))
    for cycle in (1, 7, 20):  # twenty pieces a cycle
        order = {"cycle": cycle, "expressions": ["PLC_PRG.pieces", "PLC_PRG.recipe"]}
        values = admin.post(f"{url}/flight/read", json=order).json()["values"]
        assert [value["value"] for value in values] == [cycle * 20, 5]
    now = admin.post(f"{url}/values/read", json={"expressions": ["PLC_PRG.recipe"]}).json()["values"]
    assert now[0]["value"] == 0
    write = {"values": [{"expression": "PLC_PRG.recipe", "value": "4"}]}
    for path, body in (
        ("values/write", write),
        ("values/force", write),
        ("start", None),
        ("reset", {"kind": "warm"}),
    ):
        refused = admin.post(f"{url}/{path}", json=body)
        assert refused.status_code == 409, (path, refused.text)
        assert "this is a recording" in refused.json()["detail"]
    missing = admin.post(f"{url}/flight/read", json={"cycle": 99, "expressions": ["PLC_PRG.recipe"]})
    assert missing.status_code == 409
    assert "cycles 1 to 21" in missing.json()["detail"]


def test_the_online_channel_leads_through_it(admin: TestClient, kept: str) -> None:
    runtime = admin.post(f"{kept}/open").json()["runtime"]["id"]
    with admin.websocket_connect(f"{SOCKETS}{API}/online?runtime={runtime}") as socket:
        order = {"op": "subscribe", "id": 1, "expressions": ["PLC_PRG.pieces"], "interval_ms": 100}
        socket.send_json(order)
        assert _value(socket.receive, lambda flags, cycle: flags == 0) == 400
        for cycle in (3, 20, 2):
            socket.send_json({"op": "look_back", "cycle": cycle})
            wanted = cycle
            assert (
                _value(socket.receive, lambda flags, seen, wanted=wanted: flags == 1 and seen == wanted)
                == cycle * 20
            )


def _value(receive: Callable[[], Any], fits: Callable[..., bool]) -> int:
    while True:
        message = receive()
        data = message.get("bytes")
        if data is None:
            assert json.loads(message["text"])["op"] != "error"
            continue
        _, flags, cycle, _ = struct.unpack_from("<IIQq", data)
        if fits(flags, cycle):
            return int(struct.unpack_from("<i", data, 24)[0])


def test_a_replay_fails_as_it_did_and_no_more_when_mended(
    admin: TestClient, kept: str, press: dict[str, str]
) -> None:
    report = admin.post(f"{kept}/replay", json={}).json()
    assert (report["ok"], report["same_fault"], report["problem"]) == (True, True, None)
    assert (report["last_cycle"], report["first_difference"]) == (21, None)
    assert report["fault"]["object_id"] == press["program"]
    today = admin.post(f"{kept}/replay", json={"today": True}).json()
    assert (today["ok"], today["same_fault"]) == (False, True)
    _write(admin, press, MENDED)
    mended = admin.post(f"{kept}/replay", json={"today": True}).json()
    assert (mended["ok"], mended["fault"], mended["last_cycle"]) == (True, None, 21)
    assert admin.post(f"{kept}/open").json()["relation"] == "online_change"
    _write(admin, press, "pieces := ;")
    broken = admin.post(f"{kept}/replay", json={"today": True})
    assert (broken.status_code, broken.json()["type"]) == (409, "urn:tappet:problem:build-errors")
    assert admin.post(f"{kept}/open").json()["relation"] == "download"


def _tests(client: TestClient, ids: dict[str, str], **order: Any) -> dict[str, Any]:
    url = f"{API}/projects/{ids['project']}/applications/{ids['application']}/tests"
    answer = client.post(url, json=order)
    assert answer.status_code == 200, answer.text
    report: dict[str, Any] = answer.json()
    return report


def _expect(client: TestClient, ids: dict[str, str], kept: str, **data: Any) -> None:
    """Changes what is expected of a recording."""
    url = f"{API}/projects/{ids['project']}/objects/{kept.rsplit('/', 1)[1]}"
    item = client.get(url).json()
    body = {"base_revision": item["revision"], "data": {**item["data"], **data}}
    answer = client.put(url, json=body)
    assert answer.status_code == 200, answer.text


def test_recordings_are_tests_of_the_application(
    admin: TestClient, press: dict[str, str], kept: str, recording: str
) -> None:
    failed = _tests(admin, press)
    assert (failed["ok"], failed["total"], failed["failed"], failed["problem"]) == (False, 1, 1, None)
    (suite,) = failed["suites"]
    (test,) = suite["tests"]
    assert (suite["name"], test["name"]) == ("Flight recordings", "Monday")
    (failure,) = test["failures"]
    assert failure["message"] == "cycle 21: division by zero"
    assert (failure["object_id"], failure["line"]) == (press["program"], 1)
    url = f"{API}/projects/{press['project']}/applications/{press['application']}/tests"
    assert admin.get(url).json()["outdated"] is False

    _expect(admin, press, kept, expects="same_fault")
    assert admin.get(url).json()["outdated"] is True, "what is expected is part of what is tested"
    assert _tests(admin, press)["ok"] is True
    _write(admin, press, MENDED)
    gone = _tests(admin, press)["suites"][0]["tests"][0]["failures"][0]
    assert gone["message"] == "the recorded fault of cycle 21 did not come again: division by zero"
    _expect(admin, press, kept, expects="no_fault")
    assert _tests(admin, press)["passed"] == 1

    assert _upload(admin, press, recording, "Tuesday").status_code == 201
    some = _tests(admin, press, only=["Flight recordings.Tuesday"])
    assert [test["outcome"] for test in some["suites"][0]["tests"]] == ["skipped", "passed"]
    assert admin.get(url).json()["report"]["passed"] == 2, "the other one keeps its result"
    assert _tests(admin, press, filter="*tues")["total"] == 1
    _expect(admin, press, kept, tested=False)
    assert _tests(admin, press)["total"] == 1


def test_results_of_recordings_are_told_in_chinese(
    admin: TestClient, press: dict[str, str], kept: str
) -> None:
    admin.headers["Accept-Language"] = "zh"
    _expect(admin, press, kept, expects="same_fault")
    _write(admin, press, MENDED)
    failure = _tests(admin, press)["suites"][0]["tests"][0]["failures"][0]
    assert failure["message"] == "周期 21 的记录故障没有再次出现：除以零"
