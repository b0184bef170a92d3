"""Recorders of a connection: values sampled by a task at the end of its cycles, sent as frames."""

from __future__ import annotations

import asyncio
from typing import Annotated, ClassVar

from msgspec import Meta, Struct

from tappet.runtime.errors import PlcError
from tappet.runtime.operations.declaration import CodeId, Count, Places, Session, SessionOperation, Text
from tappet.runtime.subscriptions import MOST_RECORDERS


class Recording(Struct, frozen=True):
    """A recorder that has begun."""

    recorder: int
    """Its number on this connection."""
    data_size: int
    """Bytes of values in a frame."""


class Record(SessionOperation[Recording], frozen=True):
    """Record (offset, size) items at the end of the cycles of a task (the bus cycle task for None)."""

    op: ClassVar[str] = "record"
    items: Places
    task: Text | None = None
    divider: Annotated[int, Meta(ge=1, le=(1 << 63) - 1)] = 1
    """Every so many cycles."""
    min_interval_ns: Count = 0
    frames: Count = 0
    """Wanted length of the ring, 0 for as many as fit into a megabyte."""
    code_id: CodeId = ""

    async def serve(self, session: Session) -> Recording:
        """Frames follow until it is ended or its application is gone."""
        if len(session.subscriptions) >= MOST_RECORDERS:
            raise PlcError(f"a connection has at most {MOST_RECORDERS} recorders")
        recorder = await asyncio.to_thread(
            session.plc.record,
            self.items,
            self.task,
            self.divider,
            self.min_interval_ns,
            self.frames,
            self.code_id,
        )
        return Recording(session.subscriptions.add(recorder), recorder.spec.data_size)


class EndRecord(SessionOperation[None], frozen=True):
    """End a recorder; nothing happens when it has ended."""

    op: ClassVar[str] = "end_record"
    recorder: Count

    async def serve(self, session: Session) -> None:
        """Its frames that are under way may still arrive."""
        recorder = session.subscriptions.remove(self.recorder)
        if recorder is not None:
            await asyncio.to_thread(session.plc.end_record, recorder)
