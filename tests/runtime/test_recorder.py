"""Recorders: all values of a frame are of one cycle; rates, rings and lists."""

import pytest
from plc_programs import MS, build

from tappet.iec.task import Task
from tappet.runtime.local import LocalRuntime
from tappet.runtime.recorder import merge_ranges

TEXT = """
PROGRAM PLC_PRG
VAR a, b : LINT; gap : ARRAY [0..9] OF LREAL; c : LINT; i : LINT; END_VAR
a := a + 1;
FOR i := 0 TO 2000 DO gap[i MOD 10] := LINT_TO_LREAL(i); END_FOR
b := b + 1;
c := c + 1;
END_PROGRAM
"""
ALL = ["PLC_PRG.a", "PLC_PRG.b", "PLC_PRG.c"]


def test_every_cycle_of_virtual_time() -> None:
    with LocalRuntime(build(TEXT)) as runtime:
        trace = runtime.trace(ALL)
        runtime.run(cycles=20_000)
        assert [s.values["PLC_PRG.a"] for s in trace.samples] == list(range(1, 20_001))
        assert trace.dropped == 0
        first, second = trace.samples[:2]
        assert (second.cycle - first.cycle, second.timestamp_ns - first.timestamp_ns) == (1, 10 * MS)


def test_divider_and_interval() -> None:
    with LocalRuntime(build(TEXT)) as runtime:
        third = runtime.trace(["PLC_PRG.a"], divider=3)
        slow = runtime.trace(["PLC_PRG.a"], min_interval_ns=45 * MS)
        runtime.run(cycles=20)
        assert [s.values["PLC_PRG.a"] for s in third.samples] == [1, 4, 7, 10, 13, 16, 19]
        assert [s.values["PLC_PRG.a"] for s in slow.samples] == [1, 6, 11, 16]


def test_recording_goes_on_after_a_reset() -> None:
    """The virtual clock begins again, cycle numbers do not."""
    with LocalRuntime(build(TEXT)) as runtime:
        trace = runtime.trace(["PLC_PRG.a"], min_interval_ns=20 * MS)
        runtime.run(cycles=5)
        runtime.reset("cold")
        runtime.start()
        runtime.run(cycles=3)
        assert [s.values["PLC_PRG.a"] for s in trace.samples] == [1, 3, 5, 1, 3]
        assert [s.cycle for s in trace.samples] == [1, 3, 5, 6, 8]


def test_frames_are_of_one_cycle_in_real_time() -> None:
    task = Task("Main", interval_ns=1 * MS, programs=("PLC_PRG",))
    with LocalRuntime(build(TEXT, (task,)), virtual=False) as runtime:
        trace = runtime.trace(ALL)
        while len(trace.samples) <= 50:
            runtime.run(cycles=10)
        assert all(len(set(s.values.values())) == 1 for s in trace.samples)


def test_a_full_ring_drops_the_newest_and_counts() -> None:
    with LocalRuntime(build(TEXT)) as runtime:
        recorder = runtime.plc.record(
            [(runtime.package.symbols.resolve("PLC_PRG.a").offset, 8)], None, 1, 0, 16
        )
        runtime.run(cycles=50)
        frames = recorder.take()
        assert [int.from_bytes(f.data, "little") for f in frames] == list(range(1, 17))
        assert recorder.dropped == 34
        runtime.run(cycles=3)
        assert [int.from_bytes(f.data, "little") for f in recorder.take()] == [51, 52, 53]


def test_frames_wrap_around_the_ring() -> None:
    with LocalRuntime(build(TEXT)) as runtime:
        recorder = runtime.plc.record(
            [(runtime.package.symbols.resolve("PLC_PRG.a").offset, 8)], None, 1, 0, 16
        )
        taken = []
        for cycles in (10, 11, 3, 15):
            runtime.run(cycles=cycles)
            taken += [int.from_bytes(f.data, "little") for f in recorder.take()]
        assert taken == list(range(1, 40))


def test_recorders_come_and_go_while_the_task_runs() -> None:
    task = Task("Main", interval_ns=1 * MS, programs=("PLC_PRG",))
    with LocalRuntime(build(TEXT, (task,)), virtual=False) as runtime:
        for _ in range(50):
            traces = [runtime.trace(ALL) for _ in range(5)]
            while not traces[-1].collect():
                pass
            for trace in traces:
                trace.close()
        runtime.run(cycles=2)


def test_a_task_takes_64_recorders() -> None:
    with LocalRuntime(build(TEXT)) as runtime:
        for _ in range(64):
            runtime.trace(["PLC_PRG.a"])
        with pytest.raises(ValueError, match="at most 64"):
            runtime.trace(["PLC_PRG.a"])


def test_unknown_task_is_named() -> None:
    with LocalRuntime(build(TEXT)) as runtime, pytest.raises(ValueError, match="no task 'Fast'; it has Main"):
        runtime.trace(["PLC_PRG.a"], task="Fast")


def test_neighbours_become_one_copy() -> None:
    assert merge_ranges([(0, 4), (4, 4), (16, 8), (24, 1), (0, 4)]) == [(0, 8), (16, 9), (0, 4)]
