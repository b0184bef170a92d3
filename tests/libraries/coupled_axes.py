"""A virtual master and a virtual slave with the function blocks that couple them and move either."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from functools import cache

from linked_application import LoadedApplication, loaded
from tests.libraries.one_axis import CYCLE

from tappet.codegen.build import BuildOptions, BuildSession, LibraryReference, build_application
from tappet.codegen.package import CodePackage
from tappet.lang.source import Source
from tappet.libraries import load
from tappet.libraries.catalog import items

OF_MASTER = {
    "MasterVelocity": "MC_MoveVelocity",
    "MasterAbsolute": "MC_MoveAbsolute",
    "MasterSuper": "MC_MoveSuperImposed",
    "MasterStop": "MC_Stop",
}
COUPLINGS = {
    "Gear1": "MC_GearIn",
    "Gear2": "MC_GearIn",
    "GearPos": "MC_GearInPos",
    "Phasing": "MC_Phasing",
    "Phasing2": "MC_Phasing",
    "PhasingRelative": "MC_PhasingRelative",
    "Backlash": "SMC_BacklashCompensation",
}
OF_SLAVE = {
    "Super1": "MC_MoveSuperImposed",
    "Super2": "MC_MoveSuperImposed",
    "HaltSuper": "MC_HaltSuperimposed",
    "Absolute": "MC_MoveAbsolute",
    "Additive": "MC_MoveAdditive",
    "Velocity": "MC_MoveVelocity",
    "Stop": "MC_Stop",
    "Halt": "MC_Halt",
    "Jog": "MC_Jog",
    "Inch": "SMC_Inch",
    "Through": "SMC_MoveContinuousAbsolute",
    "ThroughBy": "SMC_MoveContinuousRelative",
    "Override": "MC_SetOverride",
    "Follow": "SMC_FollowPosition",
    "FollowVelocity": "SMC_FollowVelocity",
    "FollowBoth": "SMC_FollowPositionVelocity",
    "FollowValues": "SMC_FollowSetValues",
    "Reset": "MC_Reset",
}
RELEASES = {"GearOut": "MC_GearOut", "CamOut": "MC_CamOut"}
PROFILES = {
    "Positions": ("MC_PositionProfile", "TimePosition", "MC_TP_REF"),
    "Velocities": ("MC_VelocityProfile", "TimeVelocity", "MC_TV_REF"),
    "Accelerations": ("MC_AccelerationProfile", "TimeAcceleration", "MC_TA_REF"),
}
BLOCKS = OF_MASTER | COUPLINGS | OF_SLAVE | RELEASES | {name: block for name, (block, *_) in PROFILES.items()}
_ITEMS = {item.name: item for item in items(load("SM3_Basic"))}
_OUTPUTS = {name: [pin.name for pin in item.outputs if pin.type == "BOOL"] for name, item in _ITEMS.items()}
_EXECUTES = {name: item.inputs[0].name for name, item in _ITEMS.items() if item.inputs}
_AXIS = f"(fTaskCycle := {CYCLE}, fMaxVelocity := 1E5, fMaxAcceleration := 1E7, fMaxDeceleration := 1E7)"
_INSTANCES = "\n".join(f"    {name} : SM3_Basic.{block};" for name, block in BLOCKS.items())
_TABLES = "\n".join(f"    {name}Table : SM3_Basic.{table};" for name, (_, _, table) in PROFILES.items())


def _calls(names: dict[str, str], pins: str) -> str:
    return "\n".join(f"IF sSkipped <> '{name}' THEN {name}({pins}); END_IF" for name in names)


PROGRAM = f"""
PROGRAM Main
VAR
    Master : SM3_Basic.AXIS_REF_VIRTUAL_SM3 := {_AXIS};
    Axis   : SM3_Basic.AXIS_REF_VIRTUAL_SM3 := {_AXIS};
    PowerM, Power : SM3_Basic.MC_Power;
    sSkipped    : STRING; (* The block that is not called *)
    xSlaveFirst : BOOL;   (* The couplings are called before the blocks of the master *)
    xWave       : BOOL;   (* Follow is given a sine *)
    fWave       : LREAL;
{_INSTANCES}
{_TABLES}
END_VAR
Master.BeginCycle();
Axis.BeginCycle();
PowerM(Axis := Master);
Power(Axis := Axis);
IF xSlaveFirst THEN
{_calls(COUPLINGS, "Master := Master, Slave := Axis")}
END_IF
{_calls(OF_MASTER, "Axis := Master")}
IF NOT xSlaveFirst THEN
{_calls(COUPLINGS, "Master := Master, Slave := Axis")}
END_IF
IF xWave THEN
    fWave := fWave + {CYCLE};
    Follow.fSetPosition := 50.0 * SIN(3.0 * fWave);
