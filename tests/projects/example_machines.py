"""Example projects of machines, built once and run on virtual time."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from functools import cache
from pathlib import Path

from tappet.cli.inputs import one_application
from tappet.codegen.build import build_application
from tappet.codegen.package import CodePackage
from tappet.runtime.local import LocalRuntime

PROJECTS = Path(__file__).parents[2] / "projects"
SECOND = 1_000_000_000


@cache
def package(name: str) -> CodePackage:
    """The application of an example, which builds without a message."""
    application = one_application([PROJECTS / name])
    result = build_application(application.sources, application.tasks, application.options)
    assert result.package is not None, [d.message for d in result.diagnostics]
    assert not [d for d in result.diagnostics if d.severity != "info"]
    return result.package


@contextmanager
def machine(name: str, seconds: float = 0.0) -> Iterator[LocalRuntime]:
    """The machine so long after its start."""
    with LocalRuntime(package(name)) as runtime:
        run(runtime, seconds)
        yield runtime


def run(runtime: LocalRuntime, seconds: float) -> None:
    if seconds > 0.0:
        runtime.run(time_ns=round(seconds * SECOND))


def number(runtime: LocalRuntime, path: str) -> float:
    """A number of the application."""
    return float(str(runtime.read(path)))
