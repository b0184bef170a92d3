"""Function blocks of one axis: states, timing to the cycle, and the worked examples of the specification."""

from __future__ import annotations

import math
from collections.abc import Iterator

import pytest
from tests.libraries.one_axis import CYCLE, RAMP, STATES, OneAxis, one_axis

TWO_CYCLES = 2 * CYCLE + 1e-9
MOTIONS = ("Absolute1", "Relative1", "Additive1", "Velocity1", "Halt1")
COMMANDS = (*MOTIONS, "Stop1")


@pytest.fixture
def axis() -> Iterator[OneAxis]:
    with one_axis() as one:
        yield one


def start(axis: OneAxis, block: str) -> None:
    """With inputs that suit every axis."""
    inputs: dict[str, float] = dict(RAMP)
    if block.startswith(("Halt", "Stop")):
        inputs = {"Deceleration": 100.0}
    if block.startswith("Absolute"):
        inputs["Position"] = axis.position + 1000.0
    if block.startswith(("Relative", "Additive")):
        inputs["Distance"] = 1000.0
    axis.start(block, **inputs)


def bring(axis: OneAxis, state: str) -> None:
    """The axis into a state."""
    if state == "power_off":
        axis.power(on=False)
    elif state == "errorstop":
        start(axis, "Velocity2")
        axis.write("sSkipped", "Velocity2")
        axis.cycle(2)
        axis.write("sSkipped", "")
        axis.set("Velocity2", Execute=False)
        axis.cycle(2)
    elif state == "stopping":
        start(axis, "Velocity2")
        axis.set("Velocity2", Execute=False)
        axis.after(0.5)
        start(axis, "Stop2")
    elif state == "discrete_motion":
        start(axis, "Absolute2")
        axis.after(0.1)
    elif state == "continuous_motion":
        start(axis, "Velocity2")
        axis.after(0.1)
    assert axis.state == state


def test_an_axis_begins_without_power() -> None:
    """STA-02, STA-03: standstill as soon as the drive has power."""
    with one_axis(power=False) as axis:
        assert axis.state == "power_off"
        assert axis.says("Power", "Status", "Busy", "Error") == set()
        axis.power()
        assert axis.state == "standstill"
        assert axis.says("Power", "Status", "bRegulatorRealState", "bDriveStartRealState", "Error") == {
            *("Status", "bRegulatorRealState", "bDriveStartRealState")
        }


def test_exactly_one_state_is_told(axis: OneAxis) -> None:
    """STA-01."""
    names = (
        *("Disabled", "Errorstop", "Stopping", "StandStill"),
        *("DiscreteMotion", "ContinuousMotion", "SynchronizedMotion", "Homing"),
    )
    seen = set()

    def check() -> None:
        axis.cycle()
        (told,) = axis.says("Status", *names)
        assert names.index(told) == STATES.index(axis.state)
        seen.add(told)

    check()
    start(axis, "Absolute1")
    check()
    start(axis, "Velocity1")
    check()
    start(axis, "Stop1")
    check()
    axis.power(on=False)
    check()
    assert seen == {"StandStill", "DiscreteMotion", "ContinuousMotion", "Stopping", "Disabled"}


EXPECTED = {
    "power_off": dict.fromkeys(COMMANDS, "SMC_REGULATOR_OR_START_NOT_SET"),
    "errorstop": dict.fromkeys(MOTIONS, "SMC_AXIS_NOT_READY_FOR_MOTION")
    | {"Stop1": "SMC_MS_AXIS_IN_ERRORSTOP"},
    "stopping": dict.fromkeys(MOTIONS, "SMC_AXIS_NOT_READY_FOR_MOTION")
    | {"Stop1": "SMC_MS_AXIS_ALREADY_STOPPING"},
}
NEXT = dict.fromkeys(("Absolute1", "Relative1", "Additive1", "Halt1"), "discrete_motion") | {
    "Velocity1": "continuous_motion",
    "Stop1": "stopping",
}


