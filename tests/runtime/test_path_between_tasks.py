"""A path from a task that always runs to the bus task, which interrupts it: nothing is lost or doubled.

Spec CNCR-03, CNCR-05, CNCR-116, with threads of the host; `test_cnc_tasks.py` has every order of whole calls.
"""

from __future__ import annotations

import time

import pytest
from library_programs import MS, compiled

from tappet.iec.task import Task
from tappet.runtime.local import LocalRuntime

OBJECTS = 2500
CALLS = 60
"""Of the chain in a cycle: so long that the bus task comes in between."""
SHORTEST, STEP, LENGTHS = 0.2, 0.01, 7
VELOCITY = 200.0
TEXT = f"""
VAR_GLOBAL
    xInside : BOOL; (* The slow task is at its path *)
END_VAR

PROGRAM Slow
VAR
    geo    : SM3_CNC.SMC_GEOINFO;
    queue  : SM3_CNC.SMC_OUTQUEUE;
    tool   : SM3_CNC.SMC_ToolLengthCorr;
    smooth : SM3_CNC.SMC_SmoothPath;
    slopes : SM3_CNC.SMC_RecomputeABCSlopes;
    check  : SM3_CNC.SMC_CheckVelocities;
    aIn, aFirst, aSecond, aThird : ARRAY[1..60] OF SM3_CNC.SMC_GEOINFO;
    n      : DINT; (* Objects that were made *)
    nError : DINT;
    nCall  : DINT;
    dX     : LREAL;
END_VAR
xInside := TRUE;
IF n = 0 THEN
    queue.pbyBuffer := ADR(aIn);
    SM3_CNC.SMC_SetQueueCapacity(ADR(queue), SIZEOF(aIn));
    geo.iMoveType := SM3_CNC.SMC_MOVTYP.LIN;
    geo.dVel := {VELOCITY};
    geo.dAccel := 5000;
    geo.dDecel := 5000;
END_IF
FOR nCall := 1 TO {CALLS} DO
    WHILE n < {OBJECTS} AND NOT queue.bFull DO
        geo.piStartPos.dX := dX;
        geo.dLength := {SHORTEST} + {STEP} * TO_LREAL(n MOD {LENGTHS});
        dX := dX + geo.dLength;
        geo.piDestPos.dX := dX;
        geo.piStartPos.dA := TO_LREAL(n);
        geo.piDestPos.dA := TO_LREAL(n + 1);
        geo.piStartPos.wAuxData := 2#1111;
        geo.dVelEnd := geo.dVel;
        n := n + 1;
        geo.iHelpID[0] := TO_INT(n);
        geo.dHelpPos[0] := 1.0;
        SM3_CNC.SMC_AppendObj(ADR(queue), ADR(geo));
    END_WHILE
    queue.bEndOfList := n >= {OBJECTS};
    tool(bExecute := TRUE, poqDataIn := ADR(queue), nSizeOutQueue := SIZEOF(aFirst),
        pbyBufferOutQueue := ADR(aFirst));
    smooth(bExecute := TRUE, poqDataIn := tool.poqDataOut, nSizeOutQueue := SIZEOF(aSecond),
        pbyBufferOutQueue := ADR(aSecond));
    slopes(bExecute := TRUE, poqDataIn := smooth.poqDataOut, nSizeOutQueue := SIZEOF(aThird),
        pbyBufferOutQueue := ADR(aThird));
    check(bExecute := TRUE, poqDataIn := slopes.poqDataOut, dAngleTol := 1);
    nError := MAX(nError, tool.wErrorID, smooth.wErrorID, slopes.wErrorID, check.wErrorID);
END_FOR
xInside := FALSE;
END_PROGRAM

PROGRAM Bus
VAR
    ipo   : SM3_CNC.SMC_Interpolator := (dwIpoTime := 1000);
    dWay, dBefore : LREAL;
    iSwitch : INT;
    nWrong, nInside, nCycles, nError : DINT;
END_VAR
IF xInside THEN
    nInside := nInside + 1;
END_IF
ipo(bExecute := TRUE, poqDataIn := Slow.check.poqDataOut, dLastWayPos := dWay);
dWay := ipo.dWayPos;
IF ipo.bError THEN
    nError := ipo.wErrorID;
END_IF
IF ipo.piSetPosition.dX < dBefore OR ipo.piSetPosition.dX > dBefore + {VELOCITY / 1000 * (1 + 1e-9)}
    OR ABS(ipo.piSetPosition.dX - dWay) > 1E-6 OR ipo.iLastSwitch < iSwitch
    OR ABS(ipo.piSetPosition.dX / {SHORTEST + STEP * (LENGTHS - 1) / 2} - ipo.piSetPosition.dA) > 1
THEN
    nWrong := nWrong + 1;
END_IF
dBefore := ipo.piSetPosition.dX;
iSwitch := ipo.iLastSwitch;
nCycles := nCycles + 1;
END_PROGRAM
"""


@pytest.mark.slow
def test_nothing_is_lost_or_doubled_where_the_bus_task_interrupts() -> None:
    tasks = (
        Task("SlowTask", "freewheeling", priority=20, programs=("Slow",)),
        Task("BusTask", interval_ns=MS, priority=1, programs=("Bus",)),
    )
    length = sum(SHORTEST + STEP * (n % LENGTHS) for n in range(OBJECTS))
    package = compiled(TEXT, "Conversion", "SM3_CNC", tasks=tasks)
    with LocalRuntime(package, virtual=False) as runtime:
        due = time.monotonic() + 90
        runtime.run(cycles=1)
        while not runtime.read("Bus.ipo.bDone"):
            assert time.monotonic() < due, "the path does not come to its end"
            assert runtime.read("Bus.nError") == 0
            runtime.run(cycles=50)
        assert runtime.read("Bus.nInside") > 5, "the bus task has interrupted the slow one"
        assert runtime.read("Slow.nError") == 0
        assert runtime.read("Bus.nWrong") == 0
        assert runtime.read("Bus.dWay") == pytest.approx(length, abs=1e-6)
        assert runtime.read("Bus.ipo.iLastSwitch") == OBJECTS
        assert runtime.read("Bus.ipo.piSetPosition.dA") == pytest.approx(OBJECTS)
