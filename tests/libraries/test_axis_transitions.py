"""The transition table of the specification: every function block in every state of an axis.

The table is `tests/spec/data/axis_transitions.csv`: its cells as they are printed, and what PLCopen or
another part of the specification says of the blocks that it does not name. Blocks of the library that are
in no row leave the state as it is (STA-17). All of it holds for an axis without a drive and for one with a
drive.
"""

from __future__ import annotations

import csv
import re
from collections.abc import Iterator
from pathlib import Path

import pytest
from tests.libraries.every_block import (
    BLOCKS,
    LIBRARY,
    MOVED_BY,
    Machine,
    begin_pin,
    bring,
    good_inputs,
    machine,
    moves_an_axis,
)
from tests.libraries.one_axis import STATES

NUMBERS = {value.name: int(value.value) for value in LIBRARY["SMC_ERROR"].values}
STATE_NAMES = {name.removesuffix("_motion"): name for name in STATES}
PROFILES = ("MC_PositionProfile", "MC_VelocityProfile", "MC_AccelerationProfile")
BY_CATALOG = {("MC_Home", "errorstop"): "err 174"} | {
    (block, state): "err 34"
    for block in PROFILES
    for state in ("discrete_motion", "continuous_motion", "synchronized_motion")
}
"""What the catalog says of a block wins over the table: MC_Home has an error of its own there, and profiles
begin in standstill alone (ax3000 AST-15)."""


def _table() -> dict[str, dict[str, str]]:
    path = Path(__file__).parents[1] / "spec" / "data" / "axis_transitions.csv"
    with path.open(encoding="utf-8") as file:
        return {block: row for row in csv.DictReader(file) for block in row["commands"].split()}


def _has(block: str, output: str) -> bool:
    return any(pin.name in (output, f"b{output}") for pin in BLOCKS[block].outputs)


TABLE = _table()
NO_OWNERS = {
    *(
        "MC_MoveSuperImposed",
        "MC_Phasing",
        "MC_PhasingAbsolute",
        "MC_PhasingRelative",
    ),  # over the motion of others
    *("MC_TorqueControl", "SMC_SetControllerMode", "MC_ImmediateStop"),  # no motion in position control
}
"""Blocks with CommandAborted that have no axis for themselves here."""
OWN_TESTS = {"MC_Power": "below", "SMC3_ReinitDrive": "test_drive_restart", "SMC_SetTorque": "below"}
LEAVE_THE_STATE = sorted(name for name in BLOCKS if moves_an_axis(name) and name not in {*TABLE, *OWN_TESTS})


@pytest.fixture(scope="module", params=["virtual", "drive"])
def found(request: pytest.FixtureRequest) -> Iterator[Machine]:
    with machine(request.param) as running:
        yield running


def _start(found: Machine, block: str) -> None:
    """In front of its cycle."""
    found.set(block, **good_inputs(block), **{str(begin_pin(block)): True})


def _ended(told: set[str], output: str) -> bool:
    return bool(told & {output, f"b{output}"})


def test_every_block_that_is_given_an_axis_is_in_the_table_or_leaves_the_state() -> None:
    assert {name for name in TABLE if name not in BLOCKS} == set()
    for name in LEAVE_THE_STATE:
        assert not _has(name, "CommandAborted") or name in ("MC_HaltSuperimposed", "MC_TouchProbe"), name


@pytest.mark.parametrize("state", STATES)
@pytest.mark.parametrize("block", TABLE)
def test_a_command_in_a_state(found: Machine, block: str, state: str) -> None:
    """motion_semantics 2.2, STA-06 to STA-12, STA-15: taken or refused, in the cycle of the edge."""
    cell = BY_CATALOG.get((block, state), TABLE[block][state])
    bring(found, state)
    owner = MOVED_BY.get(state)
    if block == "MC_GearInPos":
        found.set("MasterRuns", Execute=True)
        found.cycle(20)
    _start(found, block)
    found.cycle()
    told, error = found.says(block), found.error(block)
    if re.search(r"\berr\b", cell):
        numbers = {int(number) for number in re.findall(r"\d+", cell)}
        assert {name.removeprefix("b") for name in told} == {"Error"}
        assert not numbers or NUMBERS[error] in numbers, error
        found.cycle(5)
        assert found.state == state
        assert owner is None or not _ended(found.says(owner), "CommandAborted")
        return
    assert (error, _ended(told, "Error")) == ("SMC_NO_ERROR", False)
    if block == "MC_Reset":
        found.until(lambda: _ended(found.says(block), "Done"), 200)
        assert found.state == "standstill"
        return
    if block == "MC_Home" and found.kind == "virtual":
        assert found.state in ("homing", "standstill"), "without a drive it is home at once"
        return
    assert found.state == STATE_NAMES[re.split(r"[ ,]", cell)[0]]
    found.cycle()
    if "Done at once" in cell:
        assert _ended(found.says(block), "Done")
    elif owner is not None and block != "MC_ImmediateStop":
        unchanged = "unchanged" in cell
        assert _ended(found.says(owner), "CommandAborted") != unchanged
        assert not unchanged or _ended(found.says(owner), "Busy")
    if "later" in cell:
        found.until(lambda: found.state == "continuous_motion")
        found.cycle()
        assert _ended(found.says(block), "InEndVelocity")
    if "then standstill" in cell:
        assert found.state == "stopping"
        found.set(block, Execute=False)
        found.cycle(2)
        assert found.state == "standstill"


