"""The shortest time along a path by linear programming: the reference for SM3_PathPlanner.

With limited acceleration the problem is linear in the squares of the velocity, and its largest solution is
the fastest one (Verscheure et al. 2009). With limited jerk the bound of d2(v^2)/ds2 is J/v: convex, so its
tangent is a bound that is sufficient, and programs with the tangents at the solution before get faster one
after the other (Debrouwere et al. 2013).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt
from scipy.optimize import linprog
from scipy.sparse import csr_matrix, diags_array, vstack
from tests.libraries.planned_path import Path

Numbers = npt.NDArray[np.float64]
ROUNDS = 40


@dataclass(frozen=True)
class Grid:
    """Cells of a path: derivatives of its axes and of the path itself (last row) at both ends; limits."""

    points: Numbers
    sides: tuple[Numbers, Numbers]  # start and end of the cells: (order, rows, cells)
    tops: Numbers  # of v^2 at the points
    acceleration: Numbers  # (rows,)
    jerk: Numbers


def grid_of(path: Path, parts: int = 1, jump_time: float = 0.0) -> Grid:
    """The cells of a path, each in so many parts; all elements have the same limits but the feed.

    Where the curvature jumps, an axis may take the jump of its acceleration within `jump_time` by its jerk,
    if that is given.
    """
    points, starts, ends, feeds = [0.0], [], [], []
    for cell in range(len(path.owners)):
        element, place = path.owners[cell]
        length = path.knots[cell + 1] - path.knots[cell]
        for part in range(parts):
            points.append(path.knots[cell] + length * (part + 1) / parts)
            starts.append(element.shape(place + length * part / parts))
            ends.append(element.shape(place + length * (part + 1) / parts))
            feeds.append(element.feed)
    sides = []
    for values in (starts, ends):
        table = np.array(values)[:, 1:, : len(path.limits)].transpose(1, 2, 0)
        own = np.zeros((3, 1, table.shape[2]))
        own[0] = 1.0
        sides.append(np.concatenate((table, own), axis=1))
    limits = np.array(path.limits)
    fastest = np.minimum.reduce(
        [
            np.array(feeds),
            *((limits[:, [0]] / np.maximum(np.abs(side[0, :-1]), 1e-12)).min(axis=0) for side in sides),
        ]
    )
    tops = np.minimum(np.append(fastest, np.inf), np.append(np.inf, fastest)) ** 2
    if jump_time:
        jumps = np.abs(sides[0][1, :-1, 1:] - sides[1][1, :-1, :-1])
        tops[1:-1] = np.minimum(
            tops[1:-1], (limits[:, [2]] * jump_time / np.maximum(jumps, 1e-9)).min(axis=0)
        )
    element = path.elements[0]
    return Grid(
        np.array(points),
        (sides[0], sides[1]),
        tops,
        np.append(limits[:, 1], element.acceleration),
        np.append(limits[:, 2], element.jerk),
    )


def time_of(points: Numbers, squares: Numbers) -> float:
    """Time with v^2 linear between the points."""
    v = np.sqrt(squares)
    return float((2 * np.diff(points) / (v[1:] + v[:-1])).sum())


def _forwards(grid: Grid) -> csr_matrix:
    """First derivative in the cells, by the points."""
    h, count = np.diff(grid.points), len(grid.points)
    return diags_array([-1 / h, 1 / h], offsets=[0, 1], shape=(count - 1, count)).tocsr()


def _between(values: Numbers, offset: int, count: int) -> csr_matrix:
    """A factor for the point so many behind, in each row."""
    return diags_array([values], offsets=[offset], shape=(len(values), count)).tocsr()


def fastest_with_acceleration(grid: Grid) -> Numbers:
    """v^2 at the points."""
    forwards, count = _forwards(grid), len(grid.points)
    rows, limits = [], []
    for offset, side in enumerate(grid.sides):
        for q1, q2, most in zip(side[0], side[1], grid.acceleration, strict=True):
            row = _between(q2, offset, count) + diags_array(0.5 * q1) @ forwards
            rows += [row, -row]
            limits += [np.full(count - 1, most)] * 2
    tops = grid.tops.copy()
    tops[[0, -1]] = 0.0
    bounds = np.stack((0 * tops, tops), axis=1)
    found = linprog(-np.ones(count), A_ub=vstack(rows).tocsr(), b_ub=np.concatenate(limits), bounds=bounds)
    assert found.success, found.message
    return np.asarray(found.x)


def fastest_with_jerk(grid: Grid) -> Numbers:
    """v^2 at the points; the first and the last cell are gone with constant jerk."""
    x = fastest_with_acceleration(grid)
    floor = 1e-7 * x.max()
    x = np.maximum(0.05 * x, floor)
    best, shortest = x, np.inf
    for number in range(ROUNDS):
        found = _round(grid, x, floor, 3.0 if number < ROUNDS - 12 else 1.1)
        if found is None:
            break
        x = np.maximum(found, floor)
        x[[0, -1]] = 0.0
        time = jerk_time(grid.points, x)
        if time < shortest:
            best, shortest = x.copy(), time
        x[[0, -1]] = floor
    assert np.isfinite(shortest)
    return best


def _round(grid: Grid, x: Numbers, floor: float, step: float) -> Numbers | None:
    """The best v^2 where 1/v is its tangent at `x`, at most `step` times as large; None: there is none."""
    h, count = np.diff(grid.points), len(grid.points)
    forwards, middle = _forwards(grid), 0.5 * (h[1:] + h[:-1])
    bends = diags_array(1 / middle) @ (forwards[1:] - forwards[:-1])  # at the inner points
    around, inner = 0.5 * (forwards[1:] + forwards[:-1]), x[1:-1]
    rows, limits = [], []
    for side in (
        grid.sides[0][:, :, 1:],
        grid.sides[1][:, :, :-1],
    ):  # behind the inner points, and before them
        for q1, q2, q3, most_a, most_j in zip(*side, grid.acceleration, grid.jerk, strict=True):
            row = _between(q2, 1, count) + diags_array(0.5 * q1) @ around
            rows += [row, -row]
            limits += [np.full(count - 2, most_a)] * 2
            value = _between(q3, 1, count) + diags_array(1.5 * q2) @ around + diags_array(0.5 * q1) @ bends
            tangent = _between(0.5 * most_j * inner**-1.5, 1, count)
            rows += [(value + tangent)[1:-1], (tangent - value)[1:-1]]
            limits += [(1.5 * most_j / np.sqrt(inner))[1:-1]] * 2
            for at, point, length in ((0, 1, h[0]), (-1, count - 2, h[-1])):  # x at the end of constant jerk
                rows.append(_point(point, count))
                limits.append(
                    np.array([(4.5 * most_j / max(abs(q1[at]), 1e-9)) ** (2 / 3) * length ** (4 / 3)])
                )
    tops = np.minimum(grid.tops, x * step)
    low = np.maximum(x / step, floor)
    low[[0, -1]] = tops[[0, -1]] = 0.0
    weight = np.zeros(count)
    weight[1:-1] = middle * inner**-1.5
    # Out of standstill v^2 rises with s^(4/3): the slope at the first inner point is 4/3 v^2/h, at the last
    # one as much down
    ends = vstack(
        (
            forwards[[1]] - _point(1, count) * (4 / 3 / h[0]),
            forwards[[-2]] + _point(count - 2, count) * (4 / 3 / h[-1]),
        )
    )
    found = linprog(
        -weight / weight.max(),
        A_ub=vstack(rows).tocsr(),
        b_ub=np.concatenate(limits),
        A_eq=ends.tocsr(),
        b_eq=np.zeros(2),
        bounds=np.stack((np.minimum(low, tops), tops), axis=1),
    )
    return np.asarray(found.x) if found.success else None


def jerk_time(points: Numbers, squares: Numbers) -> float:
    """Time where the first and the last cell are gone with constant jerk."""
    ends = 3 * (points[1] - points[0]) / np.sqrt(squares[1]) + 3 * (points[-1] - points[-2]) / np.sqrt(
        squares[-2]
    )
    return time_of(points[1:-1], squares[1:-1]) + float(ends)


def _point(at: int, count: int) -> csr_matrix:
    return csr_matrix(([1.0], ([0], [at])), shape=(1, count))
