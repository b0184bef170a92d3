"""Blocks that watch an axis, set its software limits and its brake."""

from __future__ import annotations

from collections import deque
from collections.abc import Iterator
from contextlib import contextmanager

import pytest
from tests.libraries.st_program import Program, run

CYCLE_MS = 2.5
"""Of motion_semantics EX-29."""
PROGRAM = """
PROGRAM Main
VAR
    Axis       : SM3_Basic.AXIS_REF_VIRTUAL_SM3 := (fTaskCycle := 0.0025, iMovementType := ROTARY,
        fMaxVelocity := 1E5, fMaxAcceleration := 1E6, fMaxDeceleration := 1E6);
    Power      : SM3_Basic.MC_Power;
    Velocity   : SM3_Basic.MC_MoveVelocity;
    Relative   : SM3_Basic.MC_MoveRelative;
    Limits     : SM3_Basic.SMC_CheckLimits;
    MaxVel     : SM3_Basic.SMC_GetMaxSetVelocity;
    MaxAcc     : SM3_Basic.SMC_GetMaxSetAccDec;
    Lag        : SM3_Basic.SMC_GetTrackingError;
    InPosition : SM3_Basic.SMC_InPosition;
    Distance   : SM3_Basic.SMC_MeasureDistance;
    SetLimits  : SM3_Basic.SMC_SetSoftwareLimits;
    Bus        : SM3_Basic.SMC_CheckAxisCommunication;
    Brake      : SM3_Basic.SMC3_BrakeControl;
    BrakeState : SM3_Basic.SMC3_BrakeStatus;
    Motion     : SM3_Basic.MC_ReadMotionState;
    Place      : SM3_Basic.MC_SetPosition;
    dwCycle    : DWORD;
    fAhead     : LREAL; (* The actual position is ahead of the set position by this *)
    xWithoutBus : BOOL;
    wBus       : WORD; (* Communication state while there is none *)
END_VAR
dwCycle := dwCycle + 1;
Axis.BeginCycle();
Axis.fActPosition := Axis.fActPosition + fAhead;
IF xWithoutBus THEN Axis.wCommunicationState := wBus; END_IF
Power(Axis := Axis, Enable := TRUE, bRegulatorOn := TRUE, bDriveStart := TRUE);
Velocity(Axis := Axis);
Relative(Axis := Axis);
Limits(Axis := Axis);
MaxVel(Axis := Axis, dwTimeStamp := dwCycle);
MaxAcc(Axis := Axis, dwTimeStamp := dwCycle);
Lag(Axis := Axis, dwTimeStamp := dwCycle);
InPosition(Axis := Axis);
Distance(Axis := Axis);
Motion(Axis := Axis);
Place(Axis := Axis);
SetLimits(Axis := Axis);
Bus(Axis := Axis);
Brake(Axis := Axis);
BrakeState(Axis := Axis);
Axis.EndCycle();
END_PROGRAM
"""


class Watched:
    """A powered axis and what watches it."""

    def __init__(self, program: Program) -> None:
        self._program = program

    def set(self, variable: str, **members: float | bool | str) -> None:
        self._program.set(f"Main.{variable}" if variable else "Main", **members)

    def cycle(self, count: int = 1) -> None:
        for _ in range(count):
            self._program.cycle()

    def text(self, path: str) -> str:
        return self._program.literal(f"Main.{path}")

    def number(self, path: str) -> float:
        return float(self.text(path))

    def true(self, path: str) -> bool:
        return self.text(path) == "TRUE"

    def until_done(self) -> None:
        for _ in range(20_000):
            if self.true("Relative.Done"):
                return
            self.cycle()
        raise AssertionError("the motion never ended")


@contextmanager
def watched(rotary: bool = False) -> Iterator[Watched]:
    with run(PROGRAM.replace("ROTARY", "0" if rotary else "1"), 5) as program:
        axis = Watched(program)
        assert axis.text("Axis.nAxisState") == "standstill"
        yield axis


@pytest.fixture
def axis() -> Iterator[Watched]:
    with watched() as one:
        yield one


@pytest.fixture
def rotary() -> Iterator[Watched]:
    with watched(rotary=True) as one:
        yield one


def run_at(axis: Watched, velocity: float) -> None:
    axis.set("Velocity", Velocity=velocity, Acceleration=200.0, Deceleration=200.0, Execute=True)


