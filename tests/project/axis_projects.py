"""Projects with axes, as a user makes them."""

from __future__ import annotations

from typing import Any

from tappet.project import edit
from tappet.project.model import Project
from tappet.project.new_project import new_project

DECLARATION = """PROGRAM PLC_PRG
VAR
    fbPower : MC_Power;
    fbMove : MC_MoveAbsolute;
END_VAR"""
BODY = """fbPower(Axis := Drive, Enable := TRUE, bRegulatorOn := TRUE, bDriveStart := TRUE);
fbMove(Axis := Drive, Execute := fbPower.Status, Position := 50.0, Velocity := 10.0,
    Acceleration := 100.0, Deceleration := 100.0);"""


def with_axes(*names: str, **data: Any) -> Project:
    """A new project with these virtual axes; `data` is that of the first one."""
    project = new_project("machine")
    (application,) = project.applications()
    project, pool = edit.add_object(project, application.id, "axis_pool")
    for number, name in enumerate(names):
        project, _ = edit.add_object(project, pool.id, "axis", name, data=None if number else data or None)
    return project


def moving(project: Project, body: str = BODY) -> Project:
    """PLC_PRG moves the axis Drive to 50."""
    (program,) = project.find_kind("pou")
    return edit.change_data(project, program.id, {"declaration": DECLARATION, "implementation": body})
