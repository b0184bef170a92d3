"""Colours of the pieces of a path: by what moves there, or by a value (cnc.md CNC-53)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from tappet.motion.paths.colouring import Colouring
from tappet.motion.paths.geo_info import (
    CCLW,
    CLW,
    ELLCCLW,
    ELLCLW,
    LINPOS,
    SPLINE,
    Numbers,
)
from tappet.motion.paths.polyline import Polyline

Rgb = tuple[int, int, int]
Colours = npt.NDArray[np.uint8]


@dataclass(frozen=True, slots=True)
class Theme:
    """Colours of a picture."""

    rapid: Rgb
    feed: Rgb
    arc: Rgb
    faint: Rgb
    """Of the path as it was programmed, behind the preprocessed one."""
    grid: Rgb
    section: Rgb


LIGHT = Theme((22, 132, 70), (26, 28, 32), (20, 90, 190), (176, 180, 186), (222, 225, 229), (196, 200, 206))
DARK = Theme((76, 201, 122), (232, 235, 239), (120, 178, 255), (96, 101, 109), (52, 56, 62), (76, 81, 88))
SCALE: tuple[Rgb, ...] = (
    (60, 70, 190), (45, 125, 215), (40, 170, 160), (105, 185, 80), (215, 175, 40), (230, 120, 40),
    (205, 50, 60),
)  # fmt: skip
"""From the least value to the greatest one; readable on a light and on a dark ground."""
_CURVES = (CLW, CCLW, ELLCLW, ELLCCLW, SPLINE)


@dataclass(frozen=True, slots=True)
class Legend:
    """What the ends of the scale stand for."""

    low: float
    high: float


def by_kind(path: Polyline, theme: Theme) -> Colours:
    """A colour for each piece: positioning, lines, curves."""
    table = np.full((256, 3), theme.feed, np.uint8)
    table[LINPOS] = theme.rapid
    table[list(_CURVES)] = theme.arc
    return np.asarray(table[path.kind[path.of] & 0xFF]) if path.count else np.zeros((0, 3), np.uint8)


def by_value(path: Polyline, values: npt.NDArray[np.floating]) -> tuple[Colours, Legend]:
    """A colour for each piece by its value; those without one, NaN, have the lowest colour."""
    known = values[(path.of >= 0) & np.isfinite(values)]
    low, high = (float(known.min()), float(known.max())) if len(known) else (0.0, 0.0)
    share = np.zeros(len(values)) if high <= low else np.clip((values - low) / (high - low), 0.0, 1.0)
    place = np.nan_to_num(share) * (len(SCALE) - 1)
    stops = np.arange(len(SCALE))
    channels = [np.interp(place, stops, [stop[n] for stop in SCALE]) for n in range(3)]
    return np.column_stack(channels).round().astype(np.uint8), Legend(low, high)


def programmed(path: Polyline, colouring: Colouring) -> Numbers:
    """The value of each piece as it is in the objects."""
    if colouring == "curvature":
        return path.bend.astype(float)
    per_object = path.velocity if colouring == "velocity" else path.acceleration
    return np.asarray(per_object[path.of].astype(float)) if path.count else np.zeros(0)


def moved(path: Polyline, places: Numbers, values: Numbers) -> Numbers:
    """The value of each piece by samples of a motion along the path, in their order.

    `places`: rows of X, Y, Z; `values`: one for each. Path and motion are laid over each other by the share
    of their lengths, which differ by the chords between samples only.
    """
    if len(places) < 2 or not path.count:
        return np.full(len(path.of), np.nan)
    lengths = np.where(path.of >= 0, np.linalg.norm(np.diff(path.points, axis=0), axis=1), 0.0)
    middle = np.cumsum(lengths) - lengths / 2
    way = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(places, axis=0), axis=1))])
    whole, walked = float(lengths.sum()), float(way[-1])
    if whole == 0.0 or walked == 0.0:
        return np.full(len(path.of), np.nan)
    return np.asarray(np.interp(middle / whole, way / walked, values))
