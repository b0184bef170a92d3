"""String functions of the standard library are reentrant: tasks that interrupt each other may use them.

TASK-08 warns of controllers where they are not.
"""

from __future__ import annotations

import time

from plc_programs import MS, build

from tappet.iec.task import Task
from tappet.runtime.local import LocalRuntime

ROUNDS = 300
"""In each cycle: some hundred microseconds, so that the tasks of one millisecond interrupt and overlap."""
NAMES = ("A", "B", "C", "D")


def _program(name: str) -> str:
    """Takes texts of its own apart and together again; the result is known beforehand."""
    return f"""
PROGRAM {name}
VAR n : DINT; cycles : DINT; wrong : DINT; s : STRING; own : STRING := '{name * 12}'; END_VAR
FOR n := 1 TO {ROUNDS} DO
    s := CONCAT(LEFT(own, 5), INSERT(MID(own, 4, 2), '-', 2));
    s := REPLACE(s, 'xy', 1, 1);
    s := DELETE(CONCAT(s, RIGHT(own, 3)), 1, 2);
    IF s <> 'x{name * 4}{name * 2}-{name * 2}{name * 3}' OR LEN(s) <> 13 OR FIND(s, '-') <> 8 THEN
        wrong := wrong + 1;
    END_IF
END_FOR
cycles := cycles + 1;
END_PROGRAM
"""


def test_string_functions_are_used_by_several_tasks_at_once() -> None:
    """TASK-08."""
    tasks = [
        Task(name, interval_ns=MS, priority=priority, programs=(name,)) for priority, name in enumerate(NAMES)
    ]
    with LocalRuntime(build("".join(map(_program, NAMES)), tasks), virtual=False) as runtime:
        runtime.run(cycles=1)
        due = time.monotonic() + 60
        while min(runtime.read(f"{name}.cycles") for name in NAMES) < 100:
            assert time.monotonic() < due, "a task does not run"
            runtime.run(cycles=20)
        assert [runtime.read(f"{name}.wrong") for name in NAMES] == [0, 0, 0, 0]
