"""Tasks that ran at the same time: which orders a recording leaves, and which of them a replay takes."""

from __future__ import annotations

import time

import msgspec
import pytest
from hypothesis import given
from hypothesis import strategies as st
from plc_programs import MS, build

from tappet.codegen.build import BuildOptions, build_application
from tappet.codegen.package import CodePackage
from tappet.iec.task import Task
from tappet.lang.source import Source
from tappet.runtime.flight_recording import FlightRecording, read_recording, write_recording
from tappet.runtime.flight_tasks import TaskProgress
from tappet.runtime.local import ApplicationException, LocalRuntime
from tappet.runtime.replay import replay
from tappet.runtime.replay_orders import Order, possible_orders

BUS = Task("Bus", interval_ns=10 * MS, priority=3, programs=("Bus",))
OTHER = Task("Other", interval_ns=30 * MS, priority=5, programs=("Other",))
TASKS = (BUS, OTHER)
TEXT = """
VAR_GLOBAL a, b, q : DINT; END_VAR
PROGRAM Bus a := a + 1; q := 100 / ({bus}); END_PROGRAM
PROGRAM Other b := b + 1; q := 100 / ({other}); END_PROGRAM
"""


def _edited(package: CodePackage, text: str, tasks: tuple[Task, ...] = TASKS) -> CodePackage:
    """An online change that moves the variables and does the same."""
    text = text.replace("VAR_GLOBAL", "VAR_GLOBAL first : LREAL;").replace("a := a + 1;", "a := 1 + a;")
    built = build_application([Source("PLC_PRG", text)], tasks, BuildOptions(), previous=package)
    assert built.package is not None, built.diagnostics
    return built.package


def _failed(text: str) -> FlightRecording:
    with LocalRuntime(build(text, TASKS)) as runtime:
        with pytest.raises(ApplicationException):
            runtime.run(100)
        return runtime.plc.flight_recording()


def _blurred(recording: FlightRecording) -> FlightRecording:
    """As if each cycle of the other task had ended while that of the bus cycle task ran that came before."""
    cycles = list(recording.cycles)
    later = [one.tasks[1] for one in cycles[1:]] + [recording.tasks[1].end]
    for number, (one, after) in enumerate(zip(cycles, later, strict=True)):
        before = one.tasks[1]
        if number and after.after > before.after:
            assert after.after == before.after + 2
            met = msgspec.structs.replace(after, before=before.before)
            cycles[number] = msgspec.structs.replace(one, tasks=[one.tasks[0], met])
    return msgspec.structs.replace(recording, cycles=cycles)


@pytest.mark.parametrize(
    ("bus", "other", "task", "cycle"),
    [
        # The other task runs behind the 1st, 4th, 7th and 10th cycle of 10 ms: the 11th sees 4 first.
        ("4 - b", "1", "Bus", 11),
        # Its own 4th cycle sees that 10 have ended.
        ("1", "10 - a", "Other", 4),
        # A fault that leaves no trace in the variables but that of having come.
        ("1", "SEL(a = 10, 100, 0)", "Other", 4),
    ],
)
def test_the_fault_comes_in_its_very_cycle(bus: str, other: str, task: str, cycle: int) -> None:
    text = TEXT.format(bus=bus, other=other)
    if "SEL" in other:
        text = text.replace("b := b + 1;", "")
    recording = _failed(text)
    recorded = recording.exception
    assert recorded is not None
    assert (recorded.task, recorded.cycle) == (task, cycle)
    edited = _edited(recording.code(), text)
    for one in (recording, _blurred(recording)):
        for code in (None, edited):
            played = replay(one, code=code)
            assert played.fault is not None
            assert (played.fault.task, played.fault.cycle) == (task, cycle)
            assert played.difference is None


def test_a_cycle_under_way_for_long_is_run_once() -> None:
    """Each cycle of the bus cycle task meets the same cycle of the other one: none leads to other values."""
    with LocalRuntime(build(TEXT.format(bus="1", other="1"), TASKS)) as runtime:
        runtime.run(30)
        recording = runtime.plc.flight_recording()
    cycles = list(recording.cycles)
    for number in range(5, len(cycles)):
        task = cycles[number].tasks[1]
        # Said of each: the next one is under way, though its values came behind the third.
        under_way = msgspec.structs.replace(task, before=task.before, after=task.after + 1)
        cycles[number] = msgspec.structs.replace(
            cycles[number], tasks=[cycles[number].tasks[0], under_way if number % 3 else task]
        )
    played = replay(msgspec.structs.replace(recording, cycles=cycles), show=["a", "b"])
    assert played.values["a"] == "30"
    assert played.values["b"] == "10"


ran = st.lists(st.integers(0, 3), min_size=3, max_size=3)


@given(st.integers(0, 5), ran, st.booleans(), st.booleans())
def test_the_order_that_was_is_among_the_possible_ones(
    done: int, counts: list[int], under_way: bool, did_already: bool
) -> None:
    """So many cycles of the other task ended before the bus cycle task began, while it ran and were seen,
    while it ran and were not; one more may be under way at the end, and may have done what is seen of it."""
    ahead, seen, unseen = counts
    began = done + ahead
    ended = began + seen + unseen
    before = began + seen + (did_already and under_way and not unseen)
    progress = TaskProgress(2 * began, 2 * ended + under_way, ended, 0, 0)
    bus = TaskProgress(10, 12, 6, 0, 0)
    found = possible_orders([bus, progress], 0, [5, done])
    assert found[0] == Order((6, ended), (6, ended))
    assert Order((6, before), (6, max(before, ended))) in found
    for order in found:
        assert all(one <= other for one, other in zip(order.before, order.behind, strict=True))
        assert began <= order.before[1] <= order.behind[1] <= ended + under_way


@pytest.mark.slow
@pytest.mark.parametrize("interval", [3, 7, 13])
def test_other_code_runs_in_the_order_of_the_recorded_one(interval: int) -> None:
    """Real time, and cycles that take several milliseconds: what does the same fails in the same cycle."""
    text = TEXT.format(bus="20 - b", other="1").replace(
        "b := b + 1;", "FOR i := 1 TO 100000 DO w := SIN(w) + 1.1; END_FOR b := b + 1;"
    )
    text = text.replace("PROGRAM Other", "PROGRAM Other VAR i : DINT; w : LREAL := 1; END_VAR")
    tasks = (
        Task("Bus", interval_ns=5 * MS, priority=3, programs=("Bus",)),
        Task("Other", interval_ns=interval * MS, priority=5, programs=("Other",)),
    )
    package = build(text, tasks)
    with LocalRuntime(package, virtual=False) as runtime:
        due = time.monotonic() + 20
        while runtime.exception is None and time.monotonic() < due:
            time.sleep(0.01)
        recording = read_recording(write_recording(runtime.plc.flight_recording()))
    faults = [replay(recording, code=code).fault for code in (None, _edited(package, text, tasks))]
    same, other = [None if one is None else (one.task, one.cycle) for one in faults]
    assert same == other
