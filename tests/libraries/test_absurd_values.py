"""Absurd values at every input of every block that takes an axis: errors or sane motion, no lost axis."""

from __future__ import annotations

import math

import pytest
from tests.libraries.absurd_values import BLOCKS, NUMBERS, AllBlocks, absurd, all_blocks, enable

from tappet.libraries.catalog import Pin

SANE = {
    **dict.fromkeys(("Velocity", "VelocityDiff", "fVelocityFast", "fCompensationVel"), 20.0),
    **dict.fromkeys(("Acceleration", "fAcceleration", "fCompensationAcc"), 1000.0),
    **dict.fromkeys(("Deceleration", "fDeceleration", "fCompensationDec"), 1000.0),
    **dict.fromkeys(("EndVelocity", "fVelocitySlow"), 5.0),
    **dict.fromkeys(("Distance", "Position", "PhaseShift", "MasterSyncPosition"), 10.0),
    **dict.fromkeys(("Torque", "fTorque"), 0.1),
    "TorqueRamp": 1.0,
    "ArraySize": 2,
    "fBacklash": 1.0,
    "Direction": 1,
    "EndVelocityDirection": 1,
}
"""What blocks are given beside the absurd value, by the name of the input; others have their defaults."""
SANE_HERE: dict[str, dict[str, float | bool]] = {
    "AxisPanel": {"xWanted": True, "fPosition": 10.0, "fVelocity": 20.0},
    "MC_CamIn": {"StartMode": 2},
    "SMC_FollowSetValues": {"dwValueMask": 31},
    "MC_TouchProbe": {"WindowOnly": True, "FirstPosition": 0.0, "LastPosition": 10.0},
    "MC_ReadParameter": {"ParameterNumber": 1},
    "MC_WriteParameter": {"ParameterNumber": 2},
    "MC_ReadBoolParameter": {"ParameterNumber": 1205},
    "MC_WriteBoolParameter": {"ParameterNumber": 1205},
    "MC_GearInPos": {"MasterSyncPosition": 200.0, "MasterStartDistance": 60.0},
    "SMC_MoveContinuousAbsolute": {"Direction": 0},
    "SMC_ChangeGearingRatio": {
        "dwRatioTechUnitsDenom": 65536,
        "iRatioTechUnitsNum": 100,
        "fPositionPeriod": 360.0,
    },
    "SMC3_PersistPositionSingleturn": {"usiNumberOfAbsoluteBits": 16},
    "SMC_SetSoftwareLimits": {"SWL_Positive": 1e6, "SWL_Negative": -1e6},
}
BEFORE = {
    "MC_CamIn": "MC_CamTableSelect",
    "SMC_GetCamSlaveSetPosition": "MC_CamTableSelect",
    "MC_Phasing": "MC_GearIn",
    "MC_PhasingAbsolute": "MC_GearIn",
    "MC_PhasingRelative": "MC_GearIn",
    "MC_HaltSuperimposed": "MC_MoveSuperImposed",
}
"""What has to be going on."""
TORQUE = {"MC_TorqueControl", "SMC_SetTorque"}
"""Blocks that need torque control."""
NEEDS_A_DRIVE = {"SMC3_PersistPositionSingleturn", *TORQUE}
WITHOUT_POWER = {"SMC_ChangeGearingRatio"}
WITHOUT_EFFECT = {
    *(("MC_TorqueControl", pin) for pin in ("Acceleration", "Deceleration", "Jerk")),
    ("SMC_Homing", "fIndexPosition"),
    ("AxisPanel", "fPatience"),
    ("AxisPanel", "fDuration"),
}
"""Inputs that do not count in this use of the block, or whose absurd values mean something."""
OPEN = {
    ("MC_TorqueControl", "Velocity"),
    *(("MC_TouchProbe", pin) for pin in ("FirstPosition", "LastPosition")),
}
"""Limits that infinity takes away."""
SET_VALUES = (
    *("fSetPosition", "fSetVelocity", "fSetAcceleration", "fSetTorque", "fSetCurrent"),
    *("fActPosition", "fActVelocity"),
)
CASES = [
    (block, pin, value) for block, item in BLOCKS.items() for pin in item.inputs for value in absurd(pin)
]
TAKEN = sorted({block for block, *_ in CASES})


