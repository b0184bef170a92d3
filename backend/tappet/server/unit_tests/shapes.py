"""Unit tests of an application: the results tree."""

from __future__ import annotations

from datetime import datetime
from typing import ClassVar, Literal

from pydantic import Field

from tappet.server.builds.shapes import Diagnostic, Part
from tappet.server.shapes import Reply, Request


class TestOrder(Request):
    """What is to be run."""

    __test__ = False  # no test class of pytest

    filter: str = Field(
        default="", max_length=200, description="Only tests with this in suite.test; * is any text."
    )
    only: list[str] = Field(
        default=[], max_length=500, description="Only these tests, as suite.test; empty: all."
    )


class TestFailure(Reply):
    """Why a test is not good: an assertion that did not hold, or an exception, and where."""

    __test__ = False
    SENTENCES: ClassVar = ("message",)

    message: str
    expected: str | None
    actual: str | None
    code: int = Field(description="Number of the exception; 0 for assertions.")
    pou: str
    object_id: str | None = Field(description="Null for library texts and where the place is not known.")
    object_path: str
    part: Part | None
    element: str | None = Field(default=None, description="Id of the element in a drawn part.")
    line: int | None
    call_stack: list[str]


class TestResult(Reply):
    """One test."""

    __test__ = False

    name: str
    outcome: Literal["passed", "failed", "error", "skipped"]
    assertions: int
    seconds: float = Field(description="Simulated time from its begin to its end.")
    failures: list[TestFailure]


class TestSuite(Reply):
    """One instance of a suite."""

    __test__ = False

    name: str
    block: str
    object_id: str | None
    tests: list[TestResult]
    failures: list[TestFailure] = Field(description="What went wrong outside of a test.")


class TestReport(Reply):
    """All suites of an application."""

    __test__ = False
    SENTENCES: ClassVar = ("problem",)

    ok: bool
    total: int
    passed: int
    failed: int
    error: int
    skipped: int
    problem: str | None = Field(description="Why nothing, or not everything, was run.")
    suites: list[TestSuite]
    diagnostics: list[Diagnostic] = Field(description="Errors of the program; nothing was run then.")


class TestRun(Reply):
    """The last run of the tests of an application."""

    __test__ = False

    at: datetime = Field(description="When it ended.")
    username: str = Field(description="Who started it.")
    revision: int = Field(description="Of the project that was tested.")
    seconds: float = Field(description="What it took.")
    outdated: bool = Field(description="What was tested has changed since.")
    report: TestReport
