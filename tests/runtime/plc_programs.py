"""Builds small ST applications for the runtime tests."""

from __future__ import annotations

import asyncio
from collections.abc import Awaitable, Callable, Sequence
from functools import cache

from tappet.codegen.build import BuildOptions, build_application
from tappet.codegen.package import CodePackage
from tappet.iec.task import Task, Watchdog
from tappet.lang.source import Source

MS = 1_000_000
MAIN = (Task("Main", interval_ns=10 * MS, programs=("PLC_PRG",)),)

TASK_FUNCTIONS = """
{attribute 'tappet_external' := 'tappet_sleep_ns'}
FUNCTION SleepNs
VAR_INPUT duration : LINT; END_VAR
END_FUNCTION

{attribute 'tappet_external' := 'tappet_task_current'}
FUNCTION TaskCurrent : LWORD
END_FUNCTION

{attribute 'tappet_external' := 'tappet_watchdog_disable'}
FUNCTION DisableWatchdog : DINT
VAR_INPUT task : LWORD; END_VAR
END_FUNCTION

{attribute 'tappet_external' := 'tappet_watchdog_enable'}
FUNCTION EnableWatchdog : DINT
VAR_INPUT task : LWORD; END_VAR
END_FUNCTION
"""
"""What CmpIecTask and SysTask are made of."""

FAULTY_POUS = """FUNCTION Quotient : DINT
VAR_INPUT
    a, b : DINT;
END_VAR
Quotient := a / b;
END_FUNCTION

FUNCTION_BLOCK FB_Deep
VAR
    depth : DINT;
    room : ARRAY [0..99] OF LINT;
END_VAR
METHOD Down : LINT
VAR_INPUT
    n : LINT;
END_VAR
VAR
    local : ARRAY [0..49] OF LINT;
END_VAR
local[n MOD 50] := n;
Down := THIS^.Down(n + 1) + local[(n + 7) MOD 50];
END_METHOD
END_FUNCTION_BLOCK

"""
"""A function that divides, and a block whose method calls itself without end."""


def build(
    text: str,
    tasks: Sequence[Task] = MAIN,
    *,
    gvls: dict[str, str] | None = None,
    previous: CodePackage | None = None,
    name: str = "App",
) -> CodePackage:
    """A package of one ST text and global variable lists; fails the test with the diagnostics."""
    lists = tuple(sorted((gvls or {}).items()))
    if previous is None:
        return _build(text, tuple(tasks), lists, name)
    return _compile(text, tuple(tasks), lists, name, previous)


@cache
def _build(text: str, tasks: tuple[Task, ...], gvls: tuple[tuple[str, str], ...], name: str) -> CodePackage:
    return _compile(text, tasks, gvls, name, None)


def _compile(
    text: str,
    tasks: tuple[Task, ...],
    gvls: tuple[tuple[str, str], ...],
    name: str,
    previous: CodePackage | None,
) -> CodePackage:
    sources = [Source("PLC_PRG", text), *(Source(n, t, name=n) for n, t in gvls)]
    result = build_application(sources, list(tasks), BuildOptions(application=name), previous)
    assert result.package is not None, [d for d in result.diagnostics if d.severity == "error"]
    return CodePackage.from_bytes(result.package.to_bytes())


async def until(condition: Callable[[], Awaitable[bool]]) -> None:
    """Wait for something another thread or process does; fails after half a minute."""
    for _ in range(3000):
        if await condition():
            return
        await asyncio.sleep(0.01)
    raise AssertionError("it did not happen")


def watchdog(time_ms: int, sensitivity: int) -> Watchdog:
    """A watchdog as in the task dialog."""
    return Watchdog(time_ms * MS, sensitivity)
