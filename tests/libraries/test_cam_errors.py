"""What the blocks of cams refuse, and what becomes of a coupling whose axis fails."""

from __future__ import annotations

from collections.abc import Callable

import pytest
from tests.libraries.cam_pair import RAMP, RAMP_IN, CamPair, cam_pair
from tests.libraries.st_program import run

NAN = float("nan")


def _nothing(pair: CamPair) -> None:
    pass


@pytest.mark.parametrize(
    ("members", "error"),
    [
        ({"wCamStructID": 0}, "SMC_NO_CAM_REF_TYPE"),
        ({"nElements": 1}, "SMC_NO_CAM_REF_TYPE"),
        ({"nElements": 0}, "SMC_NO_CAM_REF_TYPE"),
        ({"nElements": -3}, "SMC_NO_CAM_REF_TYPE"),
        ({"pce": 0}, "SMC_NO_CAM_REF_TYPE"),
        ({"byType": 9}, "SMC_NO_CAM_REF_TYPE"),
        ({"xStart": 360.0}, "SMC_NO_CAM_REF_TYPE"),
        ({"xStart": NAN}, "SMC_NO_CAM_REF_TYPE"),
        ({"xEnd": float("inf")}, "SMC_NO_CAM_REF_TYPE"),
        ({"byType": 1, "byVarType": 0}, "SMC_NO_CAM_REF_TYPE"),
        ({"byType": 2, "byVarType": 7}, "SMC_NO_CAM_REF_TYPE"),
        ({"byType": 1, "byVarType": 6}, "SMC_CI_SCALING_INCORRECT"),
    ],
)
def test_a_cam_that_cannot_be_used_is_not_selected(members: dict[str, float], error: str) -> None:
    """Spec CAL-06, CAM-16; ax3000 MC_CamTableSelect."""
    with cam_pair() as pair:
        pair.set("Cam1", **members)
        pair.set("Select1", Execute=True)
        pair.cycle()
        assert pair.says("Select1") == {"Error"}
        assert pair.text("Select1.ErrorID") == error
        assert pair.text("Slave.fbeFBError[0].eErrorID") == error
        pair.couple()
        assert pair.text("CamIn1.ErrorID") == "SMC_CI_NO_CAM_SELECTED"
        pair.set("Select1", Execute=False)
        pair.cycle()
        assert pair.says("Select1") == set()


def test_points_that_fall_back_are_not_selected() -> None:
    with cam_pair(((0, 0, 0, 0), (200, 100, 0, 0), (100, 200, 0, 0), (360, 360, 0, 0))) as pair:
        pair.set("Select1", Execute=True)
        pair.cycle()
        assert pair.text("Select1.ErrorID") == "SMC_NO_CAM_REF_TYPE"


REFUSED: list[tuple[Callable[[CamPair], None], dict[str, float], str]] = [
    (lambda pair: pair.place(400.0, 0.0), {}, "SMC_CI_MASTER_OUT_OF_SCALE"),
    (lambda pair: pair.place(-1.0, 0.0), {}, "SMC_CI_MASTER_OUT_OF_SCALE"),
    (_nothing, {"MasterOffset": 361.0}, "SMC_CI_MASTER_OUT_OF_SCALE"),
    (_nothing, {"MasterStartDistance": 10.0, "MasterSyncPosition": 361.0}, "SMC_CI_MASTER_OUT_OF_SCALE"),
    (_nothing, {"MasterScaling": 0.0}, "SMC_CI_SCALING_INCORRECT"),
    (_nothing, {"SlaveScaling": 0.0}, "SMC_CI_SCALING_INCORRECT"),
    (_nothing, {"SlaveScaling": NAN}, "SMC_CI_SCALING_INCORRECT"),
    (_nothing, {"MasterOffset": NAN}, "SMC_CI_SCALING_INCORRECT"),
    (_nothing, {"SlaveOffset": float("inf")}, "SMC_CI_SCALING_INCORRECT"),
    (_nothing, {"StartMode": RAMP_IN}, "SMC_CI_RAMPIN_NEEDS_VELACC_VALUES"),
    (_nothing, {"StartMode": RAMP_IN, **RAMP, "VelocityDiff": 0.0}, "SMC_CI_RAMPIN_NEEDS_VELACC_VALUES"),
    (_nothing, {"StartMode": RAMP_IN, **RAMP, "Acceleration": NAN}, "SMC_CI_RAMPIN_NEEDS_VELACC_VALUES"),
    (_nothing, {"StartMode": RAMP_IN, **RAMP, "Deceleration": -1.0}, "SMC_CI_RAMPIN_NEEDS_VELACC_VALUES"),
    *(
        (_nothing, {"StartMode": RAMP_IN, **RAMP, pin: float("inf")}, "SMC_CI_RAMPIN_NEEDS_VELACC_VALUES")
        for pin in ("VelocityDiff", "Acceleration", "Deceleration", "Jerk")
    ),
    *(
        (_nothing, {pin: NAN}, "SMC_CI_SCALING_INCORRECT")
        for pin in ("TappetHysteresis", "MasterStartDistance", "MasterSyncPosition")
    ),
]


@pytest.mark.parametrize(("before", "inputs", "error"), REFUSED)
def test_inputs_that_are_refused(
    before: Callable[[CamPair], None], inputs: dict[str, float], error: str
) -> None:
    """Spec cam CAM-103, CAM-104, CAM-110; motion_semantics CAM-16: the slave does not move."""
    with cam_pair() as pair:
        pair.select(1)
        before(pair)
        pair.couple(**inputs)
        assert pair.says("CamIn1") == {"Error"}
        assert pair.text("CamIn1.ErrorID") == error
        assert pair.state == "standstill"
        assert pair.text("Slave.fbeFBError[0].eErrorID") == error
        pair.cycle(3)
        assert pair.says("CamIn1") == {"Error"}
        pair.set("CamIn1", Execute=False)
        pair.cycle()
        assert pair.says("CamIn1") == set()


