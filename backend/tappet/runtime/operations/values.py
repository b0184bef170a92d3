"""Reading, writing and forcing bytes of the image."""

from __future__ import annotations

import asyncio
import time
from typing import TYPE_CHECKING, Annotated, ClassVar

from msgspec import Meta, Struct

from tappet.codegen.symbol_types import Bit
from tappet.runtime.forces import Origin, PlacedValue
from tappet.runtime.operations.declaration import (
    MAX_ITEMS,
    CodeId,
    Offset,
    Operation,
    Places,
    Session,
    SessionOperation,
    Text,
    Values,
)
from tappet.runtime.places import Place

if TYPE_CHECKING:
    from tappet.runtime.plc import SoftPlc

WRITE_TIMEOUT_S = 1.0
_POLL_S = 0.001


class ForcedValue(Struct, frozen=True):
    """A forced variable: its place, the forced bytes, the bytes before, its path when it has one, and who has
    forced it, by what and when.
    """

    offset: int
    bit: int | None
    data: bytes
    before: bytes
    path: str | None
    user: str = ""
    source: str = ""
    at_ns: int = 0
    program: str = ""
    address: str = ""


class Read(Operation[list[bytes]], frozen=True):
    """Bytes at (offset, size) places, all of one moment."""

    op: ClassVar[str] = "read"
    of_recordings: ClassVar[bool] = True
    places: Places
    code_id: CodeId = ""

    def run(self, plc: SoftPlc) -> list[bytes]:
        """Waits for properties that are monitored by a call."""
        return plc.read(self.places, self.code_id)


class Write(SessionOperation[bool], frozen=True):
    """Store values together at a cycle begin.

    True when that has happened, False when the task takes longer than a second to its next cycle.
    """

    op: ClassVar[str] = "write"
    values: Values
    code_id: CodeId = ""

    async def serve(self, session: Session) -> bool:
        """Waits without a thread of its own."""
        done = await asyncio.to_thread(session.plc.write, _placed(self.values), self.code_id)
        waited = 0.0
        while not (finished := await asyncio.to_thread(done)) and waited < WRITE_TIMEOUT_S:
            await asyncio.sleep(_POLL_S)
            waited += _POLL_S
        return finished


class Force(Operation[None], frozen=True):
    """Hold places at values until they are released."""

    op: ClassVar[str] = "force"
    values: Values
    user: Text = ""
    source: Text = "wire"
    program: Text = ""
    address: Text = ""
    code_id: CodeId = ""

    def run(self, plc: SoftPlc) -> None:
        """From the next cycle on."""
        origin = Origin(self.user, self.source, time.time_ns(), self.program, self.address)
        plc.force(_placed(self.values), origin, self.code_id)


class Unforce(Operation[int], frozen=True):
    """Release (offset, bit) places, all with None; `restore` brings the values before back (WAT-09)."""

    op: ClassVar[str] = "unforce"
    keys: Annotated[list[tuple[Offset, Bit | None]], Meta(max_length=MAX_ITEMS)] | None
    restore: bool = False
    code_id: CodeId = ""

    def run(self, plc: SoftPlc) -> int:
        """How many were released."""
        return plc.unforce(self.keys, restore=self.restore, code_id=self.code_id)


class ListForces(Operation[list[ForcedValue]], frozen=True):
    """All forces."""

    op: ClassVar[str] = "forces"
    of_recordings: ClassVar[bool] = True

    def run(self, plc: SoftPlc) -> list[ForcedValue]:
        """In the order in which they were set."""
        return [
            ForcedValue(
                f.value.place.offset, f.value.place.bit, f.value.data, f.before, path,
                f.origin.user, f.origin.source, f.origin.at_ns, f.origin.program, f.origin.address,
            )
            for f, path in plc.forces()
        ]  # fmt: skip


def _placed(rows: list[tuple[int, bytes, int | None]]) -> list[PlacedValue]:
    return [PlacedValue(Place(offset, len(data), bit), data) for offset, data, bit in rows]
