"""The curves of a cam: samples to draw, extremes to show, values at single positions (cam.md 4 and 5)."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
import numpy.typing as npt

from tappet.motion.bends import bends
from tappet.motion.cam_program import CamProgram, Numbers
from tappet.project.cams.table import CamTable

PARTS = 16
"""Into which the place of a zero is divided, so many times; the last step is a secant."""
ROUNDS = 4
LEAST_SAMPLES = 9
"""Of a segment, so that narrow ones show their bends ..."""
MOST_SAMPLES = 8_000
"""... as long as the whole cam has no more than about so many."""
SIDE = 8
"""Spacings of floating-point numbers from a jump to a place that is surely beside it."""


@dataclass(frozen=True, slots=True)
class SegmentCurve:
    """Samples of a segment and its extremes."""

    samples: Numbers
    """Columns x, y, v, a, j; both ends are of this segment."""
    least: float
    greatest: float
    velocity: float
    """Largest absolute value, as the next two are."""
    acceleration: float
    jerk: float


@dataclass(frozen=True, slots=True)
class CamCurves:
    """Of a whole cam."""

    segments: tuple[SegmentCurve, ...]
    at: Numbers
    """Rows x, y, v, a, j for the positions asked for."""


def cam_curves(program: CamProgram, cam: CamTable, samples: int, at: Sequence[float] = ()) -> CamCurves:
    """About so many samples, spread by width, and of each segment enough to show its shape."""
    program.take(list(cam.pieces()))
    corners = np.array([point.x for point in cam.points])
    least = max(2, min(LEAST_SAMPLES, samples, MOST_SAMPLES // (len(corners) - 1)))
    counts = np.maximum(least, np.rint(samples * np.diff(corners) / (corners[-1] - corners[0])).astype(int))
    spread = [
        np.linspace(left, right, count)
        for (left, right), count in zip(pairwise(corners), counts, strict=True)
    ]
    x = np.concatenate(spread)
    drawn = np.column_stack([x, program.values(np.repeat(np.arange(len(counts)), counts), x)])
    low, high, peaks = _extremes(program, cam, corners)
    parts = np.split(drawn, np.cumsum(counts)[:-1])
    segments = tuple(
        SegmentCurve(part, float(low[n]), float(high[n]), *(float(peak) for peak in peaks[n]))
        for n, part in enumerate(parts)
    )
    return CamCurves(segments, _single(program, corners, np.array(at, dtype=float)))


def _single(program: CamProgram, corners: Numbers, x: Numbers) -> Numbers:
    """Outside the range the values of its ends; at a corner those of the segment behind it."""
    which = np.clip(np.searchsorted(corners, x, side="right") - 1, 0, len(corners) - 2)
    return np.column_stack([x, program.values(which, np.clip(x, corners[0], corners[-1]))])


def _extremes(program: CamProgram, cam: CamTable, corners: Numbers) -> tuple[Numbers, Numbers, Numbers]:
    """Least and greatest position, and the greatest absolute derivatives in columns, by segment.

    Between the zeros of the fourth derivative the jerk is monotonic, and has one zero at most; between those
    the acceleration, and so on: no extreme is lost between two samples.
    """
    left, right = corners[:-1, None], corners[1:, None]
    numbers = np.arange(len(left))[:, None]
    bent = np.clip(left + bends(list(cam.pieces())) * (right - left), left, right)
    side = SIDE * np.spacing(np.maximum(np.abs(left), np.abs(right)))
    jerk_free = _zeros(program, 3, np.hstack([left, bent, right]))
    even = _zeros(program, 2, np.hstack([left, bent, jerk_free, right]))
    still = _zeros(program, 1, np.hstack([left, bent, even, right]))
    places = np.hstack([left, right, bent - side, bent, bent + side, jerk_free, even, still])
    which = np.broadcast_to(numbers, places.shape).ravel()
    found = program.values(which, np.clip(places, left, right).ravel()).reshape(*places.shape, 4)
    return found[..., 0].min(axis=1), found[..., 0].max(axis=1), np.abs(found[..., 1:]).max(axis=1)


def _zeros(program: CamProgram, order: int, borders: Numbers) -> Numbers:
    """Where a derivative vanishes between borders in rows, within which it is monotonic; else a border."""
    borders = np.sort(borders, axis=1)

    def derivative(rows: npt.NDArray[np.intp], x: Numbers) -> Numbers:
        which = np.broadcast_to(rows[:, None], x.shape).ravel()
        return program.values(which, x.ravel())[:, order].reshape(x.shape)

    at_borders = derivative(np.arange(len(borders)), borders)
    found = borders[:, :-1].copy()
    crossing = at_borders[:, :-1] * at_borders[:, 1:] < 0
    rows = np.nonzero(crossing)[0]
    low, high = borders[:, :-1][crossing], borders[:, 1:][crossing]
    at_low, at_high = at_borders[:, :-1][crossing], at_borders[:, 1:][crossing]
    each = np.arange(len(rows))
    for _ in range(ROUNDS):
        inner = low[:, None] + (high - low)[:, None] * (np.arange(1, PARTS) / PARTS)
        x = np.column_stack([low, inner, high])
        values = np.column_stack([at_low, derivative(rows, inner), at_high])
        other = np.argmax(np.sign(values) != np.sign(at_low)[:, None], axis=1)
        low, high = x[each, other - 1], x[each, other]
        at_low, at_high = values[each, other - 1], values[each, other]
    found[crossing] = low + (high - low) * at_low / (at_low - at_high)
    return found
