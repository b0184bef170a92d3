"""Recordings of the flight recorder as tests: good when today's program no longer fails on them."""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

from tappet.codegen.package import CodePackage
from tappet.runtime.exception_report import ExceptionReport
from tappet.runtime.flight_recording import FlightRecording, RecordingError, read_recording
from tappet.runtime.replay_process import ReplayOrder, replay_in_process
from tappet.runtime.unit_tests.results import Failure, Report, SuiteOutcome, TestOutcome
from tappet.runtime.unit_tests.runner import NO_TESTS

SUITE = "Flight recordings"
BLOCK = "flight_recording"
BuildOn = Callable[[CodePackage], CodePackage | None]
"""Builds today's program as an online change of the recorded code; None: it has errors."""


@dataclass(frozen=True, slots=True)
class RecordedTest:
    """A recording of a project."""

    name: str
    text: str


def chosen_tests(tests: Sequence[RecordedTest], test_filter: str) -> list[RecordedTest]:
    """Those with this text in `suite.test`; `*` is any text, case does not count."""
    pattern = re.compile(".*".join(map(re.escape, test_filter.split("*"))), re.IGNORECASE)
    return [test for test in tests if pattern.search(f"{SUITE}.{test.name}")]


def replay_tests(tests: Sequence[RecordedTest], build: BuildOn) -> SuiteOutcome:
    """Replays each of them on today's program."""
    return SuiteOutcome(SUITE, BLOCK, tuple(_outcome(test, build) for test in tests))


def with_recordings(report: Report, suite: SuiteOutcome) -> Report:
    """The report of an application with that of its recordings; they are tests where it has no others."""
    if not suite.tests:
        return report
    problem = None if report.problem == NO_TESTS else report.problem
    return replace(report, suites=(*report.suites, suite), problem=problem)


def _outcome(test: RecordedTest, build: BuildOn) -> TestOutcome:
    try:
        recording = read_recording(test.text)
        code = build(recording.code())
    except RecordingError as error:
        return TestOutcome(test.name, "error", failures=(Failure(str(error)),))
    if code is None:
        return TestOutcome(test.name, "error", failures=(Failure("the program of the project has errors"),))
    result = replay_in_process(ReplayOrder(test.text, code.to_bytes()))
    seconds = _seconds(recording, result.cycles)
    if result.problem is not None:
        return TestOutcome(test.name, "error", 1, seconds, (Failure(result.problem),))
    if result.fault is not None:
        return TestOutcome(test.name, "failed", 1, seconds, (_failure(result.fault),), tuple(result.notes))
    return TestOutcome(test.name, "passed", 1, seconds, (), tuple(result.notes))


def _seconds(recording: FlightRecording, cycles: int) -> float:
    """Recorded time up to a cycle."""
    last = recording.cycles[min(cycles, len(recording.cycles) - 1)]
    return (last.timestamp_ns - recording.cycles[0].timestamp_ns) / 1e9


def _failure(fault: ExceptionReport) -> Failure:
    return Failure(
        f"cycle {fault.cycle}: {fault.message}",
        code=fault.code,
        pou=fault.pou,
        uri=fault.uri,
        line=fault.line,
        call_stack=tuple(f"{frame.pou}, line {frame.line}" for frame in fault.call_stack),
    )
