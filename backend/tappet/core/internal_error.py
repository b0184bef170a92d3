"""A failure of the compiler itself, with the place of the program that it was working on.

Whoever builds for a user turns it into a message (`internal_error` of the table of diagnostics): an exception
without a place is of no use to the engineer.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass

from tappet.core import ir
from tappet.core.program import LoweringError


@dataclass(frozen=True, slots=True)
class At:
    """What the compiler was working on."""

    name: str
    """Qualified name of the POU or list."""
    uri: str = ""
    line: int = 0
    """Counted from 1; 0 when only the object is known."""


class InternalError(Exception):
    """A stage failed at a place; the exception that began it is the cause."""

    def __init__(self, stage: str, at: At, reason: str) -> None:
        super().__init__(f"{stage} of {at.name} ({at.uri}:{at.line}): {reason}")
        self.stage = stage
        self.at = at
        self.reason = reason


@contextmanager
def working_on(stage: str, at: Callable[[], At]) -> Iterator[None]:
    """Names the place of what fails inside; `at` is asked only then."""
    try:
        yield
    except (LoweringError, InternalError):
        raise
    except Exception as error:
        raise InternalError(stage, at(), reason_of(error)) from error


def reason_of(error: BaseException) -> str:
    """An exception in one line."""
    lines = str(error).splitlines()
    return f"{type(error).__name__}: {lines[0]}" if lines else type(error).__name__


def function_at(function: ir.Function, line: int = 0) -> At:
    """A function, or a line of it."""
    return At(function.name, function.uri, line or function.line)
