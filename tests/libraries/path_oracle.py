"""How fast a group moves along its path, by the formulas of axis_group 6, written from the specification."""

from __future__ import annotations

import itertools
import math
from typing import NamedTuple

import numpy as np


class Segment(NamedTuple):
    """A movement along a path."""

    length: float
    start: float
    velocity: float
    end: float
    acceleration: float
    deceleration: float
    jerk: float
    """0: trapezoid."""


def ramp(start: float, end: float, acceleration: float, jerk: float) -> list[tuple[float, float]]:
    """Phases of a change of velocity: duration and jerk."""
    change, sign = abs(end - start), (1 if end >= start else -1)
    if change == 0:
        return []
    if change >= acceleration**2 / jerk:
        short, long = acceleration / jerk, change / acceleration - acceleration / jerk
        return [(short, sign * jerk), (long, 0.0), (short, -sign * jerk)]
    short = math.sqrt(change / jerk)
    return [(short, sign * jerk), (short, -sign * jerk)]


def ramp_time(start: float, end: float, acceleration: float, jerk: float) -> float:
    if jerk == 0:
        return abs(end - start) / acceleration
    return sum(duration for duration, _ in ramp(start, end, acceleration, jerk))


def ramp_distance(start: float, end: float, acceleration: float, jerk: float) -> float:
    return (start + end) / 2 * ramp_time(start, end, acceleration, jerk)


def peak(segment: Segment) -> float:
    """The largest velocity of a movement between its ends."""
    length, start, velocity, end, up, down, jerk = segment

    def needed(top: float) -> float:
        first = ramp_distance(start, top, up if top >= start else down, jerk)
        return first + ramp_distance(top, end, down if top >= end else up, jerk)

    if needed(velocity) <= length:
        return velocity
    low, high = max(start, end), max(velocity, start, end)
    for _ in range(100):
        middle = (low + high) / 2
        low, high = (middle, high) if needed(middle) <= length else (low, middle)
    return low


def duration(segment: Segment) -> float:
    """How long a movement takes."""
    length, start, _, end, up, down, jerk = segment
    top = peak(segment)
    first, last = (
        (start, top, up if top >= start else down, jerk),
        (top, end, down if top >= end else up, jerk),
    )
    cruise = length - ramp_distance(*first) - ramp_distance(*last)
    return ramp_time(*first) + (cruise / top if top > 0 else 0.0) + ramp_time(*last)


def plan(segment: Segment) -> list[tuple[float, float]]:
    """Phases of a movement with limited jerk."""
    length, start, _, end, up, down, jerk = segment
    top = peak(segment)
    first, last = (
        (start, top, up if top >= start else down, jerk),
        (top, end, down if top >= end else up, jerk),
    )
    cruise = length - ramp_distance(*first) - ramp_distance(*last)
    return [*ramp(*first), (cruise / top, 0.0), *ramp(*last)]


def states(phases: list[tuple[float, float]], start: float, times: np.ndarray) -> np.ndarray:
    """Position, velocity and acceleration at times, by integrating the phases."""
    out = np.zeros((len(times), 3))
    for row, time in enumerate(times):
        s, v, a, left = 0.0, start, 0.0, float(time)
        for length, jerk in phases:
            t = min(left, length)
            s += t * (v + t * (a / 2 + t * jerk / 6))
            v += t * (a + t * jerk / 2)
            a += t * jerk
            left -= t
        out[row] = (s, v, a)
    return out


def reachable(start: float, wanted: float, way: float, acceleration: float, jerk: float) -> float:
    """The velocity nearest to a wanted one that a ramp reaches within a way."""
    if ramp_distance(start, wanted, acceleration, jerk) <= way:
        return wanted
    near, far = start, wanted
    for _ in range(200):
        middle = (near + far) / 2
        near, far = (
            (middle, far) if ramp_distance(start, middle, acceleration, jerk) <= way else (near, middle)
        )
    return near


def blend(mode: int, previous: float, following: float) -> float:
    """The velocity that a buffer mode wants (paper, table 1)."""
    return {2: min(previous, following), 3: previous, 4: following, 5: max(previous, following)}.get(
        mode, 0.0
    )


class Move(NamedTuple):
    """A queued command: length, limits and how it follows the one before."""

    length: float
    velocity: float
    acceleration: float
    deceleration: float
    jerk: float
    mode: int


def joined(moves: list[Move], start: float = 0.0) -> list[float]:
    """Velocities at the ends of movements that are all queued at once (axis_group 3 and V-5, V-6)."""
    wanted = [blend(b.mode, a.velocity, b.velocity) for a, b in itertools.pairwise(moves)] + [0.0]
    for index in range(len(moves) - 2, -1, -1):
        following = moves[index + 1]
        if wanted[index] > wanted[index + 1]:
            wanted[index] = reachable(
                wanted[index + 1], wanted[index], following.length, following.deceleration, following.jerk
            )
    ends, velocity = [], start
    for move, end in zip(moves, wanted, strict=True):
        limit = move.acceleration if end > velocity else move.deceleration
        velocity = reachable(velocity, end, move.length, limit, move.jerk)
        ends.append(velocity)
    return ends


def durations(moves: list[Move]) -> list[float]:
    """How long each of the movements takes when all are queued at once."""
    ends = joined(moves)
    starts = [0.0, *ends[:-1]]
    return [
        duration(Segment(m.length, start, m.velocity, end, m.acceleration, m.deceleration, m.jerk))
        for m, start, end in zip(moves, starts, ends, strict=True)
    ]
