"""A machine of up to six virtual axes with a kinematics, a belt, a rotary table and a second group."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from functools import cache
from typing import Any

from linked_application import loaded
from tests.libraries.axis_group import CYCLE, AxisGroup

from tappet.codegen.build import BuildOptions, BuildSession, LibraryReference, build_application
from tappet.codegen.package import CodePackage
from tappet.lang.source import Source

LIMITS = {"fSWMaxVelocity": 2e3, "fSWMaxAcceleration": 1e4, "fSWMaxDeceleration": 1e4, "fSWMaxJerk": 1e6}
_SIMPLE = {
    **{f"Linear{number}": "MC_MoveLinearAbsolute" for number in range(1, 4)},
    "Relative": "MC_MoveLinearRelative",
    "Circular": "MC_MoveCircularAbsolute",
    "Direct": "MC_MoveDirectAbsolute",
    "Halt": "MC_GroupHalt",
    "Stop": "MC_GroupStop",
    "Wait": "SMC_GroupWait",
    "Enable": "MC_GroupEnable",
    "Disable": "MC_GroupDisable",
    "Reset": "MC_GroupReset",
    "Frame": "MC_SetCoordinateTransform",
    "SetKin": "MC_SetKinTransform",
    "ReadKin": "MC_ReadKinTransform",
    "SetValue": "SMC_GroupReadSetPosition",
    "Actual": "MC_GroupReadActualPosition",
    "ActualVelocity": "MC_GroupReadActualVelocity",
    "Override": "MC_GroupSetOverride",
    "Power": "SMC_GroupPower",
}
_SPECIAL = {
    "Interrupt": ("MC_GroupInterrupt", "ContinueData := Data"),
    "GoOn": ("MC_GroupContinue", "ContinueData := Data"),
    "Belted": ("MC_TrackConveyorBelt", "ConveyorBelt := Belt"),
    "Tabled": ("MC_TrackRotaryTable", "RotaryTable := Table"),
    "Attached": ("MC_SetDynCoordTransform", "MasterAxisGroup := Carrier"),
    "Select": ("MC_PathSelect", "PathData := Path, PathDescription := Description"),
    "MovePath": ("MC_MovePath", "PathData := Path"),
    "SyncGroup": ("MC_SyncGroupToAxis", "Master := Belt, PathData := Path"),
    "SyncAxis": ("MC_SyncAxisToGroup", "SlaveAxis := Feed"),
}
_OTHERS = ("Belt", "Table", "Feed", "CX", "CY")


def _program(axes: int, kinematics: str, jerk: float) -> str:
    limits = {**LIMITS, "fSWMaxJerk": jerk}
    virtual = (
        "SM3_Basic.AXIS_REF_VIRTUAL_SM3 := (fTaskCycle := "
        + f"{CYCLE}, fMaxVelocity := 1E5, fMaxAcceleration := 1E6, fMaxDeceleration := 1E6, "
        + ", ".join(f"{name} := {value}" for name, value in limits.items())
        + ")"
    )
    names = [f"A{index}" for index in range(axes)]
    every = [*names, *_OTHERS]
    lines = ["PROGRAM Main", "VAR"]
    lines += [f"    {name} : {virtual};" for name in every]
    lines += [f"    Add{name} : SM3_AxisGroup.MC_AddAxisToGroup;" for name in (*names, "CX", "CY")]
    lines += [f"    {name} : SM3_AxisGroup.{block};" for name, block in _SIMPLE.items()]
    lines += [f"    {name} : SM3_AxisGroup.{block};" for name, (block, _) in _SPECIAL.items()]
    lines += [
        "    Group, Carrier : SM3_AxisGroup.AXIS_GROUP_REF_SM3;",
        "    Data : SM3_AxisGroup.SMC_AXIS_GROUP_CONTINUE_DATA;",
        "    Path : SM3_AxisGroup.MC_PATH_DATA_REF;",
        "    Description : SM3_AxisGroup.MC_PATH_REF;",
        "    CarrierEnable : SM3_AxisGroup.MC_GroupEnable;",
        "    CarrierMove : SM3_AxisGroup.MC_MoveLinearAbsolute;",
        "    BeltMove : SM3_Basic.MC_MoveVelocity;",
        "    TableMove : SM3_Basic.MC_MoveVelocity;",
        "    Single : SM3_Basic.MC_MoveAbsolute;",
        *[f"    Power{name} : SM3_Basic.MC_Power;" for name in _OTHERS],
        f"    Machine : {kinematics};" if kinematics else "    Machine : INT;",
        "    xKinematics : BOOL; (* The machine is the kinematics *)",
        "END_VAR",
        *[f"{name}.BeginCycle();" for name in every],
        *[f"Power{name}(Axis := {name});" for name in _OTHERS],
        *[f"Add{name}(AxisGroup := Group, Axis := {name});" for name in names],
        *[f"Add{name}(AxisGroup := Carrier, Axis := {name});" for name in ("CX", "CY")],
        "BeltMove(Axis := Belt);",
        "TableMove(Axis := Table);",
        "CarrierEnable(AxisGroup := Carrier);",
        "CarrierMove(AxisGroup := Carrier);",
        "Single(Axis := A0);",
    ]
    if kinematics:
        lines += ["IF xKinematics THEN", "    SetKin.KinTransform := Machine;", "END_IF"]
    lines += [f"{name}(AxisGroup := Group);" for name in _SIMPLE]
    lines += [f"{name}(AxisGroup := Group, {pins});" for name, (_, pins) in _SPECIAL.items()]
    lines += [f"{name}.EndCycle();" for name in every]
    return "\n".join([*lines, "END_PROGRAM", ""])


@cache
def _package(axes: int, kinematics: str, jerk: float) -> CodePackage:
    libraries = tuple(
        LibraryReference(name)
        for name in ("SM3_Basic", "SM3_AxisGroup", "SM3_Transformation", "SM3_Kinematics")
    )
    options = BuildOptions(libraries=libraries, level=1)
    source = Source("program", _program(axes, kinematics, jerk))
    result = build_application([source], options=options, session=BuildSession())
    assert [str(d) for d in result.diagnostics if d.severity == "error"] == []
    assert result.package is not None
    return result.package


class Machine(AxisGroup):
    """The running machine."""

    def outputs(self, block: str) -> set[str]:
        """Which of the outputs of a command are TRUE."""
        names = ("Done", "Busy", "Active", "CommandAborted", "Error", "InSync")
        return {name for name in names if self._says(block, name)}

    def _says(self, block: str, name: str) -> bool:
        try:
            return self.text(f"{block}.{name}") == "TRUE"
        except (KeyError, ValueError):
            return False

    def place(self, variable: str, **members: float) -> None:
        """Members of a place and orientation."""
        for name, value in members.items():
            self.write(f"{variable}.{name}", value)

    def element(self, index: int, **members: Any) -> None:
        """An element of the described path."""
        for name, value in members.items():
            path = f"Description.aElements[{index}].{name}"
            if isinstance(value, tuple):
                for at, coordinate in enumerate(value):
                    self.write(f"{path}.a[{at}]", float(coordinate))
            else:
                self.write(path, value)

    def run_axis(self, block: str, velocity: float, acceleration: float = 1e3) -> None:
        """Has the belt or table run at a velocity."""
        self.give(
            block, Velocity=abs(velocity), Acceleration=acceleration, Deceleration=acceleration, Jerk=0.0
        )
        self.put(block, Direction="negative" if velocity < 0 else "positive")
        self.cycle()
        self.put(block, Execute=False)

    def coordinates(self, system: int) -> list[float]:
        """The set position in a coordinate system."""
        self.put("SetValue", Enable=True, CoordSystem=system)
        self.cycle()
        assert self.flag("SetValue.Valid"), self.error("SetValue")
        return [self.number(f"SetValue.Position.a[{index}]") for index in range(6)]


@contextmanager
def machine(
    axes: int, kinematics: str = "", start: tuple[float, ...] = (), jerk: float = 1e6
) -> Iterator[Machine]:
    """A fresh group with power in GroupStandby, with its axes at a start and the kinematics set."""
    with loaded(_package(axes, kinematics, jerk)) as application:
        names = tuple(f"A{index}" for index in range(axes))
        group = Machine(application, names)
        group.cycle()
        for axis in (*names, "CX", "CY"):
            group.start(f"Add{axis}")
        for other in _OTHERS:
            group.put(f"Power{other}", Enable=True, bRegulatorOn=True, bDriveStart=True)
        group.power()
        if kinematics:
            group.write("xKinematics", True)
            group.start("SetKin")
            assert group.outputs("SetKin") == {"Done"}, group.error("SetKin")
        group.start("Enable")
        group.start("CarrierEnable")
        group.cycle()
        assert group.state == "GroupStandby"
        if start:
            group.give("Direct", Position=start, CoordSystem=0)
            group.until_done("Direct")
            group.put("Direct", Execute=False)
            group.cycle(2)
        yield group
