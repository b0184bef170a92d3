"""Path objects to pieces of lines that lie within a tolerance of them."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, fields

import numpy as np
import numpy.typing as npt

from tappet.motion.paths.curve import (
    curvature,
    derivative,
    in_space,
    is_curved,
    is_round,
    spline_factors,
)
from tappet.motion.paths.geo_info import (
    ELLCLW,
    INITPOS,
    LINADDAXES,
    MCOMMAND,
    SPLINE,
    Numbers,
    Objects,
    places,
)

MOST_PIECES = 4096
"""Of one object."""
Z_BIT = 4
"""Of wSProfile."""


@dataclass(frozen=True, slots=True)
class Polyline:
    """A path as one row of points; `k` pieces lie between `k + 1` of them.

    Piece number `s` goes from point `s` to point `s + 1`. Pieces of an object follow each other; between
    objects that do not touch stands one that belongs to none.
    """

    points: Numbers
    """Rows of X, Y, Z, path units."""
    of: npt.NDArray[np.int32]
    """The number of the object of each piece, from 0; -1 of a gap, which is not drawn."""
    bend: npt.NDArray[np.float32]
    """Curvature in the middle of each piece [1/u]."""
    kind: npt.NDArray[np.int16]
    """SMC_MOVTYP, by object, as all that follow."""
    line: npt.NDArray[np.int32]
    """iSourceLine_No."""
    first: npt.NDArray[np.int32]
    """Its first piece; as many entries as objects and one."""
    velocity: npt.NDArray[np.float32]
    acceleration: npt.NDArray[np.float32]
    length: Numbers

    @property
    def count(self) -> int:
        """Of objects."""
        return len(self.kind)

    def points_of(self, number: int) -> Numbers:
        """Those of one object; its place alone if it does not move X, Y or Z."""
        begin, end = int(self.first[number]), int(self.first[number + 1])
        own = np.flatnonzero(self.of[begin:end] == number) + begin
        if not len(own):
            return self.points[begin : begin + 1]
        return self.points[own[0] : own[-1] + 2]


def pieces_needed(objects: Objects, tolerance: float) -> npt.NDArray[np.int64]:
    """How many pieces of equal parameter an object needs so that no point of it is further than `tolerance`
    times its size from them; the size is the half-axis of an arc or ellipse, else the way of a spline.

    A chord is at most h² max|c''| / 8 from its curve c, h being its part of the parameter.
    """
    bound, size = np.zeros(len(objects)), np.ones(len(objects))
    mask = is_round(objects)
    main = np.where(objects["iMoveType"] >= ELLCLW, objects["dP5"], objects["dP3"])
    bound[mask] = (np.abs(main) * np.radians(objects["dT2"]) ** 2)[mask]
    size[mask] = np.abs(main[mask])
    mask = objects["iMoveType"] == SPLINE
    if mask.any():
        splines = objects[mask]
        width = np.abs(splines["dT2"] - splines["dT1"])
        far = np.maximum(np.abs(splines["dT1"]), np.abs(splines["dT2"]))
        sizes = [np.linalg.norm(row, axis=1) for row in spline_factors(splines)]
        bound[mask] = width**2 * sum(n * (n - 1) * far ** (n - 2) * sizes[n] for n in range(2, 6))
        size[mask] = width * sum(n * far ** (n - 1) * sizes[n] for n in range(1, 6))
    share = np.divide(bound, size, out=np.zeros_like(bound), where=size > 0)
    share = np.nan_to_num(share, posinf=1e9)
    needed = np.ceil(np.sqrt(share / (8.0 * tolerance))).astype(np.int64)
    moved = ~np.isin(objects["iMoveType"], (INITPOS, MCOMMAND, LINADDAXES))
    return np.where(moved, np.clip(needed, 1, MOST_PIECES), 0)


def tolerance_for(objects: int) -> float:
    """A share of the size of an object: some 2000 pieces a circle in short programs, some 70 in long ones."""
    return float(np.clip(1e-9 * objects, 1e-6, 1e-3))


def polyline(parts: Iterable[Objects], tolerance: float) -> Polyline:
    """The objects of a path, which may come in parts. `tolerance`: see `pieces_needed`."""
    builder = _Builder(tolerance)
    for part in parts:
        builder.add(part)
    return builder.result()


class _Builder:
    """Keeps of objects what is drawn, so that a long path need not be in memory as a whole."""

    def __init__(self, tolerance: float) -> None:
        self._tolerance = tolerance
        self._parts: dict[str, list[npt.NDArray[np.generic]]] = {f.name: [] for f in fields(Polyline)}
        self._objects = 0
        self._pieces = 0
        self._end: Numbers | None = None

    def add(self, objects: Objects) -> None:
        if not len(objects):
            return
        counts = pieces_needed(objects, self._tolerance)
        start, end = places(objects["piStartPos"]), places(objects["piDestPos"])
        # Blind positioning has no start, and what does not move stays.
        still = counts == 0
        start[still] = end[still]
        before = np.vstack([start[:1] if self._end is None else self._end[None], end[:-1]])
        gap = np.any(np.abs(before - start) > 1e-9 * (1.0 + np.abs(start)), axis=1)
        all_counts = counts + gap
        owner = np.repeat(np.arange(len(objects)), all_counts)
        first = np.concatenate([[0], np.cumsum(all_counts)])
        step = np.arange(len(owner)) - first[owner] - gap[owner]  # -1 on a gap
        u = (step + 1) / np.maximum(counts[owner], 1)
        points = np.where((step < 0)[:, None], start[owner], end[owner])
        inner = (step >= 0) & (step + 1 < counts[owner])
        if inner.any():
            points[inner] = _inner(objects, owner[inner], u[inner])
            _lift(objects, owner, step, counts, points)
        bend = np.zeros(len(owner))
        curved = is_curved(objects)[owner] & (step >= 0)
        if curved.any():
            half = 0.5 / counts[owner[curved]]
            bend[curved] = curvature(objects[owner[curved]], u[curved] - half)
        if self._end is None:
            self._keep("points", start[:1])
        self._keep("points", points)
        self._keep("of", np.where(step < 0, -1, owner + self._objects).astype(np.int32))
        self._keep("bend", bend.astype(np.float32))
        self._keep("kind", objects["iMoveType"].copy())
        self._keep("line", objects["iSourceLine_No"].copy())
        self._keep("first", (first[:-1] + self._pieces).astype(np.int32))
        self._keep("velocity", objects["dVel"].astype(np.float32))
        self._keep("acceleration", objects["dAccel"].astype(np.float32))
        self._keep("length", objects["dLength"].copy())
        self._objects += len(objects)
        self._pieces += len(owner)
        self._end = end[-1]

    def _keep(self, name: str, values: npt.NDArray[np.generic]) -> None:
        self._parts[name].append(values)

    def result(self) -> Polyline:
        self._keep("first", np.array([self._pieces], dtype=np.int32))
        empty = Polyline(
            np.zeros((0, 3)),
            *(
                np.zeros(0, kind)
                for kind in (
                    np.int32,
                    np.float32,
                    np.int16,
                    np.int32,
                    np.int32,
                    np.float32,
                    np.float32,
                    float,
                )
            ),
        )
        found = {
            name: np.concatenate(parts) if parts else getattr(empty, name)
            for name, parts in self._parts.items()
        }
        return Polyline(**found)


def _inner(objects: Objects, owner: npt.NDArray[np.intp], u: Numbers) -> Numbers:
    return derivative(objects[owner], u, 0)


def _lift(
    objects: Objects,
    owner: npt.NDArray[np.intp],
    step: npt.NDArray[np.intp],
    counts: npt.NDArray[np.int64],
    points: Numbers,
) -> None:
    """Z of curves in 2D mode: an additional axis, by the share of the length (GEO-03), within `points`."""
    flat = (is_curved(objects) & ~in_space(objects))[owner] & (step >= 0)
    if not flat.any():
        return
    start, end = objects["piStartPos"], objects["piDestPos"]
    rows = np.flatnonzero(flat)
    begin = step[rows] == 0
    before = points[np.maximum(rows - 1, 0), :2]
    before[begin] = places(start)[owner[rows[begin]], :2]
    ways = np.cumsum(np.linalg.norm(points[rows, :2] - before, axis=1))
    last = step[rows] + 1 == counts[owner[rows]]
    bounds = np.concatenate([[0.0], ways[last]])
    group = np.cumsum(begin) - 1
    whole = np.diff(bounds)[group]
    share = np.divide(ways - bounds[group], whole, out=np.ones_like(ways), where=whole > 0)
    shaped = (objects["piDestPos"]["wSProfile"][owner[rows]] & Z_BIT) != 0
    share = np.where(shaped, share**3 * (10.0 + share * (6.0 * share - 15.0)), share)
    low, high = start["dZ"][owner[rows]], end["dZ"][owner[rows]]
    inner = ~last
    points[rows[inner], 2] = (low + share * (high - low))[inner]
