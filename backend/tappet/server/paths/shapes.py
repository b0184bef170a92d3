"""What the editor of a CNC program asks of the view of its path, and the answers."""

from __future__ import annotations

from typing import Annotated, ClassVar

from pydantic import ConfigDict, Field, StrictInt

from tappet.motion.paths.colouring import Colouring
from tappet.project.cnc.program import CncProgramData
from tappet.project.data import MAX_TEXT
from tappet.server.shapes import Reply, Request

Place = Annotated[list[float], Field(min_length=3, max_length=3, description="X, Y and Z [u].")]
TextLine = Annotated[StrictInt, Field(ge=0, le=MAX_TEXT, description="Line of the text, from 0.")]


class PathLooks(Request):
    """How a path is drawn."""

    dark: bool = False
    grid: bool = Field(default=True, description="Shows the grid in the plane Z = 0 (CNC-52).")
    colouring: Colouring = Field(default="kind", description="What the colours stand for.")
    preprocessed: bool = Field(
        default=False, description="Draws the path behind preprocessing, and the original faint behind it."
    )


class PathViewOrder(Request):
    """A view to begin."""

    looks: PathLooks = PathLooks()


class PathViewAddress(Reply):
    """A view that was begun."""

    view_id: str
    path: str = Field(description="Where it is shown; put it into a frame of a logged-in page.")


class PathOrder(Request):
    """A program to draw, as the editor has it, and how."""

    model_config = ConfigDict(extra="forbid", str_max_length=400_000_000)

    object_id: str = Field(description="The CNC object.")
    program: CncProgramData | None = Field(default=None, description="None: as it is stored.")
    looks: PathLooks = PathLooks()


class ChosenLine(Request):
    """The line whose elements are chosen."""

    line: TextLine | None = Field(default=None, description="None: no one.")


class Ray(Request):
    """Where somebody points."""

    origin: Place
    ahead: Place
    angle: float = Field(gt=0, lt=1, description="How far beside the ray an element may be seen [rad].")


class PathLegend(Reply):
    """The colours of values."""

    low: float
    high: float
    colours: list[str] = Field(description="From the least value to the greatest one, evenly.")
    by_motion: bool = Field(
        description="The values are those of the interpolated motion, else those of the program."
    )


class PathMark(Reply):
    """A place on the path."""

    place: Place
    line: int
    number: int = Field(default=0, description="H of a switch point.")


class PathElement(Reply):
    """An element of the path."""

    number: int = Field(description="Among all objects, from 0.")
    line: int
    kind: int = Field(description="SMC_MOVTYP.")
    start: Place
    end: Place
    leave: Place = Field(description="Unit vector of the path at the start; 0 where it does not move.")
    arrive: Place = Field(description="Unit vector of the path at the end.")
    length: float


class PathSummary(Reply):
    """What was drawn."""

    SENTENCES: ClassVar = ("fault",)

    centre: Place = Field(description="A place of the picture is (place - centre) * scale.")
    scale: float
    objects: int
    length: float
    low: Place
    high: Place
    start: Place | None
    end: Place | None
    ends: list[PathMark] = Field(description="Of all elements that move, unless they are many.")
    switches: list[PathMark]
    fault: str | None = Field(description="Why the path ends before its program.")
    fault_line: int | None
    legend: PathLegend | None


class ChosenElements(Reply):
    """The elements of a line."""

    elements: list[PathElement]


class PickedElement(Reply):
    """What is seen where somebody points."""

    element: PathElement | None
    place: Place | None = Field(description="On the element.")


class PathSamples(Reply):
    """The interpolated motion on the path that is drawn, thinned out; lists of one length."""

    SENTENCES: ClassVar = ("fault",)

    time: list[float]
    place: list[Place]
    velocity: list[float] = Field(description="On the path [u/s].")
    acceleration: list[float] = Field(description="Along the path [u/s²].")
    line: list[int] = Field(description="-1: none.")
    duration: float
    fault: str | None
