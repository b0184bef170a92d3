"""SMC_XInterpolator: the point of a path to the X of an axis."""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterator
from contextlib import contextmanager

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from tests.libraries.cnc_motion import BUFFER, chain
from tests.libraries.st_program import Program, run

CYCLE = 0.01
PROGRAM = f"""
PROGRAM Main
VAR
    {chain(50)}
    aPath   : ARRAY[0..40] OF SM3_CNC.SMC_GEOINFO;
    Axis    : SM3_Basic.AXIS_REF_VIRTUAL_SM3 := (fTaskCycle := {CYCLE});
    ipo     : SM3_CNC.SMC_XInterpolator := (bExecute := TRUE);
    nObjects, n : DINT;
    xFilled : BOOL;
    dWay    : LREAL;
END_VAR
IF NOT xFilled AND nObjects > 0 THEN
    xFilled := TRUE;
    {BUFFER}
    FOR n := 0 TO nObjects - 1 DO
        SM3_CNC.SMC_CalcLengthGeo(ADR(aPath[n]));
        SM3_CNC.SMC_AppendObj(ADR(queue), ADR(aPath[n]));
    END_FOR
    queue.bEndOfList := TRUE;
END_IF
ipo(X_Axis := Axis, poqDataIn := ADR(queue), dLastWayPos := dWay);
dWay := ipo.dWayPos;
END_PROGRAM
"""


class Path:
    """The running program."""

    def __init__(self, program: Program) -> None:
        self.program = program

    def set(self, **inputs: float | bool | str) -> None:
        self.program.set("Main.ipo", **inputs)

    def at(self, x: float) -> tuple[float, float]:
        """The point when the axis is there."""
        self.program.set("Main.Axis", fSetPosition=x)
        self.program.cycle()
        return self.number("piSetPosition.dX"), self.number("piSetPosition.dY")

    def number(self, output: str) -> float:
        return float(self.program.literal(f"Main.ipo.{output}"))

    def says(self, output: str) -> str:
        return self.program.literal(f"Main.ipo.{output}")


@contextmanager
def path(
    objects: list[dict[str, float]], text: str = PROGRAM, **inputs: float | bool | str
) -> Iterator[Path]:
    with run(text, cycles=0) as program:
        for n, item in enumerate(objects):
            program.set("Main", **{f"aPath[{n}].{name}": value for name, value in item.items()})
        program.set("Main", nObjects=len(objects))
        found = Path(program)
        found.set(**inputs)
        yield found


def line(x0: float, y0: float, x1: float, y1: float, **more: float) -> dict[str, float]:
    places = {"piStartPos.dX": x0, "piStartPos.dY": y0, "piDestPos.dX": x1, "piDestPos.dY": y1}
    return {"iMoveType": 1, **places, **more}


def test_a_line() -> None:
    """Spec cnc_runtime EX-36, CNCR-163."""
    with path([line(0, 0, 100, 50)]) as one:
        assert one.at(40.0) == pytest.approx((40, 20))
        assert one.says("bWorking") == "TRUE"
        one.set(dXOffset=10.0)
        assert one.at(40.0) == pytest.approx((50, 25))
        assert one.number("dVel") == pytest.approx(math.hypot(10, 5) / CYCLE)
        assert one.number("vecActTangent.dX") == pytest.approx(2 / math.sqrt(5))
        assert one.at(95.0) == pytest.approx((100, 50))
        assert (one.says("bDone"), one.says("iStatus"), one.says("bWorking")) == (
            "TRUE",
            "IPO_FINISHED",
            "FALSE",
        )
        assert one.number("dWayPos") == pytest.approx(math.hypot(100, 50))


def test_against_the_direction() -> None:
    """Catalog: the last point is kept."""
    with path([line(0, 0, 100, 50)]) as one:
        one.at(40.0)
        assert one.at(30.0) == pytest.approx((40, 20))
        assert one.number("dVel") == 0


def test_negative_direction() -> None:
    with path([line(100, 0, 50, 10), line(50, 10, 0, 0)], eDirection="negative") as one:
        assert one.at(75.0) == pytest.approx((75, 5))
        assert one.at(20.0) == pytest.approx((20, 4))


def test_before_the_path_its_start_is_kept() -> None:
    with path([line(10, 3, 100, 50)]) as one:
        assert one.at(0.0) == pytest.approx((10, 3))


def test_an_arc() -> None:
    """Upper half circle around (50, 0), clockwise from (0, 0)."""
    arc = {**line(0, 0, 100, 0), "iMoveType": 2, "dP1": 50, "dP2": 0, "dP3": 50, "dT1": 180, "dT2": 180}
    with path([arc]) as one:
        for x in (0.001, 1.0, 20.0, 50.0, 80.0, 99.0, 99.999):
            assert one.at(x) == pytest.approx((x, math.sqrt(2500 - (x - 50) ** 2)), abs=1e-7)


