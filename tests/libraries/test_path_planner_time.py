"""How close planned motion is to the shortest time: of Ruckig on lines, of linear programs on curves."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
import pytest
import ruckig
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from tests.libraries.ideal_path_times import (
    fastest_with_acceleration,
    fastest_with_jerk,
    grid_of,
    jerk_time,
    time_of,
)
from tests.libraries.planned_path import (
    ACCELERATION,
    JERK,
    Path,
    Planned,
    curve,
    duration,
    line,
    planned,
    rounded_corners,
    wave,
)

WITHIN_ACCELERATION, WITHIN_JERK = 1.05, 1.10
"""The shortest time times this is what the product promises."""
JUMP_TIME = 0.001
AXIS = (200.0, 500.0, 10_000.0)


@pytest.fixture(scope="module")
def planner() -> Iterator[Planned]:
    with planned() as program:
        yield program


def paths() -> dict[str, Path]:
    own = {"acceleration": 2000.0, "jerk": 50_000.0}
    return {
        "line": Path([line((0, 0), (100, 40), feed=150, **own)], 0.5, [AXIS] * 2),
        "rounded corners": rounded_corners(0.5, 100.0, [AXIS] * 2),
        "wave": Path([wave(4, 0.35, 60, feed=200, **own)], 0.4, [AXIS] * 2),
        "flat wave": Path([wave(6, 0.1, 90, feed=120, **own)], 0.4, [AXIS] * 2),
        "helix of three axes": Path(
            [curve(lambda u: np.stack((9 * np.cos(u), 9 * np.sin(u), 2 * u), axis=1), 9.0, feed=90, **own)],
            0.4,
            [AXIS, (120.0, 300.0, 6000.0), (30.0, 80.0, 3000.0)],
        ),
        "feed in steps": Path(
            [
                line((20 * n, 0), (20 * n + 20, 0), feed=feed, **own)
                for n, feed in enumerate((60, 150, 20, 90))
            ],
            0.4,
            [AXIS] * 2,
        ),
        "spiral": Path(
            [curve(lambda u: np.stack((u * np.cos(u), u * np.sin(u)), axis=1) * 0.8, 14.0, feed=300, **own)],
            0.4,
            [AXIS] * 2,
        ),
    }


def planned_time(planner: Planned, path: Path, method: int) -> float:
    planner.load(path, method, xClosed=True)
    return duration(planner.move(8000), 0.001)


@pytest.mark.parametrize("name", paths())
def test_with_limited_acceleration_nearly_as_fast_as_can_be(planner: Planned, name: str) -> None:
    path = paths()[name]
    grid = grid_of(path)
    ideal = time_of(grid.points, fastest_with_acceleration(grid))
    assert 0.99 * ideal < planned_time(planner, path, ACCELERATION) <= 1.01 * ideal + 0.002


@pytest.mark.slow
def test_table_of_times_beside_the_shortest(planner: Planned, capsys: pytest.CaptureFixture[str]) -> None:
    rows = []
    for name, path in paths().items():
        grid, fine = grid_of(path), grid_of(path, 3, JUMP_TIME)
        acceleration = time_of(grid.points, fastest_with_acceleration(grid))
        jerk = jerk_time(fine.points, fastest_with_jerk(fine))
        ours = [planned_time(planner, path, method) for method in (ACCELERATION, JERK)]
        rows.append((name, acceleration, ours[0], ours[0] / acceleration, jerk, ours[1], ours[1] / jerk))
    with capsys.disabled():
        print("\npath                  | acceleration: ideal, planned, ratio | jerk: ideal, planned, ratio")
        for name, *numbers in rows:
            print(f"{name:21} | {numbers[0]:7.4f} {numbers[1]:7.4f} {numbers[2]:6.4f} | ", end="")
            print(f"{numbers[3]:7.4f} {numbers[4]:7.4f} {numbers[5]:6.4f}")
    assert max(row[3] for row in rows) <= WITHIN_ACCELERATION
    assert max(row[6] for row in rows) <= WITHIN_JERK


LIMIT = st.floats(min_value=-1.0, max_value=1.0)


@settings(max_examples=40, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(length=LIMIT, velocity=LIMIT, acceleration=LIMIT, jerk=LIMIT)
def test_a_line_is_gone_nearly_as_fast_as_by_ruckig(
    planner: Planned, length: float, velocity: float, acceleration: float, jerk: float
) -> None:
    limits = {"feed": 50 * 10**velocity, "acceleration": 100 * 10**acceleration, "jerk": 1000 * 10**jerk}
    way = 20 * 10**length
    problem = ruckig.InputParameter(1)
    problem.target_position = [way]
    problem.max_velocity, problem.max_acceleration, problem.max_jerk = ([limit] for limit in limits.values())
    trajectory = ruckig.Trajectory(1)
    assert ruckig.Ruckig(1).calculate(problem, trajectory) == ruckig.Result.Working
    path = Path([line((0.0, 0.0), (way, 0.0), **limits)], way / 120)
    cycle = trajectory.duration / 2000
    planner.load(path, JERK, cycle=cycle, xClosed=True, fLead=20 * cycle)
    record = planner.move(4000)
    # On a grid of cells of equal length; both ends are cut finer by the planner
    assert duration(record, cycle) <= 1.03 * trajectory.duration
    assert duration(record, cycle) >= 0.999 * trajectory.duration
    assert record["position"][-1] == pytest.approx(way, abs=1e-12 * way)
