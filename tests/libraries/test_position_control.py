"""Axes with drives that follow a speed: the position loop of the controller (devices AXIS-40 to AXIS-48)."""

from __future__ import annotations

import math
from collections import deque
from collections.abc import Iterator
from contextlib import contextmanager

import pytest
from tests.libraries.st_program import Program, run

CYCLE = 0.002
PER_UNIT = 100
"""Increments of a unit."""
RAW = 16_384
RATED = 400.0
PROGRAM = """
PROGRAM Main
VAR
    Axis  : SM3_Basic.AXIS_REF_POSCONTROL_SM3 := (fTaskCycle := 0.002, iRatioTechUnitsNum := {sign}1,
        dwRatioTechUnitsDenom := 100, fRatedVelocity := {rated}, diRatedRaw := {raw},
        fSWMaxDeceleration := 1000.0,
        fMaxVelocity := 5000.0, fMaxAcceleration := 1E5, fMaxDeceleration := 1E5, {settings});
    Power : SM3_Basic.MC_Power := (Enable := TRUE, bRegulatorOn := TRUE, bDriveStart := TRUE);
    Move  : SM3_Basic.MC_MoveAbsolute := (Velocity := 100.0, Acceleration := 1000.0, Deceleration := 1000.0);
    Turn  : SM3_Basic.MC_MoveVelocity := (Velocity := 100.0, Acceleration := 1000.0, Deceleration := 1000.0);
    Home  : SM3_Basic.MC_Home;
    Reset : SM3_Basic.MC_Reset;
END_VAR
Axis.BeginCycle();
Power(Axis := Axis);
Move(Axis := Axis);
Turn(Axis := Axis);
Home(Axis := Axis);
Reset(Axis := Axis);
Axis.EndCycle();
END_PROGRAM
"""


class Plant:
    """A motor that follows its speed with a time constant, behind a bus of some cycles."""

    def __init__(self, program: Program, bits: int, dead: int, gain: float, constant: float) -> None:
        self.program = program
        self._mask = (1 << bits) - 1
        self._wide = bits > 16
        self.gain, self._decay = gain, math.exp(-CYCLE / constant) if constant else 0.0
        self._constant = constant
        self._waiting = deque([0.0] * dead)
        self.place = 0.0
        """[increments]"""
        self.speed = 0.0
        """[increments/s]"""

    def cycle(self, count: int = 1) -> None:
        for _ in range(count):
            counter = round(self.place) & self._mask
            name = "dwActPosition" if self._wide else "wActPosition"
            self.program.set("Main.Axis", **{f"in.{name}": counter})
            self.program.cycle()
            self._waiting.append(number(self.program, "Axis.out.diSetVelocity") / RAW * RATED * PER_UNIT)
            wanted = self.gain * self._waiting.popleft()
            slow = self._constant * (1.0 - self._decay)
            self.place += wanted * CYCLE + (self.speed - wanted) * slow
            self.speed = wanted + (self.speed - wanted) * self._decay


def number(program: Program, path: str) -> float:
    return float(program.literal(f"Main.{path}").replace("16#", "0x"))


def state(program: Program) -> str:
    return program.literal("Main.Axis.nAxisState")


@contextmanager
def axis(
    settings: str = "fKp := 20.0, fDeadTimeCycles := 1.0, iMovementType := 1",
    *,
    bits: int = 32,
    dead: int = 0,
    gain: float = 1.0,
    constant: float = 0.0,
    sign: str = "",
    raw: int = RAW,
    rated: float = RATED,
) -> Iterator[Plant]:
    """Switched on; the drive tells its state at once."""
    text = PROGRAM.format(settings=f"{settings}, byPositionBits := {bits}", sign=sign, raw=raw, rated=rated)
    with run(text, 0) as program:
        plant = Plant(program, bits, dead, gain, constant)
        plant.cycle(2)
        assert state(program) == "power_off"
        assert program.literal("Main.Axis.out.bRegulatorOn") == "TRUE"
        program.set("Main.Axis", **{"in.bRegulatorRealState": True, "in.bDriveStartRealState": True})
        plant.cycle(3)
        assert state(program) == "standstill"
        yield plant


