"""The process that runs CNC programs for their editors, as the routes ask it."""

from __future__ import annotations

import sys
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from tappet.project.cnc.program import CncProgramData
from tappet.project.cnc.settings import CncSettingsData
from tappet.server.calculation import PATIENCE_S, Calculation

WORKER = (sys.executable, "-m", "tappet.server.cnc.worker")


class CncCalculator:
    """Orders about CNC programs."""

    def __init__(self, cache: Path, command: Sequence[str] = WORKER) -> None:
        """`cache` is a folder of compiled objects."""
        self._cache = str(cache)
        self._calculation = Calculation(
            command,
            "cnc",
            f"The CNC program could not be computed within {PATIENCE_S:g} s; try again with a part of it.",
            lambda reason: f"The CNC program could not be computed: {reason}.",
        )

    async def ask(self, do: str, program: CncProgramData, settings: CncSettingsData, **facts: Any) -> bytes:
        """The JSON of an answer. Raises the problems of `Calculation.ask`; 422 for what cannot be run."""
        return await self._calculation.ask(
            {
                "do": do,
                "program": program.model_dump_json(),
                "settings": settings.model_dump_json(),
                "cache": self._cache,
                **facts,
            }
        )

    async def close(self) -> None:
        """End the process."""
        await self._calculation.close()
