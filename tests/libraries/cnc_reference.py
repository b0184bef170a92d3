"""An interpreter of G-code on its own: what path a program describes, by the rules of cnc.md 8 and 10.

A program is built command by command; each writes its line and says which piece of path it is to give.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field

import numpy as np
from scipy.integrate import quad
from scipy.interpolate import CubicHermiteSpline

AXES = "XYZABCPQUVW"
Vector = np.ndarray
Curve = Callable[[float], Vector]


@dataclass
class Piece:
    """A piece of path: its ends (11 axes) and its curve in space."""

    kind: str
    start: Vector
    dest: Vector
    space: bool
    curve: Curve
    """Place by u from 0 to 1."""
    slope: Curve
    """Derivative by u."""
    spline: bool = False
    stops: bool = False
    """The path stops in front of it and behind it; no tangent."""
    breaks: bool = False
    """A repeated position stands in front."""

    def visible(self, vector: Vector) -> Vector:
        """Without Z where that is an additional axis."""
        return vector if self.space else vector * np.array([1.0, 1.0, 0.0])

    @property
    def length(self) -> float:
        if self.kind == "LINADDAXES":
            return float(np.linalg.norm((self.dest - self.start)[3:]))
        if self.kind == "LINNODELTA":
            return abs(float(self.dest[2] - self.start[2]))
        value, _ = quad(
            lambda u: float(np.linalg.norm(self.visible(self.slope(u)))),
            0,
            1,
            epsabs=1e-10,
            epsrel=1e-10,
            limit=200,
        )
        return float(value)

    def direction(self, u: float) -> Vector:
        """Unit tangent; 0 where the piece does not move in space."""
        if self.stops or self.kind == "LINADDAXES":
            return np.zeros(3)
        slope = self.slope(u) if self.kind == "LINNODELTA" else self.visible(self.slope(u))
        size = np.linalg.norm(slope)
        return slope / size if size > 0 else np.zeros(3)


def _straight(start: Vector, dest: Vector) -> tuple[Curve, Curve]:
    return lambda u: start[:3] + u * (dest - start)[:3], lambda u: (dest - start)[:3]


@dataclass
class Reference:
    """The state of a program, its text and the pieces of its path."""

    lines: list[str] = field(default_factory=list)
    pieces: list[Piece] = field(default_factory=list)
    position: Vector = field(default_factory=lambda: np.zeros(11))
    shift: Vector = field(default_factory=lambda: np.zeros(11))
    relative: bool = False
    absolute_centre: bool = False
    space: bool = False
    plane: tuple[Vector, Vector] = (np.array([1.0, 0, 0]), np.array([0, 1.0, 0]))
    breaks: bool = False

    def mode(self, number: int) -> None:
        self.lines.append(f"G{number}")
        if number in (90, 91):
            self.relative = number == 91
        elif number in (98, 99):
            self.absolute_centre = number == 98
        else:
            self.space = number != 15
            first = {15: 0, 17: 0, 18: 2, 19: 1}[number]
            self.plane = (np.eye(3)[first], np.eye(3)[(first + 1) % 3])

    def normal(self, i: float, j: float, k: float) -> None:
        """G16: the first coordinate is the projection of the axis behind the largest part of the normal."""
        self.lines.append(f"G16 I{i!r} J{j!r} K{k!r}")
        n = np.array([i, j, k]) / np.linalg.norm([i, j, k])
        largest = max((2, 1, 0), key=lambda axis: abs(n[axis]))
        near = np.eye(3)[(largest + 1) % 3]
        u = near - (near @ n) * n
        self.space, self.plane = True, (u / np.linalg.norm(u), np.cross(n, u / np.linalg.norm(u)))

    def shifted(self, number: int, values: Mapping[str, float]) -> None:
        self.lines.append(f"G{number} " + " ".join(f"{axis}{value!r}" for axis, value in values.items()))
        for axis, value in values.items():
            at = AXES.index(axis)
            base = {54: 0.0, 55: self.shift[at], 56: self.position[at] - 2 * value}[number]
            self.shift[at] = base + value
        if number == 53:
            self.shift = np.zeros(11)

    def function(self) -> None:
        self.lines.append("M3")
        nothing = _straight(self.position, self.position)
        self._add(Piece("MCOMMAND", self.position, self.position, self.space, *nothing, stops=True))

    def go(self, number: int, values: Mapping[str, float]) -> None:
        """G0, G1, G5, G10."""
        dest = self._target(values)
        self.lines.append(f"G{number} {self._words(values)}")
        moved = dest != self.position
        space = self.space or number == 10
        if not moved.any():
            self.breaks = True
            return
        kind = "LINNODELTA" if moved[2] else "LINADDAXES"
        if moved[:2].any() or (space and moved[2]):
            kind = "LIN"
        if number == 0:
            space = space or kind == "LINNODELTA"
            kind = "LINADDAXES" if kind == "LINADDAXES" else "LINPOS"
        straight = _straight(self.position, dest)
        piece = Piece(kind, self.position, dest, space, *straight, stops=number == 0)
        if number in (5, 10) and kind == "LIN":
            piece.kind, piece.spline = "SPLINE", True
        self._add(piece)

    def arc_of_radius(self, number: int, values: Mapping[str, float], radius: float) -> None:
        dest = self._target(values)
        self.lines.append(f"G{number} {self._words(values)} R{radius!r}")
        x, y = self.plane
        a, b = (np.array([p[:3] @ x, p[:3] @ y]) for p in (self.position, dest))
        chord = np.linalg.norm(b - a)
        if chord == 0 or chord > 2 * radius:
            self.lines.pop()
            self.go(1, values)
            self.lines[-1] = f"G{number} {self._words_of(values)} R{radius!r}"
            return
        left = np.array([-(b - a)[1], (b - a)[0]]) / chord
        height = np.sqrt(radius**2 - chord**2 / 4)
        centre = (a + b) / 2 + left * height * (1 if number == 3 else -1)
        self._arc(number, dest, centre, None)

    def arc_of_centre(
        self, number: int, centre: tuple[float, float], angle: float, third: float, by_angle: bool
    ) -> None:
        """A centre from the start, in the plane, and the angle up to the end; more than a turn `by_angle`."""
        x, y = self.plane
        a = np.array([self.position[:3] @ x, self.position[:3] @ y])
        middle = a + np.array(centre)
        sign = 1.0 if number == 3 else -1.0
        turn = np.radians(angle) * sign
        rotation = np.array([[np.cos(turn), -np.sin(turn)], [np.sin(turn), np.cos(turn)]])
        b = middle + rotation @ (a - middle)
        dest = self.position.copy()
        dest[:3] += (b - a)[0] * x + (b - a)[1] * y + third * np.cross(x, y)
        offset = centre[0] * x + centre[1] * y
        if self.absolute_centre:
            offset = offset + (self.position - self.shift)[:3]
        words = " ".join(f"{letter}{value!r}" for letter, value in zip("IJK", offset.tolist(), strict=True))
        if not self.space:
            words = words[: words.index(" K")]
        if by_angle:
            change = dict(zip("XYZ", (third * np.cross(x, y)).tolist(), strict=True)) if third else {}
            target = self.position.copy()
            for axis, value in change.items():
                target[AXES.index(axis)] += value
            values = {axis: self._word(axis, target) for axis, value in change.items() if value}
            self.lines.append(f"G{number} {self._words_of(values)} {words} T{angle!r}")
            self._arc(number, dest, middle, angle)
            return
        values = {axis: self._word(axis, dest) for axis in "XYZ"}
        dest = self._target(values)
        self.lines.append(f"G{number} {self._words_of(values)} {words}")
        self._arc(number, dest, middle, None)

    def ellipse(
        self, number: int, half: tuple[float, float], turn: float, first: float, sweep: float
    ) -> None:
        """Through a start and an end at parameters `first` and `first` minus or plus `sweep`, in degrees."""
        a, b = half
        e1 = np.array([np.cos(np.radians(turn)), np.sin(np.radians(turn))])
        e2 = np.array([-e1[1], e1[0]])

        def place(parameter: float) -> Vector:
            return a * np.cos(parameter) * e1 + b * np.sin(parameter) * e2

        sign = 1.0 if number == 9 else -1.0
        begin, end = np.radians(first), np.radians(first + sign * sweep)
        centre = self.position[:2] - place(begin)
        dest = self.position.copy()
        dest[:2] = centre + place(end)
        values = {axis: self._word(axis, dest) for axis in "XY"}
        offset = centre - (self.shift[:2] if self.absolute_centre else self.position[:2])
        words = f"I{offset[0].item()!r} J{offset[1].item()!r} K{turn!r} R{b / a!r}"
        self.lines.append(f"G{number} {self._words_of(values)} {words}")
        dest = self._target(values)
        start = self.position

        def curve(u: float) -> Vector:
            xy = centre + place(begin + u * (end - begin))
            return np.array([*xy, start[2] + u * (dest - start)[2]])

        def slope(u: float) -> Vector:
            parameter = begin + u * (end - begin)
            xy = (-a * np.sin(parameter) * e1 + b * np.cos(parameter) * e2) * (end - begin)
            return np.array([*xy, (dest - start)[2]])

        self._add(Piece("ELLCLW" if number == 8 else "ELLCCLW", start, dest, False, curve, slope))

    def parabola(self, values: Mapping[str, float], vertex: tuple[float, float]) -> None:
        """`vertex` from the start."""
        dest = self._target(values)
        start = self.position
        offset = np.array(vertex) + ((self.position - self.shift)[:2] if self.absolute_centre else 0.0)
        line = f"G6 {self._words_of(values)} I{offset[0].item()!r} J{offset[1].item()!r}"
        if (dest[:2] == start[:2]).all():
            self.go(1, values)
            self.lines[-1] = line
            return
        self.lines.append(line)
        top = np.array([*(start[:2] + np.array(vertex)), (start + dest)[2] / 2])
        control = 2 * top - (start + dest)[:3] / 2

        def curve(u: float) -> Vector:
            return np.asarray((1 - u) ** 2 * start[:3] + 2 * u * (1 - u) * control + u**2 * dest[:3])

        def slope(u: float) -> Vector:
            return np.asarray(2 * (1 - u) * (control - start[:3]) + 2 * u * (dest[:3] - control))

        self._add(Piece("SPLINE", start, dest, False, curve, slope))

    def path(self) -> list[Piece]:
        """All pieces; cardinal splines have their shape."""
        pieces = self.pieces
        joined = [
            n > 0 and piece.spline and pieces[n - 1].spline and not piece.breaks
            for n, piece in enumerate(pieces)
        ]
        joined.append(False)
        for n, piece in enumerate(pieces):
            if not piece.spline:
                continue
            chord = piece.visible((piece.dest - piece.start)[:3])
            ends = []
            for u, neighbour in ((0.0, n - 1), (1.0, n + 1)):
                inner = joined[n] if u == 0 else joined[n + 1]
                other = pieces[neighbour] if 0 <= neighbour < len(pieces) else None
                cut = (piece if u == 0 else other).breaks if other is not None else True
                tangent = chord
                if inner and other is not None:
                    tangent = (
                        (piece.dest - other.start)[:3] / 2 if u == 0 else (other.dest - piece.start)[:3] / 2
                    )
                elif other is not None and not other.spline and not cut:
                    toward = piece.visible(other.direction(1.0 - u))
                    size = np.linalg.norm(toward)
                    if size > 0:
                        tangent = np.linalg.norm(chord) * toward / size
                ends.append(tangent)
            spline = CubicHermiteSpline([0, 1], [piece.start[:3], piece.dest[:3]], ends)
            piece.curve, piece.slope = spline, spline.derivative()
        return pieces

    def _arc(self, number: int, dest: Vector, centre: Vector, angle: float | None) -> None:
        x, y = self.plane
        n = np.cross(x, y)
        start = self.position
        a, b = (np.array([p[:3] @ x, p[:3] @ y]) - centre for p in (start, dest))
        sign = 1.0 if number == 3 else -1.0
        begin = np.arctan2(a[1], a[0])
        if angle is None:
            sweep = sign * (np.arctan2(b[1], b[0]) - begin) % (2 * np.pi)
            if np.linalg.norm(b - a) < 1e-9 * np.linalg.norm(a):
                sweep = 2 * np.pi
        else:
            sweep = np.radians(angle)
        radius = np.linalg.norm(a)

        def curve(u: float) -> Vector:
            phi = begin + sign * u * sweep
            u_v = centre + radius * np.array([np.cos(phi), np.sin(phi)])
            return np.asarray(u_v[0] * x + u_v[1] * y + n * ((start + u * (dest - start))[:3] @ n))

        def slope(u: float) -> Vector:
            phi = begin + sign * u * sweep
            u_v = radius * sign * sweep * np.array([-np.sin(phi), np.cos(phi)])
            return np.asarray(u_v[0] * x + u_v[1] * y + n * ((dest - start)[:3] @ n))

        self._add(Piece("CLW" if number == 2 else "CCLW", start, dest, self.space, curve, slope))

    def _add(self, piece: Piece) -> None:
        piece.breaks = self.breaks
        self.breaks = False
        self.pieces.append(piece)
        self.position = piece.dest

    def _target(self, values: Mapping[str, float]) -> Vector:
        dest = self.position.copy()
        for axis, value in values.items():
            at = AXES.index(axis)
            dest[at] = (dest[at] if self.relative else self.shift[at]) + value
        return dest

    def _word(self, axis: str, dest: Vector) -> float:
        at = AXES.index(axis)
        return float(dest[at] - (self.position[at] if self.relative else self.shift[at]))

    @staticmethod
    def _words_of(values: Mapping[str, float]) -> str:
        return " ".join(f"{axis}{value!r}" for axis, value in values.items())

    _words = _words_of
