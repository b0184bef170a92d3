"""Who keeps the flight recorder frozen, and for how long.

A browser that looks back holds it for a while and renews that; when it is gone its hold lapses, so that
recording goes on. A hold without a lease stays until it is released.
"""

from __future__ import annotations

import time
from collections.abc import Callable

ANYBODY = ""
"""Holds that name no owner are one; to release it releases all."""


class FlightHolds:
    """Holds by their owner; not for several threads at a time."""

    def __init__(self, clock: Callable[[], float] = time.monotonic) -> None:
        """`clock` in seconds."""
        self._clock = clock
        self._until: dict[str, float | None] = {}

    def __bool__(self) -> bool:
        return bool(self._until)

    def take(self, owner: str, lease_s: float | None) -> None:
        """Hold it, for `lease_s` from now on."""
        self._until[owner] = None if lease_s is None else self._clock() + lease_s

    def renew(self, owner: str, lease_s: float) -> bool:
        """Hold it further; False when the owner holds it no more."""
        if owner not in self._until:
            return False
        self.take(owner, lease_s)
        return True

    def release(self, owner: str) -> None:
        """Let it go."""
        if owner == ANYBODY:
            self._until.clear()
        else:
            self._until.pop(owner, None)

    def clear(self) -> None:
        """Let all go."""
        self._until.clear()

    def lapse(self) -> bool:
        """Forget those whose time is over; whether the last one is gone by that."""
        now = self._clock()
        lapsed = [owner for owner, until in self._until.items() if until is not None and until <= now]
        for owner in lapsed:
            del self._until[owner]
        return bool(lapsed) and not self._until
