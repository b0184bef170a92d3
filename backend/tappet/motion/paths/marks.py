"""Switch points on a path (GEO-16)."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from tappet.motion.paths.geo_info import MCOMMAND, Numbers, Objects
from tappet.motion.paths.polyline import Polyline


@dataclass(frozen=True, slots=True)
class Switches:
    """Where switches act."""

    place: Numbers
    """Rows of X, Y, Z."""
    number: npt.NDArray[np.int16]
    """H; below 0 it switches off."""
    line: npt.NDArray[np.int32]
    """iSourceLine_No."""


def switches_of(parts: Iterable[Objects], path: Polyline, most: int = 400) -> Switches:
    """The first switch points of a path, which `path` is drawn of: by the length of its pieces."""
    places: list[Numbers] = []
    numbers: list[int] = []
    lines: list[int] = []
    first = 0
    for objects in parts:
        rows, columns = np.nonzero((objects["iHelpID"] != 0) & (objects["iMoveType"] != MCOMMAND)[:, None])
        for row, column in zip(rows, columns, strict=True):
            if len(places) >= most:
                break
            places.append(_at(path.points_of(first + int(row)), float(objects["dHelpPos"][row, column])))
            numbers.append(int(objects["iHelpID"][row, column]))
            lines.append(int(objects["iSourceLine_No"][row]))
        first += len(objects)
    return Switches(np.array(places).reshape(-1, 3), np.array(numbers, np.int16), np.array(lines, np.int32))


def _at(points: Numbers, share: float) -> Numbers:
    """The point behind a share of the length of a row of points."""
    ways = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(points, axis=0), axis=1))])
    return np.array([np.interp(share * ways[-1], ways, points[:, n]) for n in range(3)])