@pytest.mark.parametrize("dead", [0.0, 1.0, 2.5, 4.0])
@pytest.mark.parametrize("kp", [0.0, 20.0, 60.0])
def test_the_speed_is_the_one_of_the_specification(kp: float, dead: float) -> None:
    """devices 15: vOut = vSet + Kp * (posSet(t - d) - posAct), limited and scaled."""
    settings = f"fKp := {kp}, fDeadTimeCycles := {dead}, iMovementType := 1"
    with axis(settings, dead=2, gain=0.97, constant=0.004) as plant:
        program = plant.program
        program.set("Main.Move", Execute=True, Position=30.0)
        history = [number(program, "Axis.fSetPosition")] * 10
        largest = 0.0
        for _ in range(400):
            plant.cycle()
            history.append(number(program, "Axis.fSetPosition"))
            whole = int(dead)
            before = history[-1 - whole] - (dead - whole) * (history[-1 - whole] - history[-2 - whole])
            speed = number(program, "Axis.fSetVelocity")
            speed += kp * (before - number(program, "Axis.fActPosition"))
            raw = min(max(speed * RAW / RATED, -RAW), RAW)
            assert number(program, "Axis.out.diSetVelocity") == pytest.approx(raw, abs=0.51)
            assert number(program, "Axis.out.iSetVelocity") == number(program, "Axis.out.diSetVelocity")
            largest = max(largest, raw)
        assert largest > 0.2 * RAW
        assert program.literal("Main.Move.Done") == "TRUE"
        if kp > 0.0:
            assert plant.place == pytest.approx(3000, abs=2)


@pytest.mark.parametrize(("gain", "kp"), [(0.9, 10.0), (1.05, 20.0), (1.0, 20.0)])
def test_a_drive_with_a_wrong_scale_lags_by_what_the_gain_leaves(gain: float, kp: float) -> None:
    """In closed form: gain * (v + kp * e) = v."""
    with axis(f"fKp := {kp}, fDeadTimeCycles := 1.0, iMovementType := 1", gain=gain) as plant:
        program = plant.program
        program.set("Main.Turn", Execute=True)
        plant.cycle(1500)
        behind = number(program, "Axis.fSetPosition") - 100.0 * CYCLE - number(program, "Axis.fActPosition")
        assert behind == pytest.approx(100.0 * (1.0 / gain - 1.0) / kp, abs=0.02)


def test_a_speed_beyond_the_rated_one_is_limited() -> None:
    with axis() as plant:
        plant.program.set("Main.Turn", Execute=True, Velocity=900.0, Acceleration=1e4)
        plant.cycle(300)
        assert number(plant.program, "Axis.out.diSetVelocity") == RAW


def test_the_speed_of_a_ten_volt_drive() -> None:
    """devices EX-06, AXIS-45: 3600 degrees/s are 32767, so 360 degrees/s are 3276 or 3277."""
    settings = "fKp := 0.0, iMovementType := 0, fPositionPeriod := 360.0"
    with axis(settings, raw=32_767, rated=3600.0) as plant:
        plant.program.set("Main.Turn", Execute=True, Velocity=360.0, Acceleration=1e4)
        plant.cycle(100)
        assert number(plant.program, "Axis.fSetVelocity") == 360.0
        assert number(plant.program, "Axis.out.iSetVelocity") in (3276, 3277)


@pytest.mark.parametrize("bits", [16, 24, 32])
def test_the_counter_runs_over(bits: int) -> None:
    settings = "fKp := 20.0, fDeadTimeCycles := 1.0, iMovementType := 0, fPositionPeriod := 90.0"
    with axis(settings, bits=bits) as plant:
        plant.program.set("Main.Turn", Execute=True, Velocity=390.0, Acceleration=1e4)
        plant.cycle(3000)
        assert plant.place > 1 << 16
        shown = number(plant.program, "Axis.fActPosition")
        behind = plant.speed * CYCLE / PER_UNIT
        difference = (plant.place / PER_UNIT - behind - shown) % 90.0
        assert min(difference, 90.0 - difference) == pytest.approx(0.0, abs=0.02)


def test_the_motor_turns_the_other_way_round() -> None:
    with axis(sign="-") as plant:
        plant.program.set("Main.Move", Execute=True, Position=30.0)
        plant.cycle(400)
        assert plant.place == pytest.approx(-3000, abs=2)
        assert plant.program.literal("Main.Move.Done") == "TRUE"


def test_a_quick_stop_comes_when_the_axis_has_braked() -> None:
    """AXIS-51: the axis brakes by its ramp, and holds its position while the power stage is on."""
    with axis() as plant:
        program = plant.program
        program.set("Main.Turn", Execute=True)
        plant.cycle(200)
        program.set("Main.Power", bDriveStart=False)
        plant.cycle(20)
        assert state(program) == "stopping"
        assert program.literal("Main.Axis.out.bDriveStart") == "TRUE"
        assert 0.0 < number(program, "Axis.fSetVelocity") < 100.0
        plant.cycle(100)
        assert program.literal("Main.Axis.out.bDriveStart") == "FALSE"
        assert program.literal("Main.Axis.out.bRegulatorOn") == "TRUE"
        assert number(program, "Axis.out.diSetVelocity") == 0
        program.set("Main.Power", bRegulatorOn=False)
        plant.cycle(2)
        assert program.literal("Main.Axis.out.bRegulatorOn") == "FALSE"
        assert state(program) == "power_off"


