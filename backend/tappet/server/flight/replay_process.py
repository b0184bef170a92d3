"""Replays of a server: each in a process of its own, which is killed when nobody waits for it any more."""

from __future__ import annotations

import asyncio
from collections.abc import Callable
from contextlib import suppress

from tappet.runtime.replay_process import COMMAND, LIMIT_S, ReplayOrder, ReplayResult, packed, unpacked

Started = Callable[[asyncio.subprocess.Process], None]
"""Gets the process, so that it can be ended from elsewhere."""


async def run_replay(order: ReplayOrder, started: Started | None = None) -> ReplayResult:
    """Carries an order out and waits for its end."""
    child = await asyncio.create_subprocess_exec(
        *COMMAND, stdin=asyncio.subprocess.PIPE, stdout=asyncio.subprocess.PIPE
    )
    if started is not None:
        started(child)
    try:
        async with asyncio.timeout(LIMIT_S):
            output, _ = await child.communicate(packed(order))
    except TimeoutError:
        return unpacked(b"", None)
    finally:
        if child.returncode is None:
            with suppress(ProcessLookupError):
                child.kill()
            await child.wait()
    return unpacked(output, child.returncode)
