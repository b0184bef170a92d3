"""JSON shapes of measurements of position loops."""

from __future__ import annotations

from typing import Annotated, ClassVar, Literal

from pydantic import Field, StrictInt

from tappet.motion.loops import Aim, Excitation, GainName
from tappet.runtime.operations.axis_panel import LONGEST_ANSWER_S
from tappet.server.shapes import Reply, Request

Place = Literal["controller", "drive"]


class TuningGain(Reply):
    """A gain of the loop that can be written."""

    name: GainName
    expression: str = Field(description="Its variable in the application.")
    value: float


class AxisTuning(Reply):
    """What there is to be tuned at an axis, and what a good measurement would be."""

    closed_in: Place = Field(description="Who closes the position loop.")
    state: str = Field(description="Of the axis, nAxisState.")
    bus_task: str
    cycle_s: float
    gains: list[TuningGain]
    lag_limit: float | None = Field(description="Units from which a step is an error of the axis.")
    excitation: Excitation = Field(description="Suggested: a step, or a fast move where there is no gain.")
    height: float = Field(description="Suggested, in units.")
    duration_s: float = Field(description="Suggested.")


class MeasureOrder(Request):
    """What to measure, by somebody who has control of the axis."""

    holder: Annotated[StrictInt, Field(ge=1, lt=1 << 32)] = Field(
        description="Number of the page in control."
    )
    excitation: Excitation = "step"
    height: Annotated[float, Field(allow_inf_nan=False)] = Field(
        description="How far the set position steps or moves, in units."
    )
    duration_s: Annotated[float, Field(gt=0, le=LONGEST_ANSWER_S)] = Field(
        default=1.0, description="Seconds until it moves back."
    )


class ResponseSamples(Reply):
    """Values of the axis from rest to the end of the answer, in units from where it stood."""

    time: list[float] = Field(description="Seconds since the set position left its place.")
    set_position: list[float]
    act_position: list[float]
    set_velocity: list[float]
    act_velocity: list[float]
    command: list[float] | None = Field(description="Velocity that the controller gives the drive.")
    torque: list[float] | None = Field(description="Of the drive, in Nm.")


class ResponseFigures(Reply):
    """What is read off an answer; null: it does not come to that in this time."""

    dead_time_cycles: int | None = Field(
        description="From the first set motion to the first reaction (AXIS-40)."
    )
    rise_time_s: float | None = Field(description="From 10 % to 90 % of the height.")
    overshoot: float = Field(description="As a part of the height.")
    settling_time_s: float | None
    band: float = Field(description="Half the width of the band that it settles in, in units.")
    steady_error: float = Field(description="Set minus actual position at the end, in units.")
    noise: float = Field(description="Standard deviation at rest, in units.")


class LoopModel(Reply):
    """The identified model: dead time, and an integrator behind the lag of the velocity loop."""

    factor: float = Field(description="Velocity that comes of the one asked for.")
    dead_time_s: float
    lag_s: float
    inertia: float | None = Field(description="Of motor and load by the gain of the drive, in kgm².")
    residual: float = Field(description="Root mean square of what it does not explain, in units.")
    answer: list[float] = Field(description="Its positions, beside the samples.")


class GainValue(Reply):
    """A proposed value."""

    name: GainName
    value: float


class GainProposal(Reply):
    """Gains that fit the model, and what they would do."""

    aim: Aim
    gains: list[GainValue]
    phase_margin_deg: float
    gain_margin: float | None = Field(description="Factor until it oscillates, null: it does not.")
    answer: list[float] = Field(description="Predicted positions, beside the samples.")


class AxisMeasured(Reply):
    """A measurement of an axis and what it says."""

    SENTENCES: ClassVar = ("problem",)

    axis: str
    closed_in: Place
    excitation: Excitation
    height: float
    cycle_s: float
    samples: ResponseSamples | None
    figures: ResponseFigures | None
    model: LoopModel | None
    proposals: list[GainProposal]
    problem: str | None = Field(description="Why there is no proposal, and what to do.")
