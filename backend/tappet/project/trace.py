"""A trace: records of variables that a task samples together, and how their curves are drawn (trace.md).

Of these settings only those of `recorded` matter to the runtime; the others say how things look, and changing
them needs no download (TRC-70, trace EX-07).
"""

from __future__ import annotations

import hashlib
import json
from typing import Annotated, Any, Literal

from pydantic import Field, StrictBool, StrictInt, model_validator

from tappet.project.data import Data, Duration, Line, Text
from tappet.project.naming import name_key

MOST_RECORDS = 16
MOST_CHANNELS = 256
MOST_POINTS = 1_000_000
"""Samples in the ring of a record."""
Color = Annotated[str, Field(pattern=r"^(#[0-9a-fA-F]{6})?$")]
"""Empty: chosen by the editor."""
Finite = Annotated[float, Field(strict=True, allow_inf_nan=False)]
Scale = Literal["auto", "fixed", "scrolling"]


class TraceLimit(Data):
    """Values beyond a limit are drawn in a colour of their own (TRC-43 .. TRC-46)."""

    on: StrictBool = False
    limit: Finite = 0.0
    color: Color = "#ff0000"


class Axis(Data):
    """What both axes of a diagram have (TRC-53 .. TRC-59)."""

    mode: Scale = "auto"
    reverse: StrictBool = False
    description: Line = ""
    grid: StrictBool = True
    grid_color: Color = ""
    arrow: Literal["none", "open", "filled"] = "none"
    position: Literal["low", "middle", "high"] = "low"


class TraceTimeAxis(Axis):
    """The X axis; `length` is what is visible while it scrolls (TRC-50 .. TRC-54)."""

    minimum: Duration = "T#0s"
    maximum: Duration = "T#10s"
    length: Duration = "T#10s"
    major: Duration | Literal[""] = Field(default="", description="Distance of long ticks; empty: chosen.")
    minor: Duration | Literal[""] = ""


class TraceValueAxis(Axis):
    """A Y axis (TRC-61)."""

    minimum: Finite = 0.0
    maximum: Finite = 100.0
    length: Finite = Field(default=100.0, gt=0)
    major: Finite = Field(default=0.0, ge=0, description="Distance of long ticks; 0: chosen.")
    minor: Finite = Field(default=0.0, ge=0)

    @model_validator(mode="after")
    def _upwards(self) -> TraceValueAxis:
        if self.minimum >= self.maximum:
            raise ValueError(f"the minimum {self.minimum} is not less than the maximum {self.maximum}")
        return self


class TraceAppearance(Data):
    """How the diagram of a record looks where all its curves share one (TRC-50 .. TRC-62)."""

    x: TraceTimeAxis = TraceTimeAxis()
    y: TraceValueAxis = TraceValueAxis()
    background: Color = ""
    selected_background: Color = ""
    font_size: StrictInt = Field(default=12, ge=6, le=40)


class TraceChannel(Data):
    """A curve: a variable or expression that the runtime samples, or a formula of other channels."""

    variable: Line = Field(default="", description="Path or expression (TRC-40).")
    formula: Line = Field(default="", description="Computed from channels by their names; not recorded.")
    name: Line = Field(default="", max_length=200, description="In the legend and in formulas.")
    color: Color = ""
    graph: Literal["none", "line", "cross", "saw_tooth", "step", "points"] = "line"
    axis: StrictInt = Field(default=0, ge=0, le=7)
    minimum_warning: TraceLimit = TraceLimit()
    maximum_warning: TraceLimit = TraceLimit()
    visible: StrictBool = True
    appearance: TraceValueAxis = TraceValueAxis()

    @property
    def recorded(self) -> bool:
        """Whether the runtime samples it."""
        return bool(self.variable.strip()) and not self.formula.strip()

    @property
    def shown_name(self) -> str:
        """What it is called."""
        return self.name.strip() or self.variable.strip() or self.formula.strip()


