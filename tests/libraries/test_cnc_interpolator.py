"""SMC_CheckVelocities and SMC_Interpolator: worked examples, cnc_runtime EX-20, EX-30, EX-31 and EX-35."""

from __future__ import annotations

import math

import numpy as np
import pytest
from tests.libraries.cnc_motion import (
    ACCEL,
    CONSTANT,
    DECEL,
    FINISHED,
    LINPOS,
    MCOMMAND,
    WAIT,
    Motion,
    Object,
    motion,
)

CYCLE = 0.01
LINE = [Object(100.0)]
TRAPEZOID = {
    0.1: (0.5, 10),
    0.25: (3.125, 25),
    0.4: (8, 40),
    0.5: (12.5, 50),
    1.0: (37.5, 50),
    2.0: (87.5, 50),
} | {
    2.1: (92, 40),
    2.25: (96.875, 25),
    2.5: (100, 0),
}
SIGMOID = {0.1: (0.161277, 4.774575), 0.25: (2.271126, 25), 0.4: (7.661277, 45.225425), 0.5: (12.5, 50)} | {
    1.0: (37.5, 50),
    2.0: (87.5, 50),
    2.1: (92.338723, 45.225425),
    2.25: (97.728874, 25),
    2.5: (100, 0),
}


def at(seconds: float) -> int:
    """The call that shows what is so many seconds after the start: the first shows the end of a cycle."""
    return round(seconds / CYCLE) - 1


def done_at(found: dict[str, np.ndarray]) -> float:
    """Seconds until the call that says done."""
    return float(np.argmax(found["aDone"] > 0) + 1) * CYCLE


def seconds(path: Motion, count: float) -> dict[str, np.ndarray]:
    return path.calls(round(count / CYCLE))


@pytest.mark.parametrize(("mode", "table"), [("TRAPEZOID", TRAPEZOID), ("SIGMOID", SIGMOID)])
def test_a_line(mode: str, table: dict[float, tuple[float, float]]) -> None:
    """Spec cnc_runtime EX-30, CNCR-120 to CNCR-123, CNCR-127, CNCR-128."""
    with motion(LINE, iVelMode=mode) as path:
        found = seconds(path, 2.6)
    for t, (s, v) in table.items():
        assert found["aS"][at(t)] == pytest.approx(s, abs=1e-6)
        assert found["aV"][at(t)] == pytest.approx(v, abs=1e-6)
    assert done_at(found) == pytest.approx(2.5)
    assert [found["aStatus"][at(t)] for t in (0.2, 1.0, 2.2, 2.5)] == [ACCEL, CONSTANT, DECEL, FINISHED]
    assert found["aWorking"].tolist() == [1] * 249 + [0] * 11
    assert found["aLine"].tolist() == [10] * 249 + [-1] * 11
    assert found["aTangent"].tolist() == [1] * 249 + [0] * 11
    assert found["aLeft"].tolist() == [1] * 249 + [0] * 11
    assert found["aWay"][-1] == pytest.approx(100.0, abs=1e-9)
    acceleration = np.diff(np.concatenate([[0.0], found["aV"]])) / CYCLE
    assert np.abs(acceleration).max() <= (100.0 if mode == "TRAPEZOID" else 50 * math.pi) + 1e-6
    if mode == "SIGMOID":
        assert np.abs(acceleration).max() == pytest.approx(157.079633, rel=1e-3)


def test_way_of_a_cycle() -> None:
    """Spec cnc_runtime EX-33: the way of each cycle, fed back."""
    with motion(LINE) as path:
        found = seconds(path, 2.6)
    assert np.diff(found["aWay"])[at(1.0)] == pytest.approx(0.5, abs=1e-9)


def test_other_deceleration() -> None:
    """Spec cnc_runtime EX-30: E100 E-50."""
    with motion([Object(100.0, deceleration=50.0)]) as path:
        found = seconds(path, 2.8)
    assert done_at(found) == pytest.approx(2.75)
    assert (found["aS"][at(2.0)], found["aV"][at(2.0)]) == (pytest.approx(85.9375), pytest.approx(37.5))


def test_a_peak() -> None:
    """Spec cnc_runtime EX-30: F50 on 9 u with E100 E-50; a cycle so short that it shows the peak."""
    with motion([Object(9.0, deceleration=50.0)], dwIpoTime=1000) as path:
        found = path.calls(800)
    assert found["aV"].max() == pytest.approx(24.494897, abs=0.1)
    assert np.argmax(found["aDone"] > 0) + 1 == 735


