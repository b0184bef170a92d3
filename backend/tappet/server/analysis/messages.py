"""The seam between the web server and the analysis of a project: messages over a pair of pipes.

Contract. The server begins a worker with `Begin` and the stored objects of its project (`StoredTexts`), and
sends it every change of them. Each browser socket is a session with a number: `Attach`, any number of
`Receive` with one message of the Language Server Protocol each, unread, then `Detach`. The worker answers
with `Send`, one protocol message for one session. Everything is plain data that names no path, database or
process of the server, and nothing but libraries is read from disk; so the worker may as well run on another
host. What the worker knows can be lost at any time: `Attach` carries all that an earlier session of the
client had, and the server keeps just that.

Cost. A frame is its length (4 bytes, little endian) and a msgpack map; a key stroke is one frame of about
200 bytes there and one for each session back. The stored objects cross once when a worker starts, then only
changed ones.

Reason. The analysis takes seconds and hundreds of megabytes and runs texts of users through code that may
fail; the web server must answer meanwhile, and survive it. Ten browsers share one worker.
"""

from __future__ import annotations

import asyncio
from collections.abc import AsyncIterator
from typing import Any

import msgspec

LARGEST_FRAME = 1 << 30
"""Bytes; a longer length means that the stream is broken."""
LENGTH_BYTES = 4
LIMIT_BUFFERED = 1 << 20
"""Bytes that are read ahead."""


class Begin(msgspec.Struct, tag="begin", frozen=True):
    """The project that a worker is for, and what bounds it."""

    project_id: str
    memory_mib: int
    """Address space of the process."""
    seconds: float
    """For one request, or one step of a check; a worker that takes longer ends itself."""


class StoredObject(msgspec.Struct, frozen=True):
    """An object as it is stored: the fields of `project.model.ProjectObject`."""

    id: str
    parent_id: str | None
    kind: str
    name: str
    index: int
    revision: int
    data: dict[str, Any]


class StoredTexts(msgspec.Struct, tag="stored", frozen=True):
    """Objects that are new or have changed, and those that are gone."""

    name: str
    """Of the project."""
    objects: list[StoredObject]
    gone: list[str]


class LibrariesChanged(msgspec.Struct, tag="libraries", frozen=True):
    """Libraries have been installed or removed."""


class Document(msgspec.Struct, frozen=True):
    """A document that a client has open."""

    uri: str
    version: int
    text: str


class Attach(msgspec.Struct, tag="attach", frozen=True):
    """A new session, in place of an earlier one where fields are given."""

    session: int
    initialize: str | None = None
    """Params of `initialize` as JSON; null: the client has not begun."""
    configuration: str | None = None
    """Params of the newest `workspace/didChangeConfiguration` as JSON."""
    documents: list[Document] = []
    published: list[str] = []
    """Documents of which the client shows messages."""


class Detach(msgspec.Struct, tag="detach", frozen=True):
    """A session ends."""

    session: int


class Receive(msgspec.Struct, tag="receive", frozen=True):
    """A message of the client of a session."""

    session: int
    text: str


class Send(msgspec.Struct, tag="send", frozen=True):
    """A message for the client of a session."""

    session: int
    text: str
    answers: int | str | None = None
    """The request that this is the answer to."""
    replaces: str = ""
    """The document whose messages these are: older ones that are still unsent are out of date."""


class Exit(msgspec.Struct, tag="exit", frozen=True):
    """The client of a session has said that it ends."""

    session: int


ToWorker = Begin | StoredTexts | LibrariesChanged | Attach | Detach | Receive
FromWorker = Send | Exit
_ENCODER = msgspec.msgpack.Encoder()
_TO_WORKER = msgspec.msgpack.Decoder(ToWorker)
_FROM_WORKER = msgspec.msgpack.Decoder(FromWorker)


def frame(message: ToWorker | FromWorker) -> bytes:
    """A message with its length in front."""
    body = _ENCODER.encode(message)
    return len(body).to_bytes(LENGTH_BYTES, "little") + body


async def messages_to_worker(reader: asyncio.StreamReader) -> AsyncIterator[ToWorker]:
    """What the server says, until it ends."""
    async for body in _frames(reader):
        yield _TO_WORKER.decode(body)


async def messages_from_worker(reader: asyncio.StreamReader) -> AsyncIterator[FromWorker]:
    """What the worker says, until it ends."""
    async for body in _frames(reader):
        yield _FROM_WORKER.decode(body)


async def _frames(reader: asyncio.StreamReader) -> AsyncIterator[bytes]:
    while True:
        try:
            length = int.from_bytes(await reader.readexactly(LENGTH_BYTES), "little")
            if length > LARGEST_FRAME:
                raise ValueError(f"a frame of {length} bytes: the stream is broken")
            yield await reader.readexactly(length)
        except (asyncio.IncompleteReadError, ConnectionError):
            return
