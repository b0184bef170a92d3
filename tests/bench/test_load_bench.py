"""The load benchmark serves its browsers, and their number costs the runtime nothing."""

from __future__ import annotations

import asyncio
import json

from hypothesis import given
from hypothesis import strategies as st

from tappet.bench.load import TRACED, VALUES, Size, outcome, percentile_us, report
from tappet.runtime.tasks import LOG_CLASSES, log_class_edge

FRAME = 24 + 8 * VALUES
"""Head and values."""


def test_browsers_see_values_and_no_sample_is_lost() -> None:
    size = Size(browsers=5, processes=2, seconds=2.0)
    found = asyncio.run(outcome(size))
    assert found.seen.least > 0
    assert found.seen.wire_bytes == found.seen.frames * FRAME
    assert found.traced.samples > 100
    assert (found.traced.lost, found.traced.gaps) == (0, 0)
    assert found.past > 100
    shown = json.loads(report(found, size).json())
    assert [row["unit"] for row in shown["rows"]] == ["us"] * 4 + ["%"] * 2
    assert f"{TRACED} variables" in report(found, size).text()


@given(st.lists(st.integers(0, 50), min_size=LOG_CLASSES, max_size=LOG_CLASSES), st.floats(0.01, 1.0))
def test_a_percentile_is_that_of_the_entries(classes: list[int], part: float) -> None:
    entries = [number for number, count in enumerate(classes) for _ in range(count)]
    if not entries:
        return
    edge = percentile_us(classes, part)
    below = sum(1 for number in entries if log_class_edge(number + 1) / 1000.0 <= edge)
    before = sum(1 for number in entries if log_class_edge(number + 1) / 1000.0 < edge)
    assert before < part * len(entries) <= below
