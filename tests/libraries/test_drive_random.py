"""Random commands to an axis with a simulated drive, in all its controller modes: it is never lost."""

from __future__ import annotations

import math
from contextlib import ExitStack
from typing import Any

import pytest
from hypothesis import HealthCheck, Phase, settings
from hypothesis import strategies as st
from hypothesis.stateful import RuleBasedStateMachine, initialize, invariant, rule
from tests.libraries.one_axis import STATES
from tests.libraries.st_program import Program, run

CYCLE = 0.002
BLOCKS = {
    "Mode": "SMC_SetControllerMode",
    "Torque": "MC_TorqueControl",
    "Direct": "SMC_SetTorque",
    "To": "MC_MoveAbsolute",
    "By": "MC_MoveAdditive",
    "At": "MC_MoveVelocity",
    "Super": "MC_MoveSuperImposed",
    "Positions": "MC_PositionProfile",
    "Home": "MC_Home",
    "Place": "MC_SetPosition",
    "Halt": "MC_Halt",
    "Stop": "MC_Stop",
    "Freeze": "MC_ImmediateStop",
    "Reset": "MC_Reset",
}
NAMES = {name: f"fb{name}" for name in BLOCKS}
ENABLES = {"Direct": "bEnable", "Mode": "bExecute"}
MODES = {1: "SMC_torque", 2: "SMC_velocity", 3: "SMC_position"}
_CALLS = "\n".join(
    f"{NAMES[name]}(Axis := Axis{', TimePosition := Table' if name == 'Positions' else ''});"
    for name in BLOCKS
)
PROGRAM = f"""
PROGRAM Main
VAR
    Axis  : SM3_Basic.AXIS_REF_MAPPING_SM3 := (
        fTaskCycle := {CYCLE}, iMovementType := 1, fRatedTorque := 1.27,
        dwRatioTechUnitsDenom := 65536, iRatioTechUnitsNum := 1, fSWMaxDeceleration := 200.0);
    Drive : SM3_Basic.SimulatedDrive := (stSettings := (
        fInertia := 1E-3, fVelocityGain := 0.5, diMaxLag := 0));
    Power : SM3_Basic.MC_Power := (Enable := TRUE, bRegulatorOn := TRUE, bDriveStart := TRUE);
    Override : SM3_Basic.MC_SetOverride;
    Table : SM3_Basic.MC_TP_REF := (Number_of_pairs := 2, IsAbsolute := FALSE,
        MC_TP_Array := [(delta_time := T#200ms, position := 4.0), (delta_time := T#200ms)]);
{chr(10).join(f"    {NAMES[name]} : SM3_Basic.{block};" for name, block in BLOCKS.items())}
END_VAR
Axis.in := Drive.stIn;
Axis.BeginCycle();
Power(Axis := Axis);
Override(Axis := Axis);
{_CALLS}
Axis.EndCycle();
Drive(stOut := Axis.out, fCycle := {CYCLE});
END_PROGRAM
"""
RAMPS = {"Acceleration": 50.0, "Deceleration": 50.0, "Jerk": 0.0}
INPUTS: dict[str, dict[str, Any]] = {
    "Torque": {"TorqueRamp": 10.0},
    "To": RAMPS,
    "By": RAMPS,
    "At": RAMPS,
    "Super": {"VelocityDiff": 3.0, **RAMPS},
    "Positions": {"ArraySize": 2},
    "Place": {"Mode": True},
    "Halt": {"Deceleration": 50.0},
    "Stop": {"Deceleration": 50.0},
}
SET_VALUES = ("fSetPosition", "fSetVelocity", "fSetTorque", "fActPosition", "fActVelocity")
waits = st.sampled_from((1, 5, 50, 300))


