"""Settings of the interpreter for work on large syntax trees: recursion limit and garbage collection."""

from __future__ import annotations

import gc
import sys
from collections.abc import Iterator
from contextlib import contextmanager

_RECURSION = 10_000
"""Frames a pass over the deepest tree the parser accepts may need."""


@contextmanager
def deep_recursion() -> Iterator[None]:
    """Raise the recursion limit and suspend garbage collection: growing trees have none, it costs a third."""
    sys.setrecursionlimit(max(sys.getrecursionlimit(), _RECURSION))
    enabled = gc.isenabled()
    gc.disable()
    try:
        yield
    finally:
        if enabled:
            gc.enable()
