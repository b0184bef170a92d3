"""The simulated drive against closed forms and scipy, and as the drive of an axis."""

from __future__ import annotations

import math
from collections.abc import Iterator
from contextlib import contextmanager

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from tests.libraries.st_program import Program, run

CYCLE = 0.002
RADIANS = 2 * math.pi / 65536
J, B, DRY, RATED, LARGEST, TAU = 6e-5, 1e-4, 0.01, 1.27, 3.8, 0.0005
KV, KP, TN = 60.0, 0.03, 0.02
ALONE = """
PROGRAM Main
VAR
    Drive   : SM3_Basic.SimulatedDrive := (stSettings := ({settings}));
    Control : SM3_Basic.CiA402Control;
END_VAR
Control(wStatusWord := Drive.stIn.wStatusWord, bStart := TRUE);
Drive.stOut.wControlWord := Control.wControlWord;
Drive(fCycle := 0.002);
END_PROGRAM
"""
WITH_AXIS = """
PROGRAM Main
VAR
    Axis  : SM3_Basic.AXIS_REF_MAPPING_SM3 := (fTaskCycle := 0.002, iMovementType := 1,
        dwRatioTechUnitsDenom := 65536, iRatioTechUnitsNum := 1, fSWMaxDeceleration := 1000.0);
    Drive : SM3_Basic.SimulatedDrive := (stSettings := ({settings}));
    Power : SM3_Basic.MC_Power;
    Move  : SM3_Basic.MC_MoveAbsolute := (Velocity := 20.0, Acceleration := 200.0, Deceleration := 200.0);
    Home  : SM3_Basic.MC_Home;
    Reset : SM3_Basic.MC_Reset;
END_VAR
Axis.in := Drive.stIn;
Axis.BeginCycle();
Power(Axis := Axis, Enable := TRUE, bRegulatorOn := TRUE, bDriveStart := TRUE);
Move(Axis := Axis);
Home(Axis := Axis);
Reset(Axis := Axis);
Axis.EndCycle();
Drive(stOut := Axis.out, fCycle := 0.002);
END_PROGRAM
"""


@contextmanager
def drive(settings: str = "fNoise := 0.0", text: str = ALONE) -> Iterator[Program]:
    with run(text.format(settings=settings), 3, CYCLE * 1000) as program:
        yield program


def number(program: Program, name: str) -> float:
    return float(program.literal(f"Main.{name}"))


def cycles(program: Program, count: int) -> None:
    for _ in range(count):
        program.cycle()


def switch_on(program: Program, mode: int) -> None:
    program.set("Main.Drive", **{"stOut.byModesOfOperation": mode})
    program.set("Main.Control", bPower=True)
    cycles(program, 10)
    assert program.literal("Main.Control.bFollows") == "TRUE"


def test_a_torque_accelerates_the_motor_as_scipy_says() -> None:
    """It sticks until the torque is that of the dry friction."""
    with drive() as program:
        switch_on(program, 10)
        program.set("Main.Drive", **{"stOut.wSetTorque": 200})
        torque = 0.2 * RATED
        loose = -TAU * math.log(1 - DRY / torque)

        def motion(time: float, state: np.ndarray) -> list[float]:
            return [state[1], (torque * (1 - math.exp(-(time + loose) / TAU)) - B * state[1] - DRY) / J]

        times = np.arange(1, 101) * CYCLE - loose
        known = solve_ivp(motion, (0.0, times[-1]), [0.0, 0.0], t_eval=times, rtol=1e-10, atol=1e-12)
        for angle, velocity in zip(*known.y, strict=True):
            program.cycle()
            assert number(program, "Drive.fVelocity") == pytest.approx(velocity, rel=5e-3, abs=0.1)
            assert number(program, "Drive.fAngle") == pytest.approx(angle, rel=5e-3, abs=0.005)


def test_without_power_friction_brings_the_motor_to_standstill() -> None:
    with drive() as program:
        switch_on(program, 9)
        program.set("Main.Drive", **{"stOut.diSetVelocity": round(100 / RADIANS)})
        cycles(program, 300)
        start, place = number(program, "Drive.fVelocity"), number(program, "Drive.fAngle")
        assert start == pytest.approx(100.0, rel=1e-4)
        program.set("Main.Control", bPower=False)
        cycles(program, 1)  # the control word is on its way
        time = J / B * math.log(1 + start * B / DRY)
        cycles(program, int(time / CYCLE) - 2)
        assert number(program, "Drive.fVelocity") > 0.0
        cycles(program, 4)
        assert number(program, "Drive.fVelocity") == 0.0
        way = J / B * (start - DRY / B * math.log(1 + start * B / DRY))
        assert number(program, "Drive.fAngle") - place == pytest.approx(way, abs=3 * start * CYCLE)
        assert program.literal("Main.Drive.fTorque") == "0.0"


@pytest.mark.parametrize(("forward", "error"), [(0.0, 50.0 / KV), (1.0, 0.0)])
def test_the_position_lags_by_the_velocity_over_the_gain(forward: float, error: float) -> None:
    with drive(f"fFeedForward := {forward}") as program:
        switch_on(program, 8)
        step = round(50 * CYCLE / RADIANS)
        for at in range(1, 400):
            program.set("Main.Drive", **{"stOut.diSetPosition": at * step})
            program.cycle()
        lag = 399 * step * RADIANS - number(program, "Drive.fAngle")
        assert lag == pytest.approx(error, abs=0.01)


