"""Axes are measured under their panel, on virtual time: the step, its record, and every way that it ends."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from functools import cache
from typing import Any

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from test_moving_axes import package
from tests.project.axis_projects import with_axes

from tappet.codegen.package import CodePackage
from tappet.motion.axis_measurement import AxisFacts, AxisMeasurement, NoPositionLoopError, RefusedStepError
from tappet.motion.loop_tuning import evaluate
from tappet.motion.measured_response import Recording
from tappet.motion.recorded_axis import recorded_answer
from tappet.project import edit
from tappet.project.model import Project
from tappet.runtime.local import LocalRuntime
from tappet.runtime.operations.axis_panel import Action, KeepAxis, SteerAxis, StopAxis
from tappet.runtime.operations.declaration import OperationError
from tappet.runtime.recorder import Frame, Recorder

ME = 7
CYCLE = 0.002
SCALING = {"increments": 65536, "units": 360.0}
PLANT_LAG, PLANT_DEAD = 0.006, 3
"""Of the program's plant: seconds, and cycles on top of those of the bus: it works before the loop."""
PLANT = f"""PROGRAM PLC_PRG
VAR
    fSpeed  : LREAL;
    fPlace  : LREAL;
    afAsked : ARRAY[0..{PLANT_DEAD}] OF LREAL;
    iAt     : INT;
    xBlocked : BOOL;
END_VAR"""
PLANT_BODY = f"""Drive.in.bRegulatorRealState := Drive.out.bRegulatorOn;
Drive.in.bDriveStartRealState := Drive.out.bDriveStart;
IF NOT xBlocked THEN
    fPlace := fPlace + afAsked[{PLANT_DEAD}] * {CYCLE}
        + (fSpeed - afAsked[{PLANT_DEAD}]) * {PLANT_LAG} * (1.0 - EXP(-{CYCLE / PLANT_LAG}));
    fSpeed := afAsked[{PLANT_DEAD}] + (fSpeed - afAsked[{PLANT_DEAD}]) * EXP(-{CYCLE / PLANT_LAG});
END_IF
FOR iAt := {PLANT_DEAD} TO 1 BY -1 DO
    afAsked[iAt] := afAsked[iAt - 1];
END_FOR
afAsked[0] := DINT_TO_LREAL(Drive.out.diSetVelocity) / 32767.0 * 1000.0;
Drive.in.dwActPosition := DINT_TO_DWORD(LREAL_TO_DINT(fPlace * 65536.0 / 360.0));"""


def fast(project: Project) -> Project:
    (task,) = project.find_kind("task")
    return edit.change_data(project, task.id, {"interval": "T#2ms", "pous": [{"name": "PLC_PRG"}]})


@cache
def machine(drive: str, gain: float = 15.0, limited: bool = False) -> CodePackage:
    settings: dict[str, Any] = {
        "drive": drive,
        "scaling": SCALING,
        "position_control": {"gain": gain, "dead_time": 4.0},
    }
    if limited:
        settings |= {
            "axis_type": "finite",
            "software_limits": {"enabled": True, "negative": -10.0, "positive": 10.0},
            "position_lag": 4.0,
        }
    project = fast(with_axes("Drive", **settings))
    body = PLANT_BODY if drive == "SM_Drive_PosControl" else ""
    (program,) = project.find_kind("pou")
    return package(edit.change_data(project, program.id, {"declaration": PLANT, "implementation": body}))


class Page:
    """Somebody who controls the axis, with a recorder of its bus task."""

    def __init__(self, runtime: LocalRuntime) -> None:
        self.runtime = runtime
        self.axis = AxisMeasurement(runtime.package.symbols, "Drive")
        self.frames: list[Frame] = []
        self._recorder: Recorder | None = None

    def steer(self, action: Action, **motion: float) -> None:
        SteerAxis("Drive", ME, action, **motion).run(self.runtime.plc)

    def stay(self, cycles: int) -> None:
        for _ in range(cycles):
            KeepAxis("Drive", ME).run(self.runtime.plc)
            self.go_on(1)

    def go_on(self, cycles: int) -> None:
        """Without a sign of the page."""
        self.runtime.run(cycles=cycles)
        if self._recorder is not None:
            self.frames += self._recorder.take()

    def switch_on(self) -> None:
        self.steer("take")
        self.stay(3)
        self.steer("power_on")
        self.stay(30)
        assert self.state() == "standstill"

    def facts(self) -> AxisFacts:
        return self.axis.facts(self.runtime.plc.read(self.axis.fact_places))

    def begin(self, action: Action, height: float, duration: float) -> None:
        self._recorder = self.runtime.plc.record(self.axis.recorded_places, self.facts().bus_task, 1, 0)
        self.frames = []
        self.steer(action, position=height, duration=duration)

    def measure(self, action: Action, height: float, duration: float) -> Recording:
        """From the beginning to the end."""
        facts = self.facts()
        self.begin(action, height, duration)
        for _ in range(50):
            self.stay(20)
            if self.phase() == "Idle":
                break
        assert self.panel("xDone") == "TRUE"
        frames = [one for one in self.frames if self.axis.phase(one.data) != "Idle"]
        cycles = [one.cycle for one in frames]
        return recorded_answer(cycles, [one.data for one in frames], self.axis.layout, facts)

    def panel(self, output: str) -> str:
        return self.runtime.literal(f"IoConfig_AxisPanels.Drive.{output}")

    def phase(self) -> str:
        return self.panel("ePhase")

    def state(self) -> str:
        return self.runtime.literal("Drive.nAxisState")

    def number(self, name: str) -> float:
        return float(self.runtime.literal(f"IoConfig_Globals.Drive.{name}"))


