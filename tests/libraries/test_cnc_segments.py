"""SMC_SegmentAnalyzer: segments and time of a path without moving, against closed forms."""

from __future__ import annotations

import math

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from tests.libraries.cnc_motion import MCOMMAND, Object, motion, program_text

ACCEL, CONSTANT, DECEL, STOP = range(4)
CYCLE = 0.01
OUTPUTS = ("eSegmentType", "dSegmentLength", "dSegmentTime", "dTotalTime", "wErrorID")
NAMES = {
    "eSegmentType": "aKind",
    "dSegmentLength": "aLength",
    "dSegmentTime": "aTime",
    "dTotalTime": "aTotal",
}
NAMES["wErrorID"] = "aFault"
CALLS = 400
TEXT = program_text(
    declarations=f"look : SM3_CNC.SMC_SegmentAnalyzer := (dwIpoTime := {round(CYCLE * 1e6)});\n"
    f"    {', '.join(NAMES.values())}, aOver : ARRAY[0..{CALLS - 1}] OF LREAL; xLooks : BOOL := TRUE;",
    calls="look(bExecute := xLooks, poqDataIn := ADR(queue));\n    "
    + "\n    ".join(f"{array}[n] := look.{name};" for name, array in NAMES.items())
    + "\n    aOver[n] := BOOL_TO_INT(look.bDone);\n    xExecutes := FALSE;",
)


def segments(path: list[Object], calls: int = 100, **inputs: object) -> list[tuple[int, float, float, float]]:
    """Kind, length, duration and the sum so far of each segment."""
    with motion(path, TEXT) as running:
        running.program.set("Main.look", **inputs)  # type: ignore[arg-type]
        running.calls(calls)
        read = {name: running.program.numbers(f"Main.{array}")[:calls] for name, array in NAMES.items()}
        over = running.program.numbers("Main.aOver")[:calls]
        assert max(read["wErrorID"]) == 0
        assert over[-1] == 1
        last = over.index(1.0)
        left = int(running.program.literal("Main.queue.nWritePos")) - int(
            running.program.literal("Main.queue.nReadPos")
        )
        assert left == len(path), "the queue is as it was"
    return [
        (int(read["eSegmentType"][n]), *(read[name][n] for name in OUTPUTS[1:4]))  # type: ignore[misc]
        for n in range(last + 1)
        if read["dSegmentTime"][n] > 0
    ]


def test_the_example_of_the_catalog() -> None:
    """One line of 100 u, F50, E100, E-100."""
    assert segments([Object(100.0)]) == [
        (ACCEL, pytest.approx(12.5), pytest.approx(0.5), pytest.approx(0.5)),
        (CONSTANT, pytest.approx(75), pytest.approx(1.5), pytest.approx(2.0)),
        (DECEL, pytest.approx(12.5), pytest.approx(0.5), pytest.approx(2.5)),
    ]


def test_a_corner_a_dwell_and_an_m_function() -> None:
    """Spec cnc_runtime EX-32: 1.5 s and 1.5 s; G4 T2 in between is a standstill; an M function is none."""
    dwell = Object(kind=MCOMMAND, members={"iHelpID[0]": -1, "dP1": 2.0})
    found = segments([Object(50.0), dwell, Object(dy=50.0)])
    assert [kind for kind, *_ in found] == [ACCEL, CONSTANT, DECEL, STOP, ACCEL, CONSTANT, DECEL]
    assert found[3][1:3] == (0.0, pytest.approx(2.0, abs=CYCLE))
    assert found[-1][3] == pytest.approx(5.0, abs=CYCLE)
    function = Object(kind=MCOMMAND, members={"iHelpID[0]": 7})
    for inputs in ({}, {"bMFunctionsPreAcknowledged": True}):
        found = segments([Object(50.0), function, Object(dy=50.0)], **inputs)
        assert found[-1][3] == pytest.approx(3.0, abs=2 * CYCLE)


@settings(max_examples=25, deadline=None)
@given(
    st.floats(1, 400),
    st.floats(5, 80),
    st.floats(20, 300),
    st.floats(20, 300),
    st.sampled_from(["TRAPEZOID", "SIGMOID"]),
)
def test_any_line(length: float, velocity: float, up: float, down: float, mode: str) -> None:
    """Ramps in closed form, to a cycle; SIGMOID has the same ones. Spec CNCR-122, CNCR-123."""
    peak = min(velocity, math.sqrt(2 * length * up * down / (up + down)))
    ramps = {ACCEL: (peak**2 / 2 / up, peak / up), DECEL: (peak**2 / 2 / down, peak / down)}
    rest = length - ramps[ACCEL][0] - ramps[DECEL][0]
    expected = {**ramps, CONSTANT: (rest, rest / peak)}
    found = segments([Object(length, velocity, up, down)], iVelMode=mode)
    assert sum(size for _, size, *_ in found) == pytest.approx(length, rel=1e-9)
    assert found[-1][3] == pytest.approx(sum(time for _, time in expected.values()), abs=1.01 * CYCLE)
    assert len({kind for kind, *_ in found}) == len(found)
    for kind, size, time, _ in found:
        assert time == pytest.approx(expected[kind][1], abs=2.01 * CYCLE)
        assert size == pytest.approx(expected[kind][0], abs=2.01 * CYCLE * peak)


def test_long_segments_take_more_calls() -> None:
    """200 s at constant velocity: the segment is given when it is complete."""
    found = segments([Object(10000.0)])
    assert [kind for kind, *_ in found] == [ACCEL, CONSTANT, DECEL]
    assert sum(size for _, size, *_ in found) == pytest.approx(10000.0)
    assert found[-1][3] == pytest.approx(200.5, abs=CYCLE)


def test_the_path_is_not_complete() -> None:
    """It waits for the end of the path; a full queue without an end is an error."""
    with motion([Object(1.0)] * 5, TEXT) as running:
        running.program.set("Main", xCloses=False)
        running.calls(20)
        assert running.program.literal("Main.look.bBusy") == "TRUE"
        assert running.program.literal("Main.look.dTotalTime") in ("0", "0.0")
    with motion([Object(1.0)] * 400, TEXT) as running:
        running.calls(20)
        assert running.program.literal("Main.look.wErrorID") == "SMC_INT2DIR_PATH_FITS_NOT_IN_QUEUE"


def test_errors() -> None:
    """A wrong queue, no cycle time, no check."""
    with motion([Object(1.0)], TEXT) as running:
        running.program.set("Main.look", dwIpoTime=0)
        running.calls(2)
        assert running.program.literal("Main.look.wErrorID") == "SMC_INT_DWIPOTIME_ZERO"
        running.program.set("Main", xLooks=False)
        running.calls(1)
        assert running.program.literal("Main.look.bError") == "FALSE"
    with motion([Object(1.0)], TEXT) as running:
        running.program.set("Main", xChecks=False)
        running.calls(30)
        assert running.program.literal("Main.look.wErrorID") == "SMC_INT_NO_CHECKVELOCITIES"
