"""The process that computes cams, as the routes ask it."""

from __future__ import annotations

import asyncio
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from tappet.project.cams.table import CamTable
from tappet.server.problems import Problem
from tappet.server.worker_process import WorkerCrashedError, WorkerProcess

WORKER = (sys.executable, "-m", "tappet.server.cams.worker")
PATIENCE_S = 60.0
"""Longest time of an answer, the time in the queue included."""


class CamCalculator:
    """Orders go to one process, one after the other; it starts with the first one."""

    def __init__(self, cache: Path, command: Sequence[str] = WORKER) -> None:
        """`cache` is a folder of compiled objects."""
        self._cache = str(cache)
        self._worker = WorkerProcess(command)

    async def ask(self, do: str, cam: CamTable, **facts: Any) -> bytes:
        """The JSON of an answer.

        Raises problems: 422 for what is no cam, 500 when the process died, 503 when it takes too long.
        """
        order = {"do": do, "cam": cam.model_dump_json(), "cache": self._cache, **facts}
        try:
            async with asyncio.timeout(PATIENCE_S):
                outcome = await self._worker.ask(order)
        except TimeoutError:
            detail = f"The cam could not be computed within {PATIENCE_S:g} s; try again with fewer points."
            raise Problem(503, "cam-too-large", detail) from None
        except WorkerCrashedError as error:
            raise Problem(500, "cam-failed", f"The cam could not be computed: {error}.") from error
        if (refusal := outcome.get("refusal")) is not None:
            fields = {} if refusal["line"] is None else {"line": refusal["line"]}
            raise Problem(422, refusal["kind"].replace("_", "-"), refusal["detail"], **fields)
        body: bytes = outcome["body"]
        return body

    async def close(self) -> None:
        """End the process."""
        await self._worker.close()
