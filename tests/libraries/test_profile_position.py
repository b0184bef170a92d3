"""Profile position of the simulated drive: closed forms, the handshake of IEC 61800-7-201, beside an axis."""

from __future__ import annotations

import math
from collections.abc import Iterator
from contextlib import contextmanager
from itertools import pairwise

import pytest
from tests.libraries.st_program import Program, run

CYCLE = 0.002
ALONE = """
PROGRAM Main
VAR
    Drive   : SM3_Basic.SimulatedDrive := (stSettings := (fDry := 0.0, {settings}));
    Control : SM3_Basic.CiA402Control;
    wMode   : WORD; (* Bits of the control word that belong to the mode *)
END_VAR
Control(wStatusWord := Drive.stIn.wStatusWord, bPower := TRUE, bStart := TRUE);
Drive.stOut.wControlWord := Control.wControlWord OR wMode;
Drive.stOut.byModesOfOperation := 1;
Drive(fCycle := 0.002);
END_PROGRAM
"""
NEW, AT_ONCE, RELATIVE, HALT = 0x10, 0x20, 0x40, 0x100
REACHED, ACKNOWLEDGE, FOLLOWING_ERROR = 10, 12, 13


class Drive:
    """The drive, with the velocity 200,000, the acceleration 400,000 and the deceleration 800,000."""

    def __init__(self, program: Program) -> None:
        self.program = program
        self.limits(200_000, 400_000, 800_000)
        self.cycles(10)

    def limits(self, velocity: int, acceleration: int, deceleration: int) -> None:
        self.program.set("Main.Drive.stOut", udiProfileVelocity=velocity)
        self.program.set("Main.Drive.stOut", udiProfileAcceleration=acceleration)
        self.program.set("Main.Drive.stOut", udiProfileDeceleration=deceleration)

    def mode(self, bits: int) -> None:
        self.program.set("Main", wMode=bits)

    def cycles(self, count: int) -> None:
        for _ in range(count):
            self.program.cycle()

    def give(self, target: int, bits: int = 0) -> None:
        """A set-point in the next cycle, the edge behind a cycle without bit 4."""
        self.program.set("Main.Drive", **{"stOut.diSetPosition": target})
        self.mode(bits & ~NEW)
        self.cycles(1)
        self.mode(bits | NEW)
        self.cycles(1)

    def bit(self, index: int) -> bool:
        return self.program.literal(f"Main.Drive.stIn.wStatusWord.{index}") == "TRUE"

    def number(self, name: str) -> float:
        return float(self.program.literal(f"Main.Drive.{name}"))

    @property
    def wanted(self) -> float:
        return self.number("fbProfile.stState.fPosition")


@contextmanager
def drive(settings: str = "diMaxLag := 65536") -> Iterator[Drive]:
    with run(ALONE.format(settings=settings), 3, CYCLE * 1000) as program:
        yield Drive(program)


def trapezoid(time: float, distance: float, top: float, up: float, down: float) -> float:
    """The way since a standstill at time 0, by the areas under the velocity."""
    top = min(top, math.sqrt(2 * distance * up * down / (up + down)))
    rising, falling = top / up, top / down
    cruising = (distance - 0.5 * top * (rising + falling)) / top
    if time < rising:
        return 0.5 * up * time**2
    if time < rising + cruising:
        return 0.5 * top * rising + top * (time - rising)
    left = max(0.0, rising + cruising + falling - time)
    return distance - 0.5 * down * left**2


@pytest.mark.parametrize("distance", [1, 40, 3000, 70_000, 400_000])
@pytest.mark.parametrize("sign", [1, -1])
def test_a_set_point_is_a_trapezoid(distance: int, sign: int) -> None:
    with drive() as one:
        start = one.wanted
        one.give(sign * distance)
        way = abs(sign * distance - start)
        for number in range(1, 1600):
            known = trapezoid(number * CYCLE, way, 200_000, 400_000, 800_000)
            assert sign * (one.wanted - start) == pytest.approx(known, abs=1e-6 * way)
            if known >= way and one.bit(REACHED):
                break
            one.cycles(1)
        one.cycles(100)
        assert one.number("stIn.diActPosition") == pytest.approx(sign * distance, abs=1)
        assert one.bit(REACHED)