def _name(case: tuple[str, Pin, float]) -> str:
    return f"{case[0]}.{case[1].name}={case[2]:g}"


def _sane(block: str) -> dict[str, float | bool]:
    names = {pin.name for pin in BLOCKS[block].inputs}
    given: dict[str, float | bool] = {name: value for name, value in SANE.items() if name in names}
    return given | SANE_HERE.get(block, {})


def _begin(axes: AllBlocks, block: str) -> None:
    """What has to be going on before a block is called."""
    if block in TORQUE:
        axes.start("SMC_SetControllerMode", nControllerMode=1)
        axes.cycle(20)
        assert axes.true("SMC_SetControllerMode.bDone")
    if block in WITHOUT_POWER:
        axes.set("MC_Power", bRegulatorOn=False)
        axes.cycle(5)
    if block == "AxisPanel":
        axes.set(block, xWanted=True, xUsed=True, udiAlive=1)
        axes.cycle(5)
        axes.set(block, eCommand=1, udiCommand=1)
    if (first := BEFORE.get(block)) is not None:
        axes.start(first, **_sane(first))
        axes.cycle(50)
        assert not axes.error(first)


def _finite(axes: AllBlocks) -> bool:
    return all(math.isfinite(axes.number(f"Axis.{name}")) for name in SET_VALUES)


@pytest.mark.parametrize("block", TAKEN)
def test_sane_values_are_taken(block: str) -> None:
    """Else the absurd ones of the same table would show nothing."""
    with all_blocks(block in NEEDS_A_DRIVE) as axes:
        _begin(axes, block)
        axes.start(block, **_sane(block))
        for _ in range(10):
            axes.cycle(5)
            assert axes.error(block) == ""
        assert axes.state != "errorstop" or block == "MC_ImmediateStop"


@pytest.mark.parametrize("case", CASES, ids=map(_name, CASES))
def test_an_absurd_value_leaves_the_axis_controllable(case: tuple[str, Pin, float]) -> None:
    block, pin, value = case
    with all_blocks(block in NEEDS_A_DRIVE) as axes:
        _begin(axes, block)
        axes.start(block, **{**_sane(block), pin.name: value})
        error = ""
        for _ in range(20):
            axes.cycle(5)
            assert _finite(axes)
            error = error or axes.error(block)
        reports = any(output.type.upper() == "SMC_ERROR" for output in BLOCKS[block].outputs)
        unlimited = math.isinf(value) and (block, pin.name) in OPEN
        unlimited = unlimited or (value == math.inf and pin.name.endswith("Jerk"))  # Nothing in a trapezoid
        counts = reports and (block, pin.name) not in WITHOUT_EFFECT
        if counts and not (math.isfinite(value) or unlimited):
            assert error, "no motion has such a value"
        _take_control(axes, block)


@pytest.mark.parametrize("duration", [math.nan, math.inf, -math.inf, -1.0, 0.0, 5e-324])
def test_a_measurement_has_an_end(duration: float) -> None:
    """The duration of a step counts in this command of the panel alone."""
    with all_blocks(False) as axes:
        _begin(axes, "AxisPanel")
        axes.set("AxisPanel", fPosition=1.0, fDuration=duration, eCommand=7, udiCommand=2)
        axes.cycle(100)
        refused = axes.text("AxisPanel.eError") == "SMC_INVALID_SET_VALUES"
        assert refused == (not 0.0 < duration < math.inf)
        assert axes.text("AxisPanel.ePhase") == "Idle" or not refused
        axes.cycle(400)
        assert axes.text("AxisPanel.ePhase") == "Idle"
        _take_control(axes, "AxisPanel")


