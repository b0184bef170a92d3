"""Loading an application: a package comes in chunks over one connection and is then committed."""

from __future__ import annotations

import asyncio
from typing import TYPE_CHECKING, Annotated, ClassVar, Literal

from msgspec import Meta

from tappet.runtime.image import ImageMemory
from tappet.runtime.operations.declaration import Operation, OperationError, Rest, Session, SessionOperation
from tappet.runtime.state import RuntimeInfo

if TYPE_CHECKING:
    from tappet.runtime.plc import SoftPlc

CHUNK = 1 << 20
"""Bytes of a package per message."""
MAX_PACKAGE = 512 << 20


class ReadImageMemory(Operation[ImageMemory | None], frozen=True):
    """The memory of the variables with its reserve for online changes; null without an application."""

    op: ClassVar[str] = "image_memory"
    rest: ClassVar[Rest | None] = Rest("GET", "/image-memory", "viewer", None)

    def run(self, plc: SoftPlc) -> ImageMemory | None:
        """As of now."""
        return plc.image_memory()


class Upload:
    """What has arrived of a package over one connection."""

    def __init__(self) -> None:
        self.size = 0
        self.data: bytearray | None = None


class BeginDownload(SessionOperation[None], frozen=True):
    """Announces a package; what was sent of another one is dropped."""

    op: ClassVar[str] = "download_begin"
    size: Annotated[int, Meta(ge=0, le=MAX_PACKAGE)]

    async def serve(self, session: Session) -> None:
        """Make room."""
        upload = session.own(Upload)
        upload.size, upload.data = self.size, bytearray()


class DownloadChunk(SessionOperation[None], frozen=True):
    """The next bytes of the package."""

    op: ClassVar[str] = "download_chunk"
    data: Annotated[bytes, Meta(max_length=CHUNK)]

    async def serve(self, session: Session) -> None:
        """Keep them."""
        upload = session.own(Upload)
        if upload.data is None:
            raise OperationError("bad_request", "download_chunk: no download has begun")
        if len(upload.data) + len(self.data) > upload.size:
            upload.data = None
            raise OperationError(
                "bad_request", f"download_chunk: more than the announced {upload.size} bytes"
            )
        upload.data += self.data


class CommitDownload(SessionOperation[RuntimeInfo], frozen=True):
    """Loads the package that has arrived; a refused one leaves the application as it was."""

    op: ClassVar[str] = "download_commit"
    mode: Literal["download", "online_change"]

    async def serve(self, session: Session) -> RuntimeInfo:
        """Off the event loop: linking takes its time."""
        upload = session.own(Upload)
        data, upload.data = upload.data, None
        if data is None or len(data) != upload.size:
            got = 0 if data is None else len(data)
            raise OperationError("bad_request", f"download_commit: {got} of {upload.size} bytes arrived")
        await asyncio.to_thread(session.plc.download, bytes(data), self.mode)
        return await asyncio.to_thread(session.plc.info)