class TraceTrigger(Data):
    """When a record has seen what it waits for (TRC-20 .. TRC-23)."""

    variable: Line = Field(default="", description="BOOL, number, enumeration, or an expression.")
    edge: Literal["none", "positive", "negative", "both"] = "none"
    level: Line = Field(default="", description="Literal, variable or enumeration value; empty for BOOL.")
    position: StrictInt = Field(default=50, ge=0, le=100, description="Percent of the samples behind it.")


class TraceRecord(Data):
    """Variables that one task samples into one ring (TRC-20 .. TRC-31)."""

    name: Line = Field(default="Record1", min_length=1, max_length=100)
    task: Line = Field(default="", description="Empty: the first task.")
    every: StrictInt = Field(default=1, ge=1, le=1_000_000, description="Cycles between two samples.")
    condition: Line = Field(default="", description="Samples are taken while it is TRUE.")
    trigger: TraceTrigger = TraceTrigger()
    buffer: StrictInt = Field(default=100, ge=1, le=MOST_POINTS, description="Samples in the ring.")
    comment: Text = ""
    trace_pou: StrictBool = Field(
        default=False,
        description="A program for visualizations (TRC-29); kept, and not made yet.",
    )
    appearance: TraceAppearance = TraceAppearance()
    channels: Annotated[tuple[TraceChannel, ...], Field(max_length=MOST_CHANNELS)] = ()

    @model_validator(mode="after")
    def _variables_once(self) -> TraceRecord:
        seen = set()
        for channel in self.channels:
            key = name_key(channel.variable.replace(" ", ""))
            if channel.recorded and key in seen:
                raise ValueError(
                    f"'{self.name}' has the variable '{channel.variable}' twice; add it to another record"
                )
            seen.add(key)
        return self


class TraceData(Data):
    """A trace and its records (TRC-10 .. TRC-12)."""

    refresh_rate: StrictInt = Field(default=500, ge=50, le=60_000, description="ms between two pictures.")
    points: StrictInt = Field(
        default=10_000, ge=1, le=MOST_POINTS, description="Most samples that a record keeps in the runtime."
    )
    stacked: StrictBool = Field(default=False, description="Diagrams of records one above another.")
    records: Annotated[tuple[TraceRecord, ...], Field(max_length=MOST_RECORDS)] = ()

    @model_validator(mode="after")
    def _records_can_be_told_apart(self) -> TraceData:
        names = [name_key(record.name) for record in self.records]
        for name in names:
            if names.count(name) > 1:
                raise ValueError(f"two records are named '{name}'; give each a name of its own")
        return self

    def recorded(self) -> dict[str, Any]:
        """What the runtime records: all but how it looks."""
        keep = {"name", "task", "every", "condition", "trigger", "buffer"}
        return {
            "points": self.points,
            "records": [
                {
                    **record.model_dump(include=keep),
                    "variables": [
                        channel.variable.strip() for channel in record.channels if channel.recorded
                    ],
                }
                for record in self.records
            ],
        }

    def digest(self) -> str:
        """Differs where a download is needed (trace EX-07)."""
        return hashlib.sha256(json.dumps(self.recorded(), sort_keys=True).encode()).hexdigest()[:20]


AXIS_MEMBERS = (
    "fSetPosition",
    "fActPosition",
    "fSetVelocity",
    "fActVelocity",
    "fSetAcceleration",
    "fActAcceleration",
    "fSetTorque",
    "fActTorque",
)
"""Members of AXIS_REF_SM3 that the device trace of an axis records."""


def axis_channels(axis: str) -> tuple[TraceChannel, ...]:
    """The device trace of an axis: what it should do, what it does, and the lag between both."""
    found = tuple(TraceChannel(variable=f"{axis}.{member}") for member in AXIS_MEMBERS)
    lag = TraceChannel(variable=f"{axis}.fSetPosition - {axis}.fActPosition", name=f"{axis}_lag", axis=1)
    return (*found, lag)