def _take_control(axes: AllBlocks, block: str) -> None:
    """The axis comes to standstill and moves to a place near it."""
    axes.set("Axis", bSWLimitEnable=False)
    if block.endswith("SetOverride"):
        axes.set(block, VelFactor=1.0, AccFactor=1.0, JerkFactor=1.0)
        axes.cycle()
    if block == "AxisPanel":
        axes.set(block, xWanted=False)
        axes.cycle(100)
    for name in {block, BEFORE.get(block, block)}:
        axes.set(name, **{enable(name): False})
    axes.set("MC_Power", bRegulatorOn=True)
    axes.cycle(60)
    if axes.state == "errorstop":
        axes.cycle(400)
        axes.set("Reset", Execute=True)
        axes.cycle(60)
        assert axes.state == "standstill"
    axes.set("Stop", Execute=True, Deceleration=1e12)
    axes.cycle(40)
    assert axes.state == "stopping"
    axes.set("Stop", Execute=False)
    axes.cycle(5)
    assert axes.state == "standstill"
    if block in TORQUE:
        axes.cycle(200)
    target = axes.number("Axis.fSetPosition") + 1.0
    if abs(target) < 1e9:  # Else nobody sees a step of 1
        axes.set("Move", Position=target, Velocity=100.0, Acceleration=1e4, Deceleration=1e4, Execute=True)
        axes.cycle(60)
        assert axes.true("Move.Done"), axes.text("Move.ErrorID")
        assert axes.number("Axis.fSetPosition") == pytest.approx(target)


WRITABLE = (9, 13, 15, 16, 1113, 1123, 1133, 1143, 1152, 1153, 1162, 2, 3, 1203, 1211, 1250)
"""Parameters of motion_semantics PAR-01 that are numbers and can be written."""


@pytest.mark.parametrize("value", [value for value in NUMBERS["LREAL"] if value == value], ids="{:g}".format)
@pytest.mark.parametrize("number", WRITABLE)
def test_an_absurd_parameter_leaves_the_axis_controllable(number: int, value: float) -> None:
    """Set back to what it was, when a move needs it."""
    with all_blocks(False) as axes:
        axes.start("MC_ReadParameter", ParameterNumber=number)
        before = axes.number("MC_ReadParameter.Value")
        axes.start("MC_MoveVelocity", **_sane("MC_MoveVelocity"))
        axes.start("MC_WriteParameter", ParameterNumber=number, Value=value)
        axes.set("MC_WriteParameter", Execute=False)
        for _ in range(20):
            axes.cycle(5)
            assert _finite(axes)
        axes.start("MC_WriteParameter", Value=before)
        axes.set("MC_MoveVelocity", Execute=False)
        _take_control(axes, "MC_WriteParameter")


def test_an_index_that_is_no_position_ends_homing() -> None:
    with all_blocks(False) as axes:
        axes.start(
            "SMC_Homing",
            **_sane("SMC_Homing"),
            nHomingMode="SMC_HOMING_MODE.FAST_BSLOW_I_S_STOP",
            fIndexPosition=math.nan,
        )
        for switch in (False, True):
            axes.cycle(20)
            axes.set("SMC_Homing", bReferenceSwitch=switch)
        axes.cycle(20)
        assert axes.true("SMC_Homing.bStartLatchingIndex")
        axes.set("SMC_Homing", bIndexOccured=True)
        axes.cycle(2)
        assert axes.error("SMC_Homing") == "SMC_3SH_INVALID_VELACC_VALUES"
        assert _finite(axes)
        axes.set("SMC_Homing", bIndexOccured=False)
        _take_control(axes, "SMC_Homing")


@pytest.mark.parametrize("patience", [math.nan, math.inf, -1.0])
def test_a_panel_without_a_sign_of_its_page_never_keeps_the_axis(patience: float) -> None:
    with all_blocks(False) as axes:
        axes.set("AxisPanel", xWanted=True, xUsed=True, fPatience=patience)
        axes.cycle(10_100)
        assert axes.text("AxisPanel.eState") == "Free"
        assert axes.true("AxisPanel.xLost")
        _take_control(axes, "MC_Halt")


@pytest.mark.parametrize("scaling", [1e11, -1e11])
def test_tappets_that_a_wild_master_never_passes_cost_no_time(scaling: float) -> None:
    """Each cycle of the master is 1e16 of the cam; only the first whole one is looked through for tappets."""
    with all_blocks(False) as axes:
        axes.set("aPoints[2]", dX=1e-6)
        kind = "TAPPET_neg" if scaling > 0.0 else "TAPPET_pos"
        for tappet in (0, 1):
            axes.set(f"aTappets[{tappet}]", x=5e-7, ctt=f"SMC_CAMTAPPETTYPE.{kind}")
        axes.start("SMC_CamRegister", MasterScaling=scaling)
        axes.cycle(5)
        assert axes.error("SMC_CamRegister") == ""
        assert "TRUE" not in axes.text("SMC_CamRegister_bTappet")