def test_limits_are_only_told(axis: Watched) -> None:
    """DIA-02: as soon as the set velocity is beyond fSWMaxVelocity, and the axis goes on."""
    axis.set("Limits", bEnable=True)
    run_at(axis, 120.0)
    told = set()
    for _ in range(400):
        beyond = axis.number("Axis.fSetVelocity") > 100.0000001
        axis.cycle()
        assert axis.true("Limits.bLimitsExceeded") == beyond
        told.add(beyond)
    assert told == {False, True}
    assert axis.true("Limits.bLimitsExceeded")
    assert axis.true("Limits.bBusy")
    assert axis.text("Axis.nAxisState") == "continuous_motion"
    axis.set("Limits", bCheckVel=False)
    axis.cycle()
    assert not axis.true("Limits.bLimitsExceeded")
    axis.set("Limits", bCheckVel=True, bEnable=False)
    axis.cycle()
    assert not axis.true("Limits.bLimitsExceeded")
    assert not axis.true("Limits.bBusy")


@pytest.mark.parametrize(
    ("acceleration", "deceleration", "speeding", "braking"),
    [(150.0, 50.0, True, False), (50.0, 150.0, False, True), (100.0, 100.0, False, False)],
)
def test_limits_of_acceleration_and_deceleration(
    axis: Watched, acceleration: float, deceleration: float, speeding: bool, braking: bool
) -> None:
    axis.set("Limits", bEnable=True, bCheckVel=False, bCheckAccDec=True)
    axis.set(
        "Relative",
        Distance=80.0,
        Velocity=50.0,
        Execute=True,
        Acceleration=acceleration,
        Deceleration=deceleration,
    )
    seen = {1.0: False, -1.0: False}
    while not axis.true("Relative.Done"):
        sign = axis.number("Axis.fSetAcceleration")
        axis.cycle()
        if axis.true("Limits.bLimitsExceeded"):
            seen[1.0 if sign > 0 else -1.0] = True
    assert (seen[1.0], seen[-1.0]) == (speeding, braking)


def test_an_axis_with_an_error_is_not_checked(axis: Watched) -> None:
    axis.set("Limits", bEnable=True)
    axis.set("Bus", bEnable=True)
    axis.set("Axis", bError=True)
    axis.cycle()
    assert (axis.true("Limits.bError"), axis.text("Limits.iErrorID")) == (True, "SMC_DI_AXIS_ERROR")
    assert not axis.true("Limits.bBusy")
    assert (axis.true("Bus.bError"), axis.text("Bus.eErrorID")) == (True, "SMC_DI_AXIS_ERROR")
    assert not axis.true("Bus.bValid")


def test_largest_set_values_and_when_they_were(axis: Watched) -> None:
    """DIA-03, with acceleration 100 and deceleration 200."""
    axis.set("MaxVel", bEnable=True)
    axis.set("MaxAcc", bEnable=True)
    axis.set("Relative", Distance=-50.0, Velocity=30.0, Acceleration=100.0, Deceleration=200.0, Execute=True)
    largest, when = 0.0, 0.0
    while not axis.true("Relative.Done"):
        velocity = abs(axis.number("Axis.fSetVelocity"))
        axis.cycle()
        if velocity > largest:
            largest, when = velocity, axis.number("dwCycle")
    assert axis.number("MaxVel.fMaxVelocity") == largest == pytest.approx(30.0, rel=1e-12)
    assert axis.number("MaxVel.dwTimeAtMax") == when
    assert axis.number("MaxAcc.fMaxAcceleration") == pytest.approx(200.0, rel=1e-12)
    for block in ("MaxVel", "MaxAcc"):
        axis.set(block, bEnable=False)
    axis.cycle()
    assert axis.number("MaxVel.fMaxVelocity") == largest
    assert not axis.true("MaxVel.bValid")
    for block, value in (("MaxVel", "fMaxVelocity"), ("MaxAcc", "fMaxAcceleration")):
        axis.set(block, bEnable=True, bResetMax=True)
        axis.cycle()
        assert (axis.number(f"{block}.{value}"), axis.number(f"{block}.dwTimeAtMax")) == (0.0, 0.0)


