"""Motions of one axis: the worked examples of the specification."""

from __future__ import annotations

import math

import pytest
from tests.libraries.one_axis import CYCLE, RAMP, TWO_CYCLES, OneAxis, start


def test_positioning_takes_the_time_of_the_formulas(axis: OneAxis) -> None:
    """motion_semantics EX-01, EX-02: 10.5 s for 100 u, 0.447 s for 1 u more; the target is not overrun."""
    ramp = {"Velocity": 10.0, "Acceleration": 20.0, "Deceleration": 20.0}
    axis.start("Absolute1", Position=100.0, **ramp)
    highest = 0.0
    first = axis.cycles_gone
    while "Done" not in axis.outputs("Absolute1"):
        axis.cycle()
        highest = max(highest, axis.number("Axis.fActPosition"))
    assert (axis.cycles_gone - first) * CYCLE == pytest.approx(10.5, abs=TWO_CYCLES)
    assert highest <= 100.0
    assert axis.position == 100.0
    axis.start("Relative1", Distance=1.0, **ramp)
    assert axis.until_done("Relative1") == pytest.approx(2 * math.sqrt(20) / 20, abs=TWO_CYCLES)


@pytest.mark.parametrize(
    ("start_at", "position", "direction", "travel"),
    [
        (0.0, 380.0, "positive", 20.0),
        (355.0, 350.0, "positive", 355.0),
        (10.0, 350.0, "shortest", -20.0),
        (10.0, 200.0, "shortest", -170.0),
        (10.0, 20.0, "negative", -350.0),
        (100.0, 380.0, "positive", 280.0),
        (100.0, 350.0, "positive", 250.0),
        (100.0, 150.0, "shortest", 50.0),
        (100.0, 350.0, "shortest", -110.0),
        (100.0, 20.0, "fastest", -80.0),
        (300.0, 20.0, "shortest", 80.0),
        (100.0, 350.0, "negative", -110.0),
        (100.0, 20.0, "negative", -80.0),
        (100.0, 280.0, "shortest", 180.0),
        (100.0, 100.0, "positive", 0.0),
        (100.0, 20.0, "current", 280.0),
    ],
)
def test_directions_of_a_rotary_axis(
    axis: OneAxis, start_at: float, position: float, direction: str, travel: float
) -> None:
    """motion_semantics EX-03 and ax3000 EX-AX-01."""
    axis.set("Axis", iMovementType=0)
    axis.start("SetPosition1", Position=start_at)
    axis.set(
        "Absolute1",
        Direction={"shortest": 0, "positive": 1, "current": 2, "fastest": 3, "negative": -1}[direction],
    )
    axis.start("Absolute1", Position=position, **RAMP)
    gone, before = 0.0, start_at
    while "Busy" in axis.outputs("Absolute1"):
        step = (axis.position - before + 180) % 360 - 180
        gone, before = gone + step, axis.position
        axis.cycle()
        assert 0 <= axis.position < 360
    gone += (axis.position - before + 180) % 360 - 180
    assert gone == pytest.approx(travel, abs=1e-9)
    assert axis.position == pytest.approx(position % 360, abs=1e-9)


@pytest.mark.parametrize(("direction", "travel"), [(0, -100.0), (3, 260.0)], ids=["shortest", "fastest"])
def test_the_fastest_way_counts_the_present_velocity(axis: OneAxis, direction: int, travel: float) -> None:
    """PRO-04: at 100 u/s, 100 back takes 1 s to stop and 2.5 s for 150; 260 on take 2.1 s and 1 s to stop."""
    axis.set("Axis", iMovementType=0)
    axis.start("Velocity1", Direction=1, **RAMP)
    axis.until(lambda: "InVelocity" in axis.outputs("Velocity1"))
    begin, last = axis.cycles_gone, axis.position
    axis.start("Absolute1", Position=(axis.position - 100.0) % 360.0, Direction=direction, **RAMP)
    gone = 0.0
    while "Done" not in axis.outputs("Absolute1"):
        gone, last = gone + (axis.position - last + 180) % 360 - 180, axis.position
        axis.cycle()
    gone += (axis.position - last + 180) % 360 - 180
    assert gone == pytest.approx(travel, abs=1e-9)
    seconds = {-100.0: 3.5, 260.0: 3.1}[travel]
    assert (axis.cycles_gone - begin) * CYCLE == pytest.approx(seconds, abs=3 * CYCLE)


