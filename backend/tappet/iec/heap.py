"""Memory of `__NEW`: the settings of an application's heap, from the project to the code package."""

from __future__ import annotations

from dataclasses import dataclass

KIB = 1024
LARGEST_HEAP_KIB = 1 << 20
"""1 GiB: half of what lies below 2 GiB, where pointers fit into DWORD."""


@dataclass(frozen=True, slots=True)
class HeapSettings:
    """The heap of one application."""

    limit: int = 64 * KIB * KIB
    """Bytes that `__NEW` may take in all, guards included; with 0 it gives nothing."""
    poison: bool = False
    """Memory that is given back is filled, so that what reads it later reads nonsense."""


DEFAULT_HEAP = HeapSettings()
