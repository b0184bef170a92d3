"""Controller modes and torques of an axis with a drive (motion_semantics TRQ-01 to TRQ-06)."""

from __future__ import annotations

from itertools import pairwise

import pytest
from tests.libraries.mapped_axis import CYCLE, DEGREES, axis, cycles, number, state, switch_on
from tests.libraries.st_program import Program


def change(program: Program, mode: str) -> None:
    program.set("Main.Mode", bExecute=False)
    program.cycle()
    program.set("Main.Mode", bExecute=True, nControllerMode=f"SMC_CONTROLLER_MODE.SMC_{mode}")
    cycles(program, 5)
    assert program.literal("Main.Mode.bDone") == "TRUE"
    program.set("Main.Mode", bExecute=False)


def test_an_axis_that_stands_changes_its_mode_and_comes_back() -> None:
    with axis(place=700) as program:
        switch_on(program)
        for mode, expected in (("velocity", 2), ("torque", 1), ("position", 3)):
            change(program, mode)
            assert number(program, "Axis.byRealControllerMode") == expected
            assert state(program) == "standstill"
        assert number(program, "liPlace") == 700


def test_a_drive_that_does_not_change_is_an_error_after_1000_cycles() -> None:
    """ax3000, SMC_SetControllerMode."""
    with axis() as program:
        switch_on(program)
        program.set("Main", xFixed=True)
        program.set("Main.Mode", bExecute=True, nControllerMode="SMC_CONTROLLER_MODE.SMC_torque")
        cycles(program, 999)
        assert program.literal("Main.Mode.bBusy") == "TRUE"
        program.cycle()
        assert program.literal("Main.Mode.bError") == "TRUE"
        assert program.literal("Main.Mode.nErrorID") == "SMC_SCM_INTERRUPTED"


@pytest.mark.parametrize("settings", [DEGREES, f"{DEGREES}, bVirtual := TRUE"])
def test_modes_that_a_drive_does_not_have_are_refused(settings: str) -> None:
    wanted = "SMC_torque" if "Virtual" in settings else "SMC_current"
    with axis(settings) as program:
        switch_on(program)
        program.set("Main.Mode", bExecute=True, nControllerMode=f"SMC_CONTROLLER_MODE.{wanted}")
        program.cycle()
        assert program.literal("Main.Mode.nErrorID") == "SMC_SCM_NOT_SUPPORTED"


def test_an_axis_in_errorstop_keeps_its_mode() -> None:
    with axis() as program:
        switch_on(program)
        program.set("Main.Freeze", Execute=True)
        cycles(program, 2)
        program.set("Main.Mode", bExecute=True, nControllerMode="SMC_CONTROLLER_MODE.SMC_torque")
        program.cycle()
        assert program.literal("Main.Mode.nErrorID") == "SMC_SCM_AXIS_IN_WRONG_STATE"


def test_moves_to_positions_need_the_position_control() -> None:
    with axis() as program:
        switch_on(program)
        change(program, "velocity")
        program.set("Main.Move", Execute=True, Position=10.0)
        program.cycle()
        assert program.literal("Main.Move.ErrorID") == "SMC_WRONG_CONTROLLER_MODE"
        program.set("Main.Turn", Execute=True)
        cycles(program, 300)
        assert program.literal("Main.Turn.InVelocity") == "TRUE"
        assert number(program, "fSpeed") == pytest.approx(1800.0)


def test_a_change_up_in_motion_is_smooth() -> None:
    """From velocity to position at 180 degrees/s: each step of the motor is that of the velocity."""
    with axis(f"{DEGREES}, fDeadTimeCycles := 1.0") as program:
        switch_on(program)
        change(program, "velocity")
        program.set("Main.Turn", Execute=True)
        cycles(program, 300)
        program.set("Main.Turn", Execute=False)
        program.set("Main", xFollow=True)
        program.set("Main.Mode", bExecute=True, nControllerMode="SMC_CONTROLLER_MODE.SMC_position")
        places = []
        for _ in range(60):
            program.cycle()
            places.append(number(program, "liPlace"))
        assert program.literal("Main.Mode.bDone") == "TRUE"
        assert state(program) == "continuous_motion"
        steps = [b - a for a, b in pairwise(places)]
        assert max(steps) <= 1800 * CYCLE + 2
        assert min(steps) >= 1800 * CYCLE - 2


def test_an_axis_in_motion_wants_a_command_behind_the_change() -> None:
    with axis() as program:
        switch_on(program)
        program.set("Main.Turn", Execute=True)
        cycles(program, 300)
        program.set("Main.Turn", Execute=False)
        program.set("Main.Mode", bExecute=True, nControllerMode="SMC_CONTROLLER_MODE.SMC_velocity")
        cycles(program, 3)
        assert program.literal("Main.Mode.bDone") == "TRUE"
        cycles(program, 2)
        assert state(program) == "errorstop"


def test_a_torque_rises_by_its_ramp_and_accelerates_the_motor() -> None:
    with axis() as program:
        switch_on(program)
        change(program, "torque")
        program.set(
            "Main.Torque", Execute=True, Torque=1.5, TorqueRamp=10.0, Direction="MC_DIRECTION.negative"
        )
        program.cycle()
        assert state(program) == "continuous_motion"
        cycles(program, 76)
        assert program.literal("Main.Torque.InTorque") == "TRUE"
        assert number(program, "Axis.fSetTorque") == pytest.approx(-1.5)
        assert number(program, "Axis.out.wSetTorque") == -600
        before = number(program, "fSpeed")
        cycles(program, 100)
        assert number(program, "fSpeed") - before == pytest.approx(-1.5 * 2000 * 100 * CYCLE, rel=1e-3)
        assert number(program, "Axis.fSetPosition") == pytest.approx(number(program, "Axis.fActPosition")), (
            "the set position follows"
        )


