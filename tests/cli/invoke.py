"""Runs a command in this process and keeps what it says."""

from __future__ import annotations

import io
from contextlib import redirect_stderr, redirect_stdout
from typing import NamedTuple

from tappet.cli import main


class Outcome(NamedTuple):
    """What a command left: its exit code, and what it wrote."""

    code: int
    output: str
    errors: str


def invoke(*arguments: object) -> Outcome:
    """The outcome of `tappet ARGUMENTS`."""
    output, errors = io.StringIO(), io.StringIO()
    with redirect_stdout(output), redirect_stderr(errors):
        code = main([str(argument) for argument in arguments])
    return Outcome(code, output.getvalue(), errors.getvalue())