def test_actual_values_follow_a_cycle_behind(axis: OneAxis) -> None:
    """INF-04: the set value of a cycle is the actual value of an ideal axis in the next one."""
    start(axis, "Absolute1")
    for _ in range(500):
        set_values = [axis.number(f"Axis.fSet{name}") for name in ("Position", "Velocity", "Acceleration")]
        axis.cycle()
        assert [
            axis.number(f"Axis.fAct{name}") for name in ("Position", "Velocity", "Acceleration")
        ] == set_values


@pytest.mark.parametrize(("before", "travel"), [(1, 280.0), (-1, -80.0)])
def test_the_current_direction_is_that_of_the_last_motion(axis: OneAxis, before: int, travel: float) -> None:
    """PRO-04, ax3000 MC-09: from 100 to 20, in the direction in which the axis has moved before."""
    axis.set("Axis", iMovementType=0)
    axis.start("Velocity1", Direction=before, **RAMP)
    axis.after(0.5)
    start(axis, "Halt1")
    axis.until_done("Halt1")
    axis.start("SetPosition1", Position=100.0)
    axis.start("Absolute1", Position=20.0, Direction=2, **RAMP)
    gone, last = 0.0, 100.0
    while "Busy" in axis.outputs("Absolute1"):
        gone, last = gone + (axis.position - last + 180) % 360 - 180, axis.position
        axis.cycle()
    assert gone + (axis.position - last + 180) % 360 - 180 == pytest.approx(travel, abs=1e-9)


@pytest.mark.parametrize("direction", [-1, 0, 1, 2, 3])
@pytest.mark.parametrize(("position", "sign"), [(40.0, -1), (160.0, 1)])
def test_a_linear_axis_has_one_way(axis: OneAxis, position: float, sign: int, direction: int) -> None:
    """ax3000 EX-AX-02: 60 u from 100, whatever the direction says."""
    axis.start("SetPosition1", Position=100.0)
    axis.start("Absolute1", Position=position, Direction=direction, **RAMP)
    while "Done" not in axis.outputs("Absolute1"):
        assert sign * axis.velocity >= 0.0
        axis.cycle()
    assert axis.position == position


def test_absolute_twice(axis: OneAxis) -> None:
    """motion_semantics EX-04."""
    ramp = {"Velocity": 3000.0, "Acceleration": 10_000.0, "Deceleration": 10_000.0}
    axis.start("Absolute1", Position=6000.0, **ramp)
    axis.until_done("Absolute1")
    assert (axis.position, axis.velocity) == (6000.0, 0.0)
    axis.start("Absolute2", Position=10_000.0, **ramp)
    axis.until_done("Absolute2")
    assert axis.position == 10_000.0
    axis.set("Absolute1", Execute=False)
    axis.set("Absolute2", Execute=False)
    axis.cycle()
    axis.start("Absolute1", Position=0.0, **ramp)
    axis.after(1.0)
    assert axis.velocity == -3000.0
    axis.start("Absolute2", Position=-4000.0, **ramp)
    slowest = 3000.0
    while axis.position > 100.0:
        axis.cycle()
        slowest = min(slowest, -axis.velocity)
    assert axis.outputs("Absolute1") == {"CommandAborted"}
    assert slowest == pytest.approx(3000.0)
    axis.until_done("Absolute2")
    assert axis.position == -4000.0


def test_relative_and_additive_during_a_motion(axis: OneAxis) -> None:
    """motion_semantics EX-05, EX-06: from where it is, and from the target of the motion before."""
    ramp = {"Velocity": 1000.0, "Acceleration": 10_000.0, "Deceleration": 10_000.0}
    for block, end in (("Relative2", 7250.0), ("Additive2", 10_000.0)):
        axis.start("SetPosition1", Position=0.0)
        axis.start("Absolute1", Position=6000.0, **ramp)
        axis.until(lambda: axis.position >= 3250.0 - 1e-6)
        assert axis.position == pytest.approx(3250.0)
        axis.start(block, Distance=4000.0, **ramp)
        axis.cycle()
        assert axis.outputs("Absolute1") == {"CommandAborted"}
        axis.until_done(block)
        assert axis.position == pytest.approx(end, abs=1e-6)
        for name in ("Absolute1", block, "SetPosition1"):
            axis.set(name, Execute=False)
        axis.cycle()


