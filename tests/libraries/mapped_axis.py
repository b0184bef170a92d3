"""An axis with a drive that speaks CiA 402 and follows at once, with one of each function block."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager

from tests.libraries.st_program import Program, run

CYCLE = 0.002
PROGRAM = """
PROGRAM Main
VAR
    Axis    : SM3_Basic.AXIS_REF_MAPPING_SM3 := (fTaskCycle := 0.002, fRatedTorque := 2.5, {settings});
    Drive   : SM3_Basic.CiA402Drive;
    Power   : SM3_Basic.MC_Power;
    Probe   : SM3_Basic.MC_TouchProbe;
    Trigger : SM3_Basic.TRIGGER_REF := (iTriggerNumber := 1);
    liEdge  : LINT := 1_000_000; (* Where the probe of the drive sees an edge [increments] *)
    Move    : SM3_Basic.MC_MoveAbsolute := (
        Velocity := 180.0, Acceleration := 1000.0, Deceleration := 1000.0);
    Turn    : SM3_Basic.MC_MoveVelocity := (
        Velocity := 180.0, Acceleration := 1000.0, Deceleration := 1000.0);
    Home    : SM3_Basic.MC_Home;
    Ratio   : SM3_Basic.SMC_ChangeGearingRatio;
    Reinit  : SM3_Basic.SMC3_ReinitDrive;
    Freeze  : SM3_Basic.MC_ImmediateStop;
    Mode    : SM3_Basic.SMC_SetControllerMode;
    Torque  : SM3_Basic.MC_TorqueControl;
    Direct  : SM3_Basic.SMC_SetTorque;
    Stop    : SM3_Basic.MC_Stop := (Deceleration := 1000.0);
    xFixed  : BOOL; (* The drive does not change its mode *)
    xFollow : BOOL; (* MC_MoveVelocity takes over when the mode is there *)
    fSpeed  : LREAL; (* Of the motor [increments/s] *)
    Place   : SM3_Basic.MC_SetPosition;
    Reset   : SM3_Basic.MC_Reset;
    Status  : SM3_Basic.MC_ReadStatus;
    Info    : SM3_Basic.MC_ReadAxisInfo;
    AxisError : SM3_Basic.MC_ReadAxisError;
    liPlace : LINT := {place}; (* Of the motor [increments] *)
    xStuck  : BOOL;
    xFault  : BOOL;
    xVolts  : BOOL := TRUE;
    byMode  : BYTE := 8;
    iHoming : INT;
    wStatus : WORD;
    diSteps : DINT; (* Largest step of a set position [increments] *)
    diBefore : DINT;
END_VAR
wStatus := Drive.wStatusWord;
IF byMode = 6 THEN
    wStatus.12 := iHoming >= 20;
    wStatus.10 := iHoming >= 20;
END_IF
Axis.in.wStatusWord := wStatus;
Axis.in.byModesOfOperationDisplay := byMode;
Axis.in.diActPosition := LINT_TO_DINT(liPlace {mask});
Axis.in.wErrorCode := SEL(xFault, WORD#0, WORD#16#8611);
Axis.BeginCycle();
Power(Axis := Axis, Enable := TRUE, bDriveStart := TRUE);
Move(Axis := Axis);
Turn(Axis := Axis);
Home(Axis := Axis);
Place(Axis := Axis);
Ratio(Axis := Axis);
Reinit(Axis := Axis);
Freeze(Axis := Axis);
Mode(Axis := Axis);
IF xFollow AND Mode.bDone THEN
    Turn(Axis := Axis, Execute := TRUE);
END_IF
Torque(Axis := Axis);
Direct(Axis := Axis);
Stop(Axis := Axis);
Reset(Axis := Axis);
Probe(Axis := Axis, TriggerInput := Trigger);
Status(Axis := Axis, Enable := TRUE);
Info(Axis := Axis, Enable := TRUE);
AxisError(Axis := Axis, Enable := TRUE);
Axis.EndCycle();
Drive(wControlWord := Axis.out.wControlWord, bFault := xFault, bVoltage := xVolts);
IF NOT xFixed THEN
    byMode := Axis.out.byModesOfOperation;
END_IF
Axis.in.diActVelocity := 0;
IF Drive.bFollows AND NOT xStuck THEN
    IF Axis.out.wTouchProbeFunction.8 THEN
        Axis.in.wTouchProbeStatus.8 := TRUE;
        IF liPlace < liEdge AND Axis.out.diSetPosition >= liEdge THEN
            Axis.in.wTouchProbeStatus.9 := TRUE;
            Axis.in.diTouchProbePosition[1] := LINT_TO_DINT(liEdge);
        END_IF
    ELSE
        Axis.in.wTouchProbeStatus := 0;
    END_IF
    IF byMode = 8 THEN
        diSteps := MAX(diSteps, ABS(Axis.out.diSetPosition - LINT_TO_DINT(liPlace)));
        Axis.in.diActVelocity := REAL_TO_DINT((Axis.out.diSetPosition - LINT_TO_DINT(liPlace)) / 0.002);
        liPlace := liPlace + (Axis.out.diSetPosition - LINT_TO_DINT(liPlace));
        fSpeed := Axis.in.diActVelocity;
    ELSIF byMode = 9 OR byMode = 10 THEN
        IF byMode = 9 THEN
            fSpeed := Axis.out.diSetVelocity;
        ELSE (* 1 Nm accelerates by 2000 increments/s2 *)
            fSpeed := fSpeed + Axis.out.wSetTorque * 0.001 * 2.5 * 2000.0 * 0.002;
        END_IF
        Axis.in.diActVelocity := LREAL_TO_DINT(fSpeed);
        liPlace := liPlace + LREAL_TO_LINT(fSpeed * 0.002);
    ELSIF Axis.out.wControlWord.4 THEN
        iHoming := iHoming + 1;
        liPlace := SEL(iHoming = 20, liPlace + 3, 0); (* There is its home *)
    END_IF
END_IF
END_PROGRAM
"""
DEGREES = "dwRatioTechUnitsDenom := 3600, iRatioTechUnitsNum := 360, iMovementType := 1"
"""Ten increments are a degree."""
FAST = "fMaxVelocity := 1000.0, fMaxAcceleration := 10000.0, fMaxDeceleration := 10000.0"


@contextmanager
def axis(settings: str = DEGREES, place: int = 0, mask: str = "") -> Iterator[Program]:
    text = PROGRAM.format(settings=settings, place=place, mask=mask)
    with run(text, 5, CYCLE * 1000) as program:
        yield program


def number(program: Program, name: str) -> float:
    return float(program.literal(f"Main.{name}"))


def state(program: Program) -> str:
    return program.literal("Main.Axis.nAxisState").rpartition(".")[2]


def cycles(program: Program, count: int) -> None:
    for _ in range(count):
        program.cycle()


def switch_on(program: Program) -> None:
    program.set("Main.Power", bRegulatorOn=True)
    cycles(program, 10)
    assert state(program) == "standstill"
    assert program.literal("Main.Power.Status") == "TRUE"
