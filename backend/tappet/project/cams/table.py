"""The data of a cam (cam.md, sections 1, 2, 5, 6 and 8): what its editor shows and the folder keeps."""

from __future__ import annotations

import math
from collections.abc import Iterator
from itertools import pairwise
from typing import Annotated, Literal, get_args

from pydantic import Field, StrictBool, StrictInt, model_validator

from tappet.project.data import CodeData, Data

FARTHEST = 1e12
"""Of positions and derivatives; MAX_CAM_RANGE of SM3_Basic."""
NARROWEST = 1e-9
"""Width of a segment; the cube of its inverse is still a number that means something."""
MOST_POINTS = 10_000
MOST_TAPPETS = 10_000
LAST_TRACK = 32_767
"""iGroupID is an INT."""
MOST_CHOSEN = 100
"""Points that are optimised at once."""
LARGEST_TABLE = 10_000
"""Elements of a table of positions."""

Coordinate = Annotated[float, Field(strict=True, ge=-FARTHEST, le=FARTHEST, allow_inf_nan=False)]
Law = Literal["line", "poly3", "poly5", "poly7", "sine", "inclined_sine", "modified_sine", "harmonic"]
LAWS: tuple[Law, ...] = get_args(Law)
"""In the order of SMC_CAM_SEGMENT_TYPE."""
TappetAction = Literal["none", "on", "off", "invert"]
CompileFormat = Literal["polynomial", "segments", "one_dimensional", "two_dimensional"]


class CamPoint(Data):
    """A point of a cam: where the slave is for a position of the master, and its derivatives there."""

    x: Coordinate = Field(description="Position of the master.")
    y: Coordinate = Field(description="Position of the slave.")
    v: Coordinate = Field(default=0.0, description="dY/dX.")
    a: Coordinate = Field(default=0.0, description="d²Y/dX².")
    j: Coordinate = Field(default=0.0, description="d³Y/dX³; polynomials of seventh degree use it.")


class CamSegment(Data):
    """What leads from a point to the next one."""

    law: Law = Field(default="poly5", description="Law of motion, VDI 2143.")
    inflection: float = Field(
        default=0.5,
        strict=True,
        gt=0,
        lt=1,
        allow_inf_nan=False,
        description="Of a modified sine: the part in front of the inflection point.",
    )


class CamTappet(Data):
    """What happens to the bit of a track when the master passes a position (CAM-53)."""

    x: Coordinate = Field(description="Position of the master.")
    positive: TappetAction = Field(default="on", description="When the master increases.")
    negative: TappetAction = Field(default="off", description="When the master decreases.")


class CamTrack(Data):
    """Tappets that switch the same bit (CAM-50)."""

    id: Annotated[StrictInt, Field(ge=1, le=LAST_TRACK)] = Field(description="Names the bit: iGroupID.")
    tappets: tuple[CamTappet, ...] = Field(default=(), max_length=MOST_TAPPETS)


class ContinuityChecks(Data):
    """What may not jump between two segments, beside the position (CAM-74)."""

    velocity: StrictBool = True
    acceleration: StrictBool = True
    jerk: StrictBool = False


class CamTable(CodeData):
    """A cam; by default the one of CAM-12 with the tracks of CAM-13."""

    points: tuple[CamPoint, ...] = Field(
        default=(
            CamPoint(x=0, y=0),
            CamPoint(x=120, y=120, v=1),
            CamPoint(x=240, y=240, v=1),
            CamPoint(x=360, y=360),
        ),
        min_length=2,
        max_length=MOST_POINTS,
        description="In order of the master; the first and the last one are the ends of its range.",
    )
    segments: tuple[CamSegment, ...] = Field(
        default=(CamSegment(), CamSegment(), CamSegment()),
        description="One behind each point but the last one.",
    )
    tracks: tuple[CamTrack, ...] = Field(
        default=(CamTrack(id=1, tappets=(CamTappet(x=90), CamTappet(x=270))), CamTrack(id=2)),
        description="Tracks of tappets, each with an id of its own.",
    )
    slave_start: Coordinate = Field(default=0.0, description="Lowest position that is shown (CAM-71).")
    slave_end: Coordinate = Field(default=360.0, description="Highest position that is shown.")
    periodic: StrictBool = Field(
        default=False, description="The end goes over into the start, up to periods of the slave (CAM-72)."
    )
    slave_period: float = Field(
        default=360.0,
        strict=True,
        gt=0,
        le=FARTHEST,
        allow_inf_nan=False,
        description="In units of the slave.",
    )
    checks: ContinuityChecks = ContinuityChecks()
    compile_format: CompileFormat = Field(
        default="polynomial", description="What the cam is compiled into (CAM-75)."
    )
    table_size: Annotated[StrictInt, Field(ge=2, le=LARGEST_TABLE)] = Field(
        default=256, description="Of the formats with tables of points: how many."
    )
    cubic: StrictBool = Field(default=False, description="Between the points of a table cubic, else linear.")

    @model_validator(mode="after")
    def _is_a_cam(self) -> CamTable:
        for number, (left, right) in enumerate(pairwise(self.points)):
            if not right.x - left.x >= NARROWEST:
                raise ValueError(
                    f"points.{number + 1}.x: {number_text(right.x)} does not lie behind "
                    f"{number_text(left.x)}, the position of the point before it"
                )
        if len(self.segments) != len(self.points) - 1:
            raise ValueError(
                f"segments: {len(self.points)} points have {len(self.points) - 1} segments between them, "
                f"not {len(self.segments)}"
            )
        self._check_tracks()
        if not self.slave_start < self.slave_end:
            raise ValueError("slave_end: the end of the slave's range must lie above its start")
        return self

    def _check_tracks(self) -> None:
        first, last = self.domain
        seen: set[int] = set()
        for number, track in enumerate(self.tracks):
            if track.id in seen:
                raise ValueError(f"tracks.{number}.id: two tracks have the id {track.id}")
            seen.add(track.id)
            for row, tappet in enumerate(track.tappets):
                if not first <= tappet.x <= last:
                    raise ValueError(
                        f"tracks.{number}.tappets.{row}.x: {number_text(tappet.x)} lies outside the range "
                        f"of the master, {number_text(first)} to {number_text(last)}"
                    )

    @property
    def domain(self) -> tuple[float, float]:
        """First and last position of the master."""
        return self.points[0].x, self.points[-1].x

    def pieces(self) -> Iterator[tuple[CamPoint, CamSegment, CamPoint]]:
        """The segments with the points at their ends."""
        return zip(self.points, self.segments, self.points[1:], strict=False)


def number_text(value: float) -> str:
    """A number as people write it, to the last bit: `120`, `0.1`, `1e-09`."""
    if value == math.floor(value) and abs(value) < 1e15:
        return str(int(value))
    return repr(value)
