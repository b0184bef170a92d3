"""A task: when it runs and which programs it calls (TASK-10..TASK-35).

The one shape of a task from the project to the code package, which adds where its event variable and code
lie.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal, get_args

from tappet.iec.system_events import EXTERNAL_EVENTS

TaskKind = Literal["cyclic", "freewheeling", "event", "status", "external"]
TaskPolicy = Literal["fifo", "round_robin", "normal"]
"""How the operating system runs the tasks of a group: at real-time priority until they wait, at real-time
priority taking turns with those of the same priority, or like any other program."""


@dataclass(frozen=True, slots=True)
class TaskDescription:
    """What a device permits of tasks, as its description says (TASK-04, TASK-07, TASK-30)."""

    most_tasks: int
    """Of an application."""
    kinds: tuple[TaskKind, ...]
    highest_priority: int
    lowest_priority: int
    external_events: tuple[str, ...]
    """What external tasks can wait for (TASK-16)."""
    most_percent: int
    """Longest time of a cycle that a watchdog permits, in percent of the interval."""
    most_sensitivity: int
    """Of a watchdog."""
    processors: int
    """Numbers of processors that task groups can name, from 0."""


SOFT_PLC = TaskDescription(
    most_tasks=64,
    kinds=get_args(TaskKind),
    highest_priority=0,
    lowest_priority=31,
    external_events=EXTERNAL_EVENTS,
    most_percent=1_000_000,
    most_sensitivity=1_000_000,
    processors=1024,  # what a set of the operating system has room for
)


@dataclass(frozen=True, slots=True)
class Watchdog:
    """An enabled watchdog: fires when `time_ns` is exceeded `sensitivity` times in a row (TASK-31..33)."""

    time_ns: int
    """Longest time of a cycle."""
    sensitivity: int = 1


@dataclass(frozen=True, slots=True)
class Task:
    """One task of an application."""

    name: str
    """Unique in the application."""
    kind: TaskKind = "cyclic"
    interval_ns: int = 10_000_000
    """Period of a cyclic task; says nothing for the other kinds."""
    priority: int = 1
    """As the device permits: 0 (highest) to 31."""
    event: str | None = None
    """Path of the BOOL variable of an event or status task, or the event of an external one."""
    watchdog: Watchdog | None = None
    programs: tuple[str, ...] = ()
    """Programs in calling order."""
    group: str = ""
    """Name of the task group; "" for none."""
    processors: tuple[int, ...] = ()
    """Processors that the tasks of its group may run on; none: as the runtime does by itself."""
    policy: TaskPolicy = "fifo"
    """Of the group."""
    object_id: str | None = None
    """The task object of the project; None for one that stands in where none is configured."""
