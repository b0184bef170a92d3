"""A slow producer with the check and a fast interpolator, called in any order."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from tests.libraries.cnc_motion import BUFFER, chain
from tests.libraries.st_program import run

CAPACITY = 12
STEPS = 3000
PATTERN = 30
APPEND, CHECK, INTERPOLATE = range(3)
CYCLE = 0.01
PROGRAM = f"""
PROGRAM Main
VAR
    {chain(CAPACITY)}
    ipo     : SM3_CNC.SMC_Interpolator := (dwIpoTime := {round(CYCLE * 1e6)}, bAcknM := TRUE);
    read    : SM3_CNC.SMC_GetMParameters := (bEnable := TRUE);
    xFilled : BOOL;
    nSteps, n, nObjects, nNext : DINT;
    aStep   : ARRAY[0..{PATTERN - 1}] OF DINT;
    nPattern : DINT := 1;
    aLength, aVelocity, aNumber : ARRAY[0..199] OF LREAL;
    nCalls  : DINT;
    dTotal, dX : LREAL;
    aS, aV, aError, aSwitch, aWay : ARRAY[0..{STEPS - 1}] OF LREAL;
END_VAR
IF NOT xFilled THEN
    xFilled := TRUE;
    {BUFFER}
    check(bExecute := TRUE, poqDataIn := ADR(queue));
END_IF
nCalls := 0;
FOR n := 0 TO nSteps - 1 DO
    CASE aStep[n MOD nPattern] OF
        {APPEND}: Produce();
        {CHECK}: check(bExecute := TRUE, poqDataIn := ADR(queue));
        {INTERPOLATE}:
            ipo(bExecute := TRUE, poqDataIn := ADR(queue), dLastWayPos := dTotal);
            dTotal := ipo.dWayPos;
            aS[nCalls] := ipo.piSetPosition.dX;
            aV[nCalls] := ipo.dVel;
            aError[nCalls] := ipo.wErrorID;
            aSwitch[nCalls] := ipo.iLastSwitch;
            aWay[nCalls] := ipo.dWayPos;
            nCalls := nCalls + 1;
    END_CASE
END_FOR
END_PROGRAM

(* One object, if there is room; the list is closed behind the last one. *)
METHOD Produce
IF nNext < nObjects AND NOT queue.bFull THEN
    geo.iMoveType := SM3_CNC.SMC_MOVTYP.LIN;
    geo.piStartPos.dX := dX;
    dX := dX + aLength[nNext];
    geo.piDestPos.dX := dX;
    geo.dLength := aLength[nNext];
    geo.dVel := aVelocity[nNext];
    geo.dVelEnd := geo.dVel;
    geo.iHelpID[0] := LREAL_TO_INT(aNumber[nNext]);
    geo.dHelpPos[0] := 0.5;
    SM3_CNC.SMC_AppendObj(ADR(queue), ADR(geo));
    nNext := nNext + 1;
END_IF
IF nNext >= nObjects THEN
    queue.bEndOfList := TRUE;
END_IF
END_METHOD
"""
OBJECTS = st.lists(
    st.tuples(st.one_of(st.floats(0.01, 0.4), st.floats(0.4, 8.0)), st.sampled_from([10.0, 30.0, 30.0])),
    min_size=1,
    max_size=60,
)
ORDERS = st.lists(
    st.lists(st.sampled_from([APPEND, APPEND, CHECK, INTERPOLATE]), min_size=1, max_size=30),
    min_size=1,
    max_size=20,
)


@settings(max_examples=40, deadline=None)
@given(OBJECTS, ORDERS, st.sampled_from(["TRAPEZOID", "SIGMOID", "QUADRATIC"]))
def test_nothing_is_lost_or_doubled(
    objects: list[tuple[float, float]], orders: list[list[int]], mode: str
) -> None:
    """Spec CNCR-03, CNCR-05, CNCR-116: any order of calls; the deceleration is kept whatever is known."""
    with run(PROGRAM, cycles=0) as program:
        program.set("Main", nObjects=len(objects))
        program.set("Main.ipo", iVelMode=mode, dJerkMax=3000.0)
        for n, (length, velocity) in enumerate(objects):
            program.set(
                "Main", **{f"aLength[{n}]": length, f"aVelocity[{n}]": velocity, f"aNumber[{n}]": n + 1}
            )
        velocity_before = place_before = 0.0
        numbers: list[int] = []
        steady = [APPEND] * 4 + [CHECK] + [INTERPOLATE] * 5
        for order, times in [*((order, 1) for order in orders), *((steady, 300) for _ in range(10))]:
            program.set(
                "Main",
                nPattern=len(order),
                nSteps=len(order) * times,
                **{f"aStep[{n}]": step for n, step in enumerate(order)},
            )
            program.cycle()
            calls = order.count(INTERPOLATE) * times
            if calls == 0:
                continue
            v, s, error, switch = (
                np.array(program.numbers(f"Main.{name}")[:calls])
                for name in ("aV", "aS", "aError", "aSwitch")
            )
            assert set(error) <= {0, 1003, 1080}
            change = np.diff(np.concatenate([[velocity_before], v]))
            assert np.abs(change).max() <= (math.pi / 2 if mode == "SIGMOID" else 1.0) * 100 * CYCLE + 1e-6
            assert np.diff(np.concatenate([[place_before], s])).min() >= -1e-12
            velocity_before, place_before = v[-1], s[-1]
            numbers.extend(int(number) for number in switch)
            if program.literal("Main.ipo.bDone") == "TRUE":
                break
        assert program.literal("Main.ipo.bDone") == "TRUE"
        assert place_before == pytest.approx(sum(length for length, _ in objects), abs=1e-9)
        assert float(program.literal("Main.dTotal")) == pytest.approx(place_before, abs=1e-9)
        assert (np.diff(numbers) >= 0).all()
        assert numbers[-1] == len(objects)
