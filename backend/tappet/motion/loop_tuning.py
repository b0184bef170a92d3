"""Gains for the position loop of an axis by a measurement: figures, model, proposals, or what is wrong."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from tappet.motion.drive_loop import drive_answer, drive_margins, proposed_loops
from tappet.motion.loop_identification import Identified, identify_drive, identify_plant
from tappet.motion.loops import Aim, ControllerLoop, DriveLoops, GainName, Margins
from tappet.motion.measured_response import (
    Figures,
    Numbers,
    Recording,
    UnusableMeasurementError,
    figures,
)
from tappet.motion.position_loop import (
    Plant,
    controller_answer,
    margins,
    proposed_gain,
)

FULL = 0.98
"""Part of a limit from which the drive counts as being at it."""
AIMS: tuple[Aim, ...] = ("no_overshoot", "fast")


@dataclass(frozen=True, slots=True)
class Proposal:
    """Gains, and what they would do."""

    aim: Aim
    gains: dict[GainName, float]
    margins: Margins
    answer: Numbers
    """Predicted positions in each cycle of the recording, for a step or move like the measured one."""


@dataclass(frozen=True, slots=True)
class Evaluation:
    """What a measurement says. Without a model `problem` says why; figures are there as far as they go."""

    figures: Figures | None
    identified: Identified | None
    proposals: tuple[Proposal, ...]
    problem: str | None


def evaluate(
    recording: Recording, loop: ControllerLoop | DriveLoops, largest_torque: float | None = None
) -> Evaluation:
    """Figures, model and proposals of a measurement, or what is wrong with it."""
    found: Figures | None = None
    try:
        found = figures(recording)
        if isinstance(loop, DriveLoops):
            if not recording.jumps:
                raise UnusableMeasurementError(
                    "A fast move shows the dead time of a drive, its feed-forward hides the loops; measure a "
                    "step for their gains"
                )
            if _reaches(recording.torque, largest_torque):
                raise UnusableMeasurementError(
                    "The torque of the drive was at its limit, so that the answer is not that of the loop; "
                    "measure a smaller height"
                )
            identified = identify_drive(recording, loop)
            proposals = tuple(_for_drive(recording, loop, identified, aim) for aim in AIMS)
        else:
            if _reaches(recording.command, loop.largest_velocity):
                raise UnusableMeasurementError(
                    "The velocity of the drive was at its limit, so that the answer is not that of the loop; "
                    "measure a smaller height"
                )
            identified = identify_plant(recording)
            dead = loop.dead_time_cycles
            dead = dead if found.dead_time_cycles is None else float(found.dead_time_cycles)
            loop = replace(loop, dead_time_cycles=dead)
            proposals = tuple(_for_controller(recording, loop, identified, aim) for aim in AIMS)
    except UnusableMeasurementError as error:
        return Evaluation(found, None, (), str(error))
    return Evaluation(found, identified, proposals, None)


def _reaches(values: Numbers | None, limit: float | None) -> bool:
    """Whether the drive was at a limit, so that it did not answer linearly."""
    return values is not None and bool(limit) and float(np.max(np.abs(values))) >= FULL * (limit or 0.0)


def _for_controller(recording: Recording, loop: ControllerLoop, known: Identified, aim: Aim) -> Proposal:
    cycle, plant = recording.cycle_s, Plant(known.factor, known.dead_time_s, known.lag_s)
    gain = proposed_gain(plant, cycle, aim)
    new = replace(loop, gain=gain)
    answer = controller_answer(new, plant, recording.set_position, recording.set_velocity, cycle)
    gains: dict[GainName, float] = {"position_gain": gain, "dead_time": loop.dead_time_cycles}
    return Proposal(aim, gains, margins(plant, cycle, gain), answer)


def _for_drive(recording: Recording, loops: DriveLoops, known: Identified, aim: Aim) -> Proposal:
    new = proposed_loops(loops, known.lag_s, aim)
    lag = known.lag_s * loops.velocity_gain / new.velocity_gain
    answer = drive_answer(new, lag, known.dead_time_s, recording.set_position, recording.cycle_s)
    gains: dict[GainName, float] = {
        "position_gain": new.position_gain,
        "velocity_gain": new.velocity_gain,
        "integral_time": new.integral_time_s,
    }
    return Proposal(aim, gains, drive_margins(new, lag)[0], answer)
