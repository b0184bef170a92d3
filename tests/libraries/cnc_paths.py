"""Path objects for tests of SM3_CNC, and their geometry by numpy and scipy: the reference."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from itertools import pairwise
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.integrate import quad

LIN, CLW, CCLW, SPLINE, ELLCLW, ELLCCLW = 1, 2, 3, 5, 8, 9
LINPOS, LINNODELTA, LINADDAXES, INITPOS, MCOMMAND = 100, 101, 102, 110, 120
AXES = ("dX", "dY", "dZ", "dA", "dB", "dC", "dA1", "dA2", "dA3", "dA4", "dA5", "dA6")
ALL_AXES = 0x7FF

Vector = NDArray[np.float64]


@dataclass
class Geo:
    """A path object: members of SMC_GEOINFO that differ from their default."""

    kind: int
    start: Vector
    end: Vector
    members: dict[str, float] = field(default_factory=dict)
    space: bool = False
    plane: tuple[Vector, Vector] = field(
        default_factory=lambda: (np.array([1.0, 0.0, 0.0]), np.array([0.0, 1.0, 0.0]))
    )

    def values(self) -> dict[str, Any]:
        """Members as they are written."""
        found: dict[str, Any] = {"iMoveType": self.kind, "b3D": self.space}
        for place, axes in (("piStartPos", self.start), ("piDestPos", self.end)):
            found |= {f"{place}.{name}": float(value) for name, value in zip(AXES, axes, strict=True)}
            found[f"{place}.wAuxData"] = ALL_AXES
        for name, vector in zip(("vX", "vY"), self.plane, strict=True):
            found |= {f"{name}.{axis}": float(value) for axis, value in zip(AXES[:3], vector, strict=True)}
        return found | self.members

    def member(self, name: str, default: float = 0.0) -> float:
        return float(self.members.get(name, default))

    def curve(self, u: float) -> Vector:
        """Place by angle, t or share; Z is 0 where it does not belong to the path."""
        m = self.member
        if self.kind in (CLW, CCLW, ELLCLW, ELLCCLW):
            along, across = self.plane
            phi = math.radians(m("dT1") - u * m("dT2", 1))
            if self.kind in (CLW, CCLW):
                first, second = m("dP3") * math.cos(phi), m("dP3") * math.sin(phi)
            else:
                turn = math.radians(m("dP7"))
                a, b = m("dP5") * math.cos(phi - turn), m("dP6") * math.sin(phi - turn)
                first, second = (
                    a * math.cos(turn) - b * math.sin(turn),
                    a * math.sin(turn) + b * math.cos(turn),
                )
            place: Vector = (m("dP1") + first) * along + (m("dP2") + second) * across
            if self.space:
                normal = np.cross(along, across)
                place = place + normal * (normal @ ((1 - u) * self.start[:3] + u * self.end[:3]))
        elif self.kind == SPLINE:
            t = m("dT1") + u * (m("dT2", 1) - m("dT1"))
            place = np.array(
                [
                    np.polyval([m("v5.dX"), m("v4.dX"), m("dP1"), m("dP2"), m("dP3"), m("dP4")], t),
                    np.polyval([m("v5.dY"), m("v4.dY"), m("dP5"), m("dP6"), m("dP7"), m("dP8")], t),
                    np.polyval([m("v5.dZ"), m("v4.dZ"), *(m(f"adZ[{n}]") for n in range(4))], t),
                ]
            )
        else:
            place = (1 - u) * self.start[:3] + u * self.end[:3]
        if not self.space and self.kind != LINNODELTA:
            place = np.array([place[0], place[1], 0.0])
        return place

    def slope(self, u: float) -> Vector:
        """Derivative of `curve` by central differences of high order: independent of formulas."""
        h = 1e-3
        steps = {1: 4 / 5, 2: -1 / 5, 3: 4 / 105, 4: -1 / 280}
        return (
            sum((c * (self.curve(u + k * h) - self.curve(u - k * h)) for k, c in steps.items()), np.zeros(3))
            / h
        )

    def length(self, end: float = 1.0) -> float:
        """By scipy.integrate.quad; of the way up to a parameter."""
        cuts = np.linspace(0.0, end, 9)
        return math.fsum(
            quad(lambda u: float(np.linalg.norm(self.slope(u))), a, b, epsabs=1e-12, epsrel=1e-12, limit=200)[
                0
            ]
            for a, b in pairwise(cuts)
        )


def position(x: float = 0.0, y: float = 0.0, z: float = 0.0, **axes: float) -> Vector:
    """A position; further axes by name, such as dA1."""
    found = np.zeros(12)
    found[:3] = x, y, z
    for name, value in axes.items():
        found[AXES.index(name)] = value
    return found


def line(start: Vector, end: Vector, kind: int = LIN, **members: float) -> Geo:
    return Geo(kind, start, end, members)


def arc(
    centre: tuple[float, float],
    radius: float,
    first: float,
    swept: float,
    further: Vector | None = None,
    **members: float,
) -> Geo:
    """An arc in X, Y; swept above 0 is clockwise. `further` are Z and the additional axes of the end."""
    ends = []
    for angle in (first, first - swept):
        place = position(
            centre[0] + radius * math.cos(math.radians(angle)),
            centre[1] + radius * math.sin(math.radians(angle)),
        )
        ends.append(place)
    if further is not None:
        ends[1][2:] = further[2:]
    given = {"dP1": centre[0], "dP2": centre[1], "dP3": radius, "dT1": first, "dT2": swept}
    return Geo(CLW if swept > 0 else CCLW, ends[0], ends[1], given | members)


def ellipse(
    centre: tuple[float, float],
    axes: tuple[float, float],
    turn: float,
    first: float,
    swept: float,
    **members: float,
) -> Geo:
    given = {
        "dP1": centre[0],
        "dP2": centre[1],
        "dP3": axes[0] * math.cos(math.radians(turn)),
        "dP4": axes[0] * math.sin(math.radians(turn)),
        "dP5": axes[0],
        "dP6": axes[1],
        "dP7": turn,
        "dP8": axes[1] / axes[0],
        "dT1": first,
        "dT2": swept,
    }
    found = Geo(ELLCLW if swept > 0 else ELLCCLW, position(), position(), given | members)
    found.start[:2] = found.curve(0.0)[:2]
    found.end[:2] = found.curve(1.0)[:2]
    return found


def spline(x: list[float], y: list[float], z: list[float] | None = None, **members: float) -> Geo:
    """By coefficients, the highest first: four, or six of a quintic."""
    given: dict[str, float] = {}
    for letter, coefficients, names in (
        ("X", x, ("dP1", "dP2", "dP3", "dP4")),
        ("Y", y, ("dP5", "dP6", "dP7", "dP8")),
        ("Z", z or [0.0] * 4, tuple(f"adZ[{n}]" for n in range(4))),
    ):
        padded = [0.0] * (6 - len(coefficients)) + coefficients
        given |= {f"v5.d{letter}": padded[0], f"v4.d{letter}": padded[1]}
        given |= dict(zip(names, padded[2:], strict=True))
    found = Geo(SPLINE, position(), position(), given | members, space=z is not None)
    found.start[:3] = found.curve(0.0)
    found.end[:3] = found.curve(1.0)
    return found


def path(pieces: list[tuple[float, ...]], **members: Any) -> list[Geo]:
    """A path in X, Y of lines (turn, length), arcs (turn, radius, swept), ellipses (turn, a, b, swept).

    An ellipse begins at a tip of its main axis; `turn` is the angle of the
    corner in front [deg]; swept above 0 is clockwise.
    """
    found: list[Geo] = []
    here, heading = np.zeros(2), 0.0
    for piece in pieces:
        heading += piece[0]
        sign = 1.0 if len(piece) == 2 or piece[-1] > 0 else -1.0
        ahead = np.array([math.cos(math.radians(heading)), math.sin(math.radians(heading))])
        left = np.array([-ahead[1], ahead[0]])
        if len(piece) == 2:
            there = here + piece[1] * ahead
            found.append(line(position(*here), position(*there), **members))
        elif len(piece) == 3:
            centre = here - sign * piece[1] * left
            first = heading + sign * 90
            found.append(arc((centre[0], centre[1]), piece[1], first, piece[2], **members))
            heading -= piece[2]
        else:
            centre = here - sign * piece[1] * left
            first = heading + sign * 90
            found.append(
                ellipse((centre[0], centre[1]), (piece[1], piece[2]), first, first, piece[3], **members)
            )
            slope = found[-1].slope(1.0)
            heading = math.degrees(math.atan2(slope[1], slope[0]))
        found[-1].start[:2] = here
        here = found[-1].end[:2]
    return found