@pytest.mark.parametrize("dead_time", [0, 2, 255])
def test_lag_is_against_the_set_position_of_then(rotary: Watched, dead_time: int) -> None:
    """DIA-04: the reference is a queue of set positions."""
    rotary.set("Axis", fPositionPeriod=20.0)
    run_at(rotary, 100.0)
    rotary.cycle(100)
    rotary.set("Lag", bEnable=True, byDeadTimeCycles=dead_time)
    positions: deque[float] = deque(maxlen=dead_time + 1)
    largest, when = 0.0, 0.0
    for number in range(dead_time + 40):
        rotary.set("", fAhead=-0.01 * (number % 7))
        positions.append(rotary.number("Axis.fSetPosition"))
        rotary.cycle()
        assert rotary.true("Lag.bValid") == (number >= dead_time)
        if number < dead_time:
            continue
        assert rotary.number("Lag.fActTrackingError") == pytest.approx(
            (positions[0] - positions[-1] + 0.01 * (number % 7) + 10.0) % 20.0 - 10.0, abs=1e-9
        )
        if abs(rotary.number("Lag.fActTrackingError")) > largest:
            largest, when = abs(rotary.number("Lag.fActTrackingError")), rotary.number("dwCycle")
    assert rotary.number("Lag.fMaxTrackingError") == largest
    assert rotary.number("Lag.dwTimeAtMax") == when
    rotary.set("Lag", bResetMax=True)
    rotary.cycle()
    assert rotary.number("Lag.fMaxTrackingError") == 0.0


def test_another_position_for_the_same_place_is_no_lag(rotary: Watched) -> None:
    run_at(rotary, 100.0)
    rotary.cycle(500)
    rotary.set("Lag", bEnable=True, byDeadTimeCycles=1)
    rotary.cycle(20)
    for position in (200.0, -50.0):
        rotary.set("Place", Execute=True, Position=position)
        rotary.cycle(5)
        rotary.set("Place", Execute=False)
        rotary.cycle()
    in_a_cycle = 100.0 * CYCLE_MS / 1000
    assert rotary.number("Lag.fMaxTrackingError") == pytest.approx(in_a_cycle, abs=1e-9)


def test_in_position_after_some_time_in_the_window(axis: Watched) -> None:
    """motion_semantics EX-29 and ax3000 EX-AX-09: 10 ms are 4 cycles of 2.5 ms."""
    axis.set("", fAhead=0.5)
    axis.set("InPosition", bEnable=True, fPosWindow=0.1, fPosTime=0.01)
    axis.cycle(10)
    assert not axis.true("InPosition.bInPosition")
    axis.set("", fAhead=-0.05)
    found = []
    for _ in range(7):
        axis.cycle()
        found.append(axis.true("InPosition.bInPosition"))
    assert found == [False] * 4 + [True] * 3
    axis.set("", fAhead=-0.11)
    axis.cycle()
    assert not axis.true("InPosition.bInPosition")
    assert axis.number("InPosition.fCurrentDistance") == pytest.approx(0.11)
    axis.set("", fAhead=0.0)
    axis.cycle(5)
    assert axis.true("InPosition.bInPosition")
    axis.set("InPosition", bEnable=False)
    axis.cycle()
    assert not axis.true("InPosition.bInPosition")
    assert not axis.true("InPosition.bBusy")


def test_short_stays_in_the_window_do_not_add_up(axis: Watched) -> None:
    axis.set("InPosition", bEnable=True, fPosWindow=0.1, fPosTime=0.01)
    for _ in range(5):
        axis.set("", fAhead=0.0)
        axis.cycle(4)
        assert not axis.true("InPosition.bInPosition")
        axis.set("", fAhead=0.2)
        axis.cycle()


def test_a_cam_that_leaves_the_window_in_each_period_is_never_in_position(axis: Watched) -> None:
    """ax3000 EX-AX-09: inside for 1.5 s of each 2 s, with a time of more than 1.5 s."""
    axis.set("InPosition", bEnable=True, fPosWindow=0.1, fPosTime=1.5025)
    for _ in range(3):
        axis.set("", fAhead=0.0)
        for _ in range(600):
            axis.cycle()
            assert not axis.true("InPosition.bInPosition")
        axis.set("", fAhead=0.2)
        axis.cycle(200)


def test_a_window_over_the_end_of_the_period(rotary: Watched) -> None:
    rotary.set("", fAhead=359.95)
    rotary.set("InPosition", bEnable=True, fPosWindow=0.1)
    rotary.cycle()
    assert rotary.true("InPosition.bInPosition")


