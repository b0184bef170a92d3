"""The position loop that the controller closes over a drive that follows a speed (SM_Drive_PosControl).

What it acts on, from the velocity it asks for to the actual position, is

    G(s) = b exp(-s T) / (s (1 + s T1))

with the factor b, the dead time T, and the lag T1 by which velocity loop and motor follow. The loop works
once a cycle and asks for one velocity until the next; on average that is half a cycle of dead time more.

The gain follows from the sum of the small time constants TS = T + T1 + half a cycle, by the magnitude optimum
(C. Kessler, Ueber die Vorausberechnung optimal abgestimmter Regelkreise, Regelungstechnik 2/3, 1954/55; in
D. Schroeder, Elektrische Antriebe: Regelung von Antriebssystemen, "Betragsoptimum"):

    fast:          Kp = 1 / (2 b TS)    damping 1/sqrt(2) of a pure lag, 4.3 % overshoot
    no overshoot:  Kp = 1 / (4 b TS)    damping 1 of a pure lag: both poles at -1 / (2 TS)

A pure dead time overshoots from Kp TS = 1/e = 0.368 on, so the second gain is without overshoot there too.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from scipy.optimize import brentq
from scipy.signal import fftconvolve

from tappet.motion.loops import Aim, ControllerLoop, Margins
from tappet.motion.measured_response import Numbers

SHARE: dict[Aim, float] = {"no_overshoot": 0.25, "fast": 0.5}
"""Of 1 / (b TS)."""
_LEAST_LAG = 1e-9
"""Seconds: a smaller lag is none."""


@dataclass(frozen=True, slots=True)
class Plant:
    """What the loop acts on."""

    factor: float
    """Velocity that comes of the one asked for."""
    dead_time_s: float
    lag_s: float


def small_time_constants(plant: Plant, cycle_s: float) -> float:
    """Their sum in seconds."""
    return plant.dead_time_s + plant.lag_s + 0.5 * cycle_s


def proposed_gain(plant: Plant, cycle_s: float, aim: Aim) -> float:
    """By the magnitude optimum, in 1/s."""
    return SHARE[aim] / (plant.factor * small_time_constants(plant, cycle_s))


def margins(plant: Plant, cycle_s: float, gain: float) -> Margins:
    """Of the open loop with a gain."""
    dead = plant.dead_time_s + 0.5 * cycle_s
    whole, lag = gain * plant.factor, plant.lag_s

    def size(omega: float) -> float:
        return whole / (omega * math.hypot(1.0, omega * lag)) - 1.0

    def phase(omega: float) -> float:
        return -0.5 * math.pi - omega * dead - math.atan(omega * lag)

    crossover = brentq(size, whole * 1e-9, whole * (1 + 1e-9))
    phase_margin = math.degrees(math.pi + phase(crossover))
    largest = 0.5 * math.pi / dead  # there the dead time alone is enough
    turn = brentq(lambda omega: phase(omega) + math.pi, 1e-12 / dead, largest * (1 + 1e-9))
    return Margins(phase_margin, 1.0 / (size(turn) + 1.0))


def plant_answer(plant: Plant, command: Numbers, cycle_s: float) -> Numbers:
    """Positions at the beginning of each cycle when the velocity asked for is held in each."""
    times = np.arange(len(command)) * cycle_s - plant.dead_time_s
    ramp = np.where(times > 0.0, times, 0.0)
    if plant.lag_s > _LEAST_LAG:
        ramp = ramp + plant.lag_s * np.expm1(-ramp / plant.lag_s)
    return plant.factor * superposed(np.diff(command, prepend=0.0), ramp)


def controller_answer(
    loop: ControllerLoop, plant: Plant, set_position: Numbers, set_velocity: Numbers, cycle_s: float
) -> Numbers:
    """Positions when the controller closes the loop once a cycle: vSet + Kp (posSet(t - d) - posAct)."""
    count = len(set_position)
    whole, part = divmod(plant.dead_time_s / cycle_s, 1.0)
    late, lag = int(whole), plant.lag_s
    ago = np.interp(np.arange(count) - loop.dead_time_cycles, np.arange(count), set_position)
    commands = np.zeros(count + late + 2)
    place, velocity = 0.0, 0.0
    found = np.empty(count)
    for at in range(count):
        found[at] = place
        command = float(set_velocity[at]) + loop.gain * (float(ago[at]) - place)
        if loop.largest_velocity is not None:
            command = min(max(command, -loop.largest_velocity), loop.largest_velocity)
        commands[at + late + 1] = plant.factor * command
        # in the first part of this cycle the drive still has the command of the cycle before
        for wanted, time in ((commands[at], part * cycle_s), (commands[at + 1], (1.0 - part) * cycle_s)):
            fall = math.exp(-time / lag) if lag > _LEAST_LAG else 0.0
            place += wanted * time + (velocity - wanted) * (lag if lag > _LEAST_LAG else 0.0) * (1.0 - fall)
            velocity = wanted + (velocity - wanted) * fall
    return found


def superposed(changes: Numbers, answer: Numbers) -> Numbers:
    """What many changes do together, each with the same answer."""
    return np.asarray(fftconvolve(changes, answer)[: len(changes)])
