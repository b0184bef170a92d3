"""One recorder for all subscriptions at the same pace, whatever values they want.

It records each wanted value once; a subscription gets its values out of the common frame, and those that
want the same ones share the result. So a hundred browsers that look at a machine cost its task, and the wire
to it, what one does.
"""

from __future__ import annotations

import asyncio
import logging
import time
from collections.abc import AsyncIterator, Callable, Iterable
from contextlib import suppress

from tappet.runtime.client import RuntimeRefused
from tappet.runtime.operations.declaration import MAX_ITEMS
from tappet.runtime.operations.values import Read
from tappet.runtime.recorder import LARGEST_FRAME, Frame
from tappet.server.problems import Problem
from tappet.server.runtimes.links import Change, RuntimeLink
from tappet.server.runtimes.plc_client import PlcClient, Recorder

log = logging.getLogger(__name__)
Sink = Callable[[Frame], None]
Place = tuple[int, int]
"""Offset in the image, and size."""
IDLE_INTERVALS = 3
"""A recorder silent for so many intervals is taken to stand still, with its task: values are read instead."""
SLOWEST_IDLE_S = 0.5
GATHER_S = 0.02
"""Subscriptions that come within this time make the recorder begin anew once."""
WASTE = 2
"""The recorder begins anew when it records so many times what is still wanted."""


class Selection:
    """The values of one list of places, out of frames with more of them, and who wants them."""

    def __init__(self, places: tuple[Place, ...]) -> None:
        self.places = places
        self.sinks: set[Sink] = set()
        self.located = False
        """Whether the frames hold its values yet."""
        self._parts: list[tuple[int, int]] = []

    def locate(self, starts: dict[Place, int]) -> None:
        """Where the values lie in a frame."""
        parts: list[tuple[int, int]] = []
        for place in self.places:
            start, end = starts[place], starts[place] + place[1]
            if parts and parts[-1][1] == start:
                parts[-1] = (parts[-1][0], end)
            else:
                parts.append((start, end))
        self._parts = parts
        self.located = True

    def of(self, frame: Frame) -> Frame:
        """A frame with these values alone, in their order."""
        data = b"".join([frame.data[start:end] for start, end in self._parts])
        return Frame(frame.cycle, frame.timestamp_ns, data)


