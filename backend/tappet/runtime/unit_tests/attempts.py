"""Test processes one after the other until every test has an outcome.

A test that kills its process gets that as its outcome; the others run on in a new process.
"""

from __future__ import annotations

import json
import signal
import sys
import time
from dataclasses import dataclass, replace
from typing import Any

import msgpack

from tappet.runtime.unit_tests.known import NOTHING, Known, Mark
from tappet.runtime.unit_tests.place import Place, PlacePage
from tappet.runtime.unit_tests.results import Failure, Report, TestOutcome

COMMAND = (sys.executable, "-m", "tappet.runtime.unit_tests.process")
WALL_LIMIT_S = 600.0
"""A run that takes longer is ended; restarts after endless loops take their time."""
MOST_PROCESSES = 100
NO_MEMORY, FRESH = 71, 72
"""Exit codes: memory ran out outside of the application; what is left needs a new process."""


@dataclass(frozen=True, slots=True)
class _Written:
    """What a process has written before it ended."""

    report: Report
    known: Known
    marks: tuple[Mark, ...]


class Attempts:
    """The processes of one run: start `command` with `order` as its input and `pass_fds`, `take` its end."""

    def __init__(self, order: bytes) -> None:
        self._content: dict[str, Any] = msgpack.unpackb(order, raw=False, strict_map_key=False)
        self._page = PlacePage()
        self._last = _Written(Report(""), NOTHING, ())
        self._processes = 0
        self._end = time.monotonic() + WALL_LIMIT_S

    def __enter__(self) -> Attempts:
        return self

    def __exit__(self, *_: object) -> None:
        self._page.close()

    @property
    def command(self) -> tuple[str, ...]:
        """What to start."""
        return (*COMMAND, str(self._page.fd))

    @property
    def pass_fds(self) -> tuple[int, ...]:
        """Files that the process needs open."""
        return (self._page.fd,)

    @property
    def order(self) -> bytes:
        """What the next process reads."""
        self._page.clear()
        self._processes += 1
        content = {**self._content, "known": self._last.known.to_dict()}
        packed: bytes = msgpack.packb(content, use_bin_type=True)
        return packed

    @property
    def place(self) -> Place:
        """What runs in the present process, or ran last in the one that has ended."""
        return self._page.read()

    @property
    def seconds_left(self) -> float:
        """Wall time for the next process."""
        return max(0.0, self._end - time.monotonic())

    def take(self, output: bytes, code: int | None) -> Report | None:
        """The report; None: start another process. `code` None: it took too long and was ended."""
        written = self._read(output)
        if code == 0:
            return written.report
        place = self._page.read()
        report = written.report
        if code is None:
            return self.ended(output, f"the tests took longer than {WALL_LIMIT_S:g} s and were ended")
        if code != FRESH:
            failure = _failure(code, report, place, written.marks)
            known = _with_failure(written.known, place, failure, len(report.suites))
            if known is None:
                return replace(report, problem=f"{_death(code)}; {_REST}")
            report = _added(report, place, failure, outside=len(known.suites) > len(written.known.suites))
            written = replace(written, report=report, known=known)
        self._last = written
        if self._processes >= MOST_PROCESSES:
            return replace(report, problem=f"given up after {MOST_PROCESSES} processes; {_REST}")
        return None

    def ended(self, output: bytes, why: str) -> Report:
        """The report of a run that was ended from outside."""
        report = self._read(output).report
        return replace(report, problem=why + _name(report, self._page.read()))

    def _read(self, output: bytes) -> _Written:
        """What a process has written; one that has not come to its tests knows what those before knew."""
        written = _read(output)
        ran = written.report.suites or written.report.problem or written.report.diagnostics
        return written if ran else replace(self._last, marks=written.marks)


_REST = "the tests that had not finished before have no result"


def _read(output: bytes) -> _Written:
    """Lines up to the first that is not whole."""
    report, known = Report(""), NOTHING
    marks: tuple[Mark, ...] = ()
    for text in output.splitlines():
        try:
            line = json.loads(text)
        except ValueError:
            break
        if "marks" in line:
            marks = tuple(Mark(*mark) for mark in line["marks"])
        if "report" in line:
            report, known = Report.from_dict(line["report"]), Known.from_dict(line["known"])
    return _Written(report, known, marks)


def _with_failure(known: Known, place: Place, failure: Failure, suites: int) -> Known | None:
    """What is known with what ended the process; None where that leads nowhere."""
    if not 0 < place.suite <= suites:
        return None
    if place.test and not known.has(place.suite, place.test):
        outcome = TestOutcome(place.test, "error", failures=(failure,))
        return known.with_test(place.suite, place.ordered, outcome)
    return None if known.is_broken(place.suite) else known.with_suite(place.suite, failure)


def _added(report: Report, place: Place, failure: Failure, *, outside: bool) -> Report:
    suites = list(report.suites)
    suite = suites[place.suite - 1]
    if outside:
        suite = replace(suite, failures=(*suite.failures, failure))
    else:
        suite = replace(suite, tests=(*suite.tests, TestOutcome(place.test, "error", failures=(failure,))))
    suites[place.suite - 1] = suite
    return replace(report, suites=tuple(suites))


def _failure(code: int, report: Report, place: Place, marks: tuple[Mark, ...]) -> Failure:
    """Why a process ended, with the last place that its test had reached."""
    if 0 < place.mark <= len(marks):
        mark = marks[place.mark - 1]
        return Failure(_death(code), pou=mark.pou, uri=mark.uri, line=mark.line)
    block = report.suites[place.suite - 1].block if 0 < place.suite <= len(report.suites) else ""
    return Failure(_death(code), pou=block, uri=block)


def _death(code: int) -> str:
    if code == NO_MEMORY:
        return "out of memory"
    if code > 0:
        return f"the test process ended with code {code}"
    name = signal.Signals(-code).name if -code in set(signal.Signals) else f"signal {-code}"
    hint = {
        "SIGKILL": "; the system does so when memory runs out",
        "SIGSEGV": "; memory beside that of __NEW was overwritten, or __DELETE got what is not from __NEW",
        "SIGABRT": "; the C library does so when memory of __NEW is damaged",
    }.get(name, "")
    return f"the process was killed ({name}{hint})"


def _name(report: Report, place: Place) -> str:
    if not 0 < place.suite <= len(report.suites):
        return ""
    name = report.suites[place.suite - 1].name
    return (
        f"; the last one that ran was {name}.{place.test}" if place.test else f"; the last suite was {name}"
    )
