"""The debugger: breakpoints, halting, steps, call stacks and their variables."""

from __future__ import annotations

import asyncio
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING, Annotated, Any, ClassVar, Literal

import msgspec
from msgspec import Meta

from tappet.runtime.debugger.shapes import (
    Breakpoint,
    BreakpointOrder,
    Command,
    DebugState,
    FlowSnapshot,
    Settings,
    Spot,
    Stack,
    Variable,
    Variables,
)
from tappet.runtime.errors import UnknownBreakpointError
from tappet.runtime.operations.declaration import (
    Fact,
    Operation,
    OperationError,
    Rest,
    Session,
    SessionOperation,
    Text,
)
from tappet.runtime.operations.download import Upload

if TYPE_CHECKING:
    from tappet.runtime.plc import SoftPlc

TAG = "debugger"
FlowHolder = Annotated[
    str, Meta(max_length=100, description="Who wants it; a named one must read every few seconds to keep it.")
]
FrameNumber = Annotated[int, Meta(ge=0, le=1000, description="0 is the innermost level.")]


def _written(value: Any) -> str:
    return msgspec.json.encode(value).decode()[:1000]


@contextmanager
def _known_breakpoint() -> Iterator[None]:
    try:
        yield
    except UnknownBreakpointError as error:
        raise OperationError("not_found", str(error)) from error


def _act(
    method: Literal["POST", "PUT", "DELETE"],
    path: str,
    audit: Callable[[Any], Fact],
    *,
    variant: bool = False,
) -> Rest:
    """An act of an engineer, which is audited; with `variant` the instrumented code is loaded first."""
    return Rest(method, f"/debug{path}", "engineer", audit, tag=TAG, variant=variant)


def _view(path: str) -> Rest:
    """A question of anybody."""
    return Rest("GET", f"/debug{path}", "viewer", None, tag=TAG)


class GetDebugState(Operation[DebugState], frozen=True):
    """Breakpoints, settings, and where tasks are halted."""

    op: ClassVar[str] = "debug_state"
    rest: ClassVar[Rest | None] = _view("")

    def run(self, plc: SoftPlc) -> DebugState:
        """As of now."""
        return plc.debugger.state()


class LoadVariant(SessionOperation[DebugState], frozen=True):
    """Links the instrumented variant that was sent like a package, beside the application that it is of."""

    op: ClassVar[str] = "debug_load"

    async def serve(self, session: Session) -> DebugState:
        """Off the event loop: linking takes its time."""
        upload = session.own(Upload)
        data, upload.data = upload.data, None
        if data is None or len(data) != upload.size:
            got = 0 if data is None else len(data)
            raise OperationError("bad_request", f"debug_load: {got} of {upload.size} bytes arrived")
        return await asyncio.to_thread(session.plc.debugger.load, bytes(data))


class SetDebugSettings(Operation[DebugState], frozen=True):
    """What happens to outputs and to other tasks while a task is halted."""

    op: ClassVar[str] = "debug_settings"
    rest: ClassVar[Rest | None] = _act(
        "PUT", "/settings", lambda order: Fact("debug-settings", new_value=_written(order.settings))
    )
    settings: Settings

    def run(self, plc: SoftPlc) -> DebugState:
        """From the next halt on."""
        return plc.debugger.set_settings(self.settings)


class AddBreakpoint(Operation[Breakpoint], frozen=True):
    """Set a breakpoint at a line or element, or on the value of a variable."""

    op: ClassVar[str] = "debug_add_breakpoint"
    rest: ClassVar[Rest | None] = _act(
        "POST",
        "/breakpoints",
        lambda order: Fact("breakpoint-added", new_value=_written(order.breakpoint)),
        variant=True,
    )
    breakpoint: BreakpointOrder

    def run(self, plc: SoftPlc) -> Breakpoint:
        """Holds from the next cycle on."""
        return plc.debugger.add(self.breakpoint)


class ChangeBreakpoint(Operation[Breakpoint], frozen=True):
    """Replace a breakpoint, for instance to disable it; its hits count from 0."""

    op: ClassVar[str] = "debug_change_breakpoint"
    rest: ClassVar[Rest | None] = _act(
        "PUT",
        "/breakpoints/{id}",
        lambda order: Fact("breakpoint-changed", new_value=_written(order.breakpoint)),
        variant=True,
    )
    id: int
    breakpoint: BreakpointOrder

    def run(self, plc: SoftPlc) -> Breakpoint:
        """Not found when there is none with this id."""
        with _known_breakpoint():
            return plc.debugger.change(self.id, self.breakpoint)


