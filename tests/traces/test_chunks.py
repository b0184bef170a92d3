"""Recordings on disk and their windows, to the sample, against numpy over all samples."""

from __future__ import annotations

import tempfile
import warnings
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from sampled_batches import CHANNELS, batch, read_window

from tappet.traces.chunks import CHUNK, ChunkFiles, StoredSamples
from tappet.traces.samples import Batch, BatchSamples, Samples, joined
from tappet.traces.windows import block_length, window


def _parts(whole: Batch, sizes: list[int]) -> list[Batch]:
    cuts = np.minimum(np.cumsum([0, *sizes]), len(whole)).tolist()
    return [whole.part(a, b) for a, b in zip(cuts, [*cuts[1:], len(whole)], strict=True)]


def _check_window(samples: Samples, whole: Batch, start: int | None, end: int | None, width: int) -> None:
    """Every point holds the least and largest value of exactly its samples."""
    found = read_window(window(samples, start, end, width))
    first, step, count = found["first"], found["step"], found["count"]
    assert count <= 2 * width + 2
    times = whole.time
    inside = np.flatnonzero((times >= (start or 0)) & (times <= (end if end is not None else times[-1])))
    stop = min(first + count * step, len(whole)) if step > 1 else first + count
    if len(inside):  # all of them are shown, and the neighbours of the picture, too
        assert first <= max(0, inside[0] - 1)
        assert end is None or stop >= min(len(whole), int(np.searchsorted(times, end)) + 1)
    origin = int(found["origin_ns"])
    begins = np.arange(first, stop, step)
    assert np.allclose(found["time"], (times[begins] - origin) / 1e9, atol=1e-9)
    assert found["gap"].tolist() == whole.gap[begins].tolist()
    for number, column in enumerate(whole.values):
        real = column.astype(float)
        if step == 1:
            assert np.array_equal(found["values"][number], real[first:stop], equal_nan=True)
            continue
        blocks = [real[b : min(b + step, len(whole))] for b in begins]
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # all NaN
            assert np.array_equal(found["low"][number], [np.nanmin(b) for b in blocks], equal_nan=True)
            assert np.array_equal(found["high"][number], [np.nanmax(b) for b in blocks], equal_nan=True)


@settings(max_examples=40, deadline=None)
@given(st.data())
def test_any_window_is_right_to_the_sample(data: st.DataObject) -> None:
    count = data.draw(st.integers(1, 5 * CHUNK))
    whole = batch(count, data.draw(st.integers(0, 99)))
    sizes = data.draw(st.lists(st.integers(0, 2 * CHUNK), max_size=5))
    low, high = int(whole.time[0]), int(whole.time[-1])
    places = st.integers(low - 5_000_000, high + 5_000_000)
    with tempfile.TemporaryDirectory() as folder:
        stored = StoredSamples(Path(folder), 0, CHANNELS)
        for part in _parts(whole, sizes):
            stored.append(part)
        assert stored.count == count
        for samples in (stored, BatchSamples(CHANNELS, whole)):
            _check_window(samples, whole, None, None, data.draw(st.integers(1, 2000)))
            for _ in range(3):
                start, end = sorted((data.draw(places), data.draw(places)))
                _check_window(samples, whole, start, end, data.draw(st.integers(1, 300)))


