"""Compile only: the findings of an application, and how one is written as a line."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace

from tappet.codegen.build import BuildOptions, SourceLike, TaskLike, build_application
from tappet.lang.diagnostics import Diagnostic
from tappet.lang.source import Source


def check_application(
    sources: Iterable[Source | SourceLike],
    tasks: Iterable[TaskLike] = (),
    options: BuildOptions | None = None,
) -> list[Diagnostic]:
    """Everything the compiler has to say, by text and place; no code is generated."""
    settings = replace(options or BuildOptions(), check_only=True)
    found = build_application(sources, tasks, settings).diagnostics
    return sorted(found, key=lambda d: (d.uri, d.span.line, d.span.column, d.code))


def format_diagnostic(diagnostic: Diagnostic) -> str:
    """`file:line:column: severity code: message`, line and column from 1; advice follows the message."""
    span = diagnostic.span
    advice = f" {diagnostic.advice}" if diagnostic.advice else ""
    place = f"{diagnostic.uri}:{span.line + 1}:{span.column + 1}"
    return f"{place}: {diagnostic.severity} {diagnostic.code}: {diagnostic.message}{advice}"
