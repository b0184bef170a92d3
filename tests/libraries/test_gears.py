"""Gears, phases and what is superimposed on either, against closed forms."""

from __future__ import annotations

import math
from collections.abc import Iterator

import pytest
from tests.libraries.coupled_axes import CoupledAxes, coupled_axes
from tests.libraries.one_axis import CYCLE

RAMP = {"Acceleration": 100.0, "Deceleration": 100.0}
SHIFT = {"Velocity": 20.0, "Acceleration": 1000.0, "Deceleration": 1000.0}
DIFFERENCE = {"VelocityDiff": 20.0, "Acceleration": 1000.0, "Deceleration": 1000.0}
SYNC = {"MasterSyncPosition": 100.0, "SlaveSyncPosition": 50.0, "MasterStartDistance": 40.0}


@pytest.fixture
def axes() -> Iterator[CoupledAxes]:
    with coupled_axes() as found:
        yield found


def _at_once(axes: CoupledAxes, **ratio: float) -> None:
    axes.start("Gear1", Acceleration=1e6, Deceleration=1e6, **ratio)
    axes.until("Gear1", "InGear")


def test_a_gear_is_reached_by_its_ramp_and_makes_up_no_distance(axes: CoupledAxes) -> None:
    """motion_semantics EX-15, ax3000 EX-AX-20."""
    axes.run_master(100.0)
    axes.after(0.2)
    start = axes.master
    axes.start("Gear1", RatioNumerator=1, RatioDenominator=2, **RAMP)
    assert axes.outputs("Gear1") == {"Busy"}
    assert axes.state == "synchronized_motion"
    assert axes.until("Gear1", "InGear") + CYCLE == pytest.approx(0.5, abs=2 * CYCLE)
    assert axes.outputs("Gear1") == {"Busy", "Active", "InGear"}
    assert axes.position == pytest.approx(12.5, abs=1e-9)
    axes.after(1.0)
    assert axes.position == pytest.approx((axes.master - start) / 2 - 12.5, abs=1e-9)
    assert axes.velocity == pytest.approx(50.0, abs=1e-9)


@pytest.mark.parametrize("ratio", [(3, 1), (-2, 1), (1, 3), (-7, 5)])
def test_a_slave_in_gear_travels_as_its_ratio_says(axes: CoupledAxes, ratio: tuple[int, int]) -> None:
    _at_once(axes, RatioNumerator=ratio[0], RatioDenominator=ratio[1])
    before = axes.position, axes.master
    axes.run_master(-80.0, 200.0)
    axes.after(0.7)
    axes.run_master(130.0, 333.0)
    axes.after(1.9)
    expected = ratio[0] / ratio[1] * (axes.master - before[1])
    assert axes.position - before[0] == pytest.approx(expected, abs=1e-9)
    assert axes.velocity == pytest.approx(ratio[0] / ratio[1] * axes.number("Master.fSetVelocity"), abs=1e-9)


def test_a_slave_catches_an_accelerating_master_within_its_own_limits(axes: CoupledAxes) -> None:
    axes.run_master(500.0, 60.0)
    axes.after(1.0)
    axes.start("Gear1", **RAMP)
    gone = axes.until("Gear1", "InGear") + CYCLE
    assert gone == pytest.approx(60.0 / (100.0 - 60.0), abs=4 * CYCLE)
    assert axes.velocity == pytest.approx(axes.number("Master.fSetVelocity"), abs=1e-9)


@pytest.mark.parametrize("gain", [0.0, 60.0])
def test_a_gear_with_jerk_is_reached_in_the_shortest_time(axes: CoupledAxes, gain: float) -> None:
    axes.run_master(1e4 if gain else 100.0, gain or 1e6)
    axes.after(1.0)
    first = axes.number("Master.fSetVelocity")
    axes.start("Gear1", Jerk=200.0, **RAMP)
    highest, jerk, before = 0.0, 0.0, axes.number("Axis.fSetAcceleration")
    gone = CYCLE
    while "InGear" not in axes.outputs("Gear1"):
        axes.cycle()
        gone += CYCLE
        now = axes.number("Axis.fSetAcceleration")
        highest, jerk, before = max(highest, now), max(jerk, abs(now - before) / CYCLE), now
    # acceleration rises from 0 with the jerk to its limit, and falls to that of the master
    rise, fall = 100.0 / 200.0, (100.0 - gain) / 200.0
    constant = (first - (0.5 * rise * (100.0 - 2 * gain) + 0.5 * fall * (100.0 - gain))) / (100.0 - gain)
    assert constant > 0.0
    assert gone == pytest.approx(rise + constant + fall, abs=3 * CYCLE)
    assert highest == pytest.approx(100.0, abs=1e-6)
    assert jerk <= 200.0 * (1 + 1e-6)


