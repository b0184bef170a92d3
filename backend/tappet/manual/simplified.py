"""Polylines with fewer points: Ramer-Douglas-Peucker."""

from __future__ import annotations

import math
from collections.abc import Sequence

Point = tuple[float, float]
TOLERANCE = 0.3
"""How far a point that is left out may lie beside the line, in pixels."""


def simplified(points: Sequence[Point], tolerance: float = TOLERANCE) -> list[Point]:
    """The points from which no other is farther than `tolerance`; the ends stay."""
    kept = [False] * len(points)
    kept[0] = kept[-1] = True
    waiting = [(0, len(points) - 1)]
    while waiting:
        first, last = waiting.pop()
        farthest, distance = 0, tolerance
        for number in range(first + 1, last):
            here = _distance(points[number], points[first], points[last])
            if here > distance:
                farthest, distance = number, here
        if farthest:
            kept[farthest] = True
            waiting += [(first, farthest), (farthest, last)]
    return [point for point, keep in zip(points, kept, strict=True) if keep]


def _distance(point: Point, begin: Point, end: Point) -> float:
    """Of a point from the line through two others."""
    (x, y), (x0, y0), (x1, y1) = point, begin, end
    length = math.hypot(x1 - x0, y1 - y0)
    if length <= 0.0:
        return math.hypot(x - x0, y - y0)
    return abs((x1 - x0) * (y0 - y) - (x0 - x) * (y1 - y0)) / length