END_IF
{_calls(RELEASES, "Slave := Axis")}
{_calls(OF_SLAVE, "Axis := Axis")}
{chr(10).join(f"{name}(Axis := Axis, {pin} := {name}Table);" for name, (_, pin, _) in PROFILES.items())}
Master.EndCycle();
Axis.EndCycle();
END_PROGRAM
"""


@cache
def _package() -> CodePackage:
    options = BuildOptions(libraries=(LibraryReference("SM3_Basic"),), level=1)
    result = build_application([Source("program", PROGRAM)], options=options, session=BuildSession())
    assert [str(d) for d in result.diagnostics if d.severity == "error"] == []
    assert result.package is not None
    return result.package


class CoupledAxes:
    """The running program; `Axis` is the slave."""

    def __init__(self, application: LoadedApplication) -> None:
        self._application = application

    def set(self, block: str, **inputs: float | bool | str) -> None:
        """Writes inputs of a block, or members of `Master` and `Axis`."""
        for name, value in inputs.items():
            self._application.write(f"Main.{block}.{name}", value)

    def write(self, name: str, value: float | bool | str) -> None:
        """Writes a variable of the program."""
        self._application.write(f"Main.{name}", value)

    def start(self, block: str, **inputs: float | bool | str) -> None:
        """Gives a block its inputs and a rising edge, and has one cycle."""
        self.set(block, **inputs, **{_EXECUTES[BLOCKS[block]]: True})
        self.cycle()

    def release(self, block: str) -> None:
        self.set(block, Execute=False)
        self.cycle()

    def cycle(self, count: int = 1) -> None:
        for _ in range(count):
            self._application.cycle()
            self._application.clock_ns += round(CYCLE * 1e9)

    def after(self, seconds: float) -> None:
        """So many cycles later."""
        self.cycle(round(seconds / CYCLE))

    def number(self, path: str) -> float:
        return float(self._application.literal(f"Main.{path}"))

    def text(self, path: str) -> str:
        return self._application.literal(f"Main.{path}")

    def outputs(self, block: str) -> set[str]:
        """Which outputs of a block are TRUE."""
        return {pin for pin in _OUTPUTS[BLOCKS[block]] if self.text(f"{block}.{pin}") == "TRUE"}

    @property
    def state(self) -> str:
        return self.text("Axis.nAxisState")

    @property
    def position(self) -> float:
        return self.number("Axis.fSetPosition")

    @property
    def velocity(self) -> float:
        return self.number("Axis.fSetVelocity")

    @property
    def master(self) -> float:
        return self.number("Master.fSetPosition")

    def until(self, block: str, output: str, at_most: float = 100.0) -> float:
        """Seconds until an output of a block is TRUE."""
        for gone in range(round(at_most / CYCLE)):
            if output in self.outputs(block):
                return gone * CYCLE
            self.cycle()
        raise AssertionError(f"{block}.{output} never came, it says {self.outputs(block)}")

    def run_master(self, velocity: float, acceleration: float = 1e6) -> None:
        """Starts the master at a velocity, at once if no acceleration is given."""
        direction = "positive" if velocity > 0 else "negative"
        self.start(
            "MasterVelocity",
            Velocity=abs(velocity),
            Acceleration=acceleration,
            Deceleration=acceleration,
            Direction={"positive": 1, "negative": -1}[direction],
        )
        self.release("MasterVelocity")


@contextmanager
def coupled_axes() -> Iterator[CoupledAxes]:
    """A fresh master and slave in standstill."""
    with loaded(_package()) as application:
        axes = CoupledAxes(application)
        for power in ("PowerM", "Power"):
            axes.set(power, Enable=True, bRegulatorOn=True, bDriveStart=True)
        axes.cycle(4)
        assert axes.state == "standstill"
        yield axes
