"""Velocity on random paths: limits, ramps and durations against a time-optimal plan, and ruckig."""

from __future__ import annotations

import itertools
import math

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st
from tests.libraries.cnc_motion import Motion, Object, motion

LENGTHS = st.one_of(st.floats(0.001, 0.5), st.floats(0.5, 30.0))
OBJECTS = st.builds(
    Object,
    length=LENGTHS,
    velocity=st.sampled_from([5.0, 20.0, 20.0, 20.0, 50.0]),
    acceleration=st.sampled_from([100.0, 100.0, 400.0]),
    deceleration=st.sampled_from([100.0, 100.0, 60.0]),
    end=st.sampled_from([1e9, 1e9, 1e9, 1e9, 12.0, 0.0]),
)
PATHS = st.lists(OBJECTS, min_size=1, max_size=25)
LONG = [Object(7.047554703425113, 46.46446822197238, 170.99514514806336, 170.99514514806336)] * 8
"""A path in parts that is looked at in several pieces, with a velocity that rounding does not meet."""
LOW_END = [
    Object(2.0, 5.0, 400.0, 60.0),
    Object(0.3373219150147494, 5.0, 400.0, 100.0, 12.0),
    Object(0.18777191184155126, 20.0, 400.0, 60.0, 12.0),
    Object(0.09994025036464889, 20.0, 100.0, 60.0, 12.0),
    Object(0.03484567578442897, 20.0, 100.0, 100.0, 12.0),
]
"""Short objects at the end: with limited jerk the way to 0 is shorter than that to a low velocity."""
MODES = ("TRAPEZOID", "SIGMOID", "SIGMOID_LIMIT", "QUADRATIC", "QUADRATIC_SMOOTH")
JERK = 2000.0
CYCLE = 0.01


def boundaries(path: list[Object], override: float) -> tuple[list[float], list[float]]:
    """Largest velocities where objects begin and at the end, and in them (spec CNCR-112, CNCR-121)."""
    inside = [item.velocity * override for item in path]
    passing = [
        min(item.end, min(item.velocity, behind.velocity) * min(override, 1.0))
        for item, behind in itertools.pairwise(path)
    ]
    return [0.0, *passing, 0.0], inside


def duration(path: list[Object], override: float, part: float = 1.0) -> float:
    """Of the shortest motion; `part` of the accelerations is their mean."""
    at, inside = boundaries(path, override)
    for n in reversed(range(len(path))):
        at[n] = min(at[n], math.sqrt(at[n + 1] ** 2 + 2 * part * path[n].deceleration * path[n].length))
    total = 0.0
    for n, item in enumerate(path):
        a, d, length = part * item.acceleration, part * item.deceleration, item.length
        at[n + 1] = min(at[n + 1], math.sqrt(at[n] ** 2 + 2 * a * length))
        peak = math.sqrt((2 * a * d * length + d * at[n] ** 2 + a * at[n + 1] ** 2) / (a + d))
        peak = max(min(peak, inside[n]), at[n], at[n + 1])
        up, down = (peak - at[n]) / a, (peak - at[n + 1]) / d
        cruise = length - 0.5 * up * (at[n] + peak) - 0.5 * down * (peak + at[n + 1])
        total += up + down + max(cruise, 0.0) / peak
    return total


def run_to_end(path: Motion, expected: float, cycle: float) -> dict[str, np.ndarray]:
    return path.calls(min(2000, math.ceil(expected / cycle) + 20))


def check_limits(
    path: list[Object],
    found: dict[str, np.ndarray],
    override: float,
    cycle: float,
    peak: float,
    slack: float = 1e-6,
) -> None:
    """Velocity within the objects, at their ends, and changes of it; positions go forward to the end."""
    ends = np.cumsum([item.length for item in path])
    at, inside = boundaries(path, override)
    place, velocity = found["aS"], found["aV"]
    which = np.minimum(np.searchsorted(ends, place - 1e-9), len(path) - 1)
    assert (velocity <= np.array(inside)[which] * (1 + 1e-9) + 1e-9).all()
    steps = np.diff(np.concatenate([[0.0], place]))
    assert steps.min() >= -1e-12
    # Changes in a cycle: the objects that it lies in decide
    before = np.concatenate([[0], which[:-1]])
    change = np.diff(np.concatenate([[0.0], velocity])) / cycle
    for n, (first, last) in enumerate(zip(before, which, strict=True)):
        items = path[first : last + 1]
        assert change[n] <= peak * max(item.acceleration for item in items) + slack / cycle
        assert change[n] >= -peak * max(item.deceleration for item in items) - slack / cycle
    # What is left to the next end must be enough to come down to its limit with the deceleration
    left = ends[which] - place
    limit = np.array(at[1:])[which]
    deceleration = peak * np.array([item.deceleration for item in path])[which]
    assert (velocity**2 <= limit**2 + 2 * deceleration * left + 1e-6).all()
    assert place[-1] == pytest.approx(ends[-1], abs=1e-9)
    assert velocity[-1] == 0.0


