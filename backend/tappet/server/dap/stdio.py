"""The debug adapter on standard input and output, for editors that start it themselves."""

from __future__ import annotations

import asyncio
import sys
from typing import BinaryIO

from tappet.server.dap.session import Begin, DebugSession
from tappet.server.framed_messages import FrameError, frame, read_message, standard_input


async def serve(begin: Begin, reader: asyncio.StreamReader, output: BinaryIO) -> None:
    """Serve one client until it ends. Raises FrameError when it speaks something else."""

    async def send(message: str) -> None:
        output.write(frame(message))
        output.flush()

    session = DebugSession(send, begin)
    leaving = asyncio.create_task(session.ended.wait())
    try:
        while not session.ended.is_set():
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


def main(begin: Begin) -> int:
    """Serve the client on the standard streams; the exit code of the process."""

    async def run() -> None:
        await serve(begin, standard_input(), sys.stdout.buffer)

    try:
        asyncio.run(run())
    except FrameError as error:
        print(f"tappet dap: {error}", file=sys.stderr)
        return 2
    return 0
