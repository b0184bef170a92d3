"""JSON shapes of the cam editor."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field, StrictInt

from tappet.project.cams.table import CamTable, Coordinate
from tappet.server.shapes import Reply, Request

MOST_SAMPLES = 20_000
MOST_SINGLE = 1000


class CurvesOrder(Request):
    """What to draw."""

    cam: CamTable
    samples: Annotated[StrictInt, Field(ge=2, le=MOST_SAMPLES)] = Field(
        default=1000,
        description="Of the whole cam, spread by width; a segment has at least both of its ends.",
    )
    at: list[Coordinate] = Field(
        default=[], max_length=MOST_SINGLE, description="Positions of the master to tell values of."
    )


class CamValues(Reply):
    """A place on the curves."""

    x: float
    y: float
    v: float
    a: float
    j: float


class CamSegmentCurve(Reply):
    """The curves of a segment; at its ends it has its own values, also where they jump."""

    x: list[float]
    y: list[float]
    v: list[float]
    a: list[float]
    j: list[float]
    least: float = Field(description="Lowest position of the slave, also between the samples.")
    greatest: float
    velocity: float = Field(description="Largest absolute value, also between the samples.")
    acceleration: float
    jerk: float


class CamFinding(Reply):
    """What is wrong with a cam."""

    severity: Literal["error", "warning", "information"]
    text: str
    x: float = Field(description="Position of the master that it is about.")


class CamDrawing(Reply):
    """The curves of a cam by the compiled library, and what is wrong with it."""

    segments: list[CamSegmentCurve]
    at: list[CamValues]
    findings: list[CamFinding]
