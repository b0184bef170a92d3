"""What came of the tests: plain data, the same for the command line, REST and JUnit XML."""

from __future__ import annotations

from dataclasses import asdict, dataclass, field
from typing import Any, Literal

NO_TESTS = "there are no tests: no block extends FB_TestSuite"
Outcome = Literal["passed", "failed", "error", "skipped"]
"""failed: an assertion did not hold; error: an exception, or the test never finished."""


@dataclass(frozen=True, slots=True)
class Failure:
    """Why a test is not good: an assertion, or an exception of the application."""

    message: str
    expected: str | None = None
    actual: str | None = None
    code: int = 0
    """Number of the exception, 0 for assertions."""
    pou: str = ""
    uri: str = ""
    line: int = 0
    """From 1; 0 where the place is not known."""
    call_stack: tuple[str, ...] = ()

    @property
    def is_assertion(self) -> bool:
        """Whether an assertion did not hold; else an exception came or the test never finished."""
        return self.code == 0 and self.expected is not None


@dataclass(frozen=True, slots=True)
class TestOutcome:
    """One test."""

    name: str
    outcome: Outcome
    assertions: int = 0
    seconds: float = 0.0
    """Time of the PLC from its begin to its end: simulated time."""
    failures: tuple[Failure, ...] = ()
    output: tuple[str, ...] = ()
    """Lines it has written with TCUNIT_ADSLOGSTR."""

    __test__ = False  # no test class of pytest


@dataclass(frozen=True, slots=True)
class SuiteOutcome:
    """One instance of a suite with its tests in the order of their first call."""

    name: str
    """Where the instance is declared, such as `PRG_TEST.fbMotor`, or the block's own name."""
    block: str
    tests: tuple[TestOutcome, ...] = ()
    failures: tuple[Failure, ...] = ()
    """What went wrong outside of a test."""


@dataclass(frozen=True, slots=True)
class Report:
    """A whole run."""

    application: str
    suites: tuple[SuiteOutcome, ...] = ()
    problem: str | None = None
    """Why nothing, or not everything, was run."""
    diagnostics: tuple[dict[str, Any], ...] = field(default=())
    """Messages of the compiler when the program has errors."""

    def count(self, outcome: Outcome) -> int:
        """Tests with this outcome."""
        return sum(test.outcome == outcome for suite in self.suites for test in suite.tests)

    @property
    def total(self) -> int:
        """All tests."""
        return sum(len(suite.tests) for suite in self.suites)

    @property
    def ok(self) -> bool:
        """Whether everything ran and passed, or was switched off."""
        broken = any(suite.failures for suite in self.suites)
        return not (self.problem or self.diagnostics or broken or self.count("failed") or self.count("error"))

    def to_dict(self) -> dict[str, Any]:
        """Plain data with the counts."""
        counts = {name: self.count(name) for name in ("passed", "failed", "error", "skipped")}
        return {"ok": self.ok, "total": self.total, **counts, **asdict(self)}

    @classmethod
    def from_dict(cls, data: dict[str, Any]) -> Report:
        """Inverse of `to_dict`."""
        return cls(
            data["application"],
            tuple(_suite(suite) for suite in data["suites"]),
            data["problem"],
            tuple(data["diagnostics"]),
        )


def _suite(data: dict[str, Any]) -> SuiteOutcome:
    return SuiteOutcome(
        data["name"],
        data["block"],
        tuple(outcome_of(test) for test in data["tests"]),
        tuple(failure_of(f) for f in data["failures"]),
    )


def outcome_of(data: dict[str, Any]) -> TestOutcome:
    """A test from plain data."""
    failures = tuple(failure_of(f) for f in data["failures"])
    return TestOutcome(**{**data, "failures": failures, "output": tuple(data.get("output", ()))})


def failure_of(data: dict[str, Any]) -> Failure:
    """A failure from plain data."""
    return Failure(**{**data, "call_stack": tuple(data["call_stack"])})
