"""Samples of one record that somebody looks at, and the time of it that is asked for."""

from __future__ import annotations

from contextlib import AbstractContextManager, nullcontext
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, NamedTuple

from tappet.server.problems import Problem
from tappet.traces.recording import RecordInfo

if TYPE_CHECKING:
    from tappet.traces.samples import Samples

BINARY = "application/vnd.tappet.samples"


class Span(NamedTuple):
    """Unix times in ns; None: from the first sample, to the last one."""

    start: int | None
    end: int | None


@dataclass(frozen=True, slots=True)
class Shown:
    """Samples of one record."""

    samples: Samples
    info: RecordInfo
    first_number: int = 0
    lock: AbstractContextManager[Any] = field(default_factory=nullcontext)

    def channel(self, number: int) -> int:
        """A channel; raises a 404 problem."""
        if number >= len(self.samples.channels):
            raise Problem(404, "not-found", f"The record '{self.info.name}' has no channel number {number}.")
        return number
