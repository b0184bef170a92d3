"""What is computed in a process of its own for an editor: its answers as JSON, its refusals as problems."""

from __future__ import annotations

import asyncio
from collections.abc import Callable, Sequence
from typing import Any

from tappet.server.problems import Problem
from tappet.server.worker_process import WorkerCrashedError, WorkerProcess

PATIENCE_S = 60.0
"""Longest time of an answer, the time in the queue included."""


class Calculation:
    """Orders go to one process, one after the other; it starts with the first one."""

    def __init__(
        self, command: Sequence[str], kind: str, too_large: str, failed: Callable[[str], str]
    ) -> None:
        """`kind`: begins slugs of problems; `too_large` is said after PATIENCE_S, `failed` of a reason."""
        self._worker = WorkerProcess(command)
        self._kind, self._too_large, self._failed = kind, too_large, failed

    async def ask(self, order: dict[str, Any]) -> bytes:
        """The JSON of an answer.

        Raises problems: 422 for what is refused, 500 when the process died, 503 when it takes too long.
        """
        try:
            async with asyncio.timeout(PATIENCE_S):
                outcome = await self._worker.ask(order)
        except TimeoutError:
            raise Problem(503, f"{self._kind}-too-large", self._too_large) from None
        except WorkerCrashedError as error:
            raise Problem(500, f"{self._kind}-failed", self._failed(str(error))) from error
        if (refusal := outcome.get("refusal")) is not None:
            fields = {} if refusal["line"] is None else {"line": refusal["line"]}
            raise Problem(422, refusal["kind"].replace("_", "-"), refusal["detail"], **fields)
        body: bytes = outcome["body"]
        return body

    async def close(self) -> None:
        """End the process."""
        await self._worker.close()
