"""The laws of motion of segments: the twin of SM3_Basic, for what is told of a cam without a compiler.

Checks, tables of points and optimisation need values where nothing can be compiled. A test compares all of
them with `SMC_CAMEvaluate`, which draws the curves of the editor. Source: cam.md section 1, VDI 2143.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

from tappet.project.cams.table import CamPoint, CamSegment, CamTable

_PI = math.pi
_AREA = 1 / (2 * _PI) + 2 / _PI**2
"""Under the velocity of one half of a modified sine with an acceleration of at most 1."""
_PACE = 2 * _PI / 3


class Values(NamedTuple):
    """Position of the slave and its derivatives by the position of the master."""

    y: float
    v: float
    a: float
    j: float


def values_in(left: CamPoint, segment: CamSegment, right: CamPoint, x: float) -> Values:
    """At a position of the master within a segment, ends included."""
    width = right.x - left.x
    s = (x - left.x) / width
    if segment.law == "modified_sine":
        found = _modified_sine(left, segment, right, s)
    elif segment.law in ("sine", "inclined_sine", "harmonic"):
        found = _harmonic(left, segment, right, s)
    else:
        found = _power_values(coefficients(left, segment, right), s)
    return Values(found.y, found.v / width, found.a / width**2, found.j / width**3)


def value_at(cam: CamTable, x: float) -> Values:
    """At a position of the master; between two segments by the right one, outside those at the ends."""
    low, high = 0, len(cam.segments) - 1
    while low < high:
        middle = (low + high + 1) // 2
        if cam.points[middle].x <= x:
            low = middle
        else:
            high = middle - 1
    left, right = cam.points[low], cam.points[low + 1]
    return values_in(left, cam.segments[low], right, min(max(x, left.x), right.x))


def coefficients(left: CamPoint, segment: CamSegment, right: CamPoint) -> list[float]:
    """Of a line or polynomial by the part of the segment, that of the lowest power first."""
    h = right.x - left.x
    rise = right.y - left.y
    if segment.law == "line":
        return [left.y, rise]
    c1 = left.v * h
    d0, d1 = rise - c1, right.v * h - c1
    if segment.law == "poly3":
        return [left.y, c1, 3 * d0 - d1, d1 - 2 * d0]
    c2 = left.a * h * h / 2
    d0, d1, d2 = d0 - c2, d1 - 2 * c2, right.a * h * h - 2 * c2
    if segment.law == "poly5":
        return [
            left.y,
            c1,
            c2,
            10 * d0 - 4 * d1 + d2 / 2,
            -15 * d0 + 7 * d1 - d2,
            6 * d0 - 3 * d1 + d2 / 2,
        ]
    c3 = left.j * h**3 / 6
    d0, d1, d2, d3 = d0 - c3, d1 - 3 * c3, d2 - 6 * c3, right.j * h**3 - 6 * c3
    return [
        left.y,
        c1,
        c2,
        c3,
        35 * d0 - 15 * d1 + 2.5 * d2 - d3 / 6,
        -84 * d0 + 39 * d1 - 7 * d2 + d3 / 2,
        70 * d0 - 34 * d1 + 6.5 * d2 - d3 / 2,
        -20 * d0 + 10 * d1 - 2 * d2 + d3 / 6,
    ]


def _power_values(c: Sequence[float], s: float) -> Values:
    found = []
    powers = list(c)
    for _ in range(4):
        value = 0.0
        for factor in reversed(powers):
            value = value * s + factor
        found.append(value)
        powers = [n * factor for n, factor in enumerate(powers)][1:]
    return Values(*found)


def harmonic_coefficients(left: CamPoint, segment: CamSegment, right: CamPoint) -> list[float]:
    """c1 to c5 of Y0 + c1 s + c2 (cos(pi s) - 1) + c3 sin(pi s) + c4 (cos(2 pi s) - 1) + c5 sin(2 pi s).

    Of sines, inclined sines and harmonics.
    """
    h = right.x - left.x
    rise = right.y - left.y
    v0 = v1 = a0 = a1 = 0.0
    if segment.law == "sine":
        a0 = _PI**2 * rise / 2
        a1 = -a0
    elif segment.law == "harmonic":
        v0, v1, a0, a1 = left.v * h, right.v * h, left.a * h * h, right.a * h * h
    c2 = (a1 - a0) / (2 * _PI**2)
    c1 = rise + 2 * c2
    c5 = ((v0 + v1) / 2 - c1) / (2 * _PI)
    return [c1, c2, (v0 - v1) / (2 * _PI), -(a0 + a1) / (8 * _PI**2), c5]


def _harmonic(left: CamPoint, segment: CamSegment, right: CamPoint, s: float) -> Values:
    c1, c2, c3, c4, c5 = harmonic_coefficients(left, segment, right)
    sin1, cos1 = math.sin(_PI * s), math.cos(_PI * s)
    sin2, cos2 = 2 * sin1 * cos1, 1 - 2 * sin1 * sin1
    return Values(
        left.y + c1 * s + c2 * (cos1 - 1) + c3 * sin1 + c4 * (cos2 - 1) + c5 * sin2,
        c1 + _PI * (c3 * cos1 - c2 * sin1 + 2 * (c5 * cos2 - c4 * sin2)),
        -(_PI**2) * (c2 * cos1 + c3 * sin1 + 4 * (c4 * cos2 + c5 * sin2)),
        _PI**3 * (c2 * sin1 - c3 * cos1 + 8 * (c4 * sin2 - c5 * cos2)),
    )


def _modified_sine(left: CamPoint, segment: CamSegment, right: CamPoint, s: float) -> Values:
    h, part = right.x - left.x, segment.inflection
    v0, v1 = left.v * h, right.v * h
    down = _PI * (v1 - v0) / 2
    up = (right.y - left.y - v0 * part - v1 * (1 - part)) / _AREA + down * (1 - part)
    down = up - down
    if s <= part:
        half = _half_sine(s / part)
        return Values(
            left.y + v0 * s + up * part * half.y,
            v0 + up * half.v,
            up / part * half.a,
            up / part**2 * half.j,
        )
    part, s = 1 - part, 1 - s
    half = _half_sine(s / part)
    return Values(
        right.y - v1 * s - down * part * half.y,
        v1 + down * half.v,
        -down / part * half.a,
        down / part**2 * half.j,
    )


def _half_sine(s: float) -> Values:
    """Half of a modified sine from standstill, with an acceleration of at most 1."""
    if s <= 0.25:
        phase = 2 * _PI * s
        return Values(
            (s - math.sin(phase) / (2 * _PI)) / (2 * _PI),
            (1 - math.cos(phase)) / (2 * _PI),
            math.sin(phase),
            2 * _PI * math.cos(phase),
        )
    phase = _PACE * (s - 0.25)
    return Values(
        (0.25 - 1 / (2 * _PI)) / (2 * _PI) + (s - 0.25) / (2 * _PI) + (1 - math.cos(phase)) / _PACE**2,
        1 / (2 * _PI) + math.sin(phase) / _PACE,
        math.cos(phase),
        -_PACE * math.sin(phase),
    )