@pytest.mark.parametrize("block", ["Relative2", "Additive2"])
def test_relative_and_additive_behind_a_motion(axis: OneAxis, block: str) -> None:
    """motion_semantics EX-05 and EX-06: started with Done of the first, 6000 and then 10000."""
    ramp = {"Velocity": 1000.0, "Acceleration": 10_000.0, "Deceleration": 10_000.0}
    axis.start("Relative1", Distance=6000.0, **ramp)
    axis.until_done("Relative1")
    assert (axis.position, axis.velocity) == (6000.0, 0.0)
    axis.start(block, Distance=4000.0, **ramp)
    axis.until_done(block)
    assert axis.position == pytest.approx(10_000.0, abs=1e-9)


def test_velocities_one_after_the_other(axis: OneAxis) -> None:
    """motion_semantics EX-08."""
    fast = {"Velocity": 3000.0, "Acceleration": 1000.0, "Deceleration": 1000.0}
    axis.start("Velocity1", **fast)
    assert axis.until(lambda: "InVelocity" in axis.outputs("Velocity1")) == pytest.approx(3.0, abs=TWO_CYCLES)
    axis.start("Velocity2", **{**fast, "Velocity": 2000.0})
    assert axis.until(lambda: "InVelocity" in axis.outputs("Velocity2")) == pytest.approx(1.0, abs=TWO_CYCLES)
    assert (axis.velocity, axis.outputs("Velocity1")) == (2000.0, {"CommandAborted"})
    axis.set("Velocity1", Execute=False)
    axis.set("Velocity2", Execute=False)
    start(axis, "Halt1")
    axis.until_done("Halt1")
    axis.start("Velocity1", **fast)
    axis.after(1.0)
    axis.start("Velocity2", **{**fast, "Velocity": 2000.0})
    highest, told = 0.0, set[str]()
    for _ in range(2000):
        axis.cycle()
        highest = max(highest, axis.velocity)
        told |= axis.outputs("Velocity1")
    assert (highest, told) == (pytest.approx(2000.0), {"CommandAborted"})


def test_halt_is_interrupted(axis: OneAxis) -> None:
    """motion_semantics EX-09."""
    axis.start("Velocity1", **RAMP)
    axis.after(1.5)
    axis.start("Halt1", Deceleration=100.0)
    assert axis.state == "discrete_motion"
    axis.after(0.4)
    assert axis.velocity == pytest.approx(60.0, abs=0.5)
    axis.set("Velocity1", Execute=False)
    axis.cycle()
    axis.start("Velocity1")
    axis.cycle()
    assert (axis.outputs("Halt1"), axis.state) == ({"CommandAborted"}, "continuous_motion")
    before = axis.velocity
    axis.after(0.2)
    assert axis.velocity > before


def test_a_new_edge_restarts_the_command(axis: OneAxis) -> None:
    """EXE-02, EXE-03: inputs count at the edge only; the motion goes on from where it is."""
    axis.start("Relative1", Distance=100.0, **RAMP)
    axis.set("Relative1", Distance=500.0)
    axis.after(0.5)
    assert axis.outputs("Relative1") == {"Busy", "Active"}
    axis.set("Relative1", Execute=False)
    axis.cycle()
    here = axis.position
    axis.start("Relative1")
    assert axis.velocity > 0
    axis.until_done("Relative1")
    assert axis.position == pytest.approx(here + 500.0, abs=1e-9)


def test_buffered_commands_wait(axis: OneAxis) -> None:
    """SEQ-05, SEQ-07, ax3000 EX-AX-04, EX-AX-05: behind a target, and behind a velocity."""
    axis.start("Absolute1", Position=1000.0, **RAMP)
    axis.set("Absolute2", BufferMode=1)
    axis.start("Absolute2", Position=3000.0, Velocity=200.0, Acceleration=100.0, Deceleration=100.0)
    axis.set("Relative1", BufferMode=1)
    axis.start("Relative1", Distance=1.0, **RAMP)
    assert axis.outputs("Relative1") == {"Error"}
    assert axis.outputs("Absolute2") == {"Busy"}
    assert axis.until_done("Absolute1") == pytest.approx(11.0, abs=3 * CYCLE + 1e-9)
    assert axis.position == pytest.approx(1000.0, abs=0.01)
    assert axis.outputs("Absolute2") == {"Busy", "Active"}
    assert axis.until_done("Absolute2") == pytest.approx(12.0, abs=3 * CYCLE + 1e-9)
    for name in ("Absolute1", "Absolute2", "Relative1"):
        axis.set(name, Execute=False)
    axis.cycle()
    axis.start("Velocity1", **RAMP)
    axis.start("Relative1", Distance=500.0)
    axis.after(0.9)
    assert axis.outputs("Relative1") == {"Busy"}
    axis.after(0.1 + TWO_CYCLES)
    assert (axis.outputs("Relative1"), axis.state) == ({"Busy", "Active"}, "discrete_motion")
    assert axis.outputs("Velocity1") == {"CommandAborted"}
    axis.until_done("Relative1")
    assert axis.position == pytest.approx(3000.0 + 50.0 + 500.0, abs=1e-6)


