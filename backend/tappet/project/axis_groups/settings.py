"""The settings of an axis group: what its editor shows and the folder format keeps (AG-01 to AG-05)."""

from __future__ import annotations

from typing import Annotated

from pydantic import Field, model_validator

from tappet.project.axes.numbers import NotNegative, Number
from tappet.project.axis_groups.kinematics import GroupKinematics
from tappet.project.data import CodeData, Data
from tappet.project.naming import MAX_NAME

MOST_AXES = 6
"""MAX_AXIS + 1 of SM3_AxisGroup (AG-03)."""

AxisName = Annotated[str, Field(pattern="^([A-Za-z_][A-Za-z0-9_]*)?$", max_length=MAX_NAME)]


class PathDynamics(Data):
    """How fast a group moves along paths in space; 0 says nothing."""

    velocity: NotNegative = Field(default=0.0, description="Along the path, in units/s.")
    acceleration: NotNegative = Field(default=0.0, description="Along the path, in units/s².")
    deceleration: NotNegative = Field(default=0.0, description="Along the path, in units/s².")
    jerk: NotNegative = Field(default=0.0, description="Along the path, in units/s³.")


class CoordinateFrame(Data):
    """A place and an orientation: turned by a about Z, then by b about the new Y, then by c about the new
    X, as MC_COORD_REF."""

    x: Number = Field(default=0.0, description="Shift along X, in units.")
    y: Number = Field(default=0.0, description="Shift along Y, in units.")
    z: Number = Field(default=0.0, description="Shift along Z, in units.")
    a: Number = Field(default=0.0, description="Turn about Z, in degrees.")
    b: Number = Field(default=0.0, description="Turn about Y, in degrees.")
    c: Number = Field(default=0.0, description="Turn about X, in degrees.")


class AxisGroupSettings(CodeData):
    """The axes of a group, how fast it moves, and where its products lie."""

    axes: list[AxisName] = Field(
        default=[],
        max_length=MOST_AXES,
        description="Names of the axes by their index in the group; empty: none chosen yet.",
    )
    kinematics: GroupKinematics = GroupKinematics()
    limits: PathDynamics = Field(
        default=PathDynamics(),
        description="That no movement along a path exceeds; 0: the axes alone limit it.",
    )
    defaults: PathDynamics = Field(
        default=PathDynamics(), description="Of movements whose blocks say 0; 0: they have to say it."
    )
    jogging: PathDynamics = Field(
        default=PathDynamics(), description="Of MC_GroupJog and MC_GroupJogVector; 0: the defaults hold."
    )
    pcs_1: CoordinateFrame = Field(
        default=CoordinateFrame(), description="Where product 1 lies in the machine."
    )
    pcs_2: CoordinateFrame = Field(
        default=CoordinateFrame(), description="Where product 2 lies in the machine."
    )

    @model_validator(mode="after")
    def _defaults_are_within_limits(self) -> AxisGroupSettings:
        for name in PathDynamics.model_fields:
            limit, default = getattr(self.limits, name), getattr(self.defaults, name)
            if 0 < limit < default:
                raise ValueError(f"the default {name} of the group must not exceed its limit")
        return self
