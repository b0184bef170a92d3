"""The global variable that an axis group is, with the values of the editor (AG-01)."""

from __future__ import annotations

from tappet.project.axes.literals import real
from tappet.project.axis_groups import kinematics
from tappet.project.axis_groups.settings import AxisGroupSettings, CoordinateFrame, PathDynamics

LIBRARY = "SM3_AxisGroup"
"""The library of all axis groups."""
VARIABLES = "IoConfig_Group_{name}"
"""The list of global variables that a group is in."""


def declaration(name: str, settings: AxisGroupSettings) -> str:
    """The variable of a group, ready for VAR_GLOBAL."""
    members = {
        "stPathLimits": dynamics(settings.limits),
        "stDefaults": dynamics(settings.defaults),
        "stJogging": dynamics(settings.jogging),
    }
    values = ",\n".join(f"        {member} := {value}" for member, value in members.items())
    text = f"    {name} : {LIBRARY}.AXIS_GROUP_REF_SM3 := (\n{values});"
    if settings.kinematics.type:
        text += "\n" + kinematics.declaration(name, settings.kinematics)
    return text


def dynamics(of: PathDynamics) -> str:
    """As GroupDynamics."""
    return (
        f"(fVelocity := {real(of.velocity)}, fAcceleration := {real(of.acceleration)}, "
        f"fDeceleration := {real(of.deceleration)}, fJerk := {real(of.jerk)})"
    )


def frame(of: CoordinateFrame) -> str:
    """As MC_COORD_REF."""
    members = ((name.upper(), getattr(of, name)) for name in CoordinateFrame.model_fields)
    return f"({', '.join(f'{member} := {real(value)}' for member, value in members)})"
