"""A virtual axis with two of each function block, moved cycle by cycle by what a test gives them."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import cache

from linked_application import LoadedApplication, loaded

from tappet.codegen.build import BuildOptions, BuildSession, LibraryReference, build_application
from tappet.codegen.package import CodePackage
from tappet.lang.source import Source

CYCLE = 0.001
BLOCKS = {
    "Absolute": "MC_MoveAbsolute",
    "Relative": "MC_MoveRelative",
    "Additive": "MC_MoveAdditive",
    "Velocity": "MC_MoveVelocity",
    "Halt": "MC_Halt",
    "Stop": "MC_Stop",
    "Reset": "MC_Reset",
    "SetPosition": "MC_SetPosition",
    "Super": "MC_MoveSuperImposed",
    "HaltSuper": "MC_HaltSuperimposed",
}
READERS = {
    "Status": ("MC_ReadStatus", "Enable"),
    "AxisError": ("MC_ReadAxisError", "Enable"),
    "FBError": ("SMC_ReadFBError", "bEnable"),
    "Actual": ("MC_ReadActualPosition", "Enable"),
    "SetValue": ("SMC_ReadSetPosition", "Enable"),
}

TWO_CYCLES = 2 * CYCLE + 1e-9
RAMP = {"Velocity": 100.0, "Acceleration": 100.0, "Deceleration": 100.0}
STATES = (
    *("power_off", "errorstop", "stopping", "standstill"),
    *("discrete_motion", "continuous_motion", "synchronized_motion", "homing"),
)

_INSTANCES = "\n".join(f"    {name}1, {name}2 : SM3_Basic.{block};" for name, block in BLOCKS.items())
_READERS = "\n".join(f"    {name} : SM3_Basic.{block};" for name, (block, _) in READERS.items())
_CALLS = "\n".join(
    f"IF sSkipped <> '{name}{number}' THEN {name}{number}(Axis := Axis); END_IF"
    for name in BLOCKS
    for number in (1, 2)
)
_READS = "\n".join(f"{name}(Axis := Axis, {enable} := xReads);" for name, (_, enable) in READERS.items())
PROGRAM = f"""
PROGRAM Main
VAR
    Axis     : SM3_Basic.AXIS_REF_VIRTUAL_SM3 := (
        fTaskCycle := {CYCLE}, fMaxVelocity := 1E5, fMaxAcceleration := 1E6, fMaxDeceleration := 1E6);
    Power    : SM3_Basic.MC_Power;
    Override : SM3_Basic.MC_SetOverride;
    sSkipped : STRING; (* The block that is not called *)
    xReads   : BOOL := TRUE;
    xClears  : BOOL;
    xStopsBus : BOOL; (* The axis gets no bus cycles *)
    diApart : DINT;   (* From one instance to another in the memory *)
{_INSTANCES}
{_READERS}
END_VAR
IF NOT xStopsBus THEN Axis.BeginCycle(); END_IF
Power(Axis := Axis);
Override(Axis := Axis);
{_CALLS}
IF xClears THEN
    xClears := SM3_Basic.SMC_ClearFBError(ADR(Axis));
