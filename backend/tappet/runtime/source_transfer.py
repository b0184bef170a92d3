"""The source of an application over the wire, in chunks: what the server and the command line use."""

from __future__ import annotations

import hashlib
import time
from typing import Protocol

from tappet.runtime.errors import PlcError
from tappet.runtime.operations.declaration import Reply, WireOperation
from tappet.runtime.operations.download import CHUNK
from tappet.runtime.operations.source import BeginSource, CommitSource, GetSource, ReadSource, SourceChunk
from tappet.runtime.source_archive import MAX_SOURCE, SourceInfo


class Caller(Protocol):
    """A connection to a runtime."""

    async def call(self, operation: WireOperation[Reply]) -> Reply:
        """The reply to an operation."""


class SourceError(PlcError):
    """There is no source, or it did not arrive as it is."""


async def send_source(
    client: Caller, archive: bytes, *, project: str, stored_by: str, code_id: str
) -> SourceInfo | None:
    """Keep the archive of a project in the controller. Raises SourceError for one that is too large, and
    what calls raise."""
    if len(archive) > MAX_SOURCE:
        raise SourceError(
            f"the archive of the project has {len(archive) / (1 << 20):.1f} MiB; a controller keeps at most "
            f"{MAX_SOURCE >> 20} MiB"
        )
    await client.call(BeginSource(len(archive)))
    for at in range(0, len(archive), CHUNK):
        await client.call(SourceChunk(archive[at : at + CHUNK]))
    return await client.call(CommitSource(project, stored_by, time.time_ns() // 1_000_000, code_id))


async def read_source(client: Caller) -> tuple[SourceInfo, bytes]:
    """The archive in the controller. Raises SourceError, and what calls raise."""
    info = await client.call(GetSource())
    if info is None:
        raise SourceError("there is no source in this controller; store it with a download, or on demand")
    if info.size > MAX_SOURCE:
        raise SourceError(f"the controller says that its source has {info.size} bytes, which is too much")
    archive = bytearray()
    while len(archive) < info.size:
        part = await client.call(ReadSource(info.digest, len(archive), CHUNK))
        if not part:
            break
        archive += part
    if hashlib.sha256(archive).hexdigest() != info.digest:
        raise SourceError("the source in the controller is damaged: its digest is another one")
    return info, bytes(archive)
