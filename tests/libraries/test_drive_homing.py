"""Homing methods of the simulated drive against the diagrams of IEC 61800-7-201 (object 6098h)."""

from __future__ import annotations

import math
from collections.abc import Iterator
from contextlib import contextmanager

import pytest
from tests.libraries.st_program import Program, run

TURN = 1000
NEGATIVE, POSITIVE = -4600, 7700
"""Limit switches: on below and above."""
LEFT, RIGHT = 1400, 4600
"""Edges of the home switch."""
FAST, SLOW = 50.0, 5.0
EVERYWHERE = 2**31 - 1
PROGRAM = """
PROGRAM Main
VAR
    Drive   : SM3_Basic.SimulatedDrive := (stSettings := (diIncrements := 1000, diMaxLag := 0,
        fHomingVelocity := 50.0, fHomingZeroVelocity := 5.0, fHomingAcceleration := 1000.0));
    Control : SM3_Basic.CiA402Control;
    xStart  : BOOL;
    xHalt   : BOOL;
    iFirst  : INT;   (* Direction of the first motion *)
    fFound  : LREAL; (* Velocity when the home was found *)
    xTurned : BOOL;  (* A limit switch was on *)
    fFastest : LREAL;
    fRamp    : LREAL;
    fBefore  : LREAL;
    xFound  : BOOL;
    i       : INT;
END_VAR
FOR i := 1 TO 20 DO
    Control(wStatusWord := Drive.stIn.wStatusWord, bPower := TRUE, bStart := TRUE);
    Drive.stOut.byModesOfOperation := 6;
    Drive.stOut.wControlWord := Control.wControlWord;
    Drive.stOut.wControlWord.4 := xStart;
    Drive.stOut.wControlWord.8 := xHalt;
    Drive(fCycle := 0.001);
    IF iFirst = 0 AND ABS(Drive.fVelocity) > 0.5 THEN
        iFirst := SEL(Drive.fVelocity > 0.0, -1, 1);
    END_IF
    IF Drive.stIn.wStatusWord.12 AND NOT xFound THEN
        fFound := Drive.fVelocity;
        xFound := TRUE;
    END_IF
    xTurned := xTurned OR Drive.stIn.dwDigitalInputs.0 OR Drive.stIn.dwDigitalInputs.1;
    fFastest := MAX(fFastest, ABS(Drive.fVelocity));
    fRamp := MAX(fRamp, ABS(Drive.fVelocity - fBefore) / 0.001);
    fBefore := Drive.fVelocity;
END_FOR
END_PROGRAM
"""
MOMENTARY = {"diHomeFrom": LEFT, "diHomeTo": RIGHT}
TO_THE_RIGHT = {"diHomeFrom": LEFT, "diHomeTo": EVERYWHERE}
TO_THE_LEFT = {"diHomeFrom": -EVERYWHERE, "diHomeTo": LEFT}
DIAGRAMS = {
    # method: home switch, home by its index pulse, direction at last,
    # first direction by where it starts: left of the switch, on it, right of it
    1: ({}, -4000, 1, {-4900: 1, 0: -1, 7900: -1}),
    2: ({}, 7000, -1, {-4900: 1, 0: 1, 7900: -1}),
    3: (TO_THE_RIGHT, 1000, -1, {-2300: 1, 3300: -1}),
    4: (TO_THE_RIGHT, 2000, 1, {-2300: 1, 3300: -1}),
    5: (TO_THE_LEFT, 2000, 1, {-2300: 1, 3300: -1}),
    6: (TO_THE_LEFT, 1000, -1, {-2300: 1, 3300: -1}),
    7: (MOMENTARY, 1000, -1, {-2300: 1, 3300: -1, 6300: 1}),
    8: (MOMENTARY, 2000, 1, {-2300: 1, 3300: -1, 6300: 1}),
    9: (MOMENTARY, 4000, -1, {-2300: 1, 3300: 1, 6300: 1}),
    10: (MOMENTARY, 5000, 1, {-2300: 1, 3300: 1, 6300: 1}),
    11: (MOMENTARY, 5000, 1, {-2300: -1, 3300: 1, 6300: -1}),
    12: (MOMENTARY, 4000, -1, {-2300: -1, 3300: 1, 6300: -1}),
    13: (MOMENTARY, 2000, 1, {-2300: -1, 3300: -1, 6300: -1}),
    14: (MOMENTARY, 1000, -1, {-2300: -1, 3300: -1, 6300: -1}),
}
EDGES = {1: NEGATIVE, 2: POSITIVE, 3: LEFT, 4: LEFT, 5: LEFT, 6: LEFT, 7: LEFT, 8: LEFT, 9: RIGHT, 10: RIGHT}
EDGES |= {11: RIGHT, 12: RIGHT, 13: LEFT, 14: LEFT}
"""The same of methods 17 to 30, which need no index pulse."""


@contextmanager
def drive(start: float, method: int, **settings: float) -> Iterator[Program]:
    """A drive that has been switched on at a place, with limit switches unless told otherwise."""
    known = {"diNegativeLimit": NEGATIVE, "diPositiveLimit": POSITIVE, **settings}
    with run(PROGRAM, 0) as program:
        program.set("Main.Drive", fAngle=start * 2 * math.pi / TURN)
        program.set("Main.Drive", **{f"stSettings.{name}": value for name, value in known.items()})
        program.set("Main.Drive", **{"stSettings.iHomingMethod": method})
        program.cycle()
        program.set("Main", xStart=True)
        yield program


def number(program: Program, name: str) -> float:
    return float(program.literal(f"Main.{name}"))


def bit(program: Program, index: int) -> bool:
    return program.literal(f"Main.Drive.stIn.wStatusWord.{index}") == "TRUE"


