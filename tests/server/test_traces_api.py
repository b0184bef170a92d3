"""Traces over REST with a real runtime: download, windows, recordings, files."""

from __future__ import annotations

import csv
import io
import sys
from collections.abc import Iterator
from dataclasses import replace
from datetime import UTC, datetime, timedelta
from pathlib import Path
from typing import Any

import numpy as np
import pyarrow.parquet as pq
import pytest
from fastapi import FastAPI
from fastapi.testclient import TestClient
from server_clients import CHEAP, RUNTIME, connected, first_account, real_app, serving, until

from tappet.server.settings import LOCAL_RUNTIME, ServerSettings
from tappet.traces.formats import write_trace
from tappet.traces.recording import ChannelInfo, RecordInfo
from tappet.traces.samples import Batch, BatchSamples

sys.path.insert(0, str(Path(__file__).parents[1] / "traces"))
from sampled_batches import read_window

TRACES = f"{RUNTIME}/traces"
RECORDINGS = "/api/v1/recordings"
DECLARATION = """PROGRAM PLC_PRG
VAR
    s : DINT; twice : LINT; odd : BOOL; d : DINT := 1; p : POINTER TO DINT;
END_VAR"""
BODY = "s := s + d;\ntwice := 2 * s;\nodd := s MOD 2 = 1;\np := ADR(s);"
DATA = {
    "records": [
        {
            "buffer": 100,
            "channels": [
                {"variable": "PLC_PRG.s", "name": "s"},
                {"formula": "s * 2", "name": "f"},
                {"variable": "PLC_PRG.twice"},
                {"variable": "PLC_PRG.odd"},
                {"variable": "PLC_PRG.p^ / 2.0"},
            ],
        }
    ]
}


@pytest.fixture(scope="module")
def traced_app(tmp_path_factory: pytest.TempPathFactory) -> Iterator[FastAPI]:
    settings = ServerSettings(data_dir=tmp_path_factory.mktemp("data"), password_cost=CHEAP)
    app = real_app(settings)
    with serving(app):
        yield app


@pytest.fixture(scope="module")
def logged_in(traced_app: FastAPI) -> TestClient:
    return connected(traced_app)


def _save(app: FastAPI, project_id: str, body: str) -> None:
    store = app.state.services.store
    item = next(o for o in store.load(project_id).objects.values() if o.name == "PLC_PRG")
    store.save(
        project_id, item.id, item.revision, {"declaration": DECLARATION, "implementation": body}, "ann"
    )


@pytest.fixture(scope="module")
def project(traced_app: FastAPI, logged_in: TestClient) -> tuple[str, str]:
    """A running application whose task counts; id of the project, URL of the application."""
    store = traced_app.state.services.store
    info = store.create_project("Traced", "ann")
    application = store.load(info.id).applications()[0]
    _save(traced_app, info.id, BODY)
    return info.id, f"/api/v1/projects/{info.id}/applications/{application.id}"


@pytest.fixture
def client(traced_app: FastAPI, logged_in: TestClient, project: tuple[str, str]) -> TestClient:
    """The application runs as it is in `BODY`, without a trace."""
    _save(traced_app, project[0], BODY)
    order = {"runtime_id": LOCAL_RUNTIME, "mode": "download", "start": True}
    answer = logged_in.post(f"{project[1]}/download", json=order)
    assert answer.status_code == 200, answer.text
    return logged_in


def _download(client: TestClient, data: dict[str, Any] = DATA, name: str = "Trace", **more: Any) -> Any:
    answer = client.put(f"{TRACES}/{name}", json={"data": data, **more})
    assert answer.status_code == 200, answer.text
    return answer.json()


def _state(client: TestClient) -> Any:
    return client.get(f"{TRACES}/Trace").json()


def _window(client: TestClient, url: str = f"{TRACES}/Trace", **query: Any) -> dict[str, Any]:
    answer = client.get(f"{url}/window", params=query)
    assert answer.status_code == 200, answer.text
    return read_window(answer.content)


