"""A recorded answer of an axis to a step or a fast move, and the figures that are read off it.

Positions are in units of the application, counted from where the axis stood. Time 0 is the cycle in which the
set position leaves its place; values are those of the end of a cycle of the bus task.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from tappet.motion.loops import LEAST_INCREMENTS
from tappet.project.errors import ProjectError

Numbers = npt.NDArray[np.floating[Any]]

SETTLED = 0.02
"""Part of the height that an answer keeps within once it is settled, the usual 2 % band."""
RISE_FROM, RISE_TO = 0.1, 0.9
NOISE_BAND = 5.0
"""Standard deviations of the noise at rest that noise does not leave in the length of a recording."""
LEAST_RESTING = 5
"""Cycles from which the noise at rest is known."""
LEAST_RESPONDING = 20
"""Cycles of an answer that can be judged."""
LEAST_MOTION = 0.05
"""Part of the height below which an axis counts as not moving."""
LEAST_REACTION = 0.002
"""Part of the height at which a reaction is seen at the earliest: what a picture shows."""
_END_PART = 0.1
"""Part of the answer, at its end, of which the position is the final one."""


class UnusableMeasurementError(ProjectError):
    """Nothing can be concluded from this recording."""

    code = "unusable_measurement"


@dataclass(frozen=True, slots=True)
class Recording:
    """Values of each cycle from rest to the end of the answer."""

    cycle_s: float
    resting: int
    """How many cycles come before the set position leaves its place."""
    set_position: Numbers
    act_position: Numbers
    set_velocity: Numbers
    act_velocity: Numbers
    command: Numbers | None = None
    """Velocity that the controller gives the drive, in units/s, where it closes the loop."""
    torque: Numbers | None = None
    resolution: float = 0.0
    """Units of an increment of the encoder."""

    @property
    def time(self) -> Numbers:
        """Seconds since the set position left its place."""
        return (np.arange(len(self.set_position)) - self.resting) * self.cycle_s

    @property
    def height(self) -> float:
        """Of the step or the move."""
        return float(self.set_position[-1])

    @property
    def jumps(self) -> bool:
        """Whether it is that of a step."""
        return bool(abs(self.set_position[self.resting]) > 0.5 * abs(self.height))

    @property
    def noise(self) -> float:
        """Standard deviation of the actual position at rest; quantisation counts at least."""
        at_rest = float(np.std(self.act_position[: self.resting])) if self.resting > 1 else 0.0
        return float(max(at_rest, self.resolution / np.sqrt(12.0)))

    @property
    def noise_band(self) -> float:
        """How far noise takes the actual position from where it is."""
        return max(NOISE_BAND * self.noise, 1.5 * self.resolution)


@dataclass(frozen=True, slots=True)
class Figures:
    """What the answer is like. None: it does not come to that within the recording."""

    dead_time_cycles: int | None
    """From the first set motion to the first reaction of the actual position (AXIS-40)."""
    rise_time_s: float | None
    """From 10 % to 90 % of the height."""
    overshoot: float
    """Beyond the final set position, as a part of the height."""
    settling_time_s: float | None
    """Until the answer stays in its band."""
    band: float
    """Half the width of that band, in units."""
    steady_error: float
    """Set minus actual position at the end, in units."""
    noise: float
    """Standard deviation at rest, in units."""


def recording_of(
    phases: Sequence[str],
    cycle_s: float,
    *,
    set_position: Numbers,
    act_position: Numbers,
    set_velocity: Numbers,
    act_velocity: Numbers,
    command: Numbers | None = None,
    torque: Numbers | None = None,
    resolution: float = 0.0,
    period: float | None = None,
) -> Recording:
    """The answer out of all cycles of a measurement, by the phases of its panel.

    `period` is that of a rotary axis. Raises UnusableMeasurementError when a phase is missing.
    """
    named = np.array(phases)
    responding = np.flatnonzero(named == "Responding")
    resting = np.flatnonzero(named == "Resting")
    if len(responding) < LEAST_RESPONDING or len(resting) < LEAST_RESTING:
        raise UnusableMeasurementError(
            f"The measurement has only {len(resting)} cycles at rest and {len(responding)} of the answer; "
            f"measure at least {LEAST_RESPONDING} cycles"
        )
    part = slice(int(resting[0]), int(responding[-1]) + 1)
    places = np.stack([set_position[part], act_position[part]])
    if period is not None:
        places = np.unwrap(places, period=period, axis=1)
        places[1] -= period * np.round((places[1, 0] - places[0, 0]) / period)
    places -= places[0, 0]
    moved = np.flatnonzero(places[0] != 0.0)
    if len(moved) == 0:
        raise UnusableMeasurementError("The set position did not leave its place")
    first = int(moved[0])
    return Recording(
        cycle_s,
        first,
        places[0],
        places[1] - float(np.mean(places[1, :first])),
        set_velocity[part],
        act_velocity[part],
        None if command is None else command[part],
        None if torque is None else torque[part],
        resolution,
    )


def figures(recording: Recording) -> Figures:
    """What is read off an answer. Raises UnusableMeasurementError when the axis did not move."""
    height = recording.height
    size = abs(height)
    if size < LEAST_INCREMENTS * recording.resolution:
        raise UnusableMeasurementError(
            f"The height of {size:g} u is only {size / recording.resolution:.1f} increments of the encoder; "
            f"measure at least {LEAST_INCREMENTS} increments"
        )
    answer = recording.act_position[recording.resting :] / height
    band = max(SETTLED, recording.noise_band / size)
    if float(np.max(np.abs(answer))) < max(LEAST_MOTION, recording.noise_band / size):
        raise UnusableMeasurementError(
            "The axis did not follow the set position; the gain of the position loop may be 0, or the drive "
            "blocked or without power"
        )
    end = answer[-max(3, round(len(answer) * _END_PART)) :]
    final = float(np.mean(end))
    times = np.arange(len(answer)) * recording.cycle_s
    reached = recording.set_position[recording.resting :] / height
    outside = np.flatnonzero(np.abs(answer - 1.0) > band)
    last = int(outside[-1]) if len(outside) else -1
    over = float(np.max(answer)) - 1.0
    return Figures(
        dead_time_cycles=_dead_time(recording),
        rise_time_s=_rise_time(answer, times),
        overshoot=over if over > recording.noise_band / size else 0.0,
        settling_time_s=None if last == len(answer) - 1 else float(times[last + 1]),
        band=band * size,
        steady_error=(float(reached[-1]) - final) * height,
        noise=recording.noise,
    )


def _dead_time(recording: Recording) -> int | None:
    """Cycles from what the drive is told first to the first reaction."""
    threshold = max(recording.noise_band, LEAST_REACTION * abs(recording.height))
    if recording.jumps and recording.command is not None:  # it may be asked for later than it is set
        start = _first_beyond(recording.command, recording.resting)
    else:
        start = int(np.argmax(np.abs(recording.set_position) > threshold))
    beyond = np.abs(recording.act_position) > threshold
    # a single value may be a disturbed one
    reacts = np.flatnonzero(beyond[start:-1] & beyond[start + 1 :])
    return int(reacts[0]) if len(reacts) else None


def _first_beyond(values: Numbers, resting: int) -> int:
    """The first cycle behind rest in which a value is none of those at rest."""
    at_rest = values[:resting]
    middle = float(np.mean(at_rest))
    threshold = max(NOISE_BAND * float(np.std(at_rest)), 1e-3 * float(np.max(np.abs(values - middle))))
    beyond = np.flatnonzero(np.abs(values[resting:] - middle) > threshold)
    return resting + (int(beyond[0]) if len(beyond) else 0)


def _rise_time(answer: Numbers, times: Numbers) -> float | None:
    low, high = _crossing(answer, times, RISE_FROM), _crossing(answer, times, RISE_TO)
    return None if low is None or high is None else high - low


def _crossing(answer: Numbers, times: Numbers, level: float) -> float | None:
    """When the answer is beyond a level for the first time, between two cycles by a straight line."""
    beyond = np.flatnonzero(answer >= level)
    if len(beyond) == 0:
        return None
    at = int(beyond[0])
    if at == 0:
        return float(times[0])
    before, behind = answer[at - 1], answer[at]
    part = (level - before) / (behind - before)
    return float(times[at - 1] + part * (times[at] - times[at - 1]))
