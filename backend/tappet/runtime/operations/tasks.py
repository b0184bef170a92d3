"""Task monitoring."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated, ClassVar

from msgspec import Meta, Struct

from tappet.runtime.monitoring import Load
from tappet.runtime.operations.declaration import Fact, Operation, OperationError, Rest, Text
from tappet.runtime.operations.instants import Instant, instant_of
from tappet.runtime.tasks import LOG_CLASSES, TaskHistogram, TaskStatistics, log_class_edge

if TYPE_CHECKING:
    from tappet.runtime.plc import SoftPlc


class TaskState(Struct, frozen=True):
    """Statistics of one task since its start or the last reset of them; times in µs (TASK-50 .. TASK-59)."""

    name: str
    kind: str
    priority: int
    status: str
    interval_us: float
    iec_cycles: Annotated[int, Meta(description="Cycles that ran the programs.")]
    cycles: Annotated[int, Meta(description="Cycles altogether, those of a stopped application too.")]
    last_us: float
    average_us: float
    min_us: float
    max_us: float
    jitter_us: Annotated[float, Meta(description="Lateness of the last start.")]
    min_jitter_us: float
    max_jitter_us: float
    average_jitter_us: float
    p999_jitter_us: Annotated[float, Meta(description="99.9 % of the starts were not later than this.")]
    overruns: Annotated[int, Meta(description="Cycles that were still running when the next was due.")]
    missed: Annotated[int, Meta(description="Starts dropped because of that.")]


def _us(ns: int) -> float:
    return round(ns / 1000, 3)


def in_us(tasks: list[TaskStatistics]) -> list[TaskState]:
    """Statistics as people read them."""
    return [
        TaskState(
            t.name, t.kind, t.priority, t.status, _us(t.interval_ns), t.iec_cycles, t.cycles,
            _us(t.last_ns), _us(t.average_ns), _us(t.min_ns), _us(t.max_ns), _us(t.jitter_ns),
            _us(t.jitter_min_ns), _us(t.jitter_max_ns), _us(t.jitter_average_ns), _us(t.jitter_p999_ns),
            t.overruns, t.missed,
        )
        for t in tasks
    ]  # fmt: skip


class ListTasks(Operation[list[TaskStatistics]], frozen=True):
    """Statistics of all tasks."""

    op: ClassVar[str] = "tasks"
    rest: ClassVar[Rest | None] = Rest("GET", "/tasks", "viewer", None, in_us)

    def run(self, plc: SoftPlc) -> list[TaskStatistics]:
        """As of now."""
        return plc.tasks()


class ResetStatistics(Operation[None], frozen=True):
    """Reset the statistics of a task, of all tasks without a name."""

    op: ClassVar[str] = "reset_statistics"
    rest: ClassVar[Rest | None] = Rest(
        "POST", "/tasks/{task}/reset", "operator", lambda order: Fact("statistics-reset", order.task or "")
    )
    task: Text | None = None

    def run(self, plc: SoftPlc) -> None:
        """Counts from the next cycle on."""
        names = [task.name for task in plc.tasks()]
        if self.task is not None and self.task not in names:
            raise OperationError("not_found", f"there is no task '{self.task}'; there are {', '.join(names)}")
        plc.reset_statistics(self.task)


class HistogramClass(Struct, frozen=True):
    """One class of the histograms of a task."""

    from_us: Annotated[float, Meta(description="Lower edge; the upper one is that of the next class.")]
    cycles: Annotated[int, Meta(description="Cycles whose programs took so long.")]
    starts: Annotated[int, Meta(description="Starts that were so late.")]


class TaskTimes(Struct, frozen=True):
    """How long the cycles of a task took and how late they began, since the last reset.

    Four classes to the octave from 0.128 µs on; the last one holds everything above.
    """

    name: str
    classes: list[HistogramClass]


def _times(tasks: list[TaskHistogram]) -> list[TaskTimes]:
    edges = [_us(log_class_edge(number)) for number in range(LOG_CLASSES)]
    return [
        TaskTimes(t.name, [HistogramClass(*row) for row in zip(edges, t.durations, t.jitters, strict=True)])
        for t in tasks
    ]


class ListHistograms(Operation[list[TaskHistogram]], frozen=True):
    """Histograms of execution time and jitter of all tasks."""

    op: ClassVar[str] = "task_histograms"
    rest: ClassVar[Rest | None] = Rest("GET", "/tasks/histograms", "viewer", None, _times)

    def run(self, plc: SoftPlc) -> list[TaskHistogram]:
        """As of now."""
        return plc.task_histograms()


class LoadMoment(Struct, frozen=True):
    """Load during the second before a moment, in percent of one processor."""

    at: Instant
    tasks: Annotated[list[float], Meta(description="In the order of the names.")]
    processors: Annotated[list[float], Meta(description="Load by all programs of the host.")]


class LoadOfTasks(Struct, frozen=True):
    """How busy tasks and processors were in the last ten minutes, a sample a second, oldest first."""

    tasks: list[str]
    processors: Annotated[list[int], Meta(description="Numbers of the processors.")]
    samples: list[LoadMoment]


def _load(load: Load) -> LoadOfTasks:
    moments = [LoadMoment(instant_of(s.at_ns), list(s.tasks), list(s.processors)) for s in load.samples]
    return LoadOfTasks(list(load.tasks), list(load.processors), moments)


class ReadLoad(Operation[Load], frozen=True):
    """Load of each task and of each processor."""

    op: ClassVar[str] = "task_load"
    rest: ClassVar[Rest | None] = Rest("GET", "/tasks/load", "viewer", None, _load)
    after_ms: Annotated[
        int, Meta(ge=0, le=1 << 50, description="Only samples after this unix time in ms.")
    ] = 0

    def run(self, plc: SoftPlc) -> Load:
        """As noted until now."""
        return plc.load_since(self.after_ms * 1_000_000)
