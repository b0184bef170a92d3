"""Operations of the flight recorder on the wire.

flight_status                          -> the fields of FlightStatus
flight_history                         -> [[cycle, unix time in ns], ...], oldest first
flight_read    cycle, places           -> [bytes, ...]
flight_freeze  on                      -> the fields of FlightStatus
"""

from __future__ import annotations

import asyncio
from collections.abc import Awaitable, Callable
from dataclasses import asdict
from typing import Any

from tappet.runtime.access import ApplicationAccess
from tappet.runtime.protocol import Fields


def operations(plc: ApplicationAccess) -> dict[str, Callable[[Fields], Awaitable[Any]]]:
    """What a connection answers, by name of the operation."""

    async def status(fields: Fields) -> Any:
        return asdict(await asyncio.to_thread(plc.flight_status))

    async def history(fields: Fields) -> Any:
        return [list(row) for row in await asyncio.to_thread(plc.flight_history)]

    async def read(fields: Fields) -> Any:
        return await asyncio.to_thread(plc.flight_read, fields.integer("cycle"), fields.places("places"))

    async def freeze(fields: Fields) -> Any:
        return asdict(await asyncio.to_thread(plc.flight_freeze, fields.flag("on")))

    return {
        "flight_status": status,
        "flight_history": history,
        "flight_read": read,
        "flight_freeze": freeze,
    }
