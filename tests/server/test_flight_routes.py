"""The flight recorder over REST."""

from __future__ import annotations

import pytest
from fake_plc import FakePlc
from fastapi.testclient import TestClient


@pytest.fixture
def url(admin: TestClient, runtime_id: str) -> str:
    return f"/api/v1/runtimes/{runtime_id}/flight"


def _run(plc: FakePlc, cycles: int) -> None:
    for _ in range(cycles):
        plc.set("PLC_PRG.nCount", plc.cycle + 1)
        plc.run_cycle()


def test_state_cycles_and_past_values(admin: TestClient, url: str, plc: FakePlc) -> None:
    empty = admin.get(url).json()
    assert (empty["frozen"], empty["entries"]["count"], empty["entries"]["first_cycle"]) == (False, 0, None)
    _run(plc, 5)
    state = admin.get(url).json()
    assert (state["period"], state["parts"], state["frozen_by"]) == (1, 1, None)
    assert state["entries"] == {
        "count": 5,
        "first_cycle": 1,
        "first_timestamp": "1970-01-01T00:00:00.010000Z",
        "last_cycle": 5,
        "last_timestamp": "1970-01-01T00:00:00.050000Z",
    }
    assert [row["cycle"] for row in admin.get(f"{url}/cycles").json()] == [1, 2, 3, 4, 5]
    plc.forced[(2, None)] = b"\0\0"
    for cycle in (1, 4):
        order = {"cycle": cycle, "expressions": ["plc_prg.nCount", "PLC_PRG.nCout", "GVL.gCount"]}
        answer = admin.post(f"{url}/read", json=order)
        assert answer.status_code == 200, answer.text
        count, wrong, other = answer.json()["values"]
        assert (count["value"], count["literal"], count["forced"]) == (cycle, str(cycle), False)
        assert "Did you mean 'PLC_PRG.nCount'" in wrong["error"]
        assert other["value"] == 0


def test_a_cycle_that_is_not_kept_is_refused(admin: TestClient, url: str, plc: FakePlc) -> None:
    _run(plc, 2)
    answer = admin.post(f"{url}/read", json={"cycle": 9, "expressions": ["PLC_PRG.nCount"]})
    assert answer.status_code == 409
    assert "cycle 9 is not kept" in answer.json()["detail"]
    for wrong in (-1, 1 << 60, "x", None):
        order = {"cycle": wrong, "expressions": ["PLC_PRG.nCount"]}
        assert admin.post(f"{url}/read", json=order).status_code == 422


def test_freezing_is_audited_and_for_operators(
    admin: TestClient, as_role: dict[str, TestClient], url: str, plc: FakePlc
) -> None:
    _run(plc, 3)
    assert as_role["viewer"].post(f"{url}/freeze", json={"on": True}).status_code == 403
    assert not plc.frozen
    state = as_role["operator"].post(f"{url}/freeze", json={"on": True}).json()
    assert (state["frozen"], state["frozen_by"]) == (True, "request")
    _run(plc, 3)
    assert as_role["viewer"].get(url).json()["entries"]["last_cycle"] == 3
    assert as_role["operator"].post(f"{url}/freeze", json={"on": False}).json()["frozen"] is False
    actions = [entry["action"] for entry in admin.get("/api/v1/audit").json()]
    assert actions[:2] == ["flight-record", "flight-freeze"]


def test_a_page_renews_its_freeze_without_a_row_in_the_audit_log(
    admin: TestClient, as_role: dict[str, TestClient], url: str, plc: FakePlc
) -> None:
    _run(plc, 3)
    order = {"owner": "page 1", "lease_s": 60}
    assert as_role["operator"].post(f"{url}/renew", json=order).status_code == 409
    assert admin.post(f"{url}/freeze", json={"on": True, **order}).json()["frozen"] is True
    assert as_role["operator"].post(f"{url}/renew", json=order).status_code == 204
    assert as_role["viewer"].post(f"{url}/renew", json=order).status_code == 403
    actions = [entry["action"] for entry in admin.get("/api/v1/audit").json()]
    assert [action for action in actions if "flight" in action] == ["flight-freeze"]
    assert admin.post(f"{url}/freeze", json={"on": True, "lease_s": 0}).status_code == 422


def test_without_runtime(admin: TestClient, url: str, plc: FakePlc) -> None:
    assert admin.get("/api/v1/runtimes/nobody/flight").status_code == 404
    plc.lose()
    assert admin.get(url).status_code == 503