def test_the_velocity_of_a_torque_is_limited() -> None:
    with axis() as program:
        switch_on(program)
        change(program, "torque")
        program.set("Main.Torque", Execute=True, Torque=1.0, TorqueRamp=1000.0, Velocity=50.0)
        cycles(program, 1000)
        assert number(program, "fSpeed") <= 500 * 1.02
        assert number(program, "fSpeed") >= 450


@pytest.mark.parametrize("block", ["Torque", "Direct"])
def test_a_torque_is_gone_when_the_power_comes_back(block: str) -> None:
    """Its command has failed: nobody may find the motor turning in standstill."""
    with axis() as program:
        switch_on(program)
        change(program, "torque")
        program.set("Main.Torque", Torque=1.0, TorqueRamp=1000.0)
        program.set("Main.Direct", fTorque=1.0)
        program.set(f"Main.{block}", **{"bEnable" if block == "Direct" else "Execute": True})
        cycles(program, 20)
        assert number(program, "Axis.fSetTorque") == 1.0
        program.set("Main.Power", bRegulatorOn=False)
        program.cycle()
        program.set(f"Main.{block}", **{"bEnable" if block == "Direct" else "Execute": False})
        program.set("Main.Power", bRegulatorOn=True)
        cycles(program, 300)
        assert state(program) == "standstill"
        assert number(program, "Axis.fSetTorque") == 0.0
        before = number(program, "fSpeed")
        cycles(program, 100)
        assert number(program, "fSpeed") == before


def test_a_torque_does_not_wait_behind_another_mode() -> None:
    with axis() as program:
        switch_on(program)
        change(program, "torque")
        program.set("Main.Torque", Execute=True, Torque=0.5, TorqueRamp=1000.0)
        cycles(program, 20)
        program.set("Main.Torque", Execute=False)
        program.set("Main", xFollow=True)
        change(program, "position")
        program.set("Main", xFollow=False)
        program.set("Main.Turn", Execute=False)
        program.set("Main.Stop", Execute=True)
        cycles(program, 600)
        program.set("Main.Stop", Execute=False)
        program.cycle()
        change(program, "torque")
        cycles(program, 100)
        assert (number(program, "Axis.fSetTorque"), number(program, "fSpeed")) == (0.0, 0.0)


def test_an_error_brakes_an_axis_with_a_torque_by_its_ramp() -> None:
    with axis(f"{DEGREES}, fSWMaxDeceleration := 100.0") as program:
        switch_on(program)
        change(program, "torque")
        program.set("Main.Torque", Execute=True, Torque=1.0, TorqueRamp=1000.0)
        cycles(program, 100)
        speed = number(program, "fSpeed")
        assert speed > 100.0
        program.set("Main.Axis", bSWLimitEnable=True)
        cycles(program, 2)
        assert state(program) == "errorstop"
        cycles(program, round(speed / 10.0 / 100.0 / CYCLE) + 20)
        assert (number(program, "fSpeed"), number(program, "Axis.fSetTorque")) == (0.0, 0.0)


def test_a_torque_needs_its_mode_and_values() -> None:
    with axis() as program:
        switch_on(program)
        program.set("Main.Torque", Execute=True, Torque=1.0, TorqueRamp=10.0)
        program.set("Main.Direct", bEnable=True, fTorque=1.0)
        program.cycle()
        assert program.literal("Main.Torque.ErrorID") == "SMC_WRONG_CONTROLLER_MODE"
        assert program.literal("Main.Direct.nErrorID") == "SMC_ST_WRONG_CONTROLLER_MODE"
        program.set("Main.Torque", Execute=False)
        program.set("Main.Direct", bEnable=False)
        change(program, "torque")
        for wrong in ({"TorqueRamp": 0.0}, {"Torque": -1.0}, {"Direction": "MC_DIRECTION.shortest"}):
            good = {"Torque": 1.0, "TorqueRamp": 10.0, "Direction": "MC_DIRECTION.positive"}
            program.set("Main.Torque", Execute=False)
            program.cycle()
            program.set("Main.Torque", Execute=True, **(good | wrong))
            program.cycle()
            assert program.literal("Main.Torque.ErrorID") == "SMC_TC_INVALID_TORQUE"
            assert state(program) == "standstill"


def test_a_torque_that_is_set_directly_ends_with_its_enable_or_a_stop() -> None:
    with axis(f"{DEGREES}, fMaxTorque := 0.5") as program:
        switch_on(program)
        change(program, "torque")
        program.set("Main.Direct", bEnable=True, fTorque=2.0)
        cycles(program, 50)
        assert program.literal("Main.Direct.bBusy") == "TRUE"
        assert number(program, "Axis.fSetTorque") == pytest.approx(0.5)
        program.set("Main.Direct", bEnable=False)
        cycles(program, 2)
        assert number(program, "Axis.fSetTorque") == 0.0
        assert state(program) == "standstill"
        program.set("Main.Direct", bEnable=True)
        cycles(program, 200)
        assert number(program, "fSpeed") > 100
        program.set("Main.Stop", Execute=True)
        program.cycle()
        assert state(program) == "stopping"
        cycles(program, 600)
        assert program.literal("Main.Stop.Done") == "TRUE"
        assert number(program, "Axis.byRealControllerMode") == 3
        assert number(program, "fSpeed") == 0.0
        assert program.literal("Main.Direct.bError") == "TRUE"
