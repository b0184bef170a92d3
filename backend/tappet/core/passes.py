"""The passes over a core module, in order."""

from __future__ import annotations

from tappet.core import ir


def run(module: ir.Module) -> None:
    """Improve a module in place."""
