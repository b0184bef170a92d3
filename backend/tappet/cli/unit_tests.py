"""`tappet test`: the unit tests of a project, on virtual time."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from tappet.cli.inputs import applications
from tappet.cli.output import FormatOption, OutputFormat, UsageError, complain, show_json
from tappet.project.durations import duration_ns
from tappet.project.errors import InvalidTimeError
from tappet.runtime.unit_tests.junit import describe, to_xml
from tappet.runtime.unit_tests.process import order, run_in_process
from tappet.runtime.unit_tests.results import Failure, Report
from tappet.runtime.unit_tests.runner import TestLimits

NS_PER_S = 1_000_000_000
SIGNS = {"passed": "ok", "failed": "FAILED", "error": "ERROR", "skipped": "skipped"}


def run_unit_tests(
    paths: Annotated[
        list[Path], typer.Argument(metavar="PATH...", help="project folder, or .st files and folders of them")
    ],
    junit: Annotated[Path | None, typer.Option(metavar="FILE", help="write JUnit XML")] = None,
    test_filter: Annotated[
        str,
        typer.Option("--filter", metavar="TEXT", help="only tests with this in suite.test; * is any text"),
    ] = "",
    simulated: Annotated[
        str, typer.Option("--time-limit", help="time of the PLC for all tests, such as 30s or 1h")
    ] = "10m",
    cycle_limit: Annotated[
        float, typer.Option(min=0.01, help="seconds after which a cycle counts as endless")
    ] = 2.0,
    memory_limit: Annotated[
        int, typer.Option(min=16, metavar="MIB", help="MiB that all tests together may take with __NEW")
    ] = 1024,
    application: Annotated[str | None, typer.Option(help="which application of the project")] = None,
    output: FormatOption = OutputFormat.TEXT,
) -> None:
    """Run the test suites (blocks that extend FB_TestSuite); exit code 1 when a test is not good."""
    limits = TestLimits(cycle_s=cycle_limit, simulated_s=_seconds(simulated), memory_mib=memory_limit)
    chosen = applications(paths, application)
    if not chosen:
        raise UsageError("the project has no application to test")
    reports = [
        run_in_process(order(a.sources, a.tasks, a.options, test_filter=test_filter, limits=limits))
        for a in chosen
    ]
    merged = reports[0] if len(reports) == 1 else _merge(reports)
    if junit is not None:
        junit.write_bytes(to_xml(merged))
    if output is OutputFormat.JSON:
        show_json(merged.to_dict())
    else:
        _show(merged)
    raise typer.Exit(0 if merged.ok else 1)


def _seconds(text: str) -> float:
    try:
        return duration_ns(text if text.upper().startswith(("T#", "TIME#")) else f"T#{text}") / NS_PER_S
    except InvalidTimeError as error:
        raise UsageError(f"--time-limit {text}: {error}") from error


def _merge(reports: list[Report]) -> Report:
    """Applications without tests count only when none has any."""
    with_tests = [r for r in reports if r.suites or r.diagnostics] or reports[:1]
    return Report(
        ", ".join(r.application for r in with_tests),
        tuple(suite for r in with_tests for suite in r.suites),
        next((r.problem for r in with_tests if r.problem), None),
        tuple(d for r in with_tests for d in r.diagnostics),
    )


def _show(report: Report) -> None:
    for d in report.diagnostics:
        place = f"{d['file']}:{d['line']}:{d['column']}"
        typer.echo(f"{place}: {d['severity']} {d['code']}: {d['message']}", err=True)
    for suite in report.suites:
        typer.echo(suite.name)
        for item in suite.tests:
            time = f"  {item.seconds:g} s" if item.seconds else ""
            typer.echo(f"  {SIGNS[item.outcome]:8}{item.name}{time}")
            for failure in item.failures:
                _show_failure(failure)
            for line in item.output:
                typer.echo(f"          > {line}")
        for failure in suite.failures:
            typer.echo("  ERROR   outside of a test")
            _show_failure(failure)
    counts = ", ".join(f"{report.count(o)} {o}" for o in ("passed", "failed", "error", "skipped"))
    if not report.diagnostics:
        typer.echo(f"{report.total} tests: {counts}")
    if report.problem:
        complain(report.problem)


def _show_failure(failure: Failure) -> None:
    for line in describe(failure).splitlines():
        typer.echo(f"          {line}")
