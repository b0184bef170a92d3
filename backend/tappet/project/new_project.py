"""The new project: one soft PLC, PLC_PRG and the cyclic MainTask that calls it (POU-07)."""

from __future__ import annotations

from tappet.project.edit import add_object, move_object
from tappet.project.kinds.device import DEVICE
from tappet.project.kinds.pou import POU
from tappet.project.kinds.task import TASK, ProgramCall, TaskData
from tappet.project.kinds.task_configuration import TASK_CONFIGURATION
from tappet.project.model import Project

DEFAULT_DEVICE = "Tappet Soft PLC"
"""Name of the device of a new project."""


def new_project(name: str, description: str = "") -> Project:
    """A project with one soft PLC, PLC_PRG and the cyclic MainTask that calls it."""
    project, _ = add_object(Project(name, description), None, DEVICE.name, DEFAULT_DEVICE)
    (application,) = project.applications()
    project, program = add_object(project, application.id, POU.name)
    (tasks,) = project.find_kind(TASK_CONFIGURATION.name)
    calls = TaskData(pous=(ProgramCall(name=program.name),))
    project, _ = add_object(project, tasks.id, TASK.name, "MainTask", data=calls)
    return move_object(project, program.id, application.id, tasks.index)
