"""A guarded part of a body (`__TRY`) while it is being lowered."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field

from tappet.core import ir


@dataclass(slots=True)
class Guard:
    """A guarded part that is being lowered."""

    buffer: ir.Local
    before: ir.Local
    """The guard that was in force."""
    labels: frozenset[str] = frozenset()
    """Labels inside: a jump to them does not leave it."""
    final: str = ""
    """Label of the code that follows in any case; empty without."""
    pending: ir.Local | None = None
    """How that code goes on: 0 behind itself, else a number of `exits`."""
    exits: list[Callable[[], None]] = field(default_factory=list)
