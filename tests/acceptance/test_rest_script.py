"""A commissioning script over REST: from an empty project to a machine that is watched, changed, faulted."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import httpx
import pytest
from live_server import RUNTIME, Script, Station, station, until

COUNTER = (
    "FUNCTION_BLOCK FB_Counter\nVAR_INPUT\n    nStep : INT := 1;\nEND_VAR\n"
    "VAR_OUTPUT\n    nCount : DINT;\nEND_VAR"
)
PROGRAM = """PROGRAM PLC_PRG
VAR
    fbCounter : FB_Counter;
    nDivisor : DINT := 1;
    nQuotient : DINT;
    xLamp : BOOL;
    tDelay : TIME := T#250ms;
    sName : STRING(10) := 'idle';
    aLevel : ARRAY[1..3] OF REAL := [1.5, 2.5, 3.5];
    eMode : E_Mode;
    wBits : WORD;
END_VAR
VAR RETAIN
    nKept : DINT := 5;
END_VAR
VAR CONSTANT
    cLimit : INT := 9;
END_VAR"""
BODY = "fbCounter();\nnQuotient := Quotient(fbCounter.nCount, nDivisor);"
DIVIDE = "FUNCTION Quotient : DINT\nVAR_INPUT\n    nTotal : DINT;\n    nPart : DINT;\nEND_VAR"


@pytest.fixture(scope="module")
def plant(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Station]:
    folder: Path = tmp_path_factory.mktemp("script")
    with station(folder) as running:
        script = running.admin
        script.create_project("Commissioning")
        script.add("pou", "FB_Counter", subkind="function_block")
        script.add("pou", "Quotient", subkind="function")
        script.add("dut", "E_Mode", subkind="enum")
        script.save("E_Mode", declaration="TYPE E_Mode : (Idle, Filling := 4, Done);\nEND_TYPE")
        _write_program(script)
        yield running


def _write_program(script: Script) -> None:
    script.save("FB_Counter", declaration=COUNTER, implementation="nCount := nCount + nStep;")
    script.save("Quotient", declaration=DIVIDE, implementation="Quotient := nTotal / nPart;")
    script.save("PLC_PRG", declaration=PROGRAM, implementation=BODY)


@pytest.fixture
def script(plant: Station) -> Script:
    """The script with its application running, as it was written above."""
    script = plant.admin
    _write_program(script)
    script.post(f"{RUNTIME}/values/unforce", {"expressions": None}, 200 if _loaded(script) else 409)
    if script.relation() != "same" or script.state()["state"] != "run":
        script.download()
    script.wait_for_state("run")
    return script


def _loaded(script: Script) -> bool:
    return bool(script.state()["code_id"])


def test_a_stale_save_is_refused_with_both_versions(plant: Station) -> None:
    script = plant.admin
    path = f"{script.project}/objects/{script.ids['FB_Counter']}"
    read = script.get(path)
    mine = {**read["data"], "implementation": "nCount := nCount + nStep; // mine"}
    theirs = {**read["data"], "implementation": "nCount := nCount + nStep; // theirs"}
    saved = script.call("PUT", path, {"base_revision": read["revision"], "data": theirs})
    assert saved["revision"] > read["revision"]
    refused = script.call("PUT", path, {"base_revision": read["revision"], "data": mine}, 409)
    assert refused["type"] == "urn:tappet:problem:stale-revision"
    assert refused["current"]["data"]["implementation"].endswith("// theirs")
    assert refused["current"]["revision"] == saved["revision"]
    assert refused["yours"]["data"]["implementation"].endswith("// mine")
    assert refused["yours"]["base_revision"] == read["revision"]
    assert script.get(path) == saved, "a refused save writes nothing"
    both = script.call("PUT", path, {"base_revision": saved["revision"], "data": mine})
    assert both["data"]["implementation"].endswith("// mine")
    history = script.get(f"{path}/revisions")
    assert [entry["author"] for entry in history[:2]] == ["local", "local"]
    back = script.post(f"{path}/revert", {"revision": read["revision"]})
    assert back["data"] == read["data"]


def test_errors_of_a_build_name_object_part_and_line(script: Script) -> None:
    script.save("FB_Counter", implementation="nCount := nCount\n    + nStop;")
    report = script.build()
    assert report["ok"] is False
    (error,) = [d for d in report["diagnostics"] if d["severity"] == "error"]
    assert error["object_id"] == script.ids["FB_Counter"]
    assert error["object_path"].endswith("Application/FB_Counter")
    assert (error["part"], error["line"], error["column"]) == ("implementation", 2, 7)
    assert "nStop" in error["message"]
    assert "nStep" in error["message"] + (error["advice"] or "")
    refused = script.download(status=422)
    assert refused["diagnostics"][0]["object_id"] == script.ids["FB_Counter"]
    assert script.state()["state"] == "run", "a refused download leaves the machine running"

    bad = COUNTER.replace("DINT", "DIMT")
    script.save("FB_Counter", declaration=bad, implementation="nCount := nCount + nStep;")
    (error, *_) = [d for d in script.build()["diagnostics"] if d["severity"] == "error"]
    assert (error["part"], error["line"]) == ("declaration", 6)
    script.save("FB_Counter", declaration=COUNTER)
    assert script.build()["ok"] is True


def test_values_by_name_with_iec_literals(script: Script) -> None:
    lines = [
        ("PLC_PRG.xLamp", "TRUE", True, "TRUE"),
        ("PLC_PRG.tDelay", "T#1m2s", None, "T#1m2s"),
        ("PLC_PRG.sName", "'it$'s on'", "it's on", "'it$'s on'"),
        ("PLC_PRG.aLevel[2]", "1.25E1", 12.5, "12.5"),
        ("PLC_PRG.eMode", "Filling", None, "Filling"),
        ("plc_prg.WBITS", "16#8001", 0x8001, None),
        ("PLC_PRG.wBits.1", "TRUE", True, "TRUE"),
        ("PLC_PRG.fbCounter.nStep", "INT#3", 3, "3"),
    ]
    for path, text, value, literal in lines:
        answer = script.write(path, text)["values"][0]
        assert answer["error"] is None, answer
        if value is not None:
            assert answer["value"] == value, path
        if literal is not None:
            assert answer["literal"].rpartition(".")[2] == literal.rpartition(".")[2], path
    assert script.value("PLC_PRG.wBits") == 0x8003
    script.write("PLC_PRG.fbCounter.nStep", 1)


REFUSED = [
    ("PLC_PRG.nDivisor", "12x", "DINT"),
    ("PLC_PRG.nDivisor", "2147483648", "2147483647"),
    ("PLC_PRG.nDivisor", 1.5, "DINT"),
    ("PLC_PRG.nDivisor", None, "DINT"),
    ("PLC_PRG.xLamp", "T#1s", "TRUE"),
    ("PLC_PRG.tDelay", "soon", "T#"),
    ("PLC_PRG.sName", "'much too long a name'", "10"),
    ("PLC_PRG.eMode", "Filing", "Filling"),
    ("PLC_PRG.aLevel[4]", "1.0", "1..3"),
    ("PLC_PRG.nDivisr", "1", "nDivisor"),
    ("PLC_PRG.cLimit", "1", "constant"),
    ("Nothing.x", "1", "Nothing"),
    ("PLC_PRG.fbCounter", "1", "FB_Counter"),
    ("PLC_PRG.", "1", "PLC_PRG."),
    ("%QZ9", "1", "%QZ9"),
]
"""Path, value and what the answer must name."""


@pytest.mark.parametrize("action", ["write", "force"])
def test_bad_values_and_names_are_answered_clearly(script: Script, action: str) -> None:
    script.write("PLC_PRG.xLamp", "FALSE")
    good = {"expression": "PLC_PRG.xLamp", "value": "TRUE"}
    for path, value, says in REFUSED:
        body = {"values": [good, {"expression": path, "value": value}]}
        refused = script.post(f"{RUNTIME}/values/{action}", body, 422)
        assert [error["location"] for error in refused["errors"]] == [path]
        assert says in refused["detail"], refused["detail"]
    assert script.value("PLC_PRG.xLamp") is False, "all or none"
    assert script.get(f"{RUNTIME}/forces")["values"] == []


def test_reading_an_unknown_name_does_not_hide_the_others(script: Script) -> None:
    expressions = ["PLC_PRG.nDivisor", "PLC_PRG.nDivisr", "PLC_PRG.aLevel[0]", "PLC_PRG.sName"]
    first, unknown, outside, last = script.post(f"{RUNTIME}/values/read", {"expressions": expressions})[
        "values"
    ]
    assert (first["value"], first["type"]) == (1, "DINT")
    assert "nDivisor" in unknown["error"]
    assert "1..3" in outside["error"]
    assert last["value"] is not None


def test_forces_hold_until_they_are_released(script: Script) -> None:
    forces = script.force("PLC_PRG.fbCounter.nCount", "DINT#-7")["values"]
    assert [(f["expression"].upper(), f["literal"]) for f in forces] == [("PLC_PRG.FBCOUNTER.NCOUNT", "-7")]
    until(lambda: script.value("PLC_PRG.nQuotient") in (-7, -6), "the forced count in the program")
    read = script.post(f"{RUNTIME}/values/read", {"expressions": ["PLC_PRG.fbCounter.nCount"]})
    assert read["values"][0]["forced"] is True
    assert script.get(f"{RUNTIME}/forces")["values"] == forces
    release = {"expressions": ["plc_prg.fbcounter.ncount"]}
    assert script.post(f"{RUNTIME}/values/unforce", release)["values"] == []
    until(lambda: script.value("PLC_PRG.fbCounter.nCount") > 0, "counting on after the release")


def test_an_online_change_keeps_the_counters(script: Script) -> None:
    assert script.relation() == "same"
    until(lambda: script.value("PLC_PRG.fbCounter.nCount") > 3, "counting")
    script.write("PLC_PRG.fbCounter.nCount", 1_000_000)
    script.write("PLC_PRG.sName", "'kept'")
    more = PROGRAM.replace("xLamp : BOOL;", "xLamp : BOOL;\n    nFresh : INT := 42;")
    script.save("PLC_PRG", declaration=more, implementation=BODY + "\nnFresh := nFresh;")
    script.save("FB_Counter", implementation="nCount := nCount + nStep + 0;")
    assert script.relation() == "online_change"
    done = script.download("online_change")
    assert done["state"] == "run"
    assert done["code_id"] == script.state()["code_id"]
    count, name, fresh = script.values("PLC_PRG.fbCounter.nCount", "PLC_PRG.sName", "PLC_PRG.nFresh")
    assert count >= 1_000_000
    assert (name, fresh) == ("kept", 42)
    until(lambda: script.value("PLC_PRG.fbCounter.nCount") > count, "counting on")
    assert script.relation() == "same"


def test_an_online_change_needs_a_running_version_of_the_application(plant: Station, script: Script) -> None:
    other = plant.script(script.http.headers["Authorization"].removeprefix("Bearer "))
    other.create_project("Stranger")
    assert other.relation() == "foreign"
    refused = other.download("online_change", 409)
    assert refused["type"] == "urn:tappet:problem:no-online-change"
    assert script.state()["state"] == "run"
    other.call("DELETE", other.project, status=204)


def test_resets_initialise_what_they_should(script: Script) -> None:
    def dirty() -> None:
        script.write("PLC_PRG.nKept", 77)
        script.write("PLC_PRG.nDivisor", 3)
        assert script.values("PLC_PRG.nKept", "PLC_PRG.nDivisor") == [77, 3]

    dirty()
    assert script.post(f"{RUNTIME}/reset", {"kind": "warm"})["state"] == "stop"
    assert script.values("PLC_PRG.nKept", "PLC_PRG.nDivisor") == [77, 1]
    assert script.value("PLC_PRG.fbCounter.nCount") == 0
    assert script.post(f"{RUNTIME}/start")["state"] == "run"
    until(lambda: script.value("PLC_PRG.fbCounter.nCount") > 0, "running again")
    dirty()
    script.post(f"{RUNTIME}/reset", {"kind": "cold"})
    assert script.values("PLC_PRG.nKept", "PLC_PRG.nDivisor") == [5, 1]
    assert script.post(f"{RUNTIME}/reset", {"kind": "origin"})["state"] == "empty"
    refused = script.post(f"{RUNTIME}/values/read", {"expressions": ["PLC_PRG.nKept"]}, 409)
    assert "download" in refused["detail"]
    script.post(f"{RUNTIME}/start", status=409)
    assert script.relation() == "empty"
    script.post(f"{RUNTIME}/reset", {"kind": "hot"}, 422)


def test_stop_and_start(script: Script) -> None:
    assert script.post(f"{RUNTIME}/stop")["state"] == "stop"
    before = script.value("PLC_PRG.fbCounter.nCount")
    script.write("PLC_PRG.tDelay", "T#3s")
    assert script.value("PLC_PRG.fbCounter.nCount") == before
    assert script.post(f"{RUNTIME}/start")["state"] == "run"
    until(lambda: script.value("PLC_PRG.fbCounter.nCount") > before, "counting on")


def test_statistics_of_the_task(script: Script) -> None:
    until(lambda: script.get(f"{RUNTIME}/tasks")[0]["iec_cycles"] > 50, "cycles")
    (task,) = script.get(f"{RUNTIME}/tasks")
    assert 0 < task["min_us"] <= task["average_us"] <= task["max_us"]
    assert task["kind"] == "cyclic"
    configured = script.read_object(task["name"])["data"]
    assert configured["interval"] == f"T#{task['interval_us'] / 1000:.0f}ms"
    script.post(f"{RUNTIME}/tasks/{task['name']}/reset", status=204)
    until(lambda: script.get(f"{RUNTIME}/tasks")[0]["iec_cycles"] < 50, "the next cycle begins again")
    unknown = script.post(f"{RUNTIME}/tasks/Nobody/reset", status=404)
    assert task["name"] in unknown["detail"]


def test_a_division_by_zero_is_reported_with_place_and_call_stack(plant: Station, script: Script) -> None:
    pid = plant.runtime_pid()
    script.write("PLC_PRG.nDivisor", 0)
    script.wait_for_state("exception")
    report = script.get(f"{RUNTIME}/exception")
    assert report == script.state()["exception"]
    assert report["name"] == "DIV_ZERO"
    assert (report["pou"].upper(), report["part"], report["line"]) == ("QUOTIENT", "implementation", 1)
    assert report["object_id"] == script.ids["Quotient"]
    stack = [(f["pou"].upper(), f["object_id"], f["line"]) for f in report["call_stack"]]
    assert stack == [("QUOTIENT", script.ids["Quotient"], 1), ("PLC_PRG", script.ids["PLC_PRG"], 2)]
    assert plant.runtime_pid() == pid, "the process lives on"
    assert script.get("/health")["status"] == "ok"
    assert script.value("PLC_PRG.nDivisor") == 0, "values can still be looked at"
    logged = [line["message"].lower() for line in script.get(f"{RUNTIME}/log")]
    assert any("division by zero in quotient, line 1" in message for message in logged), logged
    assert script.build()["ok"] is True

    script.post(f"{RUNTIME}/reset", {"kind": "warm"})
    assert script.post(f"{RUNTIME}/start")["state"] == "run"
    assert script.get(f"{RUNTIME}/exception") is None
    until(lambda: script.value("PLC_PRG.nQuotient") > 0, "working again")


def test_the_audit_log_says_who_wrote_what(plant: Station, script: Script) -> None:
    made = {"username": "otto", "password": "correct horse battery", "role": "operator"}
    if all(user["username"] != "otto" for user in script.get("/users")):
        script.post("/users", made, 201)
    otto = plant.browser()
    otto.post("/auth/login", {"username": "otto", "password": made["password"]})
    otto.write("PLC_PRG.tDelay", "T#5s")
    otto.write("PLC_PRG.tDelay", "T#7s")
    otto.force("PLC_PRG.xLamp", "TRUE")
    otto.post(f"{RUNTIME}/values/unforce", {"expressions": None})
    otto.post(f"{RUNTIME}/stop")
    entries = script.get("/audit?limit=10")
    seen = [(e["username"], e["action"], e["subject"], e["old_value"], e["new_value"]) for e in entries]
    assert ("otto", "write", "PLC_PRG.tDelay", "T#5s", "T#7s") in seen
    assert ("otto", "force", "PLC_PRG.xLamp", "FALSE", "TRUE") in seen
    assert ("otto", "unforce", "PLC_PRG.xLamp", "TRUE", None) in seen
    assert seen[0][:2] == ("otto", "stop")
    assert {e["runtime_id"] for e in entries if e["action"] in ("write", "force")} == {"local"}
    refused = otto.http.get("/audit")
    assert refused.status_code == 403
    (download, *_) = script.get("/audit?action=download")
    assert download["project_id"] == script.project_id
    assert download["username"] == "local"


def test_metrics_and_openapi_are_served(plant: Station, script: Script) -> None:
    metrics = script.http.get("/metrics")
    assert metrics.status_code == 200
    assert "tappet" in metrics.text
    assert "/api/v1/runtimes/{runtime_id}/values/force" in script.get("/openapi.json")["paths"]
    assert httpx.get(f"{plant.base}/metrics").status_code == 401
