"""Suites written for TcUnit: names, waiting, texts of failed assertions, lines, libraries they use."""

from __future__ import annotations

from pathlib import Path

import pytest

from tappet.cli.inputs import applications
from tappet.codegen.build import BuildOptions, LibraryReference
from tappet.iec.task import Task
from tappet.runtime.unit_tests.results import Report, SuiteOutcome, TestOutcome
from tappet.runtime.unit_tests.runner import run_tests

FOLDER = Path(__file__).parent / "unit_tests"


def run(name: str) -> Report:
    (application,) = applications([FOLDER / name])
    return run_tests(application.sources, application.tasks, application.options)


@pytest.fixture(scope="module")
def suites() -> dict[str, SuiteOutcome]:
    report = run("tcunit_details.st")
    assert (report.problem, report.diagnostics) == (None, ())
    return {suite.block: suite for suite in report.suites}


def test(suite: SuiteOutcome, name: str) -> TestOutcome:
    return next(t for t in suite.tests if t.name == name)


test.__test__ = False  # type: ignore[attr-defined]


def test_names_lose_blanks_and_the_prefix_that_disables(suites: dict[str, SuiteOutcome]) -> None:
    assert {t.name: t.outcome for t in suites["FB_Names_Test"].tests} == {
        "blanks around": "passed",
        "InLowerCase": "skipped",
        "Ordered": "skipped",
        "AfterDisabled": "passed",
        "Twice": "passed",
        "Unknown": "passed",
    }


def test_wrong_names_are_said_once(suites: dict[str, SuiteOutcome]) -> None:
    assert [f.message for f in suites["FB_Names_Test"].failures] == [
        "the suite has two tests of this name, the second is left out: Twice",
        "TEST_FINISHED_NAMED: the suite has no test of this name: Unkown",
    ]
    assert [suite.failures for name, suite in suites.items() if name != "FB_Names_Test"] == [(), ()]


def test_assertions_wait(suites: dict[str, SuiteOutcome]) -> None:
    found = {t.name: (t.outcome, t.assertions, t.seconds) for t in suites["FB_Await_Test"].tests}
    assert found == {
        "LongEnough": ("passed", 1, 3.0),
        "TooShort": ("failed", 1, 1.0),
        "AfterTheEnd": ("passed", 0, 0.0),
    }


def test_values_are_shown_as_tcunit_shows_them(suites: dict[str, SuiteOutcome]) -> None:
    values = test(suites["FB_Text_Test"], "Values")
    assert [(f.message, f.expected, f.actual) for f in values.failures] == [
        ("types", "(Type class = INT)", "(Type class = DINT)"),
        ("sizes", "(Data size = 4)", "(Data size = 8)"),
        ("contents", "0x00000000", "0x00000201"),
        (
            "three, size of arrays not matching.",
            "SIZE = [-5..-4,0..2,-1..0] (2x3x2)",
            "SIZE = [0..1,3..5,6..6] (2x3x1)",
        ),
        ("element", "ARRAY[-4,2,0] = 0.0", "ARRAY[2,3,2] = 1.5"),
        ("two, size of arrays not matching.", "SIZE = [-4..-2,-1..0] (3x2)", "SIZE = [1..2,0..1] (2x2)"),
        ("", "other", "words"),
    ]
    assert values.assertions == 9


def test_lines_are_the_output_of_their_test(suites: dict[str, SuiteOutcome]) -> None:
    lines = test(suites["FB_Text_Test"], "Lines")
    assert (lines.outcome, lines.output) == ("passed", ("step 2 of 3", "error: no argument"))
    assert test(suites["FB_Text_Test"], "Values").output == ()


def test_the_libraries_of_a_twincat_project_are_there() -> None:
    (application,) = applications([FOLDER / "twincat_libraries.st"])
    references = [
        LibraryReference("Tc2_Standard, * (Beckhoff Automation GmbH)"),
        LibraryReference("Tc2_System, * (Beckhoff Automation GmbH)"),
        LibraryReference("Tc3_Module, * (Beckhoff Automation GmbH)"),
        LibraryReference("TcUnit, * (www.tcunit.org)"),
    ]
    task = Task("PlcTask", interval_ns=2_000_000, programs=("PRG_TEST",))
    report = run_tests(application.sources, (task,), BuildOptions(libraries=tuple(references)))
    assert (report.problem, report.diagnostics) == (None, ())
    (suite,) = report.suites
    assert [(t.name, t.outcome, t.failures) for t in suite.tests] == [
        ("Memory", "passed", ()),
        ("Counter", "passed", ()),
    ]
    assert test(suite, "Counter").seconds == pytest.approx(0.25)
