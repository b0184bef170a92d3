"""TASK-05: functions called at system events, in their order; TASK-16: tasks that external events start."""

from __future__ import annotations

import asyncio
import os
import signal
import sys
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from plc_programs import MS, build, until
from pydantic import ValidationError
from tests.project import axis_projects
from tests.project.axis_projects import only

from tappet.cli.inputs import project_applications
from tappet.codegen.package import CodePackage
from tappet.iec.system_events import SYSTEM_EVENTS
from tappet.iec.task import Task
from tappet.project import edit
from tappet.project.kinds.task_configuration import TaskConfigurationData
from tappet.project.model import Project
from tappet.project.new_project import new_project
from tappet.runtime.client import RuntimeClient
from tappet.runtime.local import ApplicationException, LocalRuntime
from tappet.runtime.operations.life_cycle import Start
from tappet.runtime.operations.values import Read
from tappet.runtime.process import RuntimeProcess

SIZE = 500
LOG = f"""{{attribute 'qualified_only'}}
VAR_GLOBAL PERSISTENT RETAIN
    n : DINT;
    seen : ARRAY [0..{SIZE - 1}] OF INT;
    divisor : DINT := 1;
END_VAR"""
PROGRAM = 99


def noting(*events: str, body: str = "") -> Project:
    """A project whose function of each event notes the number of the event in a persistent log."""
    project = new_project("machine")
    application = only(project, "application")
    project, _ = edit.add_object(project, application.id, "persistent", "Noted", data={"declaration": LOG})
    note = "IF Noted.n < {size} THEN Noted.seen[Noted.n] := {number}; Noted.n := Noted.n + 1; END_IF\n"
    for event in events:
        number = SYSTEM_EVENTS.index(event) + 1  # type: ignore[arg-type]
        data = {
            "declaration": f"FUNCTION On{event} : BOOL",
            "implementation": note.format(size=SIZE, number=number) + body,
        }
        project, _ = edit.add_object(project, application.id, "pou", f"On{event}", data=data)
    program = next(pou for pou in project.find_kind("pou") if pou.name == "PLC_PRG")
    project = edit.change_data(
        project,
        program.id,
        {
            "declaration": "PROGRAM PLC_PRG\nVAR\n    nDivided : DINT;\nEND_VAR",
            "implementation": note.format(size=SIZE, number=PROGRAM) + "nDivided := 10 / Noted.divisor;",
        },
    )
    calls = [{"event": event, "function": f"On{event}"} for event in events]
    return edit.change_data(project, only(project, "task_configuration").id, {"system_events": calls})


def package_of(project: Project) -> CodePackage:
    result = axis_projects.build(project)
    assert [str(d) for d in result.diagnostics if d.severity == "error"] == []
    assert result.package is not None
    return result.package


def seen(runtime: LocalRuntime) -> list[str]:
    count = runtime.read("Noted.n")
    assert isinstance(count, int)
    numbers = [runtime.read(f"Noted.seen[{i}]") for i in range(count)]
    return ["program" if n == PROGRAM else SYSTEM_EVENTS[int(n) - 1] for n in numbers]  # type: ignore[arg-type]


EVERYTHING = package_of(noting(*SYSTEM_EVENTS))
CYCLE = ["AfterReadingInputs", "program", "BeforeWritingOutputs"]


@settings(max_examples=30, deadline=None)
@given(st.lists(st.sampled_from(["start", "stop", "warm", "cold", "run", "download"]), max_size=12))
def test_events_come_in_the_order_of_the_life_cycle(commands: list[str]) -> None:
    expected = ["DownloadDone"]
    running = False
    with LocalRuntime(EVERYTHING, start=False) as runtime:
        for command in commands:
            if command == "start":
                expected += [] if running else ["PrepareStart", "StartDone"]
                running = True
                runtime.start()
            elif command == "stop":
                expected += ["PrepareStop", "StopDone"] if running else []
                running = False
                runtime.stop()
            elif command == "run":
                if running:
                    runtime.run(cycles=2)
                    expected += 2 * CYCLE
            elif command == "download":
                # persistent values are those of the moment in which the old application has stopped
                expected += ["PrepareDownload", "DownloadDone"]
                running = False
                runtime.plc.load(EVERYTHING)
            else:
                expected += ["PrepareReset", "ResetDone"]
                running = False
                runtime.reset(command)  # type: ignore[arg-type]
        assert seen(runtime) == expected


def test_calls_are_counted() -> None:
    with LocalRuntime(EVERYTHING) as runtime:
        runtime.run(cycles=7)
        counts = [runtime.read(f"IoConfig_SystemEvents.udi{event}") for event in ("StartDone", *CYCLE[::2])]
        assert counts == [1, 7, 7]


def test_an_exception_is_an_event() -> None:
    with LocalRuntime(EVERYTHING) as runtime:
        runtime.write("Noted.divisor", 0)
        with pytest.raises(ApplicationException):
            runtime.run(cycles=3)
        runtime.plc.poll()
        assert seen(runtime)[-2:] == ["program", "Exception"]
        assert runtime.exception is not None
        assert runtime.exception.pou == "PLC_PRG"