@given(st.integers(0, 20_000_000), st.integers(1, 5000))
def test_a_point_is_as_short_as_the_width_allows(count: int, width: int) -> None:
    step = block_length(count, width)
    assert -(-count // step) <= 2 * width
    assert step == 1 or count > 2 * width


def test_columns_come_back_as_they_were() -> None:
    whole = batch(3 * CHUNK + 100)
    with tempfile.TemporaryDirectory() as folder:
        stored = StoredSamples(Path(folder), 1, CHANNELS)
        for part in _parts(whole, [1, 4000, 5000]):
            stored.append(part)
        for a, b in ((0, len(whole)), (4095, 4097), (5, 5), (3 * CHUNK, len(whole)), (100, 3 * CHUNK + 50)):
            assert stored.cycles(a, b).tolist() == whole.cycle[a:b].tolist()
            assert stored.times(a, b).tolist() == whole.time[a:b].tolist()
            for number, column in enumerate(whole.values):
                found = stored.native(number, a, b)
                assert found.dtype == column.dtype
                assert np.array_equal(found, column[a:b], equal_nan=number == 0)


@pytest.mark.parametrize("left", [0, 1, 1000])
def test_what_a_killed_process_has_written_is_read_again(tmp_path: Path, left: int) -> None:
    """A chunk that is written in part counts as none; what `flush` kept is there."""
    whole = batch(2 * CHUNK + 500)
    stored = StoredSamples(tmp_path, 0, CHANNELS)
    stored.append(whole.part(0, 2 * CHUNK + 300))
    stored.flush()
    for name in ("record0.samples", "record0.by16"):
        with (tmp_path / name).open("ab") as file:
            file.write(b"\1" * left)
    again = StoredSamples(tmp_path, 0, CHANNELS)
    assert again.count == 2 * CHUNK + 300
    again.append(whole.part(2 * CHUNK + 300, len(whole)))
    assert again.cycles(0, again.count).tolist() == whole.cycle.tolist()
    _check_window(again, whole, None, None, 7)


def test_a_tail_that_was_kept_before_its_chunk_is_not_counted_twice(tmp_path: Path) -> None:
    whole = batch(CHUNK + 200)
    stored = StoredSamples(tmp_path, 0, CHANNELS)
    stored.append(whole.part(0, CHUNK - 10))
    stored.flush()
    stored.append(whole.part(CHUNK - 10, CHUNK + 200))
    again = StoredSamples(tmp_path, 0, CHANNELS)
    assert again.cycles(0, again.count).tolist() == whole.cycle[:CHUNK].tolist()
    (tmp_path / "record0.tail.npz").write_bytes(b"PK damaged")
    assert StoredSamples(tmp_path, 0, CHANNELS).count == CHUNK


def test_bytes_are_those_of_the_columns_and_a_sixteenth_of_both_extremes(tmp_path: Path) -> None:
    stored = StoredSamples(tmp_path, 0, CHANNELS)
    stored.append(batch(4 * CHUNK))
    columns = 4 * CHUNK * (8 + 8 + 1 + 8 + 2 + 1)
    pyramid = 3 * 2 * 8 * 4 * (CHUNK // 16 + CHUNK // 256 + 1)
    assert stored.bytes == columns + pyramid == sum(path.stat().st_size for path in tmp_path.iterdir())
    assert ChunkFiles(tmp_path, 0, CHANNELS).chunks() == 4


def test_joined_batches() -> None:
    whole = batch(100)
    again = joined([whole.part(0, 30), whole.part(30, 30), whole.part(30, 100)])
    assert again.cycle.tolist() == whole.cycle.tolist()
    assert np.array_equal(again.values[0], whole.values[0], equal_nan=True)


@settings(max_examples=25, deadline=None)
@given(st.data())
def test_dropped_chunks_are_gone_and_the_others_as_they_were(data: st.DataObject) -> None:
    """Against a plain slice; also after the recording was opened again, and with samples that come later."""
    count = data.draw(st.integers(1, 6 * CHUNK))
    whole = batch(count, data.draw(st.integers(0, 99)))
    cut = data.draw(st.integers(0, count))
    with tempfile.TemporaryDirectory() as folder:
        stored = StoredSamples(Path(folder), 0, CHANNELS)
        stored.append(whole.part(0, cut))
        chunks, dropped = cut // CHUNK, 0
        for wanted in data.draw(st.lists(st.integers(0, 4), max_size=3)):
            stored.drop(wanted)
            dropped += max(0, min(wanted, chunks - dropped - 1))
        stored.flush()
        if data.draw(st.booleans()):
            stored = StoredSamples(Path(folder), 0, CHANNELS)
        stored.append(whole.part(cut, count))
        left = whole.part(dropped * CHUNK, count)
        assert (stored.dropped, stored.count) == (dropped * CHUNK, len(left))
        assert (stored.first_ns, stored.last_ns) == (int(left.time[0]), int(left.time[-1]))
        assert stored.cycles(0, stored.count).tolist() == left.cycle.tolist()
        _check_window(stored, left, None, None, data.draw(st.integers(1, 500)))
        low, high = int(whole.time[0]), int(whole.time[-1])
        a, b = sorted((data.draw(st.integers(low, high)), data.draw(st.integers(low, high))))
        _check_window(stored, left, a, b, data.draw(st.integers(1, 500)))
        ends = left.time[CHUNK - 1 : len(left) // CHUNK * CHUNK : CHUNK]
        assert stored.chunks_before(a) == int((ends < a).sum())


def test_dropped_chunks_give_their_room_back(tmp_path: Path) -> None:
    stored = StoredSamples(tmp_path, 0, CHANNELS)
    stored.append(batch(8 * CHUNK))
    before = stored.bytes
    stored.drop(6)
    assert stored.count == 2 * CHUNK
    # Pages that are shared with what is left stay.
    assert (
        before - 6 * stored.bytes_per_chunk <= stored.bytes <= before - 6 * stored.bytes_per_chunk + 5 * 4096
    )
    taken = sum(path.stat().st_blocks * 512 for path in tmp_path.iterdir())
    assert taken < before / 2
