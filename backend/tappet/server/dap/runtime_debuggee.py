"""The debuggee on a runtime: of a launched process of its own, or of one that runs already."""

from __future__ import annotations

import secrets
from collections.abc import Awaitable, Callable, Mapping, Sequence
from contextlib import suppress
from typing import Any, Protocol, TypeVar

from tappet.codegen.package import CodePackage
from tappet.runtime.client import RuntimeRefused
from tappet.runtime.debugger import shapes
from tappet.runtime.exception_report import ExceptionReport
from tappet.runtime.operations import debugging
from tappet.runtime.operations.declaration import WireOperation
from tappet.runtime.operations.flight import FreezeFlight, ListFlightCycles
from tappet.runtime.operations.life_cycle import GetInfo, Start, Stop
from tappet.runtime.operations.reports import GetException, ReadLog
from tappet.server.dap.debuggee import (
    ApplicationReplaced,
    Breakpoint,
    Command,
    Frame,
    Halt,
    Location,
    PastCycle,
    Refused,
    State,
    Variable,
    Wanted,
)
from tappet.server.dap.image_variables import ImageVariables
from tappet.server.dap.program_files import Texts

T = TypeVar("T")
_LOOKING_BACK_S = 3600
"""The flight recorder records again behind this time, when the session has died."""
ReadText = Callable[[str], str | None]
"""A text that is no file of the client, by its reference."""


class Caller(Protocol):
    """A connection to a runtime. Calls raise RuntimeRefused and ConnectionError."""

    async def call(self, operation: WireOperation[T]) -> T:
        """The reply to an operation."""

    def on_event(self, callback: Callable[[], None]) -> None:
        """Call back, in the event loop, when something has happened at the runtime."""


