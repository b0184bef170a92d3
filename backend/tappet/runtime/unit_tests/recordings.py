"""Recordings of the flight recorder as tests: what today's program has to do with what was recorded."""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

from tappet.codegen.faults import Fault
from tappet.codegen.package import CodePackage
from tappet.project.kinds.flight_recording import FlightRecordingData
from tappet.project.model import Project
from tappet.runtime.exception_report import ExceptionReport
from tappet.runtime.flight_recording import FlightRecording, RecordingError, read_recording
from tappet.runtime.replay_process import ReplayOrder, ReplayResult, replay_in_process
from tappet.runtime.unit_tests.results import NO_TESTS, Failure, Report, SuiteOutcome, TestOutcome

SUITE = "Flight recordings"
BLOCK = "flight_recording"
HAS_ERRORS = "the program of the project has errors"
BuildOn = Callable[[CodePackage], CodePackage | None]
"""Builds today's program as an online change of the recorded code; None: it has errors."""


@dataclass(frozen=True, slots=True)
class RecordedTest:
    """A recording of a project."""

    name: str
    text: str
    same_fault: bool = False
    """Good when the recorded fault comes again; else when none comes."""


def recorded_tests(project: Project, application_id: str) -> tuple[RecordedTest, ...]:
    """The recordings of an application that are tests."""
    return tuple(
        RecordedTest(item.name, item.data.recording, item.data.expects == "same_fault")
        for item in project.walk(application_id)
        if isinstance(item.data, FlightRecordingData) and item.data.tested and item.data.recording
    )


def chosen_tests(tests: Sequence[RecordedTest], test_filter: str) -> list[RecordedTest]:
    """Those with this text in `suite.test`; `*` is any text, case does not count."""
    pattern = re.compile(".*".join(map(re.escape, test_filter.split("*"))), re.IGNORECASE)
    return [test for test in tests if pattern.search(full_name(test))]


def full_name(test: RecordedTest) -> str:
    """The test as `suite.test`."""
    return f"{SUITE}.{test.name}"


def replay_tests(tests: Sequence[RecordedTest], build: BuildOn) -> SuiteOutcome:
    """Replays each of them on today's program."""
    return recordings_suite([_outcome(test, build) for test in tests])


def recordings_suite(outcomes: Sequence[TestOutcome]) -> SuiteOutcome:
    """The suite that these tests make."""
    return SuiteOutcome(SUITE, BLOCK, tuple(outcomes))


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
        return impossible(test, str(error))
    if code is None:
        return impossible(test, HAS_ERRORS)
    return outcome_of(test, recording, replay_in_process(ReplayOrder(test.text, code.to_bytes())))


def impossible(test: RecordedTest, why: str) -> TestOutcome:
    """What comes of a recording that cannot be replayed."""
    return TestOutcome(test.name, "error", failures=(Failure(why),))


def outcome_of(test: RecordedTest, recording: FlightRecording, result: ReplayResult) -> TestOutcome:
    """What comes of a recording by its replay on today's program."""
    seconds = _seconds(recording, result.cycles)
    if result.problem is not None:
        return TestOutcome(test.name, "error", 1, seconds, (Failure(result.problem),))
    failure = _same_fault(result) if test.same_fault else _no_fault(result)
    if failure is None:
        return TestOutcome(test.name, "passed", 1, seconds, (), tuple(result.notes))
    return TestOutcome(test.name, "failed", 1, seconds, (failure,), tuple(result.notes))


def _no_fault(result: ReplayResult) -> Failure | None:
    fault = result.fault
    return None if fault is None else _fault(fault, f"cycle {fault.cycle}: {fault.message}")


def _same_fault(result: ReplayResult) -> Failure | None:
    recorded, fault = result.recorded, result.fault
    if recorded is None:
        return Failure("nothing has failed in the recording, so no fault can come again")
    if fault is not None and _same(fault, recorded):
        return None
    if fault is not None:
        text = f"cycle {fault.cycle}: {fault.message}"
        return _fault(fault, f"another fault than the recorded one of cycle {recorded.cycle} came: {text}")
    missing = f"the recorded fault of cycle {recorded.cycle} did not come again: {recorded.message}"
    difference = result.difference
    if difference is None:
        return Failure(missing)
    row = difference.variables[0]
    values = f"{row.name} was {row.recorded}, is {row.replayed}"
    return Failure(f"{missing}; cycle {difference.cycle} is the first that differs: {values}")


def _same(one: ExceptionReport, other: ExceptionReport) -> bool:
    """Whether two faults are the same one. The line may be another one in an edited text; where and when a
    cycle takes too long is a matter of time."""
    if (one.name, one.task.upper()) != (other.name, other.task.upper()):
        return False
    if one.name == Fault.WATCHDOG.name:
        return True
    return (one.pou.upper(), one.cycle) == (other.pou.upper(), other.cycle)


def _seconds(recording: FlightRecording, cycles: int) -> float:
    """Recorded time up to a cycle."""
    last = recording.cycles[min(cycles, len(recording.cycles) - 1)]
    return (last.timestamp_ns - recording.cycles[0].timestamp_ns) / 1e9


def _fault(fault: ExceptionReport, text: str) -> Failure:
    """A failure at the place of an exception."""
    return Failure(
        text,
        code=fault.code,
        pou=fault.pou,
        uri=fault.uri,
        line=fault.line,
        call_stack=tuple(f"{frame.pou}, line {frame.line}" for frame in fault.call_stack),
    )
