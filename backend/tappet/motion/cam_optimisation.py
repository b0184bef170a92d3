"""Moves chosen points of a cam so that the largest velocity, acceleration or jerk beside them becomes least.

Between points that keep their X a polynomial depends linearly on position and derivatives at its ends. The
least peak at samples of the segments is therefore a linear programme, whose solution is the global one. What
it leaves open is chosen so that another derivative has a least peak, too.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np
import numpy.typing as npt

from tappet.project.cams.checks import law_name
from tappet.project.cams.laws import values_in
from tappet.project.cams.table import MOST_CHOSEN, CamPoint, CamTable
from tappet.project.errors import ProjectError

Goal = Literal["velocity", "acceleration", "jerk"]
_ORDERS: dict[Goal, int] = {"velocity": 1, "acceleration": 2, "jerk": 3}
_NEXT: dict[Goal, Goal] = {"velocity": "acceleration", "acceleration": "jerk", "jerk": "acceleration"}
"""What is made least with what is left open."""
LAWS = ("poly5", "poly7")
"""Segments that take any position and derivatives at their ends."""
SAMPLES = 129
"""Of a segment, ends included."""
_SLACK = 1e-7
"""Part by which the first peak may grow while the second one is made least."""

Numbers = npt.NDArray[np.float64]


class CamOptimisationError(ProjectError):
    """These points cannot be moved so."""

    code = "cam_optimisation"


@dataclass(frozen=True, slots=True)
class Peaks:
    """Of the segments beside the chosen points, before and behind."""

    before: float
    after: float


@dataclass(frozen=True, slots=True)
class OptimisedCam:
    """What a cam became."""

    cam: CamTable
    peaks: Peaks


@dataclass(frozen=True, slots=True)
class _Variable:
    """A number of a point that is looked for."""

    point: int
    name: Literal["y", "v", "a"]


def optimised(cam: CamTable, chosen: Sequence[int], goal: Goal, keep_positions: bool) -> OptimisedCam:
    """The cam with other positions and derivatives at the chosen points, which keep their X.

    Positions stay between those that the editor shows, `slave_start` and `slave_end`. Raises
    CamOptimisationError for points that cannot be moved.
    """
    points = sorted(set(chosen))
    _check(cam, points)
    names: tuple[Literal["y", "v", "a"], ...] = ("v", "a") if keep_positions else ("y", "v", "a")
    variables = [_Variable(point, name) for point in points for name in names]
    segments = sorted({segment for point in points for segment in (point - 1, point)})
    system = _System(cam, variables, segments)
    found = system.least(_ORDERS[goal], _ORDERS[_NEXT[goal]])
    order = _ORDERS[goal]
    changed = list(cam.points)
    for variable, value in zip(variables, found.tolist(), strict=True):
        place = changed[variable.point]
        changed[variable.point] = place.model_copy(update={variable.name: value})
    peaks = Peaks(system.peak(order, system.now), system.peak(order, found))
    if peaks.after >= peaks.before:
        return OptimisedCam(cam, Peaks(peaks.before, peaks.before))
    result = CamTable.model_validate(cam.model_copy(update={"points": tuple(changed)}).model_dump())
    return OptimisedCam(result, peaks)


def _check(cam: CamTable, points: Sequence[int]) -> None:
    if not points:
        raise CamOptimisationError("Choose at least one point that may move.")
    if len(points) > MOST_CHOSEN:
        raise CamOptimisationError(f"At most {MOST_CHOSEN} points are moved at once.")
    for point in points:
        if not 0 < point < len(cam.points) - 1:
            raise CamOptimisationError("The start and the end of a cam stay where they are.")
        for segment in (point - 1, point):
            law = cam.segments[segment].law
            if law not in LAWS:
                raise CamOptimisationError(
                    f"Point {point + 1} has a segment of the type {law_name(law)} beside it; points between "
                    "Poly5 and Poly7 can be moved."
                )


class _System:
    """The derivatives at samples as linear functions of the variables, in units of their own sizes."""

    def __init__(self, cam: CamTable, variables: Sequence[_Variable], segments: Sequence[int]) -> None:
        self._cam = cam
        self._variables = variables
        self._segments = segments
        width = cam.points[-1].x - cam.points[0].x
        rise = max(cam.slave_end - cam.slave_start, *(abs(point.y) for point in cam.points), 1e-9)
        sizes = {"y": rise, "v": rise / width, "a": rise / width**2}
        self._rise, self._width = rise, width
        self.now = np.array([getattr(cam.points[one.point], one.name) for one in variables])
        self._sizes = np.array([sizes[one.name] for one in variables])
        self._least = np.full(len(variables), -np.inf)
        self._greatest = np.full(len(variables), np.inf)
        for number, one in enumerate(variables):
            if one.name == "y":
                self._least[number] = min(cam.slave_start, self.now[number]) / rise
                self._greatest[number] = max(cam.slave_end, self.now[number]) / rise
        self._fixed = self._samples(cam.points)
        """Rows of values and their derivatives, by order."""
        self._factors = np.stack(
            [self._slopes(one, size) for one, size in zip(variables, self._sizes.tolist(), strict=True)],
            axis=2,
        )

    def _samples(self, points: Sequence[CamPoint], only: int | None = None) -> Numbers:
        """Values and derivatives at the samples; `only`: of the segments beside one point, 0 elsewhere."""
        found = np.zeros((4, len(self._segments), SAMPLES))
        for row, segment in enumerate(self._segments):
            if only is not None and segment not in (only - 1, only):
                continue
            left, right = points[segment], points[segment + 1]
            law = self._cam.segments[segment]
            for at, x in enumerate(np.linspace(left.x, right.x, SAMPLES).tolist()):
                found[:, row, at] = values_in(left, law, right, min(max(x, left.x), right.x))
        return found.reshape(4, -1)

    def _slopes(self, variable: _Variable, size: float) -> Numbers:
        points = [
            CamPoint.model_construct(x=point.x, y=0.0, v=0.0, a=0.0, j=0.0) for point in self._cam.points
        ]
        points[variable.point] = points[variable.point].model_copy(update={variable.name: size})
        return self._samples(points, variable.point)

    def _constant(self, order: int) -> Numbers:
        constant: Numbers = self._fixed[order] - self._factors[order] @ (self.now / self._sizes)
        return constant

    def peak(self, order: int, variables: Numbers) -> float:
        """The largest absolute value of a derivative at the samples."""
        values = self._constant(order) + self._factors[order] @ (variables / self._sizes)
        return float(np.max(np.abs(values)))

    def least(self, first: int, second: int) -> Numbers:
        """The variables with the least peak of one derivative, and among these of the other."""
        found = self._solve(first, None)
        if found is None:
            raise CamOptimisationError("No better place for these points was found.")
        better = self._solve(second, (first, self.peak(first, found) * (1 + _SLACK)))
        return found if better is None else better  # The solver's tolerance may leave nothing open

    def _solve(self, order: int, kept: tuple[int, float] | None) -> Numbers | None:
        """The least peak of a derivative; `kept` is another one with the peak that it may have."""
        from scipy.optimize import linprog  # takes a while to load

        factors, constant = self._factors[order], self._constant(order)
        size = max(float(np.max(np.abs(self._fixed[order]))), 1e-9 * self._rise / self._width**order)
        ones = np.full((len(constant), 1), -1.0)
        rows = [np.hstack([factors / size, ones]), np.hstack([-factors / size, ones])]
        limits = [-constant / size, constant / size]
        if kept is not None:
            other, peak = kept
            scale = max(peak, 1e-9 * self._rise / self._width**other)
            nothing = np.zeros((len(constant), 1))
            rows += [np.hstack([sign * self._factors[other] / scale, nothing]) for sign in (1.0, -1.0)]
            limits += [peak / scale - sign * self._constant(other) / scale for sign in (1.0, -1.0)]
        bounds = [*zip(self._least.tolist(), self._greatest.tolist(), strict=True), (0.0, None)]
        goal = np.zeros(len(self._variables) + 1)
        goal[-1] = 1.0
        result = linprog(
            goal, A_ub=np.vstack(rows), b_ub=np.concatenate(limits), bounds=bounds, method="highs"
        )
        if result.x is None:
            return None
        found: Numbers = result.x[:-1] * self._sizes
        return found
