"""Two axes with one of each function block of SM3_Basic that has a VAR_IN_OUT, called in every cycle.

The program is generated from the library, so that a new block is in it. `Axis` is the axis of the blocks and
their slave. It is virtual, or has a drive that speaks CiA 402 and does at once what it is told.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import cache

from linked_application import LoadedApplication
from tests.libraries.one_axis import CYCLE, STATES

from tappet.codegen.build import BuildOptions, BuildSession, LibraryReference, build_application
from tappet.codegen.package import CodePackage
from tappet.lang.source import Source
from tappet.libraries import load
from tappet.libraries.catalog import Item, items

LIBRARY = {item.name: item for item in items(load("SM3_Basic"))}
AXES = {"Axis": "Axis", "Slave": "Axis", "Master": "Master", "Master1": "Master", "Master2": "Master"}
CAMS = {"CAM": "Cam", "CamTable": "Cam", "cam": "Edited"}
NOT_CALLED = {
    "AxisPanel": "has the axis for the editor, test_axis_panel",
    "SMC_StartupDrive": "calls other blocks, which have their own inputs",
    "SMC_AxisDiagnosticLog": "writes a file, which needs a runtime: tests/runtime/test_file_block_timing.py",
    "SMC_WriteCAM": "writes a file, too",
}
"""Blocks that are shown elsewhere, and why."""
BLOCKS = {
    name: item
    for name, item in LIBRARY.items()
    if item.kind == "function_block" and item.in_out and name not in NOT_CALLED
}
EXECUTE = ("Execute", "bExecute")
ENABLE = ("Enable", "bEnable")
LEVELS = ("JogForward", "InchForward")
OTHERS = {
    "OtherMove": "MC_MoveAbsolute",
    "OtherVelocity": "MC_MoveVelocity",
    "OtherStop": "MC_Stop",
    "OtherGear": "MC_GearIn",
    "OtherHoming": "SMC_Homing",
    "OtherReset": "MC_Reset",
    "OtherMode": "SMC_SetControllerMode",
}
"""Instances that bring the axis into a state."""
FAST = "fMaxVelocity := 1E5, fMaxAcceleration := 1E7, fMaxDeceleration := 1E7, fSWMaxDeceleration := 1000.0"
KINDS = {
    "virtual": f"AXIS_REF_VIRTUAL_SM3 := (fTaskCycle := {CYCLE}, {FAST})",
    "drive": f"AXIS_REF_MAPPING_SM3 := (fTaskCycle := {CYCLE}, {FAST}, iMovementType := 1, "
    "dwRatioTechUnitsDenom := 1000, iRatioTechUnitsNum := 1, fDeadTimeCycles := 1.0)",
}
TAKES = {
    "virtual": "",
    "drive": """
Axis.in.wStatusWord := Drive.wStatusWord;
Axis.in.byModesOfOperationDisplay := byMode;
Axis.in.diActPosition := diPlace;
Axis.in.diActVelocity := LREAL_TO_DINT(fSpeed);
IF byMode = 6 THEN
    Axis.in.wStatusWord.12 := iHoming > 20;
    Axis.in.wStatusWord.10 := TRUE;
END_IF
""",
}
"""What the axis is told before its cycle."""
FOLLOWS = {
    "virtual": "",
    "drive": f"""
Drive(wControlWord := Axis.out.wControlWord);
IF NOT xKeepsMode THEN
    byMode := Axis.out.byModesOfOperation;
END_IF
IF NOT Drive.bFollows OR byMode = 6 THEN
    fSpeed := 0.0;
    iHoming := SEL(byMode = 6, 0, iHoming + 1);
ELSIF byMode = 8 THEN
    fSpeed := (Axis.out.diSetPosition - diPlace) / {CYCLE};
    diPlace := Axis.out.diSetPosition;
    iHoming := 0;
ELSE
    IF byMode = 9 THEN
        fSpeed := Axis.out.diSetVelocity;
    ELSE
        fSpeed := fSpeed + Axis.out.wSetTorque; (* A load that is easy to move *)
    END_IF
    diPlace := diPlace + LREAL_TO_DINT(fSpeed * {CYCLE});