def test_time_out_of_in_position(axis: Watched) -> None:
    """Of fTimeOut, once it has not been in position since bEnable; 0 is never."""
    axis.set("", fAhead=0.5)
    axis.set("InPosition", bEnable=True, fPosWindow=0.1, fTimeOut=0.02)
    found = []
    for _ in range(12):
        axis.cycle()
        found.append(axis.true("InPosition.bTimeOut"))
    assert found == [False] * 8 + [True] * 4
    axis.set("InPosition", bEnable=False)
    axis.cycle()
    assert not axis.true("InPosition.bTimeOut")
    axis.set("InPosition", bEnable=True, fTimeOut=0.0)
    axis.cycle(100)
    assert not axis.true("InPosition.bTimeOut")


def test_distance_with_whole_turns(rotary: Watched) -> None:
    """DIA-06: from 350 on to 20 are 30, and three turns more are 1110."""
    rotary.set("Relative", Distance=350.0, Velocity=1e3, Acceleration=1e5, Deceleration=1e5, Execute=True)
    rotary.until_done()
    rotary.cycle(2)
    rotary.set("Distance", bExecute=True)
    rotary.cycle()
    assert rotary.number("Distance.fDistance") == 0.0
    for distance, total in ((30.0, 30.0), (1080.0, 1110.0), (-1120.0, -10.0)):
        rotary.set("Relative", Execute=False)
        rotary.cycle()
        rotary.set("Relative", Distance=distance, Execute=True)
        rotary.cycle()
        rotary.until_done()
        rotary.cycle(2)
        assert rotary.number("Distance.fDistance") == pytest.approx(total, abs=1e-9)
    rotary.set("Distance", bExecute=False)
    rotary.cycle()
    assert not rotary.true("Distance.bBusy")
    assert rotary.number("Distance.fDistance") == pytest.approx(-10.0, abs=1e-9)
    rotary.set("Distance", bExecute=True)
    rotary.cycle()
    assert rotary.number("Distance.fDistance") == 0.0


@pytest.mark.parametrize(
    ("deceleration", "configured", "distance", "effective"),
    [(200.0, 300.0, 10.0, 500.0), (200.0, 1000.0, 10.0, 1000.0), (400.0, 300.0, 0.0, 400.0)],
)
def test_how_an_axis_stops_at_a_software_limit(
    axis: Watched, deceleration: float, configured: float, distance: float, effective: float
) -> None:
    """ax3000 EX-AX-07: the largest of three decelerations."""
    axis.set("Axis", fSWMaxDeceleration=configured)
    axis.set(
        "SetLimits",
        SWL_Activated=True,
        SWL_Positive=60.0,
        SWL_Negative=-10.0,
        bExecute=True,
        SWL_Error_Deceleration=deceleration,
        SWL_Error_MaxDistance=distance,
    )
    run_at(axis, 100.0)
    axis.cycle()
    assert axis.true("SetLimits.bDone")
    while axis.text("Axis.nAxisState") == "continuous_motion":
        axis.cycle()
    assert axis.text("Axis.nAxisState") == "errorstop"
    assert axis.text("Velocity.ErrorID") in ("SMC_DI_SWLIMITS_EXCEEDED", "SMC_NO_ERROR")
    axis.cycle(2)
    before = axis.number("Axis.fSetVelocity")
    axis.cycle()
    assert before - axis.number("Axis.fSetVelocity") == pytest.approx(effective * 0.0025, rel=1e-6)


@pytest.mark.parametrize(
    "inputs",
    [
        {"SWL_Positive": 1.0, "SWL_Negative": 1.0},
        {"SWL_Positive": -1.0, "SWL_Negative": 1.0},
        {"SWL_Positive": 1.0, "SWL_Error_Deceleration": -1.0},
        {"SWL_Positive": 1.0, "SWL_Error_MaxDistance": -1.0},
        {"SWL_Positive": float("nan"), "SWL_Negative": -1.0},
        {"SWL_Positive": float("inf"), "SWL_Negative": -1.0},
    ],
)
def test_limits_that_are_none_are_refused(axis: Watched, inputs: dict[str, float]) -> None:
    axis.set("SetLimits", SWL_Activated=True, bExecute=True, **inputs)
    axis.cycle()
    assert (axis.true("SetLimits.bError"), axis.text("SetLimits.ErrorID")) == (True, "SMC_SWL_INVALID_LIMITS")
    assert not axis.true("SetLimits.bDone")
    assert not axis.true("Axis.bSWLimitEnable")
    assert axis.text("Axis.fbeFBError[0].eErrorID") == "SMC_SWL_INVALID_LIMITS"


