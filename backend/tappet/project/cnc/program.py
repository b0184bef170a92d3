"""The data of a CNC object (cnc.md, section 1): a DIN 66025 program and how it is compiled."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field, StrictBool, StrictInt, model_validator

from tappet.project.data import CodeData, Data, Line, Text
from tappet.project.naming import name_key

FARTHEST = 1e12
"""Of coordinates and offline values, in path units."""
FASTEST = 1e9
"""Of velocities [u/s], accelerations and decelerations [u/s²] (CNC-13 to CNC-15)."""
LEAST_QUEUE = 5
MOST_QUEUE = 65_535
MOST_VARIABLES = 10_000

CompileMode = Literal["cnc_ref", "out_queue", "file"]
View = Literal["text", "table"]
Number = Annotated[float, Field(strict=True, ge=-FARTHEST, le=FARTHEST, allow_inf_nan=False)]
Rate = Annotated[float, Field(strict=True, ge=0, le=FASTEST, allow_inf_nan=False)]


class CncPosition(Data):
    """A position of all axes, in their units."""

    x: Number = 0.0
    y: Number = 0.0
    z: Number = 0.0
    a: Number = 0.0
    b: Number = 0.0
    c: Number = 0.0
    p: Number = 0.0
    q: Number = 0.0
    u: Number = 0.0
    v: Number = 0.0
    w: Number = 0.0


class OfflineValue(Data):
    """What a variable counts as where no controller runs (CNC-17)."""

    name: Line = Field(
        min_length=1,
        pattern=r"^[A-Za-z_]\w*(\.[A-Za-z_]\w*)*$",
        description="The variable, as it stands between the dollar signs.",
    )
    value: Number = 0.0


class CncProgramData(CodeData):
    """A CNC program."""

    implementation: Text = Field(default="", description="The program, DIN 66025, a block a line.")
    view: View = Field(default="text", description="The view that opens with the object (CNC-10).")
    compile_mode: CompileMode = Field(
        default="cnc_ref",
        description="What is made of it: SMC_CNC_REF, SMC_OUTQUEUE, or a file in the controller (CNC-11).",
    )
    queue_size: StrictInt = Field(
        default=100,
        ge=LEAST_QUEUE,
        le=MOST_QUEUE,
        description="Elements that path preprocessing looks ahead.",
    )
    velocity: Rate = Field(default=0.0, description="Of elements without F [u/s].")
    acceleration: Rate = Field(default=100.0, description="Of elements without E [u/s²].")
    deceleration: Rate = Field(default=100.0, description="Of elements without E- [u/s²].")
    start: CncPosition = Field(default_factory=CncPosition, description="Where the first element starts.")
    offline_values: tuple[OfflineValue, ...] = Field(default=(), max_length=MOST_VARIABLES)
    step_suppression: StrictBool = Field(
        default=False, description="Blocks that begin with / are left out (CNC-81)."
    )

    @model_validator(mode="after")
    def _no_variable_twice(self) -> CncProgramData:
        known = set()
        for row in self.offline_values:
            if name_key(row.name) in known:
                raise ValueError(f"the variable {row.name} has two offline values; remove one")
            known.add(name_key(row.name))
        return self


def new_program(_name: str) -> CncProgramData:
    """What a new object begins with: a line and an arc at a velocity of its own."""
    return CncProgramData(
        implementation="N0 G0 X0 Y0 F100\nN10 G1 X50 Y0\nN20 G3 X100 Y50 R50\n",
    )
