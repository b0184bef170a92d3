"""Programs of the manuals as they are printed, with their task cycle."""

from __future__ import annotations

import pytest
from tests.libraries.st_program import Program, run

CAM = """
PROGRAM Main
VAR
    X, Y : SM3_Basic.AXIS_REF_VIRTUAL_SM3 := (fTaskCycle := 0.004, iMovementType := 1,
        fMaxVelocity := 1000.0, fMaxAcceleration := 1E5, fMaxDeceleration := 1E5);
    MC_PowerX, MC_PowerY : SM3_Basic.MC_Power;
    MC_MoveVelocity0     : SM3_Basic.MC_MoveVelocity;
    MC_CamTableSelect0   : SM3_Basic.MC_CamTableSelect;
    MC_CamIn0            : SM3_Basic.MC_CamIn;
    MC_CamOut0           : SM3_Basic.MC_CamOut;
    MC_Stop0             : SM3_Basic.MC_Stop;
    MasterRun, CamSelect, CamIn, CamOutX : BOOL;
    Cam_A : ARRAY[0..3] OF SM3_Basic.SMC_CAMXYVA := [(dX:=0,dY:=0,dV:=0,dA:=0), (dX:=120,dY:=120,dV:=1,dA:=0),
                                           (dX:=240,dY:=240,dV:=1,dA:=0), (dX:=360,dY:=360,dV:=0,dA:=0)];
    Cam   : SM3_Basic.MC_CAM_REF := (byType:=3, nElements:=4, xStart:=0, xEnd:=360,
        nTappets:=0, strCAMName:='Cam',
        pce:=ADR(Cam_A));
END_VAR
X.BeginCycle();
Y.BeginCycle();
MC_PowerX(Axis:=X, Enable:=TRUE, bRegulatorOn:=TRUE, bDriveStart:=TRUE);
MC_PowerY(Axis:=Y, Enable:=TRUE, bRegulatorOn:=TRUE, bDriveStart:=TRUE);
MC_MoveVelocity0(Axis:=X, Execute:=MasterRun, Velocity:=100, Acceleration:=100, Deceleration:=100,
    Direction:=positive);
MC_CamTableSelect0(Master:=X, Slave:=Y, CamTable:=Cam, Execute:=CamSelect, Periodic:=TRUE,
    MasterAbsolute:=FALSE, SlaveAbsolute:=FALSE);
MC_CamIn0(Master:=X, Slave:=Y, Execute:=CamIn, StartMode:=0, CamTableID:=MC_CamTableSelect0.CamTableID);
MC_CamOut0(Slave:=Y, Execute:=CamOutX);
MC_Stop0(Axis:=Y, Execute:=MC_CamOut0.Done, Deceleration:=100);
X.EndCycle();
Y.EndCycle();
END_PROGRAM
"""
REGISTER = """
PROGRAM Main
VAR
    Master   : SM3_Basic.AXIS_REF_VIRTUAL_SM3 := (fTaskCycle := 0.004, iMovementType := 1,
        fMaxAcceleration := 1E9, fMaxDeceleration := 1E9);
    Power    : SM3_Basic.MC_Power := (Enable := TRUE, bRegulatorOn := TRUE, bDriveStart := TRUE);
    Run      : SM3_Basic.MC_MoveVelocity := (Velocity := 100.0, Acceleration := 1E9, Deceleration := 1E9);
    aTappets : ARRAY[0..0] OF SM3_Basic.SMC_CAMTappet := [(iGroupID := 1, x := 180.0)];
    Cam      : SM3_Basic.MC_CAM_REF := (byType := 3, xEnd := 360.0, nTappets := 1, pt := ADR(aTappets));
    Register : SM3_Basic.SMC_CamRegister := (Enable := TRUE);
    aBits    : ARRAY[1..SM3_Basic.MAX_NUM_TAPPETS] OF BOOL;
    fThere   : LREAL; (* Of the master when the bit came *)
    diThere  : DINT;  (* Cycles since it was at 180 *)
END_VAR
Master.BeginCycle();
Power(Axis := Master);
Run(Axis := Master);
Register(Master := Master, CamTable := Cam, bTappet := aBits);
IF NOT aBits[1] THEN
    fThere := Master.fSetPosition + 0.4;
    IF Master.fSetPosition >= 180.0 - 1E-6 THEN
        diThere := diThere + 1;
    END_IF
END_IF
Master.EndCycle();
END_PROGRAM
"""


