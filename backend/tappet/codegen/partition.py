"""Splits large applications into modules that are compiled, and cached, one by one."""

from __future__ import annotations

from tappet.core import ir

WHOLE = 400
"""Up to this many functions an application is one module, so that everything can be inlined."""
PART = 60
"""Functions per module of a larger application."""


def partition(module: ir.Module) -> list[list[str]]:
    """Names of the functions of each module, in stable order."""
    names = list(module.functions)
    if len(names) <= WHOLE:
        return [names]
    ordered = sorted(names)
    return [ordered[i : i + PART] for i in range(0, len(ordered), PART)]
