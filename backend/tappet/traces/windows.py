"""What a diagram gets of samples: those of a time, or their least and largest values where they are many.

The binary form is described in docs/trace.md: a JSON header and arrays of 64-bit floats, which a browser
takes as they are. Blocks begin at multiples of their length, so that a moving picture does not flicker.
"""

from __future__ import annotations

import json
import struct
from collections.abc import Sequence
from typing import Any

import numpy as np

from tappet.traces.chunks import LEVELS
from tappet.traces.samples import Reals, Samples


def block_length(count: int, width: int) -> int:
    """Samples in a point: 1 as long as there are at most two a pixel, else a multiple of a level."""
    if count <= 2 * width:
        return 1
    wanted = -(-count // width)
    fitting = [size for size in LEVELS if size <= wanted]
    size = fitting[-1] if fitting else 1
    return -(-wanted // size) * size


def span(samples: Samples, start_ns: int | None, end_ns: int | None) -> tuple[int, int]:
    """Numbers of the samples of a time, with one more on each side, where curves leave the picture."""
    start = 0 if start_ns is None else max(0, samples.search(start_ns) - 1)
    stop = samples.count if end_ns is None else min(samples.count, samples.search(end_ns) + 1)
    return start, max(start, stop)


def window(
    samples: Samples,
    start_ns: int | None,
    end_ns: int | None,
    width: int,
    chosen: Sequence[int] | None = None,
    *,
    trigger_ns: int | None = None,
    first_number: int = 0,
) -> bytes:
    """Samples of a time in at most `2 * width` points; `chosen` are the wanted channels."""
    start, stop = span(samples, start_ns, end_ns)
    step = block_length(stop - start, width)
    return points(samples, start, stop, step, chosen, trigger_ns=trigger_ns, first_number=first_number)


def points(
    samples: Samples,
    start: int,
    stop: int,
    step: int,
    chosen: Sequence[int] | None = None,
    *,
    trigger_ns: int | None = None,
    first_number: int = 0,
) -> bytes:
    """Samples `start` to `stop` in blocks of `step`."""
    start = start // step * step
    stop = min(samples.count, -(-stop // step) * step)
    wanted = (
        range(len(samples.channels)) if chosen is None else [c for c in chosen if c < len(samples.channels)]
    )
    arrays: list[Reals] = []
    if step == 1:
        times = samples.times(start, stop)
        gaps = samples.gaps(start, stop)
        ends = None
        arrays += [samples.native(channel, start, stop).astype(np.float64) for channel in wanted]
    else:
        begins = np.arange(start, stop, step)
        lasts = np.minimum(begins + step, stop) - 1
        times, ends = samples.times_at(begins), samples.times_at(lasts)
        gaps = samples.gaps_at(begins)
        for channel in wanted:
            arrays += samples.extremes(channel, start, stop, step)
    origin = int(times[0]) if len(times) else 0
    seconds = [(times - origin) / 1e9] + ([] if ends is None else [(ends - origin) / 1e9])
    count = samples.count
    header: dict[str, Any] = {
        "count": len(times),
        "step": step,
        "first": first_number + start,
        "samples": count,
        "origin_ns": str(origin),
        "start_ns": str(int(samples.times(0, 1)[0])) if count else None,
        "end_ns": str(int(samples.times(count - 1, count)[0])) if count else None,
        "trigger_ns": None if trigger_ns is None else str(trigger_ns),
        "channels": [
            {"index": c.index, "name": c.name, "type": c.type} for c in (samples.channels[n] for n in wanted)
        ],
    }
    return packed(header, [*seconds, *arrays], gaps)


def packed(header: dict[str, Any], arrays: Sequence[Reals], gaps: Any) -> bytes:
    """Header and arrays as one binary answer."""
    text = json.dumps(header, separators=(",", ":")).encode()
    text += b" " * (-(4 + len(text)) % 8)
    body = b"".join(np.ascontiguousarray(array, "<f8").tobytes() for array in arrays)
    return struct.pack("<I", len(text)) + text + body + np.ascontiguousarray(gaps, np.uint8).tobytes()