def test_another_gear_takes_over_without_a_step(axes: CoupledAxes) -> None:
    axes.run_master(100.0)
    _at_once(axes)
    axes.release("Gear1")
    axes.after(0.1)
    axes.start("Gear2", RatioNumerator=2, **RAMP)
    assert 100.0 - 1e-9 <= axes.velocity <= 100.1 + 1e-9
    assert axes.until("Gear2", "InGear") == pytest.approx(1.0, abs=2 * CYCLE)
    assert axes.outputs("Gear1") == set()


def test_an_edge_on_the_same_gear_changes_its_ratio(axes: CoupledAxes) -> None:
    axes.run_master(100.0)
    _at_once(axes)
    axes.release("Gear1")
    axes.start("Gear1", RatioNumerator=2, **RAMP)
    assert "InGear" not in axes.outputs("Gear1")
    assert axes.until("Gear1", "InGear") == pytest.approx(1.0, abs=2 * CYCLE)
    assert axes.velocity == pytest.approx(200.0)


def test_an_edge_on_the_same_ratio_does_not_disturb_the_gear(axes: CoupledAxes) -> None:
    """ax3000 GEAR-02."""
    axes.run_master(100.0)
    _at_once(axes, RatioNumerator=3, RatioDenominator=2)
    apart = axes.position - 1.5 * axes.master
    for _ in range(3):
        axes.release("Gear1")
        axes.start("Gear1")
        assert axes.velocity == pytest.approx(150.0, abs=1e-9)
        axes.cycle(5)
        assert axes.outputs("Gear1") == {"Busy", "Active", "InGear"}
    assert axes.position - 1.5 * axes.master == pytest.approx(apart, abs=1e-9)


def test_what_waits_behind_a_gear_begins_when_it_is_reached(axes: CoupledAxes) -> None:
    """SEQ-05 and SEQ-06, where ax3000 MC-08 has Aborting alone: no blending; Buffered waits for InGear."""
    axes.run_master(100.0)
    axes.start("Gear1", RatioDenominator=2, **RAMP)
    axes.start("Velocity", Velocity=20.0, BufferMode=2, **RAMP)
    assert axes.text("Velocity.ErrorID") == "SMC_BLENDING_NOT_SUPPORTED_BY_PREVIOUS_MOVEMENT"
    axes.release("Velocity")
    axes.start("Velocity", BufferMode=1)
    axes.after(0.4)
    assert axes.outputs("Velocity") == {"Busy"}
    assert axes.outputs("Gear1") == {"Busy", "Active"}
    axes.after(0.1)
    assert axes.outputs("Velocity") == {"Busy", "Active"}
    assert axes.velocity == pytest.approx(50.0, abs=0.5)
    axes.until("Velocity", "InVelocity")
    assert axes.velocity == 20.0


@pytest.mark.parametrize(
    ("block", "inputs", "reached"),
    [
        ("Through", {"Position": 60.0, "Velocity": 50.0, "EndVelocity": 30.0, **RAMP}, "InEndVelocity"),
        ("GearPos", SYNC, "InSync"),
    ],
)
def test_a_buffered_command_waits_for_what_is_reached(
    axes: CoupledAxes, block: str, inputs: dict[str, float], reached: str
) -> None:
    """SEQ-05: behind InEndVelocity and InSync, with the velocity that is reached there."""
    axes.run_master(100.0)
    axes.start(block, **inputs)
    if block == "GearPos":
        axes.until(block, "StartSync")
    axes.start("Velocity", Velocity=10.0, BufferMode=1, **RAMP)
    for _ in range(5000):
        if "Active" in axes.outputs("Velocity"):
            break
        assert axes.outputs("Velocity") == {"Busy"}
        before = axes.velocity
        axes.cycle()
    assert before == pytest.approx({"InEndVelocity": 30.0, "InSync": 100.0}[reached], abs=0.3)
    axes.cycle()
    assert axes.outputs(block) == {"CommandAborted"}