def test_switch_points_and_m_functions() -> None:
    """M functions do not hold the axis; switch points act."""
    first = line(0, 0, 50, 0, **{"dHelpPos[0]": 0.5, "iHelpID[0]": 3, "iSourceLine_No": 10})
    stop: dict[str, float] = {"iMoveType": 120, "iHelpID[0]": 7}
    with path([first, stop, line(50, 0, 100, 0, iSourceLine_No=30)]) as one:
        one.at(20.0)
        assert (one.number("dwSwitches"), one.number("iActObjectSourceNo")) == (0, 10)
        one.at(60.0)
        assert (one.number("dwSwitches"), one.number("iLastSwitch"), one.number("iActObjectSourceNo")) == (
            4,
            3,
            30,
        )


def test_a_synchronisation_is_answered() -> None:
    """Spec GEO-18: when the axis has come to it, not before."""
    text = PROGRAM.replace("dWay    : LREAL;", "dWay    : LREAL;\n    xPassed : BOOL;").replace(
        "    queue.bEndOfList := TRUE;", "    SM3_CNC.SMC_GetObj(ADR(queue), 1)^.pPassed := ADR(xPassed);"
    )
    stop: dict[str, float] = {"iMoveType": 120, "iHelpID[0]": -2}
    with path([line(0, 0, 50, 0), stop], text) as one:
        one.at(49.0)
        assert one.program.literal("Main.xPassed") == "FALSE"
        one.at(51.0)
        assert one.program.literal("Main.xPassed") == "TRUE"


@settings(max_examples=30, deadline=None)
@given(
    st.lists(st.tuples(st.floats(0.0, 20.0), st.floats(-30.0, 30.0)), min_size=1, max_size=10),
    st.lists(st.floats(-5.0, 210.0), min_size=1, max_size=15),
)
def test_any_polyline(steps: list[tuple[float, float]], places: list[float]) -> None:
    """Against interpolation in the corners, places in rising order; vertical lines are passed."""
    corners = [(0.0, 0.0)]
    for dx, dy in steps:
        corners.append((corners[-1][0] + dx, corners[-1][1] + dy))
    objects = [line(*a, *b) for a, b in itertools.pairwise(corners)]
    with path(objects) as one:
        for x in sorted(places):
            found = one.at(x)
            if one.says("bDone") == "TRUE":
                break
            before = [(a, b) for a, b in itertools.pairwise(corners) if a[0] <= found[0] <= b[0]]
            assert found[0] == pytest.approx(min(max(x, 0.0), corners[-1][0]), abs=1e-9)
            distances = [
                abs(found[1] - (a[1] + (found[0] - a[0]) / (b[0] - a[0]) * (b[1] - a[1])))
                if b[0] > a[0]
                else 0.0
                for a, b in before
            ]
            assert min(distances) <= 1e-8


@pytest.mark.parametrize("direction", ["shortest", "current", "fastest"])
def test_other_directions(direction: str) -> None:
    """Catalog: only positive and negative."""
    with path([line(0, 0, 100, 50)], eDirection=direction) as one:
        one.at(10.0)
        assert (one.says("bError"), one.says("wErrorID")) == ("TRUE", "SMC_MA_INVALID_DIRECTION")


def test_a_wrong_queue() -> None:
    """Spec CNCR-14, 1501."""
    with path([]) as one:
        one.program.set("Main.queue", wOUTQUEUEStructID=1)
        one.at(10.0)
        assert one.says("wErrorID") == "SMC_NO_OUTQUEUE_TYPE"


def test_abort_and_start_again() -> None:
    with path([line(0, 0, 100, 50)]) as one:
        one.at(40.0)
        one.set(bAbort=True)
        one.at(50.0)
        assert (one.says("bBusy"), one.says("bWorking"), one.says("iStatus")) == (
            "FALSE",
            "FALSE",
            "IPO_INIT",
        )
        one.set(bAbort=False, bExecute=False)
        one.at(50.0)
        one.program.set("Main", xFilled=False)
        one.set(bExecute=True)
        assert one.at(50.0) == pytest.approx((50, 25))


@pytest.mark.parametrize("value", ["nan", "inf", "-inf"])
def test_absurd_positions(value: str) -> None:
    """They move nothing, or end the path."""
    with path([line(0, 0, 100, 50)]) as one:
        one.at(40.0)
        found = one.at(float(value))
        assert found == pytest.approx((100, 50) if value == "inf" else (40, 20))
