"""Logical axes: devices AXIS-30 to AXIS-35, motion_semantics VIR-04 and VIR-05."""

from __future__ import annotations

import math
from collections.abc import Iterator
from contextlib import contextmanager

import numpy as np
import pytest
from tests.libraries.st_program import Program, run

CYCLE = 0.002
PROGRAM = """
PROGRAM Main
VAR
    Master  : SM3_Basic.AXIS_REF_VIRTUAL_SM3 := (fTaskCycle := 0.002, {master}, fMaxVelocity := 1E4,
        fMaxAcceleration := 1E6, fMaxDeceleration := 1E6, fSWMaxVelocity := 1E4);
    Logical : SM3_Basic.AXIS_REF_LOGICAL_SM3 := (pMaster := ADR(Master), fTaskCycle := 0.002, {logical});
    Slave   : SM3_Basic.AXIS_REF_VIRTUAL_SM3 := (fTaskCycle := 0.002, iMovementType := 1, fMaxVelocity := 1E4,
        fMaxAcceleration := 1E6, fMaxDeceleration := 1E6);
    Power   : SM3_Basic.MC_Power := (Enable := TRUE, bRegulatorOn := TRUE, bDriveStart := TRUE);
    PowerSlave : SM3_Basic.MC_Power := (Enable := TRUE, bRegulatorOn := TRUE, bDriveStart := TRUE);
    Turn    : SM3_Basic.MC_MoveVelocity := (
        Velocity := 500.0, Acceleration := 2000.0, Deceleration := 2000.0);
    Gear    : SM3_Basic.MC_GearIn := (
        RatioNumerator := 1, RatioDenominator := 2, Acceleration := 1E5, Deceleration := 1E5);
    Place   : SM3_Basic.MC_SetPosition;
    OfMaster : SM3_Basic.MC_SetPosition;
    Move    : SM3_Basic.MC_MoveAbsolute := (Velocity := 1.0, Acceleration := 1.0, Deceleration := 1.0);
    Limits  : SM3_Basic.SMC_SetSoftwareLimits;
    PowerOfLogical : SM3_Basic.MC_Power := (bRegulatorOn := TRUE, bDriveStart := TRUE);
    Store   : SM3_Basic.SMC3_PersistPositionLogical;
    Data    : SM3_Basic.SMC3_PersistPositionLogical_Data;
    xStore  : BOOL;
END_VAR
Master.BeginCycle();
Logical.BeginCycle();
Slave.BeginCycle();
Power(Axis := Master);
PowerSlave(Axis := Slave);
Turn(Axis := Master);
OfMaster(Axis := Master);
Place(Axis := Logical);
Move(Axis := Logical);
Limits(Axis := Logical);
PowerOfLogical(Axis := Logical);
Gear(Master := Logical, Slave := Slave);
Store(Axis := Logical, PersistentData := Data, bEnable := xStore);
Master.EndCycle();
Logical.EndCycle();
Slave.EndCycle();
END_PROGRAM
"""
LINEAR = "iMovementType := 1"
ROTARY = "iMovementType := 0, fPositionPeriod := 360.0"


@contextmanager
def logical(settings: str = LINEAR, master: str = LINEAR) -> Iterator[Program]:
    """The master stands, powered."""
    with run(PROGRAM.format(logical=settings, master=master), 5, CYCLE * 1000) as program:
        yield program


def number(program: Program, path: str) -> float:
    return float(program.literal(f"Main.{path}"))


def cycles(program: Program, count: int) -> None:
    for _ in range(count):
        program.cycle()


def recorded(program: Program, count: int, *paths: str) -> np.ndarray:
    rows = []
    for _ in range(count):
        program.cycle()
        rows.append([number(program, path) for path in paths])
    return np.array(rows)


def test_it_mirrors_its_master_in_the_same_cycle() -> None:
    with logical() as program:
        program.set("Main.Turn", Execute=True)
        rows = recorded(program, 300, "Master.fSetPosition", "Logical.fSetPosition", "Master.fSetVelocity",
                        "Logical.fSetVelocity")  # fmt: skip
        assert rows[-1, 0] > 150.0
        assert rows[:, 1] == pytest.approx(rows[:, 0], abs=1e-9)
        steps = np.diff(np.concatenate(([0.0], rows[:, 0]))) / CYCLE
        assert rows[:, 3] == pytest.approx(steps, abs=1e-6)
        assert program.literal("Main.Logical.nAxisState") == "synchronized_motion"
        program.set("Main.Power", bRegulatorOn=False)
        cycles(program, 3)
        assert program.literal("Main.Master.nAxisState") == "power_off"
        assert program.literal("Main.Logical.nAxisState") == "synchronized_motion", "whatever the master's"


