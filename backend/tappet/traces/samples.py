"""Samples as columns: number of the cycle, unix time, and a column a channel.

Contract of a `Samples`: samples are numbered from 0 without holes, times never fall. `extremes` gives, for
blocks of `step` samples, the least and largest value without NaN, which stands for no value.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, Protocol

import numpy as np
import numpy.typing as npt
from msgspec import Struct

from tappet.runtime.trace_record import HEADER_SIZE, TraceSource
from tappet.traces.recording import ChannelInfo

Reals = npt.NDArray[np.float64]
Integers = npt.NDArray[np.int64]
Flags = npt.NDArray[np.uint8]


class Batch(Struct, frozen=True):
    """Samples that follow each other."""

    cycle: Integers
    time: Integers
    gap: Flags
    """1 where samples are missing before this one."""
    values: list[npt.NDArray[Any]]

    def __len__(self) -> int:
        return len(self.cycle)

    def part(self, start: int, stop: int) -> Batch:
        """Some of them."""
        return Batch(
            self.cycle[start:stop],
            self.time[start:stop],
            self.gap[start:stop],
            [column[start:stop] for column in self.values],
        )


def joined(batches: Sequence[Batch]) -> Batch:
    """Batches one behind the other."""
    columns = zip(*(batch.values for batch in batches), strict=True) if batches[0].values else ()
    return Batch(
        np.concatenate([batch.cycle for batch in batches]),
        np.concatenate([batch.time for batch in batches]),
        np.concatenate([batch.gap for batch in batches]),
        [np.concatenate(column) for column in columns],
    )


def empty_batch(channels: Sequence[ChannelInfo]) -> Batch:
    """No samples."""
    whole = np.empty(0, np.int64)
    return Batch(whole, whole, np.empty(0, np.uint8), [np.empty(0, c.number) for c in channels])


def batch_of(
    data: bytes, sources: Sequence[TraceSource], frame_size: int, every: int, last_cycle: int | None
) -> Batch:
    """Frames of a ring as columns; `last_cycle` is the cycle of the sample before."""
    frames = np.frombuffer(data, frame_dtype(list(sources), frame_size))
    cycle = frames["cycle"].astype(np.int64)
    before = cycle
    if len(cycle):
        first = cycle[0] - every if last_cycle is None else last_cycle
        before = np.concatenate([[first], cycle[:-1]])
    values = []
    for number, source in enumerate(sources):
        column = frames[str(number)]
        if source.bit is not None:
            column = column >> source.bit & 1
        elif source.truth:
            column = column & 1
        values.append(np.ascontiguousarray(column))
    gap = (cycle - before != every).astype(np.uint8)
    return Batch(cycle, frames["time"].astype(np.int64), gap, values)


class Samples(Protocol):
    """Samples of one record that can be looked at."""

    @property
    def channels(self) -> Sequence[ChannelInfo]:
        """What is sampled."""

    @property
    def count(self) -> int:
        """How many there are."""

    def times(self, start: int, stop: int) -> Integers:
        """Unix times in ns."""

    def cycles(self, start: int, stop: int) -> Integers:
        """Numbers of the cycles."""

    def gaps(self, start: int, stop: int) -> Flags:
        """1 where samples are missing before."""

    def times_at(self, numbers: Integers) -> Integers:
        """Unix times of single samples."""

    def gaps_at(self, numbers: Integers) -> Flags:
        """1 where samples are missing before single samples."""

    def native(self, channel: int, start: int, stop: int) -> npt.NDArray[Any]:
        """Values as the type of the variable has them."""

    def search(self, time: int) -> int:
        """Number of the first sample that is not before a time."""

    def extremes(self, channel: int, start: int, stop: int, step: int) -> tuple[Reals, Reals]:
        """Least and largest values of blocks; `start` is a multiple of `step`."""


def reduced(values: npt.NDArray[Any], step: int) -> tuple[Reals, Reals]:
    """Least and largest values of blocks of `step` values, the last one perhaps shorter."""
    if not len(values):
        return np.empty(0), np.empty(0)
    real = values.astype(np.float64, copy=False)
    starts = np.arange(0, len(values), step)
    return np.fmin.reduceat(real, starts), np.fmax.reduceat(real, starts)


class BatchSamples:
    """Samples in memory."""

    def __init__(self, channels: Sequence[ChannelInfo], batch: Batch) -> None:
        self.channels = list(channels)
        self._batch = batch

    @property
    def count(self) -> int:
        """How many there are."""
        return len(self._batch)

    def times(self, start: int, stop: int) -> Integers:
        """Unix times in ns."""
        return self._batch.time[start:stop]

    def cycles(self, start: int, stop: int) -> Integers:
        """Numbers of the cycles."""
        return self._batch.cycle[start:stop]

    def gaps(self, start: int, stop: int) -> Flags:
        """1 where samples are missing before."""
        return self._batch.gap[start:stop]

    def times_at(self, numbers: Integers) -> Integers:
        """Unix times of single samples."""
        return self._batch.time[numbers]

    def gaps_at(self, numbers: Integers) -> Flags:
        """1 where samples are missing before single samples."""
        return self._batch.gap[numbers]

    def native(self, channel: int, start: int, stop: int) -> npt.NDArray[Any]:
        """Values as the type of the variable has them."""
        return self._batch.values[channel][start:stop]

    def search(self, time: int) -> int:
        """Number of the first sample that is not before a time."""
        return int(np.searchsorted(self._batch.time, time))

    def extremes(self, channel: int, start: int, stop: int, step: int) -> tuple[Reals, Reals]:
        """Least and largest values of blocks."""
        return reduced(self._batch.values[channel][start:stop], step)


def frame_dtype(sources: list[TraceSource], frame_size: int) -> np.dtype[np.void]:
    """How a frame reads: `cycle`, `time`, and the sources by their numbers in the list."""
    names, formats, offsets = ["cycle", "time"], ["<i8", "<i8"], [0, 8]
    at = HEADER_SIZE
    for number, source in enumerate(sources):
        if source.program is not None:
            names.append(str(number))
            formats.append("<f8")
            offsets.append(at)
            at += 8
    for number, source in enumerate(sources):
        if source.program is None:
            names.append(str(number))
            formats.append(f"<{source.number}")
            offsets.append(at)
            at += source.size
    return np.dtype({"names": names, "formats": formats, "offsets": offsets, "itemsize": frame_size})
