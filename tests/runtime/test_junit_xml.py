"""JUnit XML: what the usual schema (junit-4.xsd of Jenkins) allows, and what XML cannot hold."""

from __future__ import annotations

import re
from xml.etree import ElementTree as ET

from tappet.runtime.unit_tests.junit import to_xml
from tappet.runtime.unit_tests.results import Failure, Outcome, Report, SuiteOutcome, TestOutcome

# element: required and further attributes, elements inside
SCHEMA: dict[str, tuple[set[str], set[str], set[str]]] = {
    "testsuites": (set(), {"name", "time", "tests", "failures", "disabled", "errors"}, {"testsuite"}),
    "testsuite": (
        {"name", "tests"},
        {"failures", "errors", "time", "disabled", "skipped", "timestamp", "hostname", "id", "package"},
        {"properties", "testcase", "system-out", "system-err"},
    ),
    "testcase": (
        {"name", "classname"},
        {"assertions", "time", "status"},
        {"skipped", "error", "failure", "system-out", "system-err"},
    ),
    "failure": (set(), {"type", "message"}, set()),
    "error": (set(), {"type", "message"}, set()),
    "skipped": (set(), set(), set()),
    "system-out": (set(), set(), set()),
}
NUMBERS = re.compile(r"\d+")
SECONDS = re.compile(r"\d+\.\d{3}")


def faults(element: ET.Element) -> list[str]:
    """Where a document is not as the schema says, and counts that are wrong."""
    required, optional, inside = SCHEMA[element.tag]
    given = set(element.keys())
    found = [f"{element.tag} without {name}" for name in required - given]
    found += [f"{element.tag} with {name}" for name in given - required - optional]
    for name in {"tests", "failures", "errors", "skipped", "disabled", "assertions"} & given:
        if not NUMBERS.fullmatch(element.get(name, "")):
            found.append(f"{element.tag} {name} is no number")
    if "time" in given and not SECONDS.fullmatch(element.get("time", "")):
        found.append(f"{element.tag} time")
    if element.tag in ("testsuites", "testsuite"):
        cases = element.findall(".//testcase")
        counts = {
            "tests": len(cases),
            "failures": sum(c.find("error") is None and c.find("failure") is not None for c in cases),
            "errors": sum(c.find("error") is not None for c in cases),
        }
        found += [f"{element.tag} {k}" for k, n in counts.items() if element.get(k) != str(n)]
    for child in element:
        found += faults(child) if child.tag in inside else [f"{child.tag} in {element.tag}"]
    return found


def outcome(name: str, result: Outcome, *failures: Failure, output: tuple[str, ...] = ()) -> TestOutcome:
    return TestOutcome(name, result, 1, 0.25, failures, output)


WRONG = Failure("m\x1b", "1", "2", pou="FB", line=3)
RAISED = Failure("division by zero", code=1, pou="FB", line=4, call_stack=("FB, line 9",))
SUITES = (
    SuiteOutcome(
        "PRG_TEST.fbA",
        "FB_A",
        (
            outcome("good", "passed", output=("<line> 1", "& 2")),
            outcome("a\x00b<&>'\"", "failed", WRONG, WRONG),
            outcome("raised", "error", WRONG, RAISED),
            outcome("late", "error", Failure("not finished")),
            outcome("off", "skipped"),
        ),
    ),
    SuiteOutcome("PRG_TEST.fbB", "FB_B", (), (Failure("outside", code=1), Failure("two tests"))),
    SuiteOutcome("PRG_TEST.fbEmpty", "FB_C"),
)


def test_every_kind_of_result_fits_the_schema() -> None:
    root = ET.fromstring(to_xml(Report("App", SUITES)))
    assert faults(root) == []
    assert {key: root.get(key) for key in ("tests", "failures", "errors", "disabled", "time")} == {
        "tests": "6",
        "failures": "1",
        "errors": "3",
        "disabled": "1",
        "time": "1.250",
    }


def test_a_run_that_did_not_come_about_fits_the_schema() -> None:
    diagnostic = {"file": "A.st", "line": 2, "code": "E0201", "message": "x"}
    for report in (
        Report("App", problem="there are no tests"),
        Report("App", diagnostics=(diagnostic,)),
        Report("App", SUITES, problem="ended"),
    ):
        root = ET.fromstring(to_xml(report))
        assert faults(root) == []
        assert root.findall("testsuite")[-1].find("testcase/error") is not None


def test_texts_are_kept() -> None:
    root = ET.fromstring(to_xml(Report("App", SUITES)))
    cases = root.findall(".//testcase")
    assert cases[1].get("name") == "a\ufffdb<&>'\""
    assert cases[0].findtext("system-out") == "<line> 1\n& 2"
    failure = cases[1].find("failure")
    assert failure is not None
    assert failure.attrib == {"type": "assertion", "message": "m\ufffd"}
    assert failure.text == "m\ufffd: expected 1, but was 2 (FB, line 3)"
    assert cases[2].findtext("error") == "division by zero (FB, line 4)\n  called by FB, line 9"


def test_the_check_sees_faults() -> None:
    inner = "<testsuite name='a' tests='2'><testcase name='b'><x/></testcase></testsuite>"
    found = faults(ET.fromstring(f"<testsuites skipped='1'>{inner}</testsuites>"))
    wrong = {"testsuites with skipped", "testsuite tests", "testcase without classname", "x in testcase"}
    assert wrong <= set(found)
