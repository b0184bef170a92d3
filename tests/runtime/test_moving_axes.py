"""Axes of a project in a soft PLC on virtual time (motion_semantics INF-04, INF-08; devices.md AXIS-04)."""

from __future__ import annotations

import math
import time
from dataclasses import replace
from itertools import pairwise

import pytest
from tests.project.axis_projects import BODY, DECLARATION, moving, with_axes

from tappet.cli.inputs import project_applications
from tappet.codegen.build import build_application
from tappet.codegen.package import CodePackage
from tappet.project import edit
from tappet.project.model import Project
from tappet.runtime.local import ApplicationException, LocalRuntime

CYCLE = 0.02
VELOCITY, ACCELERATION = 10.0, 100.0


def package(project: Project, previous: CodePackage | None = None) -> CodePackage:
    (one,) = project_applications(project)
    options = replace(one.options, level=1, once=False)
    result = build_application(one.sources, one.tasks, options=options, previous=previous)
    assert [str(d) for d in result.diagnostics if d.severity == "error"] == []
    assert result.package is not None
    return result.package


def positions(runtime: LocalRuntime, cycles: int) -> list[float]:
    found = []
    for _ in range(cycles):
        runtime.run(cycles=1)
        found.append(float(runtime.literal("Drive.fSetPosition")))
    return found


def no_step(places: list[float]) -> bool:
    """Velocity and acceleration stay within those of the command."""
    speeds = [(b - a) / CYCLE for a, b in pairwise(places)]
    rises = [abs(b - a) / CYCLE for a, b in pairwise(speeds)]
    return max(map(abs, speeds)) <= VELOCITY * (1 + 1e-9) and max(rises) <= ACCELERATION * (1 + 1e-6)


def test_an_axis_moves_by_three_lines_without_a_call_of_its_own() -> None:
    with LocalRuntime(package(moving(with_axes("Drive")))) as runtime:
        places = positions(runtime, 300)
        assert no_step([0.0, *places])
        assert places[-1] == pytest.approx(50.0)
        assert runtime.literal("IoConfig_Globals.Drive.nAxisState") == "standstill"
        assert runtime.read("Drive.fTaskCycle") == CYCLE


def changed(project: Project, how: str) -> Project:
    """A line of ST is changed; or an axis is added before the one that moves; or its editor is used."""
    if how == "line":
        return moving(project, BODY + "\nfbMove.Jerk := 0.0;")
    pool = project.find_kind("axis_pool")[0]
    if how == "axis":
        return edit.add_object(project, pool.id, "axis", "Another")[0]
    axis = project.find_kind("axis")[0]
    return edit.change_data(project, axis.id, {"modulo": 720.0})


@pytest.mark.parametrize("how", ["line", "axis", "editor"])
def test_an_axis_goes_on_over_an_online_change_without_a_step(how: str) -> None:
    project = moving(with_axes("Drive"))
    with LocalRuntime(package(project)) as runtime:
        places = [0.0, *positions(runtime, 60)]
        assert 0.0 < places[-1] < 50.0
        runtime.plc.download(package(changed(project, how), runtime.package).to_bytes(), "online_change")
        places += positions(runtime, 240)
        assert no_step(places)
        assert runtime.literal("PLC_PRG.fbMove.Done") == "TRUE"
        assert places[-1] == pytest.approx(50.0)
        assert runtime.literal("Drive.bError") == "FALSE"


def test_after_a_download_axes_have_no_power() -> None:
    project = moving(with_axes("Drive"))
    with LocalRuntime(package(project)) as runtime:
        positions(runtime, 60)
        runtime.plc.download(package(moving(project, "")).to_bytes())
        runtime.start()
        positions(runtime, 3)
        assert runtime.literal("Drive.nAxisState") == "power_off"
        assert runtime.literal("Drive.bRegulatorOn") == "FALSE"


def test_the_runtime_stops_axes_by_their_ramp() -> None:
    """INF-08: fSWMaxDeceleration is 20, so an axis at 10 needs 2.5."""
    project = moving(with_axes("Drive", dynamic_limits={"deceleration": 20.0}))
    with LocalRuntime(package(project)) as runtime:
        runtime.run(cycles=100)
        assert runtime.read("Drive.fSetVelocity") == 10.0
        before = float(runtime.literal("Drive.fSetPosition"))
        trace = runtime.trace(["Drive.fSetPosition"], task="MainTask")
        runtime.stop()
        places = [before] + [sample.values["Drive.fSetPosition"] for sample in trace.collect()]
        assert runtime.state == "stop"
        assert no_step(places)
        assert places[-1] - before == pytest.approx(10.0 * 10.0 / (2 * 20.0), rel=0.1)
        assert runtime.read("Drive.fSetVelocity") == 0.0
        runtime.start()
        again = positions(runtime, 250)  # the enable of the drive came back, which is the edge of the move
        assert no_step([places[-1], *again])
        assert again[-1] == pytest.approx(50.0)


