"""A task: when it runs and which programs it calls (TASK-10..TASK-35).

The one shape of a task from the project to the code package, which adds where its event variable and code
lie.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

TaskKind = Literal["cyclic", "freewheeling", "event", "status", "external"]


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
    """0 (highest) to 31."""
    event: str | None = None
    """Path of the BOOL variable of an event or status task, or the event of an external one."""
    watchdog: Watchdog | None = None
    programs: tuple[str, ...] = ()
    """Programs in calling order."""
    object_id: str | None = None
    """The task object of the project; None for one that stands in where none is configured."""
