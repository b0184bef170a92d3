"""What of an application is recorded while an axis is measured, and what may be measured.

The axis answers under its panel (`AxisPanel`, `StepMeasurement` of SM3_Basic); a recorder of its bus task
takes the values at the end of each cycle. Which loop there is follows from the variables: the controller
closes it where the axis has `fKp`, the simulated drive where there is one with `stSettings`. Imports no
numbers library: the web server asks it. `recorded_axis` reads what was recorded.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

from tappet.codegen.symbol_map import SymbolError, SymbolMap, VarRef
from tappet.codegen.symbol_types import TypeInfo
from tappet.motion.loops import LEAST_INCREMENTS, ControllerLoop, DriveLoops, Excitation, GainName
from tappet.project.axes.cyclic_calls import PANELS
from tappet.project.axes.drives import drive_name
from tappet.project.axes.variables import VARIABLES
from tappet.project.errors import ProjectError

LEAST_CURRENT_TIME_S = 125e-6
"""Sum of the small time constants of a drive: its current loop works at 8 kHz at best."""
_AXIS = (
    "fTaskCycle", "bVirtual", "iMovementType", "fPositionPeriod", "bSWLimitEnable", "fSWLimitNegative",
    "fSWLimitPositive", "fSetPosition", "fMaxPositionLag", "fDeadTimeCycles", "fScalefactor", "nAxisState",
)  # fmt: skip
_CONTROLLER = ("fKp", "fRatedVelocity", "diRatedRaw", "iRatioTechUnitsNum")
_DRIVE = ("fPositionGain", "fVelocityGain", "fIntegralTime", "fCurrentTime", "fMaxTorque", "diMaxLag")
_GAINS: dict[bool, dict[GainName, str]] = {
    False: {"position_gain": "fKp", "dead_time": "fDeadTimeCycles"},
    True: {
        "position_gain": "fPositionGain",
        "velocity_gain": "fVelocityGain",
        "integral_time": "fIntegralTime",
    },
}
"""By whether the drive closes the loop."""
_RECORDED = ("fSetPosition", "fActPosition", "fSetVelocity", "fActVelocity")
_GOOD_INCREMENTS = 1000
_OF_LIMIT = 0.25
"""Part of a limit that a suggested height uses."""
_SETTLED_AFTER = 10.0
"""Times the time constant of a loop, 1 / Kp."""


class NoPositionLoopError(ProjectError):
    """There is nothing about this axis that could be tuned."""

    code = "no_position_loop"


class RefusedStepError(ProjectError):
    """The axis must not be measured so."""

    code = "refused_step"


@dataclass(frozen=True, slots=True)
class AxisFacts:
    """Values of an axis before it is measured, by the names of its members and of the drive's settings."""

    axis: str
    values: dict[str, float]
    in_drive: bool
    bus_task: str
    state: str

    @property
    def loop(self) -> ControllerLoop | DriveLoops:
        """As it works while a step is measured: that has no feed-forward."""
        known = self.values
        if self.in_drive:
            return DriveLoops(
                known["fPositionGain"],
                known["fVelocityGain"],
                known["fIntegralTime"],
                max(known["fCurrentTime"], LEAST_CURRENT_TIME_S),
            )
        return ControllerLoop(known["fKp"], known["fDeadTimeCycles"], known["fRatedVelocity"])

    @property
    def gains(self) -> dict[GainName, tuple[str, float]]:
        """Expression and present value of each gain."""
        owner = (
            f"{VARIABLES}.{drive_name(self.axis)}.stSettings" if self.in_drive else f"{VARIABLES}.{self.axis}"
        )
        return {name: (f"{owner}.{of}", self.values[of]) for name, of in _GAINS[self.in_drive].items()}

    @property
    def largest_torque(self) -> float | None:
        """Of the motor, where it is known."""
        return self.values.get("fMaxTorque")

    @property
    def resolution(self) -> float:
        """Units of an increment of the encoder."""
        scale = self.values["fScalefactor"]
        return 1.0 / abs(scale) if scale else 0.0

    @property
    def period(self) -> float | None:
        """Of a rotary axis."""
        return self.values["fPositionPeriod"] if self.values["iMovementType"] == 0 else None

    @property
    def lag_limit(self) -> float | None:
        """The smallest distance of set and actual position that is an error, None: none is."""
        limits = [self.values["fMaxPositionLag"]]
        if self.in_drive:
            limits.append(self.values["diMaxLag"] * self.resolution)
        return min((limit for limit in limits if limit > 0.0), default=None)

    @property
    def room(self) -> tuple[float, float] | None:
        """How far the axis may go down and up, None: as far as it likes."""
        known = self.values
        if self.period is not None or not known["bSWLimitEnable"]:
            return None
        return known["fSetPosition"] - known["fSWLimitNegative"], known["fSWLimitPositive"] - known[
            "fSetPosition"
        ]

    @property
    def excitation(self) -> Excitation:
        """That which shows something: without a gain an axis follows only a velocity."""
        return "move" if not self.in_drive and self.values["fKp"] <= 0.0 else "step"

    @property
    def suggested_height(self) -> float:
        """Well above the resolution, well below every limit: one of 1, 2, 5, 10 ..., in units."""
        known, limits = self.values, []
        if self.lag_limit is not None:
            limits.append(_OF_LIMIT * self.lag_limit)
        if self.period is not None:
            limits.append(_OF_LIMIT * self.period)
        if not self.in_drive and known["fKp"] > 0.0:
            limits.append(_OF_LIMIT * known["fRatedVelocity"] / known["fKp"])
        sign = 1.0
        if self.room is not None:
            down, up = self.room
            sign = -1.0 if up < 0.5 * down else 1.0
            limits.append(0.5 * max(up, down))
        wanted = min([_GOOD_INCREMENTS * (self.resolution or 1e-3), *limits])
        return sign * _rounded_down(max(wanted, LEAST_INCREMENTS * self.resolution))

    @property
    def suggested_duration_s(self) -> float:
        """Until the answer has settled."""
        gain = self.values["fPositionGain" if self.in_drive else "fKp"]
        settled = _SETTLED_AFTER / gain if gain > 0.0 else 1.0
        return _rounded_down(min(max(settled, 100 * self.values["fTaskCycle"], 0.2), 5.0))

    def check(self, height: float, excitation: Excitation) -> None:
        """Raises RefusedStepError for a height that the axis must not take."""
        known = self.values
        if known["bVirtual"]:
            raise RefusedStepError(f"The axis {self.axis} is in virtual mode: nothing follows its set values")
        if self.state != "standstill":
            raise RefusedStepError(
                f"The axis {self.axis} is in the state {self.state}; it has to stand with power (standstill)"
            )
        if abs(height) < LEAST_INCREMENTS * self.resolution or height == 0.0:
            raise RefusedStepError(
                f"A height of {height:g} u is less than {LEAST_INCREMENTS} increments of the encoder; choose "
                f"at least {LEAST_INCREMENTS * self.resolution:.3g} u"
            )
        if self.period is not None and abs(height) >= 0.5 * self.period:
            raise RefusedStepError(
                f"A height of {abs(height):g} u is half a period of the axis or more; choose less than "
                f"{0.5 * self.period:g} u"
            )
        if self.room is not None and not -self.room[0] <= height <= self.room[1]:
            raise RefusedStepError(
                f"From {known['fSetPosition']:g} u a height of {height:g} u goes to "
                f"{known['fSetPosition'] + height:g} u, beyond the software limits "
                f"{known['fSWLimitNegative']:g} u to {known['fSWLimitPositive']:g} u; choose a smaller "
                "height or move away from them"
            )
        limit = self.lag_limit
        if excitation == "step" and limit is not None and abs(height) > limit:
            raise RefusedStepError(
                f"A step of {abs(height):g} u is beyond the largest position lag of {limit:g} u, so that the "
                "axis would go into errorstop; choose a smaller height"
            )


