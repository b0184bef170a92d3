"""Runs every `.st` file below this folder: a program, and in comments what must come out.

// CYCLES: 3                    cycles of the task (default 1), 10 ms of virtual time apart
// EXPECT: Main.x = 7           value after the last cycle, as IEC literal
// FAULT: array index 11        the application ends in this exception
// ERROR: E0301                 the program is refused with this code
// WARNING: W1001               it is accepted with this message
"""

from __future__ import annotations

import contextlib
import re
from dataclasses import dataclass, field
from pathlib import Path

import pytest

from tappet.codegen import debug_build
from tappet.codegen.build import BuildSession, build_application
from tappet.codegen.debug_build import instrument
from tappet.codegen.debug_code import DebugCode
from tappet.codegen.package import CodePackage
from tappet.lang.source import Source
from tappet.runtime.flight import FlightSettings
from tappet.runtime.local import ApplicationException, LocalRuntime

FOLDER = Path(__file__).parent
FILES = sorted(FOLDER.rglob("*.st"))
_DIRECTIVE = re.compile(r"^\s*//\s*(CYCLES|EXPECT|FAULT|ERROR|WARNING):\s*(.+?)\s*$", re.MULTILINE)
SESSION = BuildSession()


@dataclass
class Expectation:
    cycles: int = 1
    values: list[tuple[str, str]] = field(default_factory=list)
    fault: str | None = None
    errors: list[str] = field(default_factory=list)
    warnings: list[str] = field(default_factory=list)


def read(text: str) -> Expectation:
    found = Expectation()
    for kind, value in _DIRECTIVE.findall(text):
        if kind == "CYCLES":
            found.cycles = int(value)
        elif kind == "EXPECT":
            path, _, literal = value.partition("=")
            found.values.append((path.strip(), literal.strip()))
        elif kind == "FAULT":
            found.fault = value
        elif kind == "ERROR":
            found.errors.append(value)
        else:
            found.warnings.append(value)
    return found


@pytest.mark.parametrize("path", FILES, ids=[str(f.relative_to(FOLDER).with_suffix("")) for f in FILES])
def test_file(path: Path) -> None:
    text = path.read_text(encoding="utf-8")
    expectation = read(text)
    assert expectation.values or expectation.fault or expectation.errors, "the file expects nothing"
    result = build_application([Source(path.name, text)], session=SESSION)
    errors = [str(d) for d in result.diagnostics if d.severity == "error"]
    if expectation.errors:
        codes = [d.code for d in result.diagnostics if d.severity == "error"]
        assert codes == expectation.errors, errors
        return
    assert errors == []
    codes = [d.code for d in result.diagnostics]
    assert set(expectation.warnings) <= set(codes)
    assert result.package is not None
    run(result.package, expectation)


def check_instrumented(path: Path) -> None:
    """The variant for the debugger comes to the same values and faults."""
    text = path.read_text(encoding="utf-8")
    expectation = read(text)
    session = BuildSession()
    result = build_application([Source(path.name, text)], session=session)
    if result.package is not None:
        assert session.generated is not None
        run(result.package, expectation, instrument(session.generated))


_NAMED = [pytest.param(f, id=str(f.relative_to(FOLDER).with_suffix(""))) for f in FILES]


@pytest.mark.parametrize("path", _NAMED[::12])
@pytest.mark.parametrize("large", [0, 1 << 30], ids=["O0", "O1"])
def test_instrumented(path: Path, large: int, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(debug_build, "LARGE", large)
    check_instrumented(path)


@pytest.mark.slow
@pytest.mark.parametrize("path", _NAMED)
@pytest.mark.parametrize("large", [0, 1 << 30], ids=["O0", "O1"])
def test_every_file_instrumented(path: Path, large: int, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(debug_build, "LARGE", large)
    check_instrumented(path)


def run(package: CodePackage, expectation: Expectation, variant: DebugCode | None = None) -> None:
    """In the soft PLC itself, on virtual time."""
    with LocalRuntime(package, flight=FlightSettings(memory=0)) as runtime:
        if variant is not None:
            runtime.plc.debugger.load(variant.to_bytes())
            runtime.plc.debugger.keep_active(True)
        with contextlib.suppress(ApplicationException):
            runtime.run(expectation.cycles)
        fault = runtime.exception
        assert runtime.plc.debugger.state().active is (variant is not None)
        if expectation.fault is None:
            assert fault is None
        else:
            assert fault is not None
            assert expectation.fault in fault.message
        actual = [(path, runtime.literal(path)) for path, _ in expectation.values]
        assert actual == expectation.values
