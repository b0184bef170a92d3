"""Why an application has stopped, and the log of the runtime."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Annotated, Any, ClassVar, Literal

from msgspec import Meta, Struct

from tappet.runtime import exception_report, logbook
from tappet.runtime.operations.declaration import Operation, Rest
from tappet.runtime.operations.instants import Instant, instant_of

if TYPE_CHECKING:
    from tappet.runtime.plc import SoftPlc


@dataclass(frozen=True, slots=True, kw_only=True)
class CodePlace:
    """A place in the program. Object and part are known for what was built from a project."""

    pou: str | None
    uri: str | None
    object_id: str | None
    part: Literal["declaration", "implementation"] | None
    element: Annotated[str | None, Meta(description="Id of the element in a drawn part.")]
    line: Annotated[
        int | None, Meta(description="From 1: in the part, or in the whole text where no part is known.")
    ]


@dataclass(frozen=True, slots=True, kw_only=True)
class CallFrame(CodePlace):
    """One level of the call stack, the innermost first."""


@dataclass(frozen=True, slots=True, kw_only=True)
class RuntimeException(CodePlace):
    """Why an application stopped."""

    SENTENCES: ClassVar = ("message",)

    code: int
    name: Annotated[str, Meta(description="Name of the code, such as `DIV_ZERO`.")]
    message: str
    task: str
    call_stack: list[CallFrame]
    values: Annotated[
        dict[str, str],
        Meta(description="Numbers of the fault and variables of the programs, as literals."),
    ]


class LogEntry(Struct, frozen=True):
    """One line of a runtime's log."""

    SENTENCES: ClassVar = ("message",)

    id: int
    at: Instant
    severity: str
    component: str
    message: str


def exception_of(report: exception_report.ExceptionReport | None) -> RuntimeException | None:
    """The report as people read it."""
    if report is None:
        return None
    return RuntimeException(
        code=report.code,
        name=report.name,
        message=report.message,
        task=report.task,
        **_place(report),
        call_stack=[CallFrame(**_place(frame)) for frame in report.call_stack],
        values=report.values,
    )


def _place(of: exception_report.ExceptionReport | exception_report.CallFrame) -> dict[str, Any]:
    place = of.place
    line = place.span.line + 1 if place is not None else of.line
    return {
        "pou": of.pou or None,
        "uri": of.uri or None,
        "object_id": place.object_id if place is not None else None,
        "part": (place.part or None) if place is not None else None,
        "element": place.element if place is not None else None,
        "line": line or None,
    }


def entries_of(entries: list[logbook.LogEntry]) -> list[LogEntry]:
    """The log as people read it."""
    return [
        LogEntry(e.number, instant_of(e.timestamp_ns), e.severity, e.component, e.message) for e in entries
    ]


class GetException(Operation[exception_report.ExceptionReport | None], frozen=True):
    """Why the application stopped, with call stack and values; null when it did not."""

    op: ClassVar[str] = "exception"
    of_recordings: ClassVar[bool] = True
    rest: ClassVar[Rest | None] = Rest("GET", "/exception", "viewer", None, exception_of)

    def run(self, plc: SoftPlc) -> exception_report.ExceptionReport | None:
        """Makes the report when there is none yet."""
        return plc.exception()


class ReadLog(Operation[list[logbook.LogEntry]], frozen=True):
    """Lines of the runtime's log after `since`, oldest first."""

    op: ClassVar[str] = "log"
    rest: ClassVar[Rest | None] = Rest("GET", "/log", "viewer", None, entries_of)
    since: Annotated[int, Meta(ge=0, le=(1 << 63) - 1, description="Id of the last known line.")] = 0

    def run(self, plc: SoftPlc) -> list[logbook.LogEntry]:
        """What the log still holds."""
        return plc.log.since(self.since)
