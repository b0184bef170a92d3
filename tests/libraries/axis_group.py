"""Three virtual axes in a group with blocks of SM3_AxisGroup, moved by what a test gives them."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import cache

import numpy as np
from linked_application import LoadedApplication, loaded

from tappet.codegen.build import BuildOptions, BuildSession, LibraryReference, build_application
from tappet.codegen.package import CodePackage
from tappet.lang.source import Source

CYCLE = 0.004
AXES = ("X", "Y", "Z")
BLOCKS = {
    **{f"Linear{number}": "MC_MoveLinearAbsolute" for number in range(1, 5)},
    **{f"Relative{number}": "MC_MoveLinearRelative" for number in (1, 2)},
    **{f"Circular{number}": "MC_MoveCircularAbsolute" for number in (1, 2)},
    "CircularRelative": "MC_MoveCircularRelative",
    **{f"Direct{number}": "MC_MoveDirectAbsolute" for number in (1, 2)},
    "DirectRelative": "MC_MoveDirectRelative",
    "Wait": "SMC_GroupWait",
    "Halt": "MC_GroupHalt",
    **{f"Stop{number}": "MC_GroupStop" for number in (1, 2)},
    "Enable": "MC_GroupEnable",
    "Disable": "MC_GroupDisable",
    "Reset": "MC_GroupReset",
    "Ungroup": "MC_UngroupAllAxes",
    "Remove": "MC_RemoveAxisFromGroup",
    "Home": "MC_GroupHome",
    "SetPosition": "MC_GroupSetPosition",
    "Frame": "MC_SetCoordinateTransform",
    "Cartesian": "MC_SetCartesianTransform",
}
CONTINUING = {
    "Interrupt1": "MC_GroupInterrupt",
    "Interrupt2": "MC_GroupInterrupt",
    "GoOn": "MC_GroupContinue",
}
READERS = {
    "Status": "MC_GroupReadStatus",
    "GroupError": "MC_GroupReadError",
    "Configuration": "MC_GroupReadConfiguration",
    "Actual": "MC_GroupReadActualPosition",
    "SetValue": "SMC_GroupReadSetPosition",
    "ActualVelocity": "MC_GroupReadActualVelocity",
    "ActualAcceleration": "MC_GroupReadActualAcceleration",
    "ReadFrame": "MC_ReadCoordinateTransform",
    "ReadCartesian": "MC_ReadCartesianTransform",
    "Override": "MC_GroupSetOverride",
    "Power": "SMC_GroupPower",
}
SINGLE = {"Single": "MC_MoveAbsolute", "SingleBuffered": "MC_MoveAbsolute", "Fault": "MC_MoveVelocity"}
STATES = (
    *("GroupDisabled", "GroupStandby", "GroupMoving"),
    *("GroupStopping", "GroupHoming", "GroupErrorStop"),
)
ERRORS = {
    "POWER": 20,
    "LIMITS": 10,
    "WRONG_STATE": 10003,
    "SINGLE_AXIS": 10004,
    "OVERRIDE": 10006,
    "IN_GROUP": 10040,
    "INDEX": 10041,
    "EMPTY": 10042,
    "VALUES": 10043,
    "FULL": 10044,
    "TOO_SHORT": 10045,
    "CIRCLE": 10046,
    "NOT_INTERRUPTED": 10047,
    "MASTER_IS_SLAVE": 10007,
    "IN_USE": 10005,
    "UNREACHABLE": 10049,
    "SINGULAR": 10050,
    "NUMBER_OF_AXES": 10051,
    "PATH": 10052,
}

_AXIS = (
    f"(fTaskCycle := {CYCLE}, fMaxVelocity := 1E5, fSWMaxVelocity := 1E4, fMaxAcceleration := 1E6, "
    "fMaxDeceleration := 1E6, fSWMaxAcceleration := 1E4, fSWMaxDeceleration := 1E4)"
)


def _instances(blocks: dict[str, str], library: str) -> str:
    return "\n".join(f"    {name} : {library}.{block};" for name, block in blocks.items())


def _calls(blocks: dict[str, str], pins: str) -> str:
    return "\n".join(f"{name}({pins});" for name in blocks)


PROGRAM = f"""
PROGRAM Main
VAR
    X, Y, Z : SM3_Basic.AXIS_REF_VIRTUAL_SM3 := {_AXIS};
    Other   : SM3_Basic.AXIS_REF_VIRTUAL_SM3 := {_AXIS};
    Group   : SM3_AxisGroup.AXIS_GROUP_REF_SM3;
    OtherGroup : SM3_AxisGroup.AXIS_GROUP_REF_SM3;
    AddX, AddY, AddZ, AddOther, AddElsewhere : SM3_AxisGroup.MC_AddAxisToGroup;
    Data    : SM3_AxisGroup.SMC_AXIS_GROUP_CONTINUE_DATA;
    xPowers : BOOL := TRUE; (* Power is called *)
{_instances(BLOCKS | CONTINUING | READERS, "SM3_AxisGroup")}
{_instances(SINGLE, "SM3_Basic")}
END_VAR
X.BeginCycle();
Y.BeginCycle();
Z.BeginCycle();
Other.BeginCycle();
AddX(AxisGroup := Group, Axis := X);
AddY(AxisGroup := Group, Axis := Y);
AddZ(AxisGroup := Group, Axis := Z);
AddOther(AxisGroup := Group, Axis := Other);
AddElsewhere(AxisGroup := OtherGroup, Axis := X);
{_calls(BLOCKS | {name: block for name, block in READERS.items() if name != "Power"}, "AxisGroup := Group")}
{_calls(CONTINUING, "AxisGroup := Group, ContinueData := Data")}
IF xPowers THEN
    Power(AxisGroup := Group);