def test_a_trace_runs_and_everybody_sees_the_same(client: TestClient) -> None:
    """TRC-02, TRC-04, TRC-70 .. TRC-75."""
    state = _download(client)
    assert (state["name"], state["application"], state["running"]) == ("Trace", "Application", True)
    assert state["downloaded_by"] == "ann"
    channels = state["records"][0]["channels"]
    assert [(c["index"], c["type"]) for c in channels] == [
        (0, "DINT"),
        (2, "LINT"),
        (3, "BOOL"),
        (4, "LREAL"),
    ]
    until(lambda: _state(client)["records"][0]["samples"] > 120)
    found = _window(client)
    s, twice, odd, half = found["values"]
    assert found["count"] == 100
    assert np.diff(s).tolist() == [1.0] * 99
    assert (twice == 2 * s).all()
    assert (odd == s % 2).all()
    assert (half == s / 2).all()
    assert found["gap"].tolist() == [0] * 100
    only = _window(client, channels="1", width=10)
    assert [c["index"] for c in only["channels"]] == [2]
    assert only["step"] > 1
    assert [t["name"] for t in client.get(TRACES).json()] == ["Trace"]
    assert client.get(f"{TRACES}/trace/configuration").json()["data"]["records"][0]["buffer"] == 100
    raw = client.get(f"{TRACES}/Trace/samples", params={"first": found["first"], "count": 5})
    assert read_window(raw.content)["count"] <= 5


def test_a_window_of_time_has_its_neighbours(client: TestClient) -> None:
    _download(client)
    until(lambda: _state(client)["records"][0]["samples"] > 60)
    client.post(f"{TRACES}/Trace/stop")
    whole = _window(client)
    origin = int(whole["origin_ns"])
    times = [origin + round(t * 1e9) for t in whole["time"]]
    part = _window(client, **{"from": times[10], "to": times[20]})
    assert part["first"] - whole["first"] == 9
    assert int(part["origin_ns"]) == times[9]
    assert part["count"] == 12
    statistics = client.get(
        f"{TRACES}/Trace/statistics", params={"channel": 0, "from": times[10], "to": times[20]}
    ).json()
    values = whole["values"][0][10:21]
    assert (statistics["count"], statistics["minimum"], statistics["maximum"]) == (
        11,
        values.min(),
        values.max(),
    )
    assert statistics["mean"] == pytest.approx(values.mean())
    slope = client.get(f"{TRACES}/Trace/derived", params={"channel": 0, "operation": "derivative"})
    distances = np.diff(whole["time"])
    assert read_window(slope.content)["values"][0][1:] == pytest.approx(
        np.diff(whole["values"][0]) / distances
    )
    spectrum = client.get(f"{TRACES}/Trace/spectrum", params={"channel": 2, "window": "rectangular"}).json()
    assert spectrum["sample_hz"] == pytest.approx(1e9 / _state(client)["records"][0]["interval_ns"])


def test_trigger_stop_start_and_reset(client: TestClient) -> None:
    """TRC-74, TRC-82."""
    record = DATA["records"][0]
    trigger = {"variable": "PLC_PRG.s MOD 200", "edge": "positive", "level": "150", "position": 25}
    _download(client, {"records": [{**record, "trigger": trigger}]})
    until(lambda: _state(client)["records"][0]["state"] == "done")
    state = _state(client)["records"][0]
    assert state["trigger"]["percent"] == 100
    found = _window(client)
    assert found["trigger_ns"] == state["trigger"]["at_ns"]
    assert [v % 200 for v in found["values"][0]][-26:] == list(range(150, 176))
    assert client.post(f"{TRACES}/Trace/reset-trigger").json()["records"][0]["state"] == "waiting"
    assert client.post(f"{TRACES}/Trace/stop").json()["running"] is False
    assert client.post(f"{TRACES}/Trace/start").json()["records"][0]["state"] == "waiting"
    assert client.delete(f"{TRACES}/Trace").status_code == 204
    assert client.get(f"{TRACES}/Trace").status_code == 404
    assert client.post(f"{TRACES}/Trace/start").status_code == 404


def test_a_digest_tells_whether_a_download_is_needed(client: TestClient) -> None:
    """trace EX-07."""

    def digest(data: dict[str, Any]) -> str:
        return client.post("/api/v1/traces/digest", json={"data": data}).json()["digest"]

    record = DATA["records"][0]
    first, *others = record["channels"]
    state = _download(client)
    assert digest(DATA) == state["data_digest"]
    assert (
        digest({"records": [{**record, "channels": [{**first, "color": "#00ff00"}, *others]}]})
        == state["data_digest"]
    )
    assert digest({"records": [{**record, "channels": [first]}]}) != state["data_digest"]


