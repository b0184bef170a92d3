"""JSON shapes of the cam editor."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field, StrictBool, StrictInt

from tappet.project.cams.table import LARGEST_TABLE, MOST_CHOSEN, MOST_POINTS, CamTable, Coordinate
from tappet.project.naming import MAX_NAME
from tappet.server.shapes import Line, Reply, Request

MOST_SAMPLES = 20_000
MOST_SINGLE = 1000

CamName = Annotated[str, Field(pattern="^[A-Za-z_][A-Za-z0-9_]*$", max_length=MAX_NAME)]


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


class CamTextOrder(Request):
    """How to write a cam as text."""

    cam: CamTable
    format: Literal["ascii", "csv", "cam"] = Field(
        description="Pairs of positions; columns with derivatives and laws; the file of SMC_ReadCAM."
    )
    count: Annotated[StrictInt, Field(ge=2, le=LARGEST_TABLE)] = Field(
        default=256, description="Of points at equal distances of the master."
    )
    points_only: bool = Field(default=False, description="The points of the cam itself instead.")
    name: Line = Field(default="Cam", max_length=80, description="Name in a cam file.")


class CamText(Reply):
    """A cam as text."""

    text: str


class CamImport(Request):
    """A text that a cam gets its points from: pairs of positions, CSV, or a cam file."""

    text: str
    cam: CamTable


class ImportedCam(Reply):
    """The cam with what was in the text."""

    cam: CamTable
    removed_tappets: int = Field(description="They lay outside the new range of the master.")


class OptimiseOrder(Request):
    """Which points of a cam may move, and for what."""

    cam: CamTable
    points: list[Annotated[StrictInt, Field(ge=0, le=MOST_POINTS)]] = Field(
        min_length=1, max_length=MOST_CHOSEN, description="Numbers of points, from 0; start and end stay."
    )
    goal: Literal["velocity", "acceleration", "jerk"] = Field(
        description="Its largest value beside the points becomes least."
    )
    keep_positions: StrictBool = Field(
        default=False, description="Positions of the slave stay; only the derivatives change."
    )


class OptimisedCam(Reply):
    """A cam with other points."""

    cam: CamTable
    before: float = Field(description="The largest value beside the points.")
    after: float


class CamCodeOrder(Request):
    """A cam and its name."""

    name: CamName
    cam: CamTable


class RunningCamOrder(Request):
    """The cam of the editor."""

    cam: CamTable


class RunningCamAnswer(Reply):
    """A cam as the application has it."""

    cam: CamTable = Field(description="That of the editor with the curve and the tappets of the application.")
    same: bool = Field(description="The application has the cam of the editor.")