class RuntimeDebuggee:
    """An application on a runtime, and the files that it was built of."""

    def __init__(
        self,
        caller: Caller,
        package: CodePackage,
        load_variant: Callable[[], Awaitable[None]],
        texts: Texts,
        read_text: ReadText,
    ) -> None:
        """`load_variant` sees to it that the runtime has the instrumented variant; raises Refused."""
        self._caller = caller
        self._package = package
        self._load_variant = load_variant
        self._texts = texts
        self._read_text = read_text
        self._image = ImageVariables(caller.call, package)
        self._lines: dict[str, list[int]] = {}
        self._data: list[int] = []
        self._last_log = 0
        self._owner = f"debugger-{secrets.token_hex(8)}"
        self._ends: list[Callable[[], Awaitable[None]]] = []
        self.tasks: Sequence[str] = tuple(task.name for task in package.tasks)

    def at_end(self, end: Callable[[], Awaitable[None]]) -> None:
        """Call it when the session is over."""
        self._ends.append(end)

    async def _call(self, operation: WireOperation[T]) -> T:
        try:
            return await self._caller.call(operation)
        except RuntimeRefused as error:
            raise Refused(str(error)) from error

    # -- running -----------------------------------------------------------------------------------------

    async def start(self, values: Mapping[str, object], *, halt: bool) -> None:
        """Write values, then run."""
        self._last_log = max((entry.number for entry in await self._call(ReadLog())), default=0)
        if values:
            await self._image.write_all([(path, _text(value)) for path, value in values.items()])
        if halt:
            await self._load_variant()
            await self._call(debugging.ControlDebugger("pause"))
        if (await self._call(GetInfo())).state == "stop":
            await self._call(Start())

    async def state(self) -> State:
        """As of now."""
        info = await self._call(GetInfo())
        if info.code_id != self._package.code_id:
            raise ApplicationReplaced
        found = await self._call(debugging.GetDebugState())
        halts = [Halt(each.task, each.reason, _id(each.breakpoint_id), each.message) for each in found.halted]
        report = await self._call(GetException()) if info.state == "exception" else None
        if report is not None:
            halts = [Halt(report.task or self.tasks[0], "exception", None, report.message)]
        stand = found.settings.other_tasks == "halt"
        return State(info.state, found.sequence, tuple(halts), stand)

    def on_change(self, callback: Callable[[], None]) -> None:
        """Every event of the runtime may be a change."""
        self._caller.on_event(callback)

    async def control(self, command: Command, task: str | None) -> None:
        """Move a halted task, or all."""
        if command == "pause":
            await self._load_variant()
        await self._call(debugging.ControlDebugger(command, task))

    async def set_next_statement(self, task: str, path: str, line: int) -> None:
        """The halted task goes on from another statement."""
        await self._call(debugging.ControlDebugger("next_statement", task, self._spot(path, line)))

    # -- breakpoints -------------------------------------------------------------------------------------

    async def set_breakpoints(self, path: str, wanted: Sequence[Wanted]) -> Sequence[Breakpoint]:
        """All breakpoints of a file, in place of those before."""
        await self._remove(self._lines.pop(path, []))
        if wanted:
            await self._load_variant()
        found = []
        for each in wanted:
            try:
                order = shapes.BreakpointOrder("line", self._spot(path, each.line), None, **_conditions(each))
                found.append(await self._add(order, self._lines.setdefault(path, [])))
            except Refused as error:
                found.append(Breakpoint(f"{path}:{each.line}", False, str(error)))
        return found

    async def set_data_breakpoints(self, wanted: Sequence[Wanted]) -> Sequence[Breakpoint]:
        """All data breakpoints, in place of those before."""
        await self._remove(self._data)
        self._data = []
        if wanted:
            await self._load_variant()
        found = []
        for each in wanted:
            order = shapes.BreakpointOrder("data", None, each.variable, **_conditions(each))
            try:
                found.append(await self._add(order, self._data))
            except Refused as error:
                found.append(Breakpoint(f"data:{each.variable}", False, str(error)))
        return found

    async def _add(self, order: shapes.BreakpointOrder, kept: list[int]) -> Breakpoint:
        made = await self._call(debugging.AddBreakpoint(order))
        kept.append(made.id)
        where = self._location(made.actual) if made.actual is not None else None
        return Breakpoint(str(made.id), made.verified, made.reason, where)

    async def _remove(self, numbers: Sequence[int]) -> None:
        for number in numbers:
            with suppress(Refused):  # somebody else has removed it
                await self._call(debugging.RemoveBreakpoint(number))

    def _spot(self, path: str, line: int) -> shapes.Spot:
        place = self._texts.place(path, line)
        if place is None:
            raise Refused(f"{path} is no file of the application")
        return shapes.Spot(place.object_id, line=place.line, part=place.part)

    def _location(self, spot: shapes.CodeSpot) -> Location | None:
        return self._texts.location(spot.object_id, spot.part, spot.line, spot.uri or None)

    # -- stack and variables -----------------------------------------------------------------------------

    async def stack(self, task: str) -> Sequence[Frame]:
        """The call stack of a halted task; of one that failed, at least what its exception tells."""
        try:
            found = await self._call(debugging.GetStack(task))
        except Refused:
            report = await self._call(GetException())
            if report is None:
                raise
            return self._fault_frames(report)
        return [
            Frame(
                each.index,
                each.place.pou,
                each.instance or self._program(each.place.pou),
                self._location(each.place),
            )
            for each in found.frames
        ]

    def _program(self, pou: str) -> str | None:
        """The program that a POU is, or is an action of."""
        root = self._package.symbols.roots.get(pou.partition(".")[0].upper())
        return root.name if root is not None and root.kind == "program" else None

    def _fault_frames(self, report: ExceptionReport) -> list[Frame]:
        frames = []
        for index, each in enumerate(report.call_stack):
            place = each.place
            where = (
                self._texts.location(place.object_id, place.part, place.span.line + 1, each.uri)
                if place is not None
                else self._texts.location(None, None, each.line, each.uri)
            )
            frames.append(Frame(index, each.pou, self._program(each.pou), where))
        return frames

    async def frame_variables(self, task: str, frame: int) -> Sequence[Variable]:
        """What a statement of the frame may name first: its locals, and the members of its instance."""
        try:
            found = await self._call(debugging.GetVariables(frame, task))
        except Refused:
            return []  # code that runs without frames has none to show
        return [self._variable(each) for each in found.variables]

    async def write_frame(self, task: str, frame: int, name: str, value: str) -> Variable:
        """Write a variable of a frame."""
        return self._variable(await self._call(debugging.WriteVariable(frame, task, name, value)))

    def _variable(self, found: shapes.Variable) -> Variable:
        literal = found.literal or found.type
        children = self._image.count(found.path) if found.path is not None else 0
        writable = found.writable or found.path is not None  # what lies in the image is written there
        return Variable(found.name, found.type, literal, found.value, found.path, children, writable=writable)

    async def children(self, path: str, start: int, count: int, cycle: int | None) -> Sequence[Variable]:
        """What lies below a path of the image."""
        return await self._image.children(path, start, count, cycle)

    async def read(self, path: str, cycle: int | None) -> Variable:
        """A variable of the image."""
        return await self._image.read(path, cycle)

    async def write(self, path: str, value: str) -> Variable:
        """Write a variable of the image."""
        return await self._image.write(path, value)

    # -- past, texts, log --------------------------------------------------------------------------------

    async def past(self) -> Sequence[PastCycle]:
        """The cycles that the flight recorder keeps; it stops."""
        await self._call(FreezeFlight(True, self._owner, _LOOKING_BACK_S))
        return [PastCycle(cycle, stamp) for cycle, stamp in await self._call(ListFlightCycles())]

    async def live(self) -> None:
        """Record again."""
        await self._call(FreezeFlight(False, self._owner))

    async def exception(self) -> str | None:
        """What ended the application."""
        report = await self._call(GetException())
        return None if report is None else f"{report.message} ({report.pou}, line {report.line})"

    async def text(self, reference: str) -> str:
        """A text of a library."""
        text = self._read_text(reference)
        if text is None:
            raise Refused(f"There is no text '{reference}'")
        return text

    async def log_lines(self) -> Sequence[tuple[str, str]]:
        """Severity and text of the lines logged since the last call."""
        entries = await self._call(ReadLog(self._last_log))
        self._last_log = max([self._last_log, *(entry.number for entry in entries)])
        return [(entry.severity, entry.message) for entry in entries]

    async def close(self, *, terminate: bool) -> None:
        """Take the breakpoints away and let go; with `terminate` the application stops, too."""
        try:
            for number in [*self._data, *(each for kept in self._lines.values() for each in kept)]:
                with suppress(Refused):
                    await self._call(debugging.RemoveBreakpoint(number))
            with suppress(Refused):
                await self._call(debugging.ControlDebugger("continue"))
            if terminate:
                with suppress(Refused):
                    await self._call(Stop())
        finally:
            for end in self._ends:
                await end()


def _id(number: int | None) -> str | None:
    return None if number is None else str(number)


def _conditions(wanted: Wanted) -> dict[str, Any]:
    given = {"condition": wanted.condition, "log": wanted.log}
    always: dict[str, Any] = {"hits": wanted.hits, "kept": False}  # the client sets them again
    return always | {name: text for name, text in given.items() if text is not None}


def _text(value: object) -> str:
    if isinstance(value, bool):
        return "TRUE" if value else "FALSE"
    return str(value)
