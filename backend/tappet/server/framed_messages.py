"""Messages with a Content-Length header, as language servers and debug adapters frame them on streams."""

from __future__ import annotations

import asyncio
import contextlib
import os
import sys
import threading
from collections.abc import Awaitable, Callable, Coroutine
from typing import Any, BinaryIO

MAX_MESSAGE = 64 * 1024 * 1024
"""Bytes of one message."""


class FrameError(ValueError):
    """What came is no message of the base protocol."""


async def read_message(reader: asyncio.StreamReader) -> str | None:
    """The next message; None at the end. Raises FrameError for a header that is none."""
    length: int | None = None
    while True:
        try:
            line = await reader.readline()
        except ValueError as error:  # longer than the reader's limit
            raise FrameError("A header line has no end") from error
        if not line:
            return None
        if line in (b"\r\n", b"\n"):
            if length is None:
                raise FrameError("The header has no Content-Length")
            break
        name, colon, value = line.decode("ascii", "replace").partition(":")
        if not colon:
            raise FrameError(f"'{line[:40]!r}' is no header line")
        if name.strip().lower() == "content-length":
            if not value.strip().isdigit() or int(value) > MAX_MESSAGE:
                raise FrameError(f"Content-Length is {value.strip()[:20]}; at most {MAX_MESSAGE}")
            length = int(value)
    try:
        return (await reader.readexactly(length)).decode("utf-8")
    except asyncio.IncompleteReadError:
        return None
    except UnicodeDecodeError as error:
        raise FrameError("The message is not UTF-8") from error


def frame(message: str) -> bytes:
    """A message with its header."""
    body = message.encode("utf-8")
    return b"Content-Length: %d\r\n\r\n%b" % (len(body), body)


def standard_input() -> asyncio.StreamReader:
    """The standard input of the process, read by a thread, because not every system can wait for it."""
    reader = asyncio.StreamReader()
    loop = asyncio.get_running_loop()

    def feed() -> None:
        with contextlib.suppress(RuntimeError):  # the loop has ended
            while data := os.read(sys.stdin.fileno(), 65536):
                loop.call_soon_threadsafe(reader.feed_data, data)
            loop.call_soon_threadsafe(reader.feed_eof)

    threading.Thread(target=feed, name="stdin", daemon=True).start()
    return reader


async def serve_frames(
    reader: asyncio.StreamReader, receive: Callable[[str], Awaitable[None]], ended: asyncio.Event
) -> None:
    """Give each message to `receive` until the stream or the conversation ends. Raises FrameError."""
    leaving = asyncio.create_task(ended.wait())
    try:
        while not ended.is_set():
            reading = asyncio.create_task(read_message(reader))
            await asyncio.wait({reading, leaving}, return_when=asyncio.FIRST_COMPLETED)
            if not reading.done():
                reading.cancel()
                return
            message = reading.result()
            if message is None:
                return
            await receive(message)
    finally:
        leaving.cancel()


def run_on_standard_streams(
    name: str, serve: Callable[[asyncio.StreamReader, BinaryIO], Coroutine[Any, Any, None]]
) -> int:
    """The exit code of a process that serves one client; what the client did wrong goes to standard error."""

    async def run() -> None:
        await serve(standard_input(), sys.stdout.buffer)

    try:
        asyncio.run(run())
    except FrameError as error:
        print(f"{name}: {error}", file=sys.stderr)
        return 2
    return 0
