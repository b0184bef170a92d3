"""A program with one of each function block that takes an axis, made from the library itself."""

from __future__ import annotations

import math
from collections.abc import Iterator
from contextlib import contextmanager
from functools import cache

from linked_application import LoadedApplication, loaded
from tests.libraries.one_axis import CYCLE

from tappet.codegen.build import BuildOptions, BuildSession, LibraryReference, build_application
from tappet.codegen.package import CodePackage
from tappet.lang.source import Source
from tappet.libraries import load
from tappet.libraries.catalog import Item, Pin, items

LIBRARY = items(load("SM3_Basic"))
LEFT_OUT = {"SMC_AxisDiagnosticLog", "SMC_StartupDrive"}
"""One writes files, which a linked application cannot; the other has an MC_Power of its own."""
BLOCKS: dict[str, Item] = {
    item.name: item
    for item in LIBRARY
    if item.kind == "function_block"
    and any(pin.type == "AXIS_REF_SM3" for pin in item.in_out)
    and item.name not in LEFT_OUT
}
"""Everything that is called with an axis."""
ENUMERATIONS = {item.name.upper() for item in LIBRARY if item.kind == "enum"}
NUMBERS: dict[str, tuple[float, ...]] = {
    "LREAL": (math.nan, math.inf, -math.inf, 1e300, -1e300, 5e-324, 0.0, -1.0),
    "DINT": (0, -1, 2**31 - 1, -(2**31)),
    "INT": (0, -1, 2**15 - 1, -(2**15)),
    "UDINT": (0, 2**32 - 1),
    "DWORD": (0, 2**32 - 1),
    "BYTE": (0, 255),
    "USINT": (0, 255),
    **dict.fromkeys(("BOOL", "MC_CAM_ID", "STRING"), ()),
}
"""Absurd values by type; those of an enumeration are of none of its names. A new type has to be added."""
AXES = {"Axis": "Axis", "Slave": "Axis", "Master": "Master", "Master1": "Master", "Master2": "Other"}
ENABLES = ("Execute", "bExecute", "Enable", "bEnable", "JogForward", "InchForward", "xUsed")
CONTROL = {"Reset": "MC_Reset", "Stop": "MC_Stop", "Move": "MC_MoveAbsolute"}
"""Further instances, by which a test sees that the axis can be controlled."""


def absurd(pin: Pin) -> tuple[float, ...]:
    if pin.type.upper() in ENUMERATIONS:
        return (-7, 99)
    return NUMBERS[pin.type]


def enable(block: str) -> str:
    """The input that has a block work."""
    names = [pin.name for pin in BLOCKS[block].inputs]
    return next(name for name in ENABLES if name in names)


def _call(name: str) -> str:
    pins = [f"{pin.name} := {AXES.get(pin.name, f'{name}_{pin.name}')}" for pin in BLOCKS[name].in_out]
    return f"{name}({', '.join(pins)});"


_FAST = "fMaxVelocity := 1E5, fMaxAcceleration := 1E7, fMaxDeceleration := 1E7, fSWMaxDeceleration := 1E6"
_VIRTUAL = f"SM3_Basic.AXIS_REF_VIRTUAL_SM3 := (fTaskCycle := {CYCLE}, {_FAST})"
_DRIVEN = (
    f"SM3_Basic.AXIS_REF_MAPPING_SM3 := (fTaskCycle := {CYCLE}, {_FAST},"
    " fRatedTorque := 127.0, fMaxTorque := 380.0, iMovementType := 1,"
    " dwRatioTechUnitsDenom := 65536, iRatioTechUnitsNum := 100)"
)
_HEAVY = "fInertia := 6E-3, fRatedTorque := 127.0, fMaxTorque := 380.0, fVelocityGain := 3.0"
"""So that a torque of 1 Nm does not wind the motor up within a test."""
_OTHERS = "\n".join(
    f"    {name}_{pin.name} : SM3_Basic.{pin.type};"
    for name, item in BLOCKS.items()
    for pin in item.in_out
    if pin.name not in AXES and not pin.type.startswith("ARRAY")
)
_TABLES = {"MC_PositionProfile": "P", "MC_VelocityProfile": "V", "MC_AccelerationProfile": "A"}
_QUANTITY = {"P": "position", "V": "velocity", "A": "acceleration"}


def _points() -> str:
    lines = []
    for block, letter in _TABLES.items():
        table = next(f"{block}_{pin.name}" for pin in BLOCKS[block].in_out if pin.name not in AXES)
        lines.append(f"{table}.Number_of_pairs := 2;")
        for number in (1, 2):
            row = f"{table}.MC_T{letter}_Array[{number}]"
            lines.append(f"{row}.delta_time := T#500ms; {row}.{_QUANTITY[letter]} := {5 * number};")
    return "\n".join(lines)