@contextmanager
def page(drive: str, **data: Any) -> Iterator[Page]:
    with LocalRuntime(machine(drive, **data)) as runtime:
        runtime.run(cycles=5)
        yield Page(runtime)


def test_a_step_of_the_simulated_drive_is_that_of_its_loops() -> None:
    """Against solve_ivp: position P, velocity PI, current of first order, friction; the feed-forward is off,
    and on again behind the step. The actual position is one cycle old."""
    with page("SM_Drive_Simulated") as one:
        one.switch_on()
        start = one.number("fSetPosition")
        recording = one.measure("measure_step", 2.0, 0.3)
        assert one.number("fSetPosition") == pytest.approx(start, abs=1e-9)
        assert one.runtime.literal("Drive.out.bStep") == "FALSE"
        inertia, viscous, dry, current, kv, kp, tn = 6e-5, 1e-4, 0.01, 0.0005, 60.0, 0.03, 0.02
        height = np.radians(2.0)

        def loops(time: float, state: np.ndarray) -> list[float]:
            angle, velocity, torque, integral = state
            error = kv * (height * min(time / CYCLE, 1.0) - angle) - velocity
            friction = viscous * velocity + dry * np.tanh(velocity / 1e-3)
            return [
                velocity,
                (torque - friction) / inertia,
                (kp * (error + integral) - torque) / current,
                error / tn,
            ]

        times = np.arange(1, 101) * CYCLE
        known = solve_ivp(loops, (0, times[-1]), [0.0] * 4, method="LSODA", t_eval=times, max_step=CYCLE / 20)
        first = recording.resting
        found = recording.act_position[first + 1 : first + 101]
        np.testing.assert_allclose(found, np.degrees(known.y[0]), atol=0.02 * 2.0)


def test_gains_for_the_simulated_drive_are_proposed() -> None:
    """The inertia is found behind friction; with the new gains the answer is the predicted one."""
    with page("SM_Drive_Simulated") as one:
        one.switch_on()
        facts = one.facts()
        first = one.measure("measure_step", 5.0, 0.3)
        found = evaluate(first, facts.loop, facts.largest_torque)
        assert found.problem is None
        assert found.identified is not None
        assert found.figures is not None
        assert found.identified.dead_time_s == pytest.approx(CYCLE, abs=0.1 * CYCLE)
        assert found.identified.lag_s * 0.03 == pytest.approx(6e-5, rel=0.05)
        assert found.figures.dead_time_cycles in (1, 2)
        for proposal, a in zip(found.proposals, (3.0, 1.0 + 2.0**0.5), strict=True):
            assert proposal.gains["velocity_gain"] == pytest.approx(6e-5 / (a * 0.0005), rel=0.05)
            assert proposal.gains["integral_time"] == pytest.approx(a * a * 0.0005)
            drive = "IoConfig_Globals.Drive_Drive.stSettings"
            one.runtime.write(f"{drive}.fPositionGain", proposal.gains["position_gain"])
            one.runtime.write(f"{drive}.fVelocityGain", proposal.gains["velocity_gain"])
            one.runtime.write(f"{drive}.fIntegralTime", proposal.gains["integral_time"])
            again = one.measure("measure_step", 5.0, 0.3)
            now = evaluate(again, one.facts().loop)
            assert now.figures is not None
            assert now.figures.overshoot < 0.03
            assert now.figures.rise_time_s is not None
            assert found.figures.rise_time_s is not None
            assert now.figures.rise_time_s < 0.6 * found.figures.rise_time_s
            np.testing.assert_allclose(again.act_position, proposal.answer, atol=0.06 * 5.0)
            assert now.identified is not None
            found_again = now.identified.lag_s * proposal.gains["velocity_gain"]
            assert found_again == pytest.approx(6e-5, rel=0.1)


