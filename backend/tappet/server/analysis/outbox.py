"""What waits to be sent to one browser: messages in order, of each document only the newest messages."""

from __future__ import annotations

import asyncio

MOST_WAITING = 64 * 1024 * 1024
"""Characters that may wait; a browser that takes none of them meanwhile is gone or broken."""


class Outbox:
    """Filled by the analysis, which never waits; emptied by the sender of one socket."""

    def __init__(self) -> None:
        self._waiting: dict[object, str] = {}
        """In order; published diagnostics by their document, so that newer ones take their place."""
        self._size = 0
        self._filled = asyncio.Event()
        self.closed: tuple[int, str] | None = None
        """Close code and reason of a socket that is to end."""
        self.replaced = 0
        """Published diagnostics that newer ones replaced before they were sent."""

    def __len__(self) -> int:
        return len(self._waiting)

    def put(self, text: str, replaces: str = "") -> None:
        """Sends `text` behind what waits, and nothing that waits under the same key."""
        if self.closed is not None:
            return
        key: object = replaces or object()
        before = self._waiting.pop(key, None)
        if before is not None:
            self._size -= len(before)
            self.replaced += 1
        self._waiting[key] = text
        self._size += len(text)
        if self._size > MOST_WAITING:
            self.close(4408, "messages were not taken; connect again")
        self._filled.set()

    def close(self, code: int, reason: str) -> None:
        """Sends nothing any more: the socket ends."""
        self._waiting.clear()
        self._size = 0
        self.closed = self.closed or (code, reason)
        self._filled.set()

    async def take(self) -> str | None:
        """The next message; None when the socket is to end."""
        while self.closed is None:
            if self._waiting:
                text = self._waiting.pop(next(iter(self._waiting)))
                self._size -= len(text)
                return text
            self._filled.clear()
            await self._filled.wait()
        return None
