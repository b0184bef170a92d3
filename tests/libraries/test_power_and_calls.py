"""MC_Power and readers in every cycle, blocks that are called together or with another axis than before."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager

from tests.libraries.st_program import Program, run

PROGRAM = """
PROGRAM Main
VAR
    First  : SM3_Basic.AXIS_REF_VIRTUAL_SM3 := (fTaskCycle := {cycle});
    Second : SM3_Basic.AXIS_REF_VIRTUAL_SM3 := (fTaskCycle := 0.001);
    Servo  : SM3_Basic.AXIS_REF_MAPPING_SM3 := (fTaskCycle := 0.01, iRatioTechUnitsNum := 1,
        dwRatioTechUnitsDenom := 1);
    Power  : SM3_Basic.MC_Power := (Enable := TRUE, bRegulatorOn := TRUE, bDriveStart := TRUE);
    Other  : SM3_Basic.MC_Power;
    Power2 : SM3_Basic.MC_Power := (Enable := TRUE, bRegulatorOn := TRUE, bDriveStart := TRUE);
    Drive  : SM3_Basic.MC_Power := (Enable := TRUE, bRegulatorOn := TRUE, bDriveStart := TRUE);
    Move   : SM3_Basic.MC_MoveAbsolute := (Position := 100.0, Velocity := 10.0, Acceleration := 100.0,
        Deceleration := 100.0);
    Later  : SM3_Basic.MC_MoveVelocity := (Velocity := 20.0, Acceleration := 100.0, Deceleration := 100.0);
    Place  : SM3_Basic.MC_ReadActualPosition;
    Speed  : SM3_Basic.MC_ReadActualVelocity;
    Torque : SM3_Basic.MC_ReadActualTorque;
    Status : SM3_Basic.MC_ReadStatus;
    xOther : BOOL; (* Two MC_Power have the same axis *)
    xSwaps : BOOL; (* The block is called with the second axis *)
END_VAR
First.BeginCycle();
Second.BeginCycle();
Servo.BeginCycle();
Power(Axis := First);
IF xOther THEN
    Other(Axis := First);
END_IF
Power2(Axis := Second);
Drive(Axis := Servo);
IF xSwaps THEN
    Move(Axis := Second);
ELSE
    Move(Axis := First);
