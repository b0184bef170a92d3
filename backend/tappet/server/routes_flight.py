"""The flight recorder: past cycles of a running or failed application."""

from __future__ import annotations

from datetime import UTC, datetime, timedelta

from fastapi import APIRouter

from tappet.runtime.flight import FlightStatus
from tappet.server import audit, values
from tappet.server.audit import Act
from tappet.server.dependencies import DatabaseDep, LinkDep, Operator, Viewer
from tappet.server.schemas.flight import (
    FlightCycle,
    FlightEntries,
    FlightReadOrder,
    FlightState,
    FreezeOrder,
    PastValues,
)

router = APIRouter(prefix="/runtimes/{runtime_id}/flight", tags=["flight recorder"])
_EPOCH = datetime(1970, 1, 1, tzinfo=UTC)


def _time(timestamp_ns: int) -> datetime:
    return _EPOCH + timedelta(microseconds=timestamp_ns // 1000)


def _state(status: FlightStatus) -> FlightState:
    first, last = status.first_timestamp_ns, status.last_timestamp_ns
    return FlightState(
        frozen=status.frozen,
        frozen_by="exception" if status.frozen_by == "exception" else "request" if status.frozen else None,
        entries=FlightEntries(
            count=status.count,
            first_cycle=status.first_cycle,
            first_timestamp=None if first is None else _time(first),
            last_cycle=status.last_cycle,
            last_timestamp=None if last is None else _time(last),
        ),
        period=status.period,
        parts=status.parts,
        memory=status.memory,
        used=status.used,
    )


@router.get("")
async def flight_state(who: Viewer, link: LinkDep) -> FlightState:
    """What is kept of the past. It freezes at an exception; a start after a reset begins anew."""
    link.loaded_symbols()
    async with link.client() as client:
        return _state(await client.flight_status())


@router.get("/cycles")
async def list_flight_cycles(who: Viewer, link: LinkDep) -> list[FlightCycle]:
    """All past cycles that can be read, oldest first. Numbers are missing where nothing was recorded."""
    link.loaded_symbols()
    async with link.client() as client:
        history = await client.flight_history()
    return [FlightCycle(cycle=cycle, timestamp=_time(stamp)) for cycle, stamp in history]


@router.post("/read")
async def read_flight(body: FlightReadOrder, who: Viewer, link: LinkDep) -> PastValues:
    """Read values at the end of a past cycle. An unknown expression carries its own error."""
    past = await values.read(link, body.expressions, cycle=body.cycle)
    return PastValues(cycle=body.cycle, values=past)


@router.post("/freeze")
async def freeze_flight(
    body: FreezeOrder, who: Operator, link: LinkDep, database: DatabaseDep
) -> FlightState:
    """Keep what is recorded, or record again. An exception stays frozen until it is reset."""
    link.loaded_symbols()
    async with link.client() as client:
        status = await client.flight_freeze(body.on)
    action = "flight-freeze" if body.on else "flight-record"
    act = Act(action, link.name, runtime_id=link.id)
    await database.write_async(lambda db: audit.record(db, who, act))
    return _state(status)
