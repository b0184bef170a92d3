"""The settings of an axis (devices.md, section 14): what its editor shows and the folder format keeps."""

from __future__ import annotations

from fractions import Fraction
from typing import Annotated, Literal

from pydantic import Field, StrictBool, StrictInt, model_validator

from tappet.project.axes.channels import ChannelMapping
from tappet.project.axes.numbers import Count, NotNegative, Number, Positive
from tappet.project.axes.simulated import SimulatedDrive
from tappet.project.data import CodeData, Data, Line
from tappet.project.naming import MAX_NAME

RampType = Literal["trapez", "sin2", "quadratic", "quadratic_smooth"]
DriveType = Literal[
    "SM_Drive_Virtual",
    "SM_Drive_Simulated",
    "SM_Drive_GenericDSP402",
    "SM_Drive_PosControl",
    "SM_Drive_Logical",
]
FilterDepth = Annotated[StrictInt, Field(ge=0, le=9)]

LARGEST_DENOMINATOR = 2**32 - 1
"""Of `dwRatioTechUnitsDenom`, a DWORD."""
LARGEST_NUMERATOR = 2**31 - 1
"""Of `iRatioTechUnitsNum`, a DINT."""

LONGEST_DEAD_TIME = 254
"""Cycles: HISTORY_LENGTH of SM3_Basic is two more."""


class SoftwareLimits(Data):
    """The travel range of a finite axis (AXIS-12)."""

    enabled: StrictBool = False
    negative: Number = Field(default=0.0, description="Lowest position, in units.")
    positive: Number = Field(default=1000.0, description="Highest position, in units.")
    deceleration: NotNegative = Field(
        default=0.0,
        description="With which the axis brakes at a limit, in units/s²; not less than the dynamic limit.",
    )

    @model_validator(mode="after")
    def _are_a_range(self) -> SoftwareLimits:
        if self.enabled and self.negative >= self.positive:
            raise ValueError("the negative software limit must lie below the positive one")
        return self


class DynamicLimits(Data):
    """How fast the axis moves by itself, and what SMC_CheckLimits and SMC_ControlAxisBy* take as too fast
    (AXIS-14, AXIS-17)."""

    velocity: Positive = Field(default=100.0, description="fSWMaxVelocity, in units/s.")
    acceleration: Positive = Field(default=100.0, description="fSWMaxAcceleration, in units/s².")
    deceleration: Positive = Field(default=100.0, description="fSWMaxDeceleration, in units/s².")
    jerk: Positive = Field(default=100_000.0, description="fSWMaxJerk, in units/s³.")


class DriveLimits(Data):
    """What the drive can do at most; set values beyond are errors of the axis (PRO-03, ERR-10)."""

    velocity: Positive = Field(default=10_000.0, description="fMaxVelocity, in units/s.")
    acceleration: Positive = Field(default=1_000_000.0, description="fMaxAcceleration, in units/s².")
    deceleration: Positive = Field(default=1_000_000.0, description="fMaxDeceleration, in units/s².")
    jerk: Positive = Field(default=100_000_000.0, description="fMaxJerk, in units/s³.")


class Scaling(Data):
    """The three lines from increments of the encoder to units of the application (AXIS-20)."""

    increments: Count = Field(default=65536, description="Increments ...")
    motor_turns: Count = Field(default=1, description="... of so many turns of the motor.")
    gear_motor_turns: Count = Field(default=1, description="Turns of the motor ...")
    gear_output_turns: Count = Field(default=1, description="... for so many turns of the gear's output.")
    output_turns: Count = Field(default=1, description="Turns of the gear's output ...")
    units: Positive = Field(default=360.0, description="... for so many units of the application.")
    invert: StrictBool = Field(default=False, description="The motor turns the other way round.")

    @property
    def units_per_increment(self) -> Fraction:
        """Without the direction."""
        return (
            Fraction(self.motor_turns, self.increments)
            * Fraction(self.gear_output_turns, self.gear_motor_turns)
            * Fraction(self.units)
            / self.output_turns
        )

    @property
    def ratio(self) -> Fraction:
        """Units per increment as `iRatioTechUnitsNum` over `dwRatioTechUnitsDenom` (AXIS-21): the nearest
        one in their ranges."""
        exact = self.units_per_increment
        largest = LARGEST_DENOMINATOR
        if exact > 1:
            largest = min(largest, max(1, int(LARGEST_NUMERATOR / exact)))
        near = exact.limit_denominator(largest)
        if near.numerator > LARGEST_NUMERATOR:
            near = Fraction(LARGEST_NUMERATOR)
        if near == 0:
            near = Fraction(1, LARGEST_DENOMINATOR)
        return -near if self.invert else near