END_IF
Later(Axis := First);
Place(Axis := First);
Speed(Axis := First);
Torque(Axis := First);
Status(Axis := First);
First.EndCycle();
Second.EndCycle();
Servo.EndCycle();
END_PROGRAM
"""


@contextmanager
def axes(cycle: float = 0.001) -> Iterator[Program]:
    with run(PROGRAM.format(cycle=cycle), 3) as program:
        yield program


def _cycles(program: Program, count: int) -> None:
    for _ in range(count):
        program.cycle()


def _true(program: Program, path: str) -> bool:
    return program.literal(f"Main.{path}") == "TRUE"


def test_the_outputs_follow_the_axis_in_every_cycle() -> None:
    """motion_semantics ENA-04, PWR-01."""
    with axes() as program:
        assert _true(program, "Power.Status")
        program.set("Main.Power", bDriveStart=False)
        _cycles(program, 2)
        assert not _true(program, "Power.Status")
        assert _true(program, "Power.bRegulatorRealState")
        assert not _true(program, "Power.bDriveStartRealState")
        program.set("Main.Power", Enable=False, bDriveStart=True)
        _cycles(program, 2)
        assert not _true(program, "Power.bRegulatorRealState")
        program.set("Main.Power", Enable=True)
        _cycles(program, 2)
        assert _true(program, "Power.Status")


def test_without_the_regulator_the_axis_stands_at_once() -> None:
    """motion_semantics PWR-02: also in motion."""
    with axes() as program:
        program.set("Main.Move", Execute=True)
        _cycles(program, 500)
        assert program.literal("Main.First.nAxisState") == "discrete_motion"
        program.set("Main.Power", bRegulatorOn=False)
        _cycles(program, 2)
        assert program.literal("Main.First.nAxisState") == "power_off"
        assert float(program.literal("Main.First.fSetVelocity")) == 0.0
        assert program.literal("Main.Move.ErrorID") == "SMC_FB_ACTIVE_AXIS_DISABLED"


def test_a_drive_that_does_not_switch_on_is_an_error_after_five_seconds() -> None:
    """motion_semantics PWR-04: its status word stays 0."""
    with axes() as program:
        _cycles(program, 490)
        assert _true(program, "Drive.Busy")
        assert not _true(program, "Drive.Error")
        _cycles(program, 20)
        assert program.literal("Main.Drive.ErrorID") == "SMC_REGULATOR_OR_START_NOT_SET"
        assert not _true(program, "Drive.Status")


def test_an_axis_without_a_cycle_time_is_an_error() -> None:
    """motion_semantics PWR-05."""
    with axes(0.0) as program:
        assert program.literal("Main.Power.ErrorID") == "SMC_P_FTASKCYCLE_EMPTY"


def test_of_two_instances_the_last_one_decides() -> None:
    """motion_semantics PWR-06."""
    with axes() as program:
        program.set("Main", xOther=True)
        _cycles(program, 2)
        assert program.literal("Main.First.nAxisState") == "power_off"
        program.set("Main.Other", Enable=True, bRegulatorOn=True, bDriveStart=True)
        program.set("Main.Power", Enable=False)
        _cycles(program, 2)
        assert program.literal("Main.First.nAxisState") == "standstill"


def test_an_instance_that_is_called_with_another_axis_fails() -> None:
    """motion_semantics CAL-05: the second axis is left alone."""
    with axes() as program:
        program.set("Main.Move", Execute=True)
        _cycles(program, 100)
        program.set("Main", xSwaps=True)
        _cycles(program, 2)
        assert program.literal("Main.Move.ErrorID") == "SMC_AXIS_REF_CHANGED_DURING_OPERATION"
        assert program.literal("Main.Second.nAxisState") == "standstill"
        assert float(program.literal("Main.Second.fSetPosition")) == 0.0


def test_of_two_commands_in_a_cycle_the_last_one_owns_the_axis() -> None:
    """motion_semantics INF-01."""
    with axes() as program:
        program.set("Main.Move", Execute=True)
        program.set("Main.Later", Execute=True)
        _cycles(program, 2)
        assert _true(program, "Move.CommandAborted")
        assert _true(program, "Later.Active")
        assert program.literal("Main.First.nAxisState") == "continuous_motion"


def test_readers_tell_the_values_of_each_cycle_while_they_are_enabled() -> None:
    """motion_semantics TRQ-07, DIA-01."""
    with axes() as program:
        for block in ("Place", "Speed", "Torque", "Status"):
            program.set(f"Main.{block}", Enable=True)
        program.set("Main.Later", Execute=True)
        told = set()
        for _ in range(300):
            _cycles(program, 1)
            assert program.literal("Main.Place.Position") == program.literal("Main.First.fActPosition")
            assert program.literal("Main.Speed.Velocity") == program.literal("Main.First.fActVelocity")
            assert program.literal("Main.Torque.Torque") == program.literal("Main.First.fActTorque")
            told.add(
                tuple(
                    name
                    for name in ("Accelerating", "ConstantVelocity", "Decelerating", "FBErrorOccured")
                    if _true(program, f"Status.{name}")
                )
            )
        assert told >= {("Accelerating",), ("ConstantVelocity",)}
        assert float(program.literal("Main.Speed.Velocity")) == 20.0
        program.set("Main.Move", Execute=True, Velocity=-1.0)
        _cycles(program, 2)
        assert _true(program, "Status.FBErrorOccured")
        program.set("Main.Later", Execute=False)
        _cycles(program, 1)
        program.set("Main.Later", Execute=True, Velocity=5.0)
        _cycles(program, 10)
        assert _true(program, "Status.Decelerating")
        program.set("Main.Speed", Enable=False)
        _cycles(program, 2)
        assert not _true(program, "Speed.Valid")
