"""Why an application is in the state exception, as an engineer reads it (decision 8)."""

from __future__ import annotations

from dataclasses import dataclass, field

from tappet.iec.places import Place


@dataclass(frozen=True, slots=True)
class CallFrame:
    """One level of the call stack, the innermost first."""

    pou: str
    uri: str
    line: int
    """1-based line in the source text `uri`; 0 when unknown."""
    place: Place | None = None
    """What an editor shows for the line; None for library texts and texts that are documents of their own."""


@dataclass(frozen=True, slots=True)
class ExceptionReport:
    """Why an application is in the state exception."""

    code: int
    name: str
    message: str
    task: str
    pou: str
    uri: str
    line: int
    cycle: int
    timestamp_ns: int
    call_stack: tuple[CallFrame, ...] = ()
    values: dict[str, str] = field(default_factory=dict)
    """Numbers of the fault itself (index, low, high, address ...) and variables of the programs in the call
    stack.
    """
    place: Place | None = None
    """What an editor shows for the line; None for library texts and texts that are documents of their own."""


def summary(report: ExceptionReport) -> str:
    """One line for the log, with the line as the editor counts it where that is known."""
    place = f" in {report.pou}" if report.pou else ""
    line = report.place.span.line + 1 if report.place is not None else report.line
    return f"task {report.task}: {report.message}{place}{f', line {line}' if line else ''}"
