"""What of an application is recorded while an axis is measured, and what these values are.

The axis answers under its panel (`AxisPanel`, `StepMeasurement` of SM3_Basic); a recorder of its bus task
takes the values at the end of each cycle. Which loop there is follows from the variables: the controller
closes it where the axis has `fKp`, the simulated drive where there is one with `stSettings`.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from tappet.codegen.symbol_map import SymbolError, SymbolMap, VarRef
from tappet.codegen.symbol_types import TypeInfo
from tappet.motion.drive_loop import DriveLoops
from tappet.motion.measured_response import Excitation, Recording, UnusableMeasurementError, recording_of
from tappet.motion.position_loop import ControllerLoop
from tappet.project.axes.cyclic_calls import PANELS
from tappet.project.axes.drives import drive_name
from tappet.project.axes.variables import VARIABLES
from tappet.project.errors import ProjectError
from tappet.runtime.recorder import Frame

_AXIS = (
    "fTaskCycle", "bVirtual", "iMovementType", "fPositionPeriod", "bSWLimitEnable", "fSWLimitNegative",
    "fSWLimitPositive", "fSetPosition", "fMaxPositionLag", "fDeadTimeCycles", "fScalefactor", "nAxisState",
)  # fmt: skip
_CONTROLLER = ("fKp", "fRatedVelocity", "diRatedRaw", "iRatioTechUnitsNum")
_DRIVE = ("fPositionGain", "fVelocityGain", "fIntegralTime", "fCurrentTime", "fMaxTorque", "diMaxLag")
LEAST_CURRENT_TIME_S = 125e-6
"""Sum of the small time constants of a drive: its current loop works at 8 kHz at best."""
_RECORDED = ("fSetPosition", "fActPosition", "fSetVelocity", "fActVelocity")


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
    def largest_torque(self) -> float | None:
        """Of the motor, where it is known."""
        return self.values.get("fMaxTorque")

    @property
    def lag_limit(self) -> float | None:
        """The smallest distance of set and actual position that is an error, None: none is."""
        known = self.values
        limits = [known["fMaxPositionLag"]]
        if self.in_drive and known["fScalefactor"] != 0.0:
            limits.append(known["diMaxLag"] / abs(known["fScalefactor"]))
        return min((limit for limit in limits if limit > 0.0), default=None)

    def check(self, height: float, excitation: Excitation) -> None:
        """Raises RefusedStepError for a height that the axis must not take."""
        known = self.values
        if known["bVirtual"]:
            raise RefusedStepError(f"The axis {self.axis} is in virtual mode: nothing follows its set values")
        if self.state != "standstill":
            raise RefusedStepError(
                f"The axis {self.axis} is in the state {self.state}; it has to stand with power (standstill)"
            )
        rotary = known["iMovementType"] == 0
        if rotary and abs(height) >= 0.5 * known["fPositionPeriod"]:
            raise RefusedStepError(
                f"A height of {abs(height):g} u is half a period of the axis or more; choose less than "
                f"{0.5 * known['fPositionPeriod']:g} u"
            )
        target = known["fSetPosition"] + height
        low, high = known["fSWLimitNegative"], known["fSWLimitPositive"]
        if not rotary and known["bSWLimitEnable"] and not low <= target <= high:
            raise RefusedStepError(
                f"From {known['fSetPosition']:g} u a height of {height:g} u goes to {target:g} u, beyond the "
                f"software limits {low:g} u to {high:g} u; choose a smaller height or move away from them"
            )
        limit = self.lag_limit
        if excitation == "step" and limit is not None and abs(height) > limit:
            raise RefusedStepError(
                f"A step of {abs(height):g} u is beyond the largest position lag of {limit:g} u, so that the "
                "axis would go into errorstop; choose a smaller height"
            )


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
        own = [f"{drive}.{name}" for name in _DRIVE] if self.in_drive else _below(variable, _CONTROLLER)
        self._facts = self._refs([*_below(variable, _AXIS), *own, f"{panel}.sBusTask"])
        more = "fActTorque" if self.in_drive else "out.diSetVelocity"
        recorded = _below(variable, (*_RECORDED, more))
        self._recorded = self._refs([f"{panel}.ePhase", *recorded])

    @property
    def fact_places(self) -> list[tuple[int, int]]:
        """(offset, size) of what is read before."""
        return [(ref.offset, ref.size) for ref in self._facts]

    @property
    def recorded_places(self) -> list[tuple[int, int]]:
        """(offset, size) of what is recorded in each cycle."""
        return [(ref.offset, ref.size) for ref in self._recorded]

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

    def phase(self, frame: Frame) -> str:
        """Of the measurement, in a recorded frame."""
        return self._phases()[int.from_bytes(frame.data[:2], "little", signed=True)]

    def recording(self, frames: Sequence[Frame], facts: AxisFacts) -> Recording:
        """The answer in recorded frames. Raises UnusableMeasurementError when they are none."""
        if not frames:
            raise UnusableMeasurementError("Nothing was recorded")
        lost = frames[-1].cycle - frames[0].cycle + 1 - len(frames)
        if lost:
            raise UnusableMeasurementError(
                f"{lost} of {lost + len(frames)} cycles were not recorded; measure for a shorter time"
            )
        layout = np.dtype([(str(at), _code(ref.type)) for at, ref in enumerate(self._recorded)])
        values = np.frombuffer(b"".join(frame.data for frame in frames), layout)
        columns = [values[str(at)].astype(float) for at in range(len(self._recorded))]
        known, phases = facts.values, self._phases()
        command = None
        if not self.in_drive:
            sign = -1.0 if known["iRatioTechUnitsNum"] < 0 else 1.0
            command = sign * columns[5] * known["fRatedVelocity"] / known["diRatedRaw"]
        return recording_of(
            [phases[int(number)] for number in columns[0]],
            known["fTaskCycle"],
            set_position=columns[1],
            act_position=columns[2],
            set_velocity=columns[3],
            act_velocity=columns[4],
            command=command,
            torque=columns[5] if self.in_drive else None,
            resolution=1.0 / abs(known["fScalefactor"]) if known["fScalefactor"] else 0.0,
            period=known["fPositionPeriod"] if known["iMovementType"] == 0 else None,
        )

    def _phases(self) -> dict[int, str]:
        return {number: name for name, number in self._recorded[0].type.values}

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


def _code(info: TypeInfo) -> str:
    """As numpy reads it."""
    return f"<{'f' if info.kind == 'real' else 'i'}{info.size}"
