"""Places on path objects, all at once, by the formulas of cnc.md 10 (GEO-04 to GEO-13).

The parameter of an object is 0 at its start and 1 at its end: the share of a line, of the angle of an arc or
ellipse, of t of a spline. Compiled code walks by length (`CurveAt` of SM3_CNC); the points are the same.
"""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from tappet.motion.paths.geo_info import (
    CCLW,
    CLW,
    ELLCCLW,
    ELLCLW,
    LINNODELTA,
    SPLINE,
    Numbers,
    Objects,
    places,
)

Mask = npt.NDArray[np.bool_]


def is_round(objects: Objects) -> Mask:
    """Arcs and ellipses."""
    return np.asarray(np.isin(objects["iMoveType"], (CLW, CCLW, ELLCLW, ELLCCLW)))


def is_curved(objects: Objects) -> Mask:
    """Not a line."""
    return np.asarray(is_round(objects) | (objects["iMoveType"] == SPLINE))


def in_space(objects: Objects) -> Mask:
    """Z belongs to the path and its length; else it is an additional axis (GEO-02)."""
    return np.asarray(objects["b3D"] | (objects["iMoveType"] == LINNODELTA))


def derivative(objects: Objects, u: Numbers, order: int) -> Numbers:
    """Place (`order` 0) or derivative by u of each object at its own u, in rows of X, Y, Z.

    Where Z does not belong to the path it is 0, in the place too: see `polyline` for its height.
    """
    found = np.zeros((len(objects), 3))
    for mask, formula in (
        (is_round(objects), _round),
        (objects["iMoveType"] == SPLINE, _spline),
        (~is_curved(objects), _line),
    ):
        if mask.any():
            found[mask] = formula(objects[mask], u[mask], order)
    found[~in_space(objects), 2] = 0.0
    return found


def curvature(objects: Objects, u: Numbers) -> Numbers:
    """[1/u], 0 of lines and where an object stands still."""
    first, second = derivative(objects, u, 1), derivative(objects, u, 2)
    speed = np.linalg.norm(first, axis=1)
    across = np.linalg.norm(np.cross(first, second), axis=1)
    return np.asarray(np.divide(across, speed**3, out=np.zeros_like(across), where=speed > 0))


def _line(objects: Objects, u: Numbers, order: int) -> Numbers:
    start, end = places(objects["piStartPos"]), places(objects["piDestPos"])
    if order == 0:
        return start + u[:, None] * (end - start)
    return end - start if order == 1 else np.zeros_like(start)


def _round(objects: Objects, u: Numbers, order: int) -> Numbers:
    ellipse = objects["iMoveType"] >= ELLCLW
    main = np.where(ellipse, objects["dP5"], objects["dP3"])
    minor = np.where(ellipse, objects["dP6"], objects["dP3"])
    turn = np.where(ellipse, np.radians(objects["dP7"]), 0.0)
    rate = -np.radians(objects["dT2"])
    # The n-th derivative of a cosine is one a quarter further on.
    angle = np.radians(objects["dT1"]) + u * rate - turn + order * np.pi / 2
    along, across = main * np.cos(angle) * rate**order, minor * np.sin(angle) * rate**order
    x = along * np.cos(turn) - across * np.sin(turn)
    y = along * np.sin(turn) + across * np.cos(turn)
    if order == 0:
        x, y = x + objects["dP1"], y + objects["dP2"]
    right, up = places(objects["vX"]), places(objects["vY"])
    found = x[:, None] * right + y[:, None] * up
    if order < 2:
        normal = np.cross(right, up)
        low = np.einsum("nk,nk->n", normal, places(objects["piStartPos"]))
        rise = np.einsum("nk,nk->n", normal, places(objects["piDestPos"])) - low
        height = np.where(in_space(objects), low + u * rise if order == 0 else rise, 0.0)
        found += height[:, None] * normal
    return np.asarray(found)


def _spline(objects: Objects, u: Numbers, order: int) -> Numbers:
    width = objects["dT2"] - objects["dT1"]
    t = objects["dT1"] + u * width
    found = np.zeros((len(objects), 3))
    for power, factors in enumerate(spline_factors(objects)):
        if power < order:
            continue
        fall = float(np.prod(np.arange(power - order + 1, power + 1)))
        found += (fall * t ** (power - order))[:, None] * factors
    return np.asarray(found * (width**order)[:, None])


def spline_factors(objects: Objects) -> list[Numbers]:
    """Of the powers of t from 0 to 5, rows of X, Y, Z."""
    letters = ((4, 3, 2, 1), (8, 7, 6, 5))
    low = [
        np.column_stack([*(objects[f"dP{row[power]}"] for row in letters), objects["adZ"][:, 3 - power]])
        for power in range(4)
    ]
    return [*low, places(objects["v4"]), places(objects["v5"])]
