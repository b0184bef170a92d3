"""Runs the tests of an application, one run at a time for each application.

The unit tests run in a process of their own. Recordings of the flight recorder that are tests follow, each
replayed in another one, on the present program as an online change of the recorded one.
"""

from __future__ import annotations

import asyncio
from collections.abc import Awaitable, Callable, Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from functools import partial

from tappet.codegen.package import CodePackage
from tappet.project.model import Project
from tappet.runtime.flight_recording import RecordingError, read_recording
from tappet.runtime.replay_process import ReplayOrder
from tappet.runtime.unit_tests.attempts import Attempts
from tappet.runtime.unit_tests.order import order
from tappet.runtime.unit_tests.recordings import (
    HAS_ERRORS,
    RecordedTest,
    chosen_tests,
    full_name,
    impossible,
    outcome_of,
    recorded_tests,
    recordings_suite,
    with_recordings,
)
from tappet.runtime.unit_tests.results import Failure, Report, SuiteOutcome, TestOutcome
from tappet.server.builds.builder import Application, Builder
from tappet.server.builds.shapes import Diagnostic, Part, Severity
from tappet.server.builds.source_places import SourcePlaces
from tappet.server.flight.replay_process import run_replay
from tappet.server.problems import Problem
from tappet.server.unit_tests.shapes import TestFailure, TestReport, TestResult, TestSuite

CANCELLED = "the run was cancelled"
BuildOn = Callable[[CodePackage], Awaitable[bytes | None]]
"""Builds the present program as an online change of the recorded code; None: it has errors."""


@dataclass(frozen=True, slots=True)
class TestedApplication:
    """An application with the recordings that are tests of it."""

    __test__ = False  # no test class of pytest

    application: Application
    recordings: tuple[RecordedTest, ...]

    @classmethod
    def of(cls, project_id: str, project: Project, application_id: str) -> TestedApplication:
        """Raises UnknownObjectError when the id is no application."""
        application = Application.of(project_id, project, application_id)
        return cls(application, recorded_tests(project, application_id))


class TestRuns:
    """The running test processes of a server."""

    __test__ = False  # no test class of pytest

    def __init__(self, builder: Builder) -> None:
        self._builder = builder
        self._running: dict[tuple[str, str], _Runner] = {}

    async def run(self, tested: TestedApplication, test_filter: str, only: Sequence[str] = ()) -> TestReport:
        """Run and wait; the process is killed when the caller goes away. 409 while a run is in progress."""
        application = tested.application
        key = (application.project_id, application.application_id)
        if key in self._running:
            raise Problem(409, "tests-running", "Tests of this application are running; wait for their end.")
        runner = self._running[key] = _Runner()
        try:
            report = await runner.run(await asyncio.to_thread(_order, application, test_filter, only))
            recordings = chosen_tests(tested.recordings, test_filter)
            if recordings and not report.diagnostics:
                suite = await runner.replay(recordings, partial(self._build_on, application), only)
                report = with_recordings(report, suite)
                if runner.cancelled:
                    report = replace(report, problem=report.problem or CANCELLED)
        finally:
            del self._running[key]
        return _reply(report, application)

    async def _build_on(self, application: Application, recorded: CodePackage) -> bytes | None:
        built = await self._builder.build(application, (recorded.code_id, recorded.to_bytes()))
        return built.package

    def cancel(self, project_id: str, application_id: str) -> bool:
        """Ends the tests of an application; False when none are running."""
        runner = self._running.get((project_id, application_id))
        if runner is None:
            return False
        runner.cancel()
        return True


class _Runner:
    """The processes of one run."""

    def __init__(self) -> None:
        self._child: asyncio.subprocess.Process | None = None
        self.cancelled = False

    async def run(self, command: bytes) -> Report:
        with Attempts(command) as attempts:
            report = None
            while report is None:
                report = await self._attempt(attempts)
            return report

    async def replay(
        self, tests: Sequence[RecordedTest], build: BuildOn, only: Sequence[str]
    ) -> SuiteOutcome:
        """The suite of the recordings. Those that are not of `only` are skipped, those behind a cancelled one
        are missing."""
        outcomes: list[TestOutcome] = []
        for test in tests:
            if self.cancelled:
                break
            if only and full_name(test) not in only:
                outcomes.append(TestOutcome(test.name, "skipped"))
                continue
            outcome = await self._replayed(test, build)
            if not self.cancelled:
                outcomes.append(outcome)
        return recordings_suite(outcomes)

    async def _replayed(self, test: RecordedTest, build: BuildOn) -> TestOutcome:
        try:
            recording = await asyncio.to_thread(read_recording, test.text)
            code = await build(await asyncio.to_thread(recording.code))
        except RecordingError as error:
            return impossible(test, str(error))
        if code is None:
            return impossible(test, HAS_ERRORS)
        result = await run_replay(ReplayOrder(test.text, code), self._started)
        return outcome_of(test, recording, result)

    def _started(self, child: asyncio.subprocess.Process) -> None:
        self._child = child
        if self.cancelled:
            self.cancel()

    def cancel(self) -> None:
        self.cancelled = True
        if self._child is not None:
            with suppress(ProcessLookupError):
                self._child.kill()

    async def _attempt(self, attempts: Attempts) -> Report | None:
        if self.cancelled:
            return attempts.ended(b"", CANCELLED)
        child = self._child = await asyncio.create_subprocess_exec(
            *attempts.command,
            stdin=asyncio.subprocess.PIPE,
            stdout=asyncio.subprocess.PIPE,
            pass_fds=attempts.pass_fds,
        )
        try:
            async with asyncio.timeout(attempts.seconds_left):
                output, _ = await child.communicate(attempts.order)
        except TimeoutError:
            return attempts.take(b"", None)
        finally:
            if child.returncode is None:
                with suppress(ProcessLookupError):
                    child.kill()
                await child.wait()
        if self.cancelled:
            return attempts.ended(output, CANCELLED)
        return attempts.take(output, child.returncode)


def _order(application: Application, test_filter: str, only: Sequence[str]) -> bytes:
    return order(
        application.name,
        application.sources,
        application.tasks,
        application.libraries,
        test_filter=test_filter,
        only=only,
        heap=application.heap,
    )


def _reply(report: Report, application: Application) -> TestReport:
    places = SourcePlaces.of(application.sources, application.paths)
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
        element=found.element if found else None,
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
        element=found.element if found else None,
        line=found.line if found else None,
        column=int(str(fields["column"])) if found else None,
        end_line=found.line + end_line - line if found else None,
        end_column=int(str(fields["end_column"])) if found else None,
    )
