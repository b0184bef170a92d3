"""What is wrong with a cam: continuity, periodicity and its compile format (CAM-03, CAM-04, CAM-45, CAM-74).

Each finding has the position of the master that it is about; the editor shows it while a cam is edited, a
build says it with the object.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from tappet.project.cams.laws import Values, values_in
from tappet.project.cams.table import CamTable, number_text

Derivative = Literal["position", "velocity", "acceleration", "jerk"]
TOLERANCE = 1e-6
"""A jump is one that is more than this part of the largest value; what people type has seven digits."""
DERIVATIVES: tuple[Derivative, ...] = ("position", "velocity", "acceleration", "jerk")
POLYNOMIAL_LAWS = frozenset(("line", "poly3", "poly5"))
"""Those that a polynomial of fifth degree between two points can be."""
LIBRARY_TABLES = (128, 256)
"""Sizes of the types of tables of SM3_Basic."""


@dataclass(frozen=True, slots=True)
class Finding:
    """Something wrong at a position of the master."""

    kind: Literal["jump", "period", "end", "law"]
    """A derivative jumps between two segments, or between end and start; the end is elsewhere than the start;
    a law that the compile format does not have."""
    x: float
    derivative: Derivative = "position"
    before: float = 0.0
    """The value left of the place, or at the end of a period."""
    behind: float = 0.0
    """The value right of it, or at the start."""
    law: str = ""
    period: float = 0.0

    @property
    def severity(self) -> Literal["error", "warning"]:
        """Whether the cam cannot be used so."""
        return "warning" if self.kind in ("jump", "period") else "error"

    @property
    def text(self) -> str:
        """In English."""
        what = self.derivative
        before, behind, x = _short(self.before), _short(self.behind), number_text(self.x)
        if self.kind == "jump":
            return f"The {what} jumps from {before} to {behind} at X = {x}"
        if self.kind == "period":
            return (
                f"The cam is periodic, and the {what} jumps from {before} at its end to {behind} at its start"
            )
        if self.kind == "end":
            return (
                f"The cam is periodic, and its end at Y = {before} is not the start at Y = {behind} up to "
                f"periods of {number_text(self.period)}"
            )
        return (
            f"The segment behind X = {x} is of the type {self.law}, which the compile format of polynomials "
            "does not have; choose the format of segments"
        )


def law_name(law: str) -> str:
    """The law as SMC_CAM_SEGMENT_TYPE calls it."""
    return "".join(word.capitalize() for word in law.split("_"))


def findings(cam: CamTable) -> list[Finding]:
    """All there is to say of a cam, in order of the master."""
    ends = [
        (values_in(left, segment, right, left.x), values_in(left, segment, right, right.x))
        for left, segment, right in cam.pieces()
    ]
    found = _jumps(cam, ends) + _period(cam, ends) + _format(cam)
    return sorted(found, key=lambda one: one.x)


def _checked(cam: CamTable) -> list[tuple[int, Derivative]]:
    wanted = {
        "position": True,
        "velocity": cam.checks.velocity,
        "acceleration": cam.checks.acceleration,
        "jerk": cam.checks.jerk,
    }
    return [(order, name) for order, name in enumerate(DERIVATIVES) if wanted[name]]


def _sizes(ends: list[tuple[Values, Values]]) -> list[float]:
    """The largest value of each derivative at the ends of segments."""
    return [max(abs(one[order]) for both in ends for one in both) for order in range(4)]


def _jumps(cam: CamTable, ends: list[tuple[Values, Values]]) -> list[Finding]:
    sizes = _sizes(ends)
    found = []
    for number in range(1, len(ends)):
        before, behind = ends[number - 1][1], ends[number][0]
        at = cam.points[number].x
        found += [
            Finding("jump", at, name, before[order], behind[order])
            for order, name in _checked(cam)
            if abs(before[order] - behind[order]) > TOLERANCE * sizes[order]
        ]
    return found


def _period(cam: CamTable, ends: list[tuple[Values, Values]]) -> list[Finding]:
    if not cam.periodic:
        return []
    sizes = _sizes(ends)
    at = cam.points[-1].x
    first, last = ends[0][0], ends[-1][1]
    found = []
    turns = (last.y - first.y) / cam.slave_period
    if abs(turns - round(turns)) * cam.slave_period > TOLERANCE * max(sizes[0], cam.slave_period):
        found.append(Finding("end", at, "position", last.y, first.y, period=cam.slave_period))
    found += [
        Finding("period", at, name, last[order], first[order])
        for order, name in _checked(cam)
        if order > 0 and abs(first[order] - last[order]) > TOLERANCE * sizes[order]
    ]
    return found


def _format(cam: CamTable) -> list[Finding]:
    """Laws that polynomials between two points cannot be (CAM-45)."""
    if cam.compile_format != "polynomial":
        return []
    return [
        Finding("law", left.x, law=law_name(segment.law))
        for left, segment, _ in cam.pieces()
        if segment.law not in POLYNOMIAL_LAWS
    ]


def _short(value: float) -> str:
    return number_text(float(f"{value:.7g}") + 0.0)
