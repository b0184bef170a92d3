"""Settings of a simulated drive: its motor and load, loops, encoder, switches, homing and limits.

Places of the motor are in turns from where it stands at the start, so they stay where they are when the
encoder changes.
"""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field, StrictBool, model_validator

from tappet.project.axes.literals import real
from tappet.project.axes.numbers import NotNegative, Number, Positive
from tappet.project.data import Data

# fmt: off
HomingMethod = Literal[
    1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14,
    17, 18, 19, 20, 21, 22, 23, 24, 25, 26, 27, 28, 29, 30,
    33, 34, 35, 37,
]
# fmt: on
"""Object 6098h of CiA 402."""
_LOWEST, _HIGHEST = -(2**31), 2**31 - 1


class MotorAndLoad(Data):
    """What turns."""

    inertia: Positive = Field(default=6e-5, description="Of the motor and what is rigid with it, in kgm².")
    viscous: NotNegative = Field(default=1e-4, description="Friction by velocity, in Nms.")
    dry: NotNegative = Field(default=0.01, description="Friction of any velocity and standstill, in Nm.")
    elastic: StrictBool = Field(default=False, description="The load is behind an elastic shaft.")
    load_inertia: Positive = Field(default=6e-5, description="Of the load behind the shaft, in kgm².")
    stiffness: Positive = Field(default=100.0, description="Of the shaft, in Nm/rad.")
    damping: NotNegative = Field(default=0.001, description="Of the shaft, in Nms/rad.")


class Loops(Data):
    """The controllers of the drive."""

    current_time: NotNegative = Field(default=0.0005, description="Time constant of the current loop, in s.")
    position_gain: NotNegative = Field(default=60.0, description="Velocity by position lag, in 1/s.")
    velocity_gain: NotNegative = Field(default=0.03, description="Torque by velocity deviation, in Nms.")
    integral_time: NotNegative = Field(
        default=0.02, description="Of the velocity loop, in s; 0: it has no integral part."
    )
    feed_forward: Annotated[float, Field(ge=0, le=1, allow_inf_nan=False)] = Field(
        default=1.0, description="Part of the set velocity that goes past the position loop."
    )


class Encoder(Data):
    """The encoder of the motor; its increments are those of the scaling."""

    noise: NotNegative = Field(default=0.0, description="Largest deviation, in increments.")


class Switches(Data):
    """Switches along the way of the motor."""

    negative: StrictBool = Field(default=False, description="There is a negative limit switch.")
    negative_at: Number = Field(default=-10.0, description="Below it that switch is on, in turns.")
    positive: StrictBool = Field(default=False, description="There is a positive limit switch.")
    positive_at: Number = Field(default=10.0, description="Above it that switch is on, in turns.")
    home: StrictBool = Field(default=False, description="There is a home switch.")
    home_from: Number = Field(default=-0.25, description="From here on it is on, in turns.")
    home_to: Number = Field(default=0.25, description="To here, in turns.")

    @model_validator(mode="after")
    def _lie_in_order(self) -> Switches:
        if self.negative and self.positive and self.negative_at >= self.positive_at:
            raise ValueError("the negative limit switch must lie below the positive one")
        if self.home and self.home_from > self.home_to:
            raise ValueError("the home switch must begin below its end")
        return self


class Homing(Data):
    """Homing by the drive, which MC_Home starts."""

    method: HomingMethod = Field(default=37, description="Object 6098h.")
    velocity: Positive = Field(default=10.0, description="In the search of the switch, in rad/s (6099h, 1).")
    zero_velocity: Positive = Field(default=2.0, description="In the search of zero, in rad/s (6099h, 2).")
    acceleration: NotNegative = Field(default=1000.0, description="In rad/s² (609Ah); 0: at once.")


class MotorLimits(Data):
    """What the drive can do and stand."""

    rated_torque: Positive = Field(default=1.27, description="1000 at objects 6071h and 6077h, in Nm.")
    max_torque: Positive = Field(default=3.8, description="Largest torque of the motor, in Nm.")
    lag: NotNegative = Field(
        default=1.0, description="Larger position lags are faults of the drive, in turns; 0: none is."
    )
    quick_stop: Positive = Field(
        default=2000.0, description="Deceleration of quick stops and faults, in rad/s²."
    )


class SimulatedDrive(Data):
    """The drive of SM_Drive_Simulated."""

    motor: MotorAndLoad = MotorAndLoad()
    loops: Loops = Loops()
    encoder: Encoder = Encoder()
    switches: Switches = Switches()
    homing: Homing = Homing()
    limits: MotorLimits = MotorLimits()


def members(drive: SimulatedDrive, increments: int) -> dict[str, str]:
    """The members of SM3_Basic.SimulatedDriveSettings as IEC literals; `increments` are those of a turn."""
    motor, loops, switches = drive.motor, drive.loops, drive.switches
    homing, limits = drive.homing, drive.limits

    def place(turns: float) -> str:
        return str(min(_HIGHEST, max(_LOWEST, round(turns * increments))))

    return {
        "fInertia": real(motor.inertia),
        "fViscous": real(motor.viscous),
        "fDry": real(motor.dry),
        "fLoadInertia": real(motor.load_inertia if motor.elastic else 0.0),
        "fStiffness": real(motor.stiffness),
        "fDamping": real(motor.damping),
        "fRatedTorque": real(limits.rated_torque),
        "fMaxTorque": real(limits.max_torque),
        "fCurrentTime": real(loops.current_time),
        "fPositionGain": real(loops.position_gain),
        "fVelocityGain": real(loops.velocity_gain),
        "fIntegralTime": real(loops.integral_time),
        "fFeedForward": real(loops.feed_forward),
        "diIncrements": str(increments),
        "fNoise": real(drive.encoder.noise),
        "diMaxLag": place(limits.lag) if limits.lag else "0",
        "diNegativeLimit": place(switches.negative_at) if switches.negative else str(_LOWEST),
        "diPositiveLimit": place(switches.positive_at) if switches.positive else str(_HIGHEST),
        "diHomeFrom": place(switches.home_from) if switches.home else str(_HIGHEST),
        "diHomeTo": place(switches.home_to) if switches.home else str(_LOWEST),
        "iHomingMethod": str(homing.method),
        "fHomingVelocity": real(homing.velocity),
        "fHomingZeroVelocity": real(homing.zero_velocity),
        "fHomingAcceleration": real(homing.acceleration),
        "fQuickStop": real(limits.quick_stop),
    }


DEFAULTS = members(SimulatedDrive(), 65536)
"""Those that the library has by itself."""


def changed_members(drive: SimulatedDrive, increments: int) -> dict[str, str]:
    """Those that differ from what the library has by itself."""
    found = members(drive, increments)
    return {name: value for name, value in found.items() if value != DEFAULTS[name]}
