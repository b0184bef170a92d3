"""SMC_Interpolator2Dir with its slow task: back and forth on a path, against closed forms."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from tests.libraries.cnc_motion import FINISHED, MCOMMAND, WAIT, Motion, Object, motion, program_text
from tests.libraries.test_cnc_velocity import PATHS, duration

TEXT = program_text(
    "SMC_Interpolator2Dir",
    declarations="""aBack : ARRAY[1..400] OF SM3_CNC.SMC_GEOINFO;
    slow : SM3_CNC.SMC_Interpolator2Dir_SlowTask;
    nBack : UDINT := 400; xSlow : BOOL := TRUE;
    aDirection : ARRAY[0..1999] OF LREAL;""",
    calls="""IF n > 0 THEN aDirection[n - 1] := ipo.nDirection; END_IF
    IF xSlow THEN
        slow(ipo2d := ipo, nSizeOutQueue := nBack * SIZEOF(SM3_CNC.SMC_GEOINFO),
            pbyBufferOutQueue := ADR(aBack));
    END_IF""",
)
CYCLE = 0.01
LINE = [Object(100.0)]
WAITING = 1
"""Calls before the motion: the slow task sees the path in the call behind the one that starts it."""


def seconds(path: Motion, count: float) -> dict[str, np.ndarray]:
    return path.calls(round(count / CYCLE))


def begin(path: Motion) -> None:
    assert path.calls(WAITING)["aWorking"].max() == 0


def test_back_and_forth() -> None:
    """Spec cnc_runtime EX-36, CNCR-160, CNCR-161."""
    with motion(LINE, TEXT) as path:
        begin(path)
        found = seconds(path, 1.0)
        assert found["aS"][-1] == pytest.approx(37.5)
        path.set(dOverride=-1.0)
        found = seconds(path, 2.1)
        assert (found["aS"][49], found["aV"][49]) == (pytest.approx(50), 0)
        direction = np.array(path.program.numbers("Main.aDirection"))
        assert (direction[10], direction[49], direction[60]) == (1, 0, -1)
        assert int(np.argmax(found["aDone"])) + 1 == 200
        assert (found["aS"][199], found["aStatus"][199]) == (pytest.approx(0, abs=1e-9), FINISHED)
        assert (found["aDone"][-1], found["aWorking"][-1], found["aLeft"][-1]) == (1, 0, 1)
        path.set(dOverride=1.0)
        found = seconds(path, 2.6)
        assert found["aDone"][0] == 0
        assert found["aS"][24] == pytest.approx(3.125)
        assert int(np.argmax(found["aDone"])) + 1 == 250
        assert found["aS"][-1] == pytest.approx(100)


def test_start_at_the_end() -> None:
    """Spec CNCR-160: bStartAtEnd; the deceleration of the way back is the acceleration of the way there."""
    with motion([Object(100.0, deceleration=50.0)], TEXT, bStartAtEnd=True, dOverride=-1.0) as path:
        begin(path)
        found = seconds(path, 2.8)
    assert found["aS"][99] == pytest.approx(100 - 25.0)
    assert found["aV"][99] == pytest.approx(50)
    assert int(np.argmax(found["aDone"])) + 1 == 275


def test_start_at_the_end_forwards() -> None:
    with motion(LINE, TEXT, bStartAtEnd=True) as path:
        begin(path)
        found = seconds(path, 0.1)
    assert (set(found["aDone"]), set(found["aS"])) == ({1}, {100})


@pytest.mark.parametrize("override", [0.0, 0.009, -0.009])
def test_standstill(override: float) -> None:
    """Spec CNCR-C7: below 0.01 in size the interpolator stands."""
    with motion(LINE, TEXT) as path:
        begin(path)
        seconds(path, 1.0)
        path.set(dOverride=override)
        found = seconds(path, 1.0)
        assert (found["aS"][-1], found["aV"][-1], found["aStatus"][-1]) == (pytest.approx(50), 0, WAIT)


def test_corner_m_function_and_switch_points_on_the_way_back() -> None:
    """Spec CNCR-161, catalog: M functions stop in both directions, switch points switch the other way."""
    switch = {"dHelpPos[0]": 0.8, "iHelpID[0]": 3}
    m7 = Object(kind=MCOMMAND, members={"iHelpID[0]": 7})
    with motion([Object(50.0, members=switch), m7, Object(50.0)], TEXT) as path:
        begin(path)
        found = seconds(path, 1.6)
        assert (found["aM"][-1], found["aSwitches"][-1]) == (7, 4)
        path.set(bAcknM=True)
        assert seconds(path, 2.0)["aDone"][-1] == 1
        path.set(bAcknM=False, dOverride=-1.0)
        found = seconds(path, 1.6)
        assert (found["aM"][-1], found["aS"][-1], found["aSwitches"][-1]) == (7, pytest.approx(50), 4)
        path.set(bAcknM=True)
        found = seconds(path, 1.6)
        bits = found["aSwitches"]
        place = found["aS"]
        assert bits.tolist() == (4 * (place > 40 + 1e-9)).tolist()
        assert set(found["aLastSwitch"]) == {3, -3}
        assert found["aDone"][-1] == 1


def mirrored(path: list[Object]) -> list[Object]:
    """The way back of a path, as the specification says."""
    ends = [1e9, *(item.end for item in path[:-1])]
    return [
        Object(item.length, item.velocity, item.deceleration, item.acceleration, end)
        for item, end in zip(reversed(path), reversed(ends), strict=True)
    ]


@settings(max_examples=20, deadline=None)
@given(PATHS, st.sampled_from([1.0, 0.3]), st.sampled_from(["TRAPEZOID", "SIGMOID"]))
def test_the_whole_way_back_is_the_shortest(path: list[Object], override: float, mode: str) -> None:
    """Duration of the way back against a time-optimal plan in numpy of the mirrored path."""
    expected = duration(mirrored(path), override)
    cycle = max(CYCLE, math.ceil(expected / 1900 * 1e6) * 1e-6)
    with motion(
        path, TEXT, bStartAtEnd=True, dOverride=-override, iVelMode=mode, dwIpoTime=round(cycle * 1e6)
    ) as running:
        begin(running)
        found = running.calls(min(2000, math.ceil(expected / cycle) + 20))
    calls = int(np.argmax(found["aDone"])) + 1
    assert expected - 1e-6 <= calls * cycle <= expected + cycle + 1e-6
    assert found["aS"][-1] == pytest.approx(0, abs=1e-9)
    assert (np.diff(found["aS"]) <= 1e-9).all()


@settings(max_examples=20, deadline=None)
@given(
    PATHS,
    st.lists(
        st.tuples(st.integers(1, 60), st.sampled_from([1.0, -1.0, 0.5, -0.5, 0.0, 2.0])),
        min_size=1,
        max_size=12,
    ),
    st.sampled_from(["TRAPEZOID", "SIGMOID", "QUADRATIC"]),
)
def test_a_hand_wheel(path: list[Object], turns: list[tuple[int, float]], mode: str) -> None:
    """Spec CNCR-162: any override at any time; never off the path, too fast or steeper than may be."""
    total = sum(item.length for item in path)
    fastest = max(item.velocity for item in path) * 2
    steepest = max(max(item.acceleration, item.deceleration) for item in path) * (
        math.pi / 2 if mode == "SIGMOID" else 1
    )
    with motion(path, TEXT, iVelMode=mode, dJerkMax=5000.0) as running:
        begin(running)
        for calls, override in turns:
            running.set(dOverride=override)
            found = running.calls(calls)
            assert found["aError"].max() == 0
            assert found["aS"].min() >= -1e-9
            assert found["aS"].max() <= total + 1e-9
            assert found["aV"].max() <= fastest + 1e-9
            assert np.abs(np.diff(found["aV"])).max(initial=0.0) <= steepest * CYCLE + 1e-6
            assert np.abs(np.diff(found["aS"])).max(initial=0.0) <= fastest * CYCLE + 1e-9
        running.set(dOverride=-1.0)
        for _ in range(10):
            if (found := running.calls(2000))["aDone"][-1]:
                break
        assert found["aS"][-1] == pytest.approx(0, abs=1e-9)


def test_no_room_for_the_way_back() -> None:
    """Spec 1050: the buffer needs a place more than the path has objects."""
    with motion([Object(10.0)] * 5, TEXT) as path:
        path.program.set("Main", nBack=5)
        found = path.calls(3)
    assert found["aError"].tolist()[-1] == 1050
    assert found["aWorking"].max() == 0


def test_no_slow_task() -> None:
    """Spec CNCR-160: it must be called."""
    with motion(LINE, TEXT) as path:
        path.program.set("Main", xSlow=False)
        found = path.calls(120)
    assert found["aS"].max() == 0
    assert found["aError"][-1] == 1050


def test_the_path_does_not_fit() -> None:
    """Spec 1051."""
    with motion([Object(1.0)] * 399, TEXT) as path:
        path.program.set("Main", xCloses=False)
        found = path.calls(3)
    assert found["aError"][-1] == 1051


def test_another_start_takes_another_way_back() -> None:
    with motion(LINE, TEXT) as path:
        begin(path)
        seconds(path, 1.0)
        path.program.set("Main", xExecutes=False)
        path.calls(1)
        path.load([Object(20.0, 10.0)])
        path.program.set("Main", xExecutes=True, xStarts=True)
        path.set(bStartAtEnd=True, dOverride=-1.0)
        begin(path)
        found = seconds(path, 3.0)
    assert (found["aS"].max(), found["aV"].max()) == (pytest.approx(20, abs=0.1), 10)
    assert found["aDone"][-1] == 1
