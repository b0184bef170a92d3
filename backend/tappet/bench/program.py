"""A program in the soft PLC, stopped, so that a native loop can call its cycle."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import contextmanager

from tappet.codegen.build import BuildOptions, BuildSession, LibraryReference, build_application
from tappet.codegen.package import CodePackage
from tappet.iec.task import Task
from tappet.lang.source import Source
from tappet.runtime.flight import FlightSettings
from tappet.runtime.local import LocalRuntime


@contextmanager
def running(text: str, libraries: Sequence[str] = ("SM3_Basic",)) -> Iterator[tuple[LocalRuntime, int]]:
    """The program `Main` in the soft PLC, stopped, with the address of its cycle; else ValueError."""
    runtime = LocalRuntime(built(text, libraries), flight=FlightSettings(memory=0), start=False)
    try:
        application = runtime.plc.application
        assert application is not None
        yield runtime, application.code[runtime.package.tasks[0].symbol]
    finally:
        runtime.close()


def built(text: str, libraries: Sequence[str] = ("SM3_Basic",)) -> CodePackage:
    """The application of a program; raises ValueError with its first error."""
    options = BuildOptions(libraries=tuple(LibraryReference(name) for name in libraries))
    source = Source(uri="Main.st", text=text, name="Main")
    result = build_application(
        [source], [Task("Task", programs=("Main",))], options=options, session=BuildSession()
    )
    if result.package is None:
        raise ValueError(str(next(d for d in result.diagnostics if d.severity == "error")))
    return result.package
