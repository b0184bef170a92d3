"""Recorders of one connection, and the frames that could not be sent to it yet."""

from __future__ import annotations

from collections import deque
from collections.abc import Collection, Iterator

from tappet.runtime import recorder_wire
from tappet.runtime.recorder import Recorder

MOST_RECORDERS = 256
"""Recorders of one connection."""
PENDING_BYTES = 4 << 20
"""Recorder bytes kept for a slow client; older ones are dropped first."""


class Subscription:
    """A recorder of a client and what could not be sent to it yet."""

    def __init__(self, number: int, recorder: Recorder) -> None:
        self.number = number
        self.recorder = recorder
        self._pending: deque[tuple[int, bytes]] = deque()
        self._bytes = 0
        self.dropped = 0
        """Frames that were sampled but dropped because the client was slow."""

    def drain(self) -> bool:
        """Take new frames out of the ring; whether there are any to send."""
        count, data = self.recorder.take_raw()
        if count:
            self._pending.append((count, data))
            self._bytes += len(data)
        while self._bytes > PENDING_BYTES and len(self._pending) > 1:
            lost, old = self._pending.popleft()
            self.dropped += lost
            self._bytes -= len(old)
        return bool(self._pending)

    def message(self) -> bytes | None:
        """Everything pending as one message."""
        if not self._pending:
            return None
        count = sum(n for n, _ in self._pending)
        data = b"".join(d for _, d in self._pending)
        self._pending.clear()
        self._bytes = 0
        dropped = self.dropped + self.recorder.dropped
        return recorder_wire.pack_frames(self.number, count, self.recorder.frame_size, dropped, data)


class Subscriptions:
    """The recorders of one connection by number."""

    def __init__(self) -> None:
        self._next = 1
        self._by_number: dict[int, Subscription] = {}

    def __len__(self) -> int:
        return len(self._by_number)

    def __iter__(self) -> Iterator[Subscription]:
        return iter(list(self._by_number.values()))

    def add(self, recorder: Recorder) -> int:
        """The number of a new recorder."""
        number = self._next
        self._next += 1
        self._by_number[number] = Subscription(number, recorder)
        return number

    def remove(self, number: int) -> Recorder | None:
        """Forget a recorder; None when there is none of this number."""
        found = self._by_number.pop(number, None)
        return None if found is None else found.recorder

    def clear(self) -> list[Recorder]:
        """Forget all; returns them."""
        recorders = [s.recorder for s in self]
        self._by_number.clear()
        return recorders

    def drain(self) -> bool:
        """Take new frames out of all rings; whether there are any to send."""
        return sum(subscription.drain() for subscription in self) > 0

    def ended(self, alive: Collection[int]) -> list[int]:
        """Forget the recorders whose `id` is not among `alive`; their numbers."""
        gone = [s.number for s in self if id(s.recorder) not in alive]
        for number in gone:
            del self._by_number[number]
        return gone
