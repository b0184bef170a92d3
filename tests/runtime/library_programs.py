"""Builds of programs that use libraries of the system."""

from __future__ import annotations

from dataclasses import replace

from tappet.codegen.build import BuildOptions, BuildSession, LibraryReference, build_application
from tappet.codegen.package import CodePackage
from tappet.iec.task import Task
from tappet.lang.source import Source

MS = 1_000_000
SESSION = BuildSession()
TASK = Task("Main", interval_ns=10 * MS, programs=("PLC_PRG",))
PLAIN = BuildOptions(level=1)
TC2_SYSTEM = "Tc2_System, * (Beckhoff Automation GmbH)"


def compiled(
    text: str,
    *libraries: str,
    previous: CodePackage | None = None,
    tasks: tuple[Task, ...] = (TASK,),
    options: BuildOptions = PLAIN,
) -> CodePackage:
    references = tuple(LibraryReference(name) for name in ("Standard", *libraries))
    result = build_application(
        [Source("PLC_PRG", text)],
        tasks,
        replace(options, libraries=references, level=1),
        previous=previous,
        session=SESSION,
    )
    assert [str(d) for d in result.diagnostics if d.severity == "error"] == []
    assert result.package is not None
    return result.package
