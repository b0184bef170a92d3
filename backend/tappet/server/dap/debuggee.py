"""What a debug session needs of the soft PLC: in the terms of the debugger, not of the protocol.

Contract: calls raise `Refused` with a sentence for the user when something is not possible, ConnectionError
when the runtime is gone, or its application (ApplicationReplaced). Lines count from 1 and are those of files.
Reason: the session is tested on a debuggee in memory; `runtime_debuggee` is the one on a runtime.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Literal, Protocol

from tappet.runtime.debugger.shapes import Hits

HaltReason = Literal["breakpoint", "step", "pause", "data", "run_to", "exception"]
Command = Literal["continue", "pause", "step_into", "step_over", "step_out"]


class Refused(ValueError):  # noqa: N818 - the event, not an error class of the field
    """It is not possible; the sentence says why."""


class ApplicationReplaced(ConnectionError):  # noqa: N818 - the event, not an error class of the field
    """The runtime runs another application than the one that is debugged."""


@dataclass(frozen=True, slots=True)
class Location:
    """A line of a file, or of a text that only the debuggee has."""

    name: str
    line: int
    path: str | None = None
    reference: str | None = None
    """By which the client asks for a text that it does not have as a file: of a library, of an object."""


@dataclass(frozen=True, slots=True)
class Halt:
    """A task that stands in the midst of its cycle, or behind an exception."""

    task: str
    reason: HaltReason
    breakpoint: str | None = None
    message: str | None = None


@dataclass(frozen=True, slots=True)
class State:
    """What stands, and what the breakpoints are."""

    application: str
    """run, stop, exception or empty."""
    sequence: int
    halts: tuple[Halt, ...]
    all_stand: bool
    """Whether the other tasks stand with the halted one."""


@dataclass(frozen=True, slots=True)
class Wanted:
    """A breakpoint as the user wants it."""

    line: int = 0
    variable: str | None = None
    """Of a data breakpoint."""
    condition: str | None = None
    hits: Hits = field(default_factory=Hits)
    log: str | None = None


@dataclass(frozen=True, slots=True)
class Breakpoint:
    """A breakpoint as it is set."""

    id: str
    verified: bool
    reason: str | None = None
    location: Location | None = None


@dataclass(frozen=True, slots=True)
class Frame:
    """A level of the call stack."""

    index: int
    pou: str
    instance: str | None
    location: Location | None


@dataclass(frozen=True, slots=True)
class Variable:
    """A variable with its value."""

    name: str
    type: str
    literal: str
    value: object = None
    """Of structures and arrays of a frame: nested; others are read by their path."""
    path: str | None = None
    """In the image: with it the variable has children, and can be watched."""
    children: int = 0
    writable: bool = True


@dataclass(frozen=True, slots=True)
class PastCycle:
    """A cycle that the flight recorder has."""

    number: int
    timestamp_ns: int


class Debuggee(Protocol):
    """A soft PLC with an application whose texts are files."""

    tasks: Sequence[str]
    """Names of the tasks."""

    async def start(self, values: Mapping[str, object], *, halt: bool) -> None:
        """Write values, then run, if it does not run yet; with `halt` no statement is executed before
        `continue`.
        """

    async def state(self) -> State:
        """As of now."""

    def on_change(self, callback: Callable[[], None]) -> None:
        """Call back, in the event loop, when the state may have changed, or the debuggee is gone."""

    async def set_breakpoints(self, path: str, wanted: Sequence[Wanted]) -> Sequence[Breakpoint]:
        """All breakpoints of a file, in place of those before."""

    async def set_data_breakpoints(self, wanted: Sequence[Wanted]) -> Sequence[Breakpoint]:
        """All data breakpoints, in place of those before."""

    async def control(self, command: Command, task: str | None) -> None:
        """Move a halted task, or all."""

    async def set_next_statement(self, task: str, path: str, line: int) -> None:
        """The halted task goes on from another statement."""

    async def stack(self, task: str) -> Sequence[Frame]:
        """The call stack of a halted task, innermost first."""

    async def frame_variables(self, task: str, frame: int) -> Sequence[Variable]:
        """Inputs, outputs and locals of a frame."""

    async def write_frame(self, task: str, frame: int, name: str, value: str) -> Variable:
        """Write a variable of a frame; the variable as it is then."""

    async def children(self, path: str, start: int, count: int, cycle: int | None) -> Sequence[Variable]:
        """What lies below a path of the image, "" for the programs and variable lists; as it was in a past
        cycle where one is given."""

    async def read(self, path: str, cycle: int | None) -> Variable:
        """A variable of the image."""

    async def write(self, path: str, value: str) -> Variable:
        """Write a variable of the image; the variable as it is then."""

    async def past(self) -> Sequence[PastCycle]:
        """The cycles that can be read, oldest first. Recording stops, so that they stay."""

    async def live(self) -> None:
        """The past is no longer needed: record again."""

    async def exception(self) -> str | None:
        """What ended the application."""

    async def text(self, reference: str) -> str:
        """A text that is no file."""

    async def log_lines(self) -> Sequence[tuple[str, str]]:
        """Severity and text of the lines logged since the last call."""

    async def close(self, *, terminate: bool) -> None:
        """Take the breakpoints away and let go; with `terminate` the application ends, too."""
