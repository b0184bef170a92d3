"""The process that computes cams, as the routes ask it."""

from __future__ import annotations

import sys
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from tappet.project.cams.table import CamTable
from tappet.server.calculation import PATIENCE_S, Calculation

WORKER = (sys.executable, "-m", "tappet.server.cams.worker")


class CamCalculator:
    """Orders about cams."""

    def __init__(self, cache: Path, command: Sequence[str] = WORKER) -> None:
        """`cache` is a folder of compiled objects."""
        self._cache = str(cache)
        self._calculation = Calculation(
            command,
            "cam",
            f"The cam could not be computed within {PATIENCE_S:g} s; try again with fewer points.",
            lambda reason: f"The cam could not be computed: {reason}.",
        )

    async def ask(self, do: str, cam: CamTable, **facts: Any) -> bytes:
        """The JSON of an answer. Raises the problems of `Calculation.ask`; 422 for what is no cam."""
        return await self._calculation.ask(
            {"do": do, "cam": cam.model_dump_json(), "cache": self._cache, **facts}
        )

    async def close(self) -> None:
        """End the process."""
        await self._calculation.close()
