"""The answer of an axis in the frames of a recorder."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from tappet.motion.axis_measurement import AxisFacts, FrameLayout
from tappet.motion.measured_response import Recording, UnusableMeasurementError, recording_of


def recorded_answer(
    cycles: Sequence[int], frames: Sequence[bytes], layout: FrameLayout, facts: AxisFacts
) -> Recording:
    """From frames with their numbers of cycles. Raises UnusableMeasurementError when they are none."""
    if not frames:
        raise UnusableMeasurementError("Nothing was recorded")
    lost = cycles[-1] - cycles[0] + 1 - len(frames)
    if lost:
        raise UnusableMeasurementError(
            f"{lost} of {lost + len(frames)} cycles were not recorded; measure for a shorter time"
        )
    values = np.frombuffer(
        b"".join(frames), np.dtype([(str(at), code) for at, code in enumerate(layout.codes)])
    )
    columns = [values[str(at)].astype(float) for at in range(len(layout.codes))]
    known = facts.values
    command = None
    if not facts.in_drive:
        sign = -1.0 if known["iRatioTechUnitsNum"] < 0 else 1.0
        command = sign * columns[5] * known["fRatedVelocity"] / known["diRatedRaw"]
    return recording_of(
        [layout.phases[int(number)] for number in columns[0]],
        known["fTaskCycle"],
        set_position=columns[1],
        act_position=columns[2],
        set_velocity=columns[3],
        act_velocity=columns[4],
        command=command,
        torque=columns[5] if facts.in_drive else None,
        resolution=facts.resolution,
        period=facts.period,
    )