SLAVES = """
PROGRAM Main
VAR
    Master, First, Second : SM3_Basic.AXIS_REF_VIRTUAL_SM3 := (fTaskCycle := 0.004, iMovementType := 1,
        fMaxAcceleration := 1E9, fMaxDeceleration := 1E9);
    Power  : ARRAY[0..2] OF SM3_Basic.MC_Power;
    Run    : SM3_Basic.MC_MoveVelocity := (Velocity := 100.0, Acceleration := 1E6, Deceleration := 1E6);
    Points : ARRAY[0..1] OF SM3_Basic.SMC_CAMXYVA := [(dV := 1.0), (dX := 3600.0, dY := 3600.0, dV := 1.0)];
    Cam    : SM3_Basic.MC_CAM_REF := (byType := 3, nElements := 2, xEnd := 3600.0, pce := ADR(Points));
    Select1, Select2 : SM3_Basic.MC_CamTableSelect := (Execute := TRUE);
    CamIn1, CamIn2   : SM3_Basic.MC_CamIn;
    Overlay : SM3_Basic.MC_MoveSuperImposed := (Distance := 5.0, VelocityDiff := 20.0, Acceleration := 500.0,
        Deceleration := 500.0);
END_VAR
Master.BeginCycle();
First.BeginCycle();
Second.BeginCycle();
Power[0](Axis := Master, Enable := TRUE, bRegulatorOn := TRUE, bDriveStart := TRUE);
Power[1](Axis := First, Enable := TRUE, bRegulatorOn := TRUE, bDriveStart := TRUE);
Power[2](Axis := Second, Enable := TRUE, bRegulatorOn := TRUE, bDriveStart := TRUE);
Run(Axis := Master);
Select1(Master := Master, Slave := First, CamTable := Cam);
Select2(Master := Master, Slave := Second, CamTable := Cam);
CamIn1(Master := Master, Slave := First, CamTableID := Select1.CamTableID);
CamIn2(Master := Master, Slave := Second, CamTableID := Select2.CamTableID, SlaveScaling := 0.5);
Overlay(Axis := Second);
Master.EndCycle();
First.EndCycle();
Second.EndCycle();
END_PROGRAM
"""
EXTERNAL = """
PROGRAM Main
VAR
    Encoder : SM3_Basic.AXIS_REF_MAPPING_SM3 := (fTaskCycle := 0.004, iMovementType := 0,
        fPositionPeriod := 360.0, dwRatioTechUnitsDenom := 10, iRatioTechUnitsNum := 1);
    Y       : SM3_Basic.AXIS_REF_VIRTUAL_SM3 := (fTaskCycle := 0.004, iMovementType := 1,
        fMaxVelocity := 1E6, fMaxAcceleration := 1E9, fMaxDeceleration := 1E9);
    Power   : SM3_Basic.MC_Power := (Enable := TRUE, bRegulatorOn := TRUE, bDriveStart := TRUE);
    Gear    : SM3_Basic.MC_GearIn := (RatioDenominator := 2, Acceleration := 1E6, Deceleration := 1E6);
    Move    : SM3_Basic.MC_MoveVelocity := (Velocity := 1.0, Acceleration := 1.0, Deceleration := 1.0);
    diCount : DINT; (* Of the counter that is read *)
    diStep  : DINT; (* A cycle *)
END_VAR
diCount := diCount + diStep;
Encoder.in.diActPosition := diCount;
Encoder.BeginCycle();
Y.BeginCycle();
Power(Axis := Y);
Gear(Master := Encoder, Slave := Y);
Move(Axis := Encoder);
Encoder.EndCycle();
Y.EndCycle();
END_PROGRAM
"""


def number(program: Program, name: str) -> float:
    return float(program.literal(f"Main.{name}"))


def state(program: Program) -> int:
    names = ("power_off", "errorstop", "stopping", "standstill")
    names += ("discrete_motion", "continuous_motion", "synchronized_motion", "homing")
    return names.index(program.literal("Main.Y.nAxisState").rpartition(".")[2])


def cycles(program: Program, count: int) -> None:
    for _ in range(count):
        program.cycle()