def test_the_step_response_is_that_of_its_loops() -> None:
    """Position P, velocity PI, current of first order; the set position comes within a cycle."""
    with drive("fDry := 0.0, fFeedForward := 0.0") as program:
        switch_on(program, 8)
        program.set("Main.Drive", **{"stOut.diSetPosition": 200})
        step = 200 * RADIANS

        def loops(time: float, state: np.ndarray) -> list[float]:
            angle, velocity, torque, integral = state
            error = KV * (step * min(time / CYCLE, 1.0) - angle) - velocity
            return [
                velocity,
                (torque - B * velocity) / J,
                (KP * (error + integral) - torque) / TAU,
                error / TN,
            ]

        times = np.arange(1, 101) * CYCLE
        known = solve_ivp(
            loops, (0.0, times[-1]), [0.0] * 4, t_eval=times, rtol=1e-10, atol=1e-14, max_step=CYCLE / 10
        )
        found = []
        for _ in times:
            program.cycle()
            found.append(number(program, "Drive.fAngle"))
        np.testing.assert_allclose(found, known.y[0], atol=0.02 * step)
        assert found[-1] == pytest.approx(step, rel=0.02)


def test_the_torque_of_the_motor_is_limited() -> None:
    with drive("diMaxLag := 0") as program:
        switch_on(program, 8)
        program.set("Main.Drive", **{"stOut.diSetPosition": 65536 * 20})
        found = []
        for _ in range(500):
            program.cycle()
            found.append(number(program, "Drive.fTorque"))
        assert max(found) == pytest.approx(LARGEST, rel=1e-6)
        assert min(found) >= -LARGEST * (1 + 1e-9)
        assert number(program, "Drive.stIn.diActPosition") == pytest.approx(65536 * 20, abs=300)


def test_the_encoder_has_noise() -> None:
    with drive("fNoise := 5.0") as program:
        found = set()
        for _ in range(300):
            program.cycle()
            found.add(number(program, "Drive.stIn.diActPosition"))
        assert min(found) >= -5
        assert max(found) <= 5
        assert len(found) == 11


def test_a_load_that_the_motor_cannot_hold_is_a_fault() -> None:
    with drive(text=WITH_AXIS) as program:
        cycles(program, 20)
        assert program.literal("Main.Power.Status") == "TRUE"
        program.set("Main.Drive", fLoadTorque=5.0)
        cycles(program, 100)
        assert program.literal("Main.Axis.nAxisState") == "errorstop"
        assert number(program, "Axis.dwErrorID") == 0x8611
        assert program.literal("Main.Power.ErrorID") == "SMC_DI_AXIS_ERROR"
        program.set("Main.Drive", fLoadTorque=0.0)
        cycles(program, 500)
        program.set("Main.Reset", Execute=True)
        cycles(program, 30)
        assert program.literal("Main.Reset.Done") == "TRUE"
        assert program.literal("Main.Axis.nAxisState") == "standstill"


def test_an_axis_moves_by_the_drive() -> None:
    with drive(text=WITH_AXIS) as program:
        cycles(program, 20)
        program.set("Main.Move", Execute=True, Position=10.0)
        lags = []
        for _ in range(400):
            program.cycle()
            lags.append(abs(number(program, "Axis.fSetPosition") - number(program, "Axis.fActPosition")))
        assert program.literal("Main.Move.Done") == "TRUE"
        assert number(program, "Axis.fActPosition") == pytest.approx(10.0, abs=0.001)
        assert max(lags) < 0.2


@pytest.mark.parametrize(
    ("method", "settings", "home"),
    [
        (37, "", 0.0),
        (17, "diNegativeLimit := -100000, ", -100000 / 65536),
        (18, "diPositiveLimit := 90000, ", 90000 / 65536),
        (33, "", 0.0),
        (34, "", 1.0),
        (2, "diPositiveLimit := 90000, ", 1.0),
        (23, "diHomeFrom := 50000, diHomeTo := 60000, ", 50000 / 65536),
    ],
)
def test_the_drive_homes_by_switch_pulse_or_where_it_is(method: int, settings: str, home: float) -> None:
    """`home` is the place of the motor, in turns, where the axis gets its reference."""
    text = f"{settings}iHomingMethod := {method}, diMaxLag := 0"
    with drive(text, WITH_AXIS) as program:
        cycles(program, 20)
        program.set("Main.Home", Execute=True, Position=7.0)
        cycles(program, 2000)
        assert program.literal("Main.Home.Done") == "TRUE"
        assert program.literal("Main.Axis.nAxisState") == "standstill"
        turns = number(program, "Drive.fAngle") / (2 * math.pi)
        assert number(program, "Axis.fActPosition") == pytest.approx(7.0 + turns - home, abs=1e-4)


def test_an_axis_whose_home_switch_is_missing_fails_and_does_not_jump() -> None:
    limits = "diNegativeLimit := -60000, diPositiveLimit := 60000, iHomingMethod := 23, diMaxLag := 2000"
    with drive(limits, WITH_AXIS) as program:
        cycles(program, 20)
        program.set("Main.Home", Execute=True, Position=7.0)
        places = []
        for _ in range(3000):
            program.cycle()
            places.append(number(program, "Drive.fAngle"))
        assert program.literal("Main.Home.ErrorID") == "SMC_DI_HOMING_ERROR"
        assert program.literal("Main.Axis.nAxisState") == "errorstop"
        assert np.abs(np.diff(places)).max() < 1.15 * 10.0 * CYCLE
        program.set("Main.Home", Execute=False)
        program.set("Main.Reset", Execute=True)
        cycles(program, 30)
        assert program.literal("Main.Axis.nAxisState") == "standstill", "the drive itself had no fault"
        assert number(program, "Drive.fAngle") == pytest.approx(places[-1], abs=0.001)