@pytest.mark.parametrize("command", COMMANDS)
@pytest.mark.parametrize("state", ["power_off", "errorstop", "stopping"])
def test_commands_are_refused(axis: OneAxis, state: str, command: str) -> None:
    """STA-15 and the transition table: the block reports it, the axis stays as it is."""
    bring(axis, state)
    start(axis, command)
    assert axis.outputs(command) == {"Error"}
    assert axis.text(f"{command}.ErrorID") == EXPECTED[state][command]
    assert axis.state == state
    axis.cycle(5)
    assert axis.state == state


@pytest.mark.parametrize("command", COMMANDS)
@pytest.mark.parametrize("state", ["standstill", "discrete_motion", "continuous_motion"])
def test_commands_change_the_state(axis: OneAxis, state: str, command: str) -> None:
    """The transition table: the state is that of the command, in the cycle of the edge."""
    bring(axis, state)
    start(axis, command)
    assert axis.outputs(command) == {"Busy"}
    at_once = state == "standstill" and command in ("Halt1", "Stop1")
    assert axis.state == ("standstill" if at_once and command == "Halt1" else NEXT[command])


@pytest.mark.parametrize("block", ["Absolute1", "Relative1", "Additive1"])
def test_timing_of_a_motion(axis: OneAxis, block: str) -> None:
    """Timing table of MC_MoveAbsolute, EXE-06, EXE-07: row by row, to the cycle."""
    axis.cycle()
    assert (axis.outputs(block), axis.state) == (set(), "standstill")
    target = {"Position" if block == "Absolute1" else "Distance": 10.0}
    axis.start(block, **target, **RAMP)
    assert (axis.outputs(block), axis.state) == ({"Busy"}, "discrete_motion")
    axis.cycle()
    assert (axis.outputs(block), axis.state) == ({"Busy", "Active"}, "discrete_motion")
    axis.until(lambda: axis.outputs(block) != {"Busy", "Active"})
    assert (axis.outputs(block), axis.state) == ({"Done"}, "standstill")
    assert axis.position == 10.0
    axis.cycle(3)
    assert axis.outputs(block) == {"Done"}
    axis.set(block, Execute=False)
    axis.cycle()
    assert (axis.outputs(block), axis.state) == (set(), "standstill")


@pytest.mark.parametrize("block", ["Absolute1", "Velocity1", "Halt1"])
def test_results_last_one_cycle_without_execute(axis: OneAxis, block: str) -> None:
    """EXE-04, EXE-07: a falling edge ends nothing; a result is told for one cycle then."""
    start(axis, "Velocity2")
    axis.after(0.5)
    start(axis, block)
    axis.set(block, Execute=False)
    axis.cycle(2)
    assert "Busy" in axis.outputs(block)
    if block == "Velocity1":
        start(axis, "Halt2")
        axis.cycle()
        assert axis.outputs(block) == {"CommandAborted"}
    else:
        axis.until_done(block)
        assert axis.outputs(block) == {"Done"}
    axis.cycle()
    assert axis.outputs(block) == set()


def test_timing_of_stop(axis: OneAxis) -> None:
    """Timing table of MC_Stop, motion_semantics EX-10: the state stays until Execute is FALSE."""
    axis.start("Velocity1", **RAMP)
    axis.until(lambda: "InVelocity" in axis.outputs("Velocity1"))
    axis.start("Stop1", Deceleration=100.0)
    assert (axis.outputs("Stop1"), axis.state) == ({"Busy"}, "stopping")
    axis.cycle()
    assert axis.outputs("Velocity1") == {"CommandAborted"}
    assert axis.until(lambda: "Done" in axis.outputs("Stop1")) == pytest.approx(1.0, abs=TWO_CYCLES)
    assert (axis.outputs("Stop1"), axis.state, axis.velocity) == ({"Busy", "Done"}, "stopping", 0.0)
    axis.set("Velocity1", Execute=False)
    axis.cycle()
    axis.start("Velocity1")
    assert axis.text("Velocity1.ErrorID") == "SMC_AXIS_NOT_READY_FOR_MOTION"
    assert (axis.outputs("Velocity1"), axis.state) == ({"Error"}, "stopping")
    axis.set("Stop1", Execute=False)
    axis.cycle(2)
    assert (axis.outputs("Stop1"), axis.state) == (set(), "standstill")


