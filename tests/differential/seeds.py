"""How many random programs a test runs: a few with every run of the tests, the others with the slow ones."""

from __future__ import annotations

import pytest


def seeds(quick: int, slow: range) -> pytest.MarkDecorator:
    """Calls a test with a `seed` of its programs and a `level` of optimisation, 0 or 2 in turns."""
    cases = [pytest.param(seed, 2 * (seed % 2)) for seed in range(quick)]
    cases += [pytest.param(seed, 2 * (seed % 2), marks=pytest.mark.slow) for seed in slow]
    return pytest.mark.parametrize(("seed", "level"), cases)
