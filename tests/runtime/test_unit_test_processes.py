"""Tests that kill their process: which one it was is reported, and the others run on in a new process."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import time
from pathlib import Path
from xml.etree import ElementTree as ET

import pytest
from unread_answers import ends_quietly

from tappet.cli.inputs import applications
from tappet.codegen.build import BuildOptions
from tappet.lang.source import Source
from tappet.runtime.unit_tests import attempts as processes
from tappet.runtime.unit_tests.attempts import NO_MEMORY, Attempts
from tappet.runtime.unit_tests.junit import to_xml
from tappet.runtime.unit_tests.known import NOTHING, Known
from tappet.runtime.unit_tests.order import TestLimits, order
from tappet.runtime.unit_tests.place import PlacePage
from tappet.runtime.unit_tests.process import run_in_process
from tappet.runtime.unit_tests.results import Failure, Report, SuiteOutcome, TestOutcome

FOLDER = Path(__file__).parent / "unit_tests"


def order_of(text: str, limits: TestLimits) -> bytes:
    options = BuildOptions()
    return order(
        options.application, [Source("tests.st", text, name="tests")], [], options.libraries, limits=limits
    )


@pytest.fixture(scope="module")
def deadly() -> Report:
    (application,) = applications([FOLDER / "deadly.st"])
    limits = TestLimits(cycle_s=5.0, memory_mib=128)
    libraries = application.options.libraries
    return run_in_process(
        order(application.name, application.sources, application.tasks, libraries, limits=limits)
    )


def test_tests_whose_server_was_killed_end_quietly() -> None:
    program = "PROGRAM P\nEND_PROGRAM"
    with Attempts(order_of(program, TestLimits())) as attempts:
        ends_quietly(attempts.command, attempts.order, attempts.pass_fds)


def test_each_deadly_test_has_its_error_and_the_others_run_on(deadly: Report) -> None:
    assert (deadly.problem, deadly.diagnostics, len(deadly.suites)) == (None, (), 3)
    first, outside, later = deadly.suites
    # in the order in which they are called
    assert [(test.name, test.outcome) for test in first.tests] == [
        ("Before", "passed"),
        ("Deletes what is not new", "error"),
        ("Takes all memory", "error"),
        ("Takes small pieces without end", "error"),
        ("After", "failed"),
    ]
    (after,) = first.tests[-1].failures
    assert (after.expected, after.actual) == ("1", "2")
    (failure,) = outside.failures
    assert (outside.tests, failure.pou) == ((), "FB_Outside_Test")
    assert failure.message.startswith("__DELETE of address 16#")
    assert [(test.name, test.outcome) for test in later.tests] == [("Fine", "passed")]


def test_a_wrong_release_is_told_with_its_line(deadly: Report) -> None:
    text = (FOLDER / "deadly.st").read_text().splitlines()
    (failure,) = deadly.suites[0].tests[1].failures
    assert failure.message.endswith(", which is not memory of __NEW")
    assert (failure.pou, text[failure.line - 1]) == ("FB_Deadly_Test", "__DELETE(pbRoom);")


def test_memory_that_is_used_up_is_told(deadly: Report) -> None:
    (failure,) = deadly.suites[0].tests[2].failures
    assert (failure.code, failure.message) == (
        3,
        "access through a null pointer or reference; the memory of __NEW is used up (64 MiB)",
    )
    (endless,) = deadly.suites[0].tests[3].failures
    assert endless.code == 6  # a watchdog that fires while memory is taken waits until it is


def test_junit_tells_it(deadly: Report) -> None:
    root = ET.fromstring(to_xml(deadly))
    case = root.find(".//testcase[@name='Deletes what is not new']/error")
    assert case is not None
    assert case.attrib["message"].startswith("__DELETE of address 16#")
    assert (root.get("tests"), root.get("failures"), root.get("errors")) == ("7", "1", "4")


def test_a_kill_from_outside_is_the_end_of_the_running_test() -> None:
    text = """