def test_stop_that_is_let_go_before_standstill(axis: OneAxis) -> None:
    """STA-10: stopping lasts until the velocity is 0."""
    start(axis, "Velocity1")
    axis.after(0.5)
    start(axis, "Stop1")
    axis.set("Stop1", Execute=False)
    axis.cycle()
    assert (axis.outputs("Stop1"), axis.state) == ({"Busy"}, "stopping")
    axis.until_done("Stop1")
    assert (axis.outputs("Stop1"), axis.state, axis.velocity) == ({"Done"}, "standstill", 0.0)


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


@pytest.mark.parametrize("direction", [0, 1, -1])
def test_a_linear_axis_has_one_way(axis: OneAxis, direction: int) -> None:
    """ax3000 EX-AX-02."""
    axis.start("SetPosition1", Position=100.0)
    axis.start("Absolute1", Position=40.0, Direction=direction, **RAMP)
    axis.until_done("Absolute1")
    assert axis.position == 40.0


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


def test_errors_of_blocks_are_kept(axis: OneAxis) -> None:
    """motion_semantics EX-12, ERR-03 to ERR-05: oldest first, until they are taken away."""
    axis.start("Absolute1", Position=10.0, Velocity=1.0, Acceleration=0.0, Deceleration=1.0)
    assert (axis.outputs("Absolute1"), axis.text("Absolute1.ErrorID")) == (
        {"Error"},
        "SMC_MA_INVALID_VELACC_VALUES",
    )
    axis.cycle()
    assert axis.says("Status", "FBErrorOccured") == {"FBErrorOccured"}
    axis.start("Velocity1", Direction=3, **RAMP)
    assert axis.text("Velocity1.ErrorID") == "SMC_MV_DIRECTION_NOT_APPLICABLE"
    axis.cycle()
    assert axis.text("FBError.nFBErrorID") == "SMC_MA_INVALID_VELACC_VALUES"
    axis.write("xClears", True)
    axis.cycle()
    assert axis.text("FBError.nFBErrorID") == "SMC_MV_DIRECTION_NOT_APPLICABLE"
    axis.write("xClears", True)
    axis.cycle()
    assert axis.says("Status", "FBErrorOccured") == set()
    axis.set("Axis", bDisableErrorLogging=True)
    axis.set("Absolute1", Execute=False)
    axis.cycle()
    axis.start("Absolute1")
    axis.cycle()
    assert axis.outputs("Absolute1") == {"Error"}
    assert axis.says("Status", "FBErrorOccured") == set()


@pytest.mark.parametrize("value", [0.0, -1.0, math.nan, math.inf])
@pytest.mark.parametrize("name", ["Velocity", "Acceleration", "Deceleration"])
@pytest.mark.parametrize(
    ("block", "error"),
    [
        ("Absolute1", "SMC_MA_INVALID_VELACC_VALUES"),
        ("Relative1", "SMC_MR_INVALID_VELACC_VALUES"),
        ("Additive1", "SMC_MAD_INVALID_VELACC_VALUES"),
        ("Velocity1", "SMC_MV_INVALID_ACCDEC_VALUES"),
    ],
)
def test_values_that_are_no_limits(axis: OneAxis, block: str, error: str, name: str, value: float) -> None:
    """EXE-10, EXE-13: the block reports it, a running motion goes on."""
    start(axis, "Velocity2")
    axis.after(2.0)
    axis.start(block, **{**RAMP, name: value})
    assert axis.outputs(block) == {"Error"}
    assert axis.text(f"{block}.ErrorID") == error
    axis.cycle(10)
    assert (axis.state, axis.velocity) == ("continuous_motion", 100.0)


@pytest.mark.parametrize("block", ["Absolute1", "Relative1"])
def test_a_running_motion_outlives_a_wrong_edge_of_its_block(axis: OneAxis, block: str) -> None:
    """EXE-10: the axis keeps its motion and its state."""
    start(axis, block)
    axis.after(0.5)
    axis.set(block, Execute=False)
    axis.cycle()
    axis.start(block, Velocity=0.0)
    assert axis.outputs(block) == {"Error"}
    axis.after(0.5)
    assert (axis.state, axis.outputs(block)) == ("discrete_motion", {"Error"})
    axis.until(lambda: axis.state == "standstill")


