"""Compile only: every message about an application, without object code."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace

from tappet.codegen.build import BuildOptions, build_application
from tappet.iec.task import Task
from tappet.lang.diagnostics import Diagnostic
from tappet.lang.source import Source


def check_application(
    sources: Iterable[Source],
    tasks: Iterable[Task] = (),
    options: BuildOptions | None = None,
) -> list[Diagnostic]:
    """All messages, in order of texts and places; errors, warnings and notes."""
    settings = replace(options or BuildOptions(), check_only=True, cache=None)
    texts = list(sources)
    result = build_application(texts, tasks, settings)
    order = {text.uri: number for number, text in enumerate(texts)}
    last = len(order)
    return sorted(result.diagnostics, key=lambda d: (order.get(d.uri, last), d.uri, d.span))


def format_diagnostic(diagnostic: Diagnostic) -> str:
    """`file:line:column: severity code: message. Advice`, lines and columns counted from 1."""
    return str(diagnostic)