def test_a_changed_application_ends_the_trace(
    traced_app: FastAPI, client: TestClient, project: tuple[str, str]
) -> None:
    """TRC-70."""
    _download(client)
    _save(traced_app, project[0], BODY.replace("2 * s", "3 * s"))
    order = {"runtime_id": LOCAL_RUNTIME, "mode": "online_change"}
    assert client.post(f"{project[1]}/download", json=order).status_code == 200
    answer = client.get(f"{TRACES}/Trace")
    assert (answer.status_code, answer.json()["type"]) == (404, "urn:tappet:problem:not-found")
    assert client.get(TRACES).json() == []


def test_wrong_settings_are_told_by_place(client: TestClient) -> None:
    data = {
        "records": [
            {"condition": "PLC_PRG.s >", "channels": [{"variable": "PLC_PRG.s"}, {"variable": "PLC_PRG.x"}]}
        ]
    }
    answer = client.put(f"{TRACES}/Trace", json={"data": data}, headers={"Accept-Language": "zh"})
    assert (answer.status_code, answer.json()["type"]) == (422, "urn:tappet:problem:trace-invalid")
    places = [(p["record"], p["channel"], p["field"]) for p in answer.json()["problems"]]
    assert places == [(0, None, "condition"), (0, 1, "variable")]
    assert "没有" in answer.json()["problems"][1]["message"]
    assert client.put(f"{TRACES}/Trace", json={"data": {"records": [{"buffer": 0}]}}).status_code == 422


def test_long_term_recording_keeps_every_sample(client: TestClient) -> None:
    _download(client)
    begun = client.post(f"{TRACES}/Trace/recording", json={"title": "Run 1"})
    assert begun.status_code == 201, begun.text
    assert begun.json()["state"] == "recording"
    url = f"{RECORDINGS}/{begun.json()['id']}"
    again = client.post(f"{TRACES}/Trace/recording", json={})
    assert again.json()["type"] == "urn:tappet:problem:still-recording"
    assert client.delete(url).status_code == 409
    until(lambda: client.get(url).json()["records"][0]["samples"] > 250)
    assert _state(client)["recording"]["title"] == "Run 1"
    ended = client.delete(f"{TRACES}/Trace/recording").json()
    assert (ended["state"], ended["lost"], ended["problem"]) == ("complete", 0, None)
    assert client.delete(f"{TRACES}/Trace/recording").status_code == 404
    count = ended["records"][0]["samples"]
    raw = read_window(client.get(f"{url}/samples", params={"count": 1_000_000}).content)
    assert raw["count"] == count
    assert np.diff(raw["values"][0]).tolist() == [1.0] * (count - 1), "no sample is missing"
    assert raw["gap"].tolist() == [0] * count
    small = _window(client, url, width=50)
    assert small["low"][0][0] == raw["values"][0][0]
    assert small["high"][0][-1] == raw["values"][0][-1]
    timed = client.post(f"{TRACES}/Trace/recording", json={"seconds": 1}).json()
    until(lambda: client.get(f"{RECORDINGS}/{timed['id']}").json()["state"] == "complete")


def test_a_recording_with_a_limit_keeps_the_newest_samples(client: TestClient) -> None:
    _download(client)
    order = {"title": "Ring", "keep_mib": 1, "keep_seconds": 3600}
    begun = client.post(f"{TRACES}/Trace/recording", json=order).json()
    assert (begun["keep_bytes"], begun["keep_seconds"], begun["dropped"]) == (1 << 20, 3600, 0)
    refused = client.post(f"{TRACES}/Trace/recording", json={"keep_seconds": 0})
    assert refused.status_code == 422
    client.delete(f"{TRACES}/Trace/recording")
    url = f"{RECORDINGS}/{begun['id']}"
    assert client.get(url).json()["state"] == "complete"
    assert client.delete(url).status_code == 204


def test_lists_of_recordings_are_filtered(client: TestClient) -> None:
    _download(client)
    until(lambda: _state(client)["records"][0]["samples"] > 20)
    stored = client.post(f"{TRACES}/Trace/snapshot", json={"title": "Filtered"}).json()

    def listed(**query: str) -> bool:
        found = client.get(RECORDINGS, params=query).json()["recordings"]
        return stored["id"] in [one["id"] for one in found]

    assert listed()
    assert listed(trace="trace", runtime_id=LOCAL_RUNTIME)
    assert not listed(trace="Other")
    assert not listed(runtime_id="other")
    assert listed(**{"from": "2020-01-01T00:00:00Z"})
    assert not listed(to="2020-01-01T00:00:00Z")
    assert client.get(RECORDINGS, params={"from": "yesterday"}).status_code == 422
    assert client.delete(f"{RECORDINGS}/{stored['id']}").status_code == 204


