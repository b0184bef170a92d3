"""The variables of the test library seen from Python: what is switched off at a start, and the results."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from typing import Any

from tappet.codegen.faults import Fault
from tappet.codegen.symbol_map import SymbolError, SymbolMap
from tappet.runtime.exception_report import ExceptionReport
from tappet.runtime.local import LocalRuntime
from tappet.runtime.unit_tests.discovery import PROGRAM, TEST_LIBRARY
from tappet.runtime.unit_tests.known import (
    BROKEN,
    FAILED,
    NOTHING,
    PASSED,
    SKIPPED,
    WAITING,
    Known,
    KnownTest,
    Mark,
)
from tappet.runtime.unit_tests.results import Failure, Outcome, SuiteOutcome, TestOutcome

_OUTCOMES: dict[int, Outcome] = {PASSED: "passed", FAILED: "failed", SKIPPED: "skipped", BROKEN: "error"}
NS_PER_S = 1_000_000_000
LONGEST_NAME = 255
MOST_CHOSEN = 500
"""Tests that can be chosen by name: MAX_ONLY of the library."""
_SHOWN_CALLERS = 20
_KINDS = ((4, "error: "), (2, "warning: "))
"""Bits of ADSLOG_MSGTYPE_... that a line is marked for."""


@dataclass(slots=True)
class _Suite:
    path: str
    block: str
    broken: bool = False
    failures: list[Failure] = field(default_factory=list)


@dataclass(slots=True)
class _Test:
    """One test over all starts of the application."""

    suite: int
    name: str
    state: int = WAITING
    record: dict[str, Any] = field(default_factory=dict)
    outcome: TestOutcome | None = None
    """Known for good."""
    order: int = 0
    """Its place in the order of the calls of the last start that called it."""


class Bench:
    """Suites and tests of one application, over all its starts."""

    def __init__(self, symbols: SymbolMap, marks: Sequence[Mark], known: Known = NOTHING) -> None:
        self._symbols = symbols
        self._marks = marks
        self._known = known
        self._root = _root(symbols)
        self._suites: list[_Suite] = []
        self._tests = [
            _Test(k.suite, k.outcome.name, k.state, {"xOrdered": k.ordered}, k.outcome) for k in known.tests
        ]
        self.complete = False
        """Every test has its outcome."""

    # -- before a start --------------------------------------------------------------------------------

    def prepare(
        self, runtime: LocalRuntime, test_filter: str, only: Sequence[str] = (), place: int = 0
    ) -> None:
        """Hands the library what is to run, the outcomes of earlier starts, and the address where it keeps
        which test runs.
        """
        if not self._suites:
            self._read_suites(runtime)
        if place:
            runtime.write(f"{self._root}.pPlace", place)
        values: dict[str, Any] = {f"{self._root}.sFilter": test_filter, f"{self._root}.diOnly": len(only)}
        values |= {f"{self._root}.asOnly[{n}]": name[:LONGEST_NAME] for n, name in enumerate(only, 1)}
        known = [test for test in self._tests if test.outcome is not None]
        for number, test in enumerate(known, 1):
            at = f"{self._root}.aTest[{number}]"
            values |= {
                f"{at}.sName": test.name,
                f"{at}.diSuite": test.suite,
                f"{at}.eState": test.state,
                f"{at}.xOrdered": bool(test.record.get("xOrdered")),
            }
        values[f"{self._root}.diTests"] = len(known)
        for number, suite in enumerate(self._suites, 1):
            values[f"{self._root}.asPath[{number}]"] = suite.path
            if suite.broken:
                values[f"{self._root}.axBroken[{number}]"] = True
        self._tests = known
        for path, value in values.items():
            runtime.write(path, value)

    def _read_suites(self, runtime: LocalRuntime) -> None:
        for number in range(1, self._number(runtime, "diSuites") + 1):
            # Device.Application.PRG_TEST.fbSuite
            path = str(runtime.read(f"{self._root}.asPath[{number}]")).split(".", 2)[-1]
            block = self._symbols.resolve(path).type.name
            made = path.upper().startswith(f"{PROGRAM}.".upper())
            failures = [failure for suite, failure in self._known.suites if suite == number]
            suite = _Suite(block if made else path, block, bool(failures), failures)
            self._suites.append(suite)

    # -- afterwards ------------------------------------------------------------------------------------

    def finished(self, runtime: LocalRuntime) -> bool:
        """Whether every test has finished."""
        return bool(runtime.read(f"{self._root}.xFinished"))

    def overflow(self, runtime: LocalRuntime) -> str | None:
        """A sentence when the library had no room for all tests."""
        if runtime.read(f"{self._root}.xOverflow"):
            return "there are more tests or suites than the library has room for; test in parts with a filter"
        return None

    def collect(self, runtime: LocalRuntime) -> None:
        """Takes over what the library has recorded in this start."""
        failures = self._failures(runtime)
        lines = self._lines(runtime)
        for number in range(1, self._number(runtime, "diTests") + 1):
            record: Any = runtime.read(f"{self._root}.aTest[{number}]")
            if number <= len(self._tests):
                test = self._tests[number - 1]
            else:
                test = _Test(record["diSuite"], record["sName"])
                self._tests.append(test)
            test.order = record["diOrder"] or test.order
            if test.outcome is None:
                test.state, test.record = record["eState"], record
                if test.state in _OUTCOMES:
                    test.outcome = self._outcome(test, failures.get(number, []), lines.get(number, []))

    def broken(self, runtime: LocalRuntime, report: ExceptionReport, note: str = "") -> str | None:
        """Gives the exception to the test, or else the suite, that it happened in; `note` continues with its
        message.
        """
        number = self._number(runtime, "diTest")
        test = self._tests[number - 1] if 0 < number <= len(self._tests) else None
        suite = self._number(runtime, "diSuite")
        failure = _exception(report, note)
        if test is not None and test.outcome is None:
            expected = test.record.get("iExpected", 0)
            failures = self._failures(runtime).get(number, [])
            if expected == report.code and not failures:
                test.state = PASSED
                outcome = self._outcome(test, [], self._lines(runtime).get(number, []))
                test.outcome = replace(outcome, assertions=test.record["diAsserts"] + 1)
            else:
                if expected and expected != report.code:
                    failure = replace(failure, expected=Fault(expected).name, actual=report.name)
                test.state = BROKEN
                output = self._lines(runtime).get(number, [])
                test.outcome = self._outcome(test, [*failures, failure], output)
            test.state = BROKEN  # its code must not run again
            return None
        if 0 < suite <= len(self._suites) and not self._suites[suite - 1].broken:
            self._suites[suite - 1].broken = True
            self._suites[suite - 1].failures.append(failure)
            return None
        place = f" in {failure.pou}, line {failure.line}" if failure.pou else ""
        return f"the test program ended in an exception outside of a suite: {failure.message}{place}"

    def give_up(self, seconds: float) -> None:
        """What has not finished by now never will."""
        self.complete = True
        for test in self._tests:
            if test.outcome is None:
                waiting = "it never was its turn" if test.state == WAITING else "TEST_FINISHED was not called"
                message = f"not finished after {seconds:g} s of simulated time: {waiting}"
                test.outcome = TestOutcome(test.name, "error", failures=(Failure(message),))
        if not any(test.outcome for test in self._tests):
            for suite in self._suites:
                suite.failures.append(
                    Failure("no test of the suite was begun; is RUN called in every cycle?")
                )

    def suites(self) -> tuple[SuiteOutcome, ...]:
        """The results so far, in the order in which the tests are called."""
        ordered = sorted(self._tests, key=lambda test: test.order or len(self._tests))
        return tuple(
            SuiteOutcome(
                suite.path,
                suite.block,
                tuple(t.outcome for t in ordered if t.suite == number and t.outcome is not None),
                tuple(suite.failures),
            )
            for number, suite in enumerate(self._suites, 1)
        )

    def known(self) -> Known:
        """What is known for good, for a bench of the same application in another process."""
        tests = [
            KnownTest(t.suite, t.state, bool(t.record.get("xOrdered")), t.outcome)
            for t in self._tests
            if t.outcome is not None
        ]
        suites = [
            (n, failure)
            for n, suite in enumerate(self._suites, 1)
            for failure in suite.failures
            if suite.broken
        ]
        return Known(tuple(tests), tuple(suites))

    # -- values ----------------------------------------------------------------------------------------

    def _number(self, runtime: LocalRuntime, name: str) -> int:
        value = runtime.read(f"{self._root}.{name}")
        assert isinstance(value, int)
        return value

    def _outcome(self, test: _Test, failures: list[Failure], output: list[str]) -> TestOutcome:
        record = test.record
        seconds = max(0, record["tEnd"] - record["tBegin"]) / NS_PER_S
        return TestOutcome(
            test.name,
            _OUTCOMES[test.state],
            record["diAsserts"],
            seconds,
            tuple(failures),
            tuple(output),
        )

    def _lines(self, runtime: LocalRuntime) -> dict[int, list[str]]:
        """What was written in this start by the number of the test."""
        found: dict[int, list[str]] = {}
        room = self._symbols.resolve(f"{self._root}.aLine").type.bounds[0][1]
        for number in range(1, min(self._number(runtime, "diLines"), room) + 1):
            line: Any = runtime.read(f"{self._root}.aLine[{number}]")
            kind = next((word for bit, word in _KINDS if line["dwKind"] & bit), "")
            found.setdefault(line["diTest"], []).append(kind + line["sText"])
        return found

    def _blame(self, number: int, failure: Failure) -> None:
        """Something is wrong with a suite; other starts find it again."""
        if 0 < number <= len(self._suites) and failure not in self._suites[number - 1].failures:
            self._suites[number - 1].failures.append(failure)

    def _failures(self, runtime: LocalRuntime) -> dict[int, list[Failure]]:
        """The failed assertions of this start by the number of their test; those of a suite go to it."""
        found: dict[int, list[Failure]] = {}
        count = self._number(runtime, "diFailures")
        room = self._symbols.resolve(f"{self._root}.aFailure").type.bounds[0][1]
        for number in range(1, min(count, room) + 1):
            record: Any = runtime.read(f"{self._root}.aFailure[{number}]")
            mark = record["diMark"]
            place = self._marks[mark - 1] if 0 < mark <= len(self._marks) else Mark("", "", 0)
            if not record["diTest"]:
                self._blame(record["diSuite"], Failure(record["sMessage"]))
                continue
            found.setdefault(record["diTest"], []).append(
                Failure(
                    record["sMessage"],
                    record["sExpected"],
                    record["sActual"],
                    pou=place.pou,
                    uri=place.uri,
                    line=place.line,
                )
            )
        return found


def _root(symbols: SymbolMap) -> str:
    for name in (f"{TEST_LIBRARY}.TestBench", "TestBench"):
        try:
            symbols.resolve(f"{name}.diTests")
        except SymbolError:
            continue
        return name
    raise SymbolError("the test library is not in the application")


def _exception(report: ExceptionReport, note: str) -> Failure:
    callers = [
        f"{frame.pou}, line {frame.line}"
        for frame in report.call_stack[1:_SHOWN_CALLERS]
        if frame.pou != PROGRAM and not frame.pou.startswith(f"{TEST_LIBRARY}.")
    ]
    return Failure(
        report.message + note,
        code=report.code,
        pou=report.pou,
        uri=report.uri,
        line=report.line,
        call_stack=tuple(callers),
    )
