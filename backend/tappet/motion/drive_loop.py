"""The loops of a servo drive that closes its position loop itself: P over PI over the current loop.

    velocity loop    C(s) = Kv (1 + 1 / (s Ti))
    current loop     1 / (1 + s TS), with the sum TS of the small time constants
    motor and load   1 / (s J)

From set to actual position that is

    x / r = Kp Kv (1 + s Ti) / (s^3 J Ti (1 + s TS) + Kv (1 + s Ti) (s + Kp))

without a feed-forward, and dry friction, a torque against the motion, adds -Ti s (1 + s TS) / (the same).
T1 = J / Kv is the lag of the velocity loop, 1 / T1 the frequency where its open loop crosses over. Without an
integral part Ti is infinite.

Gains by the symmetrical optimum (C. Kessler, Das symmetrische Optimum, Regelungstechnik 6, 1958; in
D. Schroeder, Elektrische Antriebe: Regelung von Antriebssystemen, "Symmetrisches Optimum") with a = 1 + 2 D
for the damping D:

    Kv = J / (a TS)    Ti = a^2 TS

and the position loop a fixed part slower than the velocity loop (M. Weck, C. Brecher, Werkzeugmaschinen 3:
the gain is 0.2 to 0.3 times the frequency of the drive): Kp = k / T1 = k / (a TS).

    no overshoot:  D = 1, k = 0.25            fast:  D = 1/sqrt(2), k = 0.3
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from scipy.optimize import brentq

from tappet.motion.loops import Aim, DriveLoops, Margins
from tappet.motion.measured_response import Numbers
from tappet.motion.position_loop import superposed

DAMPING: dict[Aim, float] = {"no_overshoot": 1.0, "fast": 1.0 / math.sqrt(2.0)}
OF_VELOCITY_LOOP: dict[Aim, float] = {"no_overshoot": 0.25, "fast": 0.3}
"""Gain of the position loop by the crossover of the velocity loop."""


@dataclass(frozen=True, slots=True)
class _Fraction:
    """Numerator and denominator by falling powers of s."""

    numerator: Numbers
    denominator: Numbers

    def answer(self, times: Numbers, order: int) -> Numbers:
        """To t^(order - 1) / (order - 1)!, 1 a step and 2 a ramp, by partial fractions; 0 before time 0.

        Multiple poles have other formulas with the same values: they are moved apart a little.
        """
        poles = np.roots(self.denominator).astype(complex)
        scale = float(np.max(np.abs(poles)))
        for at in range(1, len(poles)):
            while np.min(np.abs(poles[:at] - poles[at])) < 1e-5 * scale:
                poles[at] *= 1.0 + 2e-5
        slopes = np.array(
            [self.denominator[0] * np.prod(pole - np.delete(poles, at)) for at, pole in enumerate(poles)]
        )
        parts = np.polyval(self.numerator, poles) / (poles**order * slopes)
        after = np.where(times > 0.0, times, 0.0)
        value = np.real(np.exp(np.outer(after, poles)) @ parts)
        # what remains at t = 0 of the poles at 0 follows from the answer being 0 there
        low, base = self.numerator[::-1], self.denominator[::-1]
        final = float(low[0] / base[0])
        value = value + (final if order == 1 else final * after - float(np.real(np.sum(parts))))
        return np.where(times > 0.0, value, 0.0)


def _loops(loops: DriveLoops, lag_s: float) -> tuple[_Fraction, _Fraction]:
    """From the set position and from a friction by Kv to the position."""
    ti, small = loops.integral_time_s, loops.current_time_s
    control = np.array([ti, 1.0]) if ti > 0.0 else np.array([1.0])
    inert = np.polymul([lag_s, 0.0], np.polymul([ti, 0.0] if ti > 0.0 else [1.0], [small, 1.0]))
    whole = np.polyadd(np.polymul(inert, [1.0, 0.0]), np.polymul(control, [1.0, loops.position_gain]))
    free = np.polymul([ti, 0.0] if ti > 0.0 else [1.0], [small, 1.0])
    return _Fraction(control * loops.position_gain, whole), _Fraction(-free, whole)


def drive_answer(
    loops: DriveLoops, lag_s: float, dead_time_s: float, set_position: Numbers, cycle_s: float
) -> Numbers:
    """Positions without friction. It goes to each set position in a straight line, from the one before.

    `dead_time_s` is the age of an actual position against the set position of its cycle: that of the bus.
    """
    slopes = np.diff(set_position, prepend=set_position[0]) / cycle_s
    times = np.arange(1, len(set_position) + 1) * cycle_s - dead_time_s
    ramp = _loops(loops, lag_s)[0].answer(times, 2)
    return superposed(np.diff(slopes, prepend=0.0), ramp)


def friction_answer(
    loops: DriveLoops, lag_s: float, dead_time_s: float, start: int, count: int, cycle_s: float
) -> Numbers:
    """Positions by a friction of Kv against a motion that begins with the set position of a cycle."""
    times = (np.arange(count) - start + 1) * cycle_s - dead_time_s
    return _loops(loops, lag_s)[1].answer(times, 1)


def proposed_loops(loops: DriveLoops, lag_s: float, aim: Aim) -> DriveLoops:
    """By the symmetrical optimum, for the inertia lag_s Kv."""
    inertia = lag_s * loops.velocity_gain
    a, small = 1.0 + 2.0 * DAMPING[aim], loops.current_time_s
    return DriveLoops(
        position_gain=OF_VELOCITY_LOOP[aim] / (a * small),
        velocity_gain=inertia / (a * small),
        integral_time_s=a * a * small,
        current_time_s=small,
    )


def drive_margins(loops: DriveLoops, lag_s: float) -> tuple[Margins, Margins]:
    """Of the open position loop, and of the open velocity loop below it."""

    def velocity(omega: float) -> complex:
        s = 1j * omega
        integral = 1.0 + 1.0 / (s * loops.integral_time_s) if loops.integral_time_s > 0.0 else 1.0
        return integral / (s * lag_s * (1.0 + s * loops.current_time_s))

    def position(omega: float) -> complex:
        inner = velocity(omega)
        return loops.position_gain / (1j * omega) * inner / (1.0 + inner)

    top = 100.0 / min(lag_s, loops.current_time_s or lag_s)
    return _margins(position, top), _margins(velocity, top)


def _margins(response: Callable[[float], complex], top: float) -> Margins:
    grid = np.geomspace(top * 1e-7, top, 2000)
    values = np.array([response(float(omega)) for omega in grid])
    phases = np.unwrap(np.angle(values))
    phases -= 2.0 * math.pi * round((phases[0] + 0.75 * math.pi) / (2.0 * math.pi))
    crossing = int(np.argmax(np.abs(values) < 1.0))
    where = _root(lambda omega: abs(response(omega)) - 1.0, grid, crossing)
    phase = 180.0 + math.degrees(float(np.interp(math.log(where), np.log(grid), phases)))
    turns = np.flatnonzero((phases[1:] <= -math.pi) & (phases[:-1] > -math.pi)) + 1
    for turn in turns[turns >= crossing]:
        at = _root(lambda omega: response(omega).imag, grid, int(turn))
        return Margins(phase, 1.0 / abs(response(at)))
    return Margins(phase, None)


def _root(of: Callable[[float], float], grid: Numbers, at: int) -> float:
    """Between two places of the grid."""
    return math.exp(brentq(lambda x: of(math.exp(x)), math.log(grid[at - 1]), math.log(grid[at])))