@pytest.mark.parametrize(("override", "duration"), [(0.5, 4.25), (2.0, 2.0)])
def test_override_from_the_start(override: float, duration: float) -> None:
    """Spec cnc_runtime EX-30; with 2 the 100 u are just two ramps of 50 u up to 100 u/s and down."""
    with motion(LINE, dOverride=override) as path:
        assert done_at(seconds(path, 5)) == pytest.approx(duration)


@pytest.mark.parametrize("override", ["0.001", "0.0", "-1.0"])
def test_lowest_override(override: str) -> None:
    """Spec cnc_runtime EX-30, CNCR-124: below 0.01 counts as 0.01."""
    with motion(LINE, dOverride=float(override)) as path:
        assert seconds(path, 1)["aV"][-1] == pytest.approx(0.5)


def test_slow_stop() -> None:
    """Spec cnc_runtime EX-31, CNCR-141."""
    with motion(LINE) as path:
        assert seconds(path, 1.0)["aS"][-1] == pytest.approx(37.5)
        path.set(bSlow_Stop=True)
        found = seconds(path, 1.0)
        assert (found["aS"][at(0.5)], found["aV"][at(0.5)]) == (pytest.approx(50), 0)
        assert [found["aStatus"][at(t)] for t in (0.4, 0.51)] == [DECEL, WAIT]
        assert found["aTangent"][-1] == 0
        path.set(bSlow_Stop=False)
        assert done_at(seconds(path, 1.6)) == pytest.approx(1.5)


def test_slow_stop_that_is_taken_back() -> None:
    """Spec CNCR-141: the deceleration turns into acceleration."""
    with motion(LINE) as path:
        seconds(path, 1.0)
        path.set(bSlow_Stop=True)
        assert seconds(path, 0.2)["aV"][-1] == pytest.approx(30)
        path.set(bSlow_Stop=False)
        found = seconds(path, 2.0)
        assert found["aV"][at(0.2)] == pytest.approx(50)
        # 2 * 0.2 s at 40 u/s in the mean instead of 50 u/s: 4 u late
        assert done_at(found) == pytest.approx(1.38)


@pytest.mark.parametrize(("deceleration", "place", "duration"), [(500.0, 40.0, 0.1), (20.0, 50.0, 0.5)])
def test_quick_stop(deceleration: float, place: float, duration: float) -> None:
    """Spec cnc_runtime EX-31, CNCR-142."""
    with motion(LINE, dQuickDeceleration=deceleration) as path:
        seconds(path, 1.0)
        path.set(bQuick_Stop=True)
        found = seconds(path, 1.0)
    assert found["aS"][-1] == pytest.approx(place)
    assert float(np.argmax(found["aV"] == 0) + 1) * CYCLE == pytest.approx(duration)


def test_quick_stop_takes_over_from_a_slow_one() -> None:
    """Spec 7.2: of several stops the strongest deceleration counts."""
    with motion(LINE, dQuickDeceleration=500.0) as path:
        seconds(path, 1.0)
        path.set(bSlow_Stop=True)
        assert seconds(path, 0.1)["aV"][-1] == pytest.approx(40)
        path.set(bQuick_Stop=True)
        found = seconds(path, 0.2)
    assert found["aS"][-1] == pytest.approx(37.5 + 4.5 + 1.6)
    assert float(np.argmax(found["aV"] == 0) + 1) * CYCLE == pytest.approx(0.08)


def test_emergency_stop() -> None:
    """Spec cnc_runtime EX-31, CNCR-140."""
    with motion(LINE) as path:
        seconds(path, 1.0)
        path.set(bEmergency_Stop=True)
        found = seconds(path, 1.0)
        assert set(found["aS"]) == {found["aS"][0]}
        assert found["aS"][0] == pytest.approx(37.5)
        assert (set(found["aV"]), set(found["aStatus"]), set(found["aTangent"])) == ({0}, {WAIT}, {0})
        path.set(bEmergency_Stop=False)
        assert done_at(seconds(path, 2.0)) == pytest.approx(1.75)


