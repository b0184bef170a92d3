"""Watchdog rules TASK-30..TASK-35, with cycles of known length on virtual time (tasks EX-02, EX-03)."""

import contextlib

import pytest
from plc_programs import MS, TASK_FUNCTIONS, build, watchdog

from tappet.codegen.faults import Fault
from tappet.iec.task import Task
from tappet.runtime.local import ApplicationException, LocalRuntime
from tappet.runtime.tasks import watchdog_threshold

TEXT = (
    TASK_FUNCTIONS
    + """
PROGRAM PLC_PRG
VAR
    lengths : ARRAY [1..10] OF DINT;   // ms
    cycle : DINT;
    finished : DINT;
END_VAR
cycle := cycle + 1;
IF cycle <= 10 THEN
    SleepNs(DINT_TO_LINT(lengths[cycle]) * 1000000);
END_IF
finished := finished + 1;
END_PROGRAM
"""
)


def run(lengths: list[int], time_ms: int, sensitivity: int) -> int | None:
    """Number of the cycle in which the watchdog ends the task; None when it does not."""
    task = Task("Main", interval_ns=100 * MS, programs=("PLC_PRG",), watchdog=watchdog(time_ms, sensitivity))
    with LocalRuntime(build(TEXT, (task,))) as runtime:
        for number, length in enumerate(lengths, 1):
            runtime.write(f"PLC_PRG.lengths[{number}]", length)
        with contextlib.suppress(ApplicationException):
            runtime.run(cycles=len(lengths))
        report = runtime.exception
        if report is None:
            return None
        assert (report.code, report.pou) == (Fault.WATCHDOG, "PLC_PRG")
        return int(runtime.read("PLC_PRG.cycle"))


@pytest.mark.parametrize(
    ("lengths", "sensitivity", "expected"),
    [
        ([51], 5, 1),
        ([50], 5, None),
        ([11, 11, 11, 11, 11], 5, 4),
        ([11, 11, 11, 8, 11, 11, 11], 5, None),
        ([11], 1, 1),
        ([10], 1, None),
        ([11], 0, 1),
        ([11], 2, 1),
        ([11, 12], 3, 2),
        ([11, 5, 12], 3, None),
        ([31], 3, 1),
    ],
)
def test_ex_02(lengths: list[int], sensitivity: int, expected: int | None) -> None:
    assert run(lengths, 10, sensitivity) == expected


def test_consecutive_overruns_that_end_a_task() -> None:
    assert [watchdog_threshold(n) for n in range(7)] == [1, 1, 1, 2, 3, 4, 5]


def test_single_overrun_ends_the_cycle_at_once() -> None:
    """TASK-35: the rest of the program does not run."""
    task = Task("Main", interval_ns=100 * MS, programs=("PLC_PRG",), watchdog=watchdog(10, 1))
    with LocalRuntime(build(TEXT, (task,))) as runtime:
        runtime.write("PLC_PRG.lengths[1]", 30)
        with pytest.raises(ApplicationException, match="30 ms, its limit is 10 ms"):
            runtime.run(cycles=1)
        assert runtime.read("PLC_PRG.finished") == 0


EX_03 = (
    TASK_FUNCTIONS
    + """
PROGRAM PLC_PRG
VAR
    hIecTask : LWORD;
    off : BOOL;
END_VAR
hIecTask := TaskCurrent();
IF off THEN
    DisableWatchdog(hIecTask);
END_IF
SleepNs(30000000);
IF off THEN
    EnableWatchdog(hIecTask);
END_IF
SleepNs(5000000);
END_PROGRAM
"""
)


def test_ex_03_disabled_section_does_not_count() -> None:
    task = Task("Main", interval_ns=100 * MS, programs=("PLC_PRG",), watchdog=watchdog(10, 1))
    with LocalRuntime(build(EX_03, (task,))) as runtime:
        runtime.write("PLC_PRG.off", True)
        runtime.run(cycles=3)
        runtime.write("PLC_PRG.off", False)
        with pytest.raises(ApplicationException):
            runtime.run(cycles=1)


def test_endless_loop_breaks_the_single_overrun_rule_in_real_time() -> None:
    text = "PROGRAM PLC_PRG VAR n : DINT; END_VAR\nWHILE TRUE DO n := n + 1; END_WHILE\nEND_PROGRAM"
    task = Task("Main", interval_ns=100 * MS, programs=("PLC_PRG",), watchdog=watchdog(20, 2))
    with LocalRuntime(build(text, (task,)), virtual=False) as runtime:
        with pytest.raises(ApplicationException) as caught:
            runtime.run(time_ns=60_000 * MS)
        assert caught.value.report.code == Fault.WATCHDOG
        assert runtime.statistics()[0].iec_cycles == 1
        assert caught.value.report.line == 2
