"""Rules of the language documents, each shown by programs of its own: all its parts, also what it forbids.

A file of `rules/` holds many cases. Each begins with the rules it shows and what it shows of them, then says
what must come out, as in the conformance tests (CYCLES, EXPECT, FAULT, ERROR, WARNING), and more:

// CASE LDEC-07: two underscores in a row are refused
// MESSAGE: two consecutive          some message says this
// ABSENT: W1001                     no message has this code
// SOURCE: Globals                   what follows is a text of this name
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from pathlib import Path

import pytest
from tests.conformance.test_conformance import Expectation, read, run
from tests.spec.language_cases import Outcome, guarded

from tappet.codegen.build import BuildOptions, BuildSession, LibraryReference, build_application
from tappet.codegen.jit import ApplicationFault, LoadedApplication
from tappet.codegen.package import CodePackage
from tappet.lang.source import Source

FOLDER = Path(__file__).parent / "rules"
_CASE = re.compile(r"^// CASE (?P<ids>[A-Z]+-\d+(?:,? [A-Z]+-\d+)*): (?P<title>.+)$", re.MULTILINE)
_SOURCE = re.compile(r"^// SOURCE: (\w+)$", re.MULTILINE)
_MESSAGE = re.compile(r"^// MESSAGE: (.+)$", re.MULTILINE)
_ABSENT = re.compile(r"^// ABSENT: (\w+)$", re.MULTILINE)
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


CASES = [case for path in sorted(FOLDER.glob("*.st")) for case in load(path)]


@pytest.mark.parametrize("case", CASES, ids=[case.name for case in CASES])
def test_case(case: Case) -> None:
    expected = case.expectation
    wanted, absent = _MESSAGE.findall(case.text), _ABSENT.findall(case.text)
    assert expected.values or expected.fault or expected.errors or expected.warnings or wanted, (
        "expects nothing"
    )
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
    if errors or not (expected.values or expected.fault):
        return
    package = result.package
    assert package is not None
    if expected.fault:
        fault = guarded(lambda: _fault(package)).fault
        # The processor finds that nothing lies there: the runtime tells of the signal, here it ends a child.
        assert fault is not None
        assert expected.fault in fault.lower() or (expected.fault == "null" and "signal 11" in fault), fault
        return
    application = LoadedApplication(package)
    try:
        run(application, expected)
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
