"""The source of the application in the controller: stored with a download or on demand, read back."""

from __future__ import annotations

import asyncio
from typing import TYPE_CHECKING, Annotated, ClassVar

from msgspec import Meta

from tappet.runtime.operations.declaration import (
    Fact,
    Operation,
    OperationError,
    Rest,
    Session,
    SessionOperation,
)
from tappet.runtime.operations.download import CHUNK
from tappet.runtime.source_archive import MAX_SOURCE, SourceInfo, SourceNote

if TYPE_CHECKING:
    from tappet.runtime.plc import SoftPlc

Label = Annotated[str, Meta(max_length=400)]


class _Arriving:
    """What has arrived of an archive over one connection."""

    def __init__(self) -> None:
        self.size = 0
        self.data: bytearray | None = None


class BeginSource(SessionOperation[None], frozen=True):
    """Announces an archive; what was sent of another one is dropped."""

    op: ClassVar[str] = "source_begin"
    size: Annotated[int, Meta(ge=1, le=MAX_SOURCE)]

    async def serve(self, session: Session) -> None:
        """Make room."""
        arriving = session.own(_Arriving)
        arriving.size, arriving.data = self.size, bytearray()


class SourceChunk(SessionOperation[None], frozen=True):
    """The next bytes of the archive."""

    op: ClassVar[str] = "source_chunk"
    data: Annotated[bytes, Meta(max_length=CHUNK)]

    async def serve(self, session: Session) -> None:
        """Keep them."""
        arriving = session.own(_Arriving)
        if arriving.data is None:
            raise OperationError("bad_request", "source_chunk: no source has begun")
        if len(arriving.data) + len(self.data) > arriving.size:
            arriving.data = None
            raise OperationError(
                "bad_request", f"source_chunk: more than the announced {arriving.size} bytes"
            )
        arriving.data += self.data


class CommitSource(SessionOperation[SourceInfo | None], frozen=True):
    """Keeps the archive that has arrived, in place of the one that is there."""

    op: ClassVar[str] = "source_commit"
    project: Label
    stored_by: Label
    stored_at_ms: Annotated[int, Meta(ge=0, lt=1 << 53)]
    code_id: Label

    async def serve(self, session: Session) -> SourceInfo | None:
        """Off the event loop: it waits for the disk."""
        arriving = session.own(_Arriving)
        data, arriving.data = arriving.data, None
        if data is None or len(data) != arriving.size:
            got = 0 if data is None else len(data)
            raise OperationError("bad_request", f"source_commit: {got} of {arriving.size} bytes arrived")
        note = SourceNote(self.project, self.stored_by, self.stored_at_ms, self.code_id)
        await asyncio.to_thread(session.plc.keep_source, note, bytes(data))
        return await asyncio.to_thread(session.plc.source_info)


class GetSource(Operation[SourceInfo | None], frozen=True):
    """The source that is kept in the controller; null when there is none."""

    op: ClassVar[str] = "source_info"
    rest: ClassVar[Rest | None] = Rest("GET", "/source", "viewer", None)

    def run(self, plc: SoftPlc) -> SourceInfo | None:
        """Look at its head."""
        return plc.source_info()


class ReadSource(Operation[bytes], frozen=True):
    """A part of the archive with this digest."""

    op: ClassVar[str] = "source_read"
    digest: Label
    offset: Annotated[int, Meta(ge=0, le=MAX_SOURCE)]
    size: Annotated[int, Meta(ge=1, le=CHUNK)]

    def run(self, plc: SoftPlc) -> bytes:
        """From the disk."""
        return plc.source.read(self.digest, self.offset, self.size)


class RemoveSource(Operation[None], frozen=True):
    """Delete the source in the controller."""

    op: ClassVar[str] = "source_remove"
    rest: ClassVar[Rest | None] = Rest("DELETE", "/source", "engineer", lambda _: Fact("source-deleted"))

    def run(self, plc: SoftPlc) -> None:
        """It is gone for good."""
        plc.remove_source()
