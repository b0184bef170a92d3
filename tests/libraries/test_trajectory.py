"""Trajectories of SM3_Trajectory: against Ruckig, and against what their segments say of themselves."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import ExitStack
from functools import cache

import numpy as np
import pytest
import ruckig
from tests.libraries.st_program import run
from tests.libraries.trajectories import (
    PLANNED,
    POSITION,
    RUCKIGS_INPUTS,
    VELOCITY,
    Numbers,
    Plan,
    Plans,
    check_segments,
    planner,
    random_cases,
    ruckigs_duration,
)


@pytest.fixture(scope="module")
def planners() -> Iterator[Callable[[str, str], Plan]]:
    """Planners by their call and the shape of ramps, each compiled once."""
    with ExitStack() as opened:
        yield cache(lambda call, shape: opened.enter_context(planner(call, shape)))


@pytest.fixture(scope="module")
def plan(planners: Callable[[str, str], Plan]) -> Plan:
    return planners(POSITION, "Polynomial")


@pytest.fixture(scope="module")
def plan_velocity(planners: Callable[[str, str], Plan]) -> Plan:
    return planners(VELOCITY, "Polynomial")


@pytest.fixture(scope="module")
def plan_sin2(planners: Callable[[str, str], Plan]) -> Plan:
    return planners(POSITION, "Sin2")


@pytest.fixture(scope="module")
def plan_velocity_sin2(planners: Callable[[str, str], Plan]) -> Plan:
    return planners(VELOCITY, "Sin2")


@pytest.fixture(scope="module")
def plan_smooth(planners: Callable[[str, str], Plan]) -> Plan:
    return planners(POSITION, "Smooth")


@pytest.fixture(scope="module")
def plan_velocity_smooth(planners: Callable[[str, str], Plan]) -> Plan:
    return planners(VELOCITY, "Smooth")


def _check_against_ruckig(plan: Plan, cases: Numbers, to_velocity: bool = False) -> Plans:
    plans = plan(cases)
    expected = np.array([ruckigs_duration(case, to_velocity) for case in cases])
    known = ~np.isnan(expected)
    assert np.count_nonzero(known) > 0.99 * len(cases)
    assert np.all(plans.result[known] == PLANNED), cases[known][plans.result[known] != PLANNED][:3]
    late = plans.duration - expected > 1e-6 * expected + 1e-9
    assert not np.any(late & known), cases[late & known][:3]
    return plans


@pytest.mark.parametrize("start", ["within", "at", "beyond"])
def test_as_short_as_ruckigs(plan: Plan, start: str) -> None:
    check_segments(_check_against_ruckig(plan, random_cases(1, 5000, start)), within=False)


def _to_rest(cases: Numbers) -> Numbers:
    """The same, to targets at rest, for which fewer ways are looked at."""
    cases = cases.copy()
    cases[:, [4, 5]] = 0.0
    return cases


@pytest.mark.parametrize("start", ["within", "at", "beyond"])
def test_as_short_as_ruckigs_to_rest(plan: Plan, start: str) -> None:
    check_segments(_check_against_ruckig(plan, _to_rest(random_cases(31, 5000, start))), within=False)


@pytest.mark.slow
@pytest.mark.parametrize("start", ["within", "at", "beyond"])
@pytest.mark.parametrize("seed", range(2, 5))
def test_as_short_as_ruckigs_to_rest_often(plan: Plan, start: str, seed: int) -> None:
    check_segments(_check_against_ruckig(plan, _to_rest(random_cases(seed, 12000, start))), within=False)


@pytest.mark.slow
@pytest.mark.parametrize("start", ["within", "at", "beyond"])
@pytest.mark.parametrize("seed", range(2, 8))
def test_as_short_as_ruckigs_a_hundred_thousand_times(plan: Plan, start: str, seed: int) -> None:
    check_segments(_check_against_ruckig(plan, random_cases(seed, 7000, start)), within=False)


def _without_jerk(cases: Numbers) -> Numbers:
    """The same, with accelerations that may jump."""
    cases = cases.copy()
    cases[:, [2, 5, 10]] = 0.0
    return cases


@pytest.mark.parametrize("start", ["within", "at", "beyond"])
def test_as_short_as_ruckigs_without_jerk(plan: Plan, start: str) -> None:
    check_segments(_check_against_ruckig(plan, _without_jerk(random_cases(21, 5000, start))), within=False)


@pytest.mark.parametrize("start", ["within", "at", "beyond"])
@pytest.mark.parametrize("limited", [True, False])
def test_velocities_as_soon_as_ruckigs(plan_velocity: Plan, start: str, limited: bool) -> None:
    cases = random_cases(22, 3000, start)
    plans = _check_against_ruckig(plan_velocity, cases if limited else _without_jerk(cases), to_velocity=True)
    check_segments(plans, within=False)


def _check_sin2(plans: Plans) -> None:
    """Accelerations meet, and each is largest in the middle of a ramp, at the limit of its direction."""
    check_segments(plans, within=False)
    s, c = plans.segments, plans.cases
    rises = (s["rise"] != 0) & plans.used
    assert np.all(np.where(rises, s["acceleration"] == 0, True))
    peak = np.divide(np.pi * s["rise"], 2 * s["duration"], out=np.zeros_like(s["rise"]), where=rises)
    limit = np.where(s["rise"] > 0, c["a_max"][:, None], c["a_min"][:, None])
    np.testing.assert_allclose(peak[rises], limit[rises], rtol=1e-6)


@pytest.mark.parametrize("start", ["within", "at", "beyond"])
def test_sin2_is_as_short_as_straight_ramps_of_its_mean_acceleration(
    plan_sin2: Plan, plan_velocity_sin2: Plan, start: str
) -> None:
    cases = _without_jerk(random_cases(24, 3000, start))
    straight = cases.copy()
    straight[:, 8:10] *= 2 / np.pi
    for planned, to_velocity in ((plan_sin2(cases), False), (plan_velocity_sin2(cases), True)):
        expected = np.array([ruckigs_duration(case, to_velocity) for case in straight])
        known = ~np.isnan(expected)
        assert np.count_nonzero(known) > 0.99 * len(cases)
        np.testing.assert_allclose(planned.duration[known], expected[known], rtol=1e-6, atol=1e-9)
        _check_sin2(planned)


@pytest.mark.parametrize("start", ["within", "at", "beyond"])
def test_sin2_begins_with_the_acceleration_of_the_start(
    plan_sin2: Plan, plan_velocity_sin2: Plan, start: str
) -> None:
    cases = random_cases(25, 3000, start)
    cases[:, 5] = 0.0
    for planned in (plan_sin2(cases), plan_velocity_sin2(cases)):
        assert np.all(planned.result == PLANNED)
        _check_sin2(planned)
        bends = planned.segments["jerk"] != 0
        assert np.array_equal(np.count_nonzero(bends, axis=1), (cases[:, 2] != 0).astype(int))


def test_sin2_takes_no_acceleration_of_the_target(plan_sin2: Plan, plan_velocity_sin2: Plan) -> None:
    cases = random_cases(26, 1, "within")
    cases[0, 5] = 0.5 * cases[0, 8]
    assert plan_sin2(cases).result.tolist() == plan_velocity_sin2(cases).result.tolist() == [4]


def _smooth_time(change: Numbers, a_max: Numbers, a_min: Numbers) -> Numbers:
    """Of a change of velocity with jerk 1: acceleration up, kept and down, up and down by (1 - cos)/2."""
    limit = np.where(change > 0, a_max, -a_min)
    peak = np.minimum(limit, np.sqrt(2 * np.abs(change) / np.pi))
    held = np.abs(change) - peak * (np.pi / 2 * peak)  # each bend of duration pi/2 * peak gives half of that
    return np.divide(held, peak, out=np.zeros_like(peak), where=peak > 0) + np.pi * peak


def _check_smooth(plans: Plans) -> None:
    check_segments(plans, within=False)
    s, c = plans.segments, plans.cases
    bends = (s["bend"] != 0) & plans.used
    jerk = np.divide(np.pi * np.abs(s["bend"]), 2 * s["duration"], out=np.zeros_like(s["bend"]), where=bends)
    np.testing.assert_allclose(jerk[bends], np.broadcast_to(c["jerk"][:, None], jerk.shape)[bends], rtol=1e-9)
    a_unit = np.maximum(c["a_max"], -c["a_min"])[:, None]
    settled = s["jerk"] == 0
    held = np.where(plans.used & settled, s["acceleration"], 0.0)
    assert np.all(held <= c["a_max"][:, None] + 1e-9 * a_unit)
    assert np.all(held >= c["a_min"][:, None] - 1e-9 * a_unit)


@pytest.mark.parametrize("start", ["within", "at", "beyond"])
def test_smooth_ramps(plan_smooth: Plan, plan_velocity_smooth: Plan, start: str) -> None:
    cases = random_cases(27, 3000, start)
    cases[:, 5] = 0.0
    for planned in (plan_smooth(cases), plan_velocity_smooth(cases)):
        assert np.all(planned.result == PLANNED)
        _check_smooth(planned)


def test_smooth_velocities_take_the_time_of_their_closed_form(plan_velocity_smooth: Plan) -> None:
    cases = random_cases(28, 3000, "within")
    cases[:, [2, 5]] = 0.0
    expected = _smooth_time(cases[:, 4] - cases[:, 1], cases[:, 8], cases[:, 9])
    np.testing.assert_allclose(plan_velocity_smooth(cases).duration, expected, rtol=1e-9, atol=1e-12)


def test_smooth_positions_have_the_best_velocity_between(plan_smooth: Plan) -> None:
    """Against all velocities of a fine grid: none makes the way in less time."""
    cases = random_cases(29, 300, "within")
    cases[:, [2, 5]] = 0.0
    _, v0, _, distance, v1, _, v_max, v_min, a_max, a_min, _ = cases.T[:, :, None]
    grid = np.linspace(0.0, 1.0, 20001)[None, :]
    velocities = v_min + grid * (v_max - v_min)
    first = _smooth_time(velocities - v0, a_max + 0 * velocities, a_min + 0 * velocities)
    second = _smooth_time(v1 - velocities, a_max + 0 * velocities, a_min + 0 * velocities)
    way = 0.5 * (v0 + velocities) * first + 0.5 * (velocities + v1) * second
    cruise = np.divide(distance - way, velocities, out=np.full_like(way, np.inf), where=velocities != 0)
    possible = np.where(cruise >= 0, first + second + cruise, np.inf).min(axis=1)
    planned = plan_smooth(cases)
    assert np.all(planned.duration <= possible * (1 + 1e-9))
    assert np.count_nonzero(np.isfinite(possible)) > 290


def test_limits_are_kept_without_jerk(plan: Plan) -> None:
    check_segments(plan(_without_jerk(random_cases(23, 20000, "within"))), within=True)


def test_positioning_with_trapezoids_and_triangles(plan: Plan) -> None:
    """motion_semantics EX-01, motion_semantics EX-02: closed forms of the specification."""
    cases = np.zeros((2, len(RUCKIGS_INPUTS)))
    cases[:, 3] = 100.0, 1.0
    cases[:, 6:10] = 10.0, -10.0, 20.0, -20.0
    plans = plan(cases)
    np.testing.assert_allclose(plans.duration, [10.5, 2 * np.sqrt(20.0) / 20.0], rtol=1e-14)
    np.testing.assert_allclose(
        plans.segments["velocity"][:, plans.count - 1].diagonal(), [10.0, np.sqrt(20.0)]
    )
    assert plans.count.tolist() == [3, 2]


def test_limits_are_kept_from_starts_that_keep_them(plan: Plan) -> None:
    cases = random_cases(9, 20000, "within")
    v0, a0, v_max, v_min = cases[:, 1], cases[:, 2], cases[:, 6], cases[:, 7]
    kept = (v0 + a0 * a0 / 2 <= v_max) & (v0 - a0 * a0 / 2 >= v_min)
    check_segments(plan(cases[kept]), within=True)


def test_units_do_not_matter(plan: Plan) -> None:
    """Lengths from 1e-9 to 1e9, times from 1e-4 to 1e4: durations scale with the time."""
    cases = random_cases(10, 5000, "at")
    random = np.random.default_rng(11)
    length, time = 10 ** random.uniform(-9, 9, len(cases)), 10 ** random.uniform(-4, 4, len(cases))
    powers = np.array([0, 1, 2, 0, 1, 2, 1, 1, 2, 2, 3])
    scaled = plan(cases * length[:, None] / time[:, None] ** powers)
    plain = plan(cases)
    both = (scaled.result == PLANNED) & (plain.result == PLANNED)
    assert np.count_nonzero(both) > 0.95 * len(cases)  # targets at a limit may round to beyond it
    np.testing.assert_allclose(scaled.duration[both] / time[both], plain.duration[both], rtol=1e-6, atol=1e-6)
    check_segments(scaled, within=False)


def test_nothing_to_do_takes_no_time(plan: Plan) -> None:
    cases = random_cases(12, 2000, "within")
    cases[:, 3] = 0.0
    cases[:, 4] = cases[:, 1]
    cases[:, 2] = cases[:, 5] = 0.0
    plans = plan(cases)
    assert np.all(plans.result == PLANNED)
    assert np.all(plans.duration == 0.0)


@pytest.mark.parametrize(
    ("column", "value", "result"),
    [
        (1, np.nan, 1),
        (3, np.inf, 1),
        (6, 0.0, 2),
        (7, 1.0, 2),
        (8, -1.0, 2),
        (9, np.nan, 2),
        (10, -1.0, 2),
        (10, np.inf, 2),
        (4, 1e6, 3),
        (5, 1e6, 4),
    ],
)
def test_what_cannot_be_planned_is_said(plan: Plan, column: int, value: float, result: int) -> None:
    cases = random_cases(13, 1, "within")
    cases[0, column] = value
    assert plan(cases).result.tolist() == [result]


STATES = """
PROGRAM Main
VAR
    st0 : SM3_Trajectory.MotionState := (fPosition := 5.0, fVelocity := -2.0, fAcceleration := 1.0);
    st1 : SM3_Trajectory.MotionState := (fPosition := 90.0, fVelocity := 3.0);
    stLimits : SM3_Trajectory.Limits := (fVelocityMax := 20.0, fVelocityMin := -20.0,
        fAccelerationMax := 50.0, fAccelerationMin := -30.0, fJerk := 200.0);
    stTrajectory : SM3_Trajectory.Trajectory;
    stState : SM3_Trajectory.MotionState;
    afTimes : ARRAY [0..59] OF LREAL := {times};
    afStates : ARRAY [0..179] OF LREAL;
    i : INT;