def _program(driven: bool) -> str:
    return f"""
PROGRAM Main
VAR
    Master, Other : {_VIRTUAL};
    Axis  : {_DRIVEN if driven else _VIRTUAL};
    {"Drive : SM3_Basic.SimulatedDrive := (stSettings := (" + _HEAVY + "));" if driven else ""}
    PowerM, PowerO : SM3_Basic.MC_Power := (Enable := TRUE, bRegulatorOn := TRUE, bDriveStart := TRUE);
    Lead : SM3_Basic.MC_MoveVelocity := (
        Velocity := 100.0, Acceleration := 1E6, Deceleration := 1E6, Direction := 1);
    aPoints   : ARRAY[0..2] OF SM3_Basic.SMC_CAMXYVA := [
        (dX := 0.0), (dX := 180.0, dY := 90.0), (dX := 360.0)];
    aTappets  : ARRAY[0..1] OF SM3_Basic.SMC_CAMTappet := [2((iGroupID := 1, x := 90.0))];
    aSwitches : ARRAY[0..1] OF SM3_Basic.MC_CAMSWITCH_TR := [(TrackNumber := 1, LastOnPosition := 50.0)];
    SMC_CamRegister_bTappet : ARRAY[1..SM3_Basic.MAX_NUM_TAPPETS] OF BOOL;
{_OTHERS}
{chr(10).join(f"    {name} : SM3_Basic.{name};" for name in BLOCKS)}
{chr(10).join(f"    {name} : SM3_Basic.{block};" for name, block in CONTROL.items())}
END_VAR
MC_CamTableSelect_CamTable.byType := 3;
MC_CamTableSelect_CamTable.nElements := 3;
MC_CamTableSelect_CamTable.xEnd := aPoints[2].dX;
MC_CamTableSelect_CamTable.pce := ADR(aPoints);
MC_CamTableSelect_CamTable.pt := ADR(aTappets);
MC_CamTableSelect_CamTable.nTappets := 2;
SMC_CamRegister_CamTable := MC_CamTableSelect_CamTable;
MC_DigitalCamSwitch_Switches.NoOfSwitches := 1;
MC_DigitalCamSwitch_Switches.CamSwitchPtr := ADR(aSwitches);
MC_TouchProbe_TriggerInput.bFastLatching := FALSE;
{_points()}
{"Axis.in := Drive.stIn;" if driven else ""}
Master.BeginCycle();
Other.BeginCycle();
Axis.BeginCycle();
PowerM(Axis := Master);
PowerO(Axis := Other);
Lead(Axis := Master, Execute := PowerM.Status);
{_call("MC_CamTableSelect")}
MC_CamIn.CamTableID := MC_CamTableSelect.CamTableID;
SMC_GetCamSlaveSetPosition.CamTableID := MC_CamTableSelect.CamTableID;
{chr(10).join(_call(name) for name in BLOCKS if name not in ("MC_CamTableSelect", "AxisPanel"))}
{chr(10).join(f"{name}(Axis := Axis);" for name in CONTROL)}
AxisPanel(Axis := Axis);
Master.EndCycle();
Other.EndCycle();
Axis.EndCycle();
{f"Drive(stOut := Axis.out, fCycle := {CYCLE});" if driven else ""}
END_PROGRAM
"""


@cache
def _package(driven: bool) -> CodePackage:
    options = BuildOptions(libraries=(LibraryReference("SM3_Basic"),), level=1)
    result = build_application([Source("program", _program(driven))], options=options, session=BuildSession())
    assert [str(d) for d in result.diagnostics if d.severity == "error"] == []
    assert result.package is not None
    return result.package


class AllBlocks:
    """The running program; `Axis` is what the blocks move, `Master` runs."""

    def __init__(self, application: LoadedApplication) -> None:
        self._application = application

    def set(self, block: str, **inputs: float | bool | str) -> None:
        for name, value in inputs.items():
            self._application.write(f"Main.{block}.{name}", value)

    def cycle(self, count: int = 1) -> None:
        for _ in range(count):
            self._application.cycle()
            self._application.clock_ns += round(CYCLE * 1e9)

    def text(self, path: str) -> str:
        return self._application.literal(f"Main.{path}")

    def number(self, path: str) -> float:
        return float(self.text(path))

    def true(self, path: str) -> bool:
        return self.text(path) == "TRUE"

    def start(self, block: str, **inputs: float | bool | str) -> None:
        self.set(block, **inputs)
        self.set(block, **{enable(block): True})
        self.cycle()

    def error(self, block: str) -> str:
        """What a block says has failed."""
        for pin in BLOCKS[block].outputs:
            if pin.type.upper() == "SMC_ERROR" and pin.name != "nFBErrorID":
                error = self.text(f"{block}.{pin.name}").rpartition(".")[2]
                return "" if error == "SMC_NO_ERROR" else error
        return ""

    @property
    def state(self) -> str:
        return self.text("Axis.nAxisState").rpartition(".")[2]


@contextmanager
def all_blocks(driven: bool) -> Iterator[AllBlocks]:
    """The axis in standstill, virtual or with a simulated drive; the master runs."""
    with loaded(_package(driven)) as application:
        found = AllBlocks(application)
        found.cycle(2)
        found.set("MC_Power", Enable=True, bRegulatorOn=True, bDriveStart=True)
        found.cycle(60)
        assert found.state == "standstill"
        yield found