def test_a_slave_that_is_called_before_its_master_lags_a_cycle(axes: CoupledAxes) -> None:
    """Spec CAL-07: no way is lost by it."""
    axes.write("xSlaveFirst", True)
    _at_once(axes)
    axes.run_master(100.0, 200.0)
    axes.after(1.5)
    assert axes.master - axes.position == pytest.approx(0.0, abs=1e-9)
    axes.write("xSlaveFirst", False)


def test_a_released_slave_keeps_its_velocity(axes: CoupledAxes) -> None:
    axes.run_master(100.0)
    _at_once(axes)
    axes.start("GearOut")
    assert axes.state == "continuous_motion"
    assert axes.outputs("GearOut") == {"Busy", "Done"}
    axes.cycle()
    assert axes.outputs("Gear1") == {"CommandAborted"}
    axes.after(0.5)
    assert axes.velocity == pytest.approx(100.0)
    axes.start("Stop", Deceleration=1000.0)
    axes.until("Stop", "Done")
    assert axes.outputs("GearOut") == {"Done"}
    axes.release("GearOut")
    assert axes.outputs("GearOut") == set()


def test_gears_are_refused_with_their_errors(axes: CoupledAxes) -> None:
    wrong = [
        ({"RatioDenominator": 0, **RAMP}, "SMC_GI_RATIO_DENOM"),
        ({"Acceleration": 0.0, "Deceleration": 1.0}, "SMC_GI_INVALID_ACC"),
        ({"Acceleration": 1.0, "Deceleration": -1.0}, "SMC_GI_INVALID_DEC"),
    ]
    for inputs, error in wrong:
        axes.start("Gear1", **{"RatioDenominator": 1, **inputs})
        assert (axes.outputs("Gear1"), axes.text("Gear1.ErrorID")) == ({"Error"}, error)
        axes.release("Gear1")
    axes.start("GearOut")
    assert (axes.outputs("GearOut"), axes.text("GearOut.ErrorID")) == (
        {"Error"},
        "SMC_AXIS_NOT_READY_FOR_MOTION",
    )
    axes.start("Phasing", PhaseShift=1.0, **SHIFT)
    assert axes.text("Phasing.ErrorID") == "SMC_AXIS_NOT_READY_FOR_MOTION"
    assert axes.state == "standstill"


def test_a_gear_that_is_not_called_any_more_is_an_error(axes: CoupledAxes) -> None:
    axes.run_master(100.0)
    _at_once(axes)
    axes.write("sSkipped", "Gear1")
    axes.cycle(2)
    assert axes.state == "errorstop"
    axes.write("sSkipped", "")
    axes.cycle()
    assert axes.text("Gear1.ErrorID") == "SMC_FB_WASNT_CALLED_DURING_MOTION"
    axes.after(5.0)
    assert axes.velocity == 0.0


def test_positions_meet_in_gear(axes: CoupledAxes) -> None:
    """motion_semantics EX-16."""
    axes.start("GearPos", **SYNC)
    axes.run_master(100.0)
    assert axes.outputs("GearPos") == {"Busy"}
    axes.until("GearPos", "StartSync")
    assert axes.master == pytest.approx(60.0, abs=0.11)
    assert "InSync" not in axes.outputs("GearPos")
    position, velocity = axes.position, 0.0
    while "InSync" not in axes.outputs("GearPos"):
        axes.cycle()
        assert axes.position >= position - 1e-12
        assert abs(axes.velocity - velocity) < 3.0
        position, velocity = axes.position, axes.velocity
    assert axes.position == pytest.approx(axes.master - 50.0, abs=1e-9)
    assert axes.velocity == pytest.approx(100.0)
    axes.after(0.3)
    assert axes.position == pytest.approx(axes.master - 50.0, abs=1e-9)
    assert axes.outputs("GearPos") == {"Busy", "Active", "InSync"}