def test_a_deceleration_of_0_is_the_acceleration() -> None:
    with drive() as one:
        one.limits(200_000, 400_000, 0)
        one.give(50_000)
        for number in range(1, 500):
            assert one.wanted == pytest.approx(trapezoid(number * CYCLE, 50_000, 2e5, 4e5, 4e5), abs=0.05)
            one.cycles(1)


def test_the_handshake_of_a_single_set_point() -> None:
    """Bit 12 rises with the edge of bit 4 and falls with it; bit 10 goes with the target."""
    with drive() as one:
        assert [one.bit(bit) for bit in (REACHED, ACKNOWLEDGE)] == [True, False]
        one.give(40_000)
        assert [one.bit(bit) for bit in (REACHED, ACKNOWLEDGE)] == [False, True]
        one.cycles(5)
        assert one.bit(ACKNOWLEDGE), "bit 4 is still set"
        one.mode(0)
        one.cycles(1)
        assert [one.bit(bit) for bit in (REACHED, ACKNOWLEDGE)] == [False, False]
        one.cycles(500)
        assert [one.bit(bit) for bit in (REACHED, ACKNOWLEDGE)] == [True, False]
        assert one.number("stIn.diActPosition") == pytest.approx(40_000, abs=1)


def test_a_target_without_an_edge_is_none() -> None:
    with drive() as one:
        one.program.set("Main.Drive", **{"stOut.diSetPosition": 40_000})
        one.cycles(100)
        assert one.wanted == 0.0
        one.give(1000)
        one.program.set("Main.Drive", **{"stOut.diSetPosition": 90_000})
        one.cycles(500)
        assert one.wanted == 1000.0


def test_set_points_wait_for_one_another() -> None:
    """A set of set-points: the second waits, a third has no place until the first has reached its target."""
    with drive() as one:
        one.give(40_000)
        one.mode(0)
        one.cycles(1)
        one.give(10_000)
        one.mode(0)
        one.cycles(3)
        assert one.bit(ACKNOWLEDGE), "the place of the next one is taken"
        one.give(70_000)
        one.mode(0)
        places, acknowledged = [], []
        for _ in range(800):
            one.cycles(1)
            places.append(one.wanted)
            acknowledged.append(one.bit(ACKNOWLEDGE))
            assert not (one.bit(REACHED) and places[-1] > 10_001)
        assert max(places) == pytest.approx(40_000, abs=400)
        turned = places.index(max(places))
        assert acknowledged[turned - 5]
        assert not acknowledged[turned + 5]
        assert places[-1] == 10_000
        assert one.bit(REACHED)


def test_a_set_point_behind_another_begins_within_the_cycle() -> None:
    """Together they take the sum of both times, though no multiple of the cycle is in it."""
    with drive() as one:
        one.give(3100)
        one.mode(0)
        one.cycles(1)
        one.give(0)
        one.mode(0)
        first = math.sqrt(2 * 3100 * (1 / 400_000 + 1 / 800_000))
        at = 4
        while one.wanted > 0.0 and at < 500:
            time = at * CYCLE
            if time < first:
                known = trapezoid(time, 3100, 2e5, 4e5, 8e5)
            else:
                known = 3100 - trapezoid(time - first, 3100, 2e5, 4e5, 8e5)
            assert one.wanted == pytest.approx(known, abs=0.01)
            one.cycles(1)
            at += 1
        assert at == math.ceil(2 * first / CYCLE)


def test_a_set_point_at_once_takes_the_place_of_the_others() -> None:
    with drive() as one:
        one.give(300_000)
        one.mode(0)
        one.cycles(100)
        one.give(100_000)
        one.mode(0)
        one.cycles(1)
        one.give(-5000, AT_ONCE)
        one.mode(0)
        velocities = []
        before = one.wanted
        for _ in range(1500):
            one.cycles(1)
            velocities.append((one.wanted - before) / CYCLE)
            before = one.wanted
        steps = [b - a for a, b in pairwise(velocities)]
        assert max(steps) <= 800_000 * CYCLE * 1.0001
        assert min(steps) >= -800_000 * CYCLE * 1.0001
        assert one.wanted == -5000
        assert one.bit(REACHED)


