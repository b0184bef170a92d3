"""When tasks run: TASK-12..TASK-15, TASK-40..TASK-44, TASK-70..TASK-73; tasks EX-01, EX-05, EX-06."""

import pytest
from plc_programs import MS, TASK_FUNCTIONS, build

from tappet.iec.task import Task
from tappet.runtime.local import LocalRuntime

EVENTS = """
PROGRAM OnStatus
VAR n : DINT; END_VAR
n := n + 1;
END_PROGRAM
PROGRAM OnEvent
VAR n : DINT; END_VAR
n := n + 1;
END_PROGRAM
"""


def test_ex_01_status_versus_event() -> None:
    tasks = (
        Task("Status", "status", 0, 1, event="GVL.x", programs=("OnStatus",)),
        Task("Event", "event", 0, 2, event="GVL.x", programs=("OnEvent",)),
    )
    package = build(EVENTS, tasks, gvls={"GVL": "VAR_GLOBAL x : BOOL; END_VAR"})
    starts = []
    with LocalRuntime(package) as runtime:
        for level in (False, True, True, True):
            runtime.write("GVL.x", level)
            runtime.run(time_ns=MS)  # one check of the scheduler
            starts.append((runtime.read("OnStatus.n"), runtime.read("OnEvent.n")))
    assert starts == [(0, 0), (1, 1), (2, 1), (3, 1)]


def test_event_again_after_it_was_low() -> None:
    tasks = (Task("Event", "event", 0, 2, event="GVL.x", programs=("OnEvent",)),)
    with LocalRuntime(build(EVENTS, tasks, gvls={"GVL": "VAR_GLOBAL x : BOOL; END_VAR"})) as runtime:
        for level in (True, False, True, True, False, True):
            runtime.write("GVL.x", level)
            runtime.run(time_ns=MS)
        assert runtime.read("OnEvent.n") == 3


def test_event_at_a_bit_address() -> None:
    tasks = (Task("Event", "event", 0, 2, event="%MX0.3", programs=("OnEvent",)),)
    gvl = {"GVL": "VAR_GLOBAL w AT %MW0 : WORD; END_VAR"}
    with LocalRuntime(build(EVENTS, tasks, gvls=gvl)) as runtime:
        for word in (0x0007, 0x0010, 0x0008, 0x000F):
            runtime.write("GVL.w", word)
            runtime.run(time_ns=MS)
        assert runtime.read("OnEvent.n") == 1


@pytest.mark.parametrize(
    ("order", "expected"), [(("A", "B", "C"), 20), (("C", "A", "B"), 2), (("A", "C", "B"), 11)]
)
def test_ex_05_programs_run_in_list_order(order: tuple[str, ...], expected: int) -> None:
    text = """
    PROGRAM A
    g := 1;
    END_PROGRAM
    PROGRAM B
    g := g + 1;
    END_PROGRAM
    PROGRAM C
    g := g * 10;
    END_PROGRAM
    """
    task = Task("Main", interval_ns=10 * MS, programs=order)
    with LocalRuntime(build(text, (task,), gvls={"GVL": "VAR_GLOBAL g : DINT; END_VAR"})) as runtime:
        runtime.run(cycles=1)
        assert runtime.read("g") == expected


ORDER = """
PROGRAM Fast
log[used] := 1; used := used + 1;
END_PROGRAM
PROGRAM Slow
log[used] := 2; used := used + 1;
END_PROGRAM
PROGRAM Third
log[used] := 3; used := used + 1;
END_PROGRAM
"""
ORDER_LIST = {"GVL": "VAR_GLOBAL log : ARRAY [0..99] OF INT; used : INT; END_VAR"}


def log(runtime: LocalRuntime) -> list[int]:
    entries = runtime.read("GVL.log")
    assert isinstance(entries, list)
    return [int(e) for e in entries[: int(runtime.read("GVL.used"))]]


def test_ex_06_the_bus_task_runs_first() -> None:
    tasks = (
        Task("MainTask", interval_ns=20 * MS, priority=1, programs=("Slow",)),
        Task("EtherCAT_Master", interval_ns=4 * MS, priority=0, programs=("Fast",)),
    )
    with LocalRuntime(build(ORDER, tasks, gvls=ORDER_LIST)) as runtime:
        runtime.run(time_ns=21 * MS)
        assert log(runtime) == [1, 2, 1, 1, 1, 1, 1, 2]