END_VAR
SM3_Trajectory.PlanPosition(st0, st1, stLimits, stTrajectory);
FOR i := 0 TO 59 DO
    stState := SM3_Trajectory.StateAt(stTrajectory, afTimes[i]);
    afStates[3 * i] := stState.fPosition;
    afStates[3 * i + 1] := stState.fVelocity;
    afStates[3 * i + 2] := stState.fAcceleration;
END_FOR
END_PROGRAM
"""


@pytest.mark.parametrize("order", ["rising", "any"])
def test_states_are_ruckigs(order: str) -> None:
    problem = ruckig.InputParameter(1)
    values = (5.0, -2.0, 1.0, 90.0, 3.0, 0.0, 20.0, -20.0, 50.0, -30.0, 200.0)
    for name, value in zip(RUCKIGS_INPUTS, values, strict=True):
        setattr(problem, name, [value])
    trajectory = ruckig.Trajectory(1)
    ruckig.Ruckig(1).calculate(problem, trajectory)
    times = np.linspace(0.0, trajectory.duration + 0.5, 60)  # the target's velocity goes on behind the end
    if order == "any":
        times = np.random.default_rng(1).permutation(times)
    text = STATES.replace("{times}", "[" + ", ".join(repr(float(time)) for time in times) + "]")
    with run(text, 1) as program:
        states = np.array(program.numbers("Main.afStates")).reshape(60, 3)
    expected = [[column[0] for column in trajectory.at_time(float(time))[:3]] for time in times]
    np.testing.assert_allclose(states, expected, rtol=1e-9, atol=1e-9)


SIN2_STATES = """
PROGRAM Main
VAR
    st0 : SM3_Trajectory.MotionState;
    st1 : SM3_Trajectory.MotionState := (fPosition := 100.0);
    stLimits : SM3_Trajectory.Limits := (fVelocityMax := 10.0, fVelocityMin := -10.0,
        fAccelerationMax := 20.0, fAccelerationMin := -40.0, eShape := SM3_Trajectory.RampShape.Sin2);
    stTrajectory : SM3_Trajectory.Trajectory;
    stState : SM3_Trajectory.MotionState;
    afStates : ARRAY [0..599] OF LREAL;
    i : INT;