END_IF
""",
}
"""What its drive does behind it."""
TABLES = {
    "MC_TP_REF": "(Number_of_pairs := 1, MC_TP_Array := [(delta_time := T#2S, position := 40.0)])",
    "MC_TV_REF": "(Number_of_pairs := 1, MC_TV_Array := [(delta_time := T#2S, velocity := 20.0)])",
    "MC_TA_REF": "(Number_of_pairs := 1, MC_TA_Array := [(delta_time := T#2S, acceleration := 20.0)])",
}
"""What variables of some types hold at the start."""
GOOD = {
    "Velocity": 20.0,
    "Acceleration": 200.0,
    "Deceleration": 200.0,
    "Position": 30.0,
    "Distance": 10.0,
    "EndVelocity": 10.0,
    "VelocityDiff": 5.0,
    "PhaseShift": 1.0,
    "ArraySize": 1,
    "MasterSyncPosition": 100.0,
    "SlaveSyncPosition": 100.0,
    "fBacklash": 1.0,
    "fCompensationVel": 5.0,
    "fCompensationAcc": 200.0,
    "fCompensationDec": 200.0,
    "fVelocitySlow": 1.0,
    "fVelocityFast": 5.0,
    "fAcceleration": 200.0,
    "fDeceleration": 200.0,
    "Torque": 0.5,
    "TorqueRamp": 10.0,
    "ParameterNumber": 1113,
    "VelFactor": 0.5,
    "AccFactor": 1.0,
    "JerkFactor": 1.0,
    "fPosWindow": 1.0,
}
"""Inputs that suit most blocks, by their name."""


def good_inputs(block: str) -> dict[str, float | bool | str]:
    """Inputs that a block takes, without the one that starts it."""
    names = {pin.name for pin in BLOCKS[block].inputs}
    return {name: value for name, value in GOOD.items() if name in names} | OWN_INPUTS.get(block, {})


OWN_INPUTS: dict[str, dict[str, float | bool | str]] = {
    "MC_CamIn": {"MasterSyncPosition": 0.0},
    "MC_WriteParameter": {"Value": 50.0},
    "MC_WriteBoolParameter": {"ParameterNumber": 1205},
    "MC_ReadBoolParameter": {"ParameterNumber": 1205},
    "MC_SetPosition": {"Position": 0.0, "Mode": True},
}


def begin_pin(block: str) -> str | None:
    """The input of a block that starts it."""
    names = [pin.name for pin in BLOCKS[block].inputs]
    return next((name for name in (*EXECUTE, *ENABLE, *LEVELS) if name in names), None)


def moves_an_axis(block: str) -> bool:
    """Whether a block is given an axis that it may move."""
    return any(pin.name in ("Axis", "Slave") and pin.type == "AXIS_REF_SM3" for pin in BLOCKS[block].in_out)


def _variable(block: str, pin: str, type_name: str) -> tuple[str, str]:
    """The variable that a VAR_IN_OUT is given, and its declaration unless all blocks share it."""
    if type_name == "AXIS_REF_LOGICAL_SM3":
        return "Logical", ""
    if pin in AXES:
        return AXES[pin], ""
    if pin in CAMS:
        return CAMS[pin], ""
    if type_name == "TRIGGER_REF":
        return "Trigger", ""
    if type_name == "SMC_TAPPETDATA":
        return "MC_CamIn1.Tappets", ""
    prefix = "SM3_Basic." if type_name in LIBRARY else ""
    declared = f"{block}_{pin} : {prefix}{type_name.replace('MAX_', 'SM3_Basic.MAX_')}"
    return f"{block}_{pin}", f"    {declared}{' := ' + TABLES[type_name] if type_name in TABLES else ''};"


def _call(name: str, item: Item) -> str:
    pins = ", ".join(f"{pin.name} := {_variable(item.name, pin.name, pin.type)[0]}" for pin in item.in_out)
    return f"{name}({pins});"


def _program(kind: str) -> str:
    variables = [
        declared
        for item in BLOCKS.values()
        for pin in item.in_out
        if (declared := _variable(item.name, pin.name, pin.type)[1])
    ]
    instances = [f"    {name}1, {name}2 : SM3_Basic.{name};" for name in BLOCKS]
    others = [f"    {name} : SM3_Basic.{block};" for name, block in OTHERS.items()]
    calls = [_call(f"{name}{number}", item) for number in (1, 2) for name, item in BLOCKS.items()]
    other_calls = [_call(name, LIBRARY[block]) for name, block in OTHERS.items()]
    return "\n".join(
        [
            "PROGRAM Main",
            "VAR",
            f"    Axis    : SM3_Basic.{KINDS[kind]};",
            f"    Master  : SM3_Basic.{KINDS['virtual']};",
            "    Logical : SM3_Basic.AXIS_REF_LOGICAL_SM3 := (pMaster := ADR(Master));",
            "    Drive   : SM3_Basic.CiA402Drive;",
            "    byMode  : BYTE := 8;",
            "    diPlace : DINT;",
            "    fSpeed  : LREAL; (* Of the motor [increments/s] *)",
            "    iHoming : INT;   (* Cycles in which the drive has looked for its home *)",
            "    Power, PowerM : SM3_Basic.MC_Power;",
            "    MasterRuns : SM3_Basic.MC_MoveVelocity := (Velocity := 30.0, Acceleration := 1E6,",
            "        Deceleration := 1E6);",
            "    aPoints : ARRAY[0..1] OF SM3_Basic.SMC_CAMXYVA := [(), (dX := 1000.0, dY := 1000.0)];",
            "    aTappets : ARRAY[0..0] OF SM3_Basic.SMC_CAMTappet := [(iGroupID := 1, x := 500.0)];",
            "    Cam     : SM3_Basic.MC_CAM_REF := (byType := 3, nElements := 2, xEnd := 1000.0,",
            "        pce := ADR(aPoints), nTappets := 1, pt := ADR(aTappets));",
            "    Edited  : SM3_Basic.MC_CAM_REF := (byType := 3, nElements := 2, xEnd := 1000.0,",
            "        pce := ADR(aPoints));",
            "    OtherSelect : SM3_Basic.MC_CamTableSelect := (Execute := TRUE);",
            "    Trigger : SM3_Basic.TRIGGER_REF := (bFastLatching := FALSE);",
            "    xBus    : BOOL := TRUE; (* The axis has its cycles *)",
            "    xKeepsMode : BOOL;      (* The drive does not change what it controls *)",
            "    sSkipped : STRING;      (* An instance that is not called *)",
            *variables,
            *instances,
            *others,
            "END_VAR",
            TAKES[kind],
            "IF xBus THEN",
            "Axis.BeginCycle();",
            "Master.BeginCycle();",
            "Logical.BeginCycle();",
            "END_IF",
            "Power(Axis := Axis);",
            "PowerM(Axis := Master, Enable := TRUE, bRegulatorOn := TRUE, bDriveStart := TRUE);",
            "MasterRuns(Axis := Master);",
            "OtherSelect(Master := Master, Slave := Axis, CamTable := Cam);",
            "MC_CamIn1.CamTableID := OtherSelect.CamTableID;",
            "MC_CamIn2.CamTableID := OtherSelect.CamTableID;",
            "SMC_GetCamSlaveSetPosition1.CamTableID := OtherSelect.CamTableID;",
            *(
                f"IF sSkipped <> '{name}' THEN {call} END_IF"
                for name, call in zip(OTHERS, other_calls, strict=True)
            ),
            *(call for call in calls if not call.startswith("MC_Power")),
            "IF MC_Power1.Enable OR MC_Power1.Busy OR MC_Power1.Error THEN MC_Power1(Axis := Axis); END_IF",
            "IF xBus THEN",
            "Axis.EndCycle();",
            "Master.EndCycle();",
            "Logical.EndCycle();",
            "END_IF",
            FOLLOWS[kind],
            "END_PROGRAM",
        ]
    )


@cache
def _package(kind: str) -> CodePackage:
    options = BuildOptions(libraries=(LibraryReference("SM3_Basic"),), level=1)
    result = build_application([Source("program", _program(kind))], options=options, session=BuildSession())
    assert [str(d) for d in result.diagnostics if d.severity == "error"] == []
    assert result.package is not None
    return result.package


class Machine:
    """The running program; a block is known by its name, and its second instance by a 2 behind it."""

    def __init__(self, application: LoadedApplication, kind: str) -> None:
        self._application = application
        self.kind = kind

    def fresh(self, power: bool = True) -> None:
        """As after a cold start, in standstill if it has power."""
        self._application.start()
        self._application.clock_ns = 0
        self.cycle(4)
        if power:
            self.set("Power", Enable=True, bRegulatorOn=True, bDriveStart=True)
            self.cycle(12)
            assert self.state == "standstill"

    def _path(self, block: str) -> str:
        return f"Main.{block}{1 if block in BLOCKS else ''}"

    def set(self, block: str, **inputs: float | bool | str) -> None:
        """Writes inputs of a block, or members of a variable."""
        for name, value in inputs.items():
            self._application.write(f"{self._path(block)}.{name}", value)

    def write(self, name: str, value: float | bool | str) -> None:
        self._application.write(f"Main.{name}", value)

    def text(self, path: str) -> str:
        return self._application.literal(f"Main.{path}").rpartition(".")[2] if path else ""

    def output(self, block: str, pin: str) -> str:
        return self._application.literal(f"{self._path(block)}.{pin}")

    def number(self, path: str) -> float:
        return float(self._application.literal(f"Main.{path}"))

    def says(self, block: str) -> set[str]:
        """Which outputs of a block are TRUE."""
        item = LIBRARY[OTHERS.get(block, block.removesuffix("2"))]
        return {
            pin.name for pin in item.outputs if pin.type == "BOOL" and self.output(block, pin.name) == "TRUE"
        }

    def error(self, block: str) -> str:
        """The error that a block tells."""
        item = LIBRARY[OTHERS.get(block, block.removesuffix("2"))]
        pin = next(pin.name for pin in item.outputs if pin.type == "SMC_ERROR")
        return self.output(block, pin).rpartition(".")[2]

    def cycle(self, count: int = 1) -> None:
        for _ in range(count):
            self._application.cycle()
            self._application.clock_ns += round(CYCLE * 1e9)

    def until(self, condition: Callable[[], bool], at_most: int = 5000) -> int:
        """Cycles until a condition holds."""
        for gone in range(at_most):
            if condition():
                return gone
            self.cycle()
        raise AssertionError("it never came")

    @property
    def state(self) -> str:
        return self._application.literal("Main.Axis.nAxisState").rpartition(".")[2]


@contextmanager
def machine(kind: str) -> Iterator[Machine]:
    application = LoadedApplication(_package(kind))
    try:
        yield Machine(application, kind)
    finally:
        application.close()


RAMP = {"Velocity": 20.0, "Acceleration": 200.0, "Deceleration": 200.0}
SEARCH = {"fVelocityFast": 5.0, "fVelocitySlow": 1.0, "fAcceleration": 200.0, "fDeceleration": 200.0}
MOVED_BY = {
    "stopping": "OtherStop",
    "discrete_motion": "OtherMove",
    "continuous_motion": "OtherVelocity",
    "synchronized_motion": "OtherGear",
    "homing": "OtherHoming",
}
"""The instance that has the axis in a state."""


def bring(found: Machine, state: str) -> None:
    """A fresh axis into a state, where it stays for some seconds."""
    found.fresh(power=state != "power_off")
    if state == "errorstop":
        found.set("OtherVelocity", Execute=True, Direction=1, **RAMP)
        found.cycle(50)
        found.set("Axis", bSWLimitEnable=True, fSWLimitPositive=-1.0, fSWLimitNegative=-1e6)
        found.cycle(2)
        found.set("Axis", bSWLimitEnable=False)
        found.set("OtherVelocity", Execute=False)
    elif state == "stopping":
        found.set("OtherVelocity", Execute=True, Direction=1, **RAMP)
        found.cycle(200)
        found.set("OtherVelocity", Execute=False)
        found.set("OtherStop", Execute=True, Deceleration=5.0)
    elif state == "discrete_motion":
        found.set("OtherMove", Execute=True, Position=500.0, **RAMP)
    elif state == "continuous_motion":
        found.set("OtherVelocity", Execute=True, Direction=1, **RAMP)
    elif state == "synchronized_motion":
        found.set("MasterRuns", Execute=True)
        found.set("OtherGear", Execute=True, Acceleration=200.0, Deceleration=200.0)
    elif state == "homing":
        found.set("OtherHoming", bExecute=True, nDirection=1, **SEARCH)
    found.cycle(100)
    assert found.state == state, found.state
    assert state in STATES