@pytest.mark.parametrize(("block", "error"), [("Velocity1", 30), ("Stop1", 184)])
def test_a_block_that_is_not_called(axis: OneAxis, block: str, error: int) -> None:
    """CAL-02, CAL-03, ERR-06, ERR-07: errorstop, until the axis is reset."""
    axis.set("Axis", fSWMaxDeceleration=50.0)
    start(axis, "Velocity1")
    axis.after(2.0)
    if block == "Stop1":
        start(axis, "Stop1")
    axis.write("sSkipped", block)
    axis.cycle(2)
    assert axis.state == "errorstop"
    assert axis.number("AxisError.AxisErrorID") == error
    axis.write("sSkipped", "")
    axis.cycle()
    assert axis.outputs(block) == {"Error"}
    before = axis.velocity
    axis.after(0.5)
    assert before - axis.velocity == pytest.approx(25.0, abs=0.1)
    axis.start("Reset1")
    assert axis.outputs("Reset1") == {"Busy"}
    axis.until_done("Reset1")
    assert (axis.state, axis.velocity) == ("standstill", 0.0)
    axis.start("Reset2")
    assert axis.text("Reset2.ErrorID") == "SMC_R_NO_ERROR_TO_RESET"


def test_power_goes_during_a_motion(axis: OneAxis) -> None:
    """STA-04, ERR-09."""
    start(axis, "Velocity1")
    axis.after(0.5)
    axis.set("Power", bRegulatorOn=False)
    axis.cycle(2)
    assert (axis.state, axis.velocity, axis.outputs("Velocity1")) == ("power_off", 0.0, {"Error"})
    assert axis.text("Velocity1.ErrorID") == "SMC_FB_ACTIVE_AXIS_DISABLED"
    assert axis.says("Power", "Status") == set()
    axis.power()
    assert axis.state == "standstill"


def test_quick_stop(axis: OneAxis) -> None:
    """STA-18, PWR-03: it decelerates and holds its position, and can move again behind it."""
    axis.set("Axis", fSWMaxDeceleration=200.0)
    start(axis, "Velocity1")
    axis.after(2.0)
    axis.set("Power", bDriveStart=False)
    axis.cycle(2)
    assert (axis.state, axis.outputs("Velocity1")) == ("stopping", {"Error"})
    assert axis.until(lambda: axis.velocity == 0.0) == pytest.approx(0.5, abs=TWO_CYCLES)
    here = axis.position
    start(axis, "Absolute1")
    assert axis.text("Absolute1.ErrorID") == "SMC_REGULATOR_OR_START_NOT_SET"
    axis.cycle(10)
    assert axis.position == here
    axis.set("Power", bDriveStart=True)
    axis.cycle(3)
    assert axis.state == "standstill"
    assert axis.says("Power", "Status") == {"Status"}


@pytest.mark.parametrize(
    ("settings", "error"),
    [
        ({"fMaxVelocity": 50.0}, 40),
        ({"fMaxAcceleration": 50.0}, 41),
        ({"fMaxDeceleration": 50.0}, 42),
    ],
)
def test_limits_of_the_virtual_drive(axis: OneAxis, settings: dict[str, float], error: int) -> None:
    """PRO-03, ERR-10."""
    axis.set("Axis", **settings)
    axis.start("Absolute1", Position=1000.0, **RAMP)
    axis.until(lambda: axis.state == "errorstop")
    axis.cycle()
    assert axis.number("AxisError.AxisErrorID") == error
    assert axis.outputs("Absolute1") == {"Error"}