def test_a_recording_ends_with_its_trace(client: TestClient) -> None:
    _download(client)
    begun = client.post(f"{TRACES}/Trace/recording", json={}).json()
    client.delete(f"{TRACES}/Trace")
    until(lambda: client.get(f"{RECORDINGS}/{begun['id']}").json()["state"] == "interrupted")
    found = client.get(f"{RECORDINGS}/{begun['id']}").json()
    assert found["problem"] == "The trace was ended, or downloaded again."
    assert found["title"] == "Trace"


def test_files_and_stored_recordings(client: TestClient, tmp_path: Path, project: tuple[str, str]) -> None:
    """TRC-90, TRC-91: what is saved is loaded again as it was."""
    _download(client)
    until(lambda: _state(client)["records"][0]["samples"] > 120)
    client.post(f"{TRACES}/Trace/stop")
    shown = _window(client)
    stored = client.post(f"{TRACES}/Trace/snapshot", json={"title": "A", "project_id": project[0]}).json()
    url = f"{RECORDINGS}/{stored['id']}"
    assert client.get(url).json()["data"]["records"][0]["channels"][1]["formula"] == "s * 2"
    for place in (f"{TRACES}/Trace", url):
        text = client.get(f"{place}/export", params={"format": "csv"})
        assert text.headers["content-disposition"].endswith('.csv"')
        rows = list(csv.reader(io.StringIO(text.text)))
        assert rows[0] == [
            "time_ns",
            "cycle",
            "PLC_PRG.s",
            "PLC_PRG.twice",
            "PLC_PRG.odd",
            "PLC_PRG.p^ / 2.0",
            "f",
        ]
        assert [float(row[6]) for row in rows[1:]] == [2 * int(row[2]) for row in rows[1:]]
        assert [int(row[2]) for row in rows[1:]] == shown["values"][0].tolist()
        (tmp_path / "a.parquet").write_bytes(
            client.get(f"{place}/export", params={"format": "parquet"}).content
        )
        assert pq.read_table(tmp_path / "a.parquet")["PLC_PRG.s"].to_pylist() == shown["values"][0].tolist()
        saved = client.get(f"{place}/export", params={"format": "trace"}).content
        query = {"title": "Loaded", "project_id": project[0]}
        loaded = client.post(RECORDINGS, params=query, content=saved)
        assert loaded.status_code == 201, loaded.text
        again = _window(client, f"{RECORDINGS}/{loaded.json()['id']}")
        assert again["values"][0].tolist() == shown["values"][0].tolist()
        assert again["start_ns"] == shown["start_ns"]
    listed = client.get(RECORDINGS, params={"project_id": project[0]}).json()
    assert [r["title"] for r in listed["recordings"]] == ["Loaded", "Loaded", "A"]
    assert listed["used_bytes"] >= sum(r["bytes"] for r in listed["recordings"]) > 0
    changed = client.patch(url, json={"title": "B", "comment": "good"}).json()
    assert (changed["title"], changed["comment"]) == ("B", "good")
    assert client.delete(url).status_code == 204
    assert client.get(f"{url}/window").status_code == 404
    bad = client.post(RECORDINGS, content=b"no trace")
    assert bad.json()["type"] == "urn:tappet:problem:trace-file-invalid"


def test_the_server_deletes_recordings_that_are_too_old(tmp_path: Path) -> None:
    """By itself after its start, and the audit log says so."""
    kept = ServerSettings(data_dir=tmp_path, password_cost=CHEAP)
    with serving(app := real_app(kept)):
        store = app.state.services.traces.store
        for title, days in (("Old", 8), ("Young", 6)):
            ended = datetime.now(UTC) - timedelta(days)
            store.create(
                title=title, comment="", trace="T", application="A", runtime_id=None, runtime="",
                project_id=None, started_by="ann", settings={"records": []}, records=[], ended_at=ended,
            )  # fmt: skip
    with serving(app := real_app(replace(kept, recordings_keep=timedelta(7)))):
        client = first_account(app)
        until(lambda: len(client.get(RECORDINGS).json()["recordings"]) == 1)
        listed = client.get(RECORDINGS).json()
        assert (listed["recordings"][0]["title"], listed["keep_days"]) == ("Young", 7)
        asked = {"action": "recording-deleted"}
        until(lambda: client.get("/api/v1/audit", params=asked).json())
        (row,) = client.get("/api/v1/audit", params=asked).json()
        assert (row["username"], row["subject"], row["result"]) == ("(server)", "Old", "ok")


