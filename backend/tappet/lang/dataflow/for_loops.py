"""The iterations of a FOR loop whose bounds and step are constant: values of its counter."""

from __future__ import annotations

from dataclasses import dataclass

from tappet.lang import ast
from tappet.lang.dataflow.intervals import Interval, of_type
from tappet.lang.types import value_type


@dataclass(frozen=True, slots=True)
class Iterations:
    """The first value of the counter, the bound it is compared with, and the step."""

    first: int
    bound: int
    step: int

    @property
    def any(self) -> bool:
        """Whether the loop runs at all."""
        return self.first <= self.bound if self.step > 0 else self.first >= self.bound

    @property
    def last(self) -> int:
        """Value of the counter in the last iteration, if it is not changed elsewhere and does not wrap."""
        return self.first + (self.bound - self.first) // self.step * self.step

    @property
    def interval(self) -> Interval:
        """First and last value, smaller one first."""
        return min(self.first, self.last), max(self.first, self.last)


def iterations(s: ast.For) -> Iterations | None:
    """The iterations of a loop; None where bounds or step are not constant or do not fit the counter."""
    step = step_of(s)
    if step is None or not _is_number(s.start) or not _is_number(s.stop):
        return None
    first, bound = _as_counter(s, s.start), _as_counter(s, s.stop)
    return None if first is None or bound is None else Iterations(first, bound, step)


def step_of(s: ast.For) -> int | None:
    """The step with its sign, also where the counter has none; None where it is not constant."""
    if s.step is None:
        return 1
    step = s.step.constant
    return step if isinstance(step, int) and _is_number(s.step) and step != 0 else None


def limits(s: ast.For) -> Interval | None:
    """All values that the counter can hold."""
    return of_type(value_type(s.variable.type)) if s.variable.type is not None else None


def _is_number(e: ast.Expr) -> bool:
    return isinstance(e.constant, int) and not isinstance(e.constant, bool)


def _as_counter(s: ast.For, bound: ast.Expr) -> int | None:
    """A bound as the counter holds it, with another sign if it is as wide; None where it is refused."""
    number = bound.constant
    assert isinstance(number, int)
    known, own = limits(s), of_type(bound.type)
    if known is None or known[0] <= number <= known[1]:
        return number
    count = known[1] - known[0] + 1
    if bound.untyped or own is None or own[1] - own[0] + 1 != count:
        return None
    return known[0] + (number - known[0]) % count
