"""Room for large syntax trees: deep recursion, and no search for garbage while they grow."""

from __future__ import annotations

import gc
import sys
from collections.abc import Iterator
from contextlib import contextmanager

_RECURSION = 10_000
"""Frames a pass over the deepest tree the parser accepts may need."""


@contextmanager
def room_for_trees() -> Iterator[None]:
    """Deep recursion; no garbage collection: growing trees have none, and it takes a third of the time."""
    sys.setrecursionlimit(max(sys.getrecursionlimit(), _RECURSION))
    enabled = gc.isenabled()
    gc.disable()
    try:
        yield
    finally:
        if enabled:
            gc.enable()
