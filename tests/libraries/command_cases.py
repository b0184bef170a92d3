"""How each command of SM3_Basic with Execute is run, ended, aborted and refused."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field

from tests.libraries.every_block import BLOCKS, LIBRARY, Machine, bring

Act = Callable[[Machine], None]
Inputs = dict[str, float | bool | str]
NUMBERS = {value.name: int(value.value) for value in LIBRARY["SMC_ERROR"].values}
OVER = ("Done", "CommandAborted", "Error")
GOALS = ("InVelocity", "InGear", "InSync", "InEndVelocity", "InTorque")
UNTIL_ANOTHER = {"MC_GearOut", "MC_CamOut", "MC_VelocityProfile", "MC_AccelerationProfile"}
"""They hold the velocity of the axis behind their Done, until another command has it."""
HOLDERS = {"MC_Stop", *UNTIL_ANOTHER}
"""Busy beside Done, EXE-05."""
SUPER = {"VelocityDiff": 5.0, "Acceleration": 50.0, "Deceleration": 50.0}
VALID = ("Valid", "Enabled", "InOperation", "Status")


def standing(found: Machine) -> None:
    bring(found, "standstill")


def moving(found: Machine) -> None:
    bring(found, "continuous_motion")


def coupled(found: Machine) -> None:
    bring(found, "synchronized_motion")


def failed(found: Machine) -> None:
    bring(found, "errorstop")


def without_power(found: Machine) -> None:
    bring(found, "power_off")


def master_moving(found: Machine) -> None:
    bring(found, "standstill")
    found.set("MasterRuns", Execute=True)
    found.cycle(5)


def torque_mode(found: Machine) -> None:
    bring(found, "standstill")
    found.set("OtherMode", bExecute=True, nControllerMode="SMC_CONTROLLER_MODE.SMC_torque")
    found.until(lambda: "bDone" in found.says("OtherMode"), 50)


def superimposed(found: Machine) -> None:
    bring(found, "continuous_motion")
    found.set("MC_MoveSuperImposed2", Execute=True, Distance=1e3, **SUPER)
    found.cycle(50)


def probing(found: Machine) -> None:
    bring(found, "standstill")
    found.set("MC_TouchProbe2", Execute=True)
    found.cycle(2)


def probe_edge(found: Machine) -> None:
    found.set("Trigger", bInput=True)


def pass_switch(found: Machine) -> None:
    found.cycle(50)
    found.set("SMC_Homing", bReferenceSwitch=False)
    found.cycle(100)
    found.set("SMC_Homing", bReferenceSwitch=True)


def stop(found: Machine) -> None:
    found.set("OtherStop", Execute=True, Deceleration=100.0)


def abort_trigger(found: Machine) -> None:
    found.set("MC_AbortTrigger", Execute=True)


def superimpose(found: Machine) -> None:
    found.set("MC_MoveSuperImposed", Execute=True, Distance=1.0, **SUPER)


def moving_in_fixed_mode(found: Machine) -> None:
    moving(found)
    found.write("xKeepsMode", True)


def with_cam(**members: float) -> Act:
    def act(found: Machine) -> None:
        standing(found)
        found.set("Cam", **members)

    return act


def nothing(_: Machine) -> None:
    pass


def without_bus(found: Machine, before: Act) -> None:
    before(found)
    found.write("xBus", False)
    found.set("Axis", wCommunicationState=0)


@dataclass(frozen=True)
class Case:
    """How a block is run, aborted and refused."""

    error: int
    """What it says of `wrong` inputs, or in `wrongly`."""
    wrong: Inputs = field(default_factory=dict)
    wrongly: Act | None = None
    before: Act = standing
    inputs: Inputs = field(default_factory=dict)
    ends: Act = nothing
    """What lets a started command come to its end."""
    aborts: Act | None = stop
    kind: str = "virtual"


EXECUTES = {
    "MC_AbortTrigger": Case(410, wrongly=standing, before=probing),
    "MC_AccelerationProfile": Case(375, {"ArraySize": 0}),
    "MC_CamIn": Case(627, {"StartMode": 2, "VelocityDiff": 0.0}),
    "MC_CamOut": Case(34, wrongly=standing, before=coupled),
    "MC_CamTableSelect": Case(750, wrongly=with_cam(wCamStructID=0)),
    "MC_CombineAxes": Case(675, {"GearRatioDenominatorM1": 0}),
    "MC_GearIn": Case(676, {"Acceleration": 0.0}, before=master_moving),
    "MC_GearInPos": Case(675, {"RatioDenominator": 0}, before=master_moving),
    "MC_GearOut": Case(34, wrongly=standing, before=coupled),
    "MC_Halt": Case(181, {"Deceleration": 0.0}, before=moving),
    "MC_HaltSuperimposed": Case(276, {"Deceleration": 0.0}, before=superimposed, aborts=superimpose),
    "MC_Home": Case(170, wrongly=moving, kind="drive"),
    "MC_ImmediateStop": Case(10015, {"StopMode": 1}, before=moving, aborts=None),
    "MC_MoveAbsolute": Case(201, {"Velocity": 0.0}),
    "MC_MoveAdditive": Case(251, {"Deceleration": -1.0}),
    "MC_MoveContinuousAbsolute": Case(451, {"Velocity": 0.0}),
    "MC_MoveContinuousRelative": Case(426, {"Acceleration": 0.0}),
    "MC_MoveRelative": Case(226, {"Acceleration": 0.0}),
    "MC_MoveSuperImposed": Case(276, {"VelocityDiff": 0.0}, before=moving),
    "MC_MoveVelocity": Case(301, {"Acceleration": -1.0}),
    "MC_Phasing": Case(725, {"Velocity": 0.0}, before=coupled),
    "MC_PhasingAbsolute": Case(725, {"Velocity": 0.0}, before=coupled),
    "MC_PhasingRelative": Case(725, {"Acceleration": 0.0}, before=coupled),
    "MC_PositionProfile": Case(325, {"ArraySize": 0}),
    "MC_Reset": Case(120, wrongly=standing, before=failed),
    "MC_SetPosition": Case(34, wrongly=failed),
    "MC_Stop": Case(181, {"Deceleration": 0.0}, before=moving, aborts=None),
    "MC_TorqueControl": Case(10016, {"TorqueRamp": 0.0}, before=torque_mode, kind="drive"),
    "MC_TouchProbe": Case(400, wrongly=probing, ends=probe_edge, aborts=abort_trigger),
    "MC_VelocityProfile": Case(350, {"ArraySize": 0}),
    "MC_WriteBoolParameter": Case(140, {"ParameterNumber": 99999}),
    "MC_WriteDigitalOutput": Case(10017, {"OutputNumber": 99}),
    "MC_WriteParameter": Case(140, {"ParameterNumber": 99999}),
    "SMC3_BrakeControl": Case(
        NUMBERS["SMC_AXIS_IS_NOT_OPERATIONAL"], wrongly=lambda found: without_bus(found, standing)
    ),
    "SMC3_ReinitDrive": Case(34, wrongly=moving, before=without_power),
    "SMC_BacklashCompensation": Case(725, {"fCompensationVel": 0.0}),
    "SMC_CAMBounds": Case(640, wrongly=with_cam(byType=1, byVarType=6)),
    "SMC_CAMBounds_Pos": Case(640, wrongly=with_cam(byType=1, byVarType=6)),
    "SMC_ChangeGearingRatio": Case(
        90,
        {"dwRatioTechUnitsDenom": 0},
        before=without_power,
        inputs={"dwRatioTechUnitsDenom": 1, "iRatioTechUnitsNum": 1, "fPositionPeriod": 360.0},
    ),
    "SMC_FollowPosition": Case(34, wrongly=failed),
    "SMC_FollowPositionVelocity": Case(34, wrongly=failed),
    "SMC_FollowSetValues": Case(34, wrongly=failed),
    "SMC_FollowVelocity": Case(34, wrongly=failed),
    "SMC_Homing": Case(50, {"fVelocitySlow": 0.0}, ends=pass_switch),
    "SMC_MoveContinuousAbsolute": Case(451, {"Velocity": 0.0}),
    "SMC_MoveContinuousRelative": Case(426, {"Acceleration": 0.0}),
    "SMC_SetControllerMode": Case(
        70,
        {"nControllerMode": "SMC_CONTROLLER_MODE.SMC_current"},
        before=moving_in_fixed_mode,
        inputs={"nControllerMode": "SMC_CONTROLLER_MODE.SMC_velocity"},
        ends=lambda found: found.write("xKeepsMode", False),
        kind="drive",
    ),
    "SMC_SetSoftwareLimits": Case(
        10011,
        {"SWL_Positive": -1.0},
        inputs={"SWL_Activated": True, "SWL_Positive": 100.0, "SWL_Negative": 0.0},
    ),
}


def stands(found: Machine, block: str) -> set[str]:
    """The outputs that say how a command or a block stands, without the b of their names."""
    names = {name.removeprefix("b") for name in found.says(block)}
    return names & {*OVER, *GOALS, *VALID, "Busy", "Active"}


def has_output(block: str, *outputs: str) -> bool:
    return any(pin.name.removeprefix("b") in outputs for pin in BLOCKS[block].outputs)