def test_override_up_in_motion() -> None:
    """Spec cnc_runtime EX-31: done at t = 2.232051."""
    with motion(LINE) as path:
        seconds(path, 1.0)
        path.set(dOverride=2.0)
        found = seconds(path, 2.0)
    assert found["aV"].max() == pytest.approx(86.602540, abs=1.0)
    assert done_at(found) == pytest.approx(1.24)


def test_override_down_in_a_ramp() -> None:
    """Spec cnc_runtime EX-31, CNCR-124: taken over at the end of the ramp."""
    with motion(LINE) as path:
        seconds(path, 0.2)
        path.set(dOverride=0.5)
        found = seconds(path, 4.0)
    assert found["aV"][at(0.3)] == pytest.approx(50)
    assert (found["aV"][at(0.55)], found["aS"][at(0.55)]) == (pytest.approx(25), pytest.approx(21.875))
    assert done_at(found) == pytest.approx(3.8)


CORNER = [Object(50.0), Object(dy=50.0)]
TWO = [Object(50.0), Object(50.0)]


@pytest.mark.parametrize("mode", ["TRAPEZOID", "SIGMOID"])
def test_a_corner(mode: str) -> None:
    """Spec cnc_runtime EX-32."""
    with motion(CORNER, iVelMode=mode) as path:
        found = seconds(path, 3.1)
        assert done_at(found) == pytest.approx(3.0)
        assert (found["aS"][at(1.5)], found["aY"][at(1.5)], found["aV"][at(1.5)]) == (pytest.approx(50), 0, 0)


def test_wait_at_the_corner() -> None:
    """Spec cnc_runtime EX-32, CNCR-143."""
    with motion(CORNER, bWaitAtNextStop=True) as path:
        found = seconds(path, 3.0)
        assert (found["aS"][-1], found["aY"][-1], found["aStatus"][-1]) == (pytest.approx(50), 0, WAIT)
        assert done_at(found) == CYCLE  # that is: not
        path.set(bWaitAtNextStop=False)
        assert done_at(seconds(path, 2.0)) == pytest.approx(1.5)


def test_wait_at_the_end() -> None:
    """Spec CNCR-143: the end is such a point too."""
    with motion(LINE, bWaitAtNextStop=True) as path:
        found = seconds(path, 3.0)
        assert (found["aStatus"][-1], found["aDone"].max()) == (WAIT, 0)
        path.set(bWaitAtNextStop=False)
        assert done_at(seconds(path, 0.1)) == CYCLE


@pytest.mark.parametrize(("single", "duration"), [(True, 3.01), (False, 2.5)])
def test_single_step(single: bool, duration: float) -> None:
    """Spec cnc_runtime EX-32, CNCR-144."""
    with motion(TWO, bSingleStep=single) as path:
        found = seconds(path, 3.1)
    assert done_at(found) == pytest.approx(duration)
    if single:
        assert (found["aStatus"][at(1.51)], found["aS"][at(1.51)]) == (WAIT, pytest.approx(50))


def test_single_step_too_late() -> None:
    """Spec CNCR-144: 5 u before the end of the first object it is too late; not for the end of the next."""
    with motion([Object(50.0), Object(50.0), Object(50.0)]) as path:
        assert seconds(path, 1.15)["aS"][-1] == pytest.approx(45)
        path.set(bSingleStep=True)
        found = seconds(path, 3.0)
    acceleration = np.diff(found["aV"]) / CYCLE
    assert acceleration.min() == pytest.approx(-100)
    stands = found["aS"][found["aStatus"] == WAIT]
    assert set(stands) == {100.0}


SWITCHES = {
    **{f"dHelpPos[{n}]": place for n, place in enumerate((0.3, 0.8, 0.5))},
    **{f"iHelpID[{n}]": number for n, number in enumerate((3, -3, 5))},
}


def test_switch_points() -> None:
    """Spec cnc_runtime EX-35, CNCR-153: H3 at 80, H5 at 100, H-3 at 130."""
    with motion([Object(50.0), Object(100.0, members=SWITCHES)]) as path:
        found = seconds(path, 3.6)
    place, bits = found["aS"], found["aSwitches"]
    expected = 4 * ((place >= 80 - 1e-9) & (place < 130 - 1e-9)) + 16 * (place >= 100 - 1e-9)
    assert bits.tolist() == expected.tolist()
    order = found["aLastSwitch"]
    assert order[np.flatnonzero(np.diff(order)) + 1].tolist() == [3, 5, -3]