def test_equal_priority_the_one_that_waited_longest() -> None:
    """TASK-42: at 12 ms both 4 ms (due 8) and 5 ms (due 10) tasks wait for the long one."""
    text = TASK_FUNCTIONS + ORDER.replace("log[used] := 3;", "SleepNs(12000000); log[used] := 3;")
    tasks = (
        Task("Long", interval_ns=100 * MS, priority=0, programs=("Third",)),
        Task("Five", interval_ns=5 * MS, priority=3, programs=("Slow",)),
        Task("Four", interval_ns=4 * MS, priority=3, programs=("Fast",)),
    )
    with LocalRuntime(build(text, tasks, gvls=ORDER_LIST)) as runtime:
        runtime.run(time_ns=12 * MS)
        assert log(runtime) == [3]
        runtime.run(time_ns=1 * MS)
        # both wait since 0; they are taken in the order of the configuration, then 10 (5 ms) before 12 (4 ms)
        assert log(runtime)[1:] == [2, 1, 2, 1]


def test_overload_is_not_caught_up_in_a_burst() -> None:
    """TASK-72: of the starts missed during a long cycle one is made up for, the others are dropped."""
    text = (
        TASK_FUNCTIONS
        + """
    PROGRAM PLC_PRG
    VAR n : DINT; first : LINT; END_VAR
    n := n + 1;
    IF n = 1 THEN SleepNs(35000000); END_IF
    END_PROGRAM
    """
    )
    task = Task("Main", interval_ns=10 * MS, programs=("PLC_PRG",))
    with LocalRuntime(build(text, (task,))) as runtime:
        runtime.run(time_ns=36 * MS)
        assert runtime.read("PLC_PRG.n") == 2  # at 0 and, late, at 35 ms for 30 ms
        runtime.run(time_ns=64 * MS)
        assert runtime.read("PLC_PRG.n") == 8  # 40, 50 ... 90
        (statistics,) = runtime.statistics()
        assert (statistics.overruns, statistics.missed) == (1, 2)
        assert statistics.jitter_max_ns == 5 * MS


def test_task_without_program_does_nothing() -> None:
    tasks = (Task("Empty", interval_ns=10 * MS),)
    with LocalRuntime(build(ORDER, tasks, gvls=ORDER_LIST)) as runtime:
        runtime.run(cycles=5)
        assert [(t.name, t.iec_cycles) for t in runtime.statistics()] == [("Empty", 5)]


def test_freewheeling_task_in_virtual_time_has_a_pace() -> None:
    tasks = (Task("Free", "freewheeling", 0, 1, programs=("Fast",)),)
    with LocalRuntime(build(ORDER, tasks, gvls=ORDER_LIST)) as runtime:
        runtime.run(time_ns=20 * MS)
        assert runtime.read("GVL.used") == 20


def test_virtual_time_is_deterministic_and_divisible() -> None:
    tasks = (
        Task("A", interval_ns=7 * MS, priority=1, programs=("Slow",)),
        Task("B", interval_ns=3 * MS, priority=0, programs=("Fast",)),
        Task("C", interval_ns=5 * MS, priority=2, programs=("Third",)),
    )
    package = build(ORDER, tasks, gvls=ORDER_LIST)
    with LocalRuntime(package) as whole, LocalRuntime(package) as parts:
        whole.run(time_ns=60 * MS)
        for step in (1, 2, 30, 7, 20):
            parts.run(time_ns=step * MS)
        assert whole.now_ns == parts.now_ns == 60 * MS
        assert log(whole) == log(parts)


def test_clock_of_the_application_is_virtual() -> None:
    text = "PROGRAM PLC_PRG VAR t : TIME; END_VAR t := TIME(); END_PROGRAM"
    with LocalRuntime(build(text)) as runtime:
        runtime.run(cycles=360_001)
        assert runtime.literal("PLC_PRG.t") == "T#1h"


