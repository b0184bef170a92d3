"""A task: when it runs and which programs it calls (TASK-10..TASK-33)."""

from __future__ import annotations

from pydantic import Field, StrictBool, StrictInt, model_validator

from tappet.iec.task import SOFT_PLC, Task, TaskKind, Watchdog
from tappet.project.data import Data, Duration, Line
from tappet.project.durations import duration_ns
from tappet.project.model import ProjectObject
from tappet.project.naming import name_key
from tappet.project.object_kind import (
    Codesys,
    Compiled,
    Naming,
    ObjectKind,
    Placement,
    Plcopen,
    Renaming,
    TwinCat,
)


class ProgramCall(Data):
    """A program that a task calls, in the order of the list (TASK-20, TASK-21)."""

    name: Line = Field(min_length=1, description="Name of the program, e.g. PLC_PRG.")
    comment: Line = ""


class WatchdogData(Data):
    """Watchdog of a task (TASK-30..33)."""

    enabled: StrictBool = False
    time: Duration = Field(default="T#100ms", description="Longest allowed duration of a cycle.")
    percent: StrictInt | None = Field(
        default=None,
        ge=1,
        le=SOFT_PLC.most_percent,
        description="Percent of the interval instead of the time; cyclic tasks.",
    )
    sensitivity: StrictInt = Field(
        default=1, ge=0, le=SOFT_PLC.most_sensitivity, description="Number of overruns that are one too many."
    )


class TaskData(Data):
    """A task: when it runs and what it calls (tasks.md, section 2)."""

    priority: StrictInt = Field(
        default=1,
        ge=SOFT_PLC.highest_priority,
        le=SOFT_PLC.lowest_priority,
        description="0 is the highest, 31 the lowest (TASK-11).",
    )
    type: TaskKind = "cyclic"
    interval: Duration = Field(
        default="T#20ms", description="TIME literal or microseconds; cyclic tasks (TASK-12)."
    )
    event: Line = Field(default="", description="Path of the BOOL variable, or the system event (TASK-18).")
    watchdog: WatchdogData = WatchdogData()
    group: Line = Field(default="", description="Task group of the task configuration; empty for none.")
    pous: tuple[ProgramCall, ...] = ()

    @model_validator(mode="after")
    def _cyclic_needs_interval(self) -> TaskData:
        if self.type == "cyclic" and duration_ns(self.interval) == 0:
            raise ValueError("a cyclic task needs an interval longer than 0, such as T#20ms")
        return self


def _task(task: ProjectObject) -> Task:
    """The task as the build takes it."""
    data = task.data_as(TaskData)
    watchdog = None
    if data.watchdog.enabled:
        percent = data.watchdog.percent if data.type == "cyclic" else None
        longest = duration_ns(data.watchdog.time if percent is None else data.interval)
        watchdog = Watchdog(longest * (percent or 100) // 100, data.watchdog.sensitivity)
    return Task(
        name=task.name,
        kind=data.type,
        interval_ns=duration_ns(data.interval) if data.type == "cyclic" else 0,
        priority=data.priority,
        event=data.event or None if data.type in ("event", "status", "external") else None,
        watchdog=watchdog,
        programs=tuple(call.name for call in data.pous),
        group=data.group,
        object_id=task.id,
    )


def _calls_renamed(data: TaskData, renaming: Renaming) -> TaskData:
    """The calls of a program under its new name."""
    key = name_key(renaming.old)
    if renaming.kind != "pou" or all(name_key(call.name) != key for call in data.pous):
        return data
    calls = tuple(
        call.model_copy(update={"name": renaming.new}) if name_key(call.name) == key else call
        for call in data.pous
    )
    return data.model_copy(update={"pous": calls})


TASK = ObjectKind(
    name="task",
    words="task",
    description="A task.",
    data=TaskData,
    placement=Placement(parents=("task_configuration",), in_folders=False),
    naming=Naming(proposal="Task", from_imports="adapted"),
    order=150,
    compiled=Compiled(task=_task),
    follow=_calls_renamed,
    reported=True,
    plcopen=Plcopen(),
    twincat=TwinCat(tag="Task", read=lambda element, draft: element.task(draft)),
    codesys=Codesys(
        type_ids=("98a2708a9b184f3182eda1465b24fa2d",),
        read=lambda reader, entry, draft: reader.task(entry, draft),
    ),
)
