"""Tasks run on the processors of their group, as far as the host has them."""

import os

import pytest
from plc_programs import MS, build

from tappet.codegen.package import TaskSpec
from tappet.iec.task import Task
from tappet.runtime.local import LocalRuntime
from tappet.runtime.online_change import OnlineChangeError, check_change
from tappet.runtime.tasks import bus_task
from tappet.runtime.threads import NORMAL, Scheduling, available_processors

TEXT = "PROGRAM PLC_PRG VAR n : DINT; END_VAR n := n + 1; END_PROGRAM"
REALTIME = Scheduling(True, frozenset((0,)))
NOBODY = 1000
"""A processor that no host of these tests has."""


def package(*processors: int):
    return build(
        TEXT, (Task("Main", interval_ns=MS, programs=("PLC_PRG",), group="G", processors=processors),)
    )


def affinity(runtime: LocalRuntime) -> set[int]:
    application = runtime.plc.application
    assert application is not None
    return os.sched_getaffinity(application.contexts.tasks[0]["threadId"])


@pytest.mark.parametrize("processor", sorted(available_processors())[:2])
def test_the_thread_of_a_task_is_bound_to_the_processors_of_its_group(processor: int) -> None:
    with LocalRuntime(package(processor), virtual=False) as runtime:
        runtime.run(cycles=3)
        assert affinity(runtime) == {processor}


def test_what_the_host_lacks_is_said_in_the_log() -> None:
    there = min(available_processors())
    with LocalRuntime(package(there, NOBODY), virtual=False) as runtime:
        runtime.run(cycles=3)
        assert affinity(runtime) == {there}
        (said,) = [e.message for e in runtime.plc.log.since(0) if e.component == "scheduler"]
        assert f"task Main runs on processor {there}: its task group names processor {NOBODY}" in said
    with LocalRuntime(package(NOBODY), virtual=False) as runtime:
        runtime.run(cycles=3)
        assert affinity(runtime) == available_processors()


def test_policy_decides_about_the_real_time_priority() -> None:
    def options(policy: str, kind: str = "cyclic") -> tuple[int | None, bool]:
        found = REALTIME.options_of(TaskSpec("T", kind, MS, 3, policy=policy))  # type: ignore[arg-type]
        return found.fifo, found.round_robin

    assert options("fifo") == (77, False)
    assert options("round_robin") == (77, True)
    assert options("normal") == (None, False)
    assert options("round_robin", "freewheeling") == (None, False)
    assert NORMAL.options_of(TaskSpec("T", policy="fifo")).fifo is None
    assert REALTIME.options_of(TaskSpec("T")).cpus == {0}
    assert REALTIME.options_of(TaskSpec("T", policy="normal")).cpus is None


def test_another_group_needs_a_download() -> None:
    before = package(0)
    after = build(
        TEXT.replace("+ 1", "+ 2"),
        (Task("Main", interval_ns=MS, programs=("PLC_PRG",), group="H", processors=()),),
        previous=before,
    )
    with pytest.raises(OnlineChangeError, match="task group"):
        check_change(before, after)


def test_the_bus_task_is_the_fastest_cyclic_one() -> None:
    """tasks EX-07, PLC-05: of 4 ms and 20 ms the 4 ms task, whatever the order and the priorities."""
    slow, fast = TaskSpec("Slow", "cyclic", 20 * MS, 0), TaskSpec("Fast", "cyclic", 4 * MS, 9)
    assert bus_task([slow, fast]) == 1
    assert bus_task([fast, slow]) == 0
