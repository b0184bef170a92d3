"""From the path to the axes: SMC_ControlAxisByPos, ...PosVel and ...Vel with a virtual axis."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager

import numpy as np
import pytest
from tests.libraries.st_program import Program, run

CYCLE = 0.004
CALLS = 2000
BLOCKS = ("ByPos", "ByPosVel", "ByVel")
PROGRAM = f"""
PROGRAM Main
VAR
    Axis  : SM3_Basic.AXIS_REF_VIRTUAL_SM3 := (
        fTaskCycle := {CYCLE}, fSWMaxVelocity := 1000, fSWMaxAcceleration := 10000,
        fSWMaxDeceleration := 10000, fMaxVelocity := 1E9, fMaxAcceleration := 1E12, fMaxDeceleration := 1E12);
    Power : SM3_Basic.MC_Power := (Enable := TRUE, bRegulatorOn := TRUE, bDriveStart := TRUE);
    Other : SM3_Basic.MC_MoveVelocity := (Velocity := 10, Acceleration := 100, Deceleration := 100,
        Direction := SM3_Basic.MC_DIRECTION.positive);
    ByPos    : SM3_CNC.SMC_ControlAxisByPos := (
        iStatus := SM3_Basic.SMC_INT_STATUS.IPO_CONSTANT, bAvoidGaps := TRUE,
        fGapVelocity := 50, fGapAcceleration := 100, fGapDeceleration := 100);
    ByPosVel : SM3_CNC.SMC_ControlAxisByPosVel := (
        iStatus := SM3_Basic.SMC_INT_STATUS.IPO_CONSTANT, bAvoidGaps := TRUE,
        fGapVelocity := 50, fGapAcceleration := 100, fGapDeceleration := 100);
    ByVel    : SM3_CNC.SMC_ControlAxisByVel := (
        iStatus := SM3_Basic.SMC_INT_STATUS.IPO_CONSTANT, fGapAcceleration := 100, fGapDeceleration := 200);
    nCalls, n : DINT;
    aPosition, aVelocity, aStop : ARRAY[0..{CALLS - 1}] OF LREAL;
END_VAR
FOR n := 0 TO nCalls - 1 DO
    Axis.BeginCycle();
    Power(Axis := Axis);
    ByPos(Axis := Axis);
    ByPosVel(Axis := Axis);
    ByVel(Axis := Axis);
    Other(Axis := Axis);
    Axis.EndCycle();
    aPosition[n] := Axis.fSetPosition;
    aVelocity[n] := Axis.fSetVelocity;
    aStop[n] := BOOL_TO_INT(ByPos.bStopIpo OR ByPosVel.bStopIpo OR ByVel.bStopIpo);
