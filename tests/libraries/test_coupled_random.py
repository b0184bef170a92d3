"""Random commands to a master with two slaves: the PLCopen machine holds, and nothing jumps or hangs.

What is checked in every cycle is checked by the program itself, which keeps the first thing that is wrong.
"""

from __future__ import annotations

from functools import cache
from typing import Any

import pytest
from hypothesis import HealthCheck, Phase, given, settings
from hypothesis import strategies as st
from linked_application import LoadedApplication, loaded
from tests.libraries.one_axis import CYCLE

from tappet.codegen.build import BuildOptions, BuildSession, LibraryReference, build_application
from tappet.codegen.package import CodePackage
from tappet.lang.source import Source
from tappet.libraries import load
from tappet.libraries.catalog import items

AXES = ("Master", "First", "Second")
SINGLE = {
    "Absolute": "MC_MoveAbsolute",
    "Relative": "MC_MoveRelative",
    "Velocity": "MC_MoveVelocity",
    "Through": "SMC_MoveContinuousRelative",
    "Super": "MC_MoveSuperImposed",
    "HaltSuper": "MC_HaltSuperimposed",
    "Additive": "MC_MoveAdditive",
    "Override": "MC_SetOverride",
    "Place": "MC_SetPosition",
    "Halt": "MC_Halt",
    "Stop": "MC_Stop",
    "Reset": "MC_Reset",
}
OF_SLAVE = {
    "Gear": "MC_GearIn",
    "GearPos": "MC_GearInPos",
    "Phasing": "MC_PhasingRelative",
    "PhasingTo": "MC_PhasingAbsolute",
    "Backlash": "SMC_BacklashCompensation",
}
BLOCKS = {f"{axis}{name}": block for axis in AXES for name, block in SINGLE.items()}
COUPLINGS = {f"{axis}{name}": block for axis in AXES[1:] for name, block in OF_SLAVE.items()}
COMBINATIONS = {f"{axis}Combine": "MC_CombineAxes" for axis in AXES[1:]}
PROFILES = {f"{axis}Positions": "MC_PositionProfile" for axis in AXES}
RELEASES = {f"{axis}Out": "MC_GearOut" for axis in AXES[1:]}
ALL = BLOCKS | COUPLINGS | COMBINATIONS | PROFILES | RELEASES
_ITEMS = {item.name: item for item in items(load("SM3_Basic"))}
_EXECUTE = {name: _ITEMS[block].inputs[0].name for name, block in ALL.items()}
_STEEPEST = 8_000.0
"""What the position may differ from that of the mean velocity, as an acceleration."""


def _exclusive(name: str, block: str) -> str:
    outputs = {pin.name for pin in _ITEMS[block].outputs if pin.type == "BOOL"}
    ends = [pin for pin in ("Done", "CommandAborted", "bCommandAborted", "Error", "bError") if pin in outputs]
    busy = "bBusy" if "bBusy" in outputs else "Busy"
    holds = block in ("MC_Stop", "MC_GearOut")
    pairs = [(a, b) for number, a in enumerate(ends) for b in ends[number + 1 :]]
    pairs += [(busy, end) for end in ends if not (holds and end == "Done")]
    wrong = " OR ".join(f"({name}.{a} AND {name}.{b})" for a, b in pairs)
    return f"IF sWrong = '' AND ({wrong}) THEN sWrong := '{name} says two things'; END_IF"


def _watched(axis: str) -> str:
    return f"""
IF {axis}Place.Done AND NOT x{axis}Placed THEN
    f{axis}Position := f{axis}Position + {axis}Place.Position;
END_IF
x{axis}Placed := {axis}Place.Done;
fMean := {CYCLE / 2} * ({axis}.fSetVelocity + f{axis}Velocity);
IF iSteps = 0 AND sWrong = ''
    AND NOT (ABS({axis}.fSetPosition - f{axis}Position - fMean) < {_STEEPEST * CYCLE**2})
THEN
    sWrong := '{axis} jumps';
END_IF
IF sWrong = '' AND {axis}.nAxisState = SM3_Basic.SMC_AXIS_STATE.standstill AND {axis}.fSetVelocity <> 0.0 THEN
    sWrong := '{axis} moves in standstill';
END_IF
f{axis}Position := {axis}.fSetPosition;
f{axis}Velocity := {axis}.fSetVelocity;"""


