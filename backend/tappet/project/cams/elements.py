"""The elements that a cam is compiled into: points with derivatives, or positions of a table (CAM-75)."""

from __future__ import annotations

import math
from bisect import bisect_right
from itertools import accumulate

from tappet.project.cams.laws import value_at, values_in
from tappet.project.cams.table import CamPoint, CamSegment, CamTable

_EQUAL = 1e-9
"""Derivatives that differ by less than this part are those of one point."""
_FLOOR = 0.05
"""Part of the points of a table that is spread evenly, so that straight parts have some, too."""
_FINE = 16
"""Steps for each point of a table, in which its bends are looked for."""


def xyva_points(cam: CamTable) -> list[CamPoint]:
    """Points between which polynomials of fifth degree are the segments of the cam.

    Where the curve bends at a point it stands twice: as the end of one segment and the start of the next.
    """
    found: list[CamPoint] = []
    for left, segment, right in cam.pieces():
        start, end = _state(left, segment, right, left), _state(left, segment, right, right)
        if not found or not _same(found[-1], start, right.x - left.x):
            found.append(start)
        found.append(end)
    return found


def _state(left: CamPoint, segment: CamSegment, right: CamPoint, at: CamPoint) -> CamPoint:
    """An end of a segment with the derivatives of its curve."""
    if segment.law not in ("line", "poly3"):
        return at.model_copy(update={"j": 0.0})
    values = values_in(left, segment, right, at.x)
    return CamPoint.model_construct(x=at.x, y=at.y, v=values.v, a=values.a, j=0.0)


def _same(one: CamPoint, other: CamPoint, width: float) -> bool:
    size_v = max(abs(one.v), abs(other.v), abs(one.y) / width * _EQUAL)
    size_a = max(abs(one.a), abs(other.a), size_v / width)
    return abs(one.v - other.v) <= _EQUAL * size_v and abs(one.a - other.a) <= _EQUAL * size_a


def equal_steps(first: float, last: float, count: int) -> list[float]:
    """So many positions of the master at equal distances, both ends among them."""
    return [first + (last - first) * number / (count - 1) for number in range(count - 1)] + [last]


def equidistant(cam: CamTable, count: int) -> list[tuple[float, float]]:
    """Master and slave at so many equal distances of the master, both ends among them."""
    return [(x, value_at(cam, x).y) for x in equal_steps(*cam.domain, count)]


def by_bend(cam: CamTable, count: int) -> list[tuple[float, float]]:
    """Master and slave at so many positions, closer to each other the more the curve bends.

    A line between two positions misses the curve by A h²/8; it does so equally everywhere where their density
    goes by the root of A. Points of the cam are among them as far as there is room.
    """
    first, last = cam.domain
    steps = _FINE * count
    width = (last - first) / steps
    weights = [math.sqrt(abs(value_at(cam, first + (number + 0.5) * width).a)) for number in range(steps)]
    mean = sum(weights) / steps
    weights = [weight + (_FLOOR * mean if mean else 1.0) for weight in weights]
    reached = [0.0, *accumulate(weights)]
    kept = {point.x for point in cam.points} if len(cam.points) <= count else {first, last}
    free = count - len(kept)
    places = sorted(kept)
    for number in range(free):
        wanted = reached[-1] * (number + 1) / (free + 1)
        step = min(bisect_right(reached, wanted) - 1, steps - 1)
        x = first + (step + (wanted - reached[step]) / weights[step]) * width
        places.append(x)
    places = _apart(sorted(places), (last - first) / (_FINE * count * count))
    while len(places) < count:
        gaps = [(places[n + 1] - places[n], n) for n in range(len(places) - 1)]
        _, widest = max(gaps)
        places.insert(widest + 1, (places[widest] + places[widest + 1]) / 2)
    return [(x, value_at(cam, x).y) for x in places]


def _apart(places: list[float], least: float) -> list[float]:
    """Without those that nearly coincide with the one before; the last one stays."""
    found = [places[0]]
    for x in places[1:]:
        if x - found[-1] > least:
            found.append(x)
        elif x == places[-1]:
            found[-1] = x
    return found