END_FOR
END_PROGRAM
"""


class Axis:
    """The running program."""

    def __init__(self, program: Program) -> None:
        self.program = program

    def set(self, block: str, **inputs: float | bool | str) -> None:
        self.program.set(f"Main.{block}", **inputs)

    def calls(self, count: int) -> dict[str, np.ndarray]:
        self.program.set("Main", nCalls=count)
        self.program.cycle()
        return {
            n: np.array(self.program.numbers(f"Main.{n}")[:count])
            for n in ("aPosition", "aVelocity", "aStop")
        }

    def says(self, path: str) -> str:
        return self.program.literal(f"Main.{path}")


@contextmanager
def axis() -> Iterator[Axis]:
    with run(PROGRAM, cycles=0) as program:
        found = Axis(program)
        found.calls(5)
        assert found.says("Axis.nAxisState") == "standstill"
        yield found


@pytest.mark.parametrize("block", ["ByPos", "ByPosVel"])
def test_a_jump_is_bridged(block: str) -> None:
    """Spec cnc_runtime EX-40, CNCR-171: 100 u with 50 u/s, 100 u/s2 take 2.5 s."""
    with axis() as one:
        one.set(block, bEnable=True, fSetPosition=100.0)
        found = one.calls(640)
        assert found["aStop"][0] == 1
        arrived = int(np.argmax(found["aPosition"] >= 100 - 1e-9)) + 1
        assert arrived * CYCLE == pytest.approx(2.5, abs=2 * CYCLE)
        free = int(np.argmax(found["aStop"] == 0)) + 1
        assert 0 <= free - arrived <= 2
        assert found["aVelocity"].max() == pytest.approx(50)
        assert np.abs(np.diff(found["aVelocity"])).max() <= 100 * CYCLE + 1e-9
        assert one.says("Axis.nAxisState") == "synchronized_motion"
        assert one.says(f"{block}.bBusy") == "TRUE"


@pytest.mark.parametrize(("gaps", "place"), [(True, 0.5), (False, 100.0)])
def test_the_set_position_is_followed(gaps: bool, place: float) -> None:
    """Spec cnc_runtime EX-40: 125 u/s are below fSWMaxVelocity; without bAvoidGaps nothing is checked."""
    with axis() as one:
        one.set("ByPos", bEnable=True, fSetPosition=place, bAvoidGaps=gaps)
        found = one.calls(2)
        assert (found["aPosition"][0], found["aStop"].max()) == (pytest.approx(place), 0)


def test_a_jump_while_following() -> None:
    """Spec CNCR-171: also behind the start."""
    with axis() as one:
        one.set("ByPos", bEnable=True, fSetPosition=0.0)
        one.calls(5)
        one.set("ByPos", fSetPosition=-20.0)
        found = one.calls(400)
        assert found["aStop"][0] == 1
        assert (found["aStop"][-1], found["aPosition"][-1]) == (0, pytest.approx(-20))
        one.set("ByPos", fSetPosition=-20.1)
        assert one.calls(1)["aPosition"][0] == pytest.approx(-20.1)


def test_a_jump_around_a_rotary_axis() -> None:
    """Spec 10.3: from 359 to 1 degree are 2 degrees."""
    with axis() as one:
        one.set("Axis", iMovementType=0, fPositionPeriod=360.0)
        one.set("ByPos", bEnable=True, fSetPosition=359.0, bAvoidGaps=False)
        one.calls(2)
        one.set("ByPos", fSetPosition=1.0, bAvoidGaps=True)
        found = one.calls(3)
        assert (found["aStop"].max(), found["aPosition"][-1]) == (0, pytest.approx(1))


def test_the_velocity_is_written_too() -> None:
    """Spec CNCR-172."""
    with axis() as one:
        one.set("ByPosVel", bEnable=True, fSetPosition=0.5, fSetVelocity=77.0)
        assert one.calls(1)["aVelocity"][0] == pytest.approx(77)


def test_a_jump_of_the_velocity() -> None:
    """Catalog SMC_ControlAxisByVel: 100 u/s2 up; 200 u/s2 down; 40 u/s in one cycle need no ramp."""
    with axis() as one:
        one.set("ByVel", bEnable=True, fSetVelocity=30.0)
        assert one.calls(2)["aVelocity"].tolist() == pytest.approx([30, 30])
        one.set("ByVel", fSetVelocity=80.0)
        found = one.calls(140)
        assert found["aStop"][0] == 1
        assert found["aVelocity"][:3].tolist() == pytest.approx([30.4, 30.8, 31.2])
        assert int(np.argmax(found["aStop"] == 0)) + 1 == 125
        one.set("ByVel", fSetVelocity=0.0)
        assert one.calls(3)["aVelocity"].tolist() == pytest.approx([79.2, 78.4, 77.6])


@pytest.mark.parametrize("block", BLOCKS)
@pytest.mark.parametrize("status", ["IPO_INIT", "IPO_UNKNOWN"])
def test_an_interpolator_that_has_not_begun(block: str, status: str) -> None:
    """Catalog: nothing is written."""
    with axis() as one:
        one.set(block, bEnable=True, iStatus=status)
        one.calls(3)
        assert one.says("Axis.nAxisState") == "standstill"


@pytest.mark.parametrize("block", BLOCKS)
def test_the_axis_stands_behind_the_path(block: str) -> None:
    """Catalog: bEnable FALSE stops the axis."""
    with axis() as one:
        one.set(
            block, bEnable=True, **({"fSetVelocity": 1.0} if block == "ByVel" else {"fSetPosition": 0.01})
        )
        one.calls(3)
        assert one.says("Axis.nAxisState") == "synchronized_motion"
        one.set(block, bEnable=False)
        one.calls(20)
        assert (one.says("Axis.nAxisState"), one.says(f"{block}.bBusy")) == ("standstill", "FALSE")


@pytest.mark.parametrize("block", ["ByPos", "ByPosVel"])
@pytest.mark.parametrize("back", [False, True])
def test_the_axis_stands_at_the_end_of_the_path(block: str, back: bool) -> None:
    """CNCR-170: bWorking, which is bEnable, falls with the last set position; `back`: a path is begun."""
    with axis() as one:
        for place, enable in ((0.0, True), (0.4, True), (0.8, True), (1.0, False)):
            inputs = {"fSetPosition": place, "bEnable": enable}
            one.set(block, **inputs, **({"fSetVelocity": 100.0} if block == "ByPosVel" else {}))
            if not enable:
                one.set(block, iStatus="IPO_FINISHED")
            one.calls(1)
        if back:
            one.set(block, fSetPosition=0.0, iStatus="IPO_INIT")
        found = one.calls(20)
        assert found["aPosition"].tolist() == [1.0] * 20
        assert found["aVelocity"][1:].tolist() == [0.0] * 19
        assert (one.says("Axis.nAxisState"), one.says(f"{block}.bBusy")) == ("standstill", "FALSE")


@pytest.mark.parametrize("block", BLOCKS)
def test_another_command(block: str) -> None:
    """Spec CNCR-173."""
    with axis() as one:
        one.set(block, bEnable=True)
        one.calls(3)
        one.set("Other", Execute=True)
        one.calls(20)
        assert (one.says(f"{block}.bCommandAborted"), one.says(f"{block}.bBusy")) == ("TRUE", "FALSE")
        assert one.says("Axis.nAxisState") == "continuous_motion"
        one.set(block, bEnable=False)
        one.calls(20)
        assert one.says(f"{block}.bCommandAborted") == "FALSE"
        assert one.says("Axis.nAxisState") == "continuous_motion"


@pytest.mark.parametrize("block", BLOCKS)
def test_an_axis_without_power(block: str) -> None:
    """Catalog: axis errors, until bEnable is FALSE."""
    with axis() as one:
        one.set("Power", bRegulatorOn=False)
        one.calls(5)
        one.set(block, bEnable=True)
        one.calls(2)
        assert (one.says(f"{block}.bError"), one.says(f"{block}.iErrorID")) == (
            "TRUE",
            "SMC_REGULATOR_OR_START_NOT_SET",
        )
        one.set(block, bEnable=False)
        one.calls(1)
        assert (one.says(f"{block}.bError"), one.says(f"{block}.iErrorID")) == ("FALSE", "SMC_NO_ERROR")


@pytest.mark.parametrize("value", ["nan", "inf", "-inf", "1e300"])
@pytest.mark.parametrize("block", BLOCKS)
def test_absurd_set_values(block: str, value: str) -> None:
    """A set value that is none ends with an error, with and without the check of jumps."""
    for gaps in (False, True):
        with axis() as one:
            one.set(block, bEnable=True, bAvoidGaps=gaps)
            one.calls(2)
            one.set(block, **{"fSetVelocity" if block == "ByVel" else "fSetPosition": float(value)})
            found = one.calls(10)
            assert np.isfinite(found["aPosition"]).all()
            if value != "1e300" or block != "ByVel":
                assert one.says(f"{block}.bError") == "TRUE"