@settings(max_examples=40, deadline=None)
@given(
    PATHS, st.sampled_from([1.0, 1.0, 0.3, 2.0]), st.sampled_from(["TRAPEZOID", "SIGMOID", "SIGMOID_LIMIT"])
)
@example([Object(100.0), Object(1.0)], 0.5, "TRAPEZOID")
@example(LONG, 1.0, "SIGMOID")
@example([Object(30.0, 50.0), Object(0.01, 20.0), Object(3.0, 5.0)], 0.3, "SIGMOID_LIMIT")
def test_random_paths_are_the_shortest(path: list[Object], override: float, mode: str) -> None:
    """Spec 13: total time within a cycle of the analytic value, changes of velocity within limits."""
    expected = duration(path, override, 2 / math.pi if mode == "SIGMOID_LIMIT" else 1.0)
    cycle = max(CYCLE, math.ceil(expected / 1900 * 1e6) * 1e-6)
    with motion(path, dOverride=override, iVelMode=mode, dwIpoTime=round(cycle * 1e6)) as running:
        found = run_to_end(running, expected, cycle)
    assert found["aError"].max() == 0
    check_limits(path, found, override, cycle, math.pi / 2 if mode == "SIGMOID" else 1.0)
    calls = int(np.argmax(found["aDone"] > 0)) + 1
    assert expected - 1e-6 <= calls * cycle <= expected + cycle + 1e-6


@settings(max_examples=25, deadline=None)
@given(PATHS, st.sampled_from([1.0, 0.3, 2.0]), st.sampled_from(["QUADRATIC", "QUADRATIC_SMOOTH"]))
@example(LONG, 1.0, "QUADRATIC")
@example(LOW_END, 1.0, "QUADRATIC")
def test_random_paths_with_limited_jerk(path: list[Object], override: float, mode: str) -> None:
    """Spec 13: the velocity keeps all limits, its second difference that of the jerk."""
    fastest = duration(path, override)
    with motion(path, dOverride=override, iVelMode=mode, dJerkMax=JERK, dwIpoTime=20000) as running:
        parts = []
        for _ in range(5):
            parts.append(running.calls(2000))
            if parts[-1]["aDone"][-1]:
                break
        found = {name: np.concatenate([part[name] for part in parts]) for name in parts[0]}
    assert found["aError"].max() == 0
    check_limits(path, found, override, 0.02, 1.0)
    calls = int(np.argmax(found["aDone"] > 0)) + 1
    assert calls * 0.02 >= fastest - 1e-6
    jerk = np.diff(np.concatenate([[0.0, 0.0], found["aV"]]), 2) / 0.02**2
    assert np.abs(jerk).max() <= JERK * (1 + 1e-6)


CHANGES = st.lists(
    st.tuples(
        st.integers(1, 50),
        st.fixed_dictionaries(
            {
                "bSlow_Stop": st.sampled_from([False, False, True]),
                "bQuick_Stop": st.sampled_from([False, False, False, True]),
                "bEmergency_Stop": st.sampled_from([False] * 9 + [True]),
                "bSingleStep": st.sampled_from([False, False, True]),
                "bWaitAtNextStop": st.sampled_from([False, False, True]),
                "dOverride": st.sampled_from([1.0, 1.0, 0.2, 1.5]),
            }
        ),
    ),
    min_size=1,
    max_size=12,
)
QUIET: dict[str, float] = {
    "bSlow_Stop": False,
    "bQuick_Stop": False,
    "bEmergency_Stop": False,
    "bSingleStep": False,
    "bWaitAtNextStop": False,
}
QUICK = 700.0