def test_relative_targets_count_from_the_target_before() -> None:
    with drive() as one:
        one.give(5000, RELATIVE)
        one.cycles(20)
        one.give(-2000, RELATIVE | AT_ONCE)
        one.mode(0)
        one.cycles(500)
        assert one.wanted == pytest.approx(3000, abs=0.5)
        one.give(10_000, RELATIVE)
        one.cycles(500)
        assert one.wanted == pytest.approx(13_000, abs=0.5)


def test_halt_brakes_by_the_deceleration_and_goes_on() -> None:
    with drive() as one:
        one.give(300_000)
        one.mode(0)
        one.cycles(350)
        assert one.number("fbProfile.stState.fVelocity") == 200_000
        place = one.wanted
        one.mode(HALT)
        one.cycles(200)
        assert one.wanted - place == pytest.approx(200_000**2 / 2 / 800_000, rel=1e-6)
        assert one.bit(REACHED), "the velocity is 0"
        one.mode(0)
        one.cycles(1)
        assert not one.bit(REACHED)
        one.cycles(1500)
        assert one.wanted == 300_000
        assert one.bit(REACHED)


def test_without_a_velocity_it_waits() -> None:
    with drive() as one:
        one.limits(0, 400_000, 800_000)
        one.give(5000)
        one.cycles(100)
        assert one.wanted == 0.0
        assert not one.bit(FOLLOWING_ERROR)


def test_a_motor_that_does_not_follow_has_a_following_error() -> None:
    with drive("diMaxLag := 2000") as one:
        one.program.set("Main.Drive", fLoadTorque=20.0)
        one.cycles(1)
        one.give(300_000)
        seen = False
        for _ in range(300):
            one.cycles(1)
            seen = seen or one.number("stIn.wErrorCode") == 0x8611
        assert seen


WITH_AXIS = """
PROGRAM Main
VAR
    Axis  : SM3_Basic.AXIS_REF_MAPPING_SM3 := (fTaskCycle := 0.002, iMovementType := 1,
        bHWLimitEnable := TRUE, dwRatioTechUnitsDenom := 65536, iRatioTechUnitsNum := 1,
        fSWMaxDeceleration := 1000.0);
    Drive : SM3_Basic.SimulatedDrive := (stSettings := (diPositiveLimit := 650000));
    Power : SM3_Basic.MC_Power;
    Move  : SM3_Basic.MC_MoveAbsolute := (Velocity := 20.0, Acceleration := 200.0, Deceleration := 200.0);
    Stop  : SM3_Basic.MC_Stop := (Deceleration := 200.0);
    Reset : SM3_Basic.MC_Reset;
    xNew  : BOOL;
    diTo  : DINT;
END_VAR
Axis.in := Drive.stIn;
Axis.BeginCycle();
Power(Axis := Axis, Enable := TRUE, bRegulatorOn := TRUE, bDriveStart := TRUE);
Move(Axis := Axis);
Stop(Axis := Axis);
Reset(Axis := Axis);
Axis.out.wControlWord.4 := xNew;
Axis.out.wControlWord.5 := TRUE;
IF Axis.byDriveMode = 1 THEN
    Axis.out.diSetPosition := diTo;
END_IF
Axis.out.udiProfileVelocity := 65536 * 4;
Axis.out.udiProfileAcceleration := 65536 * 40;
Axis.out.udiProfileDeceleration := 65536 * 40;
Axis.EndCycle();
Drive(stOut := Axis.out, fCycle := 0.002);
END_PROGRAM
"""


@contextmanager
def axis() -> Iterator[Program]:
    with run(WITH_AXIS, 20, CYCLE * 1000) as program:
        program.set("Main.Axis", byDriveMode=1)
        program.cycle()
        program.cycle()
        program.cycle()
        program.set("Main", xNew=True, diTo=65536 * 5)
        yield program


