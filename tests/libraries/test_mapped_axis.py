"""Axes with a drive that speaks CiA 402: scaling, power, errors, homing, probes and lag."""

from __future__ import annotations

import pytest
from tests.libraries.mapped_axis import CYCLE, DEGREES, FAST, axis, cycles, number, state, switch_on


def test_an_axis_is_switched_on_where_it_is() -> None:
    with axis(place=12345) as program:
        assert number(program, "Axis.wCommunicationState") == 100
        assert state(program) == "power_off"
        assert number(program, "Axis.fSetPosition") == pytest.approx(1234.5)
        program.set("Main", liPlace=500)  # turned by hand
        cycles(program, 3)
        switch_on(program)
        assert number(program, "Axis.fSetPosition") == pytest.approx(50.0)
        assert number(program, "diSteps") == 0
        assert number(program, "liPlace") == 500


@pytest.mark.parametrize("sign", [1, -1])
def test_a_move_ends_at_its_increments(sign: int) -> None:
    with axis(DEGREES.replace(":= 360,", f":= {sign * 360},")) as program:
        switch_on(program)
        program.set("Main.Move", Execute=True, Position=90.0)
        cycles(program, 20)
        assert state(program) == "discrete_motion"
        assert number(program, "Axis.out.diSetVelocity") == pytest.approx(
            sign * 10 * number(program, "Axis.fSetVelocity"), abs=0.5
        )
        cycles(program, 600)
        assert program.literal("Main.Move.Done") == "TRUE"
        assert number(program, "liPlace") == sign * 900
        assert number(program, "Axis.fActPosition") == pytest.approx(90.0)
        assert number(program, "diSteps") <= 180 * 10 * CYCLE + 1


@pytest.mark.parametrize(
    ("bits", "mask", "start"),
    [(32, "", 2**31 - 500), (16, "AND 16#FFFF", 65000), (24, "AND 16#FFFFFF", 2**23 - 100)],
)
def test_the_counter_of_the_drive_runs_over(bits: int, mask: str, start: int) -> None:
    settings = f"{DEGREES}, byPositionBits := {bits}"
    with axis(settings, place=start, mask=mask) as program:
        switch_on(program)
        program.set("Main.Place", Execute=True, Position=0.0)
        cycles(program, 2)
        program.set("Main.Move", Execute=True, Position=200.0)
        cycles(program, 1000)
        assert number(program, "Axis.fActPosition") == pytest.approx(200.0)
        assert (number(program, "liPlace") - start - 2000) % 2**bits == 0


def test_a_short_counter_goes_on_behind_its_end() -> None:
    """devices EX-08: from 65530 to 10 with 16 bits are 16 increments, which are 1.6 degrees."""
    with axis(f"{DEGREES}, byPositionBits := 16", place=65530, mask="AND 16#FFFF") as program:
        before = number(program, "Axis.fActPosition")
        program.set("Main", liPlace=65536 + 10)
        cycles(program, 2)
        assert number(program, "Axis.in.diActPosition") == 10
        assert number(program, "Axis.fActPosition") - before == pytest.approx(1.6, abs=1e-9)


def test_a_rotary_axis_turns_on_for_long() -> None:
    settings = DEGREES.replace("iMovementType := 1", "iMovementType := 0, fPositionPeriod := 90.0")
    with axis(settings) as program:
        switch_on(program)
        program.set("Main.Turn", Execute=True, Direction="current", Velocity=3600.0, Acceleration=1e5)
        cycles(program, 1000)
        place, shown = number(program, "liPlace"), number(program, "Axis.fActPosition")
        assert place > 60000
        assert 0.0 <= shown < 90.0
        behind = 3600 * CYCLE
        assert (place / 10 - shown - behind) % 90.0 == pytest.approx(0.0, abs=1e-6) or (
            place / 10 - shown - behind
        ) % 90.0 == pytest.approx(90.0, abs=1e-6)


def test_a_fault_of_the_drive_is_an_error_of_the_axis_until_it_is_reset() -> None:
    """ERR-06, ax3000 DIAG-01: MC_ReadAxisError has the number of the drive."""
    with axis() as program:
        switch_on(program)
        program.set("Main.Turn", Execute=True)
        cycles(program, 200)
        program.set("Main", xFault=True)
        cycles(program, 5)
        assert state(program) == "errorstop"
        assert program.literal("Main.Turn.ErrorID") == "SMC_DI_AXIS_ERROR"
        assert number(program, "AxisError.AxisErrorID") == number(program, "Axis.dwErrorID") == 0x8611
        assert program.literal("Main.AxisError.AxisError") == "TRUE"
        program.set("Main.Turn", Execute=False)
        program.set("Main.Reset", Execute=True)
        cycles(program, 50)
        assert program.literal("Main.Reset.Busy") == "TRUE", "the fault is still there"
        program.set("Main", xFault=False)
        cycles(program, 20)
        assert program.literal("Main.Reset.Done") == "TRUE"
        assert state(program) == "standstill"
        assert number(program, "Axis.dwErrorID") == 0


