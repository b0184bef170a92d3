"""What comes of a replay of the flight recorder."""

from __future__ import annotations

from dataclasses import dataclass, field

from tappet.codegen.faults import Fault
from tappet.runtime.errors import PlcError
from tappet.runtime.exception_report import ExceptionReport
from tappet.runtime.replay_comparison import Difference


class ReplayError(PlcError):
    """The recording cannot be replayed."""


@dataclass(frozen=True, slots=True)
class Replayed:
    """What came of a replay."""

    cycles: int
    """Cycles that were run."""
    last_cycle: int
    recorded: ExceptionReport | None
    fault: ExceptionReport | None
    difference: Difference | None = None
    """On other code of the variables that both have: what its changes came to, no fault of the replay."""
    notes: tuple[str, ...] = ()
    """What could not be replayed as it was."""
    values: dict[str, str] = field(default_factory=dict)
    """What was asked for, as IEC literals after the last cycle."""

    @property
    def same_fault(self) -> bool:
        """Whether it ended as the recorded run did: with an exception of that kind at that place, or with
        none."""
        if self.recorded is None or self.fault is None:
            return self.recorded is self.fault
        return _what(self.recorded) == _what(self.fault)


def _what(report: ExceptionReport) -> tuple[object, ...]:
    """What makes a fault the same one. Where a cycle was that took too long is a matter of time."""
    if report.name == Fault.WATCHDOG.name:
        return report.name, report.task.upper()
    return report.name, report.pou.upper(), report.line, report.task.upper()
