"""JUnit XML of a report, as continuous integration reads it."""

from __future__ import annotations

import re
from xml.etree import ElementTree as ET

from tappet.runtime.unit_tests.results import Failure, Report, SuiteOutcome, TestOutcome

_FORBIDDEN = re.compile("[^\t\n\r -\ud7ff\ue000-\ufffd\U00010000-\U0010ffff]")
"""What XML 1.0 cannot hold."""


def to_xml(report: Report) -> bytes:
    """The report as a document; the same report gives the same bytes."""
    counts = _counts(report.application, report.suites)
    root = ET.Element("testsuites", counts | {"disabled": counts.pop("skipped")})
    for suite in report.suites:
        element = ET.SubElement(root, "testsuite", _counts(suite.name, (suite,)))
        for test in suite.tests:
            _case(element, suite, test)
        if suite.failures:
            case = ET.SubElement(element, "testcase", _names(suite, "(outside of a test)", 0.0))
            for failure in suite.failures:
                _failure(case, "error", failure)
    if report.problem or report.diagnostics:
        _problem(root, report)
    ET.indent(root)
    body: bytes = ET.tostring(root, encoding="utf-8", xml_declaration=True)
    return body + b"\n"


def _counts(name: str, suites: tuple[SuiteOutcome, ...]) -> dict[str, str]:
    tests = [test for suite in suites for test in suite.tests]
    broken = sum(bool(suite.failures) for suite in suites)
    return {
        "name": _clean(name),
        "tests": str(len(tests) + broken),
        "failures": str(sum(test.outcome == "failed" for test in tests)),
        "errors": str(sum(test.outcome == "error" for test in tests) + broken),
        "skipped": str(sum(test.outcome == "skipped" for test in tests)),
        "time": f"{sum(test.seconds for test in tests):.3f}",
    }


def _names(suite: SuiteOutcome, name: str, seconds: float) -> dict[str, str]:
    return {"classname": _clean(suite.name), "name": _clean(name), "time": f"{seconds:.3f}"}


def _case(parent: ET.Element, suite: SuiteOutcome, test: TestOutcome) -> None:
    names = _names(suite, test.name, test.seconds) | {"assertions": str(test.assertions)}
    case = ET.SubElement(parent, "testcase", names)
    if test.outcome == "skipped":
        ET.SubElement(case, "skipped")
    for failure in test.failures:
        _failure(case, "failure" if failure.is_assertion or test.outcome == "failed" else "error", failure)
    if test.output:
        ET.SubElement(case, "system-out").text = _clean("\n".join(test.output))


def _failure(parent: ET.Element, tag: str, failure: Failure) -> None:
    kind = "assertion" if failure.is_assertion else f"exception {failure.code}" if failure.code else "error"
    element = ET.SubElement(parent, tag, {"type": kind, "message": _clean(failure.message)})
    element.text = _clean(describe(failure))


def _problem(root: ET.Element, report: Report) -> None:
    names = {"name": "build", "tests": "1", "failures": "0", "errors": "1", "skipped": "0", "time": "0.000"}
    suite = ET.SubElement(root, "testsuite", names)
    case = ET.SubElement(suite, "testcase", {"classname": "build", "name": "build", "time": "0.000"})
    lines = [f"{d['file']}:{d['line']}: {d['code']}: {d['message']}" for d in report.diagnostics]
    error = ET.SubElement(case, "error", {"message": _clean(report.problem or lines[0])})
    error.text = _clean("\n".join([report.problem or "", *lines]).strip())
    for key in ("tests", "errors"):
        root.set(key, str(int(root.get(key, "0")) + 1))


def describe(failure: Failure) -> str:
    """A failure in words: message, values, place."""
    text = failure.message
    if failure.expected is not None:
        text = f"{text}: " if text else ""
        text += f"expected {failure.expected}, but was {failure.actual}"
    if failure.uri or failure.pou:
        place = failure.pou or failure.uri
        text += f" ({place}, line {failure.line})" if failure.line else f" ({place})"
    return "\n".join([text, *(f"  called by {caller}" for caller in failure.call_stack)])


def _clean(text: str) -> str:
    return _FORBIDDEN.sub("\N{REPLACEMENT CHARACTER}", text)
