"""Points moved for the least peak, against closed forms, other optimisers and numpy's polynomials."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.interpolate import BPoly
from scipy.optimize import minimize

from tappet.motion.cam_optimisation import CamOptimisationError, Goal, optimised
from tappet.project.cams.table import CamPoint, CamSegment, CamTable

ORDERS: dict[Goal, int] = {"velocity": 1, "acceleration": 2, "jerk": 3}
NUMBERS = st.floats(-5, 5).map(lambda number: round(number, 2))


def peak(points: list[tuple[float, float, float, float]], order: int, samples: int = 129) -> float:
    """The largest absolute derivative of the quintic segments through (x, y, v, a), by scipy."""
    curve = BPoly.from_derivatives([x for x, *_ in points], [[y, v, a] for _, y, v, a in points], orders=5)
    derivative = curve.derivative(order)
    found = 0.0
    for (left, *_), (right, *_) in pairwise(points):
        inside = np.linspace(left, right, samples)
        inside[0], inside[-1] = np.nextafter(left, right), np.nextafter(right, left)
        found = max(found, float(np.max(np.abs(derivative(inside)))))
    return found


def states(cam: CamTable) -> list[tuple[float, float, float, float]]:
    return [(point.x, point.y, point.v, point.a) for point in cam.points]


def rise(*inner: float) -> CamTable:
    """From rest at 0 to rest at 1 within 1, with points on the straight line between."""
    xs = (0.0, *inner, 1.0)
    points = tuple(CamPoint(x=x, y=x, v=float(0 < x < 1)) for x in xs)
    return CamTable(
        points=points, segments=(CamSegment(),) * (len(xs) - 1), tracks=(), slave_start=0, slave_end=1
    )


@pytest.mark.parametrize(
    ("goal", "least", "quintic"),
    [("velocity", 1.0, 1.875), ("acceleration", 4.0, 10 / 3**0.5), ("jerk", 32.0, 60.0)],
)
def test_peaks_lie_between_the_optimum_of_any_law_and_the_single_polynomial(
    goal: Goal, least: float, quintic: float
) -> None:
    """No motion from rest to rest has less than 1, 4 and 32; one polynomial has 1.875, 5.77 and 60."""
    found = optimised(rise(0.25, 0.5, 0.75), [1, 2, 3], goal, keep_positions=False)
    after = peak(states(found.cam), ORDERS[goal], 2001)
    assert least <= after < quintic
    assert found.peaks.after == pytest.approx(after, rel=2e-3)
    more = optimised(rise(*np.linspace(0, 1, 13)[1:-1].tolist()), range(1, 12), goal, keep_positions=False)
    assert least <= peak(states(more.cam), ORDERS[goal], 2001) <= after * (1 + 1e-6)


@settings(max_examples=25, deadline=None)
@given(
    widths=st.lists(st.floats(0.5, 3).map(lambda w: round(w, 2)), min_size=2, max_size=3),
    numbers=st.lists(st.tuples(NUMBERS, NUMBERS, NUMBERS), min_size=4, max_size=4),
    goal=st.sampled_from(sorted(ORDERS)),
    keep=st.booleans(),
)
def test_another_optimiser_finds_nothing_better(
    widths: list[float], numbers: list[tuple[float, float, float]], goal: Goal, keep: bool
) -> None:
    xs = [0.0, *np.cumsum(widths).tolist()]
    points = tuple(CamPoint(x=x, y=y, v=v, a=a) for x, (y, v, a) in zip(xs, numbers, strict=False))
    cam = CamTable(
        points=points, segments=(CamSegment(),) * len(widths), tracks=(), slave_start=-100, slave_end=100
    )
    found = optimised(cam, [1], goal, keep)
    order = ORDERS[goal]
    beside = states(cam)[:3]
    after = peak(states(found.cam)[:3], order)
    assert found.peaks.before == pytest.approx(peak(beside, order), rel=1e-9, abs=1e-12)
    assert found.peaks.after == pytest.approx(after, rel=1e-6, abs=1e-9)

    def other(values: np.ndarray) -> float:
        y, v, a = (beside[1][1], *values) if keep else tuple(values)
        return peak([beside[0], (beside[1][0], y, v, a), beside[2]], order)

    start = list(states(found.cam)[1])[2 if keep else 1 :]
    for shake in (0.0, 0.3):
        tried = minimize(other, np.array(start) + shake, method="Nelder-Mead", options={"maxiter": 400})
        assert tried.fun >= after * (1 - 1e-5) - 1e-9
    assert [one for n, one in enumerate(cam.points) if n != 1] == [
        one for n, one in enumerate(found.cam.points) if n != 1
    ]


def test_positions_stay_where_they_are_shown() -> None:
    found = optimised(
        rise(0.5).model_copy(update={"slave_start": 0.45, "slave_end": 0.55}),
        [1],
        "velocity",
        keep_positions=False,
    )
    assert 0.45 <= found.cam.points[1].y <= 0.55
    kept = optimised(rise(0.3), [1], "acceleration", keep_positions=True)
    assert kept.cam.points[1].y == 0.3
    assert kept.peaks.after < kept.peaks.before


def test_a_cam_that_is_best_already_stays_as_it_is() -> None:
    line = CamTable(
        points=tuple(CamPoint(x=x, y=x, v=1) for x in (0.0, 1.0, 2.0)),
        segments=(CamSegment(),) * 2,
        tracks=(),
    )
    found = optimised(line, [1], "velocity", keep_positions=False)
    assert found.cam == line
    assert found.peaks.after == found.peaks.before == pytest.approx(1.0)


@pytest.mark.parametrize("points", [[], [0], [2], [-1], list(range(200))])
def test_what_cannot_be_moved_is_told(points: list[int]) -> None:
    with pytest.raises(CamOptimisationError):
        optimised(rise(0.5), points, "jerk", keep_positions=False)
