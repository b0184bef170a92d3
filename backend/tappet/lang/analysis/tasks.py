"""Checks of the task configuration against the analysed application (spec tasks.md)."""

from __future__ import annotations

from collections.abc import Sequence

from tappet.iec.system_events import external_event
from tappet.iec.task import SOFT_PLC, Task
from tappet.lang import types as t
from tappet.lang.analysis.context import Body, Session
from tappet.lang.analysis.expressions import evaluate
from tappet.lang.analysis.result import Analysis
from tappet.lang.analysis.scope import describe
from tappet.lang.analysis.task_access import check_shared
from tappet.lang.diagnostics import Diagnostic, report, with_severity
from tappet.lang.nearest import nearest
from tappet.lang.parser import parse_expression
from tappet.lang.rules import coding_checks
from tappet.lang.source import NOWHERE, Scope, Source
from tappet.lang.symbols import PouSymbol, VarSymbol

_EVENT_KINDS = ("event", "status", "external")


def check_tasks(tasks: Sequence[Task], analysis: Analysis) -> list[Diagnostic]:
    """Messages about the tasks. They have no uri: the task is named in the text."""
    found: list[Diagnostic] = []
    if not tasks:
        main = analysis.options.main_program
        if main.upper() not in analysis.programs:
            found.append(report("E0219", "", NOWHERE, name=main))
        return found
    if len(tasks) > SOFT_PLC.most_tasks:
        found.append(report("E0712", "", NOWHERE, count=len(tasks), most=SOFT_PLC.most_tasks))
    names: set[str] = set()
    for task in tasks:
        key = task.name.upper()
        if key in names:
            found.append(report("E0703", "", NOWHERE, task=task.name))
        names.add(key)
        found += _check(task, analysis)
    if not any(task.kind in ("cyclic", "freewheeling") for task in tasks):
        found.append(report("W1401", "", NOWHERE))
    found += _programs_without_task(tasks, analysis)
    found += check_shared(tasks, analysis)
    static = analysis.options.static
    for rule in coding_checks("check_tasks", static.codes):
        found += rule(tasks, static.codes)
    return with_severity(found, static.errors)


def _check(task: Task, analysis: Analysis) -> list[Diagnostic]:
    found: list[Diagnostic] = []

    def say(code: str, **fields: object) -> None:
        found.append(report(code, "", NOWHERE, task=task.name, **fields))

    if not SOFT_PLC.highest_priority <= task.priority <= SOFT_PLC.lowest_priority:
        say("E0702", priority=task.priority)
    if task.kind not in SOFT_PLC.kinds:
        say("E0708", kind=task.kind)
    if task.kind == "cyclic" and task.interval_ns <= 0:
        say("E0706", interval=f"{task.interval_ns} ns")
    watchdog = task.watchdog
    if watchdog is not None and (watchdog.time_ns <= 0 or watchdog.sensitivity < 0):
        say("E0710")
    if task.kind in _EVENT_KINDS:
        if task.kind == "external" and task.event:
            if external_event(task.event) is None:
                say("E0711", event=task.event, events=", ".join(SOFT_PLC.external_events))
        elif task.event:
            found += _check_event(task, task.event, analysis)
        else:
            say("E0707")
    if not task.programs:
        say("W1402")
    for program in task.programs:
        symbol = _object(program, analysis)
        if isinstance(symbol, PouSymbol):
            if symbol.kind != "PROGRAM":
                say("E0709", program=program, what=describe(symbol))
            continue
        close = nearest(program, analysis.programs)
        hint = f"Did you mean '{analysis.programs[close[0]].name}'?" if close else "Add the program."
        say("E0701", program=program, hint=hint)
    return found


def _object(name: str, analysis: Analysis) -> object:
    return analysis.programs.get(name.upper()) or analysis.scope.get(name.upper())


def _check_event(task: Task, path: str, analysis: Analysis) -> list[Diagnostic]:
    """The event variable is resolved like an expression of the application."""
    expression, faults = parse_expression(path, task.name)
    session = Session(analysis.options, Analysis(analysis.options))
    body = Body(session, Source(task.name, path, Scope.APPLICATION), None, dict(analysis.scope))
    type_ = None if faults else evaluate(body, expression)
    symbol = getattr(expression, "symbol", None)
    bit = getattr(expression, "bit", None)
    if type_ is None or (not isinstance(symbol, VarSymbol) and bit is None):
        hint = next((d.advice for d in session.diagnostics if d.advice), "Enter the path of a BOOL variable.")
        return [report("E0704", "", NOWHERE, task=task.name, event=path, hint=hint)]
    if t.value_type(type_) is not t.BOOL:
        return [report("E0705", "", NOWHERE, task=task.name, event=path, type=type_)]
    return []


def _programs_without_task(tasks: Sequence[Task], analysis: Analysis) -> list[Diagnostic]:
    """Programs of the application that neither a task nor other code calls (warning)."""
    listed = {name.upper() for task in tasks for name in task.programs}
    found: list[Diagnostic] = []
    for key, program in analysis.programs.items():
        source = program.source
        if (
            key in listed
            or id(program) in analysis.called
            or source is None
            or source.scope is not Scope.APPLICATION
        ):
            continue
        found.append(report("W1403", source.uri, program.span or NOWHERE, name=program.name))
    return found
