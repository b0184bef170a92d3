"""The tasks of an application do not disturb each other.

Source: coding guidelines of PLCopen, CP27 (tasks), rate monotonic priorities; spec tasks.md.

Passes:
    @static
    @task Fast cyclic 1 1 - Main
    @watchdog Fast 10 1
    @task Slow cyclic 100 5 - Other
    @watchdog Slow 1000 1
    @source A
    PROGRAM Main
    END_PROGRAM
    PROGRAM Other
    END_PROGRAM
Fails:
    @static
    @task Fast cyclic 1 5 - Main
    @task Slow cyclic 100 1 - Other
    @task Third freewheeling 0 1 - Last
    @source A
    PROGRAM Main                   (* S1501: no watchdog; S1502: equal priorities *)
    END_PROGRAM
    PROGRAM Other                  (* S1503: the slow task has the higher priority *)
    END_PROGRAM
    PROGRAM Last                   (* S1504: freewheeling *)
    END_PROGRAM
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from tappet.lang.diagnostics import Diagnostic, report
from tappet.lang.source import NOWHERE

if TYPE_CHECKING:
    from tappet.iec.task import Task

CODES = ("S1501", "S1502", "S1503", "S1504", "S1505")
"""S1505 needs to know what the tasks read and write: see `analysis.task_access`."""


def check_tasks(tasks: Sequence[Task], chosen: frozenset[str]) -> list[Diagnostic]:
    """Messages about the configuration of the tasks."""
    found: list[Diagnostic] = []

    def say(code: str, task: Task, **fields: object) -> None:
        if code in chosen:
            found.append(report(code, "", NOWHERE, task=task.name, **fields))

    for number, task in enumerate(tasks):
        if task.watchdog is None:
            say("S1501", task)
        if task.kind == "freewheeling" and len(tasks) > 1:
            say("S1504", task)
        for other in tasks[:number]:
            if other.priority == task.priority:
                say("S1502", task, other=other.name, priority=task.priority)
            if task.kind == other.kind == "cyclic":
                fast, slow = sorted((task, other), key=lambda t: t.interval_ns)
                if fast.interval_ns < slow.interval_ns and fast.priority > slow.priority:
                    say("S1503", slow, other=fast.name)
    return found
