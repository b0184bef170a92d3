"""Tasks as the runtime knows them: which one moves I/O, which one owns a variable, and their statistics."""

from __future__ import annotations

import struct
from bisect import bisect_right
from dataclasses import dataclass

from tappet.codegen.package import CodePackage, TaskSpec
from tappet.runtime.executive.records import Record
from tappet.runtime.posix import read_memory

KINDS = {"cyclic": 0, "freewheeling": 1, "event": 2, "status": 3, "external": 4}
"""TASK_KIND of types.st."""
EVENT_DRIVEN = ("event", "status", "external")
"""Kinds that the scheduler starts."""
LATENESS_STEP_NS = 2048
"""Width of a class of the lateness histogram."""


LOG_CLASSES = 128
"""Classes of the histograms of execution time and jitter, LogClass of statistics.st."""
_FIRST_CLASS_NS = 128


def watchdog_threshold(sensitivity: int) -> int:
    """Consecutive overruns that end a task: 1 for sensitivity 0, 1, 2; n - 1 above (TASK-33)."""
    return max(1, sensitivity - 1)


def bus_task(tasks: list[TaskSpec]) -> int | None:
    """Index of the bus cycle task: the cyclic task with the shortest interval (PLC-05), else a freewheeling
    one.
    """
    cyclic = [(t.interval_ns, t.priority, i) for i, t in enumerate(tasks) if t.kind == "cyclic"]
    if cyclic:
        return min(cyclic)[2]
    for wanted in ("freewheeling", "status", "event", "external"):
        for i, task in enumerate(tasks):
            if task.kind == wanted:
                return i
    return None


class TaskOwnership:
    """Which task runs the program a variable belongs to; global variables belong to the bus cycle task."""

    def __init__(self, package: CodePackage) -> None:
        self.bus = bus_task(package.tasks)
        self._kinds = [t.kind for t in package.tasks]
        self._names = [t.name for t in package.tasks]
        owner: dict[str, int] = {}
        for i, task in enumerate(package.tasks):
            for program in task.programs:
                owner.setdefault(program.rpartition(".")[2].upper(), i)
        rows = []
        for symbol, data in package.data_objects.items():
            name = symbol.removeprefix("tappet.data.").upper()
            if name in owner and data.size:
                rows.append((data.offset, data.offset + data.size, owner[name]))
        self._rows = sorted(rows)
        self._starts = [row[0] for row in self._rows]

    def of(self, offset: int) -> int | None:
        """Task that owns the byte at `offset`; None when the application has no task."""
        at = bisect_right(self._starts, offset) - 1
        if at >= 0 and offset < self._rows[at][1]:
            return self._rows[at][2]
        return self.bus

    def number(self, name: str | None) -> int:
        """Index of a task; the bus cycle task for None. ValueError when there is none."""
        if name is None:
            if self.bus is None:
                raise ValueError("the application has no task that could sample values")
            return self.bus
        for i, known in enumerate(self._names):
            if known.upper() == name.upper():
                return i
        raise ValueError(f"the application has no task '{name}'; it has {', '.join(self._names) or 'none'}")

    def regular(self, offset: int) -> int | None:
        """Like `of`, but never a task that may not run for long; None when there are only such tasks."""
        for task in (self.of(offset), self.bus):
            if task is not None and self._kinds[task] in ("cyclic", "freewheeling"):
                return task
        return None


@dataclass(frozen=True, slots=True)
class TaskStatistics:
    """Task monitoring (TASK-50 .. TASK-59); durations in ns."""

    name: str
    kind: str
    priority: int
    interval_ns: int
    status: str
    """not created, created, valid or exception (TASK-51); halted while it stands at a statement."""
    iec_cycles: int
    cycles: int
    last_ns: int
    average_ns: int
    min_ns: int
    max_ns: int
    jitter_ns: int
    jitter_min_ns: int
    jitter_max_ns: int
    jitter_average_ns: int
    overruns: int
    """Cycles that were still running when the next one was due."""
    missed: int
    """Starts dropped because of that (TASK-72)."""
    jitter_p999_ns: int
    """99.9 % of the starts were not later than this, in steps of 2048 ns; 1,048,576 means more."""


def read_statistics(spec: TaskSpec, statistics: Record, status: str) -> TaskStatistics:
    """Statistics out of a task context; single numbers are exact, the set may straddle a cycle."""
    raw = read_memory(statistics.place("lateness"), statistics.size_of("lateness"))
    iec = statistics["iecCycles"]
    return TaskStatistics(
        name=spec.name,
        kind=spec.kind,
        priority=spec.priority,
        interval_ns=spec.interval_ns,
        status=status,
        iec_cycles=iec,
        cycles=statistics["cycles"],
        last_ns=statistics["execLast"],
        average_ns=statistics["execSum"] // max(iec, 1),
        min_ns=statistics["execMin"],
        max_ns=statistics["execMax"],
        jitter_ns=statistics["jitterLast"],
        jitter_min_ns=statistics["jitterMin"],
        jitter_max_ns=statistics["jitterMax"],
        jitter_average_ns=statistics["jitterSum"] // max(iec, 1),
        overruns=statistics["overruns"],
        missed=statistics["missed"],
        jitter_p999_ns=quantile(struct.unpack(f"<{len(raw) // 4}I", raw), 0.999),
    )


def quantile(classes: tuple[int, ...], share: float) -> int:
    """Upper edge, in ns, of the histogram class below which `share` of all starts lie; 0 without starts."""
    total = sum(classes)
    if not total:
        return 0
    wanted = total * share
    seen = 0
    for i, count in enumerate(classes):
        seen += count
        if seen >= wanted:
            return (i + 1) * LATENESS_STEP_NS
    return len(classes) * LATENESS_STEP_NS


def log_class_edge(number: int) -> int:
    """Lower edge, in ns, of a class of the histograms: four to the octave; the first one begins at 0."""
    return 0 if number == 0 else _FIRST_CLASS_NS * (4 + number % 4) * 2 ** (number // 4) // 4


@dataclass(frozen=True, slots=True)
class TaskHistogram:
    """How often the cycles of a task took how long, and how late they began, since the last reset."""

    name: str
    durations: tuple[int, ...]
    jitters: tuple[int, ...]


def read_histogram(spec: TaskSpec, statistics: Record) -> TaskHistogram:
    """Both histograms out of a task context."""

    def classes(member: str) -> tuple[int, ...]:
        return struct.unpack(f"<{LOG_CLASSES}I", read_memory(statistics.place(member), 4 * LOG_CLASSES))

    return TaskHistogram(spec.name, classes("durations"), classes("jitters"))
