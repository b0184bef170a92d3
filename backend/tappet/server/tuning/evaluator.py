"""The process that evaluates measurements, as the service asks it."""

from __future__ import annotations

import asyncio
import sys
from collections.abc import Sequence
from dataclasses import asdict
from typing import Any

from tappet.motion.axis_measurement import AxisFacts, FrameLayout
from tappet.runtime.recorder import Frame
from tappet.server.problems import Problem
from tappet.server.worker_process import WorkerCrashedError, WorkerProcess
from tappet.translation.language import Language

WORKER = (sys.executable, "-m", "tappet.server.tuning.worker")
PATIENCE_S = 60.0
"""Longest time of an answer, the time in the queue included."""


class MeasurementEvaluator:
    """Orders go to one process, one after the other; it starts with the first one."""

    def __init__(self, command: Sequence[str] = WORKER) -> None:
        self._worker = WorkerProcess(command)

    async def ask(
        self,
        known: dict[str, Any],
        frames: Sequence[Frame],
        layout: FrameLayout,
        facts: AxisFacts,
        language: Language,
    ) -> bytes:
        """The JSON of AxisMeasured, with what is known of it. Raises problems: 500, 503 when it fails."""
        order = {
            "known": known,
            "cycles": [frame.cycle for frame in frames],
            "frames": [frame.data for frame in frames],
            "codes": layout.codes,
            "phases": list(layout.phases.items()),
            "facts": asdict(facts),
            "language": language,
        }
        try:
            async with asyncio.timeout(PATIENCE_S):
                outcome = await self._worker.ask(order)
        except TimeoutError:
            detail = (
                f"The measurement could not be evaluated within {PATIENCE_S:g} s; measure for a shorter time."
            )
            raise Problem(503, "measurement-too-long", detail) from None
        except WorkerCrashedError as error:
            raise Problem(500, "evaluation-failed", f"The measurement was not evaluated: {error}.") from error
        body: bytes = outcome["body"]
        return body

    async def close(self) -> None:
        """End the process."""
        await self._worker.close()