class Sampler:
    """Feeds frames to its selections until it is closed or the runtime is lost."""

    def __init__(self, link: RuntimeLink, interval_ms: int) -> None:
        self._link = link
        self.interval_ms = interval_ms
        self._code_id = link.code_id
        """Of the application whose places these are: in another one they are those of other variables."""
        self.selections: dict[tuple[Place, ...], Selection] = {}
        self.recorded: frozenset[Place] = frozenset()
        """What the frames hold."""
        self.closed = False
        self._last: Frame | None = None
        self._changed = asyncio.Event()
        self._task = asyncio.create_task(self._run(), name=f"sampler {link.name} {interval_ms} ms")

    @property
    def finished(self) -> bool:
        """Whether no frame will come any more."""
        return self._task.done()

    def wanted(self) -> frozenset[Place]:
        """Every place that somebody wants."""
        return frozenset(place for places in self.selections for place in places)

    def takes(self, places: tuple[Place, ...]) -> bool:
        """Whether a frame has room for further places."""
        wanted = self.wanted() | set(places)
        return len(wanted) <= MAX_ITEMS and _size(wanted) <= LARGEST_FRAME

    def add(self, places: tuple[Place, ...], sink: Sink) -> None:
        """Gives frames of `places` to `sink`, a known last one at once."""
        selection = self.selections.get(places)
        if selection is None:
            selection = self.selections[places] = Selection(places)
            if self.recorded.issuperset(places):
                selection.locate(_starts(self.recorded))
            else:
                self._changed.set()
        selection.sinks.add(sink)
        if self._last is not None and selection.located:
            sink(selection.of(self._last))

    def remove(self, places: tuple[Place, ...], sink: Sink) -> None:
        """Ends what `add` began; nothing happens when it has ended."""
        selection = self.selections.get(places)
        if selection is None:
            return
        selection.sinks.discard(sink)
        if not selection.sinks:
            del self.selections[places]
            if _size(self.recorded) > WASTE * _size(self.wanted()):
                self._changed.set()

    async def close(self) -> None:
        """Ends the recorder."""
        self._task.cancel()
        with suppress(asyncio.CancelledError):
            await self._task

    async def _run(self) -> None:
        try:
            async with self._link.client() as client:
                before: Recorder | None = None
                try:
                    while True:
                        await asyncio.sleep(GATHER_S if before is not None else 0)
                        self._changed.clear()
                        recorder = await self._begin(client)
                        if before is not None:
                            await _end(before)
                        before = recorder
                        if recorder is None:
                            await self._read_on(client)
                            return
                        if not await self._follow(client, recorder):
                            return
                finally:
                    if before is not None:
                        await _end(before)
        except Problem as problem:
            log.info("sampler of %s ends: %s", self._link.name, problem.detail)

    async def _begin(self, client: PlcClient) -> Recorder | None:
        """A recorder of all that is wanted now; its values come at once. None if the runtime has no more."""
        self._arrange()
        await self._poll(client)
        try:
            return await client.record(
                sorted(self.recorded), None, 1, self.interval_ms * 1_000_000, code_id=self._code_id
            )
        except RuntimeRefused as refusal:
            log.warning("%s records no more (%s); values are read instead", self._link.name, refusal)
            return None

    def _arrange(self) -> None:
        """From now on frames hold what is wanted."""
        self.recorded = self.wanted()
        self._last = None
        starts = _starts(self.recorded)
        for selection in self.selections.values():
            selection.locate(starts)

    async def _follow(self, client: PlcClient, recorder: Recorder) -> bool:
        """Gives frames of the recorder; while its task stands still, the values are read at leisure.

        True when other values are wanted, False when no frame will come any more.
        """
        frames = aiter(recorder)
        idle = max(self.interval_ms * IDLE_INTERVALS / 1000, SLOWEST_IDLE_S)
        waiting = asyncio.create_task(_next(frames))
        changed = asyncio.create_task(self._changed.wait())
        try:
            while True:
                done, _ = await asyncio.wait(
                    {waiting, changed}, timeout=idle, return_when=asyncio.FIRST_COMPLETED
                )
                if changed in done:
                    return True
                if not done:
                    await self._poll(client)
                    continue
                frame = waiting.result()
                if frame is None:
                    return False
                self._give(frame)
                waiting = asyncio.create_task(_next(frames))
        finally:
            for task in (waiting, changed):
                task.cancel()
                with suppress(asyncio.CancelledError, OSError, RuntimeRefused):
                    await task

    async def _read_on(self, client: PlcClient) -> None:
        """The way without a recorder: the values of a frame are of one moment, but of no certain cycle."""
        while True:
            with suppress(TimeoutError):
                await asyncio.wait_for(self._changed.wait(), self.interval_ms / 1000)
            self._changed.clear()
            if self.recorded != self.wanted():
                self._arrange()
            await self._poll(client)

    async def _poll(self, client: PlcClient) -> None:
        recorded = self.recorded
        values = await client.call(Read(sorted(recorded), self._code_id))
        if recorded is self.recorded:
            self._give(Frame(self._last.cycle if self._last else 0, time.time_ns(), b"".join(values)))

    def _give(self, frame: Frame) -> None:
        self._last = frame
        for selection in tuple(self.selections.values()):
            if selection.located:
                part = selection.of(frame)
                for sink in tuple(selection.sinks):
                    sink(part)


def _starts(places: Iterable[Place]) -> dict[Place, int]:
    """Where each value begins in a frame: they follow each other in the order of the image."""
    found, at = {}, 0
    for place in sorted(places):
        found[place] = at
        at += place[1]
    return found


def _size(places: Iterable[Place]) -> int:
    return sum(size for _, size in places)


async def _end(recorder: Recorder) -> None:
    with suppress(OSError, RuntimeRefused):
        await recorder.close()


async def _next(frames: AsyncIterator[Frame]) -> Frame | None:
    """The next frame; None at the end of the recording."""
    async for frame in frames:
        return frame
    return None


class SamplerPool:
    """Samplers of one runtime: one for each pace, more only where a frame would become too large."""

    def __init__(self, link: RuntimeLink) -> None:
        self._link = link
        self._samplers: list[Sampler] = []
        self._closing: set[asyncio.Task[None]] = set()
        link.listen(self._on_change)

    def __len__(self) -> int:
        return len(self._samplers)

    def _on_change(self, change: Change) -> None:
        """Known places hold no longer: nobody may join the samplers of before."""
        if change is Change.APPLICATION:
            self._samplers.clear()

    def attach(self, places: tuple[Place, ...], interval_ms: int, sink: Sink) -> Callable[[], None]:
        """Gives frames of `places` to `sink`, a known last one at once; returns what ends that."""
        self._samplers = [sampler for sampler in self._samplers if not sampler.finished]
        sampler = next((s for s in self._samplers if s.interval_ms == interval_ms and s.takes(places)), None)
        if sampler is None:
            sampler = Sampler(self._link, interval_ms)
            self._samplers.append(sampler)
        sampler.add(places, sink)

        def detach() -> None:
            sampler.remove(places, sink)
            if not sampler.selections and not sampler.closed:
                sampler.closed = True
                if sampler in self._samplers:
                    self._samplers.remove(sampler)
                task = asyncio.ensure_future(sampler.close())
                self._closing.add(task)
                task.add_done_callback(self._closing.discard)

        return detach
