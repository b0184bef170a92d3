"""SMC_ChangeGearingRatio, SMC3_ReinitDrive and MC_ImmediateStop on an axis with a drive."""

from __future__ import annotations

import pytest
from tests.libraries.mapped_axis import DEGREES, FAST, axis, cycles, number, state, switch_on


def test_another_scaling_counts_from_the_restart_of_the_drive() -> None:
    """A spindle of 10 mm behind a gear of 10:1 (ax3000 AXIS-08)."""
    with axis(place=2 * 1048576) as program:
        program.set(
            "Main.Ratio",
            bExecute=True,
            dwRatioTechUnitsDenom=10485760,
            iRatioTechUnitsNum=10,
            iMovementType="SMC_MOVEMENTTYPE.linear",
        )
        program.cycle()
        assert program.literal("Main.Ratio.bDone") == "TRUE"
        assert number(program, "Axis.fScalefactor") == 1048576
        assert number(program, "Axis.fActPosition") == pytest.approx(209715.2), "not yet"
        program.set("Main.Reinit", bExecute=True)
        cycles(program, 3)
        assert program.literal("Main.Reinit.bDone") == "TRUE"
        assert number(program, "Axis.fActPosition") == pytest.approx(2.0)
        switch_on(program)
        program.set("Main.Move", Execute=True, Position=3.0, Velocity=5.0)
        cycles(program, 300)
        assert number(program, "liPlace") == 3 * 1048576


@pytest.mark.parametrize(
    ("inputs", "error"),
    [
        ({"dwRatioTechUnitsDenom": 0, "iRatioTechUnitsNum": 1}, "SMC_CGR_ZERO_VALUES"),
        ({"dwRatioTechUnitsDenom": 1, "iRatioTechUnitsNum": 0}, "SMC_CGR_ZERO_VALUES"),
        ({"dwRatioTechUnitsDenom": 1, "iRatioTechUnitsNum": 1}, "SMC_CGR_INVALID_POSPERIOD"),
        (
            {"dwRatioTechUnitsDenom": 1, "iRatioTechUnitsNum": 1, "fPositionPeriod": -360.0},
            "SMC_CGR_INVALID_POSPERIOD",
        ),
    ],
)
def test_scalings_that_are_none_are_refused(inputs: dict[str, float], error: str) -> None:
    with axis() as program:
        before = program.literal("Main.Axis.iRatioTechUnitsNum")
        program.set("Main.Ratio", bExecute=True, **inputs)
        program.cycle()
        assert program.literal("Main.Ratio.nErrorID") == error
        assert program.literal("Main.Axis.iRatioTechUnitsNum") == before


def test_the_scaling_of_a_powered_drive_stays() -> None:
    with axis() as program:
        switch_on(program)
        program.set("Main.Ratio", bExecute=True, dwRatioTechUnitsDenom=1, iRatioTechUnitsNum=1)
        program.cycle()
        assert program.literal("Main.Ratio.nErrorID") == "SMC_CGR_DRIVE_POWERED"


def test_a_restart_with_the_same_scaling_keeps_the_position() -> None:
    with axis(place=500) as program:
        program.set("Main.Place", Execute=True, Position=-7.0)
        cycles(program, 2)
        program.set("Main.Reinit", bExecute=True)
        cycles(program, 3)
        assert program.literal("Main.Reinit.bDone") == "TRUE"
        assert number(program, "Axis.fActPosition") == pytest.approx(-7.0)


def test_an_axis_becomes_virtual_and_real_again() -> None:
    with axis(f"{DEGREES}, {FAST}", place=500) as program:
        program.set("Main.Reinit", bExecute=True, bVirtual=True)
        cycles(program, 3)
        switch_on(program)
        program.set("Main.Move", Execute=True, Position=90.0)
        cycles(program, 20)
        program.set("Main.Reinit", bExecute=False)
        program.cycle()
        program.set("Main.Reinit", bExecute=True, bVirtual=False)
        program.cycle()
        assert program.literal("Main.Reinit.nErrorID") == "SMC_AXIS_NOT_READY_FOR_MOTION"
        cycles(program, 600)
        assert program.literal("Main.Move.Done") == "TRUE"
        assert number(program, "liPlace") == 500
        program.set("Main.Power", bRegulatorOn=False)
        program.set("Main.Reinit", bExecute=False)
        cycles(program, 3)
        program.set("Main.Reinit", bExecute=True)
        cycles(program, 3)
        assert program.literal("Main.Reinit.bDone") == "TRUE"
        assert number(program, "Axis.fActPosition") == pytest.approx(50.0)


def test_a_drive_that_does_not_start_is_an_error() -> None:
    with axis() as program:
        program.set("Main.Axis", **{"in.bOffline": True})
        program.set("Main.Reinit", bExecute=True)
        cycles(program, 1000)
        assert program.literal("Main.Reinit.bBusy") == "TRUE"
        cycles(program, 5)
        assert program.literal("Main.Reinit.nErrorID") == "SMC_RAG_ERROR_DURING_STARTUP"


def test_an_immediate_stop_freezes_the_set_position() -> None:
    with axis() as program:
        switch_on(program)
        program.set("Main.Turn", Execute=True)
        cycles(program, 200)
        program.set("Main.Freeze", Execute=True)
        place = number(program, "Axis.fSetPosition")
        program.cycle()
        assert program.literal("Main.Freeze.Done") == "TRUE"
        assert state(program) == "errorstop"
        cycles(program, 10)
        assert number(program, "Axis.fSetPosition") == pytest.approx(place)
        assert number(program, "Axis.fSetVelocity") == 0.0
        assert program.literal("Main.Turn.ErrorID") == "SMC_IS_AXIS_STOPPED"
        program.set("Main.Turn", Execute=False)
        program.set("Main.Reset", Execute=True)
        cycles(program, 5)
        assert state(program) == "standstill"


def test_an_immediate_stop_needs_power_and_a_mode() -> None:
    with axis() as program:
        program.set("Main.Freeze", Execute=True)
        program.cycle()
        assert program.literal("Main.Freeze.ErrorID") == "SMC_REGULATOR_OR_START_NOT_SET"
        program.set("Main.Freeze", Execute=False)
        switch_on(program)
        program.set("Main.Freeze", Execute=True, StopMode=1)
        program.cycle()
        assert program.literal("Main.Freeze.ErrorID") == "SMC_IS_INVALID_STOP_MODE"
        assert state(program) == "standstill"