BUFFERED, LOW, PREVIOUS, NEXT_ONE, HIGH = range(1, 6)


@pytest.mark.parametrize(
    ("first", "second", "mode", "passing", "at_target", "total"),
    [
        (100.0, 200.0, BUFFERED, 0.0, 11.0, 23.0),
        (100.0, 200.0, LOW, 100.0, 10.5, 21.75),
        (100.0, 200.0, PREVIOUS, 100.0, 10.5, 21.75),
        (100.0, 200.0, NEXT_ONE, 200.0, 10.0, 21.0),
        (100.0, 200.0, HIGH, 200.0, 10.0, 21.0),
        (200.0, 100.0, BUFFERED, 0.0, None, 28.0),
        (200.0, 100.0, LOW, 100.0, None, 26.75),
        (200.0, 100.0, NEXT_ONE, 100.0, None, 26.75),
        (200.0, 100.0, PREVIOUS, 200.0, None, 26.0),
        (200.0, 100.0, HIGH, 200.0, None, 26.0),
    ],
)
@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_blending(
    axis: OneAxis,
    sign: float,
    first: float,
    second: float,
    mode: int,
    passing: float,
    at_target: float | None,
    total: float,
) -> None:
    """SEQ-05, ax3000 EX-AX-04: its table, in both directions."""
    ramp = {"Acceleration": 100.0, "Deceleration": 100.0}
    begin = axis.cycles_gone
    axis.start("Absolute1", Position=sign * 1000.0, Velocity=first, **ramp)
    axis.after(1.0)
    axis.start("Absolute2", Position=sign * 3000.0, Velocity=second, BufferMode=mode, **ramp)
    axis.until(lambda: sign * axis.position >= 1000.0)
    assert sign * axis.velocity == pytest.approx(passing, abs=0.11)
    if at_target is not None:
        assert (axis.cycles_gone - begin) * CYCLE == pytest.approx(at_target, abs=TWO_CYCLES)
    assert axis.until_done("Absolute1") <= TWO_CYCLES
    assert axis.outputs("Absolute2") == {"Busy", "Active"}
    axis.until_done("Absolute2")
    assert (axis.cycles_gone - begin) * CYCLE == pytest.approx(total, abs=4 * CYCLE)
    assert axis.position == sign * 3000.0


def test_a_command_that_does_not_wait(axis: OneAxis) -> None:
    """SEQ-01, ax3000 EX-AX-04, Aborting: at 5 s and 450 u the second takes over, and the whole takes 19 s."""
    begin = axis.cycles_gone
    axis.start("Absolute1", Position=1000.0, **RAMP)
    axis.after(5.0 - CYCLE)
    assert (axis.position, axis.velocity) == (pytest.approx(450.0, abs=1e-6), pytest.approx(100.0))
    axis.start("Absolute2", Position=3000.0, Velocity=200.0, Acceleration=100.0, Deceleration=100.0)
    slowest = axis.velocity
    axis.cycle()
    assert axis.outputs("Absolute1") == {"CommandAborted"}
    while axis.position < 1000.0:
        slowest = min(slowest, axis.velocity)
        axis.cycle()
    assert slowest >= 100.0
    axis.until_done("Absolute2")
    assert (axis.cycles_gone - begin) * CYCLE == pytest.approx(19.0, abs=4 * CYCLE)


def test_blending_does_not_pass_a_target_that_the_next_motion_cannot_stop_behind(axis: OneAxis) -> None:
    """The velocity there is what 10 u suffice to brake from: sqrt(2 * 100 * 10)."""
    axis.start("Absolute1", Position=1000.0, **RAMP)
    axis.start("Absolute2", Position=1010.0, BufferMode=HIGH, **RAMP)
    highest = 0.0
    while "Done" not in axis.outputs("Absolute2"):
        if axis.position >= 1000.0:
            highest = max(highest, axis.velocity)
        axis.cycle()
        assert axis.position <= 1010.0
    assert highest == pytest.approx(math.sqrt(2000.0), abs=0.2)


