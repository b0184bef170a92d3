"""The new motion project: a virtual axis that PLC_PRG moves to and fro in a task of 4 ms."""

from __future__ import annotations

from tappet.project.edit import add_object, change_data
from tappet.project.kinds.axis import AXIS
from tappet.project.kinds.axis_pool import AXIS_POOL
from tappet.project.kinds.pou import POU
from tappet.project.kinds.task import TASK
from tappet.project.model import Project
from tappet.project.new_project import new_project

AXIS_NAME = "Drive"
_DECLARATION = """PROGRAM PLC_PRG
VAR
    fbPower   : MC_Power;
    fbForward : MC_MoveAbsolute;
    fbBack    : MC_MoveAbsolute;
    xBack     : BOOL; // The axis is on its way back
END_VAR"""
_BODY = f"""// {AXIS_NAME} is an axis of the SoftMotion General Axis Pool. MainTask calls its cycle by itself.
fbPower(Axis := {AXIS_NAME}, Enable := TRUE, bRegulatorOn := TRUE, bDriveStart := TRUE);

fbForward(Axis := {AXIS_NAME}, Execute := fbPower.Status AND NOT xBack, Position := 270,
    Velocity := 90, Acceleration := 180, Deceleration := 180, Direction := MC_DIRECTION.positive);
fbBack(Axis := {AXIS_NAME}, Execute := fbPower.Status AND xBack, Position := 0, Velocity := 90,
    Acceleration := 180, Deceleration := 180, Direction := MC_DIRECTION.negative);

IF fbForward.Done THEN
    xBack := TRUE;
ELSIF fbBack.Done THEN
    xBack := FALSE;
END_IF
"""


def motion_project(name: str, description: str = "") -> Project:
    """A project that runs as it is: log in, and the axis moves."""
    project = new_project(name, description)
    (application,) = project.applications()
    project, pool = add_object(project, application.id, AXIS_POOL.name)
    project, _ = add_object(project, pool.id, AXIS.name, AXIS_NAME, subkind="SM_Drive_Virtual")
    (program,) = project.find_kind(POU.name)
    project = change_data(project, program.id, {"declaration": _DECLARATION, "implementation": _BODY})
    (task,) = project.find_kind(TASK.name)
    return change_data(project, task.id, {**task.data.model_dump(), "interval": "T#4ms"})
