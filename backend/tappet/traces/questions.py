"""What may be asked of samples, and how much at once; nothing here loads what computes the answers."""

from __future__ import annotations

from typing import Literal

MOST_POINTS = 20_000
"""Width of a window."""
MOST_SAMPLES = 1_000_000
"""In one answer of raw samples, and of what is computed of a span as a whole."""
WindowFunction = Literal["rectangular", "hann", "hamming", "blackman", "flat_top"]
Operation = Literal["derivative", "integral"]
