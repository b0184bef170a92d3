"""The language server on standard input and output, for editors that start it themselves."""

from __future__ import annotations

import asyncio
import contextlib
import os
import sys
import threading
from pathlib import Path
from typing import BinaryIO

from tappet.server.lsp.folder_programs import FolderPrograms, canonical_uri
from tappet.server.lsp.project_analysis import ProjectAnalysis
from tappet.server.lsp.rpc import Outgoing
from tappet.server.lsp.session import LanguageSession

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


async def serve(root: Path, reader: asyncio.StreamReader, output: BinaryIO) -> None:
    """Serve one client until it ends. Raises FrameError when it speaks something else."""

    async def send(message: Outgoing) -> None:
        output.write(frame(message.text))
        output.flush()

    analysis = ProjectAnalysis(FolderPrograms(root))
    session = LanguageSession(analysis, send, advise=True, canonical=canonical_uri)
    leaving = asyncio.create_task(session.exit.wait())
    try:
        while not session.exit.is_set():
            reading = asyncio.create_task(read_message(reader))
            await asyncio.wait({reading, leaving}, return_when=asyncio.FIRST_COMPLETED)
            if not reading.done():
                reading.cancel()
                return
            message = reading.result()
            if message is None:
                return
            await session.receive(message)
    finally:
        leaving.cancel()
        await session.close()
        await analysis.close()


async def _serve_standard_streams(root: Path) -> None:
    reader = asyncio.StreamReader()
    loop = asyncio.get_running_loop()

    def feed() -> None:  # a thread, because not every system can wait for its standard input
        with contextlib.suppress(RuntimeError):  # the loop has ended
            while data := os.read(sys.stdin.fileno(), 65536):
                loop.call_soon_threadsafe(reader.feed_data, data)
            loop.call_soon_threadsafe(reader.feed_eof)

    threading.Thread(target=feed, name="stdin", daemon=True).start()
    await serve(root, reader, sys.stdout.buffer)


def main(root: Path) -> int:
    """Serve the client on the standard streams; the exit code of the process."""
    try:
        asyncio.run(_serve_standard_streams(root))
    except FrameError as error:
        print(f"tappet lsp: {error}", file=sys.stderr)
        return 2
    return 0
