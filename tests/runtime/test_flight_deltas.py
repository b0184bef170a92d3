"""Entries of the flight recorder: there and back again, and damaged bytes end in a clear error."""

from __future__ import annotations

import struct
from functools import reduce
from operator import xor

import pytest
from hypothesis import given
from hypothesis import strategies as st

from tappet.runtime.flight_deltas import (
    BLOCK,
    ENTRY_SIZE,
    Entry,
    FlightError,
    checksum,
    rebuild,
    undo,
    unpack_entries,
    xor_words,
)  # fmt: skip

BLOCKS = 8
images = st.binary(min_size=BLOCKS * BLOCK, max_size=BLOCKS * BLOCK)
changes = st.lists(
    st.dictionaries(st.integers(0, BLOCKS - 1), st.binary(min_size=BLOCK, max_size=BLOCK)), max_size=6
)


def entry_of(data: bytes, number: int = 0, position: int = 0) -> Entry:
    cycle, stamp = 100 + number, 1_700_000_000_000_000_000 + number
    return Entry(number, position, len(data), cycle, stamp, checksum(position, cycle, stamp, data))


def delta(before: bytes, blocks: dict[int, bytes]) -> bytes:
    """What the executive writes when these blocks change: neighbours as one run."""
    data = b""
    numbers = sorted(blocks)
    while numbers:
        run = [numbers.pop(0)]
        while numbers and numbers[0] == run[-1] + 1:
            run.append(numbers.pop(0))
        size = len(run) * BLOCK
        data += struct.pack("<II", run[0] * BLOCK, size) + before[run[0] * BLOCK : run[0] * BLOCK + size]
    return data


@given(images, changes)
def test_every_image_of_a_history_comes_back(first: bytes, steps: list[dict[int, bytes]]) -> None:
    history, deltas = [first], []
    for number, blocks in enumerate(steps):
        image = bytearray(history[-1])
        for block, value in blocks.items():
            image[block * BLOCK : (block + 1) * BLOCK] = value
        data = delta(history[-1], blocks)
        deltas.append((entry_of(data, number), data))
        history.append(bytes(image))
    for i, wanted in enumerate(history):
        assert rebuild(history[-1], list(reversed(deltas[i:]))) == wanted


@given(images, changes.filter(any), st.data())
def test_damaged_bytes_are_an_error_and_change_nothing(
    before: bytes, steps: list[dict[int, bytes]], draw: st.DataObject
) -> None:
    blocks = next(b for b in steps if b)
    data = delta(before, blocks)
    entry = entry_of(data)
    at = draw.draw(st.integers(0, len(data) - 1))
    damage = draw.draw(st.integers(1, 255))
    wrong = bytearray(data)
    wrong[at] ^= damage
    image = bytearray(before)
    with pytest.raises(FlightError, match="entry of cycle 100 is damaged"):
        undo(image, entry, bytes(wrong))
    assert image == before


@given(images, st.binary(max_size=400))
def test_foreign_bytes_with_a_fitting_checksum_stay_inside_the_image(before: bytes, data: bytes) -> None:
    data = data[: len(data) // 8 * 8]
    image = bytearray(before)
    message = ""
    try:
        undo(image, entry_of(data), data)
    except FlightError as error:
        message = str(error)
    if message:
        assert "entry of cycle 100 is damaged" in message
        assert image == before
    assert len(image) == len(before)


@pytest.mark.parametrize(
    ("offset", "size", "length"),
    [(0, 0, 0), (8, 64, 64), (0, 32, 32), (0, 128, 64), (BLOCKS * BLOCK, 64, 64), (0xFFFFFFC0, 64, 64)],
)
def test_impossible_runs_are_named(offset: int, size: int, length: int) -> None:
    data = struct.pack("<II", offset, size) + bytes(length)
    with pytest.raises(FlightError, match=f"a run of {size} bytes for offset {offset}"):
        undo(bytearray(BLOCKS * BLOCK), entry_of(data), data)


def test_runs_out_of_order_and_short_data_are_errors() -> None:
    run = struct.pack("<II", 64, 64) + bytes(64)
    with pytest.raises(FlightError, match="damaged"):
        undo(bytearray(BLOCKS * BLOCK), entry_of(run + run), run + run)
    with pytest.raises(FlightError, match="64 bytes instead of 72"):
        undo(bytearray(BLOCKS * BLOCK), entry_of(run), run[:-8])


@given(st.lists(st.integers(0, (1 << 64) - 1), max_size=40))
def test_xor_of_words(words: list[int]) -> None:
    assert xor_words(b"".join(w.to_bytes(8, "little") for w in words)) == reduce(xor, words, 0)


@given(st.binary(max_size=200))
def test_entries_out_of_any_memory(data: bytes) -> None:
    if len(data) % ENTRY_SIZE:
        with pytest.raises(FlightError, match="are no entries"):
            unpack_entries(7, data)
    else:
        assert [e.number for e in unpack_entries(7, data)] == list(range(7, 7 + len(data) // ENTRY_SIZE))