END_IF
{_calls(SINGLE, "Axis := Y")}
X.EndCycle();
Y.EndCycle();
Z.EndCycle();
Other.EndCycle();
END_PROGRAM
"""


@cache
def _package() -> CodePackage:
    libraries = (LibraryReference("SM3_Basic"), LibraryReference("SM3_AxisGroup"))
    options = BuildOptions(libraries=libraries, level=1)
    result = build_application([Source("program", PROGRAM)], options=options, session=BuildSession())
    assert [str(d) for d in result.diagnostics if d.severity == "error"] == []
    assert result.package is not None
    return result.package


class AxisGroup:
    """The running program."""

    def __init__(self, application: LoadedApplication, axes: tuple[str, ...] = AXES) -> None:
        self._application = application
        self.axes = axes
        self.cycles = 0

    def put(self, block: str, **inputs: object) -> None:
        """Writes inputs of a block, arrays by their elements from 0 on, or members of a variable."""
        for name, value in inputs.items():
            if isinstance(value, (list, tuple)):
                path = f"{name}.a" if name in ("Position", "Distance", "AuxPoint", "EndPoint") else name
                for index, element in enumerate(value):
                    self._application.write(f"Main.{block}.{path}[{index}]", float(element))
            else:
                assert isinstance(value, (bool, int, float, str))
                self._application.write(f"Main.{block}.{name}", value)

    def write(self, name: str, value: float | bool | str) -> None:
        self._application.write(f"Main.{name}", value)

    def give(self, block: str, **inputs: object) -> None:
        """Inputs of a block and Execute, for the next cycle."""
        self.put(block, **inputs, Execute=True)

    def start(self, block: str, **inputs: object) -> None:
        """Gives a block its inputs and a rising edge, and has one cycle; Execute goes then."""
        self.give(block, **inputs)
        self.cycle()
        self.put(block, Execute=False)

    def cycle(self, count: int = 1) -> None:
        for _ in range(count):
            self._application.cycle()
            self._application.clock_ns += round(CYCLE * 1e9)
        self.cycles += count

    def after(self, seconds: float) -> None:
        """So many cycles later."""
        self.cycle(round(seconds / CYCLE))

    @property
    def acceleration(self) -> np.ndarray:
        return np.array([self.number(f"{axis}.fSetAcceleration") for axis in self.axes])

    def text(self, path: str) -> str:
        return self._application.literal(f"Main.{path}")

    def number(self, path: str) -> float:
        value = self._application.read(f"Main.{path}")
        assert isinstance(value, (int, float))
        return float(value)

    def outputs(self, block: str) -> set[str]:
        """Which outputs of an Execute block are TRUE."""
        names = ["Done", "Busy", "Error"]
        kind = (BLOCKS | CONTINUING)[block]
        if kind.startswith(("MC_Move", "SMC_GroupWait", "MC_GroupHalt", "MC_GroupStop", "MC_GroupHome")):
            names += ["Active", "CommandAborted"]
        elif kind in CONTINUING.values():
            names += ["CommandAborted"]
        return {name for name in names if self.text(f"{block}.{name}") == "TRUE"}

    def error(self, block: str) -> int:
        return int(self.number(f"{block}.ErrorID"))

    @property
    def state(self) -> str:
        return self.text("Group.eState")

    @property
    def position(self) -> np.ndarray:
        return np.array([self.number(f"{axis}.fSetPosition") for axis in self.axes])

    @property
    def velocity(self) -> np.ndarray:
        return np.array([self.number(f"{axis}.fSetVelocity") for axis in self.axes])

    @property
    def path_velocity(self) -> float:
        return self.number("Group.fPathVelocity")

    @property
    def path_acceleration(self) -> float:
        return self.number("Group.fPathAcceleration")

    def done(self, block: str) -> bool:
        return bool(self._application.read(f"Main.{block}.Done"))

    def flag(self, path: str) -> bool:
        return bool(self._application.read(f"Main.{path}"))

    def until_done(self, block: str, at_most: float = 300.0) -> float:
        """Seconds until a block has its end; the cycle that says so comes one later."""
        return self.until(lambda: self.done(block), at_most) - CYCLE

    def until(self, condition: Callable[[], bool], at_most: float = 300.0) -> float:
        """Seconds until a condition holds."""
        first = self.cycles
        while not condition():
            assert (self.cycles - first) * CYCLE < at_most, "it never came"
            self.cycle()
        return (self.cycles - first) * CYCLE

    def power(self, on: bool = True) -> None:
        self.put("Power", Enable=True, bRegulatorOn=on, bDriveStart=on)
        self.cycle(3)


@contextmanager
def axis_group(enabled: bool = True) -> Iterator[AxisGroup]:
    """A fresh group of three axes with power, in GroupStandby if it is enabled."""
    with loaded(_package()) as application:
        group = AxisGroup(application)
        group.cycle()
        for axis in AXES:
            group.start(f"Add{axis}")
        group.power()
        if enabled:
            group.start("Enable")
            group.cycle()
            assert group.state == "GroupStandby"
        yield group