M7 = Object(kind=MCOMMAND, members={"iHelpID[0]": 7, "dT1": 1.5, "dT2": 2.0, "dP3": 4.5})


def test_an_m_function() -> None:
    """Spec cnc_runtime EX-35, CNCR-150."""
    with motion([Object(50.0), M7, Object(50.0)]) as path:
        found = seconds(path, 2.0)
        assert found["aM"].tolist() == [0] * 149 + [7] * 51
        assert (found["aS"][-1], found["aStatus"][-1], found["aV"][-1]) == (pytest.approx(50), WAIT, 0)
        path.set(bAcknM=True)
        found = seconds(path, 1.6)
        assert found["aM"].max() == 0
        assert done_at(found) == pytest.approx(1.5)


def test_m_functions_acknowledged_at_once() -> None:
    """Spec CNCR-150: still with a stop."""
    with motion([Object(50.0), M7, Object(50.0)], bAcknM=True) as path:
        found = seconds(path, 3.1)
    assert found["aM"].max() == 0
    assert done_at(found) == pytest.approx(3.0)


@pytest.mark.parametrize("dwell", [0.0, 0.005, 0.5])
def test_a_dwell(dwell: float) -> None:
    """Spec CNCR-155: not visible as an M function, not acknowledged."""
    pause = Object(kind=MCOMMAND, members={"iHelpID[0]": -1, "dP1": dwell})
    with motion([Object(50.0), pause, Object(50.0)]) as path:
        found = seconds(path, 4.0)
    assert found["aM"].max() == 0
    assert done_at(found) == pytest.approx(math.ceil(round((3.0 + dwell) / CYCLE, 6)) * CYCLE)


def test_s_profile() -> None:
    """Spec cnc_runtime EX-34, CNCR-126: P with bit 6 of wSProfile."""
    expected = {10: 0.3424, 25: 4.140625, 50: 20, 75: 35.859375}
    for profile in (0, 64):
        members = {"piStartPos.wAuxData": 71, "piDestPos.wAuxData": 71, "piStartPos.wSProfile": profile}
        # 10 u/s without ramps to speak of: 0.1 u in each cycle
        item = Object(100.0, 10.0, 1e9, 1e9, members={**members, "piDestPos.dA1": 40.0})
        with motion([item]) as path:
            for place, p in expected.items():
                calls = round((place - path_place(path)) / 0.1)
                path.calls(calls)
                found = float(path.program.literal("Main.ipo.piSetPosition.dA1"))
                assert found == pytest.approx(p if profile else 0.4 * place, abs=1e-5)


def path_place(path: Motion) -> float:
    return float(path.program.literal("Main.ipo.piSetPosition.dX"))


def test_look_ahead() -> None:
    """Spec cnc_runtime EX-20, CNCR-113."""
    with motion([Object(100.0), Object(1.0)]) as path:
        path.calls(1)
        assert path.end_velocities(2) == pytest.approx([14.142136, 0])
        assert done_at(seconds(path, 2.6)) == pytest.approx(2.51)


@pytest.mark.parametrize(
    ("path", "tolerance", "end"),
    [
        (CORNER, 1.0, 0.0),
        (
            [Object(50.0), Object(50.0, 30.0, members={"piDestPos.dY": 50 * math.tan(math.radians(0.5))})],
            1.0,
            30.0,
        ),
        (
            [Object(50.0), Object(50.0, 30.0, members={"piDestPos.dY": 50 * math.tan(math.radians(0.5))})],
            0.4,
            0.0,
        ),
        ([Object(50.0), Object(50.0, kind=LINPOS)], 1.0, 0.0),
        ([Object(50.0, end=20.0), Object(50.0)], 1.0, 20.0),
        ([Object(50.0), M7, Object(50.0)], 1.0, 0.0),
    ],
    ids=["corner", "bend", "bend beyond the tolerance", "G0", "prescribed", "M function"],
)
def test_transitions(path: list[Object], tolerance: float, end: float) -> None:
    """Spec cnc_runtime EX-20, CNCR-111, CNCR-112."""
    with motion(path) as running:
        running.program.set("Main.check", dAngleTol=tolerance)
        running.calls(1)
        assert running.end_velocities(1)[0] == pytest.approx(end)
        assert float(running.program.literal("Main.aBuffer[1].dVelEndStored")) == path[0].end
