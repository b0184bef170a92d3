"""Histograms of execution time and jitter, and the load of tasks and processors."""

import time
from bisect import bisect_right
from collections import Counter

from hypothesis import given, settings
from hypothesis import strategies as st
from plc_programs import MS, TASK_FUNCTIONS, build

from tappet.iec.task import Task
from tappet.runtime.local import LocalRuntime
from tappet.runtime.monitoring import KEPT_SAMPLES, Counters, LoadHistory, load_between, processor_times
from tappet.runtime.tasks import LOG_CLASSES, log_class_edge

INTERVAL = 2_000_000 * MS
"""Long, so that cycles can be late by anything up to it."""
CYCLES = 8
SLEEPER = build(
    TASK_FUNCTIONS
    + f"""
PROGRAM PLC_PRG
VAR lengths : ARRAY [0..{CYCLES - 1}] OF LINT; n : DINT; END_VAR
SleepNs(lengths[n]);
n := n + 1;
END_PROGRAM
""",
    (Task("Main", interval_ns=INTERVAL, programs=("PLC_PRG",)),),
)
BUSY = build(
    "PROGRAM PLC_PRG VAR i : DINT; x : LREAL; END_VAR "
    "FOR i := 1 TO 100000 DO x := x + 1.5; END_FOR END_PROGRAM",
    (Task("Main", interval_ns=MS, programs=("PLC_PRG",)),),
)


def test_edges_of_the_classes_grow_four_to_the_octave() -> None:
    edges = [log_class_edge(number) for number in range(LOG_CLASSES)]
    assert edges[:6] == [0, 160, 192, 224, 256, 320]
    assert all(b == 2 * a for a, b in zip(edges[1:], edges[5:], strict=False))


@settings(max_examples=40, deadline=None)
@given(st.lists(st.one_of(st.integers(1, 5000), st.integers(1, INTERVAL - 1)), min_size=1, max_size=CYCLES))
def test_jitter_is_counted_in_its_class(late: list[int]) -> None:
    """A cycle that sleeps past its due time by so much makes the next one late by it (virtual time)."""
    expected: Counter[int] = Counter()
    edges = [log_class_edge(number) for number in range(LOG_CLASSES)]
    with LocalRuntime(SLEEPER) as runtime:
        now = 0  # of the next start, by a plain model
        for cycle, by in enumerate(late):
            jitter = now - cycle * INTERVAL
            expected[bisect_right(edges, jitter) - 1] += 1
            length = (cycle + 1) * INTERVAL + by - now
            runtime.write(f"PLC_PRG.lengths[{cycle}]", length)
            now += length
        runtime.run(cycles=len(late))
        (found,) = runtime.plc.task_histograms()
        assert {i: n for i, n in enumerate(found.jitters) if n} == dict(expected)
        assert sum(found.durations) == len(late)


def test_the_longest_cycle_is_in_the_highest_class_that_counts() -> None:
    edges = [log_class_edge(number) for number in range(LOG_CLASSES)]
    with LocalRuntime(BUSY) as runtime:
        runtime.run(cycles=50)
        (found,) = runtime.plc.task_histograms()
        (times,) = runtime.statistics()
        counted = [i for i, n in enumerate(found.durations) if n]
        assert sum(found.durations) == times.iec_cycles == 50
        assert counted[0] == bisect_right(edges, times.min_ns) - 1
        assert counted[-1] == bisect_right(edges, times.max_ns) - 1
        runtime.plc.reset_statistics("Main")
        runtime.run(cycles=1)
        assert sum(runtime.plc.task_histograms()[0].durations) == 1


def test_load_of_a_busy_task_is_that_of_its_thread() -> None:
    with LocalRuntime(BUSY, virtual=False) as runtime:
        runtime.plc.sample_load()
        runtime.run(cycles=100)
        runtime.plc.sample_load()
        load = runtime.plc.load_since(0)
        assert load.tasks == ("Main",)
        assert load.processors == tuple(processor_times())
        (sample,) = load.samples
        assert 0 < sample.tasks[0] <= 100
        assert all(0 <= one <= 100 for one in sample.processors)
        assert runtime.plc.load_since(sample.at_ns).samples == ()


def test_load_between_two_readings_is_the_share_of_the_time() -> None:
    before = Counters(1_000, (100, 0), {0: (10, 100), 3: (0, 100)})
    now = Counters(2_000, (350, 0), {0: (85, 200), 3: (100, 200)})
    sample = load_between(before, now)
    assert sample.tasks == (25.0, 0.0)
    assert sample.processors == (75.0, 100.0)


def test_history_is_bounded_and_begins_anew_with_another_application() -> None:
    history = LoadHistory()
    with LocalRuntime(BUSY) as runtime, LocalRuntime(SLEEPER) as other:
        for _ in range(KEPT_SAMPLES + 5):
            history.sample(runtime.plc.application)
        assert len(history.since(0).samples) == KEPT_SAMPLES
        history.sample(other.plc.application)
        assert history.since(0).samples == ()
        history.sample(None)
        assert history.since(time.time_ns()).tasks == ()
