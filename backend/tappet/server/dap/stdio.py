"""The debug adapter on standard input and output, for editors that start it themselves."""

from __future__ import annotations

import asyncio
from functools import partial
from typing import BinaryIO

from tappet.server.dap.session import Begin, DebugSession
from tappet.server.framed_messages import frame, run_on_standard_streams, serve_frames


async def serve(begin: Begin, reader: asyncio.StreamReader, output: BinaryIO) -> None:
    """Serve one client until it ends. Raises FrameError when it speaks something else."""

    async def send(message: str) -> None:
        output.write(frame(message))
        output.flush()

    session = DebugSession(send, begin)
    try:
        await serve_frames(reader, session.receive, session.ended)
    finally:
        await session.close()


def main(begin: Begin) -> int:
    """Serve the client on the standard streams; the exit code of the process."""
    return run_on_standard_streams("tappet dap", partial(serve, begin))