class DriveMachine(RuleBasedStateMachine):
    """Commands, modes, power and absurd values; at the end the axis is brought to rest and moved."""

    def __init__(self) -> None:
        super().__init__()
        self._stack = ExitStack()
        self.program: Program

    @initialize()
    def begin(self) -> None:
        self.program = self._stack.enter_context(run(PROGRAM, 60, CYCLE * 1000))
        assert self._state() == "standstill"

    def teardown(self) -> None:
        if hasattr(self, "program"):
            try:
                self._bring_to_rest()
            finally:
                self._stack.close()

    @rule(mode=st.sampled_from((1, 1, 2, 3)), cycles=waits)
    def change_mode(self, mode: int, cycles: int) -> None:
        self._start("Mode", cycles, nControllerMode=f"SMC_CONTROLLER_MODE.{MODES[mode]}")

    @rule(
        torque=st.floats(0.0, 1.0),
        velocity=st.sampled_from((0.0, 2.0, 10.0)),
        direction=st.sampled_from((-1, 1)),
        cycles=waits,
    )
    def control_torque(self, torque: float, velocity: float, direction: int, cycles: int) -> None:
        self._start("Torque", cycles, Torque=torque, Velocity=velocity, Direction=direction)

    @rule(torque=st.floats(-0.5, 0.5), cycles=st.sampled_from((1, 50)))
    def set_torque(self, torque: float, cycles: int) -> None:
        self._start("Direct", cycles, fTorque=torque)

    @rule(
        block=st.sampled_from(("To", "By", "At")),
        where=st.floats(-20.0, 20.0),
        velocity=st.floats(1.0, 20.0),
        buffered=st.sampled_from((0, 0, 1)),
        cycles=waits,
    )
    def move(self, block: str, where: float, velocity: float, buffered: int, cycles: int) -> None:
        values: dict[str, Any] = {"Velocity": velocity, "BufferMode": buffered}
        values |= {"To": {"Position": where}, "By": {"Distance": where}, "At": {"Direction": 1}}[block]
        self._start(block, cycles, **values)

    @rule(
        block=st.sampled_from(("Super", "Positions", "Place", "Home", "Halt", "Reset", "Freeze")),
        cycles=waits,
    )
    def command(self, block: str, cycles: int) -> None:
        values = {"Super": {"Distance": 2.0}, "Place": {"Position": 1.5}}.get(block, {})
        self._start(block, cycles, **values)

    @rule(cycles=waits)
    def stop(self, cycles: int) -> None:
        self._start("Stop", cycles)
        self.program.set("Main.fbStop", Execute=False)
        self.wait(2)

    @rule(
        block=st.sampled_from(("Torque", "Direct", "To", "At", "Super")),
        value=st.sampled_from((math.nan, math.inf, -math.inf, 1e300, -1.0, 0.0)),
    )
    def absurd(self, block: str, value: float) -> None:
        pin = {"Torque": "Torque", "Direct": "fTorque", "To": "Position", "At": "Velocity"}.get(
            block, "Distance"
        )
        self._start(block, 3, **{pin: value})
        self.let_go(block)
        self.program.set(f"Main.{NAMES[block]}", **{pin: 1.0})

    @rule(block=st.sampled_from(sorted(set(BLOCKS) - {"Stop"})))
    def let_go(self, block: str) -> None:
        self.program.set(f"Main.{NAMES[block]}", **{ENABLES.get(block, "Execute"): False})
        self.wait(1)

    @rule(factor=st.sampled_from((0.0, 0.4, 1.0)))
    def override(self, factor: float) -> None:
        self.program.set("Main.Override", Enable=True, VelFactor=factor)
        self.wait(1)

    @rule(input=st.sampled_from(("bRegulatorOn", "bDriveStart")), cycles=st.sampled_from((1, 20)))
    def switch_off_and_on(self, input: str, cycles: int) -> None:
        self.program.set("Main.Power", **{input: False})
        self.wait(cycles)
        self.program.set("Main.Power", **{input: True})
        self.wait(30)

    @rule(cycles=waits)
    def wait(self, cycles: int) -> None:
        for _ in range(cycles):
            self.program.cycle()

    def _start(self, block: str, cycles: int, **values: Any) -> None:
        begin = ENABLES.get(block, "Execute")
        self.program.set(f"Main.{NAMES[block]}", **{begin: False})
        self.wait(1)
        self.program.set(f"Main.{NAMES[block]}", **INPUTS.get(block, {}), **values, **{begin: True})
        self.wait(cycles)

    def _state(self) -> str:
        return self.program.literal("Main.Axis.nAxisState").rpartition(".")[2]

    def _says(self, block: str) -> set[str]:
        pins = {"Direct": ("bBusy", "bError")}.get(block, ("Done", "Busy", "CommandAborted", "Error"))
        if block == "Mode":
            pins = ("bDone", "bBusy", "bCommandAborted", "bError")
        if block in ("Place", "Reset"):
            pins = ("Done", "Busy", "Error")
        if block == "Torque":
            pins = ("Busy", "CommandAborted", "Error")
        if block == "At":
            pins = ("Busy", "CommandAborted", "Error")
        if block == "Stop":
            pins = ("Busy", "CommandAborted", "Error")
        return {pin for pin in pins if self.program.literal(f"Main.{NAMES[block]}.{pin}") == "TRUE"}

    @invariant()
    def machine_holds(self) -> None:
        if not hasattr(self, "program"):
            return
        assert self._state() in STATES
        for name in SET_VALUES:
            assert math.isfinite(float(self.program.literal(f"Main.Axis.{name}")))
        for block in BLOCKS:
            assert len(self._says(block)) <= 1, (block, self._says(block))

    def _bring_to_rest(self) -> None:
        """Power and position control come back, everything stands, and a move is made."""
        for block in BLOCKS:
            self.program.set(f"Main.{NAMES[block]}", **{ENABLES.get(block, "Execute"): False})
        self.program.set("Main.Power", bRegulatorOn=True, bDriveStart=True)
        self.program.set("Main.Override", Enable=True, VelFactor=1.0)
        self.wait(3000)
        if self._state() == "errorstop":
            self._start("Reset", 100)
        if self._state() not in ("standstill", "power_off"):
            self._start("Stop", 3000)
            self.program.set("Main.fbStop", Execute=False)
            self.wait(10)
        assert self._state() == "standstill"
        self._start("Mode", 100, nControllerMode="SMC_CONTROLLER_MODE.SMC_position")
        assert self._says("Mode") == {"bDone"}
        self.wait(500)
        target = float(self.program.literal("Main.Axis.fSetPosition")) + 1.0
        self._start("To", 1000, Position=target, Velocity=10.0, BufferMode=0)
        assert self._says("To") == {"Done"}
        assert abs(float(self.program.literal("Main.Axis.fActPosition")) - target) < 0.01
        assert [block for block in BLOCKS if self._says(block) & {"Busy", "bBusy"}] == []


DriveMachine.TestCase.settings = settings(
    max_examples=15,
    stateful_step_count=20,
    deadline=None,
    phases=[Phase.generate],
    suppress_health_check=list(HealthCheck),
)
TestRandomDrives = DriveMachine.TestCase


@pytest.mark.slow
class TestManyRandomDrives(DriveMachine.TestCase):  # type: ignore[name-defined,misc]
    settings = settings(DriveMachine.TestCase.settings, max_examples=400, stateful_step_count=40)
