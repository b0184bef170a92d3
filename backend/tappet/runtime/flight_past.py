"""The images of a recording: any cycle of it, or all of them in order."""

from __future__ import annotations

from bisect import bisect_left
from collections.abc import Iterator

from tappet.runtime.flight_deltas import FlightError, delta_runs
from tappet.runtime.flight_recording import FlightRecording

MOST_KEPT = 64
"""Images that are kept besides the last one, so that no cycle takes long to rebuild."""


class RecordedPast:
    """Rebuilds past images; not for several threads at a time."""

    def __init__(self, recording: FlightRecording) -> None:
        self.recording = recording
        self.cycles = [one.cycle for one in recording.cycles]
        self._step = max(64, -(-len(self.cycles) // MOST_KEPT))
        self._kept = {len(self.cycles) - 1: recording.base}
        self._last: tuple[int, bytes] = (len(self.cycles) - 1, recording.base)

    def index_of(self, cycle: int) -> int:
        """Place of a cycle among those that are kept; FlightError when it is not."""
        at = bisect_left(self.cycles, cycle)
        if at == len(self.cycles) or self.cycles[at] != cycle:
            raise FlightError(
                f"cycle {cycle} is not in the recording, which holds cycles {self.cycles[0]} to"
                f" {self.cycles[-1]}"
            )
        return at

    def image(self, index: int) -> bytes:
        """The image at the end of a cycle, by its place; in whole blocks."""
        start, image = self._nearest(index)
        back = bytearray(image)
        for at in range(start, index, -1):
            if at % self._step == 0:
                self._kept.setdefault(at, bytes(back))
            self._undo(back, at)
        found = bytes(back)
        self._last = (index, found)
        return found

    def forward(self) -> Iterator[bytes]:
        """All images, oldest first; of as many as lie between two that are kept there is a copy at a time."""
        count = len(self.cycles)
        self.image(0)
        for first in range(0, count, self._step):
            last = min(first + self._step, count) - 1
            image = bytearray(self.image(last))
            segment = [bytes(image)]
            for at in range(last, first, -1):
                self._undo(image, at)
                segment.append(bytes(image))
            yield from reversed(segment)

    def _nearest(self, index: int) -> tuple[int, bytes]:
        """The nearest image that is known at the place or behind it."""
        known = min(at for at in self._kept if at >= index)
        if index <= self._last[0] <= known:
            return self._last
        return known, self._kept[known]

    def _undo(self, image: bytearray, index: int) -> None:
        delta = self.recording.cycles[index].delta
        for offset, at, size in delta_runs(delta, len(image)):
            image[offset : offset + size] = delta[at : at + size]
