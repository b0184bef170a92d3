"""No axis is beyond a limit of velocity, acceleration or jerk, however a path arrives or is changed."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
import pytest
from hypothesis import HealthCheck, Phase, given, settings
from hypothesis import strategies as st
from tests.libraries.planned_path import (
    ACCELERATION,
    JERK,
    LIMITS,
    Numbers,
    Path,
    Planned,
    axis_motion,
    curve,
    duration,
    line,
    planned,
    rounded_corners,
    wave,
)

ALMOST = 1.005
"""What the shape between the points of a cell adds: cells of 0.1 rad and less."""
PHASES = (Phase.explicit, Phase.reuse, Phase.generate)
"""Without shrinking: a run takes a tenth of a second."""
SETTINGS = settings(
    max_examples=8, deadline=None, phases=PHASES, suppress_health_check=[HealthCheck.function_scoped_fixture]
)
AXIS = (200.0, 500.0, 10_000.0)
PART = st.floats(min_value=-1.0, max_value=1.0)


@pytest.fixture(scope="module")
def planner() -> Iterator[Planned]:
    with planned() as program:
        yield program


@st.composite
def random_paths(draw: st.DrawFn) -> Path:
    """Smooth curves of three axes, with random limits of each."""
    bends = np.array(draw(st.lists(PART, min_size=9, max_size=9))).reshape(3, 3)
    bends[0] = 0.0  # no cusps: the radius stays above 0.9
    limits = [(100 * 3 ** draw(PART), 400 * 3 ** draw(PART), 8000 * 3 ** draw(PART)) for _ in range(3)]
    feed = 60 * 3 ** draw(PART)

    def shape(u: Numbers) -> Numbers:
        waves = np.stack([np.sin((n + 1) * 0.25 * u) / (n + 1) for n in range(3)])
        return np.stack((10 + u, 0 * u, 0 * u), axis=1) + 2 * (bends @ waves).T

    element = curve(shape, 30.0, feed=feed, acceleration=1500.0, jerk=30_000.0)
    return Path([element], 0.1, limits)


def held(path: Path, record: dict[str, Numbers], method: int = JERK) -> None:
    """The limits hold by the chain rule, and by differences of the positions."""
    axes = axis_motion(path, record)
    shares = axes.shares(path.limits)
    assert shares[0] <= 1.001
    assert shares[1] <= ALMOST
    cycle = 0.001
    velocity = np.diff(axes.position, axis=0) / cycle
    acceleration = np.diff(velocity, axis=0) / cycle
    table = np.array(path.limits)
    assert np.all(np.abs(velocity) <= 1.001 * table[:, 0])
    assert np.all(np.abs(acceleration) <= 1.005 * table[:, 1] + 1e-3)
    if method == JERK:
        assert shares[2] <= ALMOST
        jerk = np.diff(acceleration, axis=0) / cycle
        # Where the curvature jumps, the acceleration may jump by what the jerk brings in one cycle
        assert np.all(np.abs(jerk) <= 2.01 * table[:, 2])


@SETTINGS
@given(
    path=random_paths(),
    per_cycle=st.integers(1, 40),
    steps=st.integers(1, 60),
    method=st.sampled_from((JERK, ACCELERATION)),
)
def test_cells_that_arrive_while_the_path_is_gone(
    planner: Planned, path: Path, per_cycle: int, steps: int, method: int
) -> None:
    planner.load(path, method, per_cycle, steps)
    record = planner.move(8000)
    held(path, record, method)
    assert record["position"][-1] == path.knots[-1]
    assert record["velocity"][-1] == 0.0
    assert np.all(np.diff(record["position"]) >= 0.0)
    whole = planner_time(planner, path, method)
    # It starts at once, without knowing the path; so it may lose time there, and nowhere else
    assert duration(record, 0.001) <= 1.06 * whole + 0.1 + len(path.owners) / per_cycle * 0.001


def planner_time(planner: Planned, path: Path, method: int) -> float:
    planner.load(path, method, xClosed=True)
    return duration(planner.move(8000), 0.001)


@SETTINGS
@given(
    path=random_paths(),
    changes=st.lists(st.tuples(st.integers(1, 250), st.sampled_from((0.1, 0.3, 0.6, 1.0, 1.3))), max_size=8),
)
def test_the_override_changes_at_any_time(
    planner: Planned, path: Path, changes: list[tuple[int, float]]
) -> None:
    planner.load(path)
    records = []
    for cycles, override in changes:
        records.append(planner.move(cycles))
        planner.set(fOverride=override)
    planner.set(fOverride=1.0)
    records.append(planner.move(9000))
    record = {name: np.concatenate([one[name] for one in records]) for name in records[0]}
    held(path, record)
    assert record["position"][-1] == path.knots[-1]


@SETTINGS
@given(path=random_paths(), at=st.integers(20, 1500), method=st.sampled_from((JERK, ACCELERATION)))
def test_a_hold_comes_to_standstill_and_goes_on(planner: Planned, path: Path, at: int, method: int) -> None:
    planner.load(path, method)
    before = planner.move(at)
    planner.set(xHold=True)
    hold = planner.move(3000)
    planner.set(xHold=False)
    after = planner.move(9000)
    assert hold["velocity"][-1] == 0.0
    assert hold["stands"][-1] == 1.0
    held(path, {name: np.concatenate((before[name], hold[name], after[name])) for name in hold}, method)
    assert after["position"][-1] == path.knots[-1]


def test_a_hold_on_a_line_takes_hardly_longer_than_the_limits_want(planner: Planned) -> None:
    """From v with a and j, standstill takes v/a + a/j at least; a line of 100 at 50 with 500 and 10000."""
    path = Path([line((0, 0), (100, 0), feed=50)], 0.1, [AXIS] * 2)
    planner.load(path, fLead=0.01)
    assert planner.move(400)["velocity"][-1] == pytest.approx(50, rel=4e-3)
    planner.set(xHold=True)
    hold = planner.move(1000)
    stopped = duration(hold, 0.001)
    assert stopped <= 0.01 + 1.7 * (50 / 500 + 500 / 10_000)
    held(path, hold)


def test_joints_of_arcs_are_passed_without_standing(planner: Planned) -> None:
    path = rounded_corners(0.25, 100.0, [AXIS] * 2)
    planner.load(path, xClosed=True)
    record = planner.move(4000)
    held(path, record)
    moving = record["velocity"][: round(duration(record, 0.001) / 0.001)]
    inner = moving[100:-100]
    assert inner.min() > 5.0
    # The acceleration across jumps at the joints, by 1/r v^2: that much jerk takes a cycle
    assert np.abs(np.diff(axis_motion(path, record).acceleration, axis=0)).max() <= 2.0 * AXIS[2] * 0.001


@pytest.mark.parametrize("method", [JERK, ACCELERATION])
def test_at_every_instant_a_limit_is_reached_or_it_says_why_not(planner: Planned, method: int) -> None:
    path = Path([wave(4, 0.35, 60, feed=50, acceleration=2000, jerk=50_000)], 0.2, [AXIS] * 2)
    planner.load(path, method, xClosed=True)
    record = planner.move(5000)
    moving = record["stands"] == 0.0
    names = np.array(LIMITS)[record["limit"].astype(int)]
    assert set(names[~moving]) == {"Standing"}
    assert np.all((record["share"][moving] >= 0.9) | (names[moving] == "Transition"))
    assert np.mean(names[moving] == "Transition") < 0.02
    assert {"Feed", "Acceleration"} <= set(names[moving])