def _steps(name: str) -> str:
    """MC_CombineAxes gives a slave the velocity of its masters at once, and those behind it as well."""
    return f"""
IF ({name}.Execute AND NOT x{name}Execute) OR ({name}.Active AND NOT x{name}Active) THEN
    iSteps := 3; (* From the edge or the end of the command before it *)
END_IF
x{name}Execute := {name}.Execute;
x{name}Active := {name}.Active;"""


_AXIS = f"(fTaskCycle := {CYCLE}, fMaxVelocity := 1E9, fMaxAcceleration := 1E12, fMaxDeceleration := 1E12)"
PROGRAM = "\n".join(
    [
        "PROGRAM Main\nVAR\n    sWrong : STRING; fMean : LREAL; iSteps : INT;",
        "    Table : SM3_Basic.MC_TP_REF := (Number_of_pairs := 2, IsAbsolute := FALSE,",
        "        MC_TP_Array := [(delta_time := T#300ms, position := 4.0), (delta_time := T#300ms)]);",
        *(f"    x{name}Execute, x{name}Active : BOOL;" for name in COMBINATIONS),
        *(f"    {axis} : SM3_Basic.AXIS_REF_VIRTUAL_SM3 := {_AXIS};" for axis in AXES),
        *(
            f"    {axis}Power : SM3_Basic.MC_Power; x{axis}Placed : BOOL;"
            f" f{axis}Position, f{axis}Velocity : LREAL;"
            for axis in AXES
        ),
        *(f"    {name} : SM3_Basic.{block};" for name, block in ALL.items()),
        "END_VAR",
        *(f"{axis}.BeginCycle();" for axis in AXES),
        *(f"{a}Power(Axis := {a}, Enable := TRUE, bRegulatorOn := TRUE, bDriveStart := TRUE);" for a in AXES),
        *(f"{axis}{name}(Axis := {axis});" for axis in AXES for name in SINGLE),
        *(f"First{name}(Master := Master, Slave := First);" for name in OF_SLAVE),
        *(f"Second{name}(Master := First, Slave := Second);" for name in OF_SLAVE),
        "FirstCombine(Master1 := Master, Master2 := Master, Slave := First);",
        "SecondCombine(Master1 := Master, Master2 := First, Slave := Second);",
        *(f"{name}(Axis := {name.removesuffix('Positions')}, TimePosition := Table);" for name in PROFILES),
        *(f"{axis}Out(Slave := {axis});" for axis in AXES[1:]),
        *(f"{axis}.EndCycle();" for axis in AXES),
        *(_exclusive(name, block) for name, block in ALL.items()),
        "iSteps := MAX(0, iSteps - 1);",
        *(_steps(name) for name in COMBINATIONS),
        *(_watched(axis) for axis in AXES),
        "END_PROGRAM\n",
    ]
)
COMMON = {"Acceleration": 400.0, "Deceleration": 400.0}


@cache
def _package() -> CodePackage:
    options = BuildOptions(libraries=(LibraryReference("SM3_Basic"),), level=1)
    result = build_application([Source("program", PROGRAM)], options=options, session=BuildSession())
    assert [str(d) for d in result.diagnostics if d.severity == "error"] == []
    assert result.package is not None
    return result.package


class Axes:
    """The running program."""

    def __init__(self, application: LoadedApplication) -> None:
        self._application = application
        self.cycle(4)

    def set(self, name: str, **values: Any) -> None:
        for pin, value in values.items():
            self._application.write(f"Main.{name}.{pin}", value)

    def cycle(self, count: int) -> None:
        for _ in range(count):
            self._application.cycle()
            self._application.clock_ns += round(CYCLE * 1e9)
            if (wrong := self._application.literal("Main.sWrong")) != "''":
                raise AssertionError(wrong)

    def text(self, path: str) -> str:
        return self._application.literal(f"Main.{path}")

    def busy(self) -> list[str]:
        pins = {name: "bBusy" if _EXECUTE[name] == "bExecute" else "Busy" for name in ALL}
        return [name for name, pin in pins.items() if self.text(f"{name}.{pin}") == "TRUE"]


velocities = st.floats(1.0, 100.0)
distances = st.floats(-300.0, 300.0)


