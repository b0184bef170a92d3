"""Builds of programs that use libraries of the system."""

from __future__ import annotations

from tappet.codegen.build import BuildOptions, BuildSession, LibraryReference, build_application
from tappet.codegen.package import CodePackage
from tappet.iec.task import Task
from tappet.lang.source import Source

MS = 1_000_000
SESSION = BuildSession()
TASK = Task("Main", interval_ns=10 * MS, programs=("PLC_PRG",))
TC2_SYSTEM = "Tc2_System, * (Beckhoff Automation GmbH)"


def compiled(
    text: str, *libraries: str, previous: CodePackage | None = None, tasks: tuple[Task, ...] = (TASK,)
) -> CodePackage:
    references = tuple(LibraryReference(name) for name in ("Standard", *libraries))
    result = build_application(
        [Source("PLC_PRG", text)],
        tasks,
        BuildOptions(libraries=references, level=1),
        previous=previous,
        session=SESSION,
    )
    assert [str(d) for d in result.diagnostics if d.severity == "error"] == []
    assert result.package is not None
    return result.package