FUNCTION_BLOCK FB_Kill_Test EXTENDS FB_TestSuite
VAR n : UDINT; END_VAR
TEST('Runs long');
WHILE TRUE DO n := n + 1; END_WHILE
TEST_FINISHED();
TEST('After'); AssertTrue(TRUE, ''); TEST_FINISHED();
END_FUNCTION_BLOCK
"""
    with Attempts(order_of(text, TestLimits(cycle_s=300.0))) as attempts:
        child = subprocess.Popen(
            attempts.command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, pass_fds=attempts.pass_fds
        )
        assert child.stdin is not None
        child.stdin.write(attempts.order)
        child.stdin.close()
        while attempts.place.test != "Runs long":
            assert child.poll() is None
            time.sleep(0.01)
        os.kill(child.pid, signal.SIGKILL)
        assert child.stdout is not None
        with child.stdout as stream:
            output = stream.read()
        assert attempts.take(output, child.wait()) is None
        again = subprocess.run(
            attempts.command,
            input=attempts.order,
            stdout=subprocess.PIPE,
            pass_fds=attempts.pass_fds,
            check=False,
        )
        report = attempts.take(again.stdout, again.returncode)
    assert report is not None
    (suite,) = report.suites
    assert {test.name: test.outcome for test in suite.tests} == {"Runs long": "error", "After": "passed"}
    (failure,) = suite.tests[0].failures
    assert "SIGKILL" in failure.message
    assert (failure.pou, failure.line) == ("FB_Kill_Test", 4)


# -- what is made of the end of a process, without one -----------------------------------------------------

ORDER = order_of("", TestLimits())
SUITE = SuiteOutcome("PRG.fbSuite", "FB_Suite", (TestOutcome("known", "passed"),))


def output(known: Known = NOTHING, marks: bool = True) -> bytes:
    first = json.dumps({"marks": [["FB_Suite", "FB_Suite.Run", 7]]}) if marks else ""
    line = json.dumps({"report": Report("App", (SUITE,)).to_dict(), "known": known.to_dict()})
    return f'{first}\n{line}\n{{"half'.encode()


def died(attempts: Attempts, test: str, suite: int = 1, mark: int = 0) -> None:
    """As a process would leave its page."""
    page: PlacePage = attempts._page
    page.clear()
    os.pwrite(page.fd, test.encode(), 0)
    os.pwrite(page.fd, suite.to_bytes(4, "little") + mark.to_bytes(4, "little"), 256)


def test_a_process_that_dies_before_its_tests_is_told() -> None:
    with Attempts(ORDER) as attempts:
        died(attempts, "", suite=0)
        report = attempts.take(output(), -11)
    assert report is not None
    assert report.suites == (SUITE,)
    assert "SIGSEGV" in (report.problem or "")


def test_memory_that_ends_in_the_runner_is_the_running_tests_error() -> None:
    with Attempts(ORDER) as attempts:
        died(attempts, "huge", mark=1)
        assert attempts.take(output(), NO_MEMORY) is None
        report = attempts.ended(b"", "cancelled")
    assert report.suites[0].tests[-1] == TestOutcome(
        "huge", "error", failures=(Failure("out of memory", pou="FB_Suite.Run", uri="FB_Suite", line=7),)
    )


def test_a_test_whose_outcome_is_known_breaks_its_suite_and_then_the_run() -> None:
    with Attempts(ORDER) as attempts:
        died(attempts, "deadly")
        assert attempts.take(output(), -9) is None
        known = attempts._last.known
        died(attempts, "deadly")
        assert attempts.take(output(known), -9) is None
        known = attempts._last.known
        assert [(number, failure.pou) for number, failure in known.suites] == [(1, "FB_Suite")]
        died(attempts, "deadly")
        report = attempts.take(output(known), -9)
    assert report is not None
    assert "SIGKILL" in (report.problem or "")


def test_what_takes_too_long_is_told_with_what_ran() -> None:
    with Attempts(ORDER) as attempts:
        died(attempts, "slow")
        report = attempts.take(output(), None)
    assert report is not None
    assert report.problem == (
        "the tests took longer than 600 s and were ended; the last one that ran was PRG.fbSuite.slow"
    )


def test_it_is_given_up_after_many_processes(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(processes, "MOST_PROCESSES", 2)
    with Attempts(ORDER) as attempts:
        for test, over in (("a", False), ("b", True)):
            assert attempts.order
            died(attempts, test)
            report = attempts.take(output(attempts._last.known), -9)
            assert (report is not None) is over
    assert report is not None
    assert "given up after 2 processes" in (report.problem or "")