@pytest.mark.parametrize("event", ["PrepareStart", "StartDone"])
def test_a_fault_in_the_function_is_an_exception_of_the_application(event: str) -> None:
    project = noting(event, body="Noted.divisor := 0; Noted.n := 1 / Noted.divisor;")
    with LocalRuntime(package_of(project)) as runtime:
        assert runtime.state == "exception"
        report = runtime.exception
        assert report is not None
        assert (report.task, report.pou, report.name) == (f"system event {event}", f"On{event}", "DIV_ZERO")


def test_a_function_that_never_ends_is_ended() -> None:
    project = noting("StartDone", body="WHILE Noted.divisor > 0 DO Noted.n := 2; END_WHILE")
    with LocalRuntime(package_of(project), cycle_limit_s=0.2) as runtime:
        assert runtime.exception is not None
        assert runtime.exception.name == "WATCHDOG"


def test_a_missing_function_is_told_at_its_event() -> None:
    project = noting()
    configuration = only(project, "task_configuration")
    calls = [{"event": "StopDone", "function": "Nowhere"}]
    project = edit.change_data(project, configuration.id, {"system_events": calls})
    result = axis_projects.build(project)
    (error,) = (d for d in result.diagnostics if d.severity == "error")
    assert "Nowhere" in error.message
    (one,) = project_applications(project)
    source = next(s for s in one.sources if s.uri == error.uri)
    assert source.map is not None
    place = source.map.place(error.span)
    assert place is not None
    assert (place.object_id, place.element) == (configuration.id, "StopDone")


def test_an_inactive_call_is_not_made() -> None:
    project = noting("StartDone")
    calls = [{"event": "StartDone", "function": "OnStartDone", "active": False}]
    project = edit.change_data(project, only(project, "task_configuration").id, {"system_events": calls})
    with LocalRuntime(package_of(project)) as runtime:
        assert seen(runtime) == []


def test_the_function_keeps_its_event_when_renamed() -> None:
    project = noting("StartDone")
    function = next(pou for pou in project.find_kind("pou") if pou.name == "OnStartDone")
    project = edit.rename_object(project, function.id, "Began")
    data: Any = only(project, "task_configuration").data
    assert [call.function for call in data.system_events] == ["Began"]


def test_an_event_calls_one_function() -> None:
    calls = [{"event": "StartDone", "function": name} for name in ("A", "B")]
    with pytest.raises(ValidationError, match="StartDone stands there twice"):
        TaskConfigurationData.model_validate({"system_events": calls})


EXTERNAL = build(
    """
PROGRAM PLC_PRG VAR n : DINT; END_VAR n := n + 1; END_PROGRAM
PROGRAM OnSignal VAR n : DINT; END_VAR n := n + 1; END_PROGRAM
PROGRAM OnStart VAR n : DINT; END_VAR n := n + 1; END_PROGRAM
""",
    (
        Task("Main", interval_ns=10 * MS, programs=("PLC_PRG",)),
        Task("Signal", "external", 0, 3, event="sigusr1", programs=("OnSignal",)),
        Task("Began", "external", 0, 3, event="StartDone", programs=("OnStart",)),
    ),
)


def test_an_external_event_starts_its_task_once() -> None:
    """TASK-16; those that come before the scheduler looks again are one start, as with other events."""
    with LocalRuntime(EXTERNAL) as runtime:
        runtime.run(cycles=3)
        assert [runtime.read(f"{name}.n") for name in ("PLC_PRG", "OnSignal", "OnStart")] == [3, 0, 1]
        for expected, times in ((1, 1), (2, 3), (2, 0)):
            for _ in range(times):
                runtime.plc.happen("SIGUSR1")
            runtime.run(cycles=1)
            assert runtime.read("OnSignal.n") == expected
        runtime.stop()
        runtime.plc.happen("SIGUSR1")
        runtime.start()
        runtime.run(cycles=1)
        assert runtime.read("OnStart.n") == 2


def test_external_events_are_compiled_under_their_own_names() -> None:
    assert [task.event for task in EXTERNAL.tasks] == [None, "SIGUSR1", "StartDone"]


@pytest.mark.skipif(sys.platform != "linux", reason="signals of POSIX")
async def test_a_signal_to_the_process_starts_the_task(tmp_path: Path) -> None:
    ready: asyncio.Queue[Any] = asyncio.Queue()
    process = await RuntimeProcess.start(
        tmp_path / "plc", options=("--no-realtime",), on_ready=ready.put_nowait
    )
    try:
        endpoint = await ready.get()
        async with await RuntimeClient.connect(endpoint.url, endpoint.token) as client:
            await client.download(EXTERNAL.to_bytes())
            await client.call(Start())
            symbols = await client.symbols()
            place = symbols.resolve("OnSignal.n").offset
            os.kill(endpoint.pid, signal.SIGUSR1)

            async def ran() -> bool:
                (data,) = await client.call(Read([(place, 4)]))
                return int.from_bytes(data, "little") == 1

            await until(ran)
    finally:
        await process.stop()
