"""Identifies what the position loop of an axis acts on, from a recorded answer.

Output error: the times of the model are those with which its positions come nearest to the recorded ones, in
the sense of least squares. No recorded value is differentiated, so noise and quantisation of the encoder
average out. The controller's loop is identified from the velocities that it asked for, whatever its gain was;
the loop of a drive from its set positions, with the gains that it had. What is linear (factor, rest position,
friction) is solved for in between; the times are looked for on a grid first, as there may be local minima.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
from scipy.optimize import least_squares

from tappet.motion.drive_loop import drive_answer, friction_answer
from tappet.motion.loops import DriveLoops
from tappet.motion.measured_response import Numbers, Recording, UnusableMeasurementError
from tappet.motion.position_loop import Plant, plant_answer

LARGEST_RESIDUAL = 0.1
"""Part of the height: a model that is off by more says nothing about the axis."""
_DEAD_TIMES = 24
_LAGS = 14
_LONGEST_PART = 0.5
"""Of the recorded answer: longer times cannot be told from it."""
_BEFORE_REVERSAL = 0.95
"""Part of the height up to which dry friction is one torque against one direction."""
_LEAST_ANSWER = 12
"""Cycles of the answer of a drive from which its times are identified."""

Columns = Sequence[Numbers]


@dataclass(frozen=True, slots=True)
class Identified:
    """The model that fits best."""

    dead_time_s: float
    """Of what the controller's loop acts on; of a drive that of its bus, outside of its loop."""
    lag_s: float
    """Of the velocity loop."""
    factor: float
    """Velocity that comes of the one asked for."""
    residual: float
    """Root mean square of recorded minus modelled positions, in units."""
    answer: Numbers
    """Positions of the model in each cycle."""


def identify_plant(recording: Recording) -> Identified:
    """What the controller's loop acts on. Raises UnusableMeasurementError when no model fits."""
    command, cycle = recording.command, recording.cycle_s
    assert command is not None

    def columns(dead: float, lag: float) -> Columns:
        return [plant_answer(Plant(1.0, dead, lag), command, cycle)]

    return _identify(recording, columns, len(recording.act_position), factor=None)


def identify_drive(recording: Recording, loops: DriveLoops) -> Identified:
    """Lag of the velocity loop and age of the values of a drive with known gains.

    Raises UnusableMeasurementError when no model fits.
    """
    if loops.position_gain <= 0.0 or loops.velocity_gain <= 0.0:
        raise UnusableMeasurementError(
            "The gains of the drive's position and velocity loops must be above 0; set them first"
        )
    wanted, cycle, start = recording.set_position, recording.cycle_s, recording.resting
    answer = recording.act_position[start:] / recording.height
    near = np.flatnonzero(answer >= _BEFORE_REVERSAL)
    end = min(int(near[0]) if len(near) else len(answer), int(np.argmax(answer)) + 1)
    count = start + max(end, _LEAST_ANSWER)

    def columns(dead: float, lag: float) -> Columns:
        friction = friction_answer(loops, lag, dead, start, len(wanted), cycle)
        return [drive_answer(loops, lag, dead, wanted, cycle), friction]

    return _identify(recording, columns, count, factor=1.0)  # the velocity loop is one with a sensor


def _identify(
    recording: Recording, columns: Callable[[float, float], Columns], count: int, factor: float | None
) -> Identified:
    """The times with which the columns fit best, over the first cycles; `factor` is the known one of the
    first column."""
    _check_direction(recording)
    cycle = recording.cycle_s
    longest = _LONGEST_PART * (len(recording.set_position) - recording.resting) * cycle

    def misfit(times: Numbers) -> Numbers:
        return _fit(columns(float(times[0]), float(times[1])), recording, count, factor)[0]

    dead_times = np.concatenate([[0.0], np.geomspace(0.25 * cycle, longest, _DEAD_TIMES)])
    lags = np.geomspace(0.05 * cycle, longest, _LAGS)
    starts = sorted(
        (float(np.sum(misfit(np.array([dead, lag])) ** 2)), dead, lag) for dead in dead_times for lag in lags
    )[:3]
    found = [
        least_squares(
            misfit,
            [min(dead + 1e-3 * cycle, longest * 0.999), min(lag, longest * 0.999)],
            bounds=([0.0, 1e-3 * cycle], [longest, longest]),
            x_scale=cycle,
            diff_step=1e-4,
        )
        for _, dead, lag in starts
    ]
    best = min(found, key=lambda result: float(result.cost))
    dead, lag = (float(time) for time in best.x)
    rest, found_factor, answer = _fit(columns(dead, lag), recording, count, factor)
    residual = float(np.sqrt(np.mean(rest**2)))
    if residual > LARGEST_RESIDUAL * abs(recording.height):
        raise UnusableMeasurementError(
            "The answer is not that of a position loop: the model is off by "
            f"{residual / abs(recording.height):.0%} of the height; look for a loose coupling, friction, or "
            "a loop that oscillates, and measure again"
        )
    return Identified(dead, lag, found_factor, residual, answer)


def _check_direction(recording: Recording) -> None:
    farthest = recording.act_position[int(np.argmax(np.abs(recording.act_position)))]
    if farthest * recording.height < 0.0:
        raise UnusableMeasurementError(
            "The axis moves against the set position; check the direction in the scaling and the wiring of "
            "the drive"
        )


def _fit(
    columns: Columns, recording: Recording, count: int, factor: float | None
) -> tuple[Numbers, float, Numbers]:
    """What is left of the first recorded positions by the best linear parameters, the factor of the first
    column, and all positions of the model."""
    known = np.zeros(len(columns[0])) if factor is None else factor * columns[0]
    free = columns if factor is None else columns[1:]
    matrix = np.stack([*free, np.ones(len(known))], axis=1)
    sizes = np.max(np.abs(matrix[:count]), axis=0)
    sizes[sizes == 0.0] = 1.0
    wanted = (recording.act_position - known)[:count]
    solution, *_ = np.linalg.lstsq(matrix[:count] / sizes, wanted, rcond=None)
    model = known + matrix @ (solution / sizes)
    rest = (recording.act_position - model)[:count]
    return rest, float(solution[0] / sizes[0]) if factor is None else factor, model
