"""Builds applications with their instrumented variant, and drives the debugger of a soft PLC in tests."""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence

from plc_programs import MAIN

from tappet.codegen.build import BuildOptions, BuildSession, build_application
from tappet.codegen.debug_build import instrument
from tappet.codegen.package import CodePackage
from tappet.iec.task import Task
from tappet.lang.source import Source
from tappet.runtime.debugger.shapes import Breakpoint, BreakpointOrder, Command, DebugState, Hits, Spot
from tappet.runtime.plc import SoftPlc

URI = "PLC_PRG"
PATIENCE_S = 20.0


def build_both(
    text: str,
    tasks: Sequence[Task] = MAIN,
    previous: CodePackage | None = None,
    gvls: dict[str, str] | None = None,
) -> tuple[CodePackage, bytes]:
    """The package of one ST text, and the instrumented variant as it goes over the wire."""
    session = BuildSession()
    sources = [Source(URI, text), *(Source(n, t, name=n) for n, t in (gvls or {}).items())]
    result = build_application(sources, list(tasks), BuildOptions(application="App"), previous, session)
    assert result.package is not None, [d for d in result.diagnostics if d.severity == "error"]
    assert session.generated is not None
    return CodePackage.from_bytes(result.package.to_bytes()), instrument(session.generated).to_bytes()


def loaded(text: str, tasks: Sequence[Task] = MAIN, plc: SoftPlc | None = None) -> SoftPlc:
    """A soft PLC with a program and its instrumented variant, stopped."""
    package, variant = build_both(text, tasks)
    plc = plc or SoftPlc(None)
    plc.load(package)
    plc.debugger.load(variant)
    return plc


def spot(line: int, uri: str = URI) -> Spot:
    """A line of a text."""
    return Spot(uri, line, part="")


def at_line(
    line: int, hits: Hits | None = None, instance: str | None = None, task: str | None = None
) -> BreakpointOrder:
    """A breakpoint at a line."""
    return BreakpointOrder(place=spot(line), hits=hits or Hits(), instance=instance, task=task)


def add(plc: SoftPlc, line: int) -> Breakpoint:
    """A plain breakpoint, which has to be possible."""
    found = plc.debugger.add(at_line(line))
    assert found.verified, found.reason
    return found


def until(condition: Callable[[], bool]) -> None:
    """Wait for what a task does."""
    end = time.monotonic() + PATIENCE_S
    while not condition():
        assert time.monotonic() < end, "it did not happen"
        time.sleep(0.001)


def halted(plc: SoftPlc) -> DebugState:
    """The state once a task has halted."""
    until(lambda: bool(plc.debugger.halted_tasks()))
    return plc.debugger.state()


def line(plc: SoftPlc) -> int:
    """Where the one halted task stands."""
    return halted(plc).halted[0].place.line


def step(plc: SoftPlc, command: Command, task: str | None = None) -> int:
    """The line after a step."""
    plc.debugger.control(command, task)
    return line(plc)


def value(plc: SoftPlc, path: str) -> object:
    """A variable of the image as of now."""
    ref = plc.symbols().resolve(path)
    return plc.symbols().decode(ref, plc.read([(ref.offset, ref.size)])[0])