def test_an_axis_that_stands_does_not_delay_a_stop() -> None:
    with LocalRuntime(package(moving(with_axes("Drive")))) as runtime:
        runtime.run(cycles=400)
        now = runtime.now_ns
        runtime.stop()
        assert runtime.now_ns - now < 6 * CYCLE * 1e9
        assert runtime.plc.log.since()[-1].message == "Application stopped"


def test_a_stop_does_not_wait_for_an_axis_that_is_not_moved() -> None:
    """Its task has a longer interval than one waits."""
    project = with_axes("Drive")
    task = project.find_kind("task")[0]
    project = edit.change_data(project, task.id, {**task.data.model_dump(), "interval": "T#1h"})
    with LocalRuntime(package(project)) as runtime:
        runtime.stop()
        assert runtime.state == "stop"
        assert [entry.message for entry in runtime.plc.log.since()][-2:] == [
            "stopped although not all axes stand",
            "Application stopped",
        ]


FAULT = "IF iFaultAt = 0 THEN iQuotient := 1 / iFaultAt; END_IF"
FAULTING = """PROGRAM Faulting
VAR
    iFaultAt : INT := 100;
    iQuotient : INT;
END_VAR"""
GEARED = """fbPower(Axis := Drive, Enable := TRUE, bRegulatorOn := TRUE, bDriveStart := TRUE);
fbMove(Axis := Drive, Execute := fbPower.Status, Position := 50.0, Velocity := 10.0,
    Acceleration := 100.0, Deceleration := 100.0);
fbSlave(Axis := Second, Enable := TRUE, bRegulatorOn := TRUE, bDriveStart := TRUE);
fbGear(Master := Drive, Slave := Second, Execute := fbSlave.Status, RatioNumerator := 2,
    RatioDenominator := 1, Acceleration := 1000.0, Deceleration := 1000.0);"""


def faulting(where: str) -> Project:
    """The slave of a gear moves with Drive; a program divides by zero when its counter is set to 0: one of a
    task of its own, or that of the bus task before or behind the blocks of the axes."""
    project = with_axes("Drive", "Second", dynamic_limits={"deceleration": 100.0})
    declaration = DECLARATION.replace(
        "END_VAR",
        "    fbSlave : MC_Power;\n    fbGear : MC_GearIn;\n    iFaultAt : INT := 100;\n"
        "    iQuotient : INT;\nEND_VAR",
    )
    body = {"before": f"{FAULT}\n{GEARED}", "behind": f"{GEARED}\n{FAULT}"}.get(where, GEARED)
    (program,) = project.find_kind("pou")
    project = edit.change_data(project, program.id, {"declaration": declaration, "implementation": body})
    (application,) = project.applications()
    text = {"declaration": FAULTING, "implementation": FAULT}
    project, _ = edit.add_object(project, application.id, "pou", "Faulting", data=text)
    (configuration,) = project.find_kind("task_configuration")
    task = {"interval": "T#30ms", "priority": 3, "pous": [{"name": "Faulting"}]}
    project, _ = edit.add_object(project, configuration.id, "task", "Slow", data=task)
    return project


@pytest.mark.parametrize("where", ["another task", "before", "behind"])
def test_axes_brake_by_their_ramps_when_a_program_faults(where: str) -> None:
    """They do not stop dead, and no program of the user runs any more."""
    with LocalRuntime(package(faulting(where))) as runtime:
        runtime.run(cycles=200)
        assert runtime.read("Drive.fSetVelocity") == 10.0
        assert runtime.read("Second.fSetVelocity") == pytest.approx(20.0)
        names = ["Drive.fSetPosition", "Second.fSetPosition", "PLC_PRG.fbMove.Busy"]
        before = [float(runtime.literal(name)) for name in names[:2]]
        trace = runtime.trace(names, task="MainTask")
        faulty = "Faulting" if where == "another task" else "PLC_PRG"
        runtime.write(f"{faulty}.iFaultAt", 0)
        with pytest.raises(ApplicationException, match="zero"):
            runtime.run(cycles=20)
        assert runtime.state == "exception"
        samples = trace.samples
        for name, place, velocity in zip(names, before, (10.0, 20.0), strict=False):
            places = [place] + [float(str(sample.values[name])) for sample in samples]
            speeds = [(b - a) / CYCLE for a, b in pairwise(places)]
            steps = [b - a for a, b in pairwise([velocity, *speeds])]
            assert max(steps) <= 1e-6, "no axis becomes faster"
            assert min(steps) >= -100.0 * CYCLE * (1 + 1e-6), "the deceleration of its settings"
            assert speeds[-1] == 0.0
        assert runtime.literal("Drive.bRegulatorOn") == "TRUE"
        runtime.reset("warm")
        runtime.start()
        assert no_step([0.0, *positions(runtime, 100)])


