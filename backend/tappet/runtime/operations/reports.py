"""Why an application has stopped, and the log of the runtime."""

from __future__ import annotations

from typing import TYPE_CHECKING, ClassVar

from tappet.runtime.exception_report import ExceptionReport
from tappet.runtime.logbook import LogEntry
from tappet.runtime.operations.declaration import Count, Operation

if TYPE_CHECKING:
    from tappet.runtime.plc import SoftPlc


class GetException(Operation[ExceptionReport | None], frozen=True):
    """Why the application is in the state exception; nothing when it is not."""

    op: ClassVar[str] = "exception"

    def run(self, plc: SoftPlc) -> ExceptionReport | None:
        """Makes the report when there is none yet."""
        return plc.exception()


class ReadLog(Operation[list[LogEntry]], frozen=True):
    """Log entries with a higher number than `since`."""

    op: ClassVar[str] = "log"
    since: Count = 0

    def run(self, plc: SoftPlc) -> list[LogEntry]:
        """Oldest first."""
        return plc.log.since(self.since)