@st.composite
def commands(draw: st.DrawFn) -> tuple[str, dict[str, Any], int, bool]:
    """A block with its inputs, the cycles it gets, and whether its Execute is taken back then."""
    name = draw(st.sampled_from(sorted(set(ALL) - {f"{axis}Stop" for axis in AXES})))
    pins = {pin.name for pin in _ITEMS[ALL[name]].inputs}
    values: dict[str, Any] = {pin: value for pin, value in COMMON.items() if pin in pins}
    for pin in ("Velocity", "VelocityDiff", "EndVelocity", "fCompensationVel"):
        if pin in pins:
            values[pin] = draw(velocities)
    for pin in ("Position", "Distance", "PhaseShift", "MasterSyncPosition", "SlaveSyncPosition"):
        if pin in pins:
            values[pin] = draw(distances)
    for pin in ("Direction", "EndVelocityDirection"):
        if pin in pins:
            values[pin] = draw(st.sampled_from((-1, 1, 2)))
    if "Jerk" in pins:
        values["Jerk"] = draw(st.sampled_from((0.0, 4000.0)))
    if "BufferMode" in pins:
        values["BufferMode"] = draw(st.sampled_from((0, 0, 0, 1, 2, 5)))
    if "RatioNumerator" in pins:
        values |= {"RatioNumerator": draw(st.integers(-3, 3)), "RatioDenominator": draw(st.integers(1, 3))}
    if "MasterStartDistance" in pins:
        values["MasterStartDistance"] = draw(st.sampled_from((50.0, 80.0, -50.0)))
    if "VelFactor" in pins:
        values = {
            "VelFactor": draw(st.sampled_from((0.0, 0.3, 1.0))),
            "AccFactor": draw(st.sampled_from((0.5, 1.0))),
        }
    if "Mode" in pins:
        values["Mode"] = True
    if "ArraySize" in pins:
        values["ArraySize"] = 2
    if "GearRatioNumeratorM1" in pins:
        values |= {f"GearRatioNumeratorM{master}": draw(st.integers(-2, 2)) for master in (1, 2)}
        values["CombineMode"] = draw(st.sampled_from((0, 1)))
    if "fBacklash" in pins:
        values |= {"fBacklash": 2.0, "fCompensationAcc": 400.0, "fCompensationDec": 400.0}
    return name, values, draw(st.sampled_from((1, 2, 30, 200, 700))), draw(st.booleans())


def _run(steps: list[tuple[str, dict[str, Any], int, bool]], ramp: int) -> None:
    with loaded(_package()) as application:
        axes = Axes(application)
        for axis in AXES:
            axes.set(axis, eRampType=ramp, fSWMaxDeceleration=1000.0)
        for name, values, cycles, released in steps:
            if axes.text(f"{name}.{_EXECUTE[name]}") == "TRUE":
                axes.set(name, **{_EXECUTE[name]: False})
                axes.cycle(1)
            axes.set(name, **values, **{_EXECUTE[name]: True})
            axes.cycle(cycles)
            if released:
                axes.set(name, **{_EXECUTE[name]: False})
        _bring_to_rest(axes)


def _bring_to_rest(axes: Axes) -> None:
    """Every axis comes to standstill when it is told to, and no block waits any more."""
    for name in ALL:
        axes.set(name, **{_EXECUTE[name]: False})
    axes.cycle(2)
    for axis in AXES:  # A master first: that it turns may be an error of its slave
        axes.cycle(2000)
        axes.set(f"{axis}Reset", Execute=axes.text(f"{axis}.nAxisState") == "errorstop")
        axes.cycle(20)
        axes.set(f"{axis}Stop", Execute=True, Deceleration=1000.0)
    axes.cycle(3000)
    assert axes.busy() == [f"{axis}Stop" for axis in AXES]
    for axis in AXES:
        axes.set(f"{axis}Stop", Execute=False)
        axes.set(f"{axis}Reset", Execute=False)
    axes.cycle(3)
    assert [axes.text(f"{axis}.nAxisState") for axis in AXES] == ["standstill"] * 3
    assert axes.busy() == []


FEW = settings(
    max_examples=15,
    deadline=None,
    derandomize=True,
    phases=(Phase.explicit, Phase.reuse, Phase.generate, Phase.shrink),
    suppress_health_check=[HealthCheck.too_slow],
)


@FEW
@given(steps=st.lists(commands(), min_size=3, max_size=20), ramp=st.sampled_from((0, 1, 2, 3)))
def test_random_commands_to_a_master_with_two_slaves(steps: list[Any], ramp: int) -> None:
    _run(steps, ramp)


@pytest.mark.slow
@settings(FEW, max_examples=600, derandomize=False)
@given(steps=st.lists(commands(), min_size=3, max_size=40), ramp=st.sampled_from((0, 1, 2, 3)))
def test_many_random_commands_to_a_master_with_two_slaves(steps: list[Any], ramp: int) -> None:
    _run(steps, ramp)