INTERLOCK = """fbPower(Axis := Drive, Enable := TRUE, bRegulatorOn := TRUE, bDriveStart := TRUE);
fbMove(Axis := Drive, Execute := fbPower.Status, Position := 50.0, Velocity := 10.0,
    Acceleration := 100.0, Deceleration := 100.0);
fbHalt(Axis := Drive, Execute := xClosed, Deceleration := 100.0);"""


def interlocked() -> Project:
    """Logic in a slower task, in another language, closes a gate by the position; the motion halts by it."""
    declaration = DECLARATION.replace("END_VAR", "    fbHalt : MC_Halt;\nEND_VAR")
    project = with_axes("Drive")
    (program,) = project.find_kind("pou")
    project = edit.change_data(project, program.id, {"declaration": declaration, "implementation": INTERLOCK})
    (application,) = project.applications()
    variables = {"declaration": "VAR_GLOBAL\n    xClosed, xNever : BOOL;\nEND_VAR"}
    project, _ = edit.add_object(project, application.id, "gvl", "Gate", data=variables)
    for name, body in (
        ("Logic", "LD Drive.fActPosition\nGE 20.0\nS xClosed"),
        ("Idle", "LD TRUE\nST xNever"),
    ):
        text = {"declaration": f"PROGRAM {name}\nVAR\nEND_VAR", "implementation": body, "language": "IL"}
        project, _ = edit.add_object(project, application.id, "pou", name, data=text)
    (configuration,) = project.find_kind("task_configuration")
    task = {"interval": "T#100ms", "priority": 9, "pous": [{"name": "Logic"}]}
    project, _ = edit.add_object(project, configuration.id, "task", "Slow", data=task)
    return project


def test_logic_of_another_task_uses_the_data_of_an_axis() -> None:
    """ax3000 PRJ-02 to PRJ-05, TASK-05; what no task calls has no effect, and the build says so."""
    (one,) = project_applications(interlocked())
    result = build_application(one.sources, one.tasks, options=replace(one.options, level=1))
    assert [d.message for d in result.diagnostics if d.code == "W1403"] == [
        "Program 'Idle' is called by no task and no program"
    ]
    with LocalRuntime(package(interlocked())) as runtime:
        runtime.run(cycles=300)
        assert runtime.literal("Gate.xClosed") == "TRUE"
        assert runtime.literal("Gate.xNever") == "FALSE"
        assert runtime.read("PLC_PRG.fbMove.CommandAborted") is True
        # 20 u, at most a cycle of the slow task and the way to standstill behind them
        assert 20.0 <= runtime.read("Drive.fSetPosition") <= 20.0 + 10.0 * 0.14 + 0.5
        assert runtime.literal("IoConfig_Globals.Drive.nAxisState") == "standstill"


def test_a_fault_with_standing_axes_ends_at_once() -> None:
    with LocalRuntime(package(faulting("behind"))) as runtime:
        runtime.run(cycles=600)
        assert runtime.read("Drive.fSetVelocity") == 0.0
        runtime.write("PLC_PRG.iFaultAt", 0)
        now = runtime.now_ns
        with pytest.raises(ApplicationException):
            runtime.run(cycles=20)
        assert runtime.now_ns - now < 10 * CYCLE * 1e9


def test_axes_brake_in_real_time_as_well() -> None:
    with LocalRuntime(package(faulting("another task")), virtual=False) as runtime:
        runtime.run(cycles=60)
        assert runtime.read("Drive.fSetVelocity") == 10.0
        runtime.write("Faulting.iFaultAt", 0)
        end = time.monotonic() + 30.0
        while time.monotonic() < end and runtime.read("Second.fSetVelocity") != 0.0:
            time.sleep(0.01)
        assert runtime.state == "exception"
        assert runtime.read("Second.fSetVelocity") == 0.0
        assert runtime.read("Drive.fSetVelocity") == 0.0


def test_an_axis_moves_by_its_simulated_drive() -> None:
    """The motor follows the set values, and the axis ends where it was told to."""
    project = moving(with_axes("Drive", drive="SM_Drive_Simulated", axis_type="finite", position_lag=5.0))
    with LocalRuntime(package(project)) as runtime:
        lags = []
        for _ in range(40):
            runtime.run(cycles=5)
            lags.append(abs(runtime.read("Drive.fSetPosition") - runtime.read("Drive.fActPosition")))
        assert runtime.literal("PLC_PRG.fbMove.Done") == "FALSE"
        assert 0.0 < max(lags) < 2.0
        runtime.run(cycles=300)
        assert runtime.literal("PLC_PRG.fbMove.Done") == "TRUE"
        assert runtime.read("Drive.fActPosition") == pytest.approx(50.0, abs=0.05)
        assert runtime.read("Drive_Drive.fAngle") == pytest.approx(math.radians(50.0), abs=1e-3)
