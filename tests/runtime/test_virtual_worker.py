"""Virtual time runs on one thread of its own, from the first cycle to the end of the application."""

from __future__ import annotations

import os
import signal
from types import FrameType

import pytest
from plc_programs import build

from tappet.runtime.local import LocalRuntime

TEXT = """PROGRAM PLC_PRG
VAR
    n : DINT;
    endless : BOOL;
END_VAR
n := n + 1;
WHILE endless DO
    n := n + 0;
END_WHILE
END_PROGRAM
"""


def threads() -> set[int]:
    """Of this process."""
    return {int(number) for number in os.listdir("/proc/self/task")}


def test_all_cycles_run_on_one_thread_that_ends_with_the_application() -> None:
    before = threads()
    with LocalRuntime(build(TEXT)) as runtime:
        application = runtime.plc.application
        assert application is not None
        task = application.contexts.tasks[0]
        used = set()
        for _ in range(20):
            runtime.run(cycles=1)
            used.add(task["threadId"])
        runtime.reset("warm")
        runtime.start()
        runtime.run(cycles=1)
        used.add(task["threadId"])
        (worker,) = used
        assert worker in threads() - before
        assert runtime.read("PLC_PRG.n") == 1
    assert worker not in threads()


class Interrupted(Exception):  # noqa: N818 - it is none
    pass


def test_an_interrupt_ends_the_cycle_and_the_next_run_has_the_thread_again() -> None:
    def interrupt(number: int, frame: FrameType | None) -> None:
        raise Interrupted

    known = signal.signal(signal.SIGALRM, interrupt)
    try:
        with LocalRuntime(build(TEXT)) as runtime:
            runtime.run(cycles=3)
            runtime.write("PLC_PRG.endless", True)
            signal.setitimer(signal.ITIMER_REAL, 0.05)
            with pytest.raises(Interrupted):
                runtime.run(cycles=1)
            assert runtime.read("PLC_PRG.n") == 4
            runtime.write("PLC_PRG.endless", False)
            runtime.run(cycles=5)  # the clock stood at the interrupted one, the first of the five
            assert runtime.read("PLC_PRG.n") == 8
    finally:
        signal.signal(signal.SIGALRM, known)
