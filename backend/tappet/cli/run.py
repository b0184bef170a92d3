"""`tappet run`: build and run an application in this process."""

from __future__ import annotations

import csv
import json
from collections.abc import Sequence
from pathlib import Path
from typing import Annotated, Any

import typer

from tappet.cli.inputs import one_application
from tappet.cli.output import FormatOption, OutputFormat, UsageError, complain, show_json
from tappet.codegen.build import build_application
from tappet.codegen.check import format_diagnostic
from tappet.codegen.package import CodePackage
from tappet.codegen.symbol_map import SymbolError
from tappet.project.durations import duration_ns
from tappet.project.errors import InvalidTimeError
from tappet.runtime.local import ApplicationException, LocalRuntime, Trace
from tappet.runtime.tasks import TaskStatistics

DEFAULT_CYCLES = 1


def run(
    path: Annotated[Path, typer.Argument(metavar="PATH", help="project folder or .st file")],
    cycles: Annotated[int | None, typer.Option(min=0, help="cycles of the fastest cyclic task")] = None,
    time: Annotated[str | None, typer.Option(help="time to run, such as 500ms, 10s or T#1m30s")] = None,
    virtual: Annotated[
        bool, typer.Option("--virtual", help="virtual clock: deterministic, as fast as possible")
    ] = False,
    show: Annotated[
        list[str] | None, typer.Option("--print", metavar="EXPR", help="print a value at the end")
    ] = None,
    assign: Annotated[
        list[str] | None, typer.Option("--set", metavar="NAME=VALUE", help="write before the first cycle")
    ] = None,
    trace: Annotated[
        Path | None, typer.Option(metavar="FILE", help="CSV of the printed values, a row a cycle")
    ] = None,
    stats: Annotated[bool, typer.Option("--stats", help="cycles and execution times of each task")] = False,
    cycle_limit: Annotated[
        float, typer.Option(min=0.01, help="seconds after which a cycle counts as stuck")
    ] = 3.0,
    application: Annotated[str | None, typer.Option(help="which application of the project")] = None,
    output: FormatOption = OutputFormat.TEXT,
) -> None:
    """Run an application for some cycles or a time and print values."""
    if cycles is not None and time is not None:
        raise UsageError("give either --cycles or --time")
    if trace is not None and not show:
        raise UsageError("--trace needs the variables to record: give them with --print")
    time_ns = _duration(time) if time is not None else None
    package = _build(path, application, output)
    expressions = show or []
    with LocalRuntime(package, virtual=virtual, start=False, cycle_limit_s=cycle_limit) as runtime:
        try:
            _assign(runtime, assign or [])
            recorded = runtime.trace(expressions) if trace is not None else None
            if runtime.exception is not None:  # of an initialiser
                raise ApplicationException(runtime.exception)
            runtime.start()
            if time_ns is not None:
                runtime.run(time_ns=time_ns)
            else:
                runtime.run(DEFAULT_CYCLES if cycles is None else cycles)
            failed = None
        except SymbolError as error:
            raise UsageError(str(error)) from error
        except ApplicationException as error:
            failed = error
        values = _values(runtime, expressions)
        if trace is not None and recorded is not None:
            _write_trace(trace, recorded, expressions)
        _show(values, runtime.statistics() if stats else None, failed, output)
    raise typer.Exit(1 if failed else 0)


def _duration(text: str) -> int:
    for candidate in (text, f"T#{text}"):
        try:
            return duration_ns(candidate)
        except InvalidTimeError as error:
            reason = error
    raise UsageError(f"--time {text}: {reason}")


def _build(path: Path, application: str | None, output: OutputFormat) -> CodePackage:
    chosen = one_application([path], application)
    if not chosen.tasks:
        raise UsageError(f"{path} has nothing to run: no task and no PROGRAM")
    result = build_application(chosen.sources, chosen.tasks, chosen.options)
    if result.package is None:
        if output is OutputFormat.JSON:
            show_json(
                {"ok": False, "diagnostics": [diagnostic.record() for diagnostic in result.diagnostics]}
            )
        else:
            for diagnostic in result.diagnostics:
                typer.echo(format_diagnostic(diagnostic), err=True)
        raise typer.Exit(1)
    return result.package


def _assign(runtime: LocalRuntime, assignments: Sequence[str]) -> None:
    for text in assignments:
        name, equals, value = text.partition("=")
        if not equals:
            raise UsageError(f"--set {text}: write it as NAME=VALUE")
        try:
            runtime.write(name.strip(), value.strip())
        except SymbolError:
            raise
        except ValueError as error:
            raise UsageError(f"--set {text}: {error}") from error


def _values(runtime: LocalRuntime, expressions: Sequence[str]) -> dict[str, str]:
    try:
        return {expression: runtime.literal(expression) for expression in expressions}
    except SymbolError as error:
        raise UsageError(str(error)) from error


def _write_trace(path: Path, trace: Trace, expressions: Sequence[str]) -> None:
    trace.collect()
    with path.open("w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file)
        writer.writerow(["cycle", "timestamp_ns", *expressions])
        for sample in trace.samples:
            cells = [_cell(sample.values[expression]) for expression in expressions]
            writer.writerow([sample.cycle, sample.timestamp_ns, *cells])


def _cell(value: Any) -> Any:
    return json.dumps(value) if isinstance(value, (list, dict)) else value


def _show(
    values: dict[str, str],
    statistics: list[TaskStatistics] | None,
    failed: ApplicationException | None,
    output: OutputFormat,
) -> None:
    if output is OutputFormat.JSON:
        body: dict[str, Any] = {"values": values, "exception": str(failed) if failed else None}
        if statistics is not None:
            body["tasks"] = [_statistics_json(task) for task in statistics]
        show_json(body)
        return
    for expression, literal in values.items():
        typer.echo(f"{expression} = {literal}")
    for task in statistics or []:
        typer.echo(
            f"task {task.name}: cycles {task.iec_cycles}, mean {task.average_ns} ns, "
            f"min {task.min_ns} ns, max {task.max_ns} ns"
        )
    if failed is not None:
        complain(str(failed))


def _statistics_json(task: TaskStatistics) -> dict[str, Any]:
    return {
        "name": task.name,
        "cycles": task.iec_cycles,
        "mean_ns": task.average_ns,
        "min_ns": task.min_ns,
        "max_ns": task.max_ns,
    }