@pytest.mark.parametrize(
    ("number", "state"),
    [
        (0, "SMC_COMSTATE_INIT"),
        (7, "SMC_COMSTATE_PREOPERATIONAL"),
        (60, "SMC_COMSTATE_SAFEOPERATIONAL"),
        (100, "SMC_COMSTATE_OPERATIONAL"),
        (1001, "SMC_COMSTATE_ERROR"),
        (0xFFFF, "SMC_COMSTATE_UNKNOWN"),
    ],
)
def test_state_of_the_communication(axis: Watched, number: int, state: str) -> None:
    """ax3000 DIAG-06."""
    axis.set("", xWithoutBus=True, wBus=number)
    axis.set("Bus", bEnable=True)
    axis.cycle()
    assert (axis.text("Bus.eComState"), axis.number("Bus.wComState")) == (state, number)
    assert axis.true("Bus.bOperational") == (number == 100)
    assert axis.true("Bus.bValid")


def test_the_brake_is_told_and_read(axis: Watched) -> None:
    """PWR-07."""
    axis.set("Brake", eSetBrake=2, bExecute=True)
    axis.set("BrakeState", bEnable=True)
    axis.cycle()
    assert axis.text("Axis.eBrakeControl") == "SMC_BRAKE_CLOSE"
    assert axis.true("Brake.bDone")
    assert not axis.true("BrakeState.bBrakeClosed")
    axis.set("Axis", bBrakeClosedRealState=True)
    axis.set("Brake", eSetBrake=0)
    axis.cycle()
    assert axis.text("Axis.eBrakeControl") == "SMC_BRAKE_CLOSE"
    assert axis.true("BrakeState.bBrakeClosed")
    assert axis.text("Axis.nAxisState") == "standstill"


def test_an_axis_without_a_bus(axis: Watched) -> None:
    """ENA-03: the error stays while the cause lasts."""
    axis.set("", xWithoutBus=True, wBus=7)
    axis.set("Brake", eSetBrake=1, bExecute=True)
    axis.set("BrakeState", bEnable=True)
    axis.set("Distance", bExecute=True)
    axis.cycle()
    for block in ("Brake", "BrakeState", "Distance"):
        assert axis.true(f"{block}.bError")
        assert axis.text(f"{block}.nErrorID") == "SMC_AXIS_IS_NOT_OPERATIONAL"
        assert not axis.true(f"{block}.bBusy")
    assert axis.text("Axis.eBrakeControl") == "SMC_BRAKE_AUTO"
    axis.set("", xWithoutBus=False)
    axis.cycle()
    assert axis.true("BrakeState.bValid")


@pytest.mark.parametrize("source", ["Set", "Act"])
@pytest.mark.parametrize(
    ("velocity", "acceleration", "wanted"),
    [
        (3.0, 2.0, {"Accelerating", "DirectionPositive"}),
        (3.0, -2.0, {"Decelerating", "DirectionPositive"}),
        (-3.0, -2.0, {"Accelerating", "DirectionNegative"}),
        (-3.0, 2.0, {"Decelerating", "DirectionNegative"}),
        (-3.0, 0.0, {"ConstantVelocity", "DirectionNegative"}),
        (0.0, 0.0, set()),
    ],
)
def test_how_an_axis_moves(source: str, velocity: float, acceleration: float, wanted: set[str]) -> None:
    """PLCopen part 1, MC_ReadMotionState; an axis without bus cycles keeps what it is given."""
    text = PROGRAM.replace("Axis.BeginCycle();", "").replace("Axis.EndCycle();", "").replace("ROTARY", "1")
    with run(text, 0) as program:
        axis = Watched(program)
        axis.set("Axis", **{f"f{source}Velocity": velocity, f"f{source}Acceleration": acceleration})
        axis.set("Axis", wCommunicationState=100)
        axis.set("Motion", Enable=True, Source={"Set": 1, "Act": 2}[source])
        axis.cycle()
        outputs = (
            "ConstantVelocity",
            "Accelerating",
            "Decelerating",
            "DirectionPositive",
            "DirectionNegative",
        )
        assert {name for name in outputs if axis.true(f"Motion.{name}")} == wanted
        assert axis.true("Motion.Valid")
        axis.set("Axis", wCommunicationState=7)
        axis.cycle()
        assert axis.text("Motion.ErrorID") == "SMC_AXIS_IS_NOT_OPERATIONAL"
        assert not any(axis.true(f"Motion.{name}") for name in (*outputs, "Valid", "Busy"))
