"""Servo axes in small parts of a cycle, by matrix exponentials: one for the controller, one with loops."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt
from scipy.linalg import expm

Numbers = npt.NDArray[np.float64]
PARTS = 200
"""Of a cycle; dead times are whole ones of them."""


@dataclass(frozen=True)
class ServoAxis:
    """Times in cycles."""

    factor: float
    dead: float
    lag: float
    cycle: float

    def matrices(self) -> tuple[Numbers, Numbers]:
        """Position and velocity a part of a cycle later, for a velocity that is asked for meanwhile."""
        lag = self.lag * self.cycle
        system = np.array([[0, 1, 0], [0, -1 / lag, self.factor / lag], [0, 0, 0]])
        whole = expm(system * self.cycle / PARTS)
        return whole[:2, :2], whole[:2, 2]

    def controlled(
        self, set_position: Numbers, set_velocity: Numbers, gain: float, dead: float, encoder: Encoder
    ) -> tuple[Numbers, Numbers]:
        """Measured positions and commands when a controller closes the loop once a cycle."""
        on, by = self.matrices()
        late = round(self.dead * PARTS)
        asked = np.zeros((len(set_position) + 1) * PARTS + late)
        state = np.zeros(2)
        places, commands = [], []
        for at in range(len(set_position)):
            places.append(encoder.read(state[0]))
            old = set_position[max(0, at - int(dead))]
            commands.append(set_velocity[at] + gain * (old - places[-1]))
            asked[late + at * PARTS : late + (at + 1) * PARTS] = commands[-1]
            for part in range(at * PARTS, (at + 1) * PARTS):
                state = on @ state + by * asked[part]
        return np.array(places), np.array(commands)


@dataclass(frozen=True)
class ServoDrive:
    """Cascaded loops of a drive, of which `dead` cycles pass until its values are seen; friction by Kv."""

    lag: float
    """J / Kv, in cycles."""
    current: float
    """In cycles."""
    dead: float
    position_gain: float
    integral_time: float
    """In seconds, 0: no integral part."""
    cycle: float
    friction: float = 0.0

    def answer(self, set_position: Numbers, encoder: Encoder) -> Numbers:
        """Measured positions: angle, velocity, torque by Kv and the integral of the velocity error."""
        count = len(set_position) * PARTS
        fine = np.interp(np.arange(count) / PARTS, np.arange(len(set_position)), set_position)
        step = self.cycle / PARTS
        rate = 1.0 / self.integral_time if self.integral_time else 0.0
        system = np.zeros((5, 5))  # the last two are what is held in a part: what is wanted, and friction
        kv, lag, tau = self.position_gain, self.lag * self.cycle, self.current * self.cycle
        system[0, 1] = 1.0
        system[1, 2] = 1.0 / lag
        system[2] = [-kv / tau, -1.0 / tau, -1.0 / tau, 1.0 / tau, 1.0 / tau]
        system[3] = [-kv * rate, -rate, 0.0, 0.0, rate]
        on = expm(system * step)[:4]
        drag = expm(np.array([[0, 1, 0], [0, 0, 1.0 / lag], [0, 0, 0]]) * step)[:2, 2]
        state = np.zeros(4)
        inside = np.zeros(count)
        for part in range(count):
            inside[part] = state[0]
            behind = fine[min(part + 1, count - 1)]
            wanted = kv * 0.5 * (fine[part] + behind)
            state = on @ np.append(state, wanted)
            state[:2] -= drag * self.friction * np.sign(state[1]) * (abs(state[1]) > 1e-9)
        late = round(self.dead * PARTS)
        seen = np.concatenate([np.zeros(late), inside])[: len(inside) : PARTS]
        return np.array([encoder.read(place) for place in seen])


class Encoder:
    """Increments and noise, in units."""

    def __init__(self, increment: float = 0.0, noise: float = 0.0, seed: int = 1) -> None:
        self._increment, self._noise = increment, noise
        self._random = np.random.default_rng(seed)

    def read(self, place: float) -> float:
        """What is measured of a place."""
        seen = place + self._noise * self._random.standard_normal()
        return round(seen / self._increment) * self._increment if self._increment else seen
