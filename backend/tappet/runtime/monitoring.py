"""Task monitoring of a loaded application, and how busy its tasks and the processors were of late."""

from __future__ import annotations

import os
import threading
import time
from collections import deque
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from tappet.runtime.tasks import EVENT_DRIVEN, TaskHistogram, TaskStatistics, read_histogram, read_statistics

if TYPE_CHECKING:
    from tappet.runtime.application import LoadedApplication

KEPT_SAMPLES = 600
"""Seconds of load that are kept."""
_PROCESSOR_TIMES = Path("/proc/stat")
_PER_THREAD, _SCHEDULED = 4, 2
"""Bits of a clock id: time that one thread has run, to the nanosecond (CPUCLOCK of the kernel)."""


def statistics(application: LoadedApplication) -> list[TaskStatistics]:
    """Task monitoring (TASK-50 .. TASK-59)."""
    contexts = application.contexts
    faulted = contexts.faulted_task()
    halted = application.variant.halted() if application.variant is not None else []
    rows = []
    for i, (spec, task) in enumerate(zip(application.package.tasks, contexts.tasks, strict=True)):
        status = "valid" if task["started"] else "created"
        if spec.kind in EVENT_DRIVEN and not task["started"]:
            status = "not created"
        if i in halted:
            status = "halted"
        if faulted == i:
            status = "exception"
        rows.append(read_statistics(spec, contexts.statistics(task), status))
    return rows


def histograms(application: LoadedApplication) -> list[TaskHistogram]:
    """Execution times and jitters of each task in classes."""
    contexts = application.contexts
    return [
        read_histogram(spec, contexts.statistics(task))
        for spec, task in zip(application.package.tasks, contexts.tasks, strict=True)
    ]


def reset_statistics(application: LoadedApplication, task: int) -> None:
    """Values of the task back to 0 at its next cycle (TASK-59)."""
    cell = application.contexts.tasks[task].place("resetStatistics")
    application.executive.store_flag(cell, 1)


@dataclass(frozen=True, slots=True)
class LoadSample:
    """How busy tasks and processors were in one interval, in percent of a processor."""

    at_ns: int
    """Unix time of its end."""
    tasks: tuple[float, ...]
    processors: tuple[float, ...]


@dataclass(frozen=True, slots=True)
class Load:
    """The samples of the last minutes, oldest first."""

    tasks: tuple[str, ...]
    processors: tuple[int, ...]
    samples: tuple[LoadSample, ...]


@dataclass(frozen=True, slots=True)
class Counters:
    """Times that only grow, in ns: of each task's thread, and (busy, all) of each processor."""

    at_ns: int
    tasks: tuple[int, ...]
    processors: dict[int, tuple[int, int]]


class LoadHistory:
    """Load by task and by processor, sampled from outside once a second: the tasks do nothing for it."""

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._samples: deque[LoadSample] = deque(maxlen=KEPT_SAMPLES)
        self._names: tuple[str, ...] = ()
        self._processors: tuple[int, ...] = ()
        self._owner: object = None
        self._last: Counters | None = None

    def sample(self, application: LoadedApplication | None) -> None:
        """Take a sample; the history begins anew with another application."""
        with self._lock:
            names = () if application is None else tuple(t.name for t in application.package.tasks)
            now = Counters(
                time.clock_gettime_ns(time.CLOCK_MONOTONIC),
                () if application is None else _task_times(application),
                processor_times(),
            )
            processors = tuple(now.processors)
            if application is not self._owner or names != self._names or processors != self._processors:
                self._owner, self._names, self._processors = application, names, processors
                self._samples.clear()
            elif self._last is not None and now.at_ns > self._last.at_ns:
                self._samples.append(load_between(self._last, now))
            self._last = now

    def since(self, at_ns: int) -> Load:
        """The samples that ended after a unix time."""
        with self._lock:
            return Load(self._names, self._processors, tuple(s for s in self._samples if s.at_ns > at_ns))


def load_between(before: Counters, now: Counters) -> LoadSample:
    """The share of the time between two readings."""
    elapsed = now.at_ns - before.at_ns
    tasks = (_percent(b - a, elapsed) for a, b in zip(before.tasks, now.tasks, strict=True))
    processors = (
        _percent(busy - before.processors[number][0], whole - before.processors[number][1])
        for number, (busy, whole) in now.processors.items()
    )
    return LoadSample(time.time_ns(), tuple(tasks), tuple(processors))


def _percent(part: int, whole: int) -> float:
    return round(min(100.0, max(0.0, 100.0 * part / whole)), 2) if whole > 0 else 0.0


def _task_times(application: LoadedApplication) -> tuple[int, ...]:
    """Processor time of each task's thread in ns; 0 where it has none (virtual time), or not yet."""
    if application.virtual:
        return (0,) * len(application.contexts.tasks)
    return tuple(_thread_time(task["threadId"]) for task in application.contexts.tasks)


def _thread_time(thread_id: int) -> int:
    if thread_id <= 0:
        return 0
    try:
        return time.clock_gettime_ns((~thread_id << 3) | _PER_THREAD | _SCHEDULED)
    except OSError:  # it has ended
        return 0


def processor_times() -> dict[int, tuple[int, int]]:
    """(busy, all) time in ns of each processor this process may use; nothing where the host tells none."""
    try:
        lines = _PROCESSOR_TIMES.read_text(encoding="ascii").splitlines()
    except OSError:
        return {}
    tick_ns = 1_000_000_000 // os.sysconf("SC_CLK_TCK")
    usable = os.sched_getaffinity(0)
    found = {}
    for line in lines:
        name, *fields = line.split()
        if not name.startswith("cpu") or not name[3:].isdecimal() or int(name[3:]) not in usable:
            continue
        # user nice system idle iowait irq softirq steal; time of guests is in user already
        times = [int(field) * tick_ns for field in fields[:8]]
        whole = sum(times)
        found[int(name[3:])] = (whole - times[3] - times[4], whole)
    return found
