"""The kinematics that an axis group can be given: those of SM3_Transformation, with their parameters.

`python -m tappet.project.axis_groups.kinematics` prints them for the front end.
"""

from __future__ import annotations

import json
import sys
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Annotated, Literal

from pydantic import Field, model_validator

from tappet.project.axes.literals import flag, real
from tappet.project.axes.numbers import Number
from tappet.project.data import Data

LIBRARY = "SM3_Transformation"
NAMESPACE = "TRAFO"
KIN_ENDING = "_Kin"
"""Behind the name of a group: the variable that its kinematics is."""
OFFSETS = 6
"""Places of `adOffset`."""

KinematicsType = Literal[
    "",
    "Kin_Gantry2",
    "Kin_Gantry3",
    "Kin_Gantry3C",
    "Kin_GantryH2",
    "Kin_GantryT2",
    "Kin_5AxisGantry",
    "Kin_Polar_Z",
    "Kin_Scara2_Z",
    "Kin_Scara3_Z",
    "Kin_Bipod_Arm",
    "Kin_Tripod_Linear",
    "Kin_Tripod_Rotary",
    "Kin_4AxisPalletizer",
    "Kin_ArticulatedRobot_6DOF",
]


@dataclass(frozen=True, slots=True)
class KinematicsForm:
    """How many axes a kinematics has, and which parameters; `stArm.fA1` is a member of one."""

    axes: int
    parameters: tuple[str, ...] = ()


_ARM = tuple(f"stArm.{name}" for name in ("fA1", "fA2", "fA3", "fD1", "fD3", "fD4", "fD6", "xZUp"))
FORMS: Mapping[KinematicsType, KinematicsForm] = {
    "Kin_Gantry2": KinematicsForm(2),
    "Kin_Gantry3": KinematicsForm(3),
    "Kin_Gantry3C": KinematicsForm(4),
    "Kin_GantryH2": KinematicsForm(2),
    "Kin_GantryT2": KinematicsForm(2),
    "Kin_5AxisGantry": KinematicsForm(5, ("dTool",)),
    "Kin_Polar_Z": KinematicsForm(3),
    "Kin_Scara2_Z": KinematicsForm(3, ("dArmLength1", "dArmLength2")),
    "Kin_Scara3_Z": KinematicsForm(4, ("dArmLength1", "dArmLength2", "dArmLength3")),
    "Kin_Bipod_Arm": KinematicsForm(2, ("dArmLength1", "dArmLength2", "dDistance")),
    "Kin_Tripod_Linear": KinematicsForm(3, ("dInnerRadius", "dOuterRadius", "dLength", "dRotationOffset")),
    "Kin_Tripod_Rotary": KinematicsForm(
        3,
        (
            *("dArmLength1", "dArmLength2", "dArm1Radius", "dStewartRadius"),
            *("dRotationOffset", "dMaxAngleBallJoint"),
        ),
    ),
    "Kin_4AxisPalletizer": KinematicsForm(4, ("dA1", "dD1", "dL1", "dL2", "dA4", "dD4")),
    "Kin_ArticulatedRobot_6DOF": KinematicsForm(6, _ARM),
}
"""By type; the first ones are the simplest."""


class GroupKinematics(Data):
    """What leads from the axes of a group to the machine and back."""

    type: KinematicsType = Field(
        default="", description="Empty: none, positions of the machine are those of axes."
    )
    offsets: Annotated[list[Number], Field(min_length=OFFSETS, max_length=OFFSETS)] = Field(
        default=[0.0] * OFFSETS, description="adOffset: of the axes by their index, in units."
    )
    parameters: dict[str, Number] = Field(
        default={}, description="Lengths and angles of the kinematics by their names; others are 0."
    )

    @model_validator(mode="after")
    def _parameters_are_known(self) -> GroupKinematics:
        form = FORMS.get(self.type)
        for name in self.parameters:
            if form is None or name not in form.parameters:
                raise ValueError(f"the kinematics has no parameter '{name}'")
        return self


def declaration(group: str, kinematics: GroupKinematics) -> str:
    """The variable of a kinematics, ready for VAR_GLOBAL."""
    values = {"adOffset": f"[{', '.join(real(offset) for offset in kinematics.offsets)}]"}
    members: dict[str, list[str]] = {}
    for name in FORMS[kinematics.type].parameters:
        value = _literal(name, kinematics.parameters.get(name, 0.0))
        owner, dot, member = name.partition(".")
        if dot:
            members.setdefault(owner, []).append(f"{member} := {value}")
        else:
            values[name] = value
    values |= {owner: f"({', '.join(parts)})" for owner, parts in members.items()}
    lines = ",\n".join(f"        {member} := {value}" for member, value in values.items())
    return f"    {group}{KIN_ENDING} : {NAMESPACE}.{kinematics.type} := (\n{lines});"


def _literal(name: str, value: float) -> str:
    """As BOOL where the name is one's, else as LREAL."""
    return flag(value != 0.0) if is_flag(name) else real(value)


def is_flag(name: str) -> bool:
    """Whether a parameter is a BOOL; 0 is FALSE."""
    return name.rpartition(".")[2].startswith("x")


def table() -> str:
    """The kinematics by type, as JSON."""
    forms = {name: {"axes": form.axes, "parameters": form.parameters} for name, form in FORMS.items()}
    return json.dumps(forms, indent=2) + "\n"


if __name__ == "__main__":
    sys.stdout.write(table())
