"""What is known of a position loop beforehand, and what is asked of it: plain data."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

Aim = Literal["no_overshoot", "fast"]
Excitation = Literal["step", "move"]
GainName = Literal["position_gain", "dead_time", "velocity_gain", "integral_time"]
LEAST_INCREMENTS = 20
"""Of the encoder in a height that can be judged."""


@dataclass(frozen=True, slots=True)
class ControllerLoop:
    """How the controller closes the loop."""

    gain: float
    """fKp: velocity by position error, in 1/s."""
    dead_time_cycles: float = 0.0
    """How old the set position is that the actual one is compared with."""
    largest_velocity: float | None = None
    """That it asks for, in units/s."""


@dataclass(frozen=True, slots=True)
class DriveLoops:
    """Gains of a drive, and what is known of its current loop."""

    position_gain: float
    """Velocity by position error, in 1/s."""
    velocity_gain: float
    """Torque by velocity error, in Nms."""
    integral_time_s: float
    """Of the velocity loop, 0: it has no integral part."""
    current_time_s: float
    """Sum of the small time constants below the velocity loop."""


@dataclass(frozen=True, slots=True)
class Margins:
    """How far a loop is from oscillating."""

    phase_deg: float
    gain: float | None
    """Factor of the gain at which it oscillates, None: at none."""
