"""The language server on standard input and output, for editors that start it themselves."""

from __future__ import annotations

import asyncio
import sys
from pathlib import Path
from typing import BinaryIO

from tappet.server.framed_messages import FrameError, frame, read_message, standard_input
from tappet.server.lsp.folder_programs import FolderPrograms, canonical_uri
from tappet.server.lsp.project_analysis import ProjectAnalysis
from tappet.server.lsp.rpc import Outgoing
from tappet.server.lsp.session import LanguageSession


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
    await serve(root, standard_input(), sys.stdout.buffer)


def main(root: Path) -> int:
    """Serve the client on the standard streams; the exit code of the process."""
    try:
        asyncio.run(_serve_standard_streams(root))
    except FrameError as error:
        print(f"tappet lsp: {error}", file=sys.stderr)
        return 2
    return 0
