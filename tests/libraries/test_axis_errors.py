"""Errors of an axis and of its function blocks, limits, power, and blocks that only read."""

from __future__ import annotations

import math

import pytest
from tests.libraries.one_axis import RAMP, TWO_CYCLES, OneAxis, start


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
    first = axis.text("FBError.pbyErrorInstance"), axis.text("FBError.tTimeStamp")
    axis.write("xClears", True)
    axis.cycle()
    assert axis.text("FBError.nFBErrorID") == "SMC_MV_DIRECTION_NOT_APPLICABLE"
    second = axis.text("FBError.pbyErrorInstance"), axis.text("FBError.tTimeStamp")
    assert int(second[0].replace("16#", "0x"), 0) - int(first[0].replace("16#", "0x"), 0) == int(
        axis.text("diApart")
    ), "the instances"
    assert _milliseconds(second[1]) - _milliseconds(first[1]) == 2, "two cycles later"
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


def _milliseconds(time: str) -> int:
    return int(time.upper().removeprefix("TIME#").removeprefix("T#").removesuffix("MS"))


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


@pytest.mark.parametrize("block", ["Halt1", "Stop1"])
@pytest.mark.parametrize(("avoid", "lowest", "seconds"), [(False, -3.0, 2.095), (True, 0.0, 0.632)])
def test_reversal_on_halt(axis: OneAxis, block: str, avoid: bool, lowest: float, seconds: float) -> None:
    """ax3000 EX-AX-06, AXIS-13: v = 2, a = -10, jerk 10; the velocity passes 0 down to -3 unless avoided."""
    axis.set("Axis", eRampType=2, bAvoidReversalOnHaltStop=avoid)
    axis.start("Velocity1", Velocity=20.0, Acceleration=10.0, Deceleration=10.0, Jerk=10.0)
    axis.after(6.0)
    axis.start("Velocity2", Velocity=1e-3, Acceleration=10.0, Deceleration=10.0, Jerk=1e5)
    axis.until(lambda: axis.velocity <= 2.0)
    assert axis.number("Axis.fSetAcceleration") == pytest.approx(-10.0, abs=0.01)
    axis.start(block, Deceleration=10.0, Jerk=10.0)
    seen = [axis.velocity]

    def gone() -> bool:
        seen.append(axis.velocity)
        return "Done" in axis.outputs(block)

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