def test_its_position_is_its_own() -> None:
    with logical() as program:
        program.set("Main.Place", Execute=True, Position=1000.0)
        program.cycle()
        assert number(program, "Master.fSetPosition") == 0.0
        assert number(program, "Logical.fSetPosition") == pytest.approx(1000.0)
        program.set("Main.OfMaster", Execute=True, Position=-77.0)
        cycles(program, 3)
        assert number(program, "Logical.fSetPosition") == pytest.approx(1000.0), "it has not moved"
        program.set("Main.Turn", Execute=True)
        cycles(program, 300)
        moved = number(program, "Master.fSetPosition") + 77.0
        assert moved > 150.0
        assert number(program, "Logical.fSetPosition") == pytest.approx(1000.0 + moved)


@pytest.mark.parametrize("depth", [0, 1, 4, 9])
def test_positions_are_smoothed_by_a_moving_average_of_increments(depth: int) -> None:
    """Against numpy's convolution."""
    with logical(f"{LINEAR}, usiFilterDepthPosition := {depth}") as program:
        cycles(program, 10)
        program.set("Main.Turn", Execute=True)
        rows = recorded(program, 200, "Master.fSetPosition", "Logical.fSetPosition")
        increments = np.diff(np.concatenate(([0.0], rows[:, 0])))
        averaged = np.convolve(increments, np.ones(max(1, depth)) / max(1, depth))[: len(increments)]
        assert rows[:, 1] == pytest.approx(np.cumsum(averaged), abs=1e-9)


@pytest.mark.parametrize("depth", [0, 3, 9])
def test_velocities_are_averaged(depth: int) -> None:
    with logical(f"{LINEAR}, usiFilterDepthVelocity := {depth}") as program:
        cycles(program, 10)
        program.set("Main.Turn", Execute=True)
        rows = recorded(program, 200, "Master.fSetPosition", "Logical.fSetVelocity", "Logical.fSetPosition")
        increments = np.diff(np.concatenate(([0.0], rows[:, 0]))) / CYCLE
        averaged = np.convolve(increments, np.ones(max(1, depth)) / max(1, depth))[: len(increments)]
        assert rows[:, 1] == pytest.approx(averaged, abs=1e-6)
        assert rows[:, 2] == pytest.approx(rows[:, 0], abs=1e-9)


def test_the_master_is_seen_where_it_will_be() -> None:
    with logical(f"{LINEAR}, fDeadTimeCycles := 2.5") as program:
        program.set("Main.Turn", Execute=True)
        cycles(program, 400)
        ahead = number(program, "Logical.fSetPosition") - number(program, "Master.fSetPosition")
        assert ahead == pytest.approx(2.5 * CYCLE * 500.0)


def test_actual_values_can_be_followed() -> None:
    with logical(f"{LINEAR}, eValueReference := SM3_Basic.SMC_ValueSelect.SMC_ACT_VALUE") as program:
        program.set("Main.Turn", Execute=True)
        cycles(program, 400)
        assert number(program, "Logical.fSetPosition") == pytest.approx(
            number(program, "Master.fActPosition")
        )
        assert number(program, "Master.fActPosition") < number(program, "Master.fSetPosition")


def test_the_shift_can_be_given_by_hand() -> None:
    """AXIS-35."""
    with logical() as program:
        program.set("Main.Logical", bManualShiftMode=True, fManualShiftDistance=40.0)
        program.set("Main.Turn", Execute=True)
        cycles(program, 100)
        behind = number(program, "Logical.fSetPosition") - number(program, "Master.fSetPosition")
        assert behind == pytest.approx(40.0)


def test_periods_of_master_and_axis_are_their_own() -> None:
    with logical("iMovementType := 0, fModulo := 100.0", ROTARY) as program:
        program.set("Main.Turn", Execute=True)
        rows = recorded(program, 2000, "Master.fSetPosition", "Logical.fSetPosition")
        turned = np.cumsum(np.diff(np.concatenate(([0.0], rows[:, 0]))) % 360.0)
        assert turned[-1] > 1500.0
        difference = (rows[:, 1] - turned + 50.0) % 100.0 - 50.0
        assert difference == pytest.approx(np.zeros(len(rows)), abs=1e-6)
        assert rows[:, 1].max() < 100.0
        assert rows[:, 1].min() >= 0.0


