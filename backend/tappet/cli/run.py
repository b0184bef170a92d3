"""`tappet run`: build and run an application in this process."""

from __future__ import annotations

import gc
import json
import sys
from argparse import Namespace
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

from tappet.cli.arguments import ArgumentParser, integer
from tappet.cli.errors import UsageError, complain
from tappet.cli.output import show_json
from tappet.whole_file import write_output

if TYPE_CHECKING:
    from tappet.codegen.package import CodePackage
    from tappet.runtime.local import ApplicationException, LocalRuntime, Trace
    from tappet.runtime.tasks import TaskStatistics

DEFAULT_CYCLES = 1


def run_arguments(parser: ArgumentParser) -> None:
    """What to run, for how long, and what to show."""
    parser.add_argument("path", type=Path, metavar="PATH", help="project folder or .st file")
    parser.add_argument(
        "--cycles", type=integer(0), metavar="N", help="cycles of the fastest cyclic task (default: 1)"
    )
    parser.add_argument("--time", metavar="T", help="time to run, such as 500ms, 10s or T#1m30s")
    parser.add_argument(
        "--virtual", action="store_true", help="virtual clock: deterministic, as fast as possible"
    )
    parser.add_argument(
        "--print", dest="show", action="append", default=[], metavar="EXPR", help="print a value at the end"
    )
    parser.add_argument(
        "--set",
        dest="assign",
        action="append",
        default=[],
        metavar="NAME=VALUE",
        help="write before the first cycle",
    )
    parser.path_option("--trace", metavar="FILE", help="CSV of the printed values, a row a cycle")
    parser.add_argument("--stats", action="store_true", help="cycles and execution times of each task")
    parser.cycle_limit_option(3.0, "stuck")
    parser.application_option("which application of the project")
    parser.format_option()


def run(given: Namespace) -> int:
    """Builds, runs and shows."""
    if given.cycles is not None and given.time is not None:
        raise UsageError("give either --cycles or --time")
    if given.trace is not None and not given.show:
        raise UsageError("--trace needs the variables to record: give them with --print")
    time_ns = duration(given.time) if given.time is not None else None
    package = _build(given.path, given.application, given.format)
    if package is None:
        return 1
    from tappet.codegen.symbol_map import SymbolError
    from tappet.runtime.local import ApplicationException, LocalRuntime

    gc.freeze()
    gc.enable()
    with LocalRuntime(
        package, virtual=given.virtual, start=False, cycle_limit_s=given.cycle_limit
    ) as runtime:
        try:
            _assign(runtime, given.assign)
            recorded = runtime.trace(given.show) if given.trace is not None else None
            if runtime.exception is not None:  # of an initialiser
                raise ApplicationException(runtime.exception)
            runtime.start()
            if time_ns is not None:
                runtime.run(time_ns=time_ns)
            else:
                runtime.run(DEFAULT_CYCLES if given.cycles is None else given.cycles)
            failed = None
        except SymbolError as error:
            raise UsageError(str(error)) from error
        except ApplicationException as error:
            failed = error
        values = _values(runtime, given.show)
        if recorded is not None:
            _write_trace(given.trace, recorded, given.show)
        _show(values, runtime.statistics() if given.stats else None, failed, given.format)
    return 1 if failed else 0


def duration(text: str) -> int:
    """Nanoseconds of `--time`. Raises UsageError."""
    from tappet.project.durations import duration_ns
    from tappet.project.errors import InvalidTimeError

    for candidate in (text, f"T#{text}"):
        try:
            return duration_ns(candidate)
        except InvalidTimeError as error:
            reason = error
    raise UsageError(f"--time {text}: {reason}")


def _build(path: Path, application: str | None, output: str) -> CodePackage | None:
    """The package; None after errors, which are shown."""
    from tappet.cli.inputs import one_application
    from tappet.codegen.build import build_application
    from tappet.codegen.check import format_diagnostic
    from tappet.user_cache import cache_folder

    chosen = one_application([path], application)
    if not chosen.tasks:
        raise UsageError(f"{path} has nothing to run: no task and no PROGRAM")
    result = build_application(
        chosen.sources, chosen.tasks, replace(chosen.options, cache=cache_folder("objects"))
    )
    if result.package is None:
        if output == "json":
            show_json(
                {"ok": False, "diagnostics": [diagnostic.record() for diagnostic in result.diagnostics]}
            )
        else:
            for diagnostic in result.diagnostics:
                print(format_diagnostic(diagnostic), file=sys.stderr)
    return result.package


def _assign(runtime: LocalRuntime, assignments: Sequence[str]) -> None:
    from tappet.codegen.symbol_map import SymbolError

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
    from tappet.codegen.symbol_map import SymbolError

    try:
        return {expression: runtime.literal(expression) for expression in expressions}
    except SymbolError as error:
        raise UsageError(str(error)) from error


def _write_trace(path: Path, trace: Trace, expressions: Sequence[str]) -> None:
    import csv
    import io

    trace.collect()
    text = io.StringIO(newline="")
    writer = csv.writer(text)
    writer.writerow(["cycle", "timestamp_ns", *expressions])
    for sample in trace.samples:
        cells = [_cell(sample.values[expression]) for expression in expressions]
        writer.writerow([sample.cycle, sample.timestamp_ns, *cells])
    write_output(path, text.getvalue().encode())


def _cell(value: Any) -> Any:
    return json.dumps(value) if isinstance(value, (list, dict)) else value


def _show(
    values: dict[str, str],
    statistics: list[TaskStatistics] | None,
    failed: ApplicationException | None,
    output: str,
) -> None:
    if output == "json":
        body: dict[str, Any] = {"values": values, "exception": str(failed) if failed else None}
        if statistics is not None:
            body["tasks"] = [_statistics_json(task) for task in statistics]
        show_json(body)
        return
    for expression, literal in values.items():
        print(f"{expression} = {literal}")
    for task in statistics or []:
        print(
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
