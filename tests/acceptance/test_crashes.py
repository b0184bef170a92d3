"""What a machine must survive: a killed soft PLC, an endless loop, a server that starts again."""

from __future__ import annotations

import os
import signal
from collections.abc import Iterator
from pathlib import Path

import pytest
from live_server import FIRST_START_S, RUNTIME, Script, Station, station, until

PROGRAM = """PROGRAM PLC_PRG
VAR
    nVolatile : DINT := 3;
    nCycles : DINT;
END_VAR
VAR RETAIN
    nKept : DINT := 5;
    sBatch : STRING(20) := 'none';
END_VAR
VAR PERSISTENT
    rHours : LREAL;
END_VAR"""
LOOP = "PROGRAM Endless\nVAR\n    xSpin : BOOL;\n    n : DINT;\nEND_VAR"
SPIN = "n := n + 1;\nWHILE xSpin DO\n    n := n + 1;\nEND_WHILE"


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    found: Path = tmp_path_factory.mktemp("crash")
    return found


@pytest.fixture(scope="module")
def plant(folder: Path) -> Iterator[Station]:
    with station(folder) as running:
        script = running.admin
        script.create_project("Crash")
        script.save("PLC_PRG", declaration=PROGRAM, implementation="nCycles := nCycles + 1;")
        script.add("pou", "Endless", subkind="program")
        script.save("Endless", declaration=LOOP, implementation=SPIN)
        configuration = next(
            o["id"] for o in script.get(f"{script.project}/objects") if o["kind"] == "task_configuration"
        )
        slow = {
            "priority": 20,
            "interval": "T#10ms",
            "watchdog": {"enabled": True, "time": "T#2s", "sensitivity": 1},
            "pous": [{"name": "Endless"}],
        }
        made = script.add("task", "Slow", parent_id=configuration, data=slow)
        assert made["data"]["watchdog"]["enabled"] is True
        script.download()
        script.wait_for_state("run")
        yield running


def _set_values(script: Script) -> None:
    script.write("PLC_PRG.nVolatile", 33)
    script.write("PLC_PRG.nKept", 55)
    script.write("PLC_PRG.sBatch", "'B-17'")
    script.write("PLC_PRG.rHours", 12.5)
    cycles = script.value("PLC_PRG.nCycles")
    until(lambda: script.value("PLC_PRG.nCycles") > cycles + 2, "cycles after the writes")


KEPT = ("PLC_PRG.nVolatile", "PLC_PRG.nKept", "PLC_PRG.sBatch", "PLC_PRG.rHours")


def test_a_killed_runtime_returns_with_its_retained_values(plant: Station) -> None:
    script = plant.admin
    _set_values(script)
    before = script.state()
    pid = plant.runtime_pid()
    os.kill(pid, signal.SIGKILL)

    lost = until(lambda: (s := script.state())["connected"] is False and s, "the server notices")
    assert "SIGKILL" in lost["problem"] or "lost" in lost["problem"]
    refused = script.http.post(f"{RUNTIME}/values/read", json={"expressions": ["PLC_PRG.nKept"]})
    assert refused.status_code in (200, 503)
    if refused.status_code == 503:
        assert refused.json()["type"] == "urn:tappet:problem:runtime-not-connected"
        assert "not connected" in refused.json()["detail"]
    assert script.get("/health")["status"] == "ok"

    back = script.wait_for_state("run", FIRST_START_S)
    assert plant.runtime_pid() != pid
    assert (back["application"], back["code_id"]) == (before["application"], before["code_id"])
    assert back["problem"] is None
    assert script.values(*KEPT) == [3, 55, "B-17", 12.5]
    cycles = script.value("PLC_PRG.nCycles")
    until(lambda: script.value("PLC_PRG.nCycles") > cycles, "the program runs again")
    assert script.relation() == "same"
    script.write("PLC_PRG.nVolatile", 8)
    assert script.value("PLC_PRG.nVolatile") == 8
    script.save("PLC_PRG", implementation="nCycles := nCycles + 2;")
    assert script.relation() == "online_change"
    assert script.download("online_change")["state"] == "run"
    assert script.value("PLC_PRG.nVolatile") == 8


def test_an_endless_loop_ends_as_an_exception(plant: Station) -> None:
    script = plant.admin
    pid = plant.runtime_pid()
    script.write("Endless.xSpin", "TRUE")
    script.get("/projects")
    script.wait_for_state("exception")
    report = script.get(f"{RUNTIME}/exception")
    assert report["name"] == "WATCHDOG"
    assert report["task"] == "Slow"
    assert report["pou"].upper() == "ENDLESS"
    assert (report["object_id"], report["part"]) == (script.ids["Endless"], "implementation")
    assert report["line"] in (2, 3, 4)
    assert plant.runtime_pid() == pid
    assert script.value("Endless.xSpin") is True
    assert script.build()["ok"] is True
    script.post(f"{RUNTIME}/reset", {"kind": "warm"})
    assert script.post(f"{RUNTIME}/start")["state"] == "run"
    until(lambda: script.value("Endless.n") > 3, "the task runs again")