def test_a_slave_follows_it_over_its_periods() -> None:
    with logical("iMovementType := 0, fModulo := 100.0", ROTARY) as program:
        program.set("Main.Gear", Execute=True)
        cycles(program, 5)
        assert program.literal("Main.Gear.InGear") == "TRUE"
        program.set("Main.Turn", Execute=True)
        rows = recorded(program, 1500, "Master.fSetPosition", "Slave.fSetPosition")
        turned = np.cumsum(np.diff(np.concatenate(([0.0], rows[:, 0]))) % 360.0)
        assert rows[:, 1] == pytest.approx(0.5 * turned, abs=1e-6)


def test_nothing_else_may_change_it() -> None:
    with logical() as program:
        program.set("Main.Move", Execute=True, Position=5.0)
        program.set("Main.Limits", bExecute=True)
        program.set("Main.PowerOfLogical", Enable=True)
        cycles(program, 2)
        for error in ("Move.ErrorID", "Limits.ErrorID", "PowerOfLogical.ErrorID"):
            assert program.literal(f"Main.{error}") == "SMC_INVALID_ACTION_FOR_LOGICAL", error
        assert number(program, "Logical.fSetPosition") == 0.0


@pytest.mark.parametrize(
    ("setting", "value", "error", "code"),
    [
        ("usiFilterDepthPosition", 10, "SMC_ENC_FILTER_DEPTH_INVALID", 5002),
        ("usiFilterDepthVelocity", 255, "SMC_ENC_FILTER_DEPTH_INVALID", 5002),
        ("fDeadTimeCycles", math.nan, "SMC_INVALID_SET_VALUES", 10018),
        ("fDeadTimeCycles", 1e300, "SMC_INVALID_SET_VALUES", 10018),
        ("fManualShiftDistance", -math.inf, "SMC_INVALID_SET_VALUES", 10018),
    ],
)
def test_a_wrong_setting_is_an_error_as_long_as_it_is_there(
    setting: str, value: float, error: str, code: int
) -> None:
    with logical() as program:
        program.set("Main.Turn", Execute=True)
        cycles(program, 100)
        program.set("Main.Logical", bManualShiftMode=True, **{setting: value})
        cycles(program, 5)
        stays = number(program, "Logical.fSetPosition")
        assert math.isfinite(stays)
        assert program.literal("Main.Logical.bError") == "TRUE"
        assert number(program, "Logical.uiDriveInterfaceError") == code
        assert program.literal("Main.Logical.fbeFBError[0].eErrorID") == error
        assert program.literal("Main.Logical.fbeFBError[1].eErrorID") == "SMC_NO_ERROR", "told once"
        program.set("Main.Logical", **{setting: 0})
        cycles(program, 5)
        assert program.literal("Main.Logical.bError") == "FALSE"
        assert number(program, "Logical.fSetPosition") == pytest.approx(
            number(program, "Master.fSetPosition")
        )


def test_its_distance_from_the_master_outlasts_the_controller() -> None:
    """PERS-01, PERS-03."""
    with logical() as program:
        program.set("Main.Place", Execute=True, Position=30.0)
        program.set("Main", xStore=True)
        cycles(program, 3)
        assert program.literal("Main.Store.bPositionStored") == "TRUE"
        assert program.literal("Main.Store.bPositionRestored") == "FALSE"
        program.set("Main", xStore=False)
        cycles(program, 2)
        program.set("Main.Place", Execute=False)
        cycles(program, 1)
        program.set("Main.Place", Execute=True, Position=-4.0)
        cycles(program, 2)
        assert number(program, "Logical.fSetPosition") == pytest.approx(-4.0)
        program.set("Main", xStore=True)
        cycles(program, 2)
        assert program.literal("Main.Store.bPositionRestored") == "TRUE"
        assert number(program, "Logical.fSetPosition") == pytest.approx(30.0)
        program.set("Main.Logical", pMaster=0)
        program.cycle()
        assert program.literal("Main.Store.eErrorID") == "SMC_PP_WRONG_AXIS_TYPE"
