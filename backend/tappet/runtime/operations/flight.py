"""The flight recorder: past cycles of a running or failed application."""

from __future__ import annotations

from datetime import datetime
from typing import TYPE_CHECKING, Annotated, ClassVar, Literal

from msgspec import Meta, Struct

from tappet.runtime.flight import FlightStatus
from tappet.runtime.flight_holds import ANYBODY
from tappet.runtime.flight_recording import write_recording
from tappet.runtime.operations.declaration import CodeId, Count, Fact, Operation, Places, Rest
from tappet.runtime.operations.instants import Instant, instant_of

if TYPE_CHECKING:
    from tappet.runtime.plc import SoftPlc

_TAG = "flight recorder"
Owner = Annotated[str, Meta(max_length=100, description="Who looks back, such as a page of a browser.")]
Lease = Annotated[int, Meta(ge=1, le=86_400, description="Seconds.")]


class FlightEntries(Struct, frozen=True):
    """What is kept; null where nothing is."""

    count: int
    first_cycle: int | None
    first_timestamp: Instant | None
    last_cycle: int | None
    last_timestamp: Instant | None


class FlightState(Struct, frozen=True):
    """State of the flight recorder."""

    frozen: Annotated[bool, Meta(description="Nothing is recorded, so nothing kept is dropped.")]
    frozen_by: Literal["request", "exception"] | None
    entries: FlightEntries
    period: Annotated[int, Meta(description="An entry every so many cycles.")]
    parts: Annotated[
        int,
        Meta(
            description="1: all values of an entry are of its cycle. More: the image is large, each entry"
            " covers one part of it in turn, and a value may be up to `parts - 1` entries old."
        ),
    ]
    memory: Annotated[int, Meta(description="Bytes the entries may take.")]
    used: Annotated[int, Meta(description="Bytes they take.")]


class FlightCycle(Struct, frozen=True):
    """A past cycle that can be read."""

    cycle: int
    timestamp: Instant


def _time(timestamp_ns: int | None) -> datetime | None:
    return None if timestamp_ns is None else instant_of(timestamp_ns)


def state_of(status: FlightStatus) -> FlightState:
    """The status as people read it."""
    return FlightState(
        frozen=status.frozen,
        frozen_by="exception" if status.frozen_by == "exception" else "request" if status.frozen else None,
        entries=FlightEntries(
            status.count,
            status.first_cycle,
            _time(status.first_timestamp_ns),
            status.last_cycle,
            _time(status.last_timestamp_ns),
        ),
        period=status.period,
        parts=status.parts,
        memory=status.memory,
        used=status.used,
    )


def cycles_of(history: list[tuple[int, int]]) -> list[FlightCycle]:
    """The history as people read it."""
    return [FlightCycle(cycle, instant_of(stamp)) for cycle, stamp in history]


class GetFlightStatus(Operation[FlightStatus], frozen=True):
    """What is kept of the past. It freezes at an exception; after a reset it begins again."""

    op: ClassVar[str] = "flight_status"
    of_recordings: ClassVar[bool] = True
    rest: ClassVar[Rest | None] = Rest("GET", "/flight", "viewer", None, state_of, _TAG)

    def run(self, plc: SoftPlc) -> FlightStatus:
        """As of now."""
        return plc.flight_status()


class ListFlightCycles(Operation[list[tuple[int, int]]], frozen=True):
    """All past cycles that can be read, oldest first. Numbers are missing where nothing was recorded."""

    op: ClassVar[str] = "flight_history"
    of_recordings: ClassVar[bool] = True
    rest: ClassVar[Rest | None] = Rest("GET", "/flight/cycles", "viewer", None, cycles_of, _TAG)

    def run(self, plc: SoftPlc) -> list[tuple[int, int]]:
        """Cycle of the bus cycle task, and unix time in ns."""
        return plc.flight_history()


class ReadFlight(Operation[list[bytes]], frozen=True):
    """Bytes at (offset, size) at the end of a past cycle; refused when it is not kept."""

    op: ClassVar[str] = "flight_read"
    of_recordings: ClassVar[bool] = True
    cycle: Count
    places: Places
    code_id: CodeId = ""

    def run(self, plc: SoftPlc) -> list[bytes]:
        """The image is rebuilt from what is kept."""
        return plc.flight_read(self.cycle, self.places, self.code_id)


class SaveFlight(Operation[str], frozen=True):
    """The kept cycles as the text of a recording (`flight_recording`)."""

    op: ClassVar[str] = "flight_save"

    def run(self, plc: SoftPlc) -> str:
        """Of this moment; packing it stops no task."""
        return write_recording(plc.flight_recording())


class FreezeFlight(Operation[FlightStatus], frozen=True):
    """Keep what is recorded, or record again. An exception stays frozen until it is reset.

    Each owner holds it for himself: it records again when the last one lets go. Without an owner, letting go
    is for all.
    """

    op: ClassVar[str] = "flight_freeze"
    rest: ClassVar[Rest | None] = Rest(
        "POST", "/flight/freeze", "operator",
        lambda order: Fact("flight-freeze" if order.on else "flight-record"), state_of, _TAG,
    )  # fmt: skip
    on: bool
    owner: Owner = ANYBODY
    lease_s: Lease | None = None
    """It records again by itself after so many seconds, unless that is renewed; null: never."""

    def run(self, plc: SoftPlc) -> FlightStatus:
        """The status afterwards."""
        return plc.flight_freeze(self.on, self.owner, self.lease_s)


class RenewFlight(Operation[None], frozen=True):
    """Keep what is recorded for an owner that has frozen it; refused when it records again."""

    op: ClassVar[str] = "flight_renew"
    rest: ClassVar[Rest | None] = Rest("POST", "/flight/renew", "operator", None, tag=_TAG)
    owner: Owner
    lease_s: Lease

    def run(self, plc: SoftPlc) -> None:
        """Nothing is told."""
        plc.flight_renew(self.owner, self.lease_s)