def homed(program: Program, cycles: int = 600) -> bool:
    """Whether it comes to an end with success; the bits of the status word must tell one thing only."""
    for _ in range(cycles):
        program.cycle()
        assert not (bit(program, 12) and bit(program, 13))
        if (bit(program, 12) or bit(program, 13)) and bit(program, 10):
            assert number(program, "Drive.fVelocity") == pytest.approx(0.0, abs=0.01)
            return bit(program, 12)
    raise AssertionError("homing goes on and on")


def home(program: Program) -> float:
    """Where the zero of the drive lies, in increments of its motor."""
    count = number(program, "Drive.fAngle") / (2 * math.pi) * TURN
    return count - number(program, "Drive.stIn.diActPosition")


CASES = [
    (method + other, start)
    for method, (_, _, _, starts) in DIAGRAMS.items()
    for other in (0, 16)
    for start in starts
]


@pytest.mark.parametrize(("method", "start"), CASES)
def test_each_method_finds_the_home_of_its_diagram(method: int, start: int) -> None:
    diagram = method if method < 15 else method - 16
    switch, pulse, last, starts = DIAGRAMS[diagram]
    place = pulse if method < 15 else EDGES[diagram]
    with drive(start, method, **switch) as program:
        assert homed(program)
        assert home(program) == pytest.approx(place, abs=1.1)
        assert number(program, "iFirst") == starts[start]
        assert number(program, "fFound") * last == pytest.approx(SLOW, abs=1.1), "the last approach is slow"
        assert number(program, "fFastest") == pytest.approx(FAST, rel=0.15)
        assert number(program, "fRamp") < 1500.0
        away = (diagram in range(7, 11) and start > RIGHT) or (diagram in range(11, 15) and start < LEFT)
        assert (program.literal("Main.xTurned") == "TRUE") == (
            away or diagram in (1, 2) or start in (-4900, 7900)
        )


@pytest.mark.parametrize(
    ("method", "start", "place"), [(33, 300, 0), (33, -300, -1000), (34, 300, 1000), (34, -300, 0)]
)
def test_the_next_index_pulse_is_the_home(method: int, start: int, place: int) -> None:
    with drive(start, method) as program:
        assert homed(program)
        assert home(program) == pytest.approx(place, abs=0.6)
        assert number(program, "fFastest") == pytest.approx(SLOW, rel=0.15)


@pytest.mark.parametrize("method", [35, 37])
def test_the_home_is_where_the_drive_is(method: int) -> None:
    with drive(1234, method) as program:
        assert homed(program)
        assert home(program) == pytest.approx(1234, abs=0.6)
        assert number(program, "fFastest") == 0.0


@pytest.mark.parametrize("offset", [-500, 700])
def test_zero_is_the_home_offset_away_from_the_home(offset: int) -> None:
    """Object 607Ch is added to the home position."""
    with drive(0, 24, **MOMENTARY) as program:
        program.set("Main.Drive", **{"stOut.diHomeOffset": offset})
        assert homed(program)
        assert home(program) == pytest.approx(LEFT + offset, abs=1.1)


@pytest.mark.parametrize("start", [-2300, 6300])
@pytest.mark.parametrize("method", [*range(3, 15), *range(19, 31)])
def test_a_home_switch_that_is_missing_is_an_error(method: int, start: int) -> None:
    with drive(start, method) as program:
        assert not homed(program)


@pytest.mark.parametrize("method", [-128, -1, 0, 15, 16, 31, 32, 36, 38, 127])
def test_a_method_that_there_is_not_is_an_error(method: int) -> None:
    with drive(0, method, **MOMENTARY) as program:
        assert not homed(program)
        assert number(program, "fFastest") == 0.0


def test_a_limit_switch_within_the_way_of_an_index_pulse_is_an_error() -> None:
    with drive(7300, 34) as program:
        assert not homed(program)


@pytest.mark.parametrize("method", range(7, 15))
@pytest.mark.parametrize("start", [-2300, 1405, 6300])
def test_a_switch_within_the_braking_distance_is_found_as_well(method: int, start: int) -> None:
    """It is 10 increments wide; the drive needs 200 to stop."""
    with drive(start, method + 16, diHomeFrom=LEFT, diHomeTo=LEFT + 10) as program:
        assert homed(program)
        edge = LEFT if EDGES[method] == LEFT else LEFT + 10
        assert home(program) == pytest.approx(edge, abs=1.1)


def test_homing_is_halted_and_goes_on() -> None:
    with drive(-2300, 24, **MOMENTARY) as program:
        program.cycle()
        program.cycle()
        assert not bit(program, 10)
        program.set("Main", xHalt=True)
        for _ in range(10):
            program.cycle()
        assert number(program, "Drive.fVelocity") == pytest.approx(0.0, abs=0.01)
        assert [bit(program, index) for index in (10, 12, 13)] == [True, False, False]
        program.set("Main", xHalt=False)
        program.cycle()
        assert homed(program)
        assert home(program) == pytest.approx(LEFT, abs=1.1)


def test_homing_ends_when_its_bit_goes_and_begins_anew() -> None:
    with drive(-2300, 24, **MOMENTARY) as program:
        program.cycle()
        program.set("Main", xStart=False)
        for _ in range(10):
            program.cycle()
        assert [bit(program, index) for index in (10, 12, 13)] == [True, False, False]
        program.set("Main", xStart=True)
        program.cycle()
        assert homed(program)
        program.set("Main", xStart=False)
        program.cycle()
        assert not bit(program, 12)
        program.set("Main", xStart=True)
        program.cycle()
        assert homed(program)
        assert home(program) == pytest.approx(LEFT, abs=1.1)
