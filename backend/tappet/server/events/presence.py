"""Who has a project open: joins and leaves become few messages, however many sockets come and go.

A socket gets the list once, after it has asked; all that have the list get one message for a batch of
changes, and batches keep their distance. So the messages of a second are as many as the sockets.
"""

from __future__ import annotations

import asyncio
from collections.abc import Callable, Iterable

from tappet.server.events.shapes import Presence, PresenceChanged, PresentUser

BATCHES_PER_S = 4
Deliver = Callable[[Iterable[int], Presence | PresenceChanged], None]
"""Queues one message for the sockets of these numbers."""


class ProjectPresence:
    """The sockets of one project by number. Lives in the event loop."""

    def __init__(self, deliver: Deliver) -> None:
        self._deliver = deliver
        self._present: dict[int, PresentUser] = {}
        self._told: set[int] = set()
        """Numbers in the list that the sockets of `_listed` have."""
        self._listed: set[int] = set()
        self._asking: set[int] = set()
        self._changed: set[int] = set()
        self._next: asyncio.TimerHandle | None = None
        self._earliest = 0.0

    def enter(self, number: int, username: str) -> None:
        """A socket is there."""
        self._present[number] = PresentUser(id=number, username=username, object_id=None)
        self._note(number)

    def look(self, number: int, object_id: str | None) -> None:
        """It has an object open; the first time it asks for the list as well."""
        if self._present[number].object_id != object_id:
            self._present[number] = self._present[number].model_copy(update={"object_id": object_id})
            self._note(number)
        if number not in self._listed:
            self._asking.add(number)
            self._send_soon()

    def leave(self, number: int) -> None:
        """It is gone."""
        del self._present[number]
        self._listed.discard(number)
        self._asking.discard(number)
        if number in self._told:
            self._note(number)
        else:
            self._changed.discard(number)

    def close(self) -> None:
        """Nobody is to be told any more."""
        if self._next is not None:
            self._next.cancel()
            self._next = None

    def _note(self, number: int) -> None:
        self._changed.add(number)
        if self._listed:
            self._send_soon()

    def _send_soon(self) -> None:
        if self._next is None:
            loop = asyncio.get_running_loop()
            self._next = loop.call_at(max(loop.time(), self._earliest), self._send)

    def _send(self) -> None:
        self._next = None
        self._earliest = asyncio.get_running_loop().time() + 1 / BATCHES_PER_S
        changed, self._changed = sorted(self._changed), set()
        asking, self._asking = self._asking, set()
        present = [self._present[number] for number in changed if number in self._present]
        left = [number for number in changed if number in self._told and number not in self._present]
        if present or left:
            self._deliver(self._listed, PresenceChanged(present=present, left=left))
        self._told = set(self._present)
        self._listed |= asking
        if asking:
            self._deliver(asking, Presence(users=list(self._present.values())))