def test_an_error_that_stays_is_told_by_the_reset() -> None:
    """ERR-07: 123 when the fault has not gone in time, 121 without communication, until the bus is back."""
    with axis() as program:
        switch_on(program)
        program.set("Main", xFault=True)
        cycles(program, 5)
        assert state(program) == "errorstop"
        program.set("Main.Reset", Execute=True)
        cycles(program, 1005)
        assert program.literal("Main.Reset.ErrorID") == "SMC_R_DRIVE_DOESNT_ANSWER_IN_TIME"
        program.set("Main", xFault=False)
        program.set("Main.Reset", Execute=False)
        program.set("Main.Axis", **{"in.bOffline": True})
        cycles(program, 3)
        program.set("Main.Reset", Execute=True)
        cycles(program, 2)
        assert program.literal("Main.Reset.ErrorID") == "SMC_R_DRIVE_DOESNT_ANSWER"
        assert state(program) == "errorstop"
        program.set("Main.Axis", **{"in.bOffline": False})
        program.set("Main.Reset", Execute=False)
        cycles(program, 10)
        program.set("Main.Reset", Execute=True)
        cycles(program, 50)
        assert program.literal("Main.Reset.Done") == "TRUE"


def test_an_axis_that_loses_its_power_does_not_jump_when_it_comes_back() -> None:
    with axis() as program:
        switch_on(program)
        program.set("Main.Turn", Execute=True)
        cycles(program, 200)
        program.set("Main", xVolts=False)
        cycles(program, 5)
        assert state(program) == "errorstop"
        assert program.literal("Main.Turn.ErrorID") == "SMC_DI_VOLTAGE_DISABLED"
        place = number(program, "liPlace")
        program.set("Main.Turn", Execute=False)
        program.set("Main", xVolts=True, diSteps=0)
        cycles(program, 20)
        program.set("Main.Reset", Execute=True)
        cycles(program, 20)
        assert state(program) == "standstill"
        assert number(program, "liPlace") == place
        assert number(program, "diSteps") == 0


@pytest.mark.parametrize("limit", [5.0, 0.0])
def test_the_lag_of_a_drive_that_is_stuck_is_an_error(limit: float) -> None:
    with axis(f"{DEGREES}, fMaxPositionLag := {limit}, fDeadTimeCycles := 1.0") as program:
        switch_on(program)
        program.set("Main.Turn", Execute=True)
        cycles(program, 300)
        assert state(program) == "continuous_motion", "a lag of the dead time is none"
        program.set("Main", xStuck=True)
        cycles(program, int(5.0 / (180.0 * CYCLE)))
        assert state(program) == "continuous_motion"
        cycles(program, 4)
        assert state(program) == ("errorstop" if limit else "continuous_motion")
        if limit:
            assert program.literal("Main.Turn.ErrorID") == "SMC_DI_POSITIONLAGERROR"


@pytest.mark.parametrize(("velocity", "bit", "stops"), [(50.0, 2, True), (50.0, 1, False), (-50.0, 1, True)])
def test_a_limit_switch_stops_motion_towards_it(velocity: float, bit: int, stops: bool) -> None:
    with axis(f"{DEGREES}, bHWLimitEnable := TRUE") as program:
        switch_on(program)
        direction = "positive" if velocity > 0 else "negative"
        program.set("Main.Turn", Execute=True, Velocity=50.0, Direction=direction)
        cycles(program, 100)
        program.set("Main.Axis", **{"in.dwDigitalInputs": bit})
        cycles(program, 2)
        assert state(program) == ("errorstop" if stops else "continuous_motion")
        if stops:
            assert program.literal("Main.Turn.ErrorID") == "SMC_DI_HWLIMITS_EXCEEDED"


