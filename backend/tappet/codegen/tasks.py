"""Checks the task configuration against the program (E07xx) and finds event variables."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import TYPE_CHECKING, Any

from tappet.codegen.package import TaskSpec, WatchdogSpec
from tappet.codegen.symbol_map import SymbolError, SymbolMap
from tappet.lang.analysis.result import Analysis
from tappet.lang.diagnostics import Diagnostic, report
from tappet.lang.source import NOWHERE, Scope, Source
from tappet.lang.symbols import PouSymbol

if TYPE_CHECKING:
    from tappet.codegen.build import TaskLike

_KINDS = ("cyclic", "freewheeling", "event", "status")
DEFAULT_INTERVAL_NS = 10_000_000
"""Cycle of the one task of an application without configuration."""


def check_tasks(tasks: Sequence[TaskLike], analysis: Analysis, found: list[Diagnostic]) -> list[TaskSpec]:
    """Task specifications; what is wrong is added to `found`."""
    specs: list[TaskSpec] = []
    names: set[str] = set()
    for task in tasks:
        if task.name.upper() in names:
            found.append(report("E0703", "", NOWHERE, task=task.name))
        names.add(task.name.upper())
        kind = "event" if task.kind == "external" else task.kind
        if kind not in _KINDS:
            found.append(report("E0708", "", NOWHERE, task=task.name, kind=task.kind))
        if not 0 <= task.priority <= 31:
            found.append(report("E0702", "", NOWHERE, task=task.name, priority=task.priority))
        if kind == "cyclic" and task.interval_ns <= 0:
            found.append(report("E0706", "", NOWHERE, task=task.name, interval=task.interval_ns))
        if kind in ("event", "status") and not task.event:
            found.append(report("E0707", "", NOWHERE, task=task.name))
        for name in task.programs:
            _check_program(task.name, name, analysis, found)
        specs.append(
            TaskSpec(
                task.name,
                kind,
                task.interval_ns if kind == "cyclic" else 0,
                task.priority,
                task.event,
                watchdog=_watchdog(task, found),
                programs=tuple(task.programs),
            )
        )
    return specs


def _check_program(task: str, name: str, analysis: Analysis, found: list[Diagnostic]) -> None:
    if name.upper() in analysis.programs:
        return
    symbol = analysis.scope.get(name.upper())
    if isinstance(symbol, PouSymbol):
        what = symbol.kind.lower().replace("_", " ")
        found.append(report("E0709", "", NOWHERE, task=task, program=name, what=what))
        return
    known = ", ".join(sorted(p.name for p in analysis.programs.values()))
    hint = f"There is {known}." if known else "Add a program."
    found.append(report("E0701", "", NOWHERE, task=task, program=name, hint=hint))


def _watchdog(task: Any, found: list[Diagnostic]) -> WatchdogSpec | None:
    definition = getattr(task, "watchdog", None)
    if definition is None:
        return None
    if definition.time_ns <= 0 or definition.sensitivity < 0:
        found.append(report("E0710", "", NOWHERE, task=task.name))
        return None
    return WatchdogSpec(definition.time_ns, definition.sensitivity)


def default_tasks(analysis: Analysis, sources: Sequence[Source], main_program: str) -> list[TaskSpec]:
    """One cyclic task of 10 ms with the main program, or the first program of the application."""
    chosen = analysis.programs.get(main_program.upper())
    if chosen is None:
        own = {s.uri for s in sources if s.scope is not Scope.LIBRARY}
        candidates = [p for p in analysis.programs.values() if p.source is None or p.source.uri in own]
        chosen = candidates[0] if candidates else None
    if chosen is None:
        return []
    return [TaskSpec("MainTask", "cyclic", DEFAULT_INTERVAL_NS, 1, programs=(chosen.name,))]


def event_place(spec: TaskSpec, symbols: SymbolMap, found: list[Diagnostic]) -> TaskSpec:
    """The specification with the place of its event variable; what is wrong with it is added to `found`."""
    if not spec.event:
        return spec
    try:
        ref = symbols.resolve(spec.event)
    except SymbolError as error:
        hint = f"{str(error)[:1].upper()}{str(error)[1:]}."
        found.append(report("E0704", "", NOWHERE, task=spec.name, event=spec.event, hint=hint))
        return spec
    if ref.type.kind != "bool":
        wrong = report("E0705", "", NOWHERE, task=spec.name, event=spec.event, type=ref.type.name)
        found.append(wrong)
        return spec
    return replace(spec, event_offset=ref.offset, event_bit=ref.bit)