END_IF
{_READS}
diApart := LINT_TO_DINT(LWORD_TO_LINT(ADR(Velocity1)) - LWORD_TO_LINT(ADR(Absolute1)));
IF NOT xStopsBus THEN Axis.EndCycle(); END_IF
END_PROGRAM
"""


@cache
def _package() -> CodePackage:
    options = BuildOptions(libraries=(LibraryReference("SM3_Basic"),), level=1)
    result = build_application([Source("program", PROGRAM)], options=options, session=BuildSession())
    assert [str(d) for d in result.diagnostics if d.severity == "error"] == []
    assert result.package is not None
    return result.package


class OneAxis:
    """The running program."""

    def __init__(self, application: LoadedApplication) -> None:
        self._application = application
        self.cycles_gone = 0

    def set(self, block: str, **inputs: float | bool | str) -> None:
        """Writes inputs of a block, or members of `Axis`."""
        for name, value in inputs.items():
            self._application.write(f"Main.{block}.{name}", value)

    def write(self, name: str, value: float | bool | str) -> None:
        """Writes a variable of the program."""
        self._application.write(f"Main.{name}", value)

    def start(self, block: str, **inputs: float | bool | str) -> None:
        """Gives a block its inputs and a rising edge, and has one cycle."""
        self.set(block, **inputs, Execute=True)
        self.cycle()

    def cycle(self, count: int = 1) -> None:
        for _ in range(count):
            self._application.cycle()
            self._application.clock_ns += round(CYCLE * 1e9)
        self.cycles_gone += count

    def after(self, seconds: float) -> None:
        """So many cycles later."""
        self.cycle(round(seconds / CYCLE))

    def number(self, path: str) -> float:
        return float(self._application.literal(f"Main.{path}"))

    def says(self, block: str, *outputs: str) -> set[str]:
        """Those of the outputs that are TRUE."""
        return {name for name in outputs if self._application.literal(f"Main.{block}.{name}") == "TRUE"}

    def outputs(self, block: str) -> set[str]:
        """Which outputs of an Execute block are TRUE."""
        last = "InVelocity" if block.startswith("Velocity") else "Done"
        names = [last, "Busy", "Error"]
        if not block.startswith(("Reset", "SetPosition")):
            names.append("CommandAborted")
        if block.startswith(("Absolute", "Relative", "Additive", "Velocity")):
            names.append("Active")
        return self.says(block, *names)

    def text(self, path: str) -> str:
        return self._application.literal(f"Main.{path}")

    @property
    def state(self) -> str:
        return self.text("Axis.nAxisState")

    @property
    def position(self) -> float:
        return self.number("Axis.fSetPosition")

    @property
    def velocity(self) -> float:
        return self.number("Axis.fSetVelocity")

    def until(self, condition: Callable[[], bool], at_most: float = 200.0) -> float:
        """Seconds until a condition holds."""
        first = self.cycles_gone
        while not condition():
            assert (self.cycles_gone - first) * CYCLE < at_most, "it never came"
            self.cycle()
        return (self.cycles_gone - first) * CYCLE

    def until_done(self, block: str, at_most: float = 200.0) -> float:
        return self.until(lambda: "Done" in self.outputs(block), at_most)

    def power(self, on: bool = True) -> None:
        self.set("Power", Enable=True, bRegulatorOn=on, bDriveStart=on)
        self.cycle(3)


@contextmanager
def one_axis(power: bool = True) -> Iterator[OneAxis]:
    """A fresh axis, in standstill if it has power."""
    with loaded(_package()) as application:
        axis = OneAxis(application)
        axis.cycle()
        if power:
            axis.power()
            assert axis.state == "standstill"
        yield axis


def start(axis: OneAxis, block: str) -> None:
    """With inputs that suit every axis."""
    inputs: dict[str, float] = dict(RAMP)
    if block.startswith(("Halt", "Stop")):
        inputs = {"Deceleration": 100.0}
    if block.startswith("Absolute"):
        inputs["Position"] = axis.position + 1000.0
    if block.startswith(("Relative", "Additive")):
        inputs["Distance"] = 1000.0
    axis.start(block, **inputs)


def bring(axis: OneAxis, state: str) -> None:
    """The axis into a state."""
    if state == "power_off":
        axis.power(on=False)
    elif state == "errorstop":
        start(axis, "Velocity2")
        axis.write("sSkipped", "Velocity2")
        axis.cycle(2)
        axis.write("sSkipped", "")
        axis.set("Velocity2", Execute=False)
        axis.cycle(2)
    elif state == "stopping":
        start(axis, "Velocity2")
        axis.set("Velocity2", Execute=False)
        axis.after(0.5)
        start(axis, "Stop2")
    elif state == "discrete_motion":
        start(axis, "Absolute2")
        axis.after(0.1)
    elif state == "continuous_motion":
        start(axis, "Velocity2")
        axis.after(0.1)
    assert axis.state == state
