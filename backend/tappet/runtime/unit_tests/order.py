"""What a test process is asked for: plain data, made by who waits for its reports."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import asdict, dataclass

import msgpack
import msgspec

from tappet.iec.heap import DEFAULT_HEAP, HeapSettings
from tappet.iec.source import Source
from tappet.iec.task import Task
from tappet.project.library_reference import LibraryReference


@dataclass(frozen=True, slots=True)
class TestLimits:
    """When a test counts as endless."""

    cycle_s: float = 2.0
    """Wall time of one cycle."""
    simulated_s: float = 600.0
    """Time of the PLC for all tests."""
    restarts: int = 1000
    memory_mib: int = 1024
    """What all tests together may take with __NEW; only where they have a process of their own."""

    __test__ = False  # no test class of pytest


def order(
    application: str,
    sources: Sequence[Source],
    tasks: Sequence[Task],
    libraries: Sequence[LibraryReference],
    *,
    defines: Sequence[tuple[str, str]] = (),
    test_filter: str = "",
    only: Sequence[str] = (),
    limits: TestLimits | None = None,
    heap: HeapSettings = DEFAULT_HEAP,
) -> bytes:
    """What the process reads."""
    content = {
        "application": application,
        "libraries": [asdict(reference) for reference in libraries],
        "defines": list(defines),
        "sources": [msgspec.to_builtins(source) for source in sources],
        "tasks": [{"name": t.name, "interval_ns": t.interval_ns, "programs": t.programs} for t in tasks],
        "filter": test_filter,
        "only": list(only),
        "limits": asdict(limits or TestLimits()),
        "heap": asdict(heap),
    }
    packed: bytes = msgpack.packb(content, use_bin_type=True)
    return packed
