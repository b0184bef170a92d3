"""Properties monitored by calling Get (LPRG-33): the tasks call it while somebody watches the value."""

from __future__ import annotations

import time
from bisect import bisect_left
from collections.abc import Iterable, Sequence

from tappet.codegen.package import CodePackage
from tappet.core.watched_properties import ASKED, FAILED
from tappet.runtime.image import Image

LEASE_S = 3.0
"""A value that was read is kept up to date for so long: whoever reads it reads it again."""
_OFF = b"\0"

Place = tuple[int, int]


class WatchedProperties:
    """Asks the tasks of one application for the values that recorders and readers want."""

    def __init__(self, image: Image) -> None:
        self.image = image
        self.values: list[tuple[int, int, int]] = []
        """Offset and size of each value, offset of the byte that asks for it; by offset."""
        self._asked: set[int] = set()
        self._leases: dict[int, float] = {}
        self._told: set[int] = set()

    def load(self, package: CodePackage) -> None:
        """Take the places of a package; after an online change those of the new one."""
        self.values = package.facts.watched
        self._asked, self._leases, self._told = set(), {}, set()

    def lease(self, places: Iterable[Place]) -> list[int]:
        """Ask for what lies in some places for a while; the bytes of values that are not there yet."""
        if not self.values:
            return []
        wanted = self._in(places)
        until = time.monotonic() + LEASE_S
        self._leases |= dict.fromkeys(wanted, until)
        for asking in wanted:
            self._ask(asking)
        return [asking for asking in wanted if self._state(asking) == ASKED]

    def arrived(self, asking: Sequence[int]) -> bool:
        """Whether Get has been called for all of these."""
        return all(self._state(at) != ASKED for at in asking)

    def update(self, places: Iterable[Place]) -> None:
        """Ask for what recorders sample and readers want, and for nothing else any more."""
        if not self.values:
            return
        now = time.monotonic()
        self._leases = {asking: until for asking, until in self._leases.items() if until > now}
        wanted = self._in(places) | self._leases.keys()
        for asking in wanted:
            self._ask(asking)
        for asking in self._asked - wanted:
            # a cycle that runs now may write once more: looked at again next time
            if self._state(asking) == 0:
                self._asked.discard(asking)
            self.image.write(asking, _OFF)
        self._told &= wanted

    def failed(self) -> list[Place]:
        """Places of the values whose Get has ended in a fault since the last time."""
        found = {asking for asking in self._asked - self._told if self._state(asking) == FAILED}
        self._told |= found
        return [(at, size) for at, size, asking in self.values if asking in found]

    def _in(self, places: Iterable[Place]) -> set[int]:
        found: set[int] = set()
        for offset, size in places:
            number = bisect_left(self.values, (offset,))
            while number > 0 and sum(self.values[number - 1][:2]) > offset:
                number -= 1
            for at, _, asking in self.values[number:]:
                if at >= offset + size:
                    break
                found.add(asking)
        return found

    def _ask(self, asking: int) -> None:
        self._asked.add(asking)
        if self._state(asking) == 0:
            self.image.write(asking, bytes([ASKED]))

    def _state(self, asking: int) -> int:
        return self.image.read(asking, 1)[0]
