"""One recorder serves all subscriptions of a pace, and each gets its own values out of the common frame."""

from __future__ import annotations

import asyncio
from collections.abc import AsyncIterator, Callable, Sequence
from contextlib import asynccontextmanager
from random import Random
from typing import Any

import pytest

from tappet.runtime.client import RuntimeRefused
from tappet.runtime.recorder import Frame
from tappet.server.online.sampler import Place, SamplerPool
from tappet.server.problems import Problem

SIZE = 400


class Memory:
    """A runtime of bytes: recorders copy them when a cycle ends."""

    name = "memory"

    def __init__(self) -> None:
        self.image = bytearray(Random(1).randbytes(SIZE))
        self.cycle = 0
        self.recorders: list[Recording] = []
        self.begun = 0
        self.refuses = False
        self.code_id = self.loaded = "first"
        """Of the application whose places are known, and of the one that is loaded by now."""
        self.sent = 0
        """Bytes of values that recorders have sent."""

    def listen(self, listener: Callable[[Any], None]) -> Callable[[], None]:
        return lambda: None

    @asynccontextmanager
    async def client(self) -> AsyncIterator[Memory]:
        yield self

    async def call(self, read: Any) -> list[bytes]:
        if read.code_id != self.loaded:
            raise Problem(409, "refused", "the application was changed meanwhile")
        return [bytes(self.image[offset : offset + size]) for offset, size in read.places]

    async def record(
        self,
        items: Sequence[Place],
        task: str | None,
        divider: int,
        min_interval_ns: int,
        *,
        code_id: str,
    ) -> Recording:
        if code_id != self.loaded:
            raise RuntimeRefused("refused", "the application was changed meanwhile")
        if self.refuses:
            raise RuntimeRefused("refused", "no more")
        self.begun += 1
        recording = Recording(self, items)
        self.recorders.append(recording)
        return recording

    def run_cycle(self) -> None:
        self.cycle += 1
        for recorder in self.recorders:
            data = b"".join(self.image[offset : offset + size] for offset, size in recorder.items)
            self.sent += len(data)
            recorder.frames.put_nowait(Frame(self.cycle, self.cycle, data))


class Recording:
    def __init__(self, memory: Memory, items: Sequence[Place]) -> None:
        self.memory = memory
        self.items = items
        self.frames: asyncio.Queue[Frame] = asyncio.Queue()

    def __aiter__(self) -> Recording:
        return self

    async def __anext__(self) -> Frame:
        return await self.frames.get()

    async def close(self) -> None:
        self.memory.recorders.remove(self)


class Seen:
    """A sink, with the values that it has to see."""

    def __init__(self, memory: Memory, places: tuple[Place, ...]) -> None:
        self.memory = memory
        self.places = places
        self.frames: list[Frame] = []

    def __call__(self, frame: Frame) -> None:
        self.frames.append(frame)

    def is_right(self) -> bool:
        """Whether the newest frame holds what memory holds now."""
        wanted = b"".join(bytes(self.memory.image[offset : offset + size]) for offset, size in self.places)
        return bool(self.frames) and self.frames[-1].data == wanted


async def until(holds: Callable[[], bool]) -> None:
    """Lets the others run until it holds."""
    end = asyncio.get_running_loop().time() + 20
    while not holds():
        assert asyncio.get_running_loop().time() < end
        await asyncio.sleep(0.001)


PLACES = tuple((at, 4) for at in range(0, SIZE, 4))


@pytest.mark.parametrize("sessions", [1, 100])
async def test_sessions_that_want_the_same_cost_what_one_costs(sessions: int) -> None:
    memory = Memory()
    pool = SamplerPool(memory)  # type: ignore[arg-type]
    seen = [Seen(memory, PLACES) for _ in range(sessions)]
    ends = [pool.attach(PLACES, 100, one) for one in seen]
    await until(lambda: all(one.is_right() for one in seen) and len(memory.recorders) == 1)
    memory.image[:] = bytes(reversed(memory.image))
    memory.run_cycle()
    await until(lambda: all(one.is_right() for one in seen))
    assert (memory.begun, memory.sent, len(pool)) == (1, SIZE, 1)
    for end in ends:
        end()
        end()
    await until(lambda: memory.recorders == [])
    assert len(pool) == 0


