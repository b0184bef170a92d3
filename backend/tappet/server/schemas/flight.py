"""The flight recorder: past cycles of the running application."""

from __future__ import annotations

from datetime import datetime
from typing import Annotated, Literal

from pydantic import Field

from tappet.server.schemas.base import Reply, Request
from tappet.server.schemas.values import MAX_EXPRESSIONS, Expression, Values

Cycle = Annotated[int, Field(ge=0, le=(1 << 53) - 1)]
"""Number of a cycle of the bus cycle task since the application was loaded."""


class FlightEntries(Reply):
    """What is kept; null where nothing is."""

    count: int
    first_cycle: int | None
    first_timestamp: datetime | None
    last_cycle: int | None
    last_timestamp: datetime | None


class FlightState(Reply):
    """State of the flight recorder."""

    frozen: bool = Field(description="Nothing is recorded, so nothing kept is dropped.")
    frozen_by: Literal["request", "exception"] | None
    entries: FlightEntries
    period: int = Field(description="An entry every so many cycles.")
    parts: int = Field(
        description="1: all values of an entry are of its cycle. More: the image is large, each entry covers"
        " one part of it in turn, and a value may be up to `parts - 1` entries old."
    )
    memory: int = Field(description="Bytes the entries may take.")
    used: int = Field(description="Bytes they take.")


class FlightCycle(Reply):
    """A past cycle that can be read."""

    cycle: int
    timestamp: datetime


class FlightReadOrder(Request):
    """What to read, and of which cycle."""

    cycle: Cycle
    expressions: Annotated[list[Expression], Field(max_length=MAX_EXPRESSIONS)]


class PastValues(Values):
    """Values at the end of a past cycle, in the order asked for. Whether they were forced is not kept."""

    cycle: int


class FreezeOrder(Request):
    """Keep what is recorded (true), or record again (false)."""

    on: bool
