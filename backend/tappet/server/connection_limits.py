"""How many connections the server takes, as far as the system lets it."""

from __future__ import annotations

import resource
from contextlib import suppress
from dataclasses import dataclass

DESCRIPTORS_WANTED = 8192
DESCRIPTORS_KEPT = 256
"""For files, the database, processes and listening sockets."""


@dataclass(frozen=True, slots=True)
class ConnectionLimits:
    """Most connections at a time."""

    total: int = 2000
    of_address: int = 500
    """Some dozens of browsers behind one address: each tab keeps up to six connections and its sockets."""

    def within(self, descriptors: int) -> ConnectionLimits:
        """The same, as far as so many file descriptors allow."""
        total = max(min(self.total, descriptors - DESCRIPTORS_KEPT), 16)
        return ConnectionLimits(total, min(self.of_address, max(total // 2, 8)))


def raise_descriptor_limit() -> int:
    """Asks the system for enough file descriptors; returns how many there are."""
    soft, hard = resource.getrlimit(resource.RLIMIT_NOFILE)
    wanted = DESCRIPTORS_WANTED if hard == resource.RLIM_INFINITY else min(DESCRIPTORS_WANTED, hard)
    if soft != resource.RLIM_INFINITY and soft < wanted:
        with suppress(OSError, ValueError):
            resource.setrlimit(resource.RLIMIT_NOFILE, (wanted, hard))
            return wanted
    return DESCRIPTORS_WANTED if soft == resource.RLIM_INFINITY else soft
