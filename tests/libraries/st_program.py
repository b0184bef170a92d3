"""A program with all libraries, run for some cycles of virtual time."""

from collections.abc import Iterator
from contextlib import contextmanager
from functools import cache

from linked_application import LoadedApplication, loaded

from tappet.codegen.build import BuildOptions, BuildSession, LibraryReference, build_application
from tappet.codegen.package import CodePackage
from tappet.lang.source import Source
from tappet.libraries import names

CYCLE_MS = 10
SESSION = BuildSession()


class Program:
    """The values after the last cycle."""

    def __init__(self, application: LoadedApplication) -> None:
        self._application = application

    def literal(self, expression: str) -> str:
        return self._application.literal(expression)

    def cycle(self) -> None:
        """One cycle more."""
        self._application.cycle()

    def set(self, variable: str, **members: float | bool | str) -> None:
        """Writes members of a variable."""
        for name, value in members.items():
            self._application.write(f"{variable}.{name}", value)

    def numbers(self, expression: str) -> list[float]:
        return [float(number) for number in self.literal(expression).strip("[]").split(",")]


@cache
def _package(text: str) -> CodePackage:
    libraries = tuple(LibraryReference(name) for name in names())
    options = BuildOptions(libraries=libraries, level=1)
    result = build_application([Source("program", text)], options=options, session=SESSION)
    assert [str(d) for d in result.diagnostics if d.severity == "error"] == []
    assert result.package is not None
    return result.package


@contextmanager
def run(text: str, cycles: int, cycle_ms: float = CYCLE_MS) -> Iterator[Program]:
    """`text` after so many calls of its programs."""
    with loaded(_package(text)) as application:
        for _ in range(cycles):
            application.cycle()
            application.clock_ns += round(cycle_ms * 1_000_000)
        yield Program(application)
