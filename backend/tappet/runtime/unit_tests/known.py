"""What came of tests so far, handed from one test process to the next: plain data."""

from __future__ import annotations

from dataclasses import asdict, dataclass
from typing import Any

from tappet.runtime.unit_tests.results import Failure, TestOutcome, failure_of, outcome_of

WAITING, RUNNING, PASSED, FAILED, SKIPPED, BROKEN = range(6)
"""TEST_STATE of the library."""


@dataclass(frozen=True, slots=True)
class Mark:
    """Where an assertion stands, or a test begins."""

    uri: str
    pou: str
    line: int
    """From 1."""


@dataclass(frozen=True, slots=True)
class KnownTest:
    """A test whose outcome is known for good."""

    suite: int
    """Number of the suite, from 1."""
    state: int
    """TEST_STATE; a BROKEN one must not run again."""
    ordered: bool
    outcome: TestOutcome


@dataclass(frozen=True, slots=True)
class Known:
    """Tests with their outcomes, and the suites that must not be called again."""

    tests: tuple[KnownTest, ...] = ()
    suites: tuple[tuple[int, Failure], ...] = ()
    """Number of a suite, and what happened outside of its tests."""

    def has(self, suite: int, test: str) -> bool:
        """Whether the outcome of a test is known."""
        return any(k.suite == suite and k.outcome.name == test for k in self.tests)

    def is_broken(self, suite: int) -> bool:
        """Whether a suite must not be called again."""
        return any(number == suite for number, _ in self.suites)

    def with_test(self, suite: int, ordered: bool, outcome: TestOutcome) -> Known:
        """As it is, and a test that must not run again."""
        return Known((*self.tests, KnownTest(suite, BROKEN, ordered, outcome)), self.suites)

    def with_suite(self, suite: int, failure: Failure) -> Known:
        """As it is, and a suite that must not be called again."""
        return Known(self.tests, (*self.suites, (suite, failure)))

    def to_dict(self) -> dict[str, Any]:
        """Plain data."""
        return asdict(self)

    @classmethod
    def from_dict(cls, data: dict[str, Any]) -> Known:
        """Inverse of `to_dict`."""
        tests = (KnownTest(**{**test, "outcome": outcome_of(test["outcome"])}) for test in data["tests"])
        return cls(tuple(tests), tuple((number, failure_of(f)) for number, f in data["suites"]))


NOTHING = Known()