def test_blending_stops_where_the_direction_changes(axis: OneAxis) -> None:
    axis.start("Absolute1", Position=1000.0, **RAMP)
    axis.start("Absolute2", Position=0.0, BufferMode=HIGH, **RAMP)
    highest = 0.0
    while "Done" not in axis.outputs("Absolute2"):
        axis.cycle()
        highest = max(highest, axis.position)
    assert highest <= 1000.0 + 1e-9
    assert axis.position == 0.0


@pytest.mark.parametrize("before", ["Velocity1", "Halt1"])
def test_no_blending_behind_a_motion_without_a_target(axis: OneAxis, before: str) -> None:
    """SEQ-06: refused, the motion goes on."""
    start(axis, "Velocity2")
    axis.after(0.5)
    start(axis, before)
    axis.start("Absolute1", Position=1000.0, BufferMode=HIGH, **RAMP)
    assert axis.text("Absolute1.ErrorID") == "SMC_BLENDING_NOT_SUPPORTED_BY_PREVIOUS_MOVEMENT"
    axis.cycle(2)
    assert "Busy" in axis.outputs(before)


def test_position_is_set_during_a_motion(axis: OneAxis) -> None:
    """motion_semantics EX-14, HOM-10: 600 u are still to go."""
    axis.start("Absolute1", Position=1000.0, **RAMP)
    axis.until(lambda: axis.position >= 400.0 - 1e-6)
    axis.cycle()
    before = axis.number("Axis.fActPosition"), axis.position
    axis.start("SetPosition1", Position=0.0)
    assert axis.outputs("SetPosition1") == {"Done"}
    axis.until_done("Absolute1")
    assert axis.position == pytest.approx(1000.0 - before[1], abs=1e-9)
    axis.set("SetPosition1", Execute=False)
    axis.cycle()
    axis.start("SetPosition1", Position=10.0, Mode=True)
    axis.cycle()
    assert axis.position == pytest.approx(1010.0 - before[1], abs=1e-9)


def test_a_move_by_nothing_needs_no_velocity(axis: OneAxis) -> None:
    """ax3000 EX-AX-03."""
    axis.start("Relative1", Distance=50.0, Velocity=0.0, Acceleration=1.0, Deceleration=1.0)
    assert (axis.outputs("Relative1"), axis.text("Relative1.ErrorID")) == (
        {"Error"},
        "SMC_MR_INVALID_VELACC_VALUES",
    )
    axis.set("Relative1", Execute=False)
    axis.cycle()
    axis.start("Relative1", Velocity=10.0, Acceleration=0.0)
    assert axis.text("Relative1.ErrorID") == "SMC_MR_INVALID_VELACC_VALUES", "CONFLICT-01"
    axis.set("Relative1", Execute=False)
    axis.cycle()
    axis.start("Relative1", Distance=0.0, Velocity=0.0, Acceleration=1.0)
    assert axis.until_done("Relative1", 0.01) <= TWO_CYCLES
    assert (axis.state, axis.position) == ("standstill", 0.0)


@pytest.mark.parametrize("ramp", range(4))
@pytest.mark.parametrize(("direction", "sign"), [(1, 1.0), (-1, -1.0), (2, 1.0), (2, -1.0)])
def test_a_rotary_axis_that_cannot_stop_in_time_goes_around_once_more(
    axis: OneAxis, direction: int, sign: float, ramp: int
) -> None:
    """PRO-04: a direction is never left on the way to the target."""
    axis.set("Axis", iMovementType=0, fPositionPeriod=360.0, eRampType=ramp)
    moving = {"Velocity": 100.0, "Acceleration": 100.0, "Deceleration": 100.0, "Jerk": 1000.0}
    axis.start("Velocity1", Direction=int(sign), **moving)
    axis.until(lambda: "InVelocity" in axis.outputs("Velocity1"))
    target = (axis.position + sign * 5.0) % 360.0
    turned, before = 0.0, axis.position
    axis.start("Absolute1", Position=target, Direction=direction, **moving)
    while "Done" not in axis.outputs("Absolute1"):
        assert sign * axis.velocity >= -1e-9
        turned += (axis.position - before + 180.0) % 360.0 - 180.0
        before = axis.position
        axis.cycle()
    turned += (axis.position - before + 180.0) % 360.0 - 180.0
    assert turned == pytest.approx(sign * 365.0, abs=1e-6)
    assert axis.position == pytest.approx(target, abs=1e-9)
