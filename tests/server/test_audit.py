"""Nothing happens unaudited: acts are stored before they are done, refusals too, or nothing is done."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager, suppress
from datetime import UTC, datetime
from typing import Any

import pytest
from fake_plc import FakePlc
from fastapi import FastAPI
from fastapi.dependencies.models import Dependant
from fastapi.routing import RouteContext, iter_route_contexts
from fastapi.testclient import TestClient
from sqlalchemy import event, insert
from sqlalchemy.exc import OperationalError

from tappet.server import audit, tables
from tappet.server.audited import Audited
from tappet.server.auth.origin import SAFE_METHODS
from tappet.server.services import Services

API = "/api/v1"
READS = "answers a question that is too long for an address"
HISTORY = "is a revision of the project with its author, stored in the same transaction"
LOGIN = "is recorded by `login`, in the transaction of the new session"
OWN = "is a setting of one's own screen"
EXEMPT = {
    "read_values": READS,
    "read_flight": READS,
    "digest_trace": READS,
    "compare_version": READS,
    "open_recording": READS,
    "replay_recording": READS,
    "save_recording": HISTORY,
    "upload_recording": HISTORY,
    "preview_files": READS,
    "compare_import": READS,
    "build": READS,
    "rebuild": READS,
    "run_static_analysis": READS,
    "run_tests": READS,
    "search": READS,
    "draw_cam": READS,
    "write_cam_text": READS,
    "read_cam_text": READS,
    "optimise_cam": READS,
    "show_cam_code": READS,
    "read_running_cam": READS,
    "cancel_build": "ends a question",
    "keep_axis": "the heartbeat of control over an axis, which was recorded when it was taken",
    "cancel_tests": "ends a question",
    "log_in": READS,
    "log_out": "changes nothing: there is nothing kept of a login to a runtime",
    "open_view": READS,
    "show_past_cycle": READS,
    "flight_renew": "says that who has frozen the recorder is still there, which was recorded then",
    "login": LOGIN,
    "create_first_account": LOGIN,
    "write_setting": OWN,
    "create_object": HISTORY,
    "save_objects": HISTORY,
    "save_object": HISTORY,
    "move_object": HISTORY,
    "copy_object": HISTORY,
    "delete_object": HISTORY,
    "delete_objects": HISTORY,
    "revert_object": HISTORY,
    "replace": HISTORY,
    "undo_change": HISTORY,
    "undo_step": HISTORY,
    "redo_step": HISTORY,
    "add_instance_paths": HISTORY,
    "read_recipe": HISTORY,
    "import_recipe": HISTORY,
    "compare_recipes": READS,
    "parse_recipe_file": READS,
    "open_comparison": READS,
    "open_comparison_with_files": READS,
    "close_comparison": "ends a question",
    "cnc_info": READS,
    "cnc_code": READS,
    "begin_path_view": "a view of its own, of what is read",
    "draw_path": READS,
    "draw_in_another_way": READS,
    "choose_line": READS,
    "pick_element": READS,
    "end_path_view": "ends a question",
}
"""Routes with a method that may change something, and why they are in the audit log only when refused."""


def _calls(dependant: Dependant) -> Iterator[Any]:
    yield dependant.call
    for inner in dependant.dependencies:
        yield from _calls(inner)


def _changing(app: FastAPI) -> Iterator[RouteContext]:
    for context in iter_route_contexts(app.routes):
        if (context.path or "").startswith("/api/") and (context.methods or set()) - SAFE_METHODS:
            yield context


def test_every_route_that_changes_something_is_audited(app: FastAPI) -> None:
    changing = {
        str(c.name): any(isinstance(call, Audited) for call in _calls(c.dependant)) for c in _changing(app)
    }
    assert len(changing) > 30
    assert {name for name, audited in changing.items() if not audited} == set(EXEMPT)


def _entries(client: TestClient, **params: Any) -> list[dict[str, Any]]:
    answer = client.get(f"{API}/audit", params=params)
    assert answer.status_code == 200, answer.text
    entries: list[dict[str, Any]] = answer.json()
    return entries


def _write(client: TestClient, runtime_id: str, verb: str, name: str, value: object) -> Any:
    body = {"values": [{"expression": name, "value": value}]}
    return client.post(f"{API}/runtimes/{runtime_id}/values/{verb}", json=body)


def test_the_row_is_there_before_the_act(
    admin: TestClient, services: Services, runtime_id: str, plc: FakePlc, monkeypatch: pytest.MonkeyPatch
) -> None:
    seen: list[tuple[object, ...]] = []

    def start() -> None:
        row = services.database.read(lambda db: audit.read(db, 1, None, None))[0]
        seen.append((row["action"], row["subject"], row["result"]))

    monkeypatch.setattr(plc, "start", start)
    assert admin.post(f"{API}/runtimes/{runtime_id}/start").status_code == 200
    assert seen == [("start", "test stand", "begun")]
    assert _entries(admin)[0]["result"] == "ok"


def test_an_act_whose_result_cannot_be_stored_stays_begun(
    admin: TestClient, runtime_id: str, plc: FakePlc, monkeypatch: pytest.MonkeyPatch
) -> None:
    def fails(*_: Any, **__: Any) -> None:
        raise OperationalError("UPDATE audit", {}, Exception("no room"))

    monkeypatch.setattr(audit, "complete", fails)
    assert admin.post(f"{API}/runtimes/{runtime_id}/start").status_code == 200
    assert plc.state == "run"
    assert _entries(admin)[0]["result"] == "begun"


@contextmanager
def full_disk(services: Services) -> Iterator[None]:
    """The database may not grow, and has no room left in its pages."""
    engine = services.database.engine
    limit = services.database.read(lambda db: db.exec_driver_sql("PRAGMA page_count").scalar_one())

    def set_limit(connection: Any, *_: Any) -> None:
        connection.execute(f"PRAGMA max_page_count = {limit}")

    def filler(db: Any) -> None:
        who = {"at": datetime.now(UTC), "username": "-", "address": "-"}
        db.execute(insert(tables.audit).values(who | {"action": "filler", "subject": ""}))

    event.listen(engine, "checkout", set_limit)
    try:
        with suppress(OperationalError):
            while True:
                services.database.write(filler)
        yield
    finally:
        limit = 1 << 30


def test_on_a_full_disk_nothing_is_changed_and_everything_is_shown(
    admin: TestClient, services: Services, runtime_id: str, plc: FakePlc
) -> None:
    runtime = f"{API}/runtimes/{runtime_id}"
    project = admin.post(f"{API}/projects", json={"name": "Press"}).json()
    admin.post(f"{runtime}/start")
    calls: list[tuple[str, str, Any]] = [
        ("POST", f"{runtime}/start", None),
        ("POST", f"{runtime}/reset", {"kind": "cold"}),
        ("POST", f"{runtime}/values/write", {"values": [{"expression": "PLC_PRG.nCount", "value": 3}]}),
        ("POST", f"{runtime}/values/force", {"values": [{"expression": "PLC_PRG.nCount", "value": 3}]}),
        ("DELETE", runtime, None),
        ("POST", f"{API}/projects", {"name": "Second"}),
        ("PATCH", f"{API}/projects/{project['id']}", {"name": "Renamed"}),
        ("DELETE", f"{API}/projects/{project['id']}", None),
        ("POST", f"{API}/users", {"username": "b", "password": "correct horse", "role": "viewer"}),
        ("POST", f"{API}/auth/tokens", {"name": "t", "role": "viewer"}),
    ]
    image = bytes(plc.image)
    with full_disk(services):
        for method, url, body in calls:
            answer = admin.request(method, url, json=body)
            problem = answer.json()
            assert (answer.status_code, problem["type"]) == (507, "urn:tappet:problem:disk-full"), (
                url,
                problem,
            )
            assert "disk is full" in problem["detail"]
        assert (plc.state, bytes(plc.image), plc.forced) == ("run", image, {})
        assert admin.get(runtime).json()["state"] == "run"
        assert [p["name"] for p in admin.get(f"{API}/projects").json()] == ["Press"]
        assert [u["username"] for u in admin.get(f"{API}/users").json()] == ["admin"]
        assert admin.get(f"{API}/projects/{project['id']}/export").status_code == 200
        assert admin.post(f"{runtime}/stop").json()["state"] == "stop", "a machine can be stopped at any time"
        assert _entries(admin, action="stop") == []
    assert [e["action"] for e in _entries(admin, action="stop")] == ["stop"]


def test_refusals_are_rows(
    admin: TestClient, as_role: dict[str, TestClient], runtime_id: str, plc: FakePlc
) -> None:
    runtime = f"{API}/runtimes/{runtime_id}"
    assert as_role["viewer"].post(f"{runtime}/stop").status_code == 403
    right = _entries(admin)[0]
    assert (right["action"], right["result"], right["runtime_id"]) == ("stop", "refused", runtime_id)
    assert "needs the role 'operator'" in right["reason"]

    assert _write(as_role["viewer"], runtime_id, "force", "PLC_PRG.nCount", 12).status_code == 403
    assert '"PLC_PRG.nCount"' in _entries(admin)[0]["new_value"]
    assert "12" in _entries(admin)[0]["new_value"]

    plc.state = "run"
    assert admin.post(f"{runtime}/single-cycle").status_code == 409
    state = _entries(admin)[0]
    assert (state["action"], state["result"]) == ("single-cycle", "refused")
    assert "stopped" in state["reason"]

    assert _write(admin, runtime_id, "write", "PLC_PRG.nLimit", 1).status_code == 422
    assert "PLC_PRG.nLimit" in _entries(admin)[0]["reason"]

    project = admin.post(f"{API}/projects", json={"name": "Press"}).json()["id"]
    body = {"parent_id": None, "kind": "folder", "name": "x"}
    refused = as_role["operator"].post(f"{API}/projects/{project}/objects", json=body)
    assert refused.status_code == 403
    entry = _entries(admin)[0]
    assert (entry["action"], entry["subject"]) == ("no-right", f"POST {API}/projects/{project}/objects")


def test_what_is_no_request_is_no_act(admin: TestClient, runtime_id: str) -> None:
    before = _entries(admin)[0]["id"]
    assert admin.post(f"{API}/runtimes/{runtime_id}/reset", json={"kind": "hot"}).status_code == 422
    assert admin.post(f"{API}/projects", json={"nam": 1}).status_code == 422
    assert _entries(admin)[0]["id"] == before


def test_equal_refusals_are_counted_on_one_row(
    admin: TestClient, as_role: dict[str, TestClient], runtime_id: str
) -> None:
    before = _entries(admin)[0]["id"]
    for _ in range(50):
        as_role["viewer"].post(f"{API}/runtimes/{runtime_id}/stop")
    as_role["viewer"].post(f"{API}/runtimes/{runtime_id}/start")
    start, stop, *_ = _entries(admin)
    assert (stop["action"], stop["count"], start["action"], start["count"]) == ("stop", 50, "start", 1)
    assert stop["id"] == before + 1
    assert stop["last_at"] > stop["at"]


def test_a_released_force_says_which_value(admin: TestClient, runtime_id: str) -> None:
    _write(admin, runtime_id, "force", "PLC_PRG.nCount", 12)
    admin.post(f"{API}/runtimes/{runtime_id}/values/unforce", json={"expressions": None})
    entry = _entries(admin)[0]
    assert (entry["action"], entry["subject"], entry["old_value"]) == ("unforce", "PLC_PRG.nCount", "12")
    assert (entry["new_value"], entry["result"]) == (None, "ok")


def test_statistics_are_reset_by_name(admin: TestClient, runtime_id: str) -> None:
    assert admin.post(f"{API}/runtimes/{runtime_id}/tasks/MainTask/reset").status_code == 204
    entry = _entries(admin)[0]
    assert (entry["action"], entry["subject"]) == ("statistics-reset", "MainTask")


def test_a_lost_runtime_is_a_failed_act(admin: TestClient, runtime_id: str, plc: FakePlc) -> None:
    plc.down = True  # noticed by the call itself
    assert admin.post(f"{API}/runtimes/{runtime_id}/stop").status_code == 503
    entry = _entries(admin)[0]
    assert (entry["action"], entry["result"]) == ("stop", "failed")