async def test_places_of_an_application_are_not_recorded_in_another_one() -> None:
    """An online change comes between the subscription and the recorder; the link learns of it later."""
    memory = Memory()
    pool = SamplerPool(memory)  # type: ignore[arg-type]
    old = Seen(memory, PLACES[:3])
    end = pool.attach(old.places, 100, old)
    memory.loaded = "second"
    for _ in range(20):
        await asyncio.sleep(0)
        memory.run_cycle()
    assert (old.frames, memory.begun) == ([], 0)
    end()
    memory.code_id = "second"
    new = Seen(memory, PLACES[:3])
    pool.attach(new.places, 100, new)
    await until(lambda: new.is_right() and memory.begun == 1)
    assert old.frames == []


async def test_a_change_between_two_wishes_ends_the_recorder_of_before() -> None:
    memory = Memory()
    pool = SamplerPool(memory)  # type: ignore[arg-type]
    first, second = Seen(memory, PLACES[:3]), Seen(memory, PLACES[3:6])
    pool.attach(first.places, 100, first)
    await until(lambda: first.is_right() and memory.begun == 1)
    known = len(first.frames)
    memory.loaded = "second"
    pool.attach(second.places, 100, second)
    await until(lambda: memory.recorders == [])
    assert (len(first.frames), second.frames) == (known, [])


async def test_overlapping_wishes_share_one_recorder_that_has_each_value_once() -> None:
    memory = Memory()
    pool = SamplerPool(memory)  # type: ignore[arg-type]
    seen = [Seen(memory, PLACES[first : first + 50]) for first in range(0, 50, 10)]
    for one in seen:
        pool.attach(one.places, 100, one)
    await until(lambda: len(memory.recorders) == 1 and sorted(memory.recorders[0].items) == list(PLACES[:90]))
    memory.image[:] = bytes(reversed(memory.image))
    memory.run_cycle()
    await until(lambda: all(one.is_right() for one in seen))
    assert memory.sent == 90 * 4


async def test_another_pace_has_a_recorder_of_its_own() -> None:
    memory = Memory()
    pool = SamplerPool(memory)  # type: ignore[arg-type]
    for interval in (100, 200, 100):
        pool.attach(PLACES, interval, Seen(memory, PLACES))
    await until(lambda: len(memory.recorders) == 2)
    assert len(pool) == 2


async def test_what_nobody_wants_any_more_is_recorded_no_longer() -> None:
    memory = Memory()
    pool = SamplerPool(memory)  # type: ignore[arg-type]
    few, many = Seen(memory, PLACES[:10]), Seen(memory, PLACES)
    pool.attach(few.places, 100, few)
    end = pool.attach(many.places, 100, many)
    await until(lambda: len(memory.recorders) == 1 and len(memory.recorders[0].items) == 100)
    end()
    await until(lambda: len(memory.recorders) == 1 and len(memory.recorders[0].items) == 10)
    memory.image[:] = bytes(reversed(memory.image))
    memory.run_cycle()
    await until(few.is_right)


async def test_without_a_recorder_values_are_read() -> None:
    memory = Memory()
    memory.refuses = True
    pool = SamplerPool(memory)  # type: ignore[arg-type]
    first = Seen(memory, PLACES[:3])
    pool.attach(first.places, 1, first)
    await until(first.is_right)
    memory.image[:] = bytes(reversed(memory.image))
    second = Seen(memory, PLACES[50:])
    pool.attach(second.places, 1, second)
    await until(lambda: first.is_right() and second.is_right())
    assert memory.begun == 0


@pytest.mark.parametrize("seed", range(20))
async def test_whoever_comes_and_goes_each_sees_its_values(seed: int) -> None:
    r = Random(seed)
    memory = Memory()
    pool = SamplerPool(memory)  # type: ignore[arg-type]
    present: dict[Seen, Callable[[], None]] = {}
    for _ in range(12):
        for _ in range(r.randint(0, 3)):
            offsets = [r.randrange(SIZE - 8) for _ in range(r.randint(1, 12))]
            one = Seen(memory, tuple((at, r.choice((1, 2, 4, 8))) for at in offsets))
            present[one] = pool.attach(one.places, r.choice((100, 200)), one)
        for one in [one for one in present if r.random() < 0.3]:
            present.pop(one)()
            one.frames.clear()
        await until(lambda: all(one.frames for one in present))
        memory.image[:] = r.randbytes(SIZE)

        def everybody_is_right() -> bool:
            memory.run_cycle()
            return all(one.is_right() for one in present)

        await until(everybody_is_right)
        assert len(memory.recorders) <= 4
    for end in present.values():
        end()
    await until(lambda: memory.recorders == [])
