"""What tasks share: programs, global variables and instances that several of them write or read (TASK-40)."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from tappet.lang.analysis.bodies import State
from tappet.lang.analysis.context import DirectWrite
from tappet.lang.analysis.result import Analysis
from tappet.lang.diagnostics import Diagnostic, Related, report
from tappet.lang.parts import innermost
from tappet.lang.source import NOWHERE, Scope
from tappet.lang.symbols import PouSymbol, Storage, VarSymbol
from tappet.lang.types import FunctionBlock

if TYPE_CHECKING:
    from tappet.iec.task import Task

_AT_ONCE = 8
"""Bytes that are read and written in one piece."""


@dataclass(slots=True)
class _Reach:
    """What the programs of a task write and name: id() of the symbol to the POU that does it first."""

    task: str
    written: dict[int, str] = field(default_factory=dict)
    used: dict[int, str] = field(default_factory=dict)
    outputs: list[DirectWrite] = field(default_factory=list)


def check_shared(tasks: Sequence[Task], analysis: Analysis) -> list[Diagnostic]:
    """Messages about programs called twice and about data that tasks share."""
    found = list(_programs(tasks, analysis))
    state = analysis.state
    if len(tasks) > 1 and isinstance(state, State):
        reaches = [_reach(task, analysis, state) for task in tasks]
        for variable in _shareable(analysis):
            found += _check(variable, reaches, "S1505" in analysis.options.static.codes)
        found += _places(reaches)
    return found


def _programs(tasks: Sequence[Task], analysis: Analysis) -> Iterator[Diagnostic]:
    callers: dict[str, list[str]] = {}
    for task in tasks:
        seen: set[str] = set()
        for program in task.programs:
            key = program.upper()
            if key in seen:
                yield report("W1407", "", NOWHERE, task=task.name, program=program)
            else:
                callers.setdefault(key, []).append(task.name)
            seen.add(key)
    for key, names in callers.items():
        if len(names) > 1 and len(set(names)) > 1:
            symbol = analysis.programs.get(key)
            uri = symbol.source.uri if symbol is not None and symbol.source is not None else ""
            span = symbol.span if symbol is not None and symbol.span is not None else NOWHERE
            name = symbol.name if symbol is not None else key
            yield report("W1404", uri, span, program=name, tasks=_listed(names))


def _listed(names: Iterable[str]) -> str:
    return " and ".join(f"'{name}'" for name in names)


def _reach(task: Task, analysis: Analysis, state: State) -> _Reach:
    found = _Reach(task.name)
    seen: set[int] = set()
    todo = [p for name in task.programs if (p := analysis.programs.get(name.upper())) is not None]
    while todo:
        pou = todo.pop()
        if id(pou) in seen:
            continue
        seen.add(id(pou))
        record = state.records.get(id(pou))
        if record is not None:
            for key in record.written:
                found.written.setdefault(key, pou.qualified_name)
            for key in record.used:
                found.used.setdefault(key, pou.qualified_name)
            found.outputs += record.outputs
        todo += [target for target, _, _ in state.session.calls.get(id(pou), ())]
    return found


def _shareable(analysis: Analysis) -> Iterator[VarSymbol]:
    """Global variables and variables at addresses of the project itself."""
    for gvl in analysis.gvls:
        if gvl.source is not None and gvl.source.scope is not Scope.LIBRARY and gvl.decl is not None:
            yield from gvl.members.values()
    for program in analysis.programs.values():
        if program.source is not None and program.source.scope is not Scope.LIBRARY:
            yield from _direct(program)


def _direct(program: PouSymbol) -> Iterator[VarSymbol]:
    for variable in program.locals.values():
        if variable.home is Storage.DIRECT and variable.area in ("Q", "M"):
            yield variable


def _check(variable: VarSymbol, reaches: Sequence[_Reach], torn: bool) -> Iterator[Diagnostic]:
    key = id(variable)
    type_, source, span = variable.type, variable.source, variable.span
    writers = [r for r in reaches if key in r.written]
    if type_ is None or source is None or span is None or not writers:
        return
    block = isinstance(innermost(type_), FunctionBlock)
    if len(writers) > 1:
        names = " and ".join(f"'{r.task}' (in {r.written[key]})" for r in writers)
        yield report("W1408" if block else "W1405", source.uri, span, name=variable.name, tasks=names)
    elif torn and not block and type_.size > _AT_ONCE:
        readers = [r for r in reaches if key in r.used and r is not writers[0]]
        if readers:
            writer = writers[0]
            yield report(
                "S1505",
                source.uri,
                span,
                name=variable.name,
                writer=f"{writer.task} (in {writer.written[key]})",
                reader=f"{readers[0].task} (in {readers[0].used[key]})",
                size=type_.size,
            )


def _places(reaches: Sequence[_Reach]) -> Iterator[Diagnostic]:
    """Outputs and markers that several tasks write under different names, or by their address."""
    reported: set[tuple[str, int]] = set()
    for number, reach in enumerate(reaches):
        for other in reaches[number + 1 :]:
            for one in sorted(reach.outputs):
                for two in other.outputs:
                    shared = one.area == two.area and one.first < two.last and two.first < one.last
                    same = one.name.upper() == two.name.upper() and not one.name.startswith("%")
                    key = (one.area, max(one.first, two.first))
                    if not shared or same or key in reported:
                        continue
                    reported.add(key)
                    related = [Related(f"task '{other.task}' writes it here", two.uri, two.span)]
                    place = f"%{one.area}X{key[1] // 16}.{key[1] % 16}"
                    tasks = _listed((reach.task, other.task))
                    yield report(
                        "W1406", one.uri, one.span, related, address=place, name=one.name, tasks=tasks
                    )
