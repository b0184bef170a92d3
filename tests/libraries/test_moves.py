"""Moves of SM3_Trajectory, with an acceleration and a deceleration for both directions."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
import pytest
from tests.libraries.trajectories import (
    MOVE_TO_POSITION,
    MOVE_TO_VELOCITY,
    PLANNED,
    Numbers,
    Plan,
    Plans,
    check_segments,
    planner,
    random_cases,
    ruckigs_duration,
)

P0, V0, A0, P1, V1, A1, V_MAX, V_MIN, A_MAX, A_MIN, JERK = range(11)
STARTS = ("within", "at")


@pytest.fixture(scope="module")
def move_to_position() -> Iterator[Plan]:
    with planner(MOVE_TO_POSITION, "Polynomial") as function:
        yield function


@pytest.fixture(scope="module")
def move_to_velocity() -> Iterator[Plan]:
    with planner(MOVE_TO_VELOCITY, "Polynomial") as function:
        yield function


def _moves(seed: int, count: int, start: str, jerk: bool = True) -> Numbers:
    """Random moves to standstill, or to a velocity; both directions have the same limits."""
    cases = random_cases(seed, count, start)
    cases[:, V0] = np.clip(cases[:, V0], -cases[:, V_MAX], cases[:, V_MAX])
    cases[:, V1] = np.clip(cases[:, V1], -cases[:, V_MAX], cases[:, V_MAX])
    cases[:, V_MIN] = -cases[:, V_MAX]
    if not jerk:
        cases[:, [A0, JERK]] = 0.0
    cases[:, A1] = 0.0
    return cases


def _from_rest(distance: Numbers, v0: Numbers, case: Numbers) -> Numbers:
    """Of a trapezoid in positive direction with a velocity at its start that can stop at its end."""
    v_max, up, down = case[:, V_MAX], case[:, A_MAX], -case[:, A_MIN]
    peak = np.sqrt((2 * up * down * distance + down * v0**2) / (up + down))
    top = np.minimum(peak, v_max)
    way = (top**2 - v0**2) / (2 * up) + top**2 / (2 * down)
    cruise = np.divide(distance - way, top, out=np.zeros_like(way), where=top > 0)
    return np.asarray((top - v0) / up + np.maximum(cruise, 0) + top / down)


def _trapezoids(cases: Numbers) -> Numbers:
    """Durations of moves to standstill without a limit of jerk, by the formulas of every textbook."""
    sign = np.where(cases[:, V0] < 0, -1.0, 1.0)
    v0, distance = sign * cases[:, V0], sign * (cases[:, P1] - cases[:, P0])
    stop = v0**2 / (-2 * cases[:, A_MIN])
    ahead = distance >= stop
    direct = _from_rest(np.where(ahead, distance, stop), v0, cases)
    back = v0 / -cases[:, A_MIN] + _from_rest(np.abs(distance - stop), np.zeros_like(v0), cases)
    return np.where(ahead, direct, back)


@pytest.mark.parametrize("start", STARTS)
def test_trapezoids(move_to_position: Plan, start: str) -> None:
    cases = _moves(41, 5000, start, jerk=False)
    cases[:, V1] = 0.0
    plans = move_to_position(cases)
    assert np.all(plans.result == PLANNED)
    np.testing.assert_allclose(plans.duration, _trapezoids(cases), rtol=1e-6, atol=1e-9)


def _limit(cases: Numbers, sign: Numbers) -> None:
    """Gives them the limits of their direction: the acceleration with it, the deceleration against it."""
    up, down = cases[:, A_MAX].copy(), -cases[:, A_MIN]
    cases[:, A_MAX], cases[:, A_MIN] = np.where(sign > 0, up, down), -np.where(sign > 0, down, up)


@pytest.mark.parametrize("start", STARTS)
def test_velocities_of_both_directions(move_to_velocity: Plan, start: str) -> None:
    cases = _moves(42, 3000, start)
    plans = move_to_velocity(cases)
    assert np.all(plans.result == PLANNED)
    crossing = cases[:, V0] * cases[:, V1] < 0
    assert np.count_nonzero(crossing) > 100
    for index, case in enumerate(cases):
        sign = np.sign(case[V0]) or np.sign(case[V1]) or np.sign(case[A0])
        first = case[None].copy()
        _limit(first, np.array([sign]))
        expected = 0.0
        if crossing[index]:
            first[0, V1] = 0.0
            expected = ruckigs_duration(first[0], True)
            first = case[None].copy()
            first[0, [V0, A0]] = 0.0
            _limit(first, np.array([-sign]))
        expected += ruckigs_duration(first[0], True)
        if not np.isnan(expected):
            assert plans.duration[index] == pytest.approx(expected, rel=1e-6, abs=1e-9), case
    _check_accelerations(plans)


@pytest.mark.parametrize("start", STARTS)
@pytest.mark.parametrize("to_rest", [True, False])
def test_equal_ramps_are_as_short_as_ruckigs(move_to_position: Plan, start: str, to_rest: bool) -> None:
    cases = _moves(43, 3000, start)
    cases[:, A_MIN] = -cases[:, A_MAX]
    cases[:, A0] = np.clip(cases[:, A0], cases[:, A_MIN], cases[:, A_MAX])
    if to_rest:
        cases[:, V1] = 0.0
    plans = move_to_position(cases)
    expected = np.array([ruckigs_duration(case, False) for case in cases])
    known = ~np.isnan(expected)
    assert np.count_nonzero(known) > 0.99 * len(cases)
    np.testing.assert_allclose(plans.duration[known], expected[known], rtol=1e-6, atol=1e-9)


@pytest.mark.parametrize("start", STARTS)
def test_moves_with_jerk_lead_on(move_to_position: Plan, start: str) -> None:
    cases = _moves(44, 5000, start)
    cases[:, [V1, A0]] = 0.0
    plans = move_to_position(cases)
    assert np.all(plans.result == PLANNED)
    check = cases.copy()
    widest = np.maximum(cases[:, A_MAX], -cases[:, A_MIN])
    check[:, A_MAX], check[:, A_MIN] = widest, -widest
    plans.limit(check)
    check_segments(plans, within=True)
    plans.limit(cases)
    _check_accelerations(plans)


def _check_accelerations(plans: Plans) -> None:
    """Speed rises by no more than the acceleration and falls by no more than the deceleration."""
    s, c = plans.segments, plans.cases
    for part in (0.001, 0.25, 0.5, 0.75, 0.999):
        t = part * s["duration"]
        a = s["acceleration"] + t * s["jerk"]
        v = s["velocity"] + t * (s["acceleration"] + t * s["jerk"] / 2)
        rises = a * v > 0
        limit = np.where(rises, c["a_max"][:, None], -c["a_min"][:, None])
        moving = plans.used & (np.abs(v) > 1e-9 * c["v_max"][:, None])
        started_within = (np.abs(c["a0"]) <= np.minimum(c["a_max"], -c["a_min"]))[:, None]
        assert np.all((np.abs(a) <= limit * (1 + 1e-9))[moving & started_within])