def value(program: Program, name: str) -> float:
    return float(program.literal(f"Main.{name}"))


def state(program: Program) -> str:
    return program.literal("Main.Axis.nAxisState").rpartition(".")[2]


def cycles(program: Program, count: int) -> float:
    """The fastest motion in these cycles, in turns a second."""
    fastest = 0.0
    for _ in range(count):
        program.cycle()
        fastest = max(fastest, abs(value(program, "Drive.fVelocity")) / (2 * math.pi))
    return fastest


def test_a_program_runs_profile_position_beside_the_axis() -> None:
    """The axis follows; no block moves it meanwhile; then it is cyclic again, without a jump."""
    with axis() as program:
        cycles(program, 200)
        assert value(program, "Axis.fActVelocity") == pytest.approx(4.0, rel=0.02)
        assert value(program, "Axis.fSetPosition") == pytest.approx(
            value(program, "Axis.fActPosition"), abs=1e-6
        )
        cycles(program, 700)
        assert value(program, "Axis.fActPosition") == pytest.approx(5.0, abs=1e-3)
        program.set("Main.Move", Execute=True, Position=1.0)
        program.cycle()
        assert program.literal("Main.Move.ErrorID") == "SMC_WRONG_CONTROLLER_MODE"
        program.set("Main.Move", Execute=False)
        program.set("Main.Axis", byDriveMode=0)
        assert cycles(program, 20) < 0.05
        assert value(program, "Axis.in.byModesOfOperationDisplay") == 8
        assert value(program, "Axis.fActPosition") == pytest.approx(5.0, abs=1e-3)
        program.set("Main.Move", Execute=True, Position=1.0)
        cycles(program, 400)
        assert program.literal("Main.Move.Done") == "TRUE"
        assert value(program, "Axis.fActPosition") == pytest.approx(1.0, abs=1e-3)


def test_the_axis_halts_the_drive_before_it_is_cyclic_again() -> None:
    with axis() as program:
        cycles(program, 200)
        place = value(program, "Axis.fActPosition")
        program.set("Main.Axis", byDriveMode=0)
        assert cycles(program, 150) < 4.3
        way = value(program, "Axis.fActPosition") - place
        assert way == pytest.approx(4.0**2 / 2 / 40 + 2 * 4 * CYCLE, abs=0.03)
        assert value(program, "Axis.in.byModesOfOperationDisplay") == 8
        assert state(program) == "standstill"


def test_a_limit_switch_halts_the_drive_until_the_axis_is_reset() -> None:
    with axis() as program:
        program.set("Main", diTo=65536 * 50)
        cycles(program, 1600)
        assert state(program) == "errorstop"
        assert value(program, "Drive.fVelocity") == pytest.approx(0.0, abs=0.02)
        assert value(program, "Axis.fActPosition") == pytest.approx(650000 / 65536 + 0.2, abs=0.1)
        program.set("Main", xNew=False)
        program.set("Main.Axis", byDriveMode=0)
        program.set("Main.Reset", Execute=True)
        cycles(program, 30)
        assert state(program) == "standstill"
        assert value(program, "Axis.in.byModesOfOperationDisplay") == 8


def test_mc_stop_halts_the_drive() -> None:
    with axis() as program:
        cycles(program, 200)
        program.set("Main.Stop", Execute=True)
        cycles(program, 150)
        assert value(program, "Drive.fVelocity") == pytest.approx(0.0, abs=0.02)
        assert program.literal("Main.Stop.Done") == "TRUE"
        assert value(program, "Axis.fActPosition") < 4.0


def test_an_axis_that_moves_does_not_let_go() -> None:
    with run(WITH_AXIS, 20, CYCLE * 1000) as program:
        program.set("Main.Move", Execute=True, Position=4.0)
        cycles(program, 50)
        program.set("Main.Axis", byDriveMode=1)
        cycles(program, 20)
        assert value(program, "Axis.in.byModesOfOperationDisplay") == 8
        cycles(program, 300)
        assert program.literal("Main.Move.Done") == "TRUE"
        assert value(program, "Axis.in.byModesOfOperationDisplay") == 1