@dataclass(frozen=True, slots=True)
class FrameLayout:
    """What the bytes of a recorded frame are, in their order."""

    codes: tuple[str, ...]
    """As numpy names types."""
    phases: dict[int, str]
    """Of the first value."""


class AxisMeasurement:
    """The variables of an axis in a loaded application."""

    def __init__(self, symbols: SymbolMap, axis: str) -> None:
        """Raises SymbolError when there is no such axis, NoPositionLoopError when nothing closes a loop."""
        self._symbols = symbols
        self._axis = axis
        variable, drive = f"{VARIABLES}.{axis}", f"{VARIABLES}.{drive_name(axis)}.stSettings"
        symbols.resolve(f"{variable}.nAxisState")
        panel = f"{PANELS}.{axis}"
        self.in_drive = not self._has(f"{variable}.fKp")
        if self.in_drive and not self._has(f"{drive}.fPositionGain"):
            raise NoPositionLoopError(
                f"Neither the controller nor a simulated drive closes a position loop for the axis {axis}; "
                "only axes with SM_Drive_PosControl or SM_Drive_Simulated are tuned here"
            )
        own = _below(drive, _DRIVE) if self.in_drive else _below(variable, _CONTROLLER)
        self._facts = self._refs([*_below(variable, _AXIS), *own, f"{panel}.sBusTask"])
        more = "fActTorque" if self.in_drive else "out.diSetVelocity"
        self._recorded = self._refs([f"{panel}.ePhase", *_below(variable, (*_RECORDED, more))])
        self._phases = {number: name for name, number in self._recorded[0].type.values}
        self._ends = self._refs([f"{panel}.xDone", f"{panel}.eError"])

    @property
    def fact_places(self) -> list[tuple[int, int]]:
        """(offset, size) of what is read before."""
        return _places(self._facts)

    @property
    def recorded_places(self) -> list[tuple[int, int]]:
        """(offset, size) of what is recorded in each cycle."""
        return _places(self._recorded)

    @property
    def end_places(self) -> list[tuple[int, int]]:
        """(offset, size) of what is read behind it."""
        return _places(self._ends)

    @property
    def layout(self) -> FrameLayout:
        """Of what is recorded."""
        return FrameLayout(tuple(_code(ref.type) for ref in self._recorded), self._phases)

    def facts(self, data: Sequence[bytes]) -> AxisFacts:
        """Of what was read at `fact_places`."""
        found = {
            ref.path.rpartition(".")[2]: self._symbols.decode(ref, one)
            for ref, one in zip(self._facts, data, strict=True)
        }
        state = next(ref for ref in self._facts if ref.path.endswith("nAxisState"))
        names = {number: name for name, number in state.type.values}
        numbers = {name: float(value) for name, value in found.items() if isinstance(value, int | float)}
        number = int(numbers["nAxisState"])
        return AxisFacts(
            self._axis, numbers, self.in_drive, str(found["sBusTask"]), names.get(number, str(number))
        )

    def end(self, data: Sequence[bytes]) -> tuple[bool, str]:
        """Whether it came to its end, and the error of the panel, of what was read at `end_places`."""
        done, error = (self._symbols.decode(ref, one) for ref, one in zip(self._ends, data, strict=True))
        return bool(done), self._symbols.format_literal(self._ends[1], error)

    def phase(self, frame: bytes) -> str:
        """Of the measurement, in the bytes of a recorded frame."""
        size = self._recorded[0].size
        return self._phases[int.from_bytes(frame[:size], "little", signed=True)]

    def _has(self, path: str) -> bool:
        try:
            self._symbols.resolve(path)
        except SymbolError:
            return False
        return True

    def _refs(self, paths: Sequence[str]) -> list[VarRef]:
        return [self._symbols.resolve(path) for path in paths]


def _below(variable: str, members: Sequence[str]) -> list[str]:
    return [f"{variable}.{member}" for member in members]


def _places(refs: Sequence[VarRef]) -> list[tuple[int, int]]:
    return [(ref.offset, ref.size) for ref in refs]


def _code(info: TypeInfo) -> str:
    return f"<{'f' if info.kind == 'real' else 'i'}{info.size}"


def _rounded_down(value: float) -> float:
    """To 1, 2 or 5 times a power of ten."""
    power = 10.0 ** math.floor(math.log10(value) + 1e-9)
    first = max(one for one in (1, 2, 5) if one * power <= value * (1 + 1e-9))
    return float(f"{first * power:.3g}")
