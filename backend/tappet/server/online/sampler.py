"""One recorder for all subscriptions that want the same values at the same pace."""

from __future__ import annotations

import asyncio
import logging
import time
from collections.abc import AsyncIterator, Callable
from contextlib import suppress

from tappet.runtime.client import RuntimeRefused
from tappet.runtime.operations.values import Read
from tappet.runtime.recorder import Frame
from tappet.server.problems import Problem
from tappet.server.runtimes.links import Change, RuntimeLink
from tappet.server.runtimes.plc_client import PlcClient, Recorder

log = logging.getLogger(__name__)
Sink = Callable[[Frame], None]
IDLE_INTERVALS = 3
"""A recorder silent for so many intervals is taken to stand still, with its task: values are read instead."""
SLOWEST_IDLE_S = 0.5
Key = tuple[tuple[tuple[int, int], ...], int]


class Sampler:
    """Feeds frames to its sinks until it is closed or the runtime is lost."""

    def __init__(self, link: RuntimeLink, key: Key) -> None:
        self._link = link
        self.places, self.interval_ms = key
        self.sinks: set[Sink] = set()
        self.last: Frame | None = None
        self._task = asyncio.create_task(self._run(), name=f"sampler {link.name} {self.interval_ms} ms")

    @property
    def finished(self) -> bool:
        """Whether no frame will come any more."""
        return self._task.done()

    async def close(self) -> None:
        """Ends the recorder."""
        self._task.cancel()
        with suppress(asyncio.CancelledError):
            await self._task

    async def _run(self) -> None:
        try:
            async with self._link.client() as client:
                await self._poll(client)
                try:
                    recorder = await client.record(self.places, None, 1, self.interval_ms * 1_000_000)
                except RuntimeRefused as refusal:
                    log.warning("%s records no more (%s); values are read instead", self._link.name, refusal)
                    await self._read_on(client)
                    return
                try:
                    await self._follow(client, recorder)
                finally:
                    with suppress(OSError, RuntimeRefused):
                        await recorder.close()
        except Problem as problem:
            log.info("sampler of %s ends: %s", self._link.name, problem.detail)

    async def _follow(self, client: PlcClient, recorder: Recorder) -> None:
        """Frames of the recorder; while its task stands still, the values are read at leisure."""
        frames = aiter(recorder)
        idle = max(self.interval_ms * IDLE_INTERVALS / 1000, SLOWEST_IDLE_S)
        waiting = asyncio.create_task(_next(frames))
        try:
            while True:
                done, _ = await asyncio.wait({waiting}, timeout=idle)
                if not done:
                    await self._poll(client)
                    continue
                frame = waiting.result()
                if frame is None:
                    return
                self._give(frame)
                waiting = asyncio.create_task(_next(frames))
        finally:
            waiting.cancel()
            with suppress(asyncio.CancelledError, OSError, RuntimeRefused):
                await waiting

    async def _read_on(self, client: PlcClient) -> None:
        """The way without a recorder: the values of a frame are of one moment, but of no certain cycle."""
        while True:
            await asyncio.sleep(self.interval_ms / 1000)
            await self._poll(client)

    async def _poll(self, client: PlcClient) -> None:
        values = await client.call(Read(list(self.places)))
        self._give(Frame(self.last.cycle if self.last else 0, time.time_ns(), b"".join(values)))

    def _give(self, frame: Frame) -> None:
        self.last = frame
        for sink in tuple(self.sinks):
            sink(frame)


async def _next(frames: AsyncIterator[Frame]) -> Frame | None:
    """The next frame; None at the end of the recording."""
    async for frame in frames:
        return frame
    return None


class SamplerPool:
    """Samplers of one runtime by what they sample."""

    def __init__(self, link: RuntimeLink) -> None:
        self._link = link
        self._samplers: dict[Key, Sampler] = {}
        self._closing: set[asyncio.Task[None]] = set()
        link.listen(self._on_change)

    def __len__(self) -> int:
        return len(self._samplers)

    def _on_change(self, change: Change) -> None:
        """Known places hold no longer: nobody may join the samplers of before."""
        if change is Change.APPLICATION:
            self._samplers.clear()

    def attach(self, places: tuple[tuple[int, int], ...], interval_ms: int, sink: Sink) -> Callable[[], None]:
        """Gives frames of `places` to `sink`, a known last one at once; returns what ends that."""
        key = (places, interval_ms)
        sampler = self._samplers.get(key)
        if sampler is None or sampler.finished:
            sampler = self._samplers[key] = Sampler(self._link, key)
        sampler.sinks.add(sink)
        if sampler.last is not None:
            sink(sampler.last)

        def detach() -> None:
            sampler.sinks.discard(sink)
            if not sampler.sinks:
                if self._samplers.get(key) is sampler:
                    del self._samplers[key]
                task = asyncio.ensure_future(sampler.close())
                self._closing.add(task)
                task.add_done_callback(self._closing.discard)

        return detach
