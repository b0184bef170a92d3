"""Unit tests in ST: isolation, results, fixtures, sources written for TcUnit, reports."""

from __future__ import annotations

import json
from pathlib import Path
from xml.etree import ElementTree as ET

import pytest
from tests.cli.invoke import invoke

from tappet.cli.inputs import applications
from tappet.lang.parser import parse
from tappet.lang.source import Source
from tappet.runtime.unit_tests.instrument import instrument
from tappet.runtime.unit_tests.known import Mark
from tappet.runtime.unit_tests.order import TestLimits
from tappet.runtime.unit_tests.results import Failure, Report, SuiteOutcome
from tappet.runtime.unit_tests.runner import run_tests

FOLDER = Path(__file__).parent / "unit_tests"
LIMITS = TestLimits(cycle_s=2.0, simulated_s=700.0)


def run_file(name: str, test_filter: str = "") -> Report:
    (application,) = applications([FOLDER / name])
    return run_tests(
        application.sources, application.tasks, application.options, test_filter=test_filter, limits=LIMITS
    )


def run_text(text: str, limits: TestLimits = LIMITS) -> Report:
    return run_tests([Source("tests.st", text, name="tests")], limits=limits)


def outcomes(suite: SuiteOutcome) -> dict[str, str]:
    return {test.name: test.outcome for test in suite.tests}


def failures(suite: SuiteOutcome, name: str) -> tuple[Failure, ...]:
    return next(test.failures for test in suite.tests if test.name == name)


@pytest.fixture(scope="module")
def isolation() -> SuiteOutcome:
    report = run_file("isolation.st")
    assert (report.problem, report.diagnostics) == (None, ())
    (suite,) = report.suites
    return suite


def test_every_test_ends_in_its_own_way(isolation: SuiteOutcome) -> None:
    assert (isolation.name, isolation.failures) == ("FB_Isolation_Test", ())
    assert outcomes(isolation) == {
        "Passes": "passed",
        "Fails": "failed",
        "Divides": "error",
        "Loops": "error",
        "Expected": "passed",
        "ExpectedOther": "error",
        "ExpectedInVain": "failed",
        "Waits": "passed",
        "In the body": "passed",
        "Never": "skipped",
    }


def test_a_failed_assertion_says_what_and_where(isolation: SuiteOutcome) -> None:
    first, second = failures(isolation, "Fails")
    assert (first.message, first.expected, first.actual) == ("sum", "3", "4")
    text = (FOLDER / "isolation.st").read_text().splitlines()
    assert (first.pou, text[first.line - 1]) == (
        "FB_Isolation_Test.Fails",
        "AssertEquals_INT(Expected := 3, Actual := 4, Message := 'sum');",
    )
    assert text[second.line - 1].startswith("AssertFalse(")


def test_an_exception_says_what_and_where(isolation: SuiteOutcome) -> None:
    text = (FOLDER / "isolation.st").read_text().splitlines()
    assertion, exception = failures(isolation, "Divides")
    assert assertion.message == "before the exception"
    assert (exception.code, exception.message, exception.pou) == (
        1,
        "division by zero",
        "FB_Isolation_Test.Divides",
    )
    assert text[exception.line - 1] == "iZero := 5 / iZero;"
    assert exception.call_stack == (f"FB_Isolation_Test, line {text.index('Divides();') + 1}",)
    (loop,) = failures(isolation, "Loops")
    assert (loop.code, loop.pou) == (6, "FB_Isolation_Test.Loops")
    (other,) = failures(isolation, "ExpectedOther")
    assert (other.code, other.expected, other.actual) == (2, "DIV_ZERO", "ARRAY_BOUNDS")
    (none,) = failures(isolation, "ExpectedInVain")
    assert (none.expected, none.actual) == ("null reference", "no exception")