def test_without_power_the_axis_follows_its_encoder() -> None:
    with axis() as plant:
        program = plant.program
        program.set("Main.Power", Enable=False)
        plant.cycle(3)
        program.set("Main.Axis", **{"in.bRegulatorRealState": False, "in.bDriveStartRealState": False})
        plant.place = 1234.0
        plant.cycle(2)
        assert number(program, "Axis.fSetPosition") == pytest.approx(12.34)
        assert number(program, "Axis.out.diSetVelocity") == 0
        program.set("Main.Power", Enable=True)
        program.set("Main.Axis", **{"in.bRegulatorRealState": True, "in.bDriveStartRealState": True})
        plant.cycle(50)
        assert state(program) == "standstill"
        assert plant.place == 1234.0


def test_a_fault_of_the_drive_is_an_error_until_it_is_reset() -> None:
    with axis() as plant:
        program = plant.program
        program.set("Main.Turn", Execute=True)
        plant.cycle(100)
        program.set("Main.Axis", **{"in.bExternalError": True})
        plant.cycle(2)
        assert state(program) == "errorstop"
        assert program.literal("Main.Turn.ErrorID") == "SMC_DI_AXIS_ERROR"
        program.set("Main.Turn", Execute=False)
        program.set("Main.Axis", **{"in.bExternalError": False})
        plant.cycle(200)
        program.set("Main.Reset", Execute=True)
        plant.cycle(5)
        assert state(program) == "standstill"


def test_a_drive_that_loses_its_power_is_an_error() -> None:
    with axis() as plant:
        plant.program.set("Main.Turn", Execute=True)
        plant.cycle(100)
        plant.program.set("Main.Axis", **{"in.bRegulatorRealState": False})
        plant.cycle(2)
        assert state(plant.program) == "errorstop"
        assert plant.program.literal("Main.Turn.ErrorID") == "SMC_DI_VOLTAGE_DISABLED"
        assert number(plant.program, "Axis.out.diSetVelocity") == 0


@pytest.mark.parametrize(("limit", "stops"), [("bLimitPos", True), ("bLimitNeg", False)])
def test_a_limit_switch_stops_motion_towards_it(limit: str, stops: bool) -> None:
    settings = "fKp := 20.0, fDeadTimeCycles := 1.0, iMovementType := 1, bHWLimitEnable := TRUE"
    with axis(settings) as plant:
        plant.program.set("Main.Turn", Execute=True, Direction="positive")
        plant.cycle(100)
        plant.program.set("Main.Axis", **{f"in.{limit}": True})
        plant.cycle(3)
        assert (state(plant.program) == "errorstop") == stops
        if stops:
            assert plant.program.literal("Main.Turn.ErrorID") == "SMC_DI_HWLIMITS_EXCEEDED"


def test_a_drive_that_is_stuck_lags_until_that_is_an_error() -> None:
    settings = "fKp := 20.0, fDeadTimeCycles := 1.0, iMovementType := 1, fMaxPositionLag := 2.0"
    with axis(settings) as plant:
        plant.program.set("Main.Turn", Execute=True)
        plant.cycle(300)
        assert state(plant.program) == "continuous_motion"
        plant.gain = 0.0
        plant.cycle(int(2.0 / (100.0 * CYCLE)))
        assert state(plant.program) == "continuous_motion"
        plant.cycle(5)
        assert state(plant.program) == "errorstop"
        assert plant.program.literal("Main.Turn.ErrorID") == "SMC_DI_POSITIONLAGERROR"


def test_the_drive_cannot_home_by_itself() -> None:
    with axis() as plant:
        plant.program.set("Main.Home", Execute=True)
        plant.cycle(5)
        assert plant.program.literal("Main.Home.Error") == "TRUE"
        assert plant.program.literal("Main.Home.ErrorID") == "SMC_DI_HOMING_ERROR"
        assert state(plant.program) == "errorstop"


def test_in_virtual_mode_the_drive_has_no_power() -> None:
    with run(PROGRAM.format(settings="bVirtual := TRUE", sign="", raw=RAW, rated=RATED), 0) as program:
        plant = Plant(program, 32, 0, 1.0, 0.0)
        plant.cycle(3)
        assert state(program) == "standstill"
        program.set("Main.Move", Execute=True, Position=30.0)
        plant.cycle(400)
        assert program.literal("Main.Move.Done") == "TRUE"
        assert program.literal("Main.Axis.out.bRegulatorOn") == "FALSE"
        assert plant.place == 0.0
