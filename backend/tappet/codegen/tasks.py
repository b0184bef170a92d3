"""Tasks of the package from the task configuration; where their event variables lie."""

from __future__ import annotations

from collections.abc import Sequence

from msgspec.structs import replace

from tappet.codegen.package import TaskSpec
from tappet.codegen.symbol_map import SymbolError, SymbolMap
from tappet.iec.system_events import external_event
from tappet.iec.task import Task
from tappet.lang.analysis.result import Analysis
from tappet.lang.diagnostics import Diagnostic, report
from tappet.lang.source import NOWHERE, Scope, Source

DEFAULT_INTERVAL_NS = 10_000_000
"""Cycle of the one task of an application without configuration."""


def task_specs(tasks: Sequence[Task]) -> list[TaskSpec]:
    """What the package says about tasks that `check_tasks` finds no error in."""
    return [
        TaskSpec(
            task.name,
            task.kind,
            task.interval_ns if task.kind == "cyclic" else 0,
            task.priority,
            external_event(task.event) if task.kind == "external" and task.event else task.event,
            watchdog=task.watchdog,
            programs=tuple(task.programs),
            processors=tuple(task.processors),
            policy=task.policy,
        )
        for task in tasks
    ]


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
    if not spec.event or spec.kind == "external":
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