def test_the_cam_program() -> None:
    """ax3000 EX-AX-17, CAM-03, CAM-04, CAM-14, AST-07, AST-08, AST-10, AXIS-02: each signal in its turn."""
    with run(CAM, 4, 4.0) as program:
        assert state(program) == 3
        program.set("Main", MasterRun=True)
        cycles(program, 260)
        assert number(program, "X.fSetVelocity") == 100.0
        assert program.literal("Main.MC_CamTableSelect0.Done") == "FALSE"
        program.set("Main", CamSelect=True)
        program.cycle()
        assert program.literal("Main.MC_CamTableSelect0.Done") == "TRUE"
        assert state(program) == 3
        start, here = number(program, "X.fSetPosition"), number(program, "Y.fSetPosition")
        program.set("Main", CamIn=True)
        program.cycle()
        assert state(program) == 6
        start += 0.4  # of the cycle in which the cam begins
        cycles(program, 449)
        assert number(program, "X.fSetPosition") - start == pytest.approx(180.0 - 0.4, abs=0.5)
        assert number(program, "Y.fSetPosition") - here == pytest.approx(
            number(program, "X.fSetPosition") - start, abs=1e-9
        ), "the cam is a line with the slope 1 there"
        velocity = number(program, "Y.fSetVelocity")
        program.set("Main", CamOutX=True)
        program.cycle()
        assert program.literal("Main.MC_CamOut0.Done") == "TRUE"
        assert velocity == pytest.approx(100.0)
        assert state(program) == 2, "MC_Stop takes over in the call behind MC_CamOut"
        cycles(program, 251)
        assert (number(program, "Y.fSetVelocity"), program.literal("Main.MC_Stop0.Done")) == (0.0, "TRUE")
        assert state(program) == 2
        program.set("Main", CamOutX=False)
        cycles(program, 2)
        assert state(program) == 3


@pytest.mark.parametrize(("time", "at", "late"), [(0.0, 180.0, 0), (0.02, 178.0, 0), (-0.02, 182.0, 5)])
def test_dead_times_in_cycles_of_four_milliseconds(time: float, at: float, late: int) -> None:
    """motion_semantics EX-23 and ax3000 EX-AX-18, v = 100 u/s, P = 180: at P - v T, or 5 cycles late."""
    with run(REGISTER, 4, 4.0) as program:
        program.set("Main.Register", DeadTimeCompensation=time)
        program.set("Main.Run", Execute=True)
        cycles(program, 600)
        assert program.literal("Main.aBits[1]") == "TRUE"
        assert number(program, "fThere") == pytest.approx(at, abs=0.4 + 1e-6)
        assert abs(number(program, "diThere") - late) <= 1


def test_several_slaves_have_one_cam_and_one_master() -> None:
    """ax3000 CAM-01: each with its own scaling, and a motion superimposed on one of them."""
    with run(SLAVES, 5, 4.0) as program:
        program.set("Main.CamIn1", Execute=True)
        program.set("Main.CamIn2", Execute=True)
        program.set("Main.Run", Execute=True)
        cycles(program, 100)
        places = [number(program, f"{name}.fSetPosition") for name in ("Master", "First", "Second")]
        assert places == pytest.approx([places[0], places[0], places[0] / 2], abs=1e-9)
        program.set("Main.Overlay", Execute=True)
        cycles(program, 200)
        assert program.literal("Main.Overlay.Done") == "TRUE"
        places = [number(program, f"{name}.fSetPosition") for name in ("Master", "First", "Second")]
        assert places == pytest.approx([places[0], places[0], places[0] / 2 + 5.0], abs=1e-9)


def test_a_counter_without_a_drive_leads_a_slave() -> None:
    """ax3000 AXIS-06: it is a master and nothing else, over its period too."""
    with run(EXTERNAL, 5, 4.0) as program:
        program.set("Main.Gear", Execute=True)
        cycles(program, 3)
        assert program.literal("Main.Gear.InGear") == "TRUE"
        program.set("Main", diStep=20)
        cycles(program, 1000)
        program.set("Main", diStep=0)
        cycles(program, 5)
        assert number(program, "Encoder.fActPosition") == pytest.approx(2000.0 % 360.0)
        assert number(program, "Y.fSetPosition") == pytest.approx(1000.0, abs=1e-6)
        program.set("Main.Move", Execute=True)
        program.cycle()
        assert program.literal("Main.Move.Error") == "TRUE"
