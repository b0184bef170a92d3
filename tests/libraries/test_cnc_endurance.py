"""An endless path: a generator, the velocity check and the interpolator, for a day of virtual time."""

from __future__ import annotations

import pytest
from tests.libraries.cnc_motion import BUFFER, chain
from tests.libraries.st_program import run

CAPACITY = 40
CALLS = 100_000
"""Calls of the interpolator in one cycle of the program."""
PROGRAM = f"""
PROGRAM Main
VAR
    {chain(CAPACITY)}
    ipo     : SM3_CNC.SMC_Interpolator := (dwIpoTime := 10000, iVelMode := SM3_CNC.SMC_INT_VELMODE.SIGMOID);
    xFilled : BOOL;
    n, nCalls : DINT;
    udiMade : UDINT;       (* Objects of the generator *)
    udiM    : UDINT;       (* M functions acknowledged *)
    udiSwitched : UDINT;   (* Changes of the switch point that each line has *)
    dwBefore : DWORD;
    wBefore : WORD;
    dBefore, dSteepest, dFastest : LREAL;
    dMade, dWay, dOff : LREAL; (* Ways of generator and interpolator; largest distance from the path *)
    xWrong  : BOOL;
    udiMs, udiLines : UDINT; (* M functions and lines of the generator *)
    dAt     : LREAL;         (* Angle that it has come to [degrees] *)
    xSwitch : BOOL;
    udiRandom : UDINT := 12345;
END_VAR
IF NOT xFilled THEN
    xFilled := TRUE;
    {BUFFER}
END_IF
FOR n := 1 TO nCalls DO
    WHILE NOT queue.bFull DO
        Generate();
    END_WHILE
    check(bExecute := TRUE, poqDataIn := ADR(queue), dAngleTol := 0.01);
    ipo(bExecute := TRUE, poqDataIn := ADR(queue), bAcknM := wBefore <> 0);
    IF wBefore <> 0 AND ipo.wM = 0 THEN
        udiM := udiM + 1;
    END_IF
    wBefore := ipo.wM;
    IF ipo.dwSwitches <> dwBefore THEN
        udiSwitched := udiSwitched + 1;
        dwBefore := ipo.dwSwitches;
    END_IF
    dWay := dWay + ipo.dWayPos;
    dSteepest := MAX(dSteepest, ABS(ipo.dVel - dBefore));
    dFastest := MAX(dFastest, ipo.dVel);
    dBefore := ipo.dVel;
    dOff := MAX(dOff, ABS(SQRT(ipo.piSetPosition.dX * ipo.piSetPosition.dX
        + ipo.piSetPosition.dY * ipo.piSetPosition.dY) - 100.0));
    xWrong := xWrong OR ipo.bError OR ipo.bDone OR check.bError OR ipo.wErrorID = 1003;
END_FOR
END_PROGRAM

(* An arc of a circle around 0 in random pieces; now and then an M function. *)
METHOD Generate
VAR
    dAngle : LREAL;
END_VAR
udiRandom := (udiRandom * 1103 + 12345) MOD 65536;
IF udiRandom MOD 16 = 0 AND geo.iMoveType <> SM3_CNC.SMC_MOVTYP.MCOMMAND THEN
    geo.iMoveType := SM3_CNC.SMC_MOVTYP.MCOMMAND;
    geo.iHelpID[0] := 7;
    udiMs := udiMs + 1;
ELSE
    geo.iMoveType := SM3_CNC.SMC_MOVTYP.CCLW;
    dAngle := 3.0 + UDINT_TO_LREAL(udiRandom MOD 1000) * 0.02;
    geo.dP3 := 100.0;
    geo.dT1 := dAt;
    geo.dT2 := -dAngle;
    geo.piStartPos := geo.piDestPos;
    IF udiLines = 0 THEN
        geo.piStartPos.dX := 100.0;
        geo.piStartPos.dY := 0.0;
    END_IF
    dAt := dAt + dAngle;
    WHILE dAt >= 360.0 DO dAt := dAt - 360.0; END_WHILE
    geo.piDestPos.dX := 100.0 * COS(dAt * 0.017453292519943295);
    geo.piDestPos.dY := 100.0 * SIN(dAt * 0.017453292519943295);
    SM3_CNC.SMC_CalcLengthGeo(ADR(geo));
    dMade := dMade + geo.dLength;
    geo.dVel := SEL(udiRandom MOD 3 = 0, 50.0, 20.0);
    geo.dVelEnd := geo.dVel;
    xSwitch := NOT xSwitch;
    geo.iHelpID[0] := SEL(xSwitch, -3, 3);
    geo.dHelpPos[0] := 0.5;
    udiLines := udiLines + 1;
END_IF
SM3_CNC.SMC_AppendObj(ADR(queue), ADR(geo));
udiMade := udiMade + 1;
END_METHOD
"""


def check_run(seconds: float) -> None:
    cycles = round(seconds / 0.01)
    with run(PROGRAM, cycles=0) as program:

        def number(name: str) -> float:
            return float(program.literal(f"Main.{name}"))

        program.set("Main", nCalls=min(cycles, CALLS))
        for _ in range(max(1, cycles // CALLS)):
            program.cycle()
            assert program.literal("Main.xWrong") == "FALSE"
        # What was made is passed or waits, each object once
        assert number("udiMade") == number("udiMs") + number("udiLines")
        in_queue = CAPACITY - 3
        assert number("udiMs") - in_queue <= number("udiM") <= number("udiMs")
        assert number("udiLines") - in_queue <= number("udiSwitched") <= number("udiLines")
        passed = number("udiM") + number("udiSwitched")
        assert number("udiMade") - in_queue - 1 <= passed <= number("udiMade")
        left = number("dMade") - number("dWay")
        assert 0.0 <= left <= in_queue * 100.0 * 0.4014257
        assert number("dOff") <= 1e-9
        assert number("dFastest") <= 50.0 + 1e-9
        assert number("dSteepest") <= 1.570797 + 1e-6


def test_a_quarter_of_an_hour() -> None:
    """Spec CNCR-03, CNCR-05: an endless path; no stop but those of the path, nothing lost or doubled."""
    check_run(900.0)


@pytest.mark.slow
def test_a_day() -> None:
    """Spec CNCR-03: the queue is all the memory there is; 8.64 million cycles."""
    check_run(86400.0)
