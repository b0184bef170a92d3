"""The language server on standard input and output, for editors that start it themselves."""

from __future__ import annotations

import asyncio
from functools import partial
from pathlib import Path
from typing import BinaryIO

from tappet.server.framed_messages import frame, run_on_standard_streams, serve_frames
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
    try:
        await serve_frames(reader, session.receive, session.exit)
    finally:
        await session.close()
        await analysis.close()


def main(root: Path) -> int:
    """Serve the client on the standard streams; the exit code of the process."""
    return run_on_standard_streams("tappet lsp", partial(serve, root))
