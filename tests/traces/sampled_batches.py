"""Batches of samples made by numpy alone, and binary windows read back."""

from __future__ import annotations

import json
import struct
from typing import Any

import numpy as np

from tappet.traces.recording import ChannelInfo
from tappet.traces.samples import Batch

CHANNELS = [
    ChannelInfo(0, "P.r", "LREAL", "f8"),
    ChannelInfo(1, "P.i", "INT", "i2"),
    ChannelInfo(3, "P.x", "BOOL", "u1"),
]


def batch(count: int, seed: int = 0, *, start: int = 0, holes: bool = True) -> Batch:
    """`count` samples 1 ms apart with gaps, NaN and all signs."""
    rng = np.random.default_rng(seed)
    steps = np.where(rng.random(count) < (0.01 if holes else 0.0), rng.integers(2, 50, count), 1)
    cycle = start + np.cumsum(steps).astype(np.int64)
    reals = rng.normal(size=count) * 10.0 ** rng.integers(-3, 4, count)
    if holes:
        reals[rng.random(count) < 0.05] = np.nan
    return Batch(
        cycle,
        1_700_000_000_000_000_000 + cycle * 1_000_000,
        (steps != 1).astype(np.uint8),
        [reals, rng.integers(-32768, 32767, count).astype("i2"), rng.integers(0, 2, count).astype("u1")],
    )


def read_window(data: bytes) -> dict[str, Any]:
    """The header with the arrays `time`, `end`, `gap`, and `values` or `low` and `high`."""
    (length,) = struct.unpack_from("<I", data)
    assert (4 + length) % 8 == 0
    found: dict[str, Any] = json.loads(data[4 : 4 + length])
    count, channels = found["count"], len(found["channels"])
    at = 4 + length

    def take() -> np.ndarray[Any, Any]:
        nonlocal at
        array = np.frombuffer(data, "<f8", count, at)
        at += 8 * count
        return array

    found["time"] = take()
    if found["step"] == 1:
        found["values"] = [take() for _ in range(channels)]
    else:
        found["end"] = take()
        pairs = [(take(), take()) for _ in range(channels)]
        found["low"], found["high"] = [p[0] for p in pairs], [p[1] for p in pairs]
    found["gap"] = np.frombuffer(data, np.uint8, count, at)
    assert at + count == len(data)
    return found