RUNNING = [
    block
    for block, row in TABLE.items()
    if row["standstill"] and _has(block, "CommandAborted") and block not in NO_OWNERS
]


@pytest.mark.parametrize("running", RUNNING)
def test_which_command_interrupts_which(found: Machine, running: str) -> None:
    """SEQ-01, EXE-09, EXE-10: by the state that the running command has brought, a cycle later at most."""
    for other in TABLE:
        bring(found, "continuous_motion" if running in ("MC_Halt", "MC_Stop") else "standstill")
        found.set("MasterRuns", Execute=True)
        found.cycle(20)
        _start(found, running)
        found.cycle(5)
        state = found.state
        if running == "MC_Home" and found.kind == "virtual":
            assert state == "standstill", "without a drive it is home at once"
            return
        assert _ended(found.says(running), "Busy"), running
        cell = BY_CATALOG.get((other, state), TABLE[other][state])
        found.set(f"{other}2", **good_inputs(other), **{str(begin_pin(other)): True})
        found.cycle(2)
        told = found.says(running)
        message = f"{other} in {state}: {running} says {told}, {other} says {found.says(other + '2')}"
        if other == "MC_ImmediateStop":
            assert _ended(told, "Error"), message
        elif re.search(r"\berr\b", cell) or "unchanged" in cell:
            assert _ended(told, "Busy"), message
            assert not _ended(told, "CommandAborted"), message
        else:
            assert {name.removeprefix("b") for name in told} == {"CommandAborted"}, message


@pytest.mark.parametrize("state", STATES)
@pytest.mark.parametrize("block", LEAVE_THE_STATE)
def test_what_is_no_command_leaves_the_state(found: Machine, block: str, state: str) -> None:
    """STA-17: whatever the block says, the axis stays in its state, and its command goes on."""
    bring(found, state)
    _start(found, block)
    found.cycle(5)
    assert found.state == state
    if state in MOVED_BY:
        assert _ended(found.says(MOVED_BY[state]), "Busy")


@pytest.mark.parametrize("state", STATES)
def test_power_off_in_a_state(found: Machine, state: str) -> None:
    """STA-04, PWR-02: power_off from every state but errorstop; a command that ran fails with 33."""
    bring(found, state)
    found.set("Power", bRegulatorOn=False)
    found.cycle(3)
    assert found.state == ("errorstop" if state == "errorstop" else "power_off")
    if state in MOVED_BY:
        told = found.says(MOVED_BY[state])
        assert (_ended(told, "Error"), _ended(told, "Busy")) == (True, False)
        assert found.error(MOVED_BY[state]) == "SMC_FB_ACTIVE_AXIS_DISABLED"


@pytest.mark.parametrize("state", STATES)
def test_power_on_in_a_state(found: Machine, state: str) -> None:
    """STA-03: a second MC_Power that says the same changes nothing, and powers an axis that has no power."""
    bring(found, state)
    if state == "power_off":
        found.set("Power", Enable=True, bRegulatorOn=True, bDriveStart=True)
    found.set("MC_Power", Enable=True, bRegulatorOn=True, bDriveStart=True)
    found.cycle(12)
    assert found.state == ("standstill" if state == "power_off" else state)


@pytest.mark.parametrize("state", STATES)
def test_an_error_of_the_axis_in_a_state(found: Machine, state: str) -> None:
    """STA-13, ERR-08: MC_ImmediateStop is an error without a ramp; commands fail until the axis is reset."""
    if state == "power_off":
        pytest.skip("without power nothing can be stopped")
    bring(found, state)
    found.set("MC_ImmediateStop", Execute=True)
    found.cycle(2)
    assert found.state == "errorstop"
    if state in MOVED_BY:
        assert _ended(found.says(MOVED_BY[state]), "Error")
    found.set("MC_MoveVelocity", Execute=True, **good_inputs("MC_MoveVelocity"))
    found.cycle(2)
    assert found.error("MC_MoveVelocity") == "SMC_AXIS_NOT_READY_FOR_MOTION"


def test_reset_without_power_ends_in_power_off(found: Machine) -> None:
    """STA-14, ax3000 AST-04."""
    bring(found, "errorstop")
    found.set("Power", bRegulatorOn=False)
    found.cycle(20)
    found.set("MC_Reset", Execute=True)
    found.until(lambda: "Done" in found.says("MC_Reset"), 200)
    assert found.state == "power_off"


def test_a_torque_in_torque_mode_is_a_continuous_motion() -> None:
    """PLCopen part 1, MC_TorqueControl; SMC_SetTorque leaves standstill too (TRQ-05)."""
    with machine("drive") as found:
        for block in ("MC_TorqueControl", "SMC_SetTorque"):
            bring(found, "standstill")
            found.set("OtherMode", bExecute=True, nControllerMode="SMC_CONTROLLER_MODE.SMC_torque")
            found.until(lambda: "bDone" in found.says("OtherMode"), 20)
            _start(found, block)
            found.cycle()
            assert (found.state, found.error(block)) == ("continuous_motion", "SMC_NO_ERROR")
