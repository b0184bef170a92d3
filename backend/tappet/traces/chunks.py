"""Samples on disk: columns in chunks, and the least and largest values of blocks of 16, 256 and 4096 samples.

A file of chunks is only appended to, a chunk at a time, so that what was written stays readable whatever
happens to the process. Within a chunk a column lies in one piece. Of the pyramid only the topmost level is
kept in memory (16 bytes a channel for 4096 samples): any window reads a few pages of the level whose blocks
fit its width. The oldest chunks can be dropped: their room in the files is given back, and what is left is
numbered from 0 again.
"""

from __future__ import annotations

import os
from bisect import bisect_left
from collections.abc import Sequence
from itertools import accumulate
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from tappet.traces.holes import punch_hole
from tappet.traces.recording import ChannelInfo
from tappet.traces.samples import (
    Batch,
    Flags,
    Integers,
    Reals,
    empty_batch,
    joined,
    reduced,
)

CHUNK = 4096
LEVELS = (16, 256, 4096)
"""Samples in a block of each level of the pyramid; the last one is a chunk."""


class ChunkFiles:
    """The files of one record: one of samples and one for each level of the pyramid."""

    def __init__(self, folder: Path, record: int, channels: Sequence[ChannelInfo]) -> None:
        self.channels = list(channels)
        self.dtypes: list[np.dtype[Any]] = [np.dtype("<i8"), np.dtype("<i8"), np.dtype("u1")]
        self.dtypes += [np.dtype(f"<{channel.number}") for channel in channels]
        self.offsets = list(accumulate((d.itemsize * CHUNK for d in self.dtypes), initial=0))
        self._samples = folder / f"record{record}.samples"
        self._levels = [folder / f"record{record}.by{size}" for size in LEVELS]
        self._tail = folder / f"record{record}.tail.npz"
        self._dropped_file = folder / f"record{record}.dropped"
        self.dropped = int(self._dropped_file.read_text()) if self._dropped_file.exists() else 0
        """Chunks that were dropped; all numbers are of those behind them."""
        self._maps: dict[Path, npt.NDArray[Any]] = {}

    @property
    def chunk_size(self) -> int:
        """Bytes of a chunk of samples."""
        return self.offsets[-1]

    def chunks(self) -> int:
        """How many are complete in all files."""
        counts = [_size(self._samples) // self.chunk_size]
        width = 16 * len(self.channels)
        if width:
            counts += [
                _size(path) // (width * (CHUNK // size))
                for path, size in zip(self._levels, LEVELS, strict=True)
            ]
        return max(0, min(counts) - self.dropped)

    def bytes(self) -> int:
        """On disk."""
        return sum(_room(path) for path in (self._samples, self._tail, *self._levels))

    def sizes(self) -> list[tuple[Path, int]]:
        """Bytes that a chunk has in each file."""
        width = 16 * len(self.channels)
        sizes = [self.chunk_size, *(width * (CHUNK // size) for size in LEVELS)]
        return list(zip((self._samples, *self._levels), sizes, strict=True))

    def drop(self, count: int) -> int:
        """Drop the oldest chunks; how many, as the last one stays."""
        count = min(count, self.chunks() - 1)
        if count <= 0:
            return 0
        self.dropped += count
        unfinished = self._dropped_file.with_suffix(".new")
        unfinished.write_text(str(self.dropped))
        unfinished.replace(self._dropped_file)
        for path, size in self.sizes():
            punch_hole(path, self.dropped * size)
        return count

    def cut(self) -> int:
        """Drop what a killed process has left behind the last complete chunk; how many there are."""
        count = self.chunks()
        for path, size in self.sizes():
            if _size(path) > (self.dropped + count) * size:
                os.truncate(path, (self.dropped + count) * size)
        return count

    def append(self, batch: Batch) -> Reals:
        """Write a full chunk; gives its topmost level: least and largest value of each channel."""
        columns: list[npt.NDArray[Any]] = [batch.cycle, batch.time, batch.gap, *batch.values]
        pairs = [[reduced(column, size) for column in batch.values] for size in LEVELS]
        # the samples last: a chunk counts when they are complete
        for path, level in zip(self._levels, pairs, strict=True):
            _append(path, b"".join(part.tobytes() for pair in level for part in pair))
        _append(
            self._samples,
            b"".join(c.astype(d, copy=False).tobytes() for c, d in zip(columns, self.dtypes, strict=True)),
        )
        return np.array([[low[0], high[0]] for low, high in pairs[-1]]).reshape(len(self.channels), 2)

    def _mapped(self, path: Path, dtype: Any, shape: tuple[int, ...], count: int) -> npt.NDArray[Any]:
        """The first chunks of a file, at least `count`; mapped again when the file has grown."""
        found = self._maps.get(path)
        if found is None or len(found) < count:
            found = self._maps[path] = np.memmap(path, dtype, "r", 0, (count, *shape))
        return found

    def _column(self, number: int, count: int) -> npt.NDArray[Any]:
        """A column as a table of chunks."""
        dtype, start = self.dtypes[number], self.offsets[number]
        raw = self._mapped(self._samples, np.uint8, (self.chunk_size,), self.dropped + count)
        return raw[self.dropped :, start : start + dtype.itemsize * CHUNK].view(dtype)

    def column(self, number: int, first: int, last: int) -> npt.NDArray[Any]:
        """A column of chunks `first` to `last`: cycle, time, gap, then the channels."""
        if last <= first:
            return np.empty(0, self.dtypes[number])
        return self._column(number, last)[first:last].reshape(-1)

    def at(self, number: int, samples: Integers) -> npt.NDArray[Any]:
        """Single values of a column."""
        column = self._column(number, int(samples[-1]) // CHUNK + 1)
        return np.asarray(column[samples // CHUNK, samples % CHUNK])

    def level(self, number: int, channel: int, first: int, last: int) -> Reals:
        """Least and largest values of the blocks of a level in chunks `first` to `last`: two rows."""
        if last <= first:
            return np.empty((2, 0))
        shape = (len(self.channels), 2, CHUNK // LEVELS[number])
        whole = self._mapped(self._levels[number], np.float64, shape, self.dropped + last)
        raw = whole[self.dropped + first : self.dropped + last]
        return np.ascontiguousarray(raw[:, channel].transpose(1, 0, 2)).reshape(2, -1)

    def keep_tail(self, batch: Batch) -> None:
        """Write the samples behind the last chunk, in place of those before."""
        unfinished = self._tail.with_suffix(".new")
        columns: dict[str, Any] = {"cycle": batch.cycle, "time": batch.time, "gap": batch.gap}
        columns |= {f"v{number}": column for number, column in enumerate(batch.values)}
        with unfinished.open("wb") as file:
            np.savez(file, allow_pickle=False, **columns)
        unfinished.replace(self._tail)

    def kept_tail(self) -> Batch:
        """The samples behind the last chunk, as they were kept; none where the file is damaged."""
        try:
            with np.load(self._tail, allow_pickle=False) as file:
                values = [file[f"v{n}"] for n in range(len(self.channels))]
                return Batch(file["cycle"], file["time"], file["gap"], values)
        except (OSError, ValueError, KeyError, EOFError):
            return empty_batch(self.channels)


def _size(path: Path) -> int:
    return path.stat().st_size if path.exists() else 0


def _room(path: Path) -> int:
    """Bytes that a file takes: fewer than its size where it begins with a hole."""
    if not path.exists():
        return 0
    found = path.stat()
    return min(found.st_size, found.st_blocks * 512)


def _append(path: Path, data: bytes) -> None:
    with path.open("ab") as file:
        file.write(data)


class StoredSamples:
    """Samples of one record on disk, with those in memory that fill no chunk yet."""

    def __init__(self, folder: Path, record: int, channels: Sequence[ChannelInfo]) -> None:
        self.channels = list(channels)
        self._files = ChunkFiles(folder, record, channels)
        self._chunks = self._files.cut()
        self._tail = self._files.kept_tail()
        tops = [self._files.level(len(LEVELS) - 1, c, 0, self._chunks) for c in range(len(channels))]
        self._top = [list(top) for top in tops]
        edges = np.arange(self._chunks, dtype=np.int64) * CHUNK
        self._begins = self._files.at(1, edges).tolist() if self._chunks else []
        self._ends = self._files.at(1, edges + CHUNK - 1).tolist() if self._chunks else []
        self._gaps = self._files.at(2, edges).tolist() if self._chunks else []
        self._drop_written()

    def _drop_written(self) -> None:
        """A tail that was kept before its chunk was written begins with samples of that chunk."""
        if self._chunks and len(self._tail):
            last = self._files.column(0, self._chunks - 1, self._chunks)[-1]
            self._tail = self._tail.part(
                int(np.searchsorted(self._tail.cycle, last, "right")), len(self._tail)
            )

    @property
    def count(self) -> int:
        """How many samples there are."""
        return self._chunks * CHUNK + len(self._tail)

    @property
    def bytes(self) -> int:
        """On disk."""
        return self._files.bytes()

    @property
    def dropped(self) -> int:
        """Samples that were there before the first one."""
        return self._files.dropped * CHUNK

    @property
    def first_ns(self) -> int | None:
        """Unix time of the first sample."""
        return int(self.times(0, 1)[0]) if self.count else None

    @property
    def last_ns(self) -> int | None:
        """Unix time of the last sample."""
        return int(self.times(self.count - 1, self.count)[0]) if self.count else None

    @property
    def bytes_per_chunk(self) -> int:
        """What dropping one gives back."""
        return sum(size for _, size in self._files.sizes())

    def drop(self, chunks: int) -> None:
        """Drop the oldest chunks; the last one stays."""
        count = self._files.drop(chunks)
        self._chunks -= count
        self._top = [[low[count:], high[count:]] for low, high in self._top]
        for kept in (self._begins, self._ends, self._gaps):
            del kept[:count]

    def chunks_before(self, time: int) -> int:
        """How many chunks end before a time."""
        return bisect_left(self._ends, time)

    @property
    def last_cycle(self) -> int | None:
        """Of the last sample."""
        return int(self.cycles(self.count - 1, self.count)[0]) if self.count else None

    def append(self, batch: Batch) -> None:
        """Keep more samples."""
        if not len(batch):
            return
        waiting = joined([self._tail, batch]) if len(self._tail) else batch
        start = 0
        while len(waiting) - start >= CHUNK:
            part = waiting.part(start, start + CHUNK)
            top = self._files.append(part)
            for channel, (low, high) in enumerate(top):
                kept = self._top[channel]
                self._top[channel] = [np.append(kept[0], low), np.append(kept[1], high)]
            self._begins.append(int(part.time[0]))
            self._ends.append(int(part.time[-1]))
            self._gaps.append(int(part.gap[0]))
            self._chunks += 1
            start += CHUNK
        self._tail = waiting.part(start, len(waiting))

    def flush(self) -> None:
        """Bring what is in memory to disk."""
        self._files.keep_tail(self._tail)

    def _tail_column(self, number: int) -> npt.NDArray[Any]:
        """A column of the samples in memory, numbered as in the files."""
        tail = self._tail
        columns: list[npt.NDArray[Any]] = [tail.cycle, tail.time, tail.gap, *tail.values]
        return columns[number]

    def _column(self, number: int, start: int, stop: int) -> npt.NDArray[Any]:
        stored = self._chunks * CHUNK
        tail = self._tail_column(number)
        behind = tail[max(0, start - stored) : max(0, stop - stored)]
        if start >= stored:
            return behind
        first, last = start // CHUNK, -(-min(stop, stored) // CHUNK)
        found = self._files.column(number, first, last)[
            start - first * CHUNK : min(stop, stored) - first * CHUNK
        ]
        return np.concatenate([found, behind]) if len(behind) else found

    def cycles(self, start: int, stop: int) -> Integers:
        """Numbers of the cycles."""
        return self._column(0, start, stop)

    def times(self, start: int, stop: int) -> Integers:
        """Unix times in ns."""
        return self._column(1, start, stop)

    def gaps(self, start: int, stop: int) -> Flags:
        """1 where samples are missing before."""
        return self._column(2, start, stop)

    def _at(self, number: int, samples: Integers) -> npt.NDArray[Any]:
        """Single values of a column; `samples` rise."""
        stored = self._chunks * CHUNK
        tail = self._tail_column(number)
        behind = int(np.searchsorted(samples, stored))
        if not behind:
            return tail[samples - stored]
        return np.concatenate([self._inside(number, samples[:behind]), tail[samples[behind:] - stored]])

    def _inside(self, number: int, samples: Integers) -> npt.NDArray[Any]:
        """The same of complete chunks, whose edges are in memory."""
        chunks, places = samples // CHUNK, samples % CHUNK
        if number == 1 and not places.any():
            return np.asarray(self._begins, np.int64)[chunks]
        if number == 1 and (places == CHUNK - 1).all():
            return np.asarray(self._ends, np.int64)[chunks]
        if number == 2 and not places.any():
            return np.asarray(self._gaps, np.uint8)[chunks]
        return self._files.at(number, samples)

    def times_at(self, numbers: Integers) -> Integers:
        """Unix times of single samples."""
        return self._at(1, numbers)

    def gaps_at(self, numbers: Integers) -> Flags:
        """1 where samples are missing before single samples."""
        return self._at(2, numbers)

    def native(self, channel: int, start: int, stop: int) -> npt.NDArray[Any]:
        """Values as the type of the variable has them."""
        return self._column(3 + channel, start, stop)

    def search(self, time: int) -> int:
        """Number of the first sample that is not before a time."""
        chunk = int(np.searchsorted(np.asarray(self._begins, np.int64), time)) - 1
        if chunk < 0 and self._chunks:
            return 0
        start = max(0, chunk) * CHUNK
        stop = min(start + CHUNK, self.count) if chunk < self._chunks - 1 else self.count
        return start + int(np.searchsorted(self.times(start, stop), time))

    def extremes(self, channel: int, start: int, stop: int, step: int) -> tuple[Reals, Reals]:
        """Least and largest values of blocks, from the level whose blocks fit into the step."""
        fitting = [number for number, size in enumerate(LEVELS) if step % size == 0]
        if not fitting:
            return reduced(self.native(channel, start, stop), step)
        number = fitting[-1]
        size = LEVELS[number]
        stored = self._chunks * CHUNK
        end = min(stop, stored) // size * size
        low, high = self._blocks(number, channel, start, end)
        rest_low, rest_high = reduced(self.native(channel, max(start, end), stop), size)
        low, high = np.concatenate([low, rest_low]), np.concatenate([high, rest_high])
        starts = np.arange(0, len(low), step // size)
        if not len(starts):
            return low, high
        return np.fmin.reduceat(low, starts), np.fmax.reduceat(high, starts)

    def _blocks(self, number: int, channel: int, start: int, end: int) -> tuple[Reals, Reals]:
        """Blocks of a level from sample `start` to `end`, both multiples of their size."""
        size = LEVELS[number]
        if end <= start:
            return np.empty(0), np.empty(0)
        if size == CHUNK:
            low, high = self._top[channel]
            return low[start // size : end // size], high[start // size : end // size]
        first, last = start // CHUNK, -(-end // CHUNK)
        both = self._files.level(number, channel, first, last)
        offset = first * (CHUNK // size)
        part = both[:, start // size - offset : end // size - offset]
        return part[0], part[1]
