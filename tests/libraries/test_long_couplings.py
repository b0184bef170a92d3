"""Gears stay where exact rational arithmetic has them, after millions of cycles."""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction

import pytest
from tests.libraries.st_program import Program, run

FEW, MANY = 1_000_000, 10_000_000
PERIOD = 360
LARGEST = 1e-9
"""Deviation of the slave [u]."""
BLOCKS = ("Gear", "GearPos", "Combine", "Backlash")
_AXIS = "fTaskCycle := 0.001, fMaxVelocity := 1E6, fMaxAcceleration := 1E12, fMaxDeceleration := 1E12"
PROGRAM = f"""
PROGRAM Main
VAR
    Master, Other, Slave : SM3_Basic.AXIS_REF_VIRTUAL_SM3 := ({_AXIS}, iMovementType := {{movement}});
    PowerM, PowerO, PowerS : SM3_Basic.MC_Power := (
        Enable := TRUE, bRegulatorOn := TRUE, bDriveStart := TRUE);
    Lead, Second : SM3_Basic.MC_MoveVelocity := (
        Velocity := 123.456, Acceleration := 1E6, Deceleration := 1E6, Direction := {{direction}});
    Gear     : SM3_Basic.MC_GearIn := (RatioDenominator := 3, Acceleration := 1E9, Deceleration := 1E9);
    GearPos  : SM3_Basic.MC_GearInPos := (
        RatioDenominator := 3,
        MasterSyncPosition := {{direction}} * 20.0, SlaveSyncPosition := {{direction}} * 5.0);
    Combine  : SM3_Basic.MC_CombineAxes := (
        GearRatioDenominatorM1 := 3, GearRatioNumeratorM2 := 2, GearRatioDenominatorM2 := 7);
    Backlash : SM3_Basic.SMC_BacklashCompensation := (
        fCompensationVel := 100.0, fCompensationAcc := 1000.0, fCompensationDec := 1000.0);
    diCycles : DINT := 1000;
    diCycle  : DINT;
    afPlaces : ARRAY[0..2] OF LREAL;
    aliTurns : ARRAY[0..2] OF LINT;
END_VAR
FOR diCycle := 1 TO diCycles DO
    Master.BeginCycle(); Other.BeginCycle(); Slave.BeginCycle();
    PowerM(Axis := Master); PowerO(Axis := Other); PowerS(Axis := Slave);
    Lead(Axis := Master, Execute := PowerM.Status);
    Second(Axis := Other, Execute := PowerO.Status, Velocity := 77.7);
    {{block}}({{masters}}, Slave := Slave, {{execute}} := PowerS.Status);
    Master.EndCycle(); Other.EndCycle(); Slave.EndCycle();
    Count(0, Master.fSetPosition);
    Count(1, Other.fSetPosition);
    Count(2, Slave.fSetPosition);
END_FOR

METHOD Count
VAR_INPUT
    iAxis  : INT;
    fPlace : LREAL; (* [u] *)
END_VAR
IF fPlace - afPlaces[iAxis] < -180.0 THEN
    aliTurns[iAxis] := aliTurns[iAxis] + 1;
ELSIF fPlace - afPlaces[iAxis] > 180.0 THEN
    aliTurns[iAxis] := aliTurns[iAxis] - 1;
END_IF
afPlaces[iAxis] := fPlace;
END_METHOD
END_PROGRAM
"""
GEAR: dict[str, Callable[[Fraction, Fraction], Fraction]] = {
    "Gear": lambda master, _: master / 3,
    "GearPos": lambda master, _: master / 3,
    "Combine": lambda master, other: master / 3 + 2 * other / 7,
    "Backlash": lambda master, _: master,
}


def _places(program: Program, rotary: bool) -> list[Fraction]:
    """Of master, other master and slave, with all turns."""
    places = program.numbers("Main.afPlaces")
    turns = program.numbers("Main.aliTurns") if rotary else (0, 0, 0)
    return [Fraction(place) + PERIOD * Fraction(turn) for place, turn in zip(places, turns, strict=True)]


def _deviation(block: str, rotary: bool, direction: int, cycles: int) -> float:
    text = PROGRAM.format(
        movement=0 if rotary else 1,
        direction=direction,
        block=block,
        masters="Master1 := Master, Master2 := Other" if block == "Combine" else "Master := Master",
        execute="bExecute" if block == "Backlash" else "Execute",
    )
    with run(text, 1) as program:
        before = _places(program, rotary)
        program.set("Main", diCycles=cycles)
        program.cycle()
        after = _places(program, rotary)
    master, other, slave = (b - a for a, b in zip(before, after, strict=True))
    assert abs(master) > Fraction(cycles, 10)
    return float(abs(slave - GEAR[block](master, other)))


@pytest.mark.parametrize("direction", [1, -1])
@pytest.mark.parametrize("rotary", [False, True])
@pytest.mark.parametrize("block", BLOCKS)
def test_a_gear_does_not_drift(block: str, rotary: bool, direction: int) -> None:
    assert _deviation(block, rotary, direction, FEW) < LARGEST


@pytest.mark.slow
@pytest.mark.parametrize("direction", [1, -1])
@pytest.mark.parametrize("rotary", [False, True])
@pytest.mark.parametrize("block", BLOCKS)
def test_a_gear_does_not_drift_in_hours(block: str, rotary: bool, direction: int) -> None:
    assert _deviation(block, rotary, direction, MANY) < LARGEST
