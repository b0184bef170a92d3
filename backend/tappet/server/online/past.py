"""Frames of a past cycle, out of the flight recorder."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from tappet.runtime.operations.flight import ReadFlight
from tappet.server.runtimes.links import RuntimeLink

PAST = 1
"""Flag of a frame: its values are not live."""
Places = Sequence[tuple[int, int]]


async def read_past(link: RuntimeLink, cycle: int, wanted: Mapping[int, Places]) -> dict[int, bytes]:
    """What each subscription shows of `cycle`, by the places of its frame. One question for all of them: the
    image is rebuilt once. Raises problems for a cycle that is not kept, and while nothing is connected."""
    places = sorted({place for listed in wanted.values() for place in listed})
    code_id = link.code_id
    async with link.client() as client:
        values = await client.call(ReadFlight(cycle, places, code_id))
    held = dict(zip(places, values, strict=True))
    return {id: b"".join(held[place] for place in listed) for id, listed in wanted.items() if listed}