def test_faults_of_the_processor_end_only_their_test() -> None:
    report = run_file("native_faults.st")
    assert (report.problem, report.diagnostics) == (None, ())
    (suite,) = report.suites
    codes = {test.name: [failure.code for failure in test.failures] for test in suite.tests}
    assert codes == {
        "Null": [3],
        "Reads elsewhere": [4],
        "Writes elsewhere": [4],
        "Calls elsewhere": [4],
        "Stack": [5],
        "Overwrites": [4],
        "Smallest": [],
        "After": [],
    }
    assert outcomes(suite)["After"] == "passed"


def test_ten_minutes_of_the_plc_are_simulated(isolation: SuiteOutcome) -> None:
    assert next(test.seconds for test in isolation.tests if test.name == "Waits") == 600.0


def test_sources_written_for_tcunit_run_unchanged() -> None:
    report = run_file("tcunit_style.st")
    assert (report.problem, report.diagnostics) == (None, ())
    timed, types = report.suites
    assert [suite.name for suite in report.suites] == ["PRG_TEST.fbTimed", "PRG_TEST.fbTypes"]
    assert outcomes(timed) == {"LongTime": "passed", "ShortTime": "passed", "Parallel": "passed"}
    assert [test.seconds for test in timed.tests] == [10.0, 2.0, 0.0]
    assert outcomes(types) == {
        "Equal": "passed",
        "Different": "failed",
        "Arrays": "failed",
        "Protected": "passed",
    }
    assert next(test.assertions for test in types.tests if test.name == "Equal") == 16
    found = {f.message: (f.expected, f.actual) for f in failures(types, "Different")}
    assert found == {
        "byte": ("0xAB", "0xCD"),
        "text": ("x", "y"),
        "types": ("(Type class = LTIME)", "(Type class = SINT)"),
        "word": ("0x000A", "0xFFFF"),
        "number": ("1.0", "1.5"),
        "no number": ("1.0", "nan"),
    }
    found = {f.message: (f.expected, f.actual) for f in failures(types, "Arrays")}
    assert found == {
        "element": ("ARRAY[2] = 2", "ARRAY[1] = 7"),
        "size, size of arrays not matching.": ("SIZE = 3", "SIZE = 5"),
        "field": ("ARRAY[1,1] = 4.0", "ARRAY[2,2] = 4.5"),
        "bits": ("ARRAY[2] = FALSE", "ARRAY[2] = TRUE"),
    }


def test_fixtures_and_cases() -> None:
    report = run_file("fixtures.st")
    fixture, log = report.suites
    assert outcomes(log) == {"Log": "passed"}
    assert outcomes(fixture) == {
        "First": "passed",
        "Second": "passed",
        "Square (1)": "passed",
        "Square (2)": "passed",
        "Square (3)": "failed",
        "Named 1": "passed",
        "Named 2": "passed",
    }


@pytest.mark.parametrize(
    ("test_filter", "ran"),
    [
        ("fixture_test", ["First", "Second", "Square (1)", "Square (2)", "Square (3)", "Named 1", "Named 2"]),
        (".first", ["First"]),
        ("square*2", ["Square (2)"]),
        ("fixture*Log", []),
    ],
)
def test_a_filter_chooses_by_suite_and_test(test_filter: str, ran: list[str]) -> None:
    report = run_file("fixtures.st", test_filter)
    assert [t.name for suite in report.suites for t in suite.tests if t.outcome != "skipped"] == ran


def test_an_exception_outside_of_a_test_breaks_only_its_suite() -> None:
    report = run_text("""
FUNCTION_BLOCK FB_Bad_Test EXTENDS FB_TestSuite
VAR n : INT; END_VAR
n := 1 / n;
TEST('Never'); TEST_FINISHED();
END_FUNCTION_BLOCK
FUNCTION_BLOCK FB_Good_Test EXTENDS FB_TestSuite
TEST('Fine'); AssertTrue(TRUE, ''); TEST_FINISHED();
END_FUNCTION_BLOCK
""")
    bad, good = report.suites
    assert (bad.failures[0].message, bad.failures[0].line, bad.tests) == ("division by zero", 4, ())
    assert outcomes(good) == {"Fine": "passed"}
    assert not report.ok


