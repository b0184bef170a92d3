"""Polynomials of fifth degree as they stand in cam files and running cams, and the points of the editor."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import pairwise

from tappet.project.cams.laws import values_in
from tappet.project.cams.table import NARROWEST, CamPoint, CamSegment, Law, number_text
from tappet.project.cams.texts import CamTextError, number_in

_EQUAL = 1e-9
"""States of a point on both sides that differ by less than this part are the same."""
Rows = Sequence[tuple[int, Sequence[float]]]
"""Numbers with the line that they stand in, or the number of their element."""


@dataclass(frozen=True, slots=True)
class Piece:
    """A polynomial of fifth degree between two points."""

    left: CamPoint
    right: CamPoint
    line: int
    """Where it stands in the text, or the number of its element."""
    law: Law = "poly5"

    @property
    def width(self) -> float:
        """Of the master."""
        return self.right.x - self.left.x

    def is_(self, law: Law) -> bool:
        """Whether a simpler law gives the same curve."""
        simple = CamSegment(law=law)
        ends = [values_in(self.left, simple, self.right, at.x) for at in (self.left, self.right)]
        states = (self.left, self.right)
        return all(
            _same_v(found.v, state.v, self) and _same_a(found.a, state.a, self)
            for found, state in zip(ends, states, strict=True)
        )


def joined(rows: Rows) -> list[Piece]:
    """Pieces between points; a point may stand twice, where the curve bends."""
    points = [(line, CamPoint(**dict(zip("xyva", row, strict=True)))) for line, row in rows]
    found = []
    for (start, left), (line, right) in pairwise(points):
        if right.x == left.x:
            if abs(right.y - left.y) > _EQUAL * max(abs(right.y), abs(left.y)):
                raise CamTextError(line, f"the position jumps at X = {number_text(right.x)}")
        elif not right.x - left.x >= NARROWEST:
            raise CamTextError(line, f"{number_text(right.x)} does not lie behind {number_text(left.x)}")
        else:
            found.append(Piece(left, right, start))
    return found


def of_polynomials(rows: Rows, last: float) -> list[Piece]:
    """Pieces with the states at the ends of polynomials by the distance from where they start."""
    found: list[Piece] = []
    ends = [row[0] for _, row in rows[1:]] + [last]
    for (line, (start, *powers)), end in zip(rows, ends, strict=True):
        if not end - start >= NARROWEST:
            raise CamTextError(line, f"{number_text(end)} does not lie behind {number_text(start)}")
        left, right = (_state(line, powers, start, x) for x in (start, end))
        if found and abs(found[-1].right.y - left.y) > _EQUAL * max(
            abs(left.y), abs(right.y), abs(found[-1].left.y)
        ):
            raise CamTextError(line, f"the position jumps at X = {number_text(start)}")
        found.append(Piece(left, right, line))
    return found


def _state(line: int, powers: list[float], start: float, x: float) -> CamPoint:
    values = []
    for _ in range(3):
        value = 0.0
        for factor in reversed(powers):
            value = value * (x - start) + factor
        values.append(number_in(repr(value), line))
        powers = [n * factor for n, factor in enumerate(powers)][1:]
    return CamPoint(x=x, y=values[0], v=values[1], a=values[2])


def _same_v(one: float, other: float, *pieces: Piece) -> bool:
    return abs(one - other) <= _EQUAL * max(_velocity(piece) for piece in pieces)


def _same_a(one: float, other: float, *pieces: Piece) -> bool:
    """Rounding of positions and velocities shows in it, too."""
    sizes = [max(abs(p.left.a), abs(p.right.a), _velocity(p) / p.width) for p in pieces]
    return abs(one - other) <= _EQUAL * max(sizes)


def _velocity(piece: Piece) -> float:
    rise = max(abs(piece.left.y), abs(piece.right.y)) / piece.width
    return max(abs(piece.left.v), abs(piece.right.v), rise)


def points_of(pieces: list[Piece]) -> tuple[tuple[CamPoint, ...], tuple[CamSegment, ...]]:
    """Points with one state each: where the curve bends, a simpler law beside it needs none."""
    points = [pieces[0].left]
    for number in range(1, len(pieces)):
        before, behind = pieces[number - 1], pieces[number]
        left, right = before.right, behind.left
        slope = _same_v(left.v, right.v, before, behind)
        if slope and _same_a(left.a, right.a, before, behind):
            points.append(right)
            continue
        if before.law == "line" or before.is_("line"):
            pieces[number - 1] = replace(before, law="line")
            points.append(right)
        elif behind.is_("line"):
            pieces[number] = replace(behind, law="line")
            points.append(left)
        elif slope and (before.law == "poly3" or before.is_("poly3")):
            pieces[number - 1] = replace(before, law="poly3")
            points.append(right)
        elif slope and behind.is_("poly3"):
            pieces[number] = replace(behind, law="poly3")
            points.append(left)
        else:
            what = "acceleration" if slope else "velocity"
            raise CamTextError(
                behind.line,
                f"the {what} jumps at X = {number_text(right.x)} between two polynomials; a point of the "
                "editor has one value of it",
            )
    points.append(pieces[-1].right)
    return tuple(points), tuple(CamSegment(law=piece.law) for piece in pieces)
