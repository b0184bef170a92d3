"""What is computed of a channel over a span of samples, however long: statistics, spectrum, calculus.

Samples without a value (NaN) are left out. Gaps are not bridged: a derivative has no value behind one, an
integral does not grow over one.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from msgspec import Struct

from tappet.traces.questions import Operation, WindowFunction
from tappet.traces.recording import ChannelInfo
from tappet.traces.samples import Batch, Integers, Reals, Samples

BLOCK = 1 << 18
MOST_SPECTRUM = 1 << 20
"""Samples of one spectrum; a longer span is averaged over such pieces (Welch's method, without overlap)."""
_COSINES: dict[str, tuple[float, ...]] = {
    "rectangular": (1.0,),
    "hann": (0.5, 0.5),
    "hamming": (0.54, 0.46),
    "blackman": (0.42, 0.5, 0.08),
    "flat_top": (0.21557895, 0.41663158, 0.277263158, 0.083578947, 0.006947368),
}
"""Coefficients of the cosine series; the flat top is that of ISO 18431-2, as scipy has it."""


class Statistics(Struct, frozen=True):
    """Of a span of a channel."""

    count: int
    invalid: int
    """Samples without a value."""
    minimum: float | None = None
    maximum: float | None = None
    mean: float | None = None
    rms: float | None = None
    deviation: float | None = None
    """Standard deviation of the population."""
    first: float | None = None
    last: float | None = None
    minimum_ns: str | None = None
    maximum_ns: str | None = None


class Spectrum(Struct, frozen=True):
    """Amplitudes of the sines that a span consists of; at 0 Hz the mean."""

    step_hz: float
    sample_hz: float
    samples: int
    """Used for each piece."""
    pieces: int
    amplitudes: list[float]


def _pieces(start: int, stop: int) -> Iterator[tuple[int, int]]:
    for first in range(start, stop, BLOCK):
        yield first, min(stop, first + BLOCK)


def _real(samples: Samples, channel: int, start: int, stop: int) -> Reals:
    return samples.native(channel, start, stop).astype(np.float64)


def statistics(samples: Samples, channel: int, start: int, stop: int) -> Statistics:
    """Least, largest and mean values; sums are shifted by the first value, so that they stay exact."""
    count, shift, total, squares = 0, 0.0, 0.0, 0.0
    low, high, low_at, high_at = np.inf, -np.inf, 0, 0
    first = last = None
    for a, b in _pieces(start, stop):
        values = _real(samples, channel, a, b)
        valid = np.flatnonzero(np.isfinite(values))
        if not len(valid):
            continue
        found = values[valid]
        if first is None:
            first = shift = float(found[0])
        last = float(found[-1])
        if found.min() < low:
            low, low_at = float(found.min()), a + int(valid[found.argmin()])
        if found.max() > high:
            high, high_at = float(found.max()), a + int(valid[found.argmax()])
        count += len(found)
        total += float((found - shift).sum())
        squares += float(((found - shift) ** 2).sum())
    invalid = max(0, stop - start) - count
    if not count:
        return Statistics(0, invalid)
    offset = total / count
    variance = max(0.0, squares / count - offset**2)
    mean = shift + offset
    times = [str(int(samples.times(n, n + 1)[0])) for n in (low_at, high_at)]
    rms = float(np.sqrt(variance + mean**2))
    return Statistics(count, invalid, low, high, mean, rms, float(np.sqrt(variance)), first, last, *times)


def window_function(name: WindowFunction, count: int) -> Reals:
    """A periodic window, whose sum the amplitudes are divided by."""
    phase = 2 * np.pi * np.arange(count) / count
    terms = [(-1) ** k * a * np.cos(k * phase) for k, a in enumerate(_COSINES[name])]
    return np.asarray(sum(terms), np.float64)


def spectrum(
    samples: Samples, channel: int, start: int, stop: int, name: WindowFunction = "hann"
) -> Spectrum:
    """Single-sided amplitude spectrum on the grid of the median distance of the samples."""
    times = samples.times(start, min(stop, start + BLOCK))
    distances = np.diff(times)
    if len(distances) < 1 or np.median(distances) <= 0:
        return Spectrum(0.0, 0.0, 0, 0, [])
    rate = 1e9 / float(np.median(distances))
    size = min(stop - start, MOST_SPECTRUM)
    pieces = (stop - start) // size
    weights = window_function(name, size)
    power = np.zeros(size // 2 + 1)
    for piece in range(pieces):
        a = start + piece * size
        values = _even(samples, channel, a, a + size)
        amplitudes = np.abs(np.fft.rfft(values * weights)) * 2 / weights.sum()
        amplitudes[0] /= 2
        if size % 2 == 0:
            amplitudes[-1] /= 2
        power += amplitudes**2
    return Spectrum(rate / size, rate, size, pieces, np.sqrt(power / pieces).tolist())


def _even(samples: Samples, channel: int, start: int, stop: int) -> Reals:
    """Values at equal distances: missing samples are interpolated."""
    values, times = _real(samples, channel, start, stop), samples.times(start, stop).astype(np.float64)
    valid = np.isfinite(values)
    if not valid.any():
        return np.zeros(len(values))
    grid = np.linspace(times[0], times[-1], len(times))
    return np.interp(grid, times[valid], values[valid])


class Derived:
    """The derivative or the integral of a channel, as samples of their own that are computed in blocks."""

    def __init__(self, samples: Samples, channel: int, operation: Operation) -> None:
        self._samples = samples
        self._channel = channel
        known = samples.channels[channel]
        name = f"d({known.name})/dt" if operation == "derivative" else f"∫({known.name})dt"
        self.channels = [ChannelInfo(known.index, name, "LREAL", "f8")]
        self._operation = operation

    def batch(self, start: int, stop: int) -> Batch:
        """Of a span. A derivative is the slope from the sample before, an integral that of trapezia from the
        begin of the span."""
        samples = self._samples
        before = start - 1 if self._operation == "derivative" and start > 0 else start
        times, gaps = samples.times(before, stop), samples.gaps(before, stop)
        values = _real(samples, self._channel, before, stop)
        seconds = np.diff(times) / 1e9
        if self._operation == "derivative":
            with np.errstate(divide="ignore", invalid="ignore"):
                slopes = np.where((gaps[1:] == 0) & (seconds > 0), np.diff(values) / seconds, np.nan)
            found = slopes if before < start else np.concatenate([[np.nan] * min(1, len(values)), slopes])
        else:
            areas = (values[1:] + values[:-1]) / 2 * seconds
            areas[(gaps[1:] != 0) | ~np.isfinite(areas)] = 0.0
            found = np.concatenate([[0.0] * min(1, len(values)), np.cumsum(areas)])
        cycles: Integers = samples.cycles(start, stop)
        return Batch(cycles, samples.times(start, stop), samples.gaps(start, stop), [found])
