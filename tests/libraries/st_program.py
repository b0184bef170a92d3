"""A program with all libraries, run for some cycles of virtual time."""

import re
from collections.abc import Iterator
from contextlib import contextmanager
from functools import cache

from linked_application import LoadedApplication, loaded

from tappet.codegen.build import BuildOptions, BuildSession, LibraryReference, build_application
from tappet.codegen.package import CodePackage
from tappet.lang.source import Source
from tappet.libraries import names
from tappet.libraries.repository import ROOT

CYCLE_MS = 10
SESSION = BuildSession()
WITHOUT_RESULT = re.compile(r"^(?=FUNCTION INTERNAL \w+$)", re.MULTILINE)
"""Functions of a library may be without a result, those of an application only where they are marked."""
MARK = "{attribute 'no_return_type'} "


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
def package(text: str, inside: str = "") -> CodePackage:
    """A program with all libraries; `inside` a library it also has what is INTERNAL there."""
    libraries = tuple(LibraryReference(name) for name in names() if name != inside)
    options = BuildOptions(libraries=libraries, level=1)
    own = sorted((ROOT / inside).glob("*.st")) if inside else []
    sources = [Source(path.stem, WITHOUT_RESULT.sub(MARK, path.read_text("utf-8"))) for path in own]
    result = build_application([*sources, Source("program", text)], options=options, session=SESSION)
    assert not (errors := [str(d) for d in result.diagnostics if d.severity == "error"]), errors
    assert result.package is not None
    return result.package


@contextmanager
def run(text: str, cycles: int, cycle_ms: float = CYCLE_MS, inside: str = "") -> Iterator[Program]:
    """`text` after so many calls of its programs; `inside` a library it also has what is INTERNAL there."""
    with loaded(package(text, inside)) as application:
        for _ in range(cycles):
            application.cycle()
            application.clock_ns += round(cycle_ms * 1_000_000)
        yield Program(application)
