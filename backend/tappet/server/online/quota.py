"""What one user may watch, over all sockets: who asks for more gets coarser intervals, and starves nobody.

The load of a user is the frames and bytes a second that were asked for. Beyond the quota all intervals of the
user are multiplied by the same power of two, so that small changes of the load change nothing. Work that is
done once, such as finding variables by their names, is paid from a budget that refills.
"""

from __future__ import annotations

import asyncio
from collections.abc import Callable
from dataclasses import dataclass, field

from tappet.server.problems import Problem

FRAMES_PER_S = 1000
"""A hundred panels at ten a second."""
BYTES_PER_S = 4 << 20
EXPRESSIONS_PER_S = 5_000
"""Variables that are looked up."""
BURST_S = 4.0
"""So much of a budget may be saved."""
MOST_EXPRESSIONS = 50_000
"""Watched at a time: they are looked up again after each download."""
MOST_SUBSCRIPTIONS = 300
MOST_SOCKETS = 64
RELAXED = 0.4
"""Intervals become shorter again when the load is below this part of what they carry."""
SLOWEST_MS = 60_000


@dataclass(eq=False, slots=True)
class Share:
    """A subscription: what it asks for, and how it is told its interval."""

    size: int
    interval_ms: int
    expressions: int
    paced: Callable[[int], None] = field(default=lambda _: None)
    """Called with the new interval when others of the user change the load."""


class UserQuota:
    """Of one user."""

    def __init__(self) -> None:
        self.sockets = 0
        self._shares: set[Share] = set()
        self._factor = 1
        self._paid_until = 0.0

    def enter(self, share: Share) -> int:
        """Counts a subscription; returns the interval in ms that it gets. Raises ValueError for too many."""
        if len(self._shares) >= MOST_SUBSCRIPTIONS:
            raise ValueError(f"One user has at most {MOST_SUBSCRIPTIONS} subscriptions at a time.")
        watched = share.expressions + sum(one.expressions for one in self._shares)
        if watched > MOST_EXPRESSIONS:
            raise ValueError(f"One user watches at most {MOST_EXPRESSIONS} variables at a time.")
        self._shares.add(share)
        self._pace()
        return self.interval(share)

    def leave(self, share: Share) -> None:
        """It has ended."""
        self._shares.discard(share)
        self._pace()

    def interval(self, share: Share) -> int:
        """The interval in ms that a subscription has now."""
        return max(share.interval_ms, min(share.interval_ms * self._factor, SLOWEST_MS))

    async def pay(self, expressions: int) -> None:
        """Waits until so many variables may be looked up."""
        now = asyncio.get_running_loop().time()
        self._paid_until = max(self._paid_until, now - BURST_S) + expressions / EXPRESSIONS_PER_S
        if self._paid_until > now:
            await asyncio.sleep(self._paid_until - now)

    def _pace(self) -> None:
        frames = sum(1000 / one.interval_ms for one in self._shares)
        size = sum(one.size * 1000 / one.interval_ms for one in self._shares)
        load = max(frames / FRAMES_PER_S, size / BYTES_PER_S)
        factor = 1
        while factor < load:
            factor *= 2
        if factor == self._factor or RELAXED * self._factor < load <= self._factor:
            return
        self._factor = factor
        for share in tuple(self._shares):
            share.paced(self.interval(share))


class UserQuotas:
    """Of all who watch now, by the id of the user."""

    def __init__(self) -> None:
        self._quotas: dict[str, UserQuota] = {}

    def open(self, user_id: str) -> UserQuota:
        """One more socket of a user; `close` must follow. Raises a 429 problem when there are too many."""
        quota = self._quotas.setdefault(user_id, UserQuota())
        if quota.sockets >= MOST_SOCKETS:
            raise Problem(429, "too-many-sockets", f"One user has at most {MOST_SOCKETS} online channels.")
        quota.sockets += 1
        return quota

    def close(self, user_id: str) -> None:
        """One socket less."""
        quota = self._quotas[user_id]
        quota.sockets -= 1
        if not quota.sockets:
            del self._quotas[user_id]