@pytest.mark.parametrize("direction", [1.0, -1.0])
def test_a_moving_slave_goes_on_until_it_is_coupled(axes: CoupledAxes, direction: float) -> None:
    axes.start("Velocity", Velocity=30.0, Acceleration=1e6, Deceleration=1e6, Direction=-1)
    axes.start(
        "GearPos",
        RatioNumerator=3,
        RatioDenominator=2,
        MasterSyncPosition=100.0 * direction,
        SlaveSyncPosition=20.0,
        MasterStartDistance=80.0 * direction,
    )
    axes.run_master(50.0 * direction)
    axes.after(0.2)
    assert axes.velocity == pytest.approx(-30.0)
    assert axes.outputs("Velocity") >= {"Busy", "InVelocity"}
    before = axes.velocity, axes.position
    while "InSync" not in axes.outputs("GearPos"):
        axes.cycle()
        assert axes.position == pytest.approx(before[1] + CYCLE * (before[0] + axes.velocity) / 2, abs=1e-3)
        assert abs(axes.velocity - before[0]) < 2.0
        before = axes.velocity, axes.position
    assert axes.position - 20.0 == pytest.approx(1.5 * (axes.master - 100.0 * direction), abs=1e-9)
    assert axes.outputs("Velocity") == {"CommandAborted"}


def test_a_stop_before_the_start_aborts_the_coupling(axes: CoupledAxes) -> None:
    axes.start("GearPos", **SYNC)
    axes.cycle(3)
    axes.start("Stop", Deceleration=100.0)
    axes.cycle()
    assert axes.outputs("GearPos") == {"CommandAborted"}
    axes.run_master(100.0)
    axes.after(2.0)
    assert axes.position == 0.0


def test_a_master_that_turns_while_it_is_coupled_is_an_error(axes: CoupledAxes) -> None:
    axes.start("GearPos", **SYNC)
    axes.run_master(100.0)
    axes.until("GearPos", "StartSync")
    axes.after(0.1)
    axes.run_master(-100.0, 2000.0)
    axes.after(0.2)
    assert (axes.outputs("GearPos"), axes.text("GearPos.ErrorID")) == (
        {"Error"},
        "SMC_GIP_MASTER_DIRECTION_CHANGE",
    )
    assert axes.state == "errorstop"


def test_a_rotary_slave_avoids_a_reversal(axes: CoupledAxes) -> None:
    axes.start("GearPos", AvoidReversal=True, **SYNC)
    assert axes.text("GearPos.ErrorID") == "SMC_GIP_AVOID_REVERSAL_FOR_FINITE_AXIS"
    axes.release("GearPos")
    axes.set("Axis", iMovementType=0, fPositionPeriod=360.0)
    axes.start("GearPos", **SYNC | {"SlaveSyncPosition": 350.0})
    axes.run_master(100.0)
    axes.until("GearPos", "StartSync")
    slowest = 0.0
    while "InSync" not in axes.outputs("GearPos"):
        axes.cycle()
        slowest = min(slowest, axes.velocity)
        assert axes.velocity >= -1e-9
    assert axes.position == pytest.approx(350.0 + axes.master - 100.0, abs=1e-9)


def test_a_phase_has_the_slave_lag(axes: CoupledAxes) -> None:
    """motion_semantics EX-17."""
    for name in ("Master", "Axis"):
        axes.set(name, iMovementType=0, fPositionPeriod=360.0)
    axes.run_master(100.0)
    _at_once(axes)
    apart = axes.master - axes.position
    axes.start("Phasing", PhaseShift=10.0, **SHIFT)
    slowest = 100.0
    gone = CYCLE
    while "Done" not in axes.outputs("Phasing"):
        axes.cycle()
        gone += CYCLE
        slowest = min(slowest, axes.velocity)
        assert axes.state == "synchronized_motion"
    assert gone == pytest.approx(10.0 / 20.0 + 20.0 / 1000.0, abs=3 * CYCLE)
    assert slowest == pytest.approx(80.0, abs=1e-6)
    assert (axes.master - axes.position - apart) % 360.0 == pytest.approx(10.0, abs=1e-9)
    axes.release("Phasing")
    axes.start("Phasing", PhaseShift=10.0, **SHIFT)
    axes.until("Phasing", "Done", 0.1)
    axes.start("PhasingRelative", PhaseShift=-4.0, **SHIFT)
    axes.until("PhasingRelative", "Done")
    assert (axes.master - axes.position - apart) % 360.0 == pytest.approx(6.0, abs=1e-9)