class EnableBreakpoints(Operation[DebugState], frozen=True):
    """Enable or disable all breakpoints at once; their hits go on counting."""

    op: ClassVar[str] = "debug_enable_breakpoints"
    rest: ClassVar[Rest | None] = _act(
        "PUT",
        "/breakpoints",
        lambda order: Fact("breakpoints-enabled" if order.enabled else "breakpoints-disabled"),
        variant=True,
    )
    enabled: bool

    def run(self, plc: SoftPlc) -> DebugState:
        """Halted tasks stay halted."""
        return plc.debugger.enable(self.enabled)


class RemoveBreakpoint(Operation[None], frozen=True):
    """Remove a breakpoint."""

    op: ClassVar[str] = "debug_remove_breakpoint"
    rest: ClassVar[Rest | None] = _act(
        "DELETE", "/breakpoints/{id}", lambda order: Fact("breakpoint-removed", new_value=str(order.id))
    )
    id: int

    def run(self, plc: SoftPlc) -> None:
        """Not found when there is none with this id."""
        with _known_breakpoint():
            plc.debugger.remove(self.id)


class RemoveBreakpoints(Operation[None], frozen=True):
    """Remove all breakpoints."""

    op: ClassVar[str] = "debug_remove_breakpoints"
    rest: ClassVar[Rest | None] = _act("DELETE", "/breakpoints", lambda _: Fact("breakpoints-removed"))

    def run(self, plc: SoftPlc) -> None:
        """Halted tasks stay halted."""
        plc.debugger.remove(None)


class ControlDebugger(Operation[DebugState], frozen=True):
    """Halt, go on, or step: `continue` and `pause` mean all tasks where none is named.

    `run_to` and `next_statement` need a place. `single_cycle` runs a halted application to the end of its
    cycle and stops it there.
    """

    op: ClassVar[str] = "debug_control"
    rest: ClassVar[Rest | None] = _act(
        "POST",
        "/control",
        lambda order: Fact(f"debug-{order.command.replace('_', '-')}", new_value=order.task),
        variant=True,
    )
    command: Command
    task: Text | None = None
    place: Spot | None = None

    def run(self, plc: SoftPlc) -> DebugState:
        """Answers where a step has ended, if it has at once."""
        return plc.debugger.control(self.command, self.task, self.place)


class GetStack(Operation[Stack], frozen=True):
    """The call stack of a halted task, or of one that an exception in instrumented code has ended."""

    op: ClassVar[str] = "debug_stack"
    rest: ClassVar[Rest | None] = _view("/stack")
    task: Text

    def run(self, plc: SoftPlc) -> Stack:
        """The innermost level first."""
        return plc.debugger.stack(self.task)


class GetVariables(Operation[Variables], frozen=True):
    """The variables of a level of a call stack: its own, and those of the instance or program."""

    op: ClassVar[str] = "debug_variables"
    rest: ClassVar[Rest | None] = _view("/stack/{frame}/variables")
    frame: FrameNumber
    task: Text

    def run(self, plc: SoftPlc) -> Variables:
        """With their present values."""
        return plc.debugger.variables(self.task, self.frame)


class WriteVariable(Operation[Variable], frozen=True):
    """Write a local variable of a level of a call stack; others are written by their path."""

    op: ClassVar[str] = "debug_write"
    rest: ClassVar[Rest | None] = _act(
        "POST",
        "/stack/{frame}/write",
        lambda order: Fact("write", f"{order.task}: {order.name}", _written(order.value)),
    )
    frame: FrameNumber
    task: Text
    name: Text
    value: Annotated[Any, Meta(description="A JSON value or an IEC literal.")]

    def run(self, plc: SoftPlc) -> Variable:
        """At once."""
        return plc.debugger.write(self.task, self.frame, self.name, self.value)


class SetFlow(Operation[None], frozen=True):
    """Record which statements of these objects a cycle executes; an empty list ends that."""

    op: ClassVar[str] = "debug_set_flow"
    rest: ClassVar[Rest | None] = _act(
        "PUT", "/flow", lambda order: Fact("flow-control", new_value=_written(order.object_ids)), variant=True
    )
    object_ids: Annotated[list[Text], Meta(max_length=100)]
    holder: FlowHolder = ""

    def run(self, plc: SoftPlc) -> None:
        """From the next cycle on."""
        plc.debugger.set_flow(self.object_ids, self.holder)


class GetFlow(Operation[FlowSnapshot], frozen=True):
    """The executed statements of an object under flow control, all of one cycle."""

    op: ClassVar[str] = "debug_flow"
    rest: ClassVar[Rest | None] = _view("/flow")
    object_id: Text
    holder: FlowHolder = ""

    def run(self, plc: SoftPlc) -> FlowSnapshot:
        """Of the last complete cycle, or of the present one while the task is halted."""
        return plc.debugger.flow(self.object_id, self.holder)
