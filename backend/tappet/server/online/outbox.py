"""What waits to be sent to one browser: messages in order, of frames only the newest of each subscription."""

from __future__ import annotations

import asyncio
from collections import deque

LONGEST = 200
"""Messages that may wait before nothing more is read from the browser."""


class Outbox:
    """Filled by samplers and the reader, emptied by one sender."""

    def __init__(self) -> None:
        self._messages: deque[str] = deque()
        self._frames: dict[int, bytes] = {}
        self._filled = asyncio.Event()
        self._room = asyncio.Event()
        self._room.set()
        self.replaced = 0
        """Frames that a newer one replaced before they were sent."""
        self.sent = 0

    def put_message(self, text: str) -> None:
        """Sends `text` before any frame that is put later."""
        self._messages.append(text)
        if len(self._messages) >= LONGEST:
            self._room.clear()
        self._filled.set()

    def put_frame(self, subscription: int, frame: bytes) -> None:
        """Sends `frame`, unless a newer one of the subscription comes first."""
        if self._frames.pop(subscription, None) is not None:
            self.replaced += 1
        self._frames[subscription] = frame
        self._filled.set()

    def drop_frame(self, subscription: int) -> None:
        """Forgets the waiting frame of a subscription that ends or changes its layout."""
        self._frames.pop(subscription, None)

    async def take(self) -> str | bytes:
        """The next thing to send: messages first, then the frame that waits longest."""
        while True:
            if self._messages:
                text = self._messages.popleft()
                if len(self._messages) < LONGEST // 2:
                    self._room.set()
                return text
            if self._frames:
                self.sent += 1
                return self._frames.pop(next(iter(self._frames)))
            self._filled.clear()
            await self._filled.wait()

    async def wait_for_room(self) -> None:
        """Returns when the browser has taken most of its messages."""
        await self._room.wait()
