"""The kinds of drives that an axis can have: types, declarations, and calls of the bus task.

`{axis}` in a text is the name of the axis, `{drive}` that of its drive, `{cycle}` the cycle time in seconds.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from tappet.project.axes.literals import flag, real
from tappet.project.axes.settings import AxisSettings, DriveType
from tappet.project.axes.simulated import changed_members

LIBRARY = "SM3_Basic"
"""The library of all axes (AXIS-03, CAL-08)."""
DRIVE_ENDING = "_Drive"
"""Behind the name of an axis: the variable that its drive is, where the drive is one."""


@dataclass(frozen=True, slots=True)
class Drive:
    """What the texts that are made of an axis have for its drive."""

    axis_type: str
    """Of SM3_Basic."""
    members: Callable[[AxisSettings], dict[str, str]] = lambda settings: {}
    """Initial values of members that other axes do not have."""
    declared: Callable[[AxisSettings], str] | None = None
    """Type and initial values of the variable of the drive; None: it has none."""
    before: str = ""
    """Statements in front of BeginCycle."""
    behind: str = ""
    """Statements behind EndCycle."""


def drive_of(settings: AxisSettings) -> Drive:
    """The drive of an axis."""
    return _DRIVES[settings.drive]


def drive_name(axis: str) -> str:
    """The variable of the drive of an axis."""
    return f"{axis}{DRIVE_ENDING}"


def _simulated(settings: AxisSettings) -> str:
    increments = max(1, round(settings.scaling.increments / settings.scaling.motor_turns))
    changed = changed_members(settings.simulated_drive, increments)
    if not changed:
        return f"{LIBRARY}.SimulatedDrive"
    values = ", ".join(f"{member} := {value}" for member, value in changed.items())
    return f"{LIBRARY}.SimulatedDrive := (stSettings := ({values}))"


def _simulated_members(settings: AxisSettings) -> dict[str, str]:
    drive = settings.simulated_drive
    switches = drive.switches.negative or drive.switches.positive
    return {
        "fRatedTorque": real(drive.limits.rated_torque),
        "bHWLimitEnable": flag(settings.axis_type == "finite" and switches),
    }


def _generic(settings: AxisSettings) -> dict[str, str]:
    drive = settings.generic_drive
    return {
        "fRatedTorque": real(drive.rated_torque),
        "byPositionBits": str(drive.bits),
        "fDeadTimeCycles": real(drive.dead_time),
        "bHWLimitEnable": flag(settings.axis_type == "finite" and drive.limit_switches),
    }


def _position_controlled(settings: AxisSettings) -> dict[str, str]:
    control = settings.position_control
    return {
        "byPositionBits": str(control.bits),
        "fDeadTimeCycles": real(control.dead_time),
        "fKp": real(control.gain),
        "fRatedVelocity": real(control.rated_velocity),
        "diRatedRaw": str(control.rated_raw),
        "bSpeedFromPosition": flag(control.speed_from == "position"),
        "bHWLimitEnable": flag(settings.axis_type == "finite"),
    }


def _mirroring(settings: AxisSettings) -> dict[str, str]:
    mirrored = settings.mirroring
    reference = "SMC_SET_VALUE" if mirrored.reference == "set" else "SMC_ACT_VALUE"
    return {
        **({"pMaster": f"ADR({mirrored.master})"} if mirrored.master else {}),
        "eValueReference": f"{LIBRARY}.SMC_ValueSelect.{reference}",
        "fDeadTimeCycles": real(mirrored.dead_time),
        "usiFilterDepthPosition": str(mirrored.position_filter),
        "usiFilterDepthVelocity": str(mirrored.velocity_filter),
        **({"fModulo": real(settings.modulo)} if settings.axis_type == "modulo" else {}),
    }


_DRIVES: dict[DriveType, Drive] = {
    "SM_Drive_Virtual": Drive("AXIS_REF_VIRTUAL_SM3"),
    "SM_Drive_Simulated": Drive(
        "AXIS_REF_MAPPING_SM3",
        members=_simulated_members,
        declared=_simulated,
        before="{axis}.in := {drive}.stIn;\n",
        behind="\n{drive}(stOut := {axis}.out, fCycle := {cycle});",
    ),
    "SM_Drive_GenericDSP402": Drive("AXIS_REF_MAPPING_SM3", members=_generic),
    "SM_Drive_PosControl": Drive("AXIS_REF_POSCONTROL_SM3", members=_position_controlled),
    "SM_Drive_Logical": Drive("AXIS_REF_LOGICAL_SM3", members=_mirroring),
}
