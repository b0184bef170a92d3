"""The PLCopen states of an axis, and the timing of its function blocks to the cycle."""

from __future__ import annotations

import pytest
from tests.libraries.one_axis import RAMP, STATES, TWO_CYCLES, OneAxis, bring, one_axis, start

MOTIONS = ("Absolute1", "Relative1", "Additive1", "Velocity1", "Halt1")
COMMANDS = (*MOTIONS, "Stop1")


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
