"""The flight recorder: past cycles of the running application."""

from __future__ import annotations

from typing import Annotated

from pydantic import Field

from tappet.server.shapes import Request
from tappet.server.values.shapes import MAX_EXPRESSIONS, Expression, Values

Cycle = Annotated[int, Field(ge=0, le=(1 << 53) - 1)]
"""Number of a cycle of the bus cycle task since the application was loaded."""


class FlightReadOrder(Request):
    """What to read, and of which cycle."""

    cycle: Cycle
    expressions: Annotated[list[Expression], Field(max_length=MAX_EXPRESSIONS)]


class PastValues(Values):
    """Values at the end of a past cycle, in the order asked for. Whether they were forced is not kept."""

    cycle: int
