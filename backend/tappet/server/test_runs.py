"""Runs the unit tests of an application in a process of their own, one run at a time for each application."""

from __future__ import annotations

import asyncio
from collections.abc import Sequence
from contextlib import suppress

from tappet.codegen.build import BuildOptions, LibraryReference, as_source
from tappet.codegen.package import TaskSpec
from tappet.runtime.unit_tests import process
from tappet.runtime.unit_tests.results import Failure, Report, SuiteOutcome, TestOutcome
from tappet.server.builder import Application
from tappet.server.problems import Problem
from tappet.server.schemas.build import Diagnostic, Part, Severity
from tappet.server.schemas.tests import TestFailure, TestReport, TestResult, TestSuite
from tappet.server.source_places import SourcePlaces


class TestRuns:
    """The running test processes of a server."""

    __test__ = False  # no test class of pytest

    def __init__(self) -> None:
        self._running: dict[tuple[str, str], asyncio.subprocess.Process | None] = {}

    async def run(self, application: Application, test_filter: str, only: Sequence[str] = ()) -> TestReport:
        """Run and wait; the process is killed when the caller goes away. 409 while a run is going on."""
        key = (application.project_id, application.application_id)
        if key in self._running:
            raise Problem(409, "tests-running", "Tests of this application are running; wait for their end.")
        self._running[key] = None
        try:
            order = await asyncio.to_thread(_order, application, test_filter, only)
            child = await asyncio.create_subprocess_exec(
                *process.COMMAND, stdin=asyncio.subprocess.PIPE, stdout=asyncio.subprocess.PIPE
            )
            self._running[key] = child
            report = await _result(child, order)
        finally:
            del self._running[key]
        return _reply(report, application)

    def cancel(self, project_id: str, application_id: str) -> bool:
        """Ends the tests of an application; False when none are running."""
        child = self._running.get((project_id, application_id))
        if child is None:
            return False
        with suppress(ProcessLookupError):
            child.kill()
        return True


async def _result(child: asyncio.subprocess.Process, order: bytes) -> Report:
    try:
        output, _ = await asyncio.wait_for(child.communicate(order), process.WALL_LIMIT_S)
        return process.report_of(output, child.returncode)
    except TimeoutError:
        return process.report_of(b"", None)
    finally:
        if child.returncode is None:
            with suppress(ProcessLookupError):
                child.kill()
            await child.wait()


def _order(application: Application, test_filter: str, only: Sequence[str]) -> bytes:
    libraries = tuple(
        LibraryReference(n, v, space or None, holder) for n, v, space, holder in application.libraries
    )
    tasks = [TaskSpec(t.name, interval_ns=t.interval_ns, programs=t.programs) for t in application.tasks]
    sources = [as_source(text) for text in application.sources]
    options = BuildOptions(application.name, libraries=libraries)
    return process.order(sources, tasks, options, test_filter=test_filter, only=only)


def _reply(report: Report, application: Application) -> TestReport:
    places = SourcePlaces.of(application.project_id, application.sources, application.paths)
    return TestReport(
        ok=report.ok,
        total=report.total,
        passed=report.count("passed"),
        failed=report.count("failed"),
        error=report.count("error"),
        skipped=report.count("skipped"),
        problem=report.problem,
        suites=[_suite(suite, places) for suite in report.suites],
        diagnostics=[_diagnostic(d, places) for d in report.diagnostics],
    )


def _suite(suite: SuiteOutcome, places: SourcePlaces) -> TestSuite:
    found = places.locate(suite.block, 1)
    return TestSuite(
        name=suite.name,
        block=suite.block,
        object_id=found.object_id if found else None,
        tests=[_test(test, places) for test in suite.tests],
        failures=[_failure(failure, places) for failure in suite.failures],
    )


def _test(test: TestOutcome, places: SourcePlaces) -> TestResult:
    return TestResult(
        name=test.name,
        outcome=test.outcome,
        assertions=test.assertions,
        seconds=test.seconds,
        failures=[_failure(failure, places) for failure in test.failures],
    )


def _failure(failure: Failure, places: SourcePlaces) -> TestFailure:
    found = places.locate(failure.uri, failure.line)
    return TestFailure(
        message=failure.message,
        expected=failure.expected,
        actual=failure.actual,
        code=failure.code,
        pou=failure.pou,
        object_id=found.object_id if found else None,
        object_path=found.object_path if found else "",
        part=Part(found.part) if found else None,
        line=found.line if found else None,
        call_stack=list(failure.call_stack),
    )


def _diagnostic(fields: dict[str, object], places: SourcePlaces) -> Diagnostic:
    line, end_line = int(str(fields["line"])), int(str(fields["end_line"]))
    found = places.locate(str(fields["file"]), line)
    return Diagnostic(
        code=str(fields["code"]),
        severity=Severity(str(fields["severity"])),
        message=str(fields["message"]),
        advice=str(fields["advice"]) if fields["advice"] else None,
        object_id=found.object_id if found else None,
        object_path=found.object_path if found else str(fields["file"]),
        part=Part(found.part) if found else None,
        line=found.line if found else None,
        column=int(str(fields["column"])) if found else None,
        end_line=found.line + end_line - line if found else None,
        end_column=int(str(fields["end_column"])) if found else None,
    )