@pytest.mark.parametrize(
    ("action", "gain"), [("measure_step", 15.0), ("measure_move", 15.0), ("measure_move", 0.0)]
)
def test_a_gain_for_the_controller_is_proposed(action: Action, gain: float) -> None:
    """The plant of the program: two cycles of the bus, three more, and a lag of 6 ms. The dead time is that
    of devices EX-07, by a fast move also with a gain of 0."""
    with page("SM_Drive_PosControl", gain=gain) as one:
        one.switch_on()
        facts = one.facts()
        found = evaluate(one.measure(action, 3.0, 0.6), facts.loop)
        assert found.problem is None
        assert found.identified is not None
        plant = found.identified
        dead = (PLANT_DEAD + 2) * CYCLE
        assert plant.dead_time_s + plant.lag_s == pytest.approx(dead + PLANT_LAG, rel=0.02)
        assert plant.dead_time_s == pytest.approx(dead, abs=0.3 * CYCLE)
        assert plant.factor == pytest.approx(1.0, abs=0.01)
        gentle = found.proposals[0]
        assert gentle.gains["position_gain"] == pytest.approx(
            0.25 / (dead + PLANT_LAG + 0.5 * CYCLE), rel=0.03
        )
        assert found.figures is not None
        # as it is read off a trace: a motion begins with no velocity, and the lag of the fast move shows
        at_least = PLANT_DEAD + 2 + 1
        assert found.figures.dead_time_cycles in (at_least, at_least + (action == "measure_move"))
        one.runtime.write("Drive.fKp", gentle.gains["position_gain"])
        one.runtime.write("Drive.fDeadTimeCycles", gentle.gains["dead_time"])
        again = one.measure("measure_step", 3.0, 0.6)
        now = evaluate(again, one.facts().loop)
        assert now.figures is not None
        assert now.figures.overshoot < 0.01
        assert abs(now.figures.steady_error) < 0.02


def test_an_axis_without_a_gain_does_not_follow_a_step() -> None:
    with page("SM_Drive_PosControl", gain=0.0) as one:
        one.switch_on()
        found = evaluate(one.measure("measure_step", 3.0, 0.2), one.facts().loop)
        assert found.proposals == ()
        assert "did not follow the set position" in str(found.problem)


def test_a_slow_bus_task_rests_long_enough_to_know_the_noise() -> None:
    """Twenty cycles at least, whatever the cycle."""
    with LocalRuntime(package(with_axes("Drive", drive="SM_Drive_Simulated", scaling=SCALING))) as runtime:
        runtime.run(cycles=5)
        one = Page(runtime)
        one.switch_on()
        assert one.facts().values["fTaskCycle"] == 0.02
        recording = one.measure("measure_step", 5.0, 1.0)
        assert recording.resting == pytest.approx(20, abs=1)


def test_a_rotary_axis_is_measured_over_its_zero() -> None:
    with page("SM_Drive_PosControl") as one:
        one.switch_on()
        one.steer("set_position", position=359.0)
        one.stay(5)
        recording = one.measure("measure_step", 3.0, 0.4)
        assert recording.height == pytest.approx(3.0)
        assert recording.act_position[-1] == pytest.approx(3.0, abs=0.05)
        assert one.number("fSetPosition") == pytest.approx(359.0)


def test_a_page_that_is_gone_ends_the_measurement_and_the_axis_rests() -> None:
    """The dead-man watchdog of the panel holds in a measurement, too."""
    with page("SM_Drive_PosControl") as one:
        one.switch_on()
        one.begin("measure_step", 3.0, 10.0)
        one.stay(60)
        assert one.phase() == "Responding"
        one.go_on(round(2.0 / CYCLE) - 10)
        assert one.phase() == "Responding"
        one.go_on(round(0.5 / CYCLE))
        assert one.panel("eState") == "Free"
        assert one.panel("xLost") == "TRUE"
        assert one.phase() == "Idle"
        assert one.panel("xDone") == "FALSE"
        assert one.state() == "power_off"
        assert one.number("fSetVelocity") == 0.0
        place = one.number("fActPosition")
        one.go_on(200)
        assert one.number("fActPosition") == place


