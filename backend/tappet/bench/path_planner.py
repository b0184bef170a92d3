"""Cells a second that the path planner plans, and what a cycle of the motion costs.

The path is endless: as many cells arrive in a call as are gone in it, so each is planned as often as the
window is planned anew. Beside it stands the bar of the whole chain of CNC blocks, 200,000 short lines a
second, as nanoseconds of a line.
"""

from __future__ import annotations

from tappet.bench.native import NativeLoop
from tappet.bench.program import running
from tappet.bench.report import Report, Row
from tappet.runtime.local import LocalRuntime

BAR_NS = 1e9 / 200_000
CALLS = 400
ROUNDS = 5
TURN = 0.005
"""Change of direction from line to line of 0.1: a radius of 20."""
PROGRAM = """PROGRAM Main
VAR
    planner : SM3_PathPlanner.PathPlanner;
    stCell  : SM3_PathPlanner.PathCell;
    nBefore, nGone, nCalls : UDINT;
    iAxes   : INT := {axes};
    i       : INT;
    k       : INT;
    fAngle  : LREAL;
    result  : LREAL;
END_VAR
stCell.fLength := 0.1;
stCell.fFeed := 50.0;
stCell.fAcceleration := 400.0;
stCell.fJerk := 8000.0;
planner.eMethod := SM3_PathPlanner.PlanMethod.{method};
planner.nAxes := INT_TO_UDINT(iAxes);
FOR i := 1 TO iAxes DO
    planner.aLimits[i].fVelocity := 200.0;
    planner.aLimits[i].fAcceleration := 500.0;
    planner.aLimits[i].fJerk := 20000.0;
END_FOR
FOR k := 1 TO 300 DO
    FOR i := 1 TO iAxes DO
        Direct();
    END_FOR
    IF NOT planner.Append(stCell) THEN
        EXIT;
    END_IF
    fAngle := fAngle + {turn};
END_FOR
nBefore := planner.nCell;
planner.Plan(1000);
{cycles}
nGone := nGone + planner.nCell - nBefore;
nCalls := nCalls + 1;
result := planner.stState.fVelocity;
END_PROGRAM

METHOD Direct
{direct}
END_METHOD
"""
_LINES = """stCell.stStart.aFirst[i] := COS(fAngle - i);
stCell.stEnd.aFirst[i] := stCell.stStart.aFirst[i];"""
_CURVES = """stCell.stStart.aFirst[i] := COS(fAngle - i);
stCell.stStart.aSecond[i] := -0.05 * SIN(fAngle - i);
stCell.stStart.aThird[i] := -0.0025 * COS(fAngle - i);
stCell.stEnd.aFirst[i] := COS(fAngle + {turn} - i);
stCell.stEnd.aSecond[i] := -0.05 * SIN(fAngle + {turn} - i);
stCell.stEnd.aThird[i] := -0.0025 * COS(fAngle + {turn} - i);"""
_STEADY = "planner.Advance(0.2);"
_CYCLES = "FOR k := 1 TO 200 DO\n    planner.Advance(0.001);\nEND_FOR"


def planned(
    loop: NativeLoop, method: str, axes: int, direct: str, cycles: str = _STEADY
) -> tuple[float, int]:
    """Nanoseconds of a cell, appended, planned and gone, and the cells gone; ValueError if none."""
    turn = f"{TURN}"
    text = PROGRAM.format(
        axes=axes, method=method, turn=turn, cycles=cycles, direct=direct.replace("{turn}", turn)
    )
    with running(text, ["SM3_PathPlanner"]) as (runtime, cycle):
        loop.seconds(cycle, 20)
        found = []
        for _ in range(ROUNDS):
            before = _gone(runtime)
            seconds = loop.seconds(cycle, CALLS)
            gone = _gone(runtime) - before
            if gone == 0:
                raise ValueError("the path stands: something else was measured")
            found.append(seconds / gone * 1e9)
        return min(found), _gone(runtime)


def _gone(runtime: LocalRuntime) -> int:
    found = runtime.read("Main.nGone")
    assert isinstance(found, int)
    return found


def run() -> Report:
    """All of it."""
    loop = NativeLoop()
    rows = []
    for name, method, axes, direct in (
        ("short lines, limited acceleration", "LimitedAcceleration", 3, _LINES),
        ("short lines, limited jerk", "LimitedJerk", 3, _LINES),
        ("curves of 3 axes, limited jerk", "LimitedJerk", 3, _CURVES),
        ("curves of 6 axes, limited jerk", "LimitedJerk", 6, _CURVES),
    ):
        ns, _ = planned(loop, method, axes, direct)
        rows.append(Row(name, ns, BAR_NS, "ns/cell", f"{1e9 / ns:,.0f} cells a second"))
    whole, gone = planned(loop, "LimitedJerk", 3, _LINES, _CYCLES)
    per_call = gone / (CALLS * ROUNDS + 20)
    cycle_ns = max(0.0, (whole - rows[1].ours) * per_call / 200)
    rows.append(Row("a cycle of the motion", cycle_ns, None, "ns"))
    return Report(
        "path-planner", "200,000 short lines a second", rows, "at most the baseline for short lines"
    )
