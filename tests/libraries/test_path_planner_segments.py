"""Paths of many short lines: gone at the feed without stutter, through a window shorter than they are."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import pairwise

import numpy as np
import pytest
from tests.libraries.planned_path import (
    ACCELERATION,
    JERK,
    Element,
    Path,
    Planned,
    duration,
    line,
    planned,
)

AXIS = (200.0, 500.0, 10_000.0)


@pytest.fixture(scope="module")
def planner() -> Iterator[Planned]:
    with planned() as program:
        yield program


def chords(count: int, radius: float = 20.0, length: float = 0.1, **limits: float) -> list[Element]:
    """A circle by short lines."""
    turn = 2 * np.arcsin(length / 2 / radius)
    corners = [(radius * np.sin(n * turn), radius * (1 - np.cos(n * turn))) for n in range(count + 1)]
    return [line(one, other, **limits) for one, other in pairwise(corners)]


@pytest.mark.parametrize("method", [JERK, ACCELERATION])
@pytest.mark.parametrize("per_cycle", [2, 4000])
def test_short_lines_are_gone_at_the_feed(planner: Planned, method: int, per_cycle: int) -> None:
    """1500 lines of 0.1: four times as many as the window holds."""
    path = Path(chords(1500, feed=50, acceleration=400, jerk=8000), 0.1, [AXIS] * 2)
    planner.load(path, method, per_cycle)
    record = planner.move(4000)
    assert record["position"][-1] == path.knots[-1]
    velocity = record["velocity"][: round(duration(record, 0.001) / 0.001)]
    ramp = 250
    assert velocity[ramp:-ramp].min() > 0.99 * 50
    assert velocity.max() <= 50.0
    # v/a + a/j + L/v where nothing is in the way
    assert (
        duration(record, 0.001)
        <= 1.02 * (path.knots[-1] / 50 + 50 / 400 + (400 / 8000 if method == JERK else 0.0)) + 0.01
    )


def test_another_feed_on_each_line_stops_nothing(planner: Planned) -> None:
    """Feeds of 40 and 60 in turn, ten lines each: as one path whose top has steps."""
    elements = [
        line((n, 0), (n + 1, 0), feed=60.0 if n // 10 % 2 else 40.0, acceleration=400, jerk=8000)
        for n in range(100)
    ]
    path = Path(elements, 0.25, [AXIS] * 2)
    planner.load(path, JERK, 4)
    record = planner.move(5000)
    assert record["position"][-1] == path.knots[-1]
    moving = record["velocity"][: round(duration(record, 0.001) / 0.001)]
    # With limited jerk it is faster to be a little slower before a step up: the acceleration is there then
    assert moving[250:-250].min() > 0.94 * 40
    assert moving.max() > 0.985 * 60
    feeds = np.array([element.feed for element, _ in path.owners])[record["element"].astype(int)]
    assert np.all(record["velocity"] <= feeds * (1 + 1e-9))


@pytest.mark.parametrize("method", [JERK, ACCELERATION])
@pytest.mark.parametrize("count", [1, 2, 3, 5])
def test_a_few_cells_are_gone(planner: Planned, method: int, count: int) -> None:
    path = Path([line((0, 0), (0.1 * count, 0), feed=50, acceleration=400, jerk=8000)], 0.1, [AXIS] * 2)
    planner.load(path, method)
    record = planner.move(600)
    assert record["position"][-1] == path.knots[-1]
    assert record["velocity"].max() > 0.0


def test_a_path_stops_where_an_element_wants_it(planner: Planned) -> None:
    elements = [line((0, 0), (10, 0), feed=50, acceleration=400, jerk=8000)]
    elements.append(line((10, 0), (10, 10), feed=50, acceleration=400, jerk=8000, start_velocity=0.0))
    path = Path(elements, 0.25, [AXIS] * 2)
    planner.load(path, JERK, xClosed=True)
    record = planner.move(3000)
    corner = int(np.argmin(np.abs(record["position"] - 10.0)))
    assert record["position"][corner] == pytest.approx(10.0, abs=1e-3)
    assert record["velocity"][corner] < 0.5
    assert record["position"][-1] == path.knots[-1]


@pytest.mark.parametrize("wrong", [np.nan, np.inf, -1.0, 0.0])
def test_a_cell_without_a_length_is_refused(planner: Planned, wrong: float) -> None:
    path = Path([line((0, 0), (1, 0), feed=50, acceleration=400, jerk=8000)], 0.25, [AXIS] * 2)
    planner.load(path)
    planner.inside[1] = wrong
    before = planner.count("nBehind")
    record = planner.move(50)
    assert planner.count("nBehind") == before
    assert np.all(record["stands"] == 1.0)
