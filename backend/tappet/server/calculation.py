"""What is computed in a process of its own for an editor: its answers as JSON, its refusals as problems."""

from __future__ import annotations

import asyncio
from collections.abc import Sequence
from typing import Any

from tappet.server.problems import Problem
from tappet.server.worker_process import WorkerCrashedError, WorkerProcess

PATIENCE_S = 60.0
"""Longest time of an answer, the time in the queue included."""


class Calculation:
    """Orders go to one process, one after the other; it starts with the first one."""

    def __init__(self, command: Sequence[str], kind: str, what: str, advice: str) -> None:
        """`kind`: begins the slugs of problems; `what` is computed; `advice`: for when that takes long."""
        self._worker = WorkerProcess(command)
        self._kind, self._what, self._advice = kind, what, advice

    async def ask(self, order: dict[str, Any]) -> bytes:
        """The JSON of an answer.

        Raises problems: 422 for what is refused, 500 when the process died, 503 when it takes too long.
        """
        try:
            async with asyncio.timeout(PATIENCE_S):
                outcome = await self._worker.ask(order)
        except TimeoutError:
            detail = f"{self._what} could not be computed within {PATIENCE_S:g} s; {self._advice}."
            raise Problem(503, f"{self._kind}-too-large", detail) from None
        except WorkerCrashedError as error:
            detail = f"{self._what} could not be computed: {error}."
            raise Problem(500, f"{self._kind}-failed", detail) from error
        if (refusal := outcome.get("refusal")) is not None:
            fields = {} if refusal["line"] is None else {"line": refusal["line"]}
            raise Problem(422, refusal["kind"].replace("_", "-"), refusal["detail"], **fields)
        body: bytes = outcome["body"]
        return body

    async def close(self) -> None:
        """End the process."""
        await self._worker.close()
