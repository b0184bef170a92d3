"""The flight recorder: values of past cycles by their expressions; its other routes are operations."""

from __future__ import annotations

from tappet.server.dependencies import LinkDep, Viewer
from tappet.server.flight.shapes import FlightReadOrder, PastValues
from tappet.server.routing import Router
from tappet.server.values import service as values

router = Router(prefix="/runtimes/{runtime_id}/flight", tags=["flight recorder"])


@router.post("/read")
async def read_flight(body: FlightReadOrder, who: Viewer, link: LinkDep) -> PastValues:
    """Read values at the end of a past cycle. An unknown expression carries its own error."""
    past = await values.read(link, body.expressions, cycle=body.cycle)
    return PastValues(cycle=body.cycle, values=past)
