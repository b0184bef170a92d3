"""The global variables that axes are: an instance of the type of their drive with the values of the editor
(AXIS-04, AXIS-17)."""

from __future__ import annotations

from fractions import Fraction

from tappet.project.axes.drives import LIBRARY, drive_name, drive_of
from tappet.project.axes.literals import flag, real
from tappet.project.axes.settings import AxisSettings

NOT_WRITTEN_BY_HAND = (
    "{analysis -S1001, -S1002, -S1003, -S1004, -S1101, -S1102, -S1211, -S1242, -S1408, -S1414, -S1416, "
    "-S1418, -S1609, -S1610}"
)
"""First line of the texts that are made of axes: how a user wants his texts to be says nothing about them."""
VARIABLES = "IoConfig_Globals"
"""The list of global variables that the axes are in."""


def declaration(name: str, settings: AxisSettings) -> str:
    """The variable of an axis, ready for VAR_GLOBAL, and that of its drive."""
    values = ",\n".join(f"        {member} := {value}" for member, value in initial_values(settings).items())
    drive = drive_of(settings)
    found = f"    {name} : {LIBRARY}.{drive.axis_type} := (\n{values});"
    if drive.declared is not None:
        found += f"\n    {drive_name(name)} : {drive.declared(settings)};"
    return found


def initial_values(settings: AxisSettings) -> dict[str, str]:
    """The members that the editor decides, as IEC literals."""
    limits, dynamic, drive = settings.software_limits, settings.dynamic_limits, settings.drive_limits
    ratio = settings.scaling.ratio
    finite = settings.axis_type == "finite"
    return {
        "bVirtual": flag(settings.virtual_mode or not settings.has_drive),
        "iMovementType": "1" if finite else "0",
        "fPositionPeriod": real(settings.modulo),
        "bSWLimitEnable": flag(finite and limits.enabled),
        "fSWLimitNegative": real(limits.negative),
        "fSWLimitPositive": real(limits.positive),
        "fSWLimitDeceleration": real(limits.deceleration),
        "fSWMaxVelocity": real(dynamic.velocity),
        "fSWMaxAcceleration": real(dynamic.acceleration),
        "fSWMaxDeceleration": real(dynamic.deceleration),
        "fSWMaxJerk": real(dynamic.jerk),
        "fMaxVelocity": real(drive.velocity),
        "fMaxAcceleration": real(drive.acceleration),
        "fMaxDeceleration": real(drive.deceleration),
        "fMaxJerk": real(drive.jerk),
        "eRampType": f"{LIBRARY}.SMC_RAMPTYPE.{settings.ramp_type}",
        "fSWErrorMaxDistance": real(settings.stopping_distance),
        "iRatioTechUnitsNum": str(ratio.numerator),
        "dwRatioTechUnitsDenom": str(ratio.denominator),
        "fScalefactor": real(float(1 / _signed(settings))),
        **({"fMaxPositionLag": real(settings.position_lag)} if settings.has_drive else {}),
        **drive_of(settings).members(settings),
    }


def _signed(settings: AxisSettings) -> Fraction:
    exact = settings.scaling.units_per_increment
    return -exact if settings.scaling.invert else exact
