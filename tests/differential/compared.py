"""Runs one program on the compiler and on the reference and reports where they differ."""

from __future__ import annotations

from typing import Any

import reference
import write_st
from arithmetic import Fault, same
from linked_application import ApplicationFault, LoadedApplication
from typed_tree import Program, base_of

from tappet.codegen.build import BuildOptions, BuildSession, LibraryReference, build_application
from tappet.lang.source import Source

SESSION = BuildSession()
LIBRARIES = (LibraryReference("Standard"), LibraryReference("Standard64"))


class RefusedError(AssertionError):
    """The compiler gave errors for a program that is right."""


def compiled(program: Program, level: int) -> tuple[dict[str, Any], str | None]:
    """Values by path after the cycles, and the fault that ended the program."""
    text = write_st.program(program)
    options = BuildOptions(level=level, libraries=LIBRARIES)
    result = build_application([Source("a.st", text)], (), options, session=SESSION)
    errors = [f"{d.span.line + 1}: {d.code} {d.message}" for d in result.diagnostics if d.severity == "error"]
    if result.package is None:
        raise RefusedError("\n".join([*errors, text]))
    application = LoadedApplication(result.package)
    fault = None
    try:
        application.start()
        try:
            for _ in range(program.cycles):
                application.cycle()
        except ApplicationFault as raised:
            fault = str(raised)
        return {path: _value(application, path, t) for path, t, _ in _paths(program)}, fault
    finally:
        application.close()


def _paths(program: Program) -> list[tuple[str, Any, list[Any]]]:
    return write_st.paths(program.variables, "PLC_PRG.") + write_st.paths(program.globals, "")


def _value(application: LoadedApplication, path: str, type_: Any) -> Any:
    value = application.read(path)
    if base_of(type_) is not None and isinstance(value, str) and not hasattr(base_of(type_), "length"):
        return dict(type_.members)[value]  # an enumeration by name
    return value


def expected(program: Program) -> tuple[dict[str, Any], bool]:
    """Values after the cycles, and whether the program ended in a fault. Raises reference.TooLong."""
    machine = reference.Machine(program)
    fault = False
    try:
        for _ in range(program.cycles):
            machine.cycle()
    except Fault:
        fault = True
    return {path: _expected(machine, path, keys) for path, _, keys in _paths(program)}, fault


def _expected(machine: reference.Machine, path: str, keys: list[Any]) -> Any:
    value: Any = machine.variables if path.startswith("PLC_PRG.") else machine.globals
    for key in keys:
        value = value[key]
    return value


def both(machine: reference.Machine, application: LoadedApplication) -> dict[str, tuple[Any, Any]]:
    """Expected and actual value of each variable."""
    return {
        path: (_expected(machine, path, keys), _value(application, path, t))
        for path, t, keys in _paths(machine.program)
    }


def differences(program: Program, level: int) -> list[str]:
    """What differs, empty when both agree."""
    values, fault = expected(program)
    actual, ended = compiled(program, level)
    found = [f"fault expected {fault}, got {ended}"] if fault != (ended is not None) else []
    return found + [
        f"{p}: expected {v!r}, got {actual[p]!r}" for p, v in values.items() if not same(v, actual[p])
    ]