def test_another_phase_or_the_end_of_the_coupling_aborts_a_phase(axes: CoupledAxes) -> None:
    axes.run_master(100.0)
    _at_once(axes)
    axes.start("Phasing", PhaseShift=50.0, **SHIFT)
    axes.after(0.3)
    axes.start("Phasing2", PhaseShift=0.0, **SHIFT)
    axes.cycle()
    assert axes.outputs("Phasing") == {"CommandAborted"}
    assert axes.outputs("Phasing2") == {"Busy"}
    axes.start("Velocity", Velocity=10.0, **RAMP)
    axes.cycle()
    assert axes.outputs("Phasing2") == {"CommandAborted"}
    axes.release("Phasing")
    axes.set("Master", iMovementType=0, fPositionPeriod=0.0)
    axes.start("Phasing", PhaseShift=0.0, **SHIFT)
    assert axes.text("Phasing.ErrorID") == "SMC_PH_ROTARYAXIS_PERIOD0"


def test_what_is_superimposed_on_a_slave_stays(axes: CoupledAxes) -> None:
    axes.run_master(100.0)
    _at_once(axes)
    apart = axes.position - axes.master
    axes.start("Super1", Distance=5.0, **DIFFERENCE)
    axes.until("Super1", "Done")
    axes.after(0.3)
    assert axes.position - axes.master - apart == pytest.approx(5.0, abs=1e-9)
    assert axes.outputs("Gear1") == {"Busy", "Active", "InGear"}
    assert axes.state == "synchronized_motion"


@pytest.mark.parametrize(
    ("start", "forward", "back"),
    [(0, 2.0, -2.0), (1, 0.0, -4.0), (-1, 4.0, 0.0)],
    ids=["none", "positive", "negative"],
)
def test_a_slave_is_brought_through_its_backlash(
    axes: CoupledAxes, start: int, forward: float, back: float
) -> None:
    compensation = {"fCompensationVel": 20.0, "fCompensationAcc": 500.0, "fCompensationDec": 500.0}
    axes.start("Backlash", fBacklash=2.0, eBacklashStartState=start, **compensation)
    axes.start("MasterAbsolute", Position=100.0, Velocity=50.0, **RAMP)
    fastest = 0.0
    while "Done" not in axes.outputs("MasterAbsolute"):
        axes.cycle()
        fastest = max(fastest, axes.velocity)
    axes.after(1.0)
    assert axes.position == pytest.approx(100.0 + forward, abs=1e-9)
    assert axes.state == "synchronized_motion"
    axes.set("MasterAbsolute", Execute=False)
    axes.cycle()
    axes.start("MasterAbsolute", Position=50.0)
    axes.until("MasterAbsolute", "Done")
    axes.after(1.0)
    assert axes.position == pytest.approx(50.0 + back, abs=1e-9)
    assert math.isclose(axes.velocity, 0.0, abs_tol=1e-9)
    axes.start("Stop", Deceleration=100.0)
    axes.cycle()
    assert axes.outputs("Backlash") == {"bCommandAborted"}


def test_a_backlash_larger_than_half_a_period_is_refused(axes: CoupledAxes) -> None:
    axes.set("Axis", iMovementType=0, fPositionPeriod=360.0)
    axes.start("Backlash", fBacklash=181.0, fCompensationVel=1.0, fCompensationAcc=1.0, fCompensationDec=1.0)
    assert axes.text("Backlash.iErrorID") == "SMC_BC_BL_TOO_BIG"