END_VAR
SM3_Trajectory.PlanPosition(st0, st1, stLimits, stTrajectory);
FOR i := 0 TO 199 DO
    stState := SM3_Trajectory.StateAt(stTrajectory, INT_TO_LREAL(i) * 0.06);
    afStates[3 * i] := stState.fPosition;
    afStates[3 * i + 1] := stState.fVelocity;
    afStates[3 * i + 2] := stState.fAcceleration;
END_FOR
END_PROGRAM
"""


def test_sin2_moves_as_the_specification_says() -> None:
    """v(t) = v1 sin2(pi t / 2T) with T = pi/2 v1/a, integrated and differentiated by numpy."""
    with run(SIN2_STATES, 1) as program:
        states = np.array(program.numbers("Main.afStates")).reshape(200, 3)
    up, down = np.pi / 2 * 10.0 / 20.0, np.pi / 2 * 10.0 / 40.0
    cruise = (100.0 - 5.0 * (up + down)) / 10.0

    def velocity(time: np.ndarray) -> Numbers:
        rising = 10.0 * np.sin(np.pi * np.clip(time, 0, up) / (2 * up)) ** 2
        falling = 10.0 * np.cos(np.pi * np.clip(time - up - cruise, 0, down) / (2 * down)) ** 2
        return np.asarray(np.where(time < up + cruise, rising, falling))

    times = np.arange(200) * 0.06
    fine = np.linspace(0.0, times[-1], 199 * 200 + 1)
    means = (velocity(fine)[1:] + velocity(fine)[:-1]) / 2
    positions = np.concatenate(([0.0], np.cumsum(means * np.diff(fine))))[::200]
    accelerations = np.gradient(velocity(fine), fine)[::200]
    np.testing.assert_allclose(states[:, 1], velocity(times), atol=1e-9)
    np.testing.assert_allclose(states[:, 0], positions, atol=1e-6)
    np.testing.assert_allclose(states[:, 2], accelerations, atol=0.05)
