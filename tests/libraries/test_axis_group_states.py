"""The states of an axis group: every event in every state, as the table has it (axis_group 2)."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any

import numpy as np
import pytest
from tests.libraries.axis_group import AXES, ERRORS, STATES, AxisGroup, axis_group

DYNAMICS: dict[str, Any] = {
    "Velocity": 100.0,
    "Acceleration": 200.0,
    "Deceleration": 200.0,
    "Jerk": 2000.0,
    "CoordSystem": 0,
}
FAR: dict[str, Any] = {"Position": (300.0, 200.0, 100.0), **DYNAMICS}
BRAKE: dict[str, Any] = {"Deceleration": 200.0, "Jerk": 2000.0}
POSITION: dict[str, Any] = {"Position": (1.0, 2.0, 3.0), "CoordSystem": 0}


@pytest.fixture
def group() -> Iterator[AxisGroup]:
    with axis_group(enabled=False) as one:
        yield one


def bring(group: AxisGroup, state: str) -> None:
    """The group into a state."""
    if state != "GroupDisabled":
        group.start("Enable")
    if state in ("GroupMoving", "GroupErrorStop", "GroupStopping"):
        group.start("Linear4", **FAR)
        group.after(0.5)
    if state == "GroupStopping":
        group.give("Stop2", **BRAKE)
    if state == "GroupErrorStop":
        group.write("Y.bRegulatorOn", False)
        group.put("Power", bRegulatorOn=False)
    if state == "GroupHoming":
        group.give("Home", **POSITION)
    group.cycle()
    if state == "GroupErrorStop":
        group.cycle()
        group.put("Power", bRegulatorOn=True)
        group.after(2.0)
    assert group.state == state


EVENTS: dict[str, tuple[str, dict[str, Any]]] = {
    "enable": ("Enable", {}),
    "disable": ("Disable", {}),
    "linear": ("Linear1", FAR),
    "linear buffered": ("Linear1", {**FAR, "BufferMode": 1}),
    "relative": ("Relative1", {"Distance": (300.0, 0.0, 0.0), **DYNAMICS}),
    "circular": (
        "Circular1",
        {"AuxPoint": (300.0, 300.0, 0.0), "EndPoint": (600.0, 0.0, 50.0), "BufferMode": 1, **DYNAMICS},
    ),
    "direct": ("Direct1", {"Position": (300.0, 200.0, 100.0), "CoordSystem": 0}),
    "wait": ("Wait", {"WaitTime": 1.0, "BufferMode": 1}),
    "halt": ("Halt", BRAKE),
    "stop": ("Stop1", BRAKE),
    "interrupt": ("Interrupt1", BRAKE),
    "continue": ("GoOn", {}),
    "home": ("Home", POSITION),
    "reset": ("Reset", {}),
    "remove": ("Remove", {"IdentInGroup": 3}),
    "ungroup": ("Ungroup", {}),
    "set position": ("SetPosition", POSITION),
}
TOO_FAST = 40
"""SMC_VD_MAX_VELOCITY_EXCEEDED."""
MOVEMENTS = ("linear", "linear buffered", "relative", "circular", "direct", "wait")
LEADS: dict[tuple[str, str], str] = {
    ("GroupDisabled", "enable"): "GroupStandby",
    ("GroupDisabled", "disable"): "GroupDisabled",
    ("GroupDisabled", "reset"): "GroupDisabled",
    ("GroupDisabled", "remove"): "GroupDisabled",
    ("GroupDisabled", "ungroup"): "GroupDisabled",
    ("GroupDisabled", "set position"): "GroupDisabled",
    **{("GroupStandby", movement): "GroupMoving" for movement in MOVEMENTS},
    ("GroupStandby", "enable"): "GroupStandby",
    ("GroupStandby", "disable"): "GroupDisabled",
    ("GroupStandby", "stop"): "GroupStopping",
    ("GroupStandby", "home"): "GroupHoming",
    ("GroupStandby", "reset"): "GroupStandby",
    ("GroupStandby", "set position"): "GroupStandby",
    **{("GroupMoving", movement): "GroupMoving" for movement in MOVEMENTS},
    ("GroupMoving", "enable"): "GroupMoving",
    ("GroupMoving", "halt"): "GroupMoving",
    ("GroupMoving", "stop"): "GroupStopping",
    ("GroupMoving", "interrupt"): "GroupMoving",
    ("GroupMoving", "reset"): "GroupMoving",
    ("GroupStopping", "enable"): "GroupStopping",
    ("GroupStopping", "reset"): "GroupStopping",
    ("GroupStopping", "interrupt"): "GroupStopping",
    ("GroupHoming", "enable"): "GroupHoming",
    ("GroupHoming", "reset"): "GroupHoming",
    ("GroupHoming", "stop"): "GroupStopping",
    ("GroupErrorStop", "disable"): "GroupDisabled",
    ("GroupErrorStop", "reset"): "GroupErrorStop",
}
"""Where events lead to that a state takes; all others are errors of the block and change nothing."""


@pytest.mark.parametrize("event", EVENTS)
@pytest.mark.parametrize("state", STATES)
def test_every_event_in_every_state(group: AxisGroup, state: str, event: str) -> None:
    """AG-02, AG-06, AG-10 to AG-23: the table, and "every other combination"."""
    if state == "GroupHoming" and event in ("home", "set position"):
        return  # the block is busy, and the axes have their references before the other is called
    bring(group, state)
    block, inputs = EVENTS[event]
    group.give(block, **inputs)
    group.cycle()
    homed = (
        {"GroupStandby"} if state == "GroupHoming" else set[str]()
    )  # a virtual axis has its reference at once
    if (state, event) in LEADS:
        assert group.state in {LEADS[state, event]} | homed
        group.cycle()
        assert not group.flag(f"{block}.Error"), group.error(block)
    else:
        group.cycle()
        assert "Error" in group.outputs(block)
        expected = {"WRONG_STATE", "NOT_INTERRUPTED"} if event == "continue" else {"WRONG_STATE"}
        assert group.error(block) in {ERRORS[name] for name in expected}
        assert group.state in {state} | homed


def test_homing(group: AxisGroup) -> None:
    """AG-20, AG-21: the axes have their references, and the positions of the block."""
    bring(group, "GroupStandby")
    group.give("Home", **POSITION)
    group.cycle()
    group.cycle(3)
    assert group.outputs("Home") == {"Done"}
    assert group.state == "GroupStandby"
    assert group.position == pytest.approx((1, 2, 3))


def test_a_halt_ends_in_standby_and_may_be_followed(group: AxisGroup) -> None:
    """AG-15."""
    bring(group, "GroupMoving")
    group.start("Halt", **BRAKE)
    group.cycle()
    assert group.outputs("Halt") == {"Busy", "Active"}
    assert group.outputs("Linear4") == {"CommandAborted"}
    group.until(lambda: group.state == "GroupStandby", 5.0)
    assert group.path_velocity == 0
    group.start("Linear1", **FAR)
    group.after(0.3)
    group.give("Halt", **BRAKE)
    group.cycle(5)
    before = group.path_velocity
    group.give("Relative1", Distance=(0, 0, 300), **DYNAMICS)
    group.cycle(2)
    assert group.outputs("Halt") == {"CommandAborted"}
    assert group.path_velocity > 0.8 * before
    group.until(lambda: group.done("Relative1"), 20.0)
    assert group.state == "GroupStandby"


def test_a_single_axis_may_move_in_standby(group: AxisGroup) -> None:
    """AG-24, AG-26: it may, but the group must not then."""
    bring(group, "GroupStandby")
    group.give("Single", Position=50.0, Velocity=10.0, Acceleration=100.0, Deceleration=100.0)
    group.after(1.0)
    assert group.state == "GroupStandby"
    assert group.text("Y.nAxisState") == "discrete_motion"
    group.start("Linear1", **FAR)
    assert group.outputs("Linear1") == {"Error"}
    assert group.error("Linear1") == ERRORS["SINGLE_AXIS"]
    assert group.state == "GroupErrorStop"
    assert [group.text(f"{axis}.nAxisState") for axis in AXES] == ["errorstop"] * 3


def _stops_on_its_path(group: AxisGroup, cause: Callable[[], None], reason: int, failed: int) -> None:
    """The axes brake on the line of the group and are in errorstop; a reset brings the group back."""
    bring(group, "GroupStandby")
    group.give("Linear1", **FAR)
    group.give("Linear2", **FAR, BufferMode=2)
    group.after(0.8)
    direction = np.array(FAR["Position"]) / np.linalg.norm(FAR["Position"])
    assert group.path_velocity > 50
    cause()
    group.cycle(2)
    assert group.state == "GroupErrorStop"
    speeds = []
    while group.path_velocity > 0:
        apart = group.position - (group.position @ direction) * direction
        assert np.linalg.norm(apart) < 1e-9
        speeds.append(group.path_velocity)
        group.cycle()
    assert len(speeds) >= 2
    assert np.all(np.diff(speeds) < 0)
    group.cycle(2)
    assert group.velocity == pytest.approx((0, 0, 0), abs=0)
    assert group.outputs("Linear1") == {"Error"}
    assert group.error("Linear1") == reason
    assert group.outputs("Linear2") == {"CommandAborted"}
    group.put("GroupError", Enable=True)
    group.cycle()
    assert int(group.number("GroupError.Axis")) == failed
    assert [group.text(f"{axis}.nAxisState") for axis in AXES] == ["errorstop"] * 3
    for block in ("Single", "Linear1", "Linear2"):
        group.put(block, Execute=False)
    group.give("Reset")
    group.cycle(5)
    assert group.outputs("Reset") == {"Done"}
    assert group.state == "GroupStandby"
    assert [group.text(f"{axis}.nAxisState") for axis in AXES] == ["standstill"] * 3
    group.put("Z", fMaxVelocity=1e5)
    group.start("Linear1", **FAR)
    group.until(lambda: group.done("Linear1"), 20.0)
    assert group.position == pytest.approx(FAR["Position"], abs=1e-12)


def test_a_single_axis_command_stops_the_moving_group(group: AxisGroup) -> None:
    """AG-25."""
    for axis in AXES:
        group.put(axis, fSWMaxDeceleration=500.0)
    inputs = {"Position": 5.0, "Velocity": 10.0, "Acceleration": 100.0, "Deceleration": 100.0}
    _stops_on_its_path(group, lambda: group.give("Single", **inputs), ERRORS["SINGLE_AXIS"], 1)
    assert group.flag("Single.Execute") is False


def test_a_buffered_single_axis_command_stops_it_too(group: AxisGroup) -> None:
    """AG-25."""
    bring(group, "GroupMoving")
    group.give("Single", Position=5.0, Velocity=1.0, Acceleration=1.0, Deceleration=1.0, BufferMode=1)
    group.cycle()
    assert group.state == "GroupErrorStop"


def test_a_fault_of_one_axis_stops_the_group_on_its_path(group: AxisGroup) -> None:
    """AG-04, AG-22: beyond what the drive can, an error of the axis alone."""
    for axis in AXES:
        group.put(axis, fSWMaxDeceleration=500.0)
    _stops_on_its_path(group, lambda: group.put("Z", fMaxVelocity=1.0), TOO_FAST, 2)


def test_axes_of_a_group(group: AxisGroup) -> None:
    """AG-01, AG-02, AG-03, AG-51: an axis is in one group, under one number, while the group is disabled."""
    assert group.number("Group.iAxes") == 3
    group.start("AddElsewhere")
    assert int(group.number("AddElsewhere.ErrorID")) == ERRORS["IN_GROUP"]
    for number in (1, 7, 65535):
        group.put("AddOther", IdentInGroup=number)
        group.start("AddOther")
        assert int(group.number("AddOther.ErrorID")) == ERRORS["INDEX"]
    group.start("Remove", IdentInGroup=2)
    group.cycle()
    assert group.number("Group.iAxes") == 2
    group.put("AddOther", IdentInGroup=0)
    group.start("AddOther")
    group.put("Configuration", Enable=True, IdentInGroup=2)
    group.cycle()
    assert group.flag("Configuration.Valid")
    assert group.number("Group.iAxes") == 3
    group.start("Enable")
    group.start("AddElsewhere")
    group.start("Remove", IdentInGroup=1)
    assert group.error("Remove") == ERRORS["WRONG_STATE"]
    group.start("Disable")
    group.start("Ungroup")
    assert group.number("Group.iAxes") == 0
    group.cycle()
    group.start("Enable")
    assert group.error("Enable") == ERRORS["EMPTY"]


def test_exactly_one_state_is_told() -> None:
    """AG-07."""
    for state in STATES:
        if state == "GroupHoming":
            continue
        with axis_group(enabled=False) as fresh:
            fresh.put("Status", Enable=True)
            bring(fresh, state)
            fresh.cycle()
            assert {name for name in STATES if fresh.flag(f"Status.{name}")} == {state}


def test_axes_without_power_are_not_moved(group: AxisGroup) -> None:
    """AG-10, AG-50 (V-1): a group is enabled without power, but its movements are errors of their blocks."""
    group.power(on=False)
    group.start("Enable")
    assert group.outputs("Enable") == {"Done"}
    group.start("Linear1", **FAR)
    assert group.outputs("Linear1") == {"Error"}
    assert group.error("Linear1") == ERRORS["POWER"]
    assert group.state == "GroupStandby"