class PositionControl(Data):
    """The position loop over a drive that follows a speed alone (AXIS-40 to AXIS-45)."""

    dead_time: Annotated[float, Field(ge=0, le=LONGEST_DEAD_TIME, allow_inf_nan=False)] = Field(
        default=2.0, description="Cycles from a set position until its actual one."
    )
    gain: NotNegative = Field(default=0.0, description="fKp: velocity by the position error, in 1/s.")
    bits: Literal[16, 24, 32] = Field(default=32, description="Width of the counter of the encoder.")
    speed_from: Literal["velocity", "position"] = Field(
        default="velocity", description="What the speed is taken from: the set velocity or the set positions."
    )
    rated_velocity: Positive = Field(default=1000.0, description="Velocity at `rated_raw`, in units/s.")
    rated_raw: Count = Field(default=32767, description="Set value of the drive at that velocity.")


class GenericDrive(Data):
    """A drive that speaks CiA 402, of which nothing else is known."""

    rated_torque: Positive = Field(
        default=1.0, description="Of the motor: 1000 at objects 6071h and 6077h, in Nm."
    )
    bits: Literal[16, 24, 32] = Field(default=32, description="Width of the position counter.")
    dead_time: Annotated[float, Field(ge=0, le=LONGEST_DEAD_TIME, allow_inf_nan=False)] = Field(
        default=2.0, description="Cycles from a set position until its actual one."
    )
    limit_switches: StrictBool = Field(
        default=True, description="On a finite axis, motion towards a limit switch that is on is an error."
    )


class Mirroring(Data):
    """What a logical axis mirrors (AXIS-30 to AXIS-34)."""

    master: Annotated[str, Field(pattern="^([A-Za-z_][A-Za-z0-9_]*)?$", max_length=MAX_NAME)] = Field(
        default="", description="Name of the axis; empty: none yet."
    )
    reference: Literal["set", "actual"] = Field(default="set", description="Values of the master.")
    dead_time: Number = Field(default=0.0, description="Cycles that the master is seen ahead.")
    position_filter: FilterDepth = Field(
        default=0, description="Cycles of which position increments are averaged; 0: the newest one."
    )
    velocity_filter: FilterDepth = Field(default=0, description="The same of the velocity.")


class AxisSettings(CodeData):
    """An axis of the application (devices.md, 14.2 and 14.3)."""

    drive: DriveType = Field(default="SM_Drive_Virtual", description="The device that the axis moves.")
    axis_type: Literal["modulo", "finite"] = Field(
        default="modulo", description="Rotary with a period, or linear with ends (AXIS-11)."
    )
    modulo: Positive = Field(default=360.0, description="Units of one period of a modulo axis (AXIS-13).")
    software_limits: SoftwareLimits = SoftwareLimits()
    dynamic_limits: DynamicLimits = DynamicLimits()
    drive_limits: DriveLimits = DriveLimits()
    ramp_type: RampType = Field(default="trapez", description="Shape of velocity ramps (AXIS-15).")
    stopping_distance: NotNegative = Field(
        default=0.0,
        description="Units within which the axis comes to standstill after an error, 0: by its deceleration.",
    )
    virtual_mode: StrictBool = Field(
        default=False, description="The axis moves without its drive (AXIS-10); a virtual drive always does."
    )
    position_lag: NotNegative = Field(
        default=0.0,
        description="Largest difference between set and actual position, in units; 0: it is not watched.",
    )
    scaling: Scaling = Scaling()
    position_control: PositionControl = PositionControl()
    mirroring: Mirroring = Mirroring()
    simulated_drive: SimulatedDrive = SimulatedDrive()
    generic_drive: GenericDrive = GenericDrive()
    mapping: ChannelMapping = ChannelMapping()
    bus_task: Line = Field(
        default="",
        description="Task that moves the axis; empty: that of the pool, else the fastest cyclic one.",
    )

    @property
    def has_drive(self) -> bool:
        """Whether there is something behind the axis that has increments."""
        return self.drive in ("SM_Drive_Simulated", "SM_Drive_GenericDSP402", "SM_Drive_PosControl")

    @property
    def subkind(self) -> str | None:
        """The drive."""
        return self.drive
