"""Rules of the language documents, each shown by programs of its own: all its parts, also what it forbids.

A file of `rules/` holds many cases. Each begins with the rules it shows and what it shows of them, then says
what must come out, as in the conformance tests (CYCLES, EXPECT, FAULT, ERROR, WARNING), and more:

// CASE LDEC-07: two underscores in a row are refused
// MESSAGE: two consecutive          some message says this
// ABSENT: W1001                     no message has this code
// SET 3: Globals.go = TRUE          written before the third cycle, as a write from outside
// RESET 3: warm                     before the third cycle: warm, cold, origin, download or reboot
// OVER: PLC_PRG.x = 0 1 1           the values at the end of each cycle; FALSE is 0, TRUE is 1
// SOURCE: Globals                   what follows is a text of this name
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from pathlib import Path

import pytest
from linked_application import ApplicationFault, LoadedApplication
from tests.conformance.test_conformance import Expectation, read, run
from tests.spec.language_cases import Outcome, guarded, start_again

from tappet.codegen.build import BuildOptions, BuildSession, LibraryReference, build_application
from tappet.codegen.package import CodePackage
from tappet.lang.source import Source

FOLDER = Path(__file__).parent / "rules"
CYCLE_NS = 10_000_000
_CASE = re.compile(r"^// CASE (?P<ids>[A-Z]+-\d+(?:,? [A-Z]+-\d+)*): (?P<title>.+)$", re.MULTILINE)
_SOURCE = re.compile(r"^// SOURCE: (\w+)$", re.MULTILINE)
_MESSAGE = re.compile(r"^// MESSAGE: (.+)$", re.MULTILINE)
_ABSENT = re.compile(r"^// ABSENT: (\w+)$", re.MULTILINE)
_SET = re.compile(r"^// SET (\d+): (\S+) = (.+)$", re.MULTILINE)
_RESET = re.compile(r"^// RESET (\d+): (warm|cold|origin|download|reboot)$", re.MULTILINE)
_OVER = re.compile(r"^// OVER: (\S+) = (.+)$", re.MULTILINE)
_VALUES = re.compile(r"'[^']*'|\S+")
_BIT = {"FALSE": "0", "TRUE": "1"}
LIBRARIES = (LibraryReference("Standard"),)
SESSION = BuildSession()


@dataclass
class Case:
    """One program, or several texts of one, and what must come of it."""

    name: str
    text: str
    expectation: Expectation

    def sources(self) -> list[Source]:
        """The texts; the first one is that of the program."""
        first, *more = _SOURCE.split(self.text)
        found = [Source("PLC_PRG", first)]
        for name, text in zip(more[::2], more[1::2], strict=True):
            found.append(Source(name, text, name=name))
        return found


def load(path: Path) -> list[Case]:
    text = path.read_text(encoding="utf-8")
    heads = list(_CASE.finditer(text))
    ends = [head.start() for head in heads[1:]] + [len(text)]
    cases = []
    for head, end in zip(heads, ends, strict=True):
        body = text[head.end() : end]
        cases.append(Case(f"{path.stem}: {head['ids']}: {head['title']}", body, read(body)))
    return cases


@dataclass
class Course:
    """What happens before single cycles, and the values that must stand at the end of each."""

    writes: dict[int, list[tuple[str, str]]]
    resets: dict[int, str]
    rows: dict[str, list[str]]

    @classmethod
    def read(cls, text: str) -> Course:
        writes: dict[int, list[tuple[str, str]]] = {}
        for cycle, path, literal in _SET.findall(text):
            writes.setdefault(int(cycle), []).append((path, literal))
        resets = {int(cycle): command for cycle, command in _RESET.findall(text)}
        return cls(writes, resets, {path: _VALUES.findall(values) for path, values in _OVER.findall(text)})

    def run(self, application: LoadedApplication) -> dict[str, list[str]]:
        """Cycles as many as the rows have values; what came out, row by row."""
        found: dict[str, list[str]] = {path: [] for path in self.rows}
        application.start()
        for cycle in range(1, max(map(len, self.rows.values())) + 1):
            if cycle in self.resets:
                start_again(application, self.resets[cycle])
            for path, literal in self.writes.get(cycle, []):
                application.write(path, literal)
            application.cycle()
            application.clock_ns += CYCLE_NS
            for path, values in found.items():
                value = application.literal(path)
                values.append(_BIT.get(value, value))
        return found


CASES = [case for path in sorted(FOLDER.glob("*.st")) for case in load(path)]


@pytest.mark.parametrize("case", CASES, ids=[case.name for case in CASES])
def test_case(case: Case) -> None:
    expected = case.expectation
    wanted, absent = _MESSAGE.findall(case.text), _ABSENT.findall(case.text)
    course = Course.read(case.text)
    assert (
        expected.values or course.rows or expected.fault or expected.errors or expected.warnings or wanted
    ), "expects nothing"
    assert not (course.rows and expected.values), "rows of values, or values at the end"
    assert course.rows or not (course.writes or course.resets), "SET and RESET need rows of values (OVER)"
    options = BuildOptions(level=1, libraries=LIBRARIES)
    result = build_application(case.sources(), session=SESSION, options=options)
    texts = [str(d) for d in result.diagnostics]
    codes = [d.code for d in result.diagnostics]
    errors = [d.code for d in result.diagnostics if d.severity == "error"]
    assert errors == expected.errors, texts
    assert set(expected.warnings) <= set(codes), texts
    assert not set(absent) & set(codes), texts
    for text in wanted:
        assert any(text in found for found in texts), texts
    if errors or not (expected.values or expected.fault or course.rows):
        return
    package = result.package
    assert package is not None
    if expected.fault:
        fault = guarded(lambda: _fault(package)).fault
        # The processor finds that nothing lies there: the runtime reports the signal, here it ends a child.
        assert fault is not None
        assert expected.fault in fault.lower() or (expected.fault == "null" and "signal 11" in fault), fault
        return
    if not course.rows:
        run(package, expected)
        return
    application = LoadedApplication(package)
    try:
        assert course.run(application) == course.rows
    finally:
        application.close()


def _fault(package: CodePackage) -> Outcome:
    """How the application ends."""
    application = LoadedApplication(package)
    try:
        application.start()
        application.cycle()
    except ApplicationFault as fault:
        return Outcome([], [], str(fault), {})
    return Outcome([], [], None, {})


def test_names_of_cases_are_unique() -> None:
    names = [case.name for case in CASES]
    assert sorted(set(names)) == sorted(names)