@settings(max_examples=25, deadline=None)
@given(PATHS, CHANGES, st.sampled_from(MODES))
def test_any_stops_and_overrides(
    path: list[Object], changes: list[tuple[int, dict[str, float]]], mode: str
) -> None:
    """Spec 7.2: whatever is pressed when, the path is gone to its end within all limits."""
    peak = math.pi / 2 if mode == "SIGMOID" else 1.0
    up = peak * max(item.acceleration for item in path) * CYCLE
    down = peak * max(QUICK, *(item.deceleration for item in path)) * CYCLE
    total = sum(item.length for item in path)
    with motion(path, iVelMode=mode, dJerkMax=JERK, dQuickDeceleration=QUICK) as running:
        velocity = place = way = 0.0
        rest = [(2000, QUIET)] * 3 + [(2000, QUIET | {"dOverride": 1.0})]
        for calls, inputs in [*changes, *rest]:
            running.set(**inputs)
            found = running.calls(calls)
            assert found["aError"].max() == 0
            change = np.diff(np.concatenate([[velocity], found["aV"]]))
            assert change.max() <= up + 1e-6
            assert change.min() >= -down - 1e-6 or inputs["bEmergency_Stop"]
            assert np.diff(np.concatenate([[place], found["aS"]])).min() >= -1e-12
            # The way of each cycle is that of the position
            assert found["aWay"][-1] - way == pytest.approx(found["aS"][-1] - place, abs=1e-9)
            velocity, place, way = found["aV"][-1], found["aS"][-1], found["aWay"][-1]
            if found["aDone"][-1]:
                break
        assert found["aDone"][-1] == 1
        assert place == pytest.approx(total, abs=1e-9)


@settings(max_examples=20, deadline=None)
@given(
    st.floats(1.0, 40.0),
    st.integers(1, 120),
    st.sampled_from(["QUADRATIC", "QUADRATIC_SMOOTH"]),
    st.booleans(),
)
def test_a_stop_with_limited_jerk(length: float, calls: int, mode: str, quick: bool) -> None:
    """A stop at any time of the motion, and the way on: the acceleration has no jumps."""
    stop = "bQuick_Stop" if quick else "bSlow_Stop"
    with motion([Object(length)] * 3, iVelMode=mode, dJerkMax=JERK, dQuickDeceleration=300.0) as running:
        first = running.calls(calls)["aV"]
        running.set(**{stop: True})
        second = running.calls(400)
        assert second["aV"][-1] == 0
        running.set(**{stop: False})
        third = running.calls(1200)
    assert third["aDone"][-1] == 1
    velocity = np.concatenate([[0.0, 0.0], first, second["aV"], third["aV"]])
    assert np.abs(np.diff(velocity, 2)).max() / CYCLE**2 <= JERK * (1 + 1e-6)


@settings(max_examples=15, deadline=None)
@given(
    st.floats(0.5, 60.0),
    st.floats(5.0, 80.0),
    st.floats(50.0, 400.0),
    st.floats(500.0, 20000.0),
    st.integers(1, 12),
)
def test_quadratic_is_as_fast_as_ruckig(
    length: float, velocity: float, acceleration: float, jerk: float, parts: int
) -> None:
    """One line, or the same in pieces: the duration is that of ruckig's time-optimal motion."""
    ruckig = pytest.importorskip("ruckig")
    given_, out = ruckig.InputParameter(1), ruckig.Trajectory(1)
    given_.target_position, given_.max_velocity, given_.max_acceleration = (
        [length],
        [velocity],
        [acceleration],
    )
    given_.max_jerk = [jerk]
    ruckig.Ruckig(1).calculate(given_, out)
    expected = out.duration
    path = [Object(length / parts, velocity, acceleration, acceleration)] * parts
    with motion(path, iVelMode="QUADRATIC", dJerkMax=jerk) as running:
        found = running.calls(min(2000, math.ceil(expected / CYCLE) + 20))
    calls = int(np.argmax(found["aDone"] > 0)) + 1
    assert expected - 1e-6 <= calls * CYCLE <= expected + CYCLE + 1e-6
    times = np.arange(1, calls) * CYCLE
    assert found["aS"][: calls - 1] == pytest.approx([out.at_time(float(t))[0][0] for t in times], abs=1e-6)
