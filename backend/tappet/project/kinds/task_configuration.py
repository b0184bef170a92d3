"""The task configuration: holds the tasks of an application (TASK-01); functions called at system events."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import Annotated

from pydantic import Field, StrictBool, StrictInt, model_validator

from tappet.iec.system_events import SystemEventName
from tappet.iec.task import SOFT_PLC, Task, TaskPolicy
from tappet.project.data import Data, Line
from tappet.project.model import Project, ProjectObject
from tappet.project.naming import name_key
from tappet.project.object_kind import (
    Codesys,
    Compiled,
    JsonFile,
    Merging,
    Naming,
    ObjectKind,
    Placement,
    Renaming,
)
from tappet.project.source_text import SourceWriter
from tappet.project.task_events import events_around


class SystemEventCall(Data):
    """A function that is called at a system event (TASK-05)."""

    event: SystemEventName = Field(description="What happens.")
    function: Line = Field(
        min_length=1, pattern=r"^[A-Za-z_]\w*$", description="Function or program that is called then."
    )
    description: Line = ""
    active: StrictBool = Field(default=True, description="False: it is not called.")


class TaskGroup(Data):
    """Tasks that share processors."""

    name: Line = Field(min_length=1, pattern=r"^[A-Za-z_]\w*$", description="Unique in the configuration.")
    processors: tuple[Annotated[StrictInt, Field(ge=0, le=SOFT_PLC.processors - 1)], ...] = Field(
        default=(), description="Numbers of the processors of the host, from 0; none: as the runtime does it."
    )
    policy: TaskPolicy = Field(
        default="fifo",
        description="fifo: at real-time priority until a task waits; round_robin: tasks of one priority "
        "take turns; normal: like other programs.",
    )


class TaskConfigurationData(Data):
    """What belongs to no single task."""

    system_events: tuple[SystemEventCall, ...] = ()
    groups: tuple[TaskGroup, ...] = ()

    @model_validator(mode="after")
    def _nothing_twice(self) -> TaskConfigurationData:
        events = [call.event for call in self.system_events]
        twice = next((event for event in events if events.count(event) > 1), None)
        if twice is not None:
            raise ValueError(f"the event {twice} stands there twice; call both functions from one")
        names = [name_key(group.name) for group in self.groups]
        same = next((group.name for group in self.groups if names.count(name_key(group.name)) > 1), None)
        if same is not None:
            raise ValueError(f"there are two task groups named {same}; rename one of them")
        return self


def _around_tasks(
    project: Project, item: ProjectObject, tasks: Sequence[Task], writer: SourceWriter
) -> list[Task]:
    """The tasks with what their group says, and the functions of events that happen in their cycle."""
    data = item.data_as(TaskConfigurationData)
    calls: dict[str, str] = {call.event: call.function for call in data.system_events if call.active}
    groups = {name_key(group.name): group for group in data.groups}
    faults = []
    grouped = []
    for task in tasks:
        group = groups.get(name_key(task.group))
        if group is not None:
            grouped.append(replace(task, processors=group.processors, policy=group.policy))
            continue
        grouped.append(task)
        if task.group:
            faults.append(
                (task, f"Task {task.name}: there is no task group {task.group}; choose another one")
            )
    tasks = events_around(item, calls, grouped, writer)
    if faults:
        writer.keyword("{attribute 'hide'}\nFUNCTION IoConfig_TaskGroups : BOOL")
        for task, fault in faults:
            writer.part(task.object_id or item.id, "declaration", f"{{error '{fault}'}}")
        writer.keyword("END_FUNCTION")
    return tasks


def _function_renamed(data: TaskConfigurationData, renaming: Renaming) -> TaskConfigurationData:
    """The calls of a function under its new name."""
    key = name_key(renaming.old)
    if renaming.kind != "pou" or all(name_key(call.function) != key for call in data.system_events):
        return data
    calls = tuple(
        call.model_copy(update={"function": renaming.new}) if name_key(call.function) == key else call
        for call in data.system_events
    )
    return data.model_copy(update={"system_events": calls})


TASK_CONFIGURATION = ObjectKind(
    name="task_configuration",
    words="task configuration",
    description="Holds the tasks of an application.",
    data=TaskConfigurationData,
    placement=Placement(parents=("application",), in_folders=False, once=True),
    naming=Naming(style="fixed", names=("Task Configuration",)),
    order=140,
    compiled=Compiled(around_tasks=_around_tasks),
    follow=_function_renamed,
    folder=JsonFile(optional=True),
    merging=Merging(),
    codesys=Codesys(type_ids=("ae1de277a2074a289efb456c06bd52f3",)),
)
