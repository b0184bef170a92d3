"""The largest velocity of MC_TorqueControl against closed forms and a servo with friction."""

from __future__ import annotations

import math
from itertools import pairwise

import numpy as np
import pytest
from tests.libraries.mapped_axis import CYCLE, axis, cycles, number, switch_on
from tests.libraries.st_program import run
from tests.libraries.test_controller_modes import change

SERVO = """
PROGRAM Main
VAR
    Axis   : SM3_Basic.AXIS_REF_MAPPING_SM3 := (fTaskCycle := {cycle}, iMovementType := 1,
        dwRatioTechUnitsDenom := 65536, iRatioTechUnitsNum := 1, fRatedTorque := 1.27,
        fSWMaxDeceleration := 1000.0);
    Drive  : SM3_Basic.SimulatedDrive := (stSettings := ({settings}));
    Power  : SM3_Basic.MC_Power;
    Mode   : SM3_Basic.SMC_SetControllerMode;
    Torque : SM3_Basic.MC_TorqueControl;
END_VAR
Axis.in := Drive.stIn;
Axis.BeginCycle();
Power(Axis := Axis, Enable := TRUE, bRegulatorOn := TRUE, bDriveStart := TRUE);
Mode(Axis := Axis, bExecute := Power.Status, nControllerMode := SM3_Basic.SMC_CONTROLLER_MODE.SMC_torque);
Torque(Axis := Axis);
Axis.EndCycle();
Drive(stOut := Axis.out, fCycle := {cycle});
END_PROGRAM
"""
"""Units are turns of the motor."""


def test_a_free_mass_comes_to_the_limit_exponentially() -> None:
    """1 Nm accelerates by 200 u/s2; near the limit the rest of the velocity falls as exp(-t/T)."""
    limit, acceleration, time = 50.0, 200.0, 20 * CYCLE
    with axis() as program:
        switch_on(program)
        change(program, "torque")
        program.set("Main.Torque", Execute=True, Torque=1.0, TorqueRamp=1000.0, Velocity=limit)
        speeds = []
        for _ in range(400):
            program.cycle()
            speeds.append(number(program, "fSpeed") / 10.0)
    assert max(speeds) <= limit * 1.002
    begins = (limit - acceleration * time) / acceleration
    found = np.array(speeds)
    at = np.arange(1, len(speeds) + 1) * CYCLE
    offset = found[20] / acceleration - at[20]
    expected = np.where(
        at + offset < begins,
        acceleration * (at + offset),
        limit - acceleration * time * np.exp(-(at + offset - begins) / time),
    )
    assert np.abs(found - expected).max() < 0.03 * limit
    assert found[-1] == pytest.approx(limit, rel=1e-3)


@pytest.mark.parametrize("sign", [1, -1])
@pytest.mark.parametrize("ramp", [2.0, 20.0, 1000.0])
@pytest.mark.parametrize("dry", [0.0, 0.3, 0.7])
@pytest.mark.parametrize(
    ("inertia", "cycle"), [(1e-4, 0.001), (1e-3, 0.001), (5e-3, 0.001), (1e-3, 0.004), (1e-2, 0.004)]
)
def test_a_servo_settles_at_the_limit(
    inertia: float, dry: float, ramp: float, cycle: float, sign: int
) -> None:
    """Whatever inertia and friction it has: hardly above the limit, with the torque of friction there."""
    limit, torque, viscous = 20.0, 0.5, 1e-4
    settings = f"fInertia := {inertia}, fDry := {dry * torque}, fViscous := {viscous}, fNoise := 0.0"
    text = SERVO.format(settings=settings, cycle=cycle)
    with run(text, 60, cycle * 1000) as program:
        assert program.literal("Main.Mode.bDone") == "TRUE"
        program.set("Main.Torque", Execute=True, Torque=torque, TorqueRamp=ramp, Velocity=limit)
        program.set("Main.Torque", Direction=sign)
        seconds = 2.0 + 30.0 * torque / ramp + 4.0 * inertia * limit * 2 * math.pi / (torque * (1.0 - dry))
        speeds, torques = [], []
        for _ in range(round(seconds / cycle)):
            program.cycle()
            speeds.append(sign * float(program.literal("Main.Axis.fActVelocity")))
            torques.append(sign * float(program.literal("Main.Axis.fSetTorque")))
    assert max(speeds) <= limit * 1.1
    assert np.mean(speeds[-20:]) == pytest.approx(limit, rel=0.01)
    friction = dry * torque + viscous * limit * 2 * math.pi
    assert np.mean(torques[-20:]) == pytest.approx(friction, rel=0.05, abs=0.01)
    last = torques[-round(0.5 / cycle) :]
    assert max(last) - min(last) < 0.1 * torque, "it does not chatter"
    assert max(abs(b - a) for a, b in pairwise(torques)) <= ramp * cycle * (1 + 1e-9)


def test_a_heavier_load_gets_the_whole_torque_again() -> None:
    with run(
        SERVO.format(settings="fInertia := 1E-3, fDry := 0.05, fNoise := 0.0", cycle=0.002), 60, 2
    ) as program:
        program.set("Main.Torque", Execute=True, Torque=0.5, TorqueRamp=20.0, Velocity=20.0)
        cycles(program, 1000)
        assert program.literal("Main.Torque.InTorque") == "FALSE"
        program.set("Main.Drive.stSettings", fDry=0.49)
        cycles(program, 2000)
        assert program.literal("Main.Torque.InTorque") == "TRUE"
        program.set("Main.Drive.stSettings", fDry=0.05)
        fastest = 0.0
        for _ in range(2000):
            program.cycle()
            fastest = max(fastest, float(program.literal("Main.Axis.fActVelocity")))
        assert fastest < 20.0 * 1.15
        assert float(program.literal("Main.Axis.fActVelocity")) == pytest.approx(20.0, rel=0.01)