def test_task_71_equal_due_times_start_in_priority_order() -> None:
    """Whatever the order of the configuration."""
    tasks = (
        Task("Last", interval_ns=20 * MS, priority=9, programs=("Third",)),
        Task("First", interval_ns=20 * MS, priority=0, programs=("Fast",)),
        Task("Middle", interval_ns=10 * MS, priority=4, programs=("Slow",)),
    )
    with LocalRuntime(build(ORDER, tasks, gvls=ORDER_LIST)) as runtime:
        runtime.run(time_ns=41 * MS)
        assert log(runtime) == [1, 2, 3, 2, 1, 2, 3, 2, 1, 2, 3]


def test_task_70_cycles_in_real_time() -> None:
    """The due times keep their distance: a busy host makes starts late or drops them, and all are counted."""
    text = """
    PROGRAM PLC_PRG
    VAR n : DINT; first, last : LTIME; END_VAR
    n := n + 1; last := LTIME();
    IF n = 1 THEN first := last; END_IF
    END_PROGRAM
    """
    with LocalRuntime(build(text), virtual=False) as runtime:
        runtime.run(cycles=100)
        runtime.stop()
        (statistics,) = runtime.statistics()
        assert runtime.read("PLC_PRG.n") == statistics.iec_cycles
        times = [runtime.read(f"PLC_PRG.{name}") for name in ("first", "last")]
        assert isinstance(times[0], int)
        assert isinstance(times[1], int)
        due = (statistics.iec_cycles + statistics.missed - 1) * 10 * MS
        assert abs(times[1] - times[0] - due) <= statistics.jitter_max_ns + 10 * MS
        assert statistics.jitter_min_ns <= statistics.jitter_average_ns <= statistics.jitter_max_ns


def test_all_kinds_of_tasks_in_real_time() -> None:
    text = EVENTS + ORDER.replace("log[used] := 1; used := used + 1;", "x := TRUE;").replace(
        "log[used] := 2; used := used + 1;", "used := used + 1;"
    )
    tasks = (
        Task("Cyclic", interval_ns=5 * MS, priority=1, programs=("Fast",)),
        Task("Free", "freewheeling", 0, 31, programs=("Slow",)),
        Task("Status", "status", 0, 2, event="GVL.x", programs=("OnStatus",)),
        Task("Event", "event", 0, 3, event="GVL.x", programs=("OnEvent",)),
    )
    lists = {"GVL": "VAR_GLOBAL log : ARRAY [0..99] OF INT; used : DINT; x : BOOL; END_VAR"}
    with LocalRuntime(build(text, tasks, gvls=lists), virtual=False) as runtime:
        counts: dict[str, int] = {}
        while not (counts.get("Event") and counts["Status"] > 10 and counts["Free"] > counts["Cyclic"]):
            runtime.run(cycles=1)
            counts = {t.name: t.iec_cycles for t in runtime.statistics()}
        runtime.stop()
        counts = {t.name: t.iec_cycles for t in runtime.statistics()}
        assert counts["Event"] == runtime.read("OnEvent.n") == 1
        assert counts["Status"] == runtime.read("OnStatus.n")
        assert counts["Free"] == runtime.read("GVL.used")


def test_ex_06_in_real_time() -> None:
    """Both tasks run beside each other; without real-time priorities the host decides who starts first, so
    the order of TASK-71 is shown on virtual time."""
    tasks = (
        Task("MainTask", interval_ns=20 * MS, priority=1, programs=("Main",)),
        Task("EtherCAT_Master", interval_ns=20 * MS, priority=0, programs=("Bus",)),
    )
    text = """
    PROGRAM Bus
    VAR n : DINT; END_VAR
    n := n + 1;
    END_PROGRAM
    PROGRAM Main
    VAR n : DINT; END_VAR
    n := n + 1;
    END_PROGRAM
    """
    with LocalRuntime(build(text, tasks), virtual=False) as runtime:
        while int(runtime.read("Main.n")) < 10 or int(runtime.read("Bus.n")) < 10:
            runtime.run(cycles=1)
        runtime.stop()
        counts = {t.name: t.iec_cycles for t in runtime.statistics()}
        assert counts == {"MainTask": runtime.read("Main.n"), "EtherCAT_Master": runtime.read("Bus.n")}