def test_an_endless_loop_without_watchdog_ends_too(plant: Station) -> None:
    """Stopped by hand, which must work at any time; the other tasks go on until then."""
    script = plant.admin
    pid = plant.runtime_pid()
    task = script.read_object("Slow")["data"]
    script.save("Slow", watchdog={**task["watchdog"], "enabled": False})
    script.download()
    script.wait_for_state("run")
    script.write("Endless.xSpin", "TRUE")
    cycles = script.value("PLC_PRG.nCycles")
    until(lambda: script.value("PLC_PRG.nCycles") > cycles, "the other task runs on")
    assert script.build()["ok"] is True
    state = script.post(f"{RUNTIME}/stop")
    assert state["state"] in ("stop", "exception")
    assert plant.runtime_pid() == pid
    assert state["connected"] is True
    script.post(f"{RUNTIME}/reset", {"kind": "warm"})
    assert script.post(f"{RUNTIME}/start")["state"] == "run"


DESTROYING = """nCycles := nCycles + 1;
IF xDestroy THEN
    pContext := TaskHandle();
    FOR i := 0 TO 5999 DO pContext[i] := 255; END_FOR
    pContext := 0;
    pContext^ := 1;
END_IF"""


def test_a_program_that_ends_the_process_is_not_started_again(plant: Station) -> None:
    """It writes over what the runtime itself needs; whoever has seen the exception may start it anyway."""
    script = plant.admin
    script.add("pou", "TaskHandle", subkind="function")
    handle = "{attribute 'tappet_external' := 'tappet_task_current'}\nFUNCTION TaskHandle : LWORD"
    script.save("TaskHandle", declaration=handle, implementation="")
    more = "VAR\n    xDestroy : BOOL;\n    pContext : POINTER TO BYTE;\n    i : DINT;\nEND_VAR"
    good = script.read_object("PLC_PRG")["data"]["implementation"]
    script.save("PLC_PRG", declaration=f"{PROGRAM}\n{more}", implementation=DESTROYING)
    script.download()
    script.wait_for_state("run")
    script.write("PLC_PRG.nKept", 77)
    cycles = script.value("PLC_PRG.nCycles")
    until(lambda: script.value("PLC_PRG.nCycles") > cycles + 2, "cycles after the write")
    for _ in range(2):
        pid = plant.runtime_pid()
        order = {"values": [{"expression": "PLC_PRG.xDestroy", "value": "TRUE"}]}
        answer = script.http.post(f"{RUNTIME}/values/write", json=order)
        assert answer.status_code in (200, 503), "the process may end before it answers"
        lost = until(lambda: (s := script.state())["connected"] is False and s, "the server notices")
        assert "SIGSEGV" in lost["problem"] or "lost" in lost["problem"]
        waits = script.wait_for_state("exception", FIRST_START_S)
        assert plant.runtime_pid() != pid
        report = script.get(f"{RUNTIME}/exception")
        assert waits["exception"] == report
        assert (report["name"], report["task"]) == ("PROCESS_ENDED", "MainTask")
        assert (report["object_id"], report["part"]) == (script.ids["PLC_PRG"], "implementation")
        assert report["line"] in (4, 5, 6)
        assert report["values"]["signal"] == "SIGSEGV"
        assert "start this one anyway" in report["message"]
        assert any("PLC_PRG" in line["message"] for line in script.get(f"{RUNTIME}/log"))
        assert script.post(f"{RUNTIME}/start")["state"] == "run"
        assert script.values("PLC_PRG.nKept", "PLC_PRG.xDestroy") == [77, False]
    script.save("PLC_PRG", declaration=PROGRAM, implementation=good)
    script.download()
    script.wait_for_state("run")


def test_a_server_that_starts_anew_finds_everything(folder: Path, plant: Station) -> None:
    """Last here: it stops the server of this module and starts another on its folder."""
    script = plant.admin
    _set_values(script)
    project, code = script.read_object("PLC_PRG"), script.state()["code_id"]
    plant.process.send_signal(signal.SIGTERM)
    assert plant.process.wait(30) == 0
    with station(folder) as again:
        later = again.admin
        later.project_id, later.application_id, later.ids = (
            script.project_id,
            script.application_id,
            script.ids,
        )
        assert later.read_object("PLC_PRG") == project
        assert later.wait_for_state("run")["code_id"] == code
        assert later.values(*KEPT) == [3, 55, "B-17", 12.5]
        assert later.relation() == "same"
        old_token = again.script(script.http.headers["Authorization"].removeprefix("Bearer "))
        assert old_token.get("/auth/me")["username"] == "local"