def test_a_relative_master_needs_zero_in_the_cam() -> None:
    """Spec motion_semantics CAM-05, cam CAM-104."""
    with cam_pair(((10, 0, 0, 0), (360, 100, 0, 0))) as pair:
        pair.select(1, master_absolute=False)
        pair.place(100.0, 0.0)
        pair.couple()
        assert pair.text("CamIn1.ErrorID") == "SMC_CI_MASTER_OUT_OF_SCALE"


@pytest.mark.parametrize("state", ["power_off", "errorstop", "stopping"])
def test_states_in_which_a_slave_takes_no_cam(state: str) -> None:
    """Spec STA-15."""
    with cam_pair() as pair:
        pair.select(1)
        if state == "power_off":
            pair.set("SlavePower", Enable=False)
            pair.cycle(3)
        elif state == "errorstop":
            pair.set("Slave", bSWLimitEnable=True, fSWLimitPositive=1.0, fSWLimitNegative=-1.0)
            pair.start("SlaveTo", Position=50.0, Velocity=50.0, Acceleration=500.0, Deceleration=500.0)
            pair.until(lambda: pair.state == "errorstop")
        else:
            pair.start("SlaveStop", Deceleration=100.0)
        assert pair.state == state
        pair.couple()
        assert pair.says("CamIn1") == {"Error"}
        expected = (
            "SMC_REGULATOR_OR_START_NOT_SET" if state == "power_off" else "SMC_AXIS_NOT_READY_FOR_MOTION"
        )
        assert pair.text("CamIn1.ErrorID") == expected
        assert pair.state == state


def test_a_slave_without_power_fails_its_coupling() -> None:
    """Spec ERR-09, CAL-04."""
    with cam_pair() as pair:
        pair.select(1)
        pair.couple()
        pair.run(100.0)
        pair.cycle(100)
        pair.set("SlavePower", bRegulatorOn=False)
        pair.cycle(3)
        assert pair.says("CamIn1") == {"Error"}
        assert pair.text("CamIn1.ErrorID") == "SMC_FB_ACTIVE_AXIS_DISABLED"
        assert pair.state == "power_off"


def test_software_limits_hold_for_a_coupled_slave() -> None:
    """Spec ax3000 CAM-16."""
    with cam_pair() as pair:
        pair.set(
            "Slave",
            bSWLimitEnable=True,
            fSWLimitPositive=100.0,
            fSWLimitNegative=-1.0,
            fSWMaxDeceleration=1e4,
        )
        pair.select(1)
        pair.couple()
        pair.run(100.0)
        pair.until(lambda: pair.state == "errorstop")
        pair.cycle(100)
        assert 100.0 <= pair.slave < 102.0
        assert pair.says("CamIn1") == {"Error"}
        assert pair.text("CamIn1.ErrorID") == "SMC_DI_SWLIMITS_EXCEEDED"


def test_a_refused_restart_leaves_the_coupling() -> None:
    """Spec EXE-10."""
    with cam_pair() as pair:
        pair.select(1)
        pair.couple()
        pair.set("CamIn1", Execute=False)
        pair.cycle()
        pair.couple(SlaveScaling=0.0)
        assert pair.says("CamIn1") == {"Error"}
        pair.move(60.0)
        assert pair.slave == pytest.approx(41.25, abs=1e-9)
        assert pair.state == "synchronized_motion"


def test_a_buffered_cam_whose_master_is_elsewhere_by_then_fails() -> None:
    with cam_pair() as pair:
        pair.select(1)
        pair.start("SlaveTo", Position=41.25, Velocity=50.0, Acceleration=500.0, Deceleration=500.0)
        pair.couple(BufferMode=1)
        pair.run(1000.0)
        pair.until(lambda: pair.true("SlaveTo.Done"))
        pair.cycle(2)
        assert pair.says("CamIn1") == {"Error"}
        assert pair.text("CamIn1.ErrorID") == "SMC_CI_MASTER_OUT_OF_SCALE"
        assert pair.state == "standstill"
        assert pair.slave == 41.25


def test_an_axis_cannot_lead_itself() -> None:
    """Spec motion_semantics CAM-01."""
    text = """
PROGRAM Main
VAR
    aPoints : ARRAY[0..1] OF SM3_Basic.SMC_CAMXYVA := [(dX := 0), (dX := 360)];
    Cam     : SM3_Basic.MC_CAM_REF := (byType := 3, nElements := 2, xEnd := 360, pce := ADR(aPoints));
    Axis    : SM3_Basic.AXIS_REF_VIRTUAL_SM3;
    Select  : SM3_Basic.MC_CamTableSelect;
    CamIn   : SM3_Basic.MC_CamIn;
    stID    : SM3_Basic.MC_CAM_ID;
END_VAR
stID.pCT := ADR(Cam);
Select(Master := Axis, Slave := Axis, CamTable := Cam, Execute := TRUE);
CamIn(Master := Axis, Slave := Axis, CamTableID := stID, Execute := TRUE);
END_PROGRAM
"""
    with run(text, cycles=1) as program:
        assert program.literal("Main.Select.ErrorID") == "SMC_MASTER_IS_SLAVE"
        assert program.literal("Main.CamIn.ErrorID") == "SMC_MASTER_IS_SLAVE"
