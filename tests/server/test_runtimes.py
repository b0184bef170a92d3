"""The list of runtimes, their state, and connections that mend themselves."""

from __future__ import annotations

import asyncio

from fake_plc import FakePlc, division_by_zero
from fastapi.testclient import TestClient
from server_clients import until

from tappet.server.runtimes.links import PlcClient, RuntimeLink

URL = "/api/v1/runtimes"


def test_state_start_stop(admin: TestClient, runtime_id: str, plc: FakePlc) -> None:
    state = admin.get(f"{URL}/{runtime_id}").json()
    assert (state["connected"], state["state"], state["application"]) == (True, "stop", "Application")
    assert (state["code_id"], state["data_id"], state["exception"]) == ("code1", "data1", None)
    assert admin.post(f"{URL}/{runtime_id}/start").json()["state"] == "run"
    assert admin.post(f"{URL}/{runtime_id}/stop").json()["state"] == "stop"
    actions = [e["action"] for e in admin.get("/api/v1/audit").json()]
    assert actions[:2] == ["stop", "start"]


def test_single_cycle(as_role: dict[str, TestClient], runtime_id: str, plc: FakePlc) -> None:
    """LST-84: of a stopped application only; noted in the audit log."""
    url = f"{URL}/{runtime_id}/single-cycle"
    assert as_role["viewer"].post(url).status_code == 403
    assert as_role["operator"].post(url).json()["state"] == "stop"
    assert plc.cycles == 1
    assert as_role["admin"].get("/api/v1/audit").json()[0]["action"] == "single-cycle"
    plc.state = "run"
    answer = as_role["operator"].post(url)
    assert (answer.status_code, "stopped" in answer.json()["detail"]) == (409, True)


def test_operator_starts_engineer_resets(as_role: dict[str, TestClient], runtime_id: str) -> None:
    assert as_role["operator"].post(f"{URL}/{runtime_id}/start").status_code == 200
    assert as_role["operator"].post(f"{URL}/{runtime_id}/reset", json={"kind": "cold"}).status_code == 403
    assert as_role["engineer"].post(f"{URL}/{runtime_id}/reset", json={"kind": "cold"}).status_code == 200
    assert as_role["engineer"].post(f"{URL}/{runtime_id}/reset", json={"kind": "hot"}).status_code == 422


def test_exception_is_told_with_place(admin: TestClient, runtime_id: str, plc: FakePlc) -> None:
    plc.state, plc.report = "exception", division_by_zero()
    plc.notify("exception")
    until(lambda: admin.get(f"{URL}/{runtime_id}").json()["state"] == "exception")
    report = admin.get(f"{URL}/{runtime_id}").json()["exception"]
    assert (report["task"], report["pou"], report["line"]) == ("MainTask", "FB_Motor", 4)
    assert (report["object_id"], report["part"], report["element"]) == ("motor", "implementation", None)
    assert admin.get(f"{URL}/{runtime_id}/exception").json() == report
    stack = [
        (frame["pou"], frame["uri"], frame["object_id"], frame["line"]) for frame in report["call_stack"]
    ]
    assert stack == [("FB_Motor", "FB_Motor", "motor", 4), ("TON", "Standard/TON", None, 7)]
    refused = admin.post(f"{URL}/{runtime_id}/start")
    assert refused.status_code == 409
    assert "reset" in refused.json()["detail"]


def test_tasks(admin: TestClient, runtime_id: str) -> None:
    task = admin.get(f"{URL}/{runtime_id}/tasks").json()[0]
    assert (task["name"], task["interval_us"], task["max_us"]) == ("MainTask", 10000.0, 2.0)
    assert admin.post(f"{URL}/{runtime_id}/tasks/MainTask/reset").status_code == 204
    wrong = admin.post(f"{URL}/{runtime_id}/tasks/Main/reset")
    assert wrong.status_code == 404
    assert "MainTask" in wrong.json()["detail"]


def test_lost_runtime_says_since_when_and_comes_back(
    admin: TestClient, runtime_id: str, plc: FakePlc
) -> None:
    plc.lose()
    until(lambda: not admin.get(f"{URL}/{runtime_id}").json()["connected"])
    state = admin.get(f"{URL}/{runtime_id}").json()
    assert state["since"]
    assert state["application"] == "Application", "the last known facts stay"
    answer = admin.post(f"{URL}/{runtime_id}/values/read", json={"expressions": ["PLC_PRG.nCount"]})
    assert answer.status_code == 503
    assert "since" in answer.json()
    plc.down = False
    until(lambda: admin.get(f"{URL}/{runtime_id}").json()["connected"])


def test_add_and_remove(admin: TestClient, runtime_id: str) -> None:
    body = {"name": "test stand", "url": "ws://plc:11740", "token": "t"}
    assert admin.post(URL, json=body).status_code == 409, "the name is taken"
    assert admin.post(URL, json={**body, "name": "b", "url": "http://plc"}).status_code == 422
    assert admin.post(URL, json={**body, "name": "b", "url": "ws://plc:1/?token=x"}).status_code == 422
    added = admin.post(URL, json={**body, "name": "b"}).json()
    assert "token" not in added
    assert [r["name"] for r in admin.get(URL).json()] == ["test stand", "b"]
    assert admin.delete(f"{URL}/{added['id']}").status_code == 204
    assert admin.get(f"{URL}/{added['id']}").status_code == 404
    assert [e["action"] for e in admin.get("/api/v1/audit").json()][:1] == ["runtime-removed"]


def test_log(admin: TestClient, runtime_id: str) -> None:
    log = admin.get(f"{URL}/{runtime_id}/log", params={"since": 1}).json()
    assert [(e["id"], e["message"], e["at"][:10]) for e in log] == [
        (2, "entry 2", "2023-11-14"),
        (3, "division by zero, line 7", "2023-11-14"),
    ]


def test_metrics(admin: TestClient, runtime_id: str) -> None:
    answer = admin.get("/api/v1/metrics")
    assert answer.headers["content-type"].startswith("text/plain")
    assert 'tappet_runtime_connected{runtime="test stand"} 1' in answer.text
    assert 'tappet_task_cycles_total{runtime="test stand",task="MainTask"} 7' in answer.text
    assert 'tappet_http_requests_total{method="POST",status="201"}' in answer.text
    for line in answer.text.splitlines():
        assert line.startswith("# ") or len(line.rsplit(" ", 1)) == 2


async def test_a_connection_that_fails_while_it_is_given_up_does_not_go_on() -> None:
    answer: asyncio.Future[PlcClient] = asyncio.get_running_loop().create_future()
    asked = asyncio.Event()

    async def connect(url: str, token: str) -> PlcClient:
        asked.set()
        return await answer

    link = RuntimeLink("1", "test stand", "ws://127.0.0.1:1", "token", connect, 0.01)
    link.start()
    await asked.wait()
    answer.set_exception(ConnectionRefusedError("nobody there"))
    done, _ = await asyncio.wait({asyncio.create_task(link.close())}, timeout=10)
    assert done