@pytest.mark.parametrize(
    ("settings", "deceleration"),
    [
        ({"fSWLimitDeceleration": 200.0, "fSWMaxDeceleration": 300.0, "fSWErrorMaxDistance": 10.0}, 500.0),
        ({"fSWLimitDeceleration": 200.0, "fSWMaxDeceleration": 1000.0, "fSWErrorMaxDistance": 10.0}, 1000.0),
        ({"fSWLimitDeceleration": 400.0, "fSWMaxDeceleration": 300.0}, 400.0),
    ],
)
def test_software_limits(axis: OneAxis, settings: dict[str, float], deceleration: float) -> None:
    """PRO-06, STA-16, ax3000 EX-AX-07: it brakes with the largest of three decelerations, and comes back."""
    axis.set("Axis", bSWLimitEnable=True, fSWLimitPositive=200.0, fSWLimitNegative=-200.0, **settings)
    start(axis, "Velocity1")
    axis.until(lambda: axis.state == "errorstop")
    assert 200.0 < axis.position <= 200.2
    axis.cycle()
    assert axis.number("AxisError.AxisErrorID") == 10
    assert axis.says("AxisError", "SWEndSwitchActive") == {"SWEndSwitchActive"}
    assert axis.until(lambda: axis.velocity == 0.0) == pytest.approx(100.0 / deceleration, abs=TWO_CYCLES)
    axis.start("Reset1")
    axis.until_done("Reset1")
    axis.start("Absolute1", Position=0.0, **RAMP)
    axis.until_done("Absolute1")
    assert axis.position == 0.0


@pytest.mark.parametrize(("avoid", "lowest", "seconds"), [(False, -3.0, 2.095), (True, 0.0, 0.632)])
def test_reversal_on_halt(axis: OneAxis, avoid: bool, lowest: float, seconds: float) -> None:
    """ax3000 EX-AX-06: v = 2, a = -10, jerk 10; the velocity passes 0 down to -3 unless that is avoided."""
    axis.set("Axis", eRampType=2, bAvoidReversalOnHaltStop=avoid)
    axis.start("Velocity1", Velocity=20.0, Acceleration=10.0, Deceleration=10.0, Jerk=10.0)
    axis.after(6.0)
    axis.start("Velocity2", Velocity=1e-3, Acceleration=10.0, Deceleration=10.0, Jerk=1e5)
    axis.until(lambda: axis.velocity <= 2.0)
    assert axis.number("Axis.fSetAcceleration") == pytest.approx(-10.0, abs=0.01)
    axis.start("Halt1", Deceleration=10.0, Jerk=10.0)
    seen = [axis.velocity]

    def gone() -> bool:
        seen.append(axis.velocity)
        return "Done" in axis.outputs("Halt1")

    assert axis.until(gone) == pytest.approx(seconds, abs=0.01)
    assert min(seen) == pytest.approx(lowest, abs=0.02)


def test_readers_of_an_axis_without_a_bus(axis: OneAxis) -> None:
    """ENA-03: the error stays as long as its cause."""
    axis.write("xStopsBus", True)
    axis.set("Axis", wCommunicationState=0)
    axis.cycle()
    for reader in ("Actual", "SetValue", "Status", "AxisError"):
        assert axis.says(reader, "Valid", "Busy", "Error") == {"Busy", "Error"}
        assert axis.text(f"{reader}.ErrorID") == "SMC_AXIS_IS_NOT_OPERATIONAL"
    axis.write("xStopsBus", False)
    axis.cycle()
    assert axis.says("Status", "Valid", "Error", "StandStill") == {"Valid", "StandStill"}


def test_readers_keep_or_drop_their_values(axis: OneAxis) -> None:
    """ENA-01, ENA-02."""
    axis.start("Absolute1", Position=50.0, **RAMP)
    axis.until_done("Absolute1")
    axis.cycle(2)
    assert (axis.number("Actual.Position"), axis.number("SetValue.Position")) == (50.0, 50.0)
    axis.write("xReads", False)
    axis.start("Absolute2", Position=0.0, **RAMP)
    axis.until_done("Absolute2")
    assert axis.says("Actual", "Valid", "Busy") == axis.says("Status", "Valid", "StandStill") == set()
    assert (axis.number("Actual.Position"), axis.number("SetValue.Position")) == (50.0, 50.0)
