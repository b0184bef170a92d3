"""Which pieces of a path to draw: as few as look the same from where one looks (architecture, decision 14).

The pieces are the leaves of a binary tree: a node of level n stands for 2^n pieces by one line from the first
point of these to the last, and knows how far the points between are from it. From a camera those nodes are
taken whose error is seen under less than a pixel; what the camera does not see is left out. One pass a level
with arrays, over the nodes that matter only.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from tappet.motion.paths.geo_info import Numbers
from tappet.motion.paths.polyline import Polyline

MOST_DRAWN = 60_000
"""Pieces of a picture; beyond, errors of more than a pixel are taken."""
MOST_LEVELS = 24


@dataclass(frozen=True, slots=True)
class Camera:
    """From where a path is looked at, in its own coordinates."""

    place: Numbers
    ahead: Numbers
    """Unit vector."""
    pixel: float
    """Angle of a pixel [rad]."""
    cone: float
    """Half angle of the cone that holds the picture [rad]."""


@dataclass(frozen=True, slots=True)
class Chosen:
    """Lines to draw, each for some pieces: points `start` to `end`, and the piece whose colour it has."""

    start: npt.NDArray[np.intp]
    end: npt.NDArray[np.intp]
    piece: npt.NDArray[np.intp]


@dataclass(frozen=True, slots=True)
class _Level:
    error: npt.NDArray[np.float32]
    """Greatest distance of points from the line; infinite where a gap is inside."""
    middle: npt.NDArray[np.float32]
    radius: npt.NDArray[np.float32]


class Levels:
    """The tree of a path."""

    def __init__(self, path: Polyline) -> None:
        self._points = path.points
        self._drawn = path.of >= 0
        self._levels: list[_Level] = []
        self.low, self.high = _bounds(path)
        count = len(path.of)
        while count and len(self._levels) < MOST_LEVELS:
            self._levels.append(self._level(len(self._levels)))
            if len(self._levels[-1].error) == 1:
                break

    def _ends(self, level: int, nodes: npt.NDArray[np.intp]) -> tuple[npt.NDArray[np.intp], ...]:
        start = nodes << level
        return start, np.minimum((nodes + 1) << level, len(self._drawn))

    def _level(self, level: int) -> _Level:
        nodes = np.arange(-(-len(self._drawn) // (1 << level)))
        start, end = self._ends(level, nodes)
        a, b = self._points[start], self._points[end]
        if level == 0:
            radius = np.linalg.norm(b - a, axis=1) / 2
            error = np.where(self._drawn, 0.0, np.inf)
            return _Level(error.astype(np.float32), ((a + b) / 2).astype(np.float32), _up(radius))
        owner = np.arange(len(self._points) - 1) >> level
        inner = self._points[:-1]
        away = _distance(inner, a[owner], b[owner])
        error = np.maximum.reduceat(away, start)
        gaps = np.logical_or.reduceat(~self._drawn, start)
        low = np.minimum(np.minimum.reduceat(inner, start), b)
        high = np.maximum(np.maximum.reduceat(inner, start), b)
        middle = ((low + high) / 2).astype(np.float32)
        radius = np.linalg.norm(high - low, axis=1) / 2
        return _Level(_up(np.where(gaps, np.inf, error)), middle, _up(radius))

    def choose(self, camera: Camera, most: int = MOST_DRAWN) -> Chosen:
        """The lines for a picture, at most so many but for what a whole picture of gaps needs."""
        pixels = 0.5
        while True:
            found = self._choose(camera, pixels * camera.pixel, most)
            if found is not None:
                return found
            pixels *= 2.0

    def _choose(self, camera: Camera, error: float, most: int) -> Chosen | None:
        start, end, piece = [], [], []
        nodes = np.zeros(1 if self._levels else 0, np.intp)
        drawn = 0
        for level in range(len(self._levels) - 1, -1, -1):
            facts = self._levels[level]
            nodes = nodes[nodes < len(facts.error)]
            away = facts.middle[nodes] - camera.place
            distance = np.linalg.norm(away, axis=1)
            near = np.maximum(distance - facts.radius[nodes], 0.0)
            nodes, near = (part[_seen(camera, away, distance, facts.radius[nodes])] for part in (nodes, near))
            smooth = facts.error[nodes] <= error * near
            if level == 0:
                smooth = np.isfinite(facts.error[nodes])
            begin, finish = self._ends(level, nodes[smooth])
            start.append(begin)
            end.append(finish)
            piece.append((begin + finish) // 2)
            drawn += len(begin)
            rest = nodes[~smooth]
            nodes = np.column_stack([2 * rest, 2 * rest + 1]).ravel() if level else rest
            if drawn + len(nodes) // 2 > most and error < 1.0:
                return None
        return Chosen(*(np.concatenate(parts or [np.zeros(0, np.intp)]) for parts in (start, end, piece)))

    def nearest(self, place: Numbers, ahead: Numbers, angle: float) -> int | None:
        """The piece that a ray meets within an angle [rad]: the one seen nearest to it. None: no one."""
        nodes = np.zeros(1 if self._levels else 0, np.intp)
        for level in range(len(self._levels) - 1, -1, -1):
            facts = self._levels[level]
            nodes = nodes[nodes < len(facts.error)]
            away = facts.middle[nodes] - place
            along = away @ ahead
            across = np.linalg.norm(away - along[:, None] * ahead, axis=1)
            radius = facts.radius[nodes]
            nodes = nodes[across - radius <= (along + radius) * np.tan(angle) + 1e-12]
            if level:
                nodes = np.column_stack([2 * nodes, 2 * nodes + 1]).ravel()
        nodes = nodes[self._drawn[nodes]] if len(nodes) else nodes
        if not len(nodes):
            return None
        seen = _angles(place, ahead, self._points[nodes], self._points[nodes + 1])
        best = int(np.argmin(seen))
        return int(nodes[best]) if seen[best] <= angle else None


def _bounds(path: Polyline) -> tuple[Numbers, Numbers]:
    if not len(path.of):
        return np.zeros(3), np.zeros(3)
    return path.points.min(axis=0), path.points.max(axis=0)


def _up(values: Numbers) -> npt.NDArray[np.float32]:
    """In single precision, never less."""
    return np.nextafter(values.astype(np.float32), np.float32(np.inf))


def _distance(points: Numbers, a: Numbers, b: Numbers) -> Numbers:
    """Of points from segments."""
    way = b - a
    length = np.einsum("nk,nk->n", way, way)
    share = np.einsum("nk,nk->n", points - a, way)
    share = np.clip(np.divide(share, length, out=np.zeros_like(share), where=length > 0), 0.0, 1.0)
    return np.asarray(np.linalg.norm(points - a - share[:, None] * way, axis=1))


def _seen(
    camera: Camera, away: Numbers, distance: Numbers, radius: npt.NDArray[np.float32]
) -> npt.NDArray[np.bool_]:
    """Whether spheres reach into the cone of the picture."""
    along = away @ camera.ahead
    with np.errstate(invalid="ignore", divide="ignore"):
        angle = np.arccos(np.clip(along / distance, -1.0, 1.0))
        size = np.arcsin(np.clip(radius / distance, 0.0, 1.0))
    return np.asarray((distance <= radius) | (angle - size <= camera.cone))


def _angles(place: Numbers, ahead: Numbers, a: Numbers, b: Numbers) -> Numbers:
    """Under which angle from a ray the nearest points of segments are seen, by projection in front of it."""
    start, way = a - place, b - a
    # Nearest points of two lines; the ray has length 1.
    c, d, e = way @ ahead, np.einsum("nk,nk->n", way, start), start @ ahead
    square = np.einsum("nk,nk->n", way, way)
    wide = square - c * c
    share = np.clip(np.divide(c * e - d, wide, out=np.zeros_like(d), where=wide > 1e-15 * square), 0.0, 1.0)
    nearest = start + share[:, None] * way
    along = nearest @ ahead
    across = np.linalg.norm(nearest - along[:, None] * ahead, axis=1)
    return np.asarray(np.arctan2(across, along))