@pytest.mark.parametrize("lag", ["", ", fMaxPositionLag := 1.0"])
def test_the_drive_homes_by_itself(lag: str) -> None:
    with axis(f"{DEGREES}{lag}", place=700) as program:
        switch_on(program)
        program.set("Main.Home", Execute=True, Position=-20.0)
        cycles(program, 8)
        assert state(program) == "homing"
        assert program.literal("Main.Axis.bStartReferenceRealState") == "TRUE"
        cycles(program, 40)
        assert program.literal("Main.Home.Done") == "TRUE"
        assert state(program) == "standstill"
        behind = number(program, "liPlace")
        assert behind <= 3, "of the cycle in which the drive says that it is home"
        assert number(program, "Axis.fActPosition") == pytest.approx(-20.0 + behind / 10)
        assert number(program, "Axis.fSetPosition") == pytest.approx(number(program, "Axis.fActPosition"))
        program.set("Main.Move", Execute=True, Position=0.0)
        cycles(program, 600)
        assert number(program, "Axis.fActPosition") == pytest.approx(0.0, abs=1e-9)
        assert number(program, "liPlace") == 200


def test_an_axis_whose_bus_is_lost_stops_and_starts_again() -> None:
    with axis() as program:
        switch_on(program)
        program.set("Main.Turn", Execute=True)
        cycles(program, 200)
        program.set("Main.Axis", **{"in.bOffline": True})
        cycles(program, 3)
        assert state(program) == "errorstop"
        assert program.literal("Main.Turn.ErrorID") == "SMC_DI_GENERAL_COMMUNICATION_ERROR"
        assert number(program, "Axis.wCommunicationState") != 100
        program.set("Main.Turn", Execute=False)
        program.set("Main.Axis", **{"in.bOffline": False})
        cycles(program, 5)
        assert number(program, "Axis.wCommunicationState") == 100
        assert number(program, "Axis.fActPosition") == pytest.approx(number(program, "liPlace") / 10)


def test_in_virtual_mode_the_drive_has_no_power() -> None:
    with axis(f"{DEGREES}, {FAST}, bVirtual := TRUE", place=700) as program:
        switch_on(program)
        program.set("Main.Move", Execute=True, Position=90.0)
        cycles(program, 700)
        assert number(program, "Axis.fActPosition") == pytest.approx(90.0)
        assert number(program, "liPlace") == 700
        assert program.literal("Main.Drive.bTorque") == "FALSE"


def test_without_a_scaling_an_axis_does_not_start() -> None:
    with axis("dwRatioTechUnitsDenom := 0") as program:
        assert number(program, "Axis.wCommunicationState") != 100
        program.set("Main.Power", bRegulatorOn=True)
        cycles(program, 10)
        assert program.literal("Main.Power.ErrorID") == "SMC_CGR_ZERO_VALUES"


def test_a_torque_is_a_part_of_the_rated_one() -> None:
    with axis(f"{DEGREES}, fMaxTorque := 5.0") as program:
        program.set("Main.Axis", fSetTorque=1.0, **{"in.wActTorque": -500})
        cycles(program, 2)
        assert number(program, "Axis.out.wSetTorque") == 400
        assert number(program, "Axis.fActTorque") == pytest.approx(-1.25)
        program.set("Main.Axis", fSetTorque=-7.0)
        cycles(program, 2)
        assert number(program, "Axis.out.wSetTorque") == -2000


@pytest.mark.parametrize("window", [False, True])
def test_the_drive_latches_the_position_of_a_trigger(window: bool) -> None:
    """Outside of the window the first edge does not count, and the drive is armed again."""
    with axis() as program:
        switch_on(program)
        program.set("Main", liEdge=123)
        program.set("Main.Probe", Execute=True, WindowOnly=window, FirstPosition=30.0, LastPosition=60.0)
        program.set("Main.Turn", Execute=True)
        cycles(program, 120)
        if window:
            assert program.literal("Main.Probe.Busy") == "TRUE"
            program.set("Main", liEdge=456)
            cycles(program, 150)
        assert program.literal("Main.Probe.Done") == "TRUE"
        assert number(program, "Probe.RecordedPosition") == pytest.approx(45.6 if window else 12.3)
        assert program.literal("Main.Trigger.bActive") == "FALSE"
        cycles(program, 2)
        assert number(program, "Axis.out.wTouchProbeFunction") == 0


def test_a_trigger_that_the_drive_does_not_have_is_an_error() -> None:
    with axis() as program:
        program.set("Main.Trigger", iTriggerNumber=2)
        program.set("Main.Probe", Execute=True)
        program.cycle()
        assert program.literal("Main.Probe.ErrorID") == "SMC_TP_COMM_ERROR"