def test_what_never_finishes_is_said() -> None:
    text = """
FUNCTION_BLOCK FB_Slow_Test EXTENDS FB_TestSuite
TEST('Slow');
IF TEST_ORDERED('One') THEN AssertTrue(TRUE, ''); END_IF
IF TEST_ORDERED('Two') THEN TEST_FINISHED(); END_IF
END_FUNCTION_BLOCK
"""
    (suite,) = run_text(text, TestLimits(simulated_s=1.0)).suites
    assert outcomes(suite) == {"Slow": "error", "One": "error", "Two": "error"}
    assert "TEST_FINISHED was not called" in failures(suite, "One")[0].message
    assert "never was its turn" in failures(suite, "Two")[0].message


def test_errors_of_the_program_are_shown_as_written() -> None:
    head = "FUNCTION_BLOCK FB_X_Test EXTENDS FB_TestSuite\n"
    report = run_text(f"{head}TEST('a'); nowhere := 1; TEST_FINISHED();\nEND_FUNCTION_BLOCK")
    assert [(d["line"], d["column"], d["code"]) for d in report.diagnostics] == [(2, 12, "E0201")]
    assert not report.ok


def test_nothing_to_test_is_said() -> None:
    report = run_text("FUNCTION F : INT\nEND_FUNCTION")
    assert report.problem is not None
    assert "no tests" in report.problem


@pytest.mark.parametrize(
    ("body", "expected"),
    [
        (
            "TEST('a'); x(); TEST_FINISHED(); y();",
            "IF TAPPET_TEST('a') THEN TAPPET_MARK(1); x(); TEST_FINISHED(); END_IF; y();",
        ),
        ("TEST('a'); x();\nTEST('b');", "IF TAPPET_TEST('a') THEN TAPPET_MARK(1); x(); END_IF;\nTEST('b');"),
        (
            "TcUnit.TEST(TestName := 'a');\nIF q THEN TEST_FINISHED(); END_IF // ;",
            "IF TcUnit.TAPPET_TEST(TestName := 'a') THEN TAPPET_MARK(1);\n"
            "IF q THEN TEST_FINISHED(); END_IF END_IF; // ;",
        ),
        (
            "TEST('a'); AssertTrue(x, ';'); TEST_FINISHED();",
            "IF TAPPET_TEST('a') THEN TAPPET_MARK(1); TAPPET_MARK(2); AssertTrue(x, ';'); "
            "TEST_FINISHED(); END_IF;",
        ),
    ],
)
def test_tests_are_made_switchable_on_their_lines(body: str, expected: str) -> None:
    marks: list[Mark] = []
    source = Source("m", f"METHOD m\n{body}\nEND_METHOD", owner="FB")
    text = instrument(source, marks).text
    assert text == f"METHOD m\n{expected}\nEND_METHOD"
    assert parse(Source("m", text)).diagnostics == []
    assert marks == [Mark("m", "FB.m", 2)] * expected.count("MARK")


def test_a_report_comes_back_from_json(isolation: SuiteOutcome) -> None:
    report = Report("App", (isolation,))
    assert Report.from_dict(json.loads(json.dumps(report.to_dict()))) == report


def test_the_command(tmp_path: Path) -> None:
    file, xml = tmp_path / "t.st", tmp_path / "t.xml"
    file.write_text(
        "FUNCTION_BLOCK FB_A_Test EXTENDS FB_TestSuite\n"
        "TEST('good'); AssertTrue(TRUE, ''); TEST_FINISHED();\n"
        "TEST('bad'); AssertTrue(FALSE, 'wrong'); TEST_FINISHED();\nEND_FUNCTION_BLOCK\n"
    )
    shown = invoke("test", file, "--junit", xml)
    assert shown.code == 1
    assert "FAILED  bad" in shown.output
    assert "2 tests: 1 passed, 1 failed" in shown.output
    assert len(ET.parse(xml).findall(".//failure")) == 1
    shown = invoke("test", file, "--filter", "good", "--format", "json")
    assert shown.code == 0
    assert [t["outcome"] for t in json.loads(shown.output)["suites"][0]["tests"]] == ["passed", "skipped"]
    assert invoke("test", tmp_path / "nothing").code == 2
