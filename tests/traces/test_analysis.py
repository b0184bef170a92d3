"""Statistics, spectra, derivatives and integrals against closed forms, numpy and scipy."""

from __future__ import annotations

import numpy as np
import pytest
from sampled_batches import CHANNELS, batch
from scipy.signal import get_window

from tappet.traces.analysis import Derived, spectrum, statistics, window_function
from tappet.traces.questions import WindowFunction
from tappet.traces.recording import ChannelInfo
from tappet.traces.samples import Batch, BatchSamples

REAL = [ChannelInfo(0, "v", "LREAL", "f8")]


def _even(values: np.ndarray, step_ns: int = 1_000_000) -> BatchSamples:
    count = len(values)
    cycle = np.arange(count, dtype=np.int64)
    return BatchSamples(REAL, Batch(cycle, cycle * step_ns, np.zeros(count, np.uint8), [values]))


def test_statistics_are_those_of_numpy() -> None:
    whole = batch(600_000, 3)
    samples = BatchSamples(CHANNELS, whole)
    for start, stop in ((0, 600_000), (17, 400_001)):
        found = statistics(samples, 0, start, stop)
        part = whole.values[0][start:stop]
        assert found.count == np.isfinite(part).sum()
        assert found.invalid == np.isnan(part).sum()
        assert (found.minimum, found.maximum) == (np.nanmin(part), np.nanmax(part))
        expected = [np.nanmean(part), np.sqrt(np.nanmean(part**2)), np.nanstd(part)]
        assert [found.mean, found.rms, found.deviation] == pytest.approx(expected, rel=1e-9)
        assert found.minimum_ns == str(whole.time[start + np.nanargmin(part)])
        assert found.maximum_ns == str(whole.time[start + np.nanargmax(part)])


def test_a_small_deviation_of_large_values_is_not_lost() -> None:
    values = 1e9 + np.array([0.0, 1.0] * 1000)
    found = statistics(_even(values), 0, 0, 2000)
    assert found.deviation == pytest.approx(0.5, rel=1e-12)


def test_nothing_has_no_statistics() -> None:
    assert statistics(_even(np.full(5, np.nan)), 0, 0, 5).minimum is None
    assert statistics(_even(np.zeros(5)), 0, 3, 3).count == 0


@pytest.mark.parametrize(
    ("name", "known"),
    [("hann", "hann"), ("hamming", "hamming"), ("blackman", "blackman"), ("flat_top", "flattop")],
)
def test_windows_are_those_of_scipy(name: WindowFunction, known: str) -> None:
    assert window_function(name, 64) == pytest.approx(get_window(known, 64, fftbins=True), abs=1e-8)


@pytest.mark.parametrize("name", ["rectangular", "hann", "hamming", "blackman", "flat_top"])
def test_amplitudes_of_sines_are_right(name: WindowFunction) -> None:
    """1.5 at 50 Hz and 0.25 at 120 Hz on a mean of 3, 1000 samples of 1 ms: bins of 1 Hz."""
    t = np.arange(1000) / 1000
    values = 3 + 1.5 * np.sin(2 * np.pi * 50 * t + 0.3) + 0.25 * np.cos(2 * np.pi * 120 * t)
    found = spectrum(_even(values), 0, 0, 1000, name)
    assert (found.step_hz, found.sample_hz) == pytest.approx((1.0, 1000.0))
    assert [found.amplitudes[n] for n in (0, 50, 120)] == pytest.approx([3.0, 1.5, 0.25], abs=1e-9)
    assert max(found.amplitudes[200:]) < 1e-9


def test_a_long_span_is_averaged_over_pieces(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("tappet.traces.analysis.MOST_SPECTRUM", 1000)
    t = np.arange(5500) / 1000
    found = spectrum(_even(np.sin(2 * np.pi * 50 * t)), 0, 0, 5500, "hann")
    assert (found.pieces, found.samples) == (5, 1000)
    assert found.amplitudes[50] == pytest.approx(1.0, abs=1e-9)


def test_derivative_and_integral_of_a_sine() -> None:
    t = np.arange(2000) / 1000
    samples = _even(np.sin(2 * np.pi * t))
    slope = Derived(samples, 0, "derivative").batch(500, 1000).values[0]
    between = t[500:1000] - 0.0005  # the slope of a chord is that of the curve in its middle
    assert slope == pytest.approx(2 * np.pi * np.cos(2 * np.pi * between), abs=1e-4)
    area = Derived(samples, 0, "integral").batch(0, 2000).values[0]
    assert area == pytest.approx((1 - np.cos(2 * np.pi * t)) / (2 * np.pi), abs=1e-5)


def test_nothing_is_bridged_over_a_gap() -> None:
    time = np.array([0, 1, 2, 12, 13], np.int64) * 1_000_000
    gap = np.array([0, 0, 0, 1, 0], np.uint8)
    samples = BatchSamples(REAL, Batch(time, time, gap, [np.array([1.0, 2, 3, 4, 6])]))
    slope = Derived(samples, 0, "derivative").batch(0, 5).values[0]
    assert np.array_equal(slope, [np.nan, 1000, 1000, np.nan, 2000], equal_nan=True)
    area = Derived(samples, 0, "integral").batch(0, 5).values[0]
    assert area == pytest.approx([0, 0.0015, 0.004, 0.004, 0.009])
