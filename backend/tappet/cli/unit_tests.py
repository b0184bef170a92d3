"""`tappet test`: the unit tests of a project, on virtual time."""

from __future__ import annotations

import sys
from argparse import Namespace
from dataclasses import replace
from typing import TYPE_CHECKING

from tappet.cli.arguments import ArgumentParser, integer
from tappet.cli.errors import UsageError, complain
from tappet.cli.output import counted, show_json
from tappet.whole_file import write_output

if TYPE_CHECKING:
    from tappet.cli.inputs import ApplicationInput
    from tappet.runtime.unit_tests.results import Failure, Report

NS_PER_S = 1_000_000_000
SIGNS = {"passed": "ok", "failed": "FAILED", "error": "ERROR", "skipped": "skipped"}


def run_unit_tests_arguments(parser: ArgumentParser) -> None:
    """What to test, within which limits."""
    parser.programs()
    parser.path_option("--junit", metavar="FILE", help="write JUnit XML")
    parser.add_argument(
        "--filter", default="", metavar="TEXT", help="only tests with this in suite.test; * is any text"
    )
    parser.add_argument(
        "--time-limit",
        default="10m",
        metavar="T",
        help="time of the PLC for all tests, such as 30s or 1h (default: %(default)s)",
    )
    parser.cycle_limit_option(2.0, "endless")
    parser.add_argument(
        "--memory-limit",
        type=integer(16),
        default=1024,
        metavar="MIB",
        help="MiB that all tests together may take with __NEW (default: %(default)s)",
    )
    parser.application_option("which application of the project")
    parser.format_option()


def run_unit_tests(given: Namespace) -> int:
    """Runs the tests of all applications and shows one report."""
    from tappet.cli.inputs import applications
    from tappet.runtime.unit_tests.junit import to_xml
    from tappet.runtime.unit_tests.order import TestLimits, order
    from tappet.runtime.unit_tests.process import run_in_process

    limits = TestLimits(
        cycle_s=given.cycle_limit, simulated_s=_seconds(given.time_limit), memory_mib=given.memory_limit
    )
    chosen = applications(given.paths, given.application)
    if not chosen:
        raise UsageError("the project has no application to test")
    reports = [
        _with_recordings(
            a,
            given.filter,
            run_in_process(
                order(
                    a.options.application,
                    a.sources,
                    a.tasks,
                    a.options.libraries,
                    defines=a.options.defines,
                    test_filter=given.filter,
                    limits=limits,
                    heap=a.options.heap,
                )
            ),
        )
        for a in chosen
    ]
    merged = reports[0] if len(reports) == 1 else _merge(reports)
    if given.junit is not None:
        write_output(given.junit, to_xml(merged))
    if given.format == "json":
        show_json(merged.to_dict())
    else:
        _show(merged)
    return 0 if merged.ok else 1


def _with_recordings(application: ApplicationInput, test_filter: str, report: Report) -> Report:
    """The report with the recordings of the application, which are replayed on what it is now."""
    if not application.recordings or report.diagnostics:
        return report
    from tappet.codegen.build import build_application
    from tappet.codegen.package import CodePackage
    from tappet.runtime.unit_tests.recordings import chosen_tests, replay_tests, with_recordings
    from tappet.user_cache import cache_folder

    options = replace(application.options, cache=cache_folder("objects"))

    def build(recorded: CodePackage) -> CodePackage | None:
        return build_application(application.sources, application.tasks, options, previous=recorded).package

    chosen = chosen_tests(application.recordings, test_filter)
    return with_recordings(report, replay_tests(chosen, build))


def _seconds(text: str) -> float:
    from tappet.project.durations import duration_ns
    from tappet.project.errors import InvalidTimeError

    try:
        return duration_ns(text if text.upper().startswith(("T#", "TIME#")) else f"T#{text}") / NS_PER_S
    except InvalidTimeError as error:
        raise UsageError(f"--time-limit {text}: {error}") from error


def _merge(reports: list[Report]) -> Report:
    """Applications without tests count only when none has any."""
    from tappet.runtime.unit_tests.results import Report

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
        print(f"{place}: {d['severity']} {d['code']}: {d['message']}", file=sys.stderr)
    for suite in report.suites:
        print(suite.name)
        for item in suite.tests:
            time = f"  {item.seconds:g} s" if item.seconds else ""
            print(f"  {SIGNS[item.outcome]:8}{item.name}{time}")
            for failure in item.failures:
                _show_failure(failure)
            for line in item.output:
                print(f"          > {line}")
        for failure in suite.failures:
            print("  ERROR   outside of a test")
            _show_failure(failure)
    counts = ", ".join(f"{report.count(o)} {o}" for o in ("passed", "failed", "error", "skipped"))
    if not report.diagnostics:
        print(f"{counted(report.total, 'test')}: {counts}")
    if report.problem:
        complain(report.problem)


def _show_failure(failure: Failure) -> None:
    from tappet.runtime.unit_tests.junit import describe

    for line in describe(failure).splitlines():
        print(f"          {line}")
