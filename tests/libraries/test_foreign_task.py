"""Blocks that are called in another task than the bus task of their axis (motion_semantics CAL-01)."""

from __future__ import annotations

from collections.abc import Iterator

import pytest

from tappet.codegen.build import BuildOptions, LibraryReference, build_application
from tappet.codegen.package import CodePackage
from tappet.iec.task import Task
from tappet.lang.source import Source
from tappet.libraries import load
from tappet.libraries.catalog import Item, items
from tappet.runtime.local import LocalRuntime

CYCLE_NS = 10_000_000
AXIS = "AXIS_REF_SM3"
READERS = {
    *("MC_ReadActualPosition", "MC_ReadActualVelocity", "MC_ReadActualTorque", "MC_ReadAxisError"),
    *("MC_ReadBoolParameter", "MC_ReadParameter", "MC_ReadMotionState", "MC_ReadStatus"),
    *("MC_ReadAxisInfo", "SMC_ReadSetPosition", "SMC_ReadFBError", "SMC_GetOverride", "SMC3_BrakeStatus"),
    *("SMC_CheckAxisCommunication", "SMC_CheckLimits", "SMC_GetMaxSetAccDec", "SMC_GetMaxSetVelocity"),
    *("SMC_GetTrackingError", "SMC_InPosition", "SMC_MeasureDistance", "SMC_GetCamSlaveSetPosition"),
    *("MC_DigitalCamSwitch", "SMC_CamRegister", "MC_CamTableSelect", "SMC_AxisDiagnosticLog"),
    *("SMC_DigitalCamSwitch_HighPrecision", "SMC_StartupDrive"),
}
"""They change nothing of an axis by themselves, so that they may be called anywhere."""
REFUSED_BEFORE = {
    *("MC_GearOut", "MC_CamOut", "MC_TouchProbe", "MC_CamIn"),
    *("MC_AccelerationProfile", "MC_PositionProfile", "MC_VelocityProfile"),
    *("SMC3_PersistPosition", "SMC3_PersistPositionSingleturn"),
}
"""They say what else is wrong: the axis is no slave or has no encoder, a trigger, cam or table is none."""
STARTS = ("Execute", "bExecute", "Enable", "bEnable", "JogForward", "InchForward")
VALUES = {
    "Velocity": "10.0",
    "Acceleration": "10.0",
    "Deceleration": "10.0",
    "Jerk": "10.0",
    "bRegulatorOn": "TRUE",
    "bDriveStart": "TRUE",
    "Distance": "5.0",
    "VelocityDiff": "5.0",
    "VelFactor": "0.5",
    "ParameterNumber": "1007",
    "fCompensationVel": "5.0",
    "fCompensationAcc": "5.0",
    "fCompensationDec": "5.0",
    "fVelocitySlow": "1.0",
    "fVelocityFast": "2.0",
    "fAcceleration": "5.0",
    "fDeceleration": "5.0",
    "TorqueRamp": "5.0",
}
WRONG_TASK = "SMC_FB_CALLED_FROM_WRONG_TASK"
LIBRARY = {item.name: item for item in items(load("SM3_Basic"))}
BLOCKS = [
    item
    for item in LIBRARY.values()
    if item.kind == "function_block"
    and item.name != "AxisPanel"  # runs in the bus task by itself
    and any(pin.type == AXIS for pin in item.in_out)
]


def _start(block: Item) -> str | None:
    names = [pin.name for pin in block.inputs]
    return next((name for name in STARTS if name in names), None)


def _program() -> str:
    variables, calls = [], []
    for block in BLOCKS:
        given = []
        for pin in block.in_out:
            name = "Bus.Drive"
            if pin.type != AXIS:
                name = f"{block.name}_{pin.name}"
                variables.append(
                    f"    {name} : SM3_Basic.{pin.type};"
                    if pin.type in LIBRARY
                    else f"    {name} : {pin.type};"
                )
            given.append(f"{pin.name} := {name}")
        pins = {pin.name for pin in block.inputs}
        given += [f"{pin} := {value}" for pin, value in VALUES.items() if pin in pins]
        start = _start(block)
        if start is not None:
            given.append(f"{start} := xStart")
        variables.append(f"    fb{block.name} : SM3_Basic.{block.name};")
        calls.append(f"fb{block.name}({', '.join(given)});")
    return "\n".join(
        ["PROGRAM Other", "VAR", "    xStart : BOOL;", *variables, "END_VAR", *calls, "END_PROGRAM"]
    )


BUS = """
PROGRAM Bus
VAR
    Drive  : SM3_Basic.AXIS_REF_VIRTUAL_SM3 := (fTaskCycle := 0.01);
    fbPower : SM3_Basic.MC_Power;
    xPower : BOOL := TRUE;
END_VAR
Drive.BeginCycle();
fbPower(Axis := Drive, Enable := TRUE, bRegulatorOn := xPower, bDriveStart := TRUE);
Drive.EndCycle();
END_PROGRAM
"""


@pytest.fixture(scope="module")
def package() -> CodePackage:
    options = BuildOptions(libraries=(LibraryReference("SM3_Basic"),), level=1)
    tasks = [
        Task("Bus", interval_ns=CYCLE_NS, priority=1, programs=("Bus",)),
        Task("Slow", interval_ns=CYCLE_NS, priority=5, programs=("Other",)),
    ]
    result = build_application([Source("bus", BUS), Source("other", _program())], tasks, options=options)
    assert [str(d) for d in result.diagnostics if d.severity == "error"] == []
    assert result.package is not None
    return result.package


@pytest.fixture
def runtime(package: CodePackage) -> Iterator[LocalRuntime]:
    with LocalRuntime(package) as found:
        found.run(cycles=10)
        assert found.literal("Bus.Drive.nAxisState") == "standstill"
        yield found


def test_no_block_of_another_task_changes_an_axis(runtime: LocalRuntime) -> None:
    """No member of the axis but its queue of errors."""
    members = [pin.name for pin in LIBRARY[AXIS].inputs if pin.name != "fbeFBError"]
    before = {name: runtime.literal(f"Bus.Drive.{name}") for name in members}
    runtime.write("Other.xStart", True)
    runtime.run(cycles=40)
    assert {name: runtime.literal(f"Bus.Drive.{name}") for name in members} == before


def test_blocks_that_move_or_set_something_say_why_they_do_not(runtime: LocalRuntime) -> None:
    runtime.write("Other.xStart", True)
    runtime.run(cycles=40)
    for block in BLOCKS:
        error = next((pin.name for pin in block.outputs if pin.type == "SMC_ERROR"), None)
        said = runtime.literal(f"Other.fb{block.name}.{error}") if error else "no error"
        if block.name in REFUSED_BEFORE:
            assert said not in ("SMC_NO_ERROR", "no error"), block.name
        elif block.name == "SMC_ReadFBError":
            assert said == WRONG_TASK, "the first error in the queue is that of another block"
        elif block.name in READERS:
            assert said != WRONG_TASK, block.name
        else:
            assert said == WRONG_TASK, block.name
