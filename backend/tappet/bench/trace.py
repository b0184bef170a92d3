"""Windows of a recording of ten million samples, as a diagram asks for them.

The baseline takes the least and largest values of the same blocks out of all samples of the span, held in
memory as arrays: what a server without a pyramid would do at best. Shown is processor time, the median of
several places.
"""

from __future__ import annotations

import tempfile
import time
from collections.abc import Callable
from pathlib import Path
from statistics import median

import numpy as np

from tappet.bench.report import Report, Row
from tappet.traces.chunks import CHUNK, StoredSamples
from tappet.traces.recording import ChannelInfo
from tappet.traces.samples import Batch, BatchSamples
from tappet.traces.windows import window

SAMPLES = 10_000_000
CHANNELS = 8
WIDTH = 1500
"""Points of the diagram."""
ROUNDS = 15
_SPANS = {
    "whole recording": SAMPLES,
    "1,000,000 samples": 1_000_000,
    "100,000 samples": 100_000,
    "2,000 samples": 2000,
}
_BLOCK = CHUNK * 16


def _batch(start: int, stop: int) -> Batch:
    cycle = np.arange(start, stop)
    values = [np.sin(cycle / (100.0 * (n + 1))) for n in range(CHANNELS)]
    return Batch(cycle, cycle * 1_000_000, np.zeros(len(cycle), np.uint8), list(values))


def _median(work: Callable[[int], object], span: int) -> float:
    """Milliseconds of processor time; `work` gets the begin of a window."""
    places = np.random.default_rng(1).integers(0, max(1, SAMPLES - span), ROUNDS).tolist()
    times = []
    for place in places:
        begun = time.process_time()
        work(place * 1_000_000)
        times.append(time.process_time() - begun)
    return median(times) * 1000


def run() -> Report:
    """Writes a recording, then measures."""
    channels = [ChannelInfo(n, f"v{n}", "LREAL", "f8") for n in range(CHANNELS)]
    with tempfile.TemporaryDirectory(prefix="tappet-bench-") as folder:
        stored = StoredSamples(Path(folder), 0, channels)
        begun = time.process_time()
        for start in range(0, SAMPLES, _BLOCK):
            stored.append(_batch(start, min(SAMPLES, start + _BLOCK)))
        written = time.process_time() - begun
        whole = BatchSamples(channels, _batch(0, SAMPLES))
        rows = []
        for name, span in _SPANS.items():
            length = span * 1_000_000
            ours = _median(lambda at, n=length: window(stored, at, at + n, WIDTH), span)  # type: ignore[misc]
            base = _median(lambda at, n=length: window(whole, at, at + n, WIDTH), span)  # type: ignore[misc]
            rows.append(Row(name, ours, base, "ms"))
        size = f"{SAMPLES:,} samples of {CHANNELS} LREAL, {stored.bytes >> 20} MiB"
        remarks = [f"{size}, made and written in {written:.1f} s of processor time; {WIDTH} points"]
        return Report("trace", "least and largest values of all samples in memory", rows, "", remarks)