@pytest.mark.parametrize("after", [20, 55, 70])
def test_stop_ends_the_measurement_where_the_axis_is(after: int) -> None:
    """At rest, just behind the step, and in the middle of the answer: the axis does not jump back."""
    with page("SM_Drive_PosControl") as one:
        one.switch_on()
        one.begin("measure_step", 3.0, 10.0)
        one.stay(after)
        StopAxis("Drive", ME).run(one.runtime.plc)
        one.stay(3)
        assert one.phase() == "Ending"
        one.stay(150)
        assert one.phase() == "Idle"
        assert one.state() == "standstill"
        assert one.panel("eState") == "Control"
        assert one.panel("eError") == "SMC_NO_ERROR"
        assert one.number("fSetPosition") == pytest.approx(one.number("fActPosition"), abs=0.02)
        assert one.number("fSetPosition") < 3.0
        recording = one.measure("measure_step", 1.0, 0.2)  # it can be measured again
        assert recording.height == pytest.approx(1.0)


def test_an_oscillating_loop_is_ended_by_stop() -> None:
    """A gain far beyond that of stability: the quick stop of the drive ends the oscillation."""
    with page("SM_Drive_PosControl", gain=150.0) as one:
        one.switch_on()
        one.begin("measure_step", 3.0, 10.0)
        one.stay(200)
        assert max(abs(one.number("fActPosition") - 3.0), 1.0) > 3.0 or one.number("out.diSetVelocity") != 0
        StopAxis("Drive", ME).run(one.runtime.plc)
        one.stay(5)
        assert one.number("out.diSetVelocity") == 0.0
        one.stay(100)
        assert one.phase() == "Idle"
        assert one.state() == "standstill"


def test_an_error_of_the_axis_ends_the_measurement() -> None:
    with page("SM_Drive_PosControl") as one:
        one.switch_on()
        one.runtime.write("PLC_PRG.xBlocked", True)
        one.runtime.write("Drive.fMaxPositionLag", 1.0)
        one.begin("measure_step", 3.0, 1.0)
        one.stay(200)
        assert one.state() == "errorstop"
        assert one.phase() == "Idle"
        assert one.panel("xDone") == "FALSE"
        assert one.panel("eError") == "SMC_DI_POSITIONLAGERROR"
        assert one.number("fSetPosition") == pytest.approx(one.number("fActPosition"), abs=0.01)
        one.runtime.write("PLC_PRG.xBlocked", False)
        one.steer("reset")
        one.stay(20)
        assert one.state() == "standstill"


def test_what_the_axis_must_not_do_is_refused_before_and_in_the_controller() -> None:
    with page("SM_Drive_PosControl", limited=True) as one:
        refused = one.facts()
        with pytest.raises(RefusedStepError, match="state power_off; it has to stand with power"):
            refused.check(1.0, "step")
        one.switch_on()
        facts = one.facts()
        facts.check(4.0, "step")
        with pytest.raises(RefusedStepError, match=r"goes to 12 u, beyond the software limits -10 u to 10 u"):
            facts.check(12.0, "move")
        with pytest.raises(RefusedStepError, match=r"beyond the largest position lag of 4 u"):
            facts.check(-5.0, "step")
        facts.check(-5.0, "move")
        for height, error in ((12.0, "SMC_DI_SWLIMITS_EXCEEDED"), (0.0, "SMC_INVALID_SET_VALUES")):
            one.steer("measure_step", position=height)
            one.stay(3)
            assert one.phase() == "Idle"
            assert one.panel("eError") == error
            assert one.number("fSetPosition") == 0.0
        one.steer("power_off")
        one.stay(10)
        one.steer("measure_step", position=1.0)
        one.stay(3)
        assert one.panel("eError") == "SMC_REGULATOR_OR_START_NOT_SET"


def test_nothing_else_is_begun_meanwhile() -> None:
    with page("SM_Drive_PosControl") as one:
        one.switch_on()
        one.begin("measure_step", 3.0, 0.3)
        one.stay(60)
        with pytest.raises(OperationError, match="is being measured; wait for the end, or stop it"):
            one.steer("move_absolute", position=50.0)
        one.steer("jog_forward")
        one.stay(50)
        assert one.number("fSetVelocity") == 0.0
        one.steer("jog_end")
        one.stay(300)
        assert one.panel("xDone") == "TRUE"


def test_an_axis_without_a_loop_is_not_tuned() -> None:
    with (
        LocalRuntime(machine("SM_Drive_Virtual")) as runtime,
        pytest.raises(NoPositionLoopError, match="only axes with"),
    ):
        AxisMeasurement(runtime.package.symbols, "Drive")