def test_an_export_names_the_formulas_that_have_no_values(
    client: TestClient, project: tuple[str, str]
) -> None:
    """Of a running trace and of a stored recording; without formulas the recorded variables can be had."""
    channels = [
        {"variable": "PLC_PRG.s", "name": "s"},
        {"formula": "s * 2", "name": "good"},
        {"formula": "s + FOO(1)", "name": "wrong"},
        {"formula": "s - gone", "name": "lost"},
    ]
    data = {"records": [{"name": "Fast", "channels": channels}]}
    assert client.put(f"{TRACES}/Broken", json={"data": data}).status_code == 200
    until(lambda: client.get(f"{TRACES}/Broken").json()["records"][0]["samples"] > 3)
    stored = client.post(f"{TRACES}/Broken/snapshot", json={"project_id": project[0]}).json()
    for place in (f"{TRACES}/Broken", f"{RECORDINGS}/{stored['id']}"):
        for form in ("csv", "parquet"):
            refused = client.get(f"{place}/export", params={"format": form})
            assert refused.status_code == 422
            found = refused.json()
            assert found["type"] == "urn:tappet:problem:formula-invalid"
            assert found["detail"].startswith("The formula 'wrong' of the record 'Fast' has no values: ")
            told = [(p["record"], p["channel"], p["field"], p["message"]) for p in found["problems"]]
            assert told[0][:3] == (0, 2, "formula")
            assert told[0][3].startswith("there is no function 'FOO' (at 5); there are ABS, SQRT")
            assert told[1:] == [
                (0, 3, "formula", "no recorded variable is called 'gone' (at 5); there are: s")
            ]
        text = client.get(f"{place}/export", params={"format": "csv", "formulas": "false"}).text
        assert next(csv.reader(io.StringIO(text))) == ["time_ns", "cycle", "PLC_PRG.s"]
        assert client.get(f"{place}/export", params={"format": "trace"}).status_code == 200
    chinese = {"Accept-Language": "zh"}
    said = client.get(f"{TRACES}/Broken/export", params={"format": "csv"}, headers=chinese).json()
    assert said["problems"][1]["message"] == "没有名为“gone”的已记录变量（位置 5）；现有：s"
    client.delete(f"{TRACES}/Broken")
    client.delete(f"{RECORDINGS}/{stored['id']}")


def test_a_file_may_be_larger_than_other_requests(client: TestClient, tmp_path: Path) -> None:
    count = 1_200_000
    values = np.random.default_rng(1).normal(size=count)
    cycle = np.arange(count)
    channels = [ChannelInfo(0, "v", "LREAL", "f8")]
    long = BatchSamples(channels, Batch(cycle, cycle * 1_000_000, np.zeros(count, np.uint8), [values]))
    info = RecordInfo("Record1", "Main", 1_000_000, 1, channels)
    write_trace(tmp_path / "a.trace", "Long", "App", DATA, [(info, long)])
    data = (tmp_path / "a.trace").read_bytes()
    assert len(data) > traced_limit(client)
    loaded = client.post(RECORDINGS, content=data)
    assert loaded.status_code == 201, loaded.text
    url = f"{RECORDINGS}/{loaded.json()['id']}"
    found = _window(client, url, width=100)
    assert max(found["high"][0]) == values.max()
    assert client.delete(url).status_code == 204


def traced_limit(client: TestClient) -> int:
    limit: int = client.app.state.services.settings.max_body_bytes  # type: ignore[attr-defined]
    return limit


def test_the_quota_is_kept(traced_app: FastAPI, client: TestClient) -> None:
    store = traced_app.state.services.traces.store
    _download(client)
    before, store.quota_bytes = store.quota_bytes, 0
    try:
        answer = client.post(f"{TRACES}/Trace/snapshot", json={})
        assert (answer.status_code, answer.json()["type"]) == (507, "urn:tappet:problem:recordings-full")
    finally:
        store.quota_bytes = before


def test_the_device_trace_of_an_axis(client: TestClient) -> None:
    found = client.get("/api/v1/traces/axis-template", params={"axis": "Drive"}).json()["channels"]
    assert found[0]["variable"] == "Drive.fSetPosition"
    assert found[-1]["variable"] == "Drive.fSetPosition - Drive.fActPosition"
