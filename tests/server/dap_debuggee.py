"""A debuggee in memory for tests of the debug adapter: one of its two tasks walks through lines."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace

from tappet.server.dap.debuggee import (
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

FILE = "/machine/Main.st"
LINES = (5, 6, 8, 9)
"""Lines with statements."""


class WalkingDebuggee:
    """`MainTask` executes the lines in turn, when it is told to; `Main.nCount` is their number so far."""

    tasks: Sequence[str] = ("MainTask", "Slow")

    def __init__(self) -> None:
        self.variables = {"Main.nCount": "0", "Main.xReady": "FALSE"}
        self.locals = {"nLocal": "7"}
        self.breakpoints: list[tuple[Wanted, Breakpoint]] = []
        self.data: list[Wanted] = []
        self.halt: Halt | None = None
        self.at = 0
        self.sequence = 0
        self.application = "stop"
        self.frozen = False
        self.closed: bool | None = None
        self.log: list[tuple[str, str]] = []
        self.lost = False
        self._call: Callable[[], None] = lambda: None

    def _stand(self, halt: Halt | None) -> None:
        self.halt = halt
        self.sequence += 1
        self._call()

    def walk(self, steps: int = 100) -> None:
        """Execute lines until a breakpoint, or so many."""
        for _ in range(steps):
            self.at = (self.at + 1) % len(LINES)
            self.variables["Main.nCount"] = str(int(self.variables["Main.nCount"]) + 1)
            for wanted, found in self.breakpoints:
                if found.verified and wanted.line == LINES[self.at] and wanted.log is None:
                    self._stand(Halt("MainTask", "breakpoint", found.id))
                    return

    def fail(self) -> None:
        self.application = "exception"
        self._stand(Halt("MainTask", "exception", message="division by zero"))

    # -- the protocol of Debuggee ------------------------------------------------------------------------

    async def start(self, values: Mapping[str, object], *, halt: bool) -> None:
        self.variables |= {path: str(value) for path, value in values.items()}
        self.application = "run"
        if halt:
            self._stand(Halt("MainTask", "pause"))

    async def state(self) -> State:
        if self.lost:
            raise ConnectionError("the connection to the runtime was lost")
        return State(self.application, self.sequence, (self.halt,) if self.halt else (), False)

    def on_change(self, callback: Callable[[], None]) -> None:
        self._call = callback

    async def set_breakpoints(self, path: str, wanted: Sequence[Wanted]) -> Sequence[Breakpoint]:
        found = []
        for each in wanted:
            line = next((line for line in LINES if line >= each.line), None)
            name = f"{path}:{each.line}"
            if path != FILE or line is None:
                found.append(Breakpoint(name, False, "there is no statement at this line or behind it"))
            else:
                found.append(Breakpoint(name, True, None, Location("Main.st", line, FILE)))
        self.breakpoints = [
            (replace(w, line=f.location.line if f.location else w.line), f)
            for w, f in zip(wanted, found, strict=True)
        ]
        return found

    async def set_data_breakpoints(self, wanted: Sequence[Wanted]) -> Sequence[Breakpoint]:
        self.data = list(wanted)
        return [Breakpoint(f"data {each.variable}", True) for each in wanted]

    async def control(self, command: Command, task: str | None) -> None:
        if command == "pause":
            self._stand(Halt("MainTask", "pause"))
            return
        if self.halt is None or task not in (None, "MainTask"):
            raise Refused(f"{task} is not halted")
        if command == "continue":
            self._stand(None)
        else:
            self.walk(1)
            self._stand(Halt("MainTask", "step"))

    async def set_next_statement(self, task: str, path: str, line: int) -> None:
        if path != FILE or line not in LINES:
            raise Refused(f"line {line} is no statement of Main")
        self.at = LINES.index(line)
        self.sequence += 1

    async def stack(self, task: str) -> Sequence[Frame]:
        where = Location("Main.st", LINES[self.at], FILE)
        library = Location("TON", 12, reference="Standard/TON")
        return [
            Frame(0, "TON", "Main.fbDelay", library),
            Frame(1, "Main", "Main", where),
            Frame(2, "?", None, None),
        ]

    async def frame_variables(self, task: str, frame: int) -> Sequence[Variable]:
        local = [Variable(name, "INT", value) for name, value in self.locals.items()]
        nested = Variable("stPoint", "POINT", "(x := 1, a := [2, 3])", {"x": 1, "a": [2, 3]})
        return (
            [*local, nested, Variable("IN", "BOOL", "TRUE", path="Main.fbDelay.IN")] if frame == 0 else local
        )

    async def write_frame(self, task: str, frame: int, name: str, value: str) -> Variable:
        if not value.lstrip("-").isdigit():
            raise Refused(f"'{value}' is no INT")
        self.locals[name] = value
        return Variable(name, "INT", value)

    async def children(self, path: str, start: int, count: int, cycle: int | None) -> Sequence[Variable]:
        if not path:
            return [Variable("Main", "program", "Main", None, "Main", 1, writable=False)]
        if path != "Main":
            raise Refused(f"'{path}' names nothing")
        return [await self.read(name, cycle) for name in self.variables]

    async def read(self, path: str, cycle: int | None) -> Variable:
        for name, value in self.variables.items():
            if name.casefold() == path.casefold():
                shown = value if cycle is None else f"{value} at {cycle}"
                return Variable(name.rpartition(".")[2], "INT", shown, None, name)
        raise Refused(f"'{path}' is no program, variable list or global variable of the application")

    async def write(self, path: str, value: str) -> Variable:
        if not value.isalnum():
            raise Refused(f"'{value}' is no INT")
        self.variables[path] = value
        return await self.read(path, None)

    async def past(self) -> Sequence[PastCycle]:
        self.frozen = True
        return [PastCycle(number, number * 10_000_000) for number in range(100, 105)]

    async def live(self) -> None:
        self.frozen = False

    async def exception(self) -> str | None:
        return "division by zero in Main, line 6" if self.application == "exception" else None

    async def text(self, reference: str) -> str:
        return f"(* {reference} *)"

    async def log_lines(self) -> Sequence[tuple[str, str]]:
        lines, self.log = self.log, []
        return lines

    async def close(self, *, terminate: bool) -> None:
        self.closed = terminate
