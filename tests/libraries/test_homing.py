"""Homing with a reference switch at a place of the machine, in all modes, against where the switch is."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from functools import cache

import pytest
from linked_application import LoadedApplication, loaded
from tests.libraries.one_axis import CYCLE

from tappet.codegen.build import BuildOptions, BuildSession, LibraryReference, build_application
from tappet.codegen.package import CodePackage
from tappet.lang.source import Source

PROGRAM = """
PROGRAM Main
VAR
    Axis    : SM3_Basic.AXIS_REF_VIRTUAL_SM3 := (
        fTaskCycle := {cycle}, fMaxVelocity := 1E5, fMaxAcceleration := 1E7, fMaxDeceleration := 1E7);
    Power   : SM3_Basic.MC_Power;
    Homing  : SM3_Basic.SMC_Homing;
    Home    : SM3_Basic.MC_Home;
    Stop    : SM3_Basic.MC_Stop;
    Move    : SM3_Basic.MC_MoveAbsolute;
    fPlace  : LREAL; (* Of the axis in the machine, however it counts *)
    fBefore : LREAL;
    fFrom   : LREAL := -120.0; (* The switch is actuated between these places *)
    fTo     : LREAL := -100.0;
    fIndex  : LREAL := -90.0;
    xOnwards : BOOL; (* The index comes in the direction of the search *)
END_VAR
Axis.BeginCycle();
Homing.bReferenceSwitch := fPlace < fFrom OR fPlace > fTo;
Homing.bIndexOccured := Homing.bStartLatchingIndex AND (fPlace > fIndex) <> xOnwards;
IF NOT Homing.bIndexOccured THEN
    Homing.fIndexPosition := Axis.fActPosition;
END_IF
Power(Axis := Axis, Enable := TRUE, bRegulatorOn := TRUE, bDriveStart := TRUE);
Homing(Axis := Axis);
Home(Axis := Axis);
Stop(Axis := Axis);
Move(Axis := Axis);
fBefore := Axis.fSetVelocity;
Axis.EndCycle();
fPlace := fPlace + 0.5 * {cycle} * (fBefore + Axis.fSetVelocity);
END_PROGRAM
"""
GIVEN = {
    "fVelocityFast": 50.0,
    "fVelocitySlow": 10.0,
    "fAcceleration": 200.0,
    "fDeceleration": 200.0,
    "fHomePosition": 5.0,
}
MODES = {
    0: "backwards, set and stop",
    1: "backwards, stop and set",
    2: "backwards, index",
    4: "on, set and stop",
    5: "on, stop and set",
    6: "on, index",
}


@cache
def _package(cycle: float) -> CodePackage:
    options = BuildOptions(libraries=(LibraryReference("SM3_Basic"),), level=1)
    text = PROGRAM.format(cycle=cycle)
    result = build_application([Source("program", text)], options=options, session=BuildSession())
    assert [str(d) for d in result.diagnostics if d.severity == "error"] == []
    assert result.package is not None
    return result.package


class Machine:
    """The running program."""

    def __init__(self, application: LoadedApplication, seconds: float) -> None:
        self._application = application
        self._cycle_ns = round(seconds * 1e9)
        self.cycle(4)

    def set(self, block: str, **values: float | bool) -> None:
        for name, value in values.items():
            self._application.write(f"Main.{block}.{name}", value)

    def write(self, **values: float | bool) -> None:
        """Variables of the program."""
        for name, value in values.items():
            self._application.write(f"Main.{name}", value)

    def cycle(self, count: int = 1) -> None:
        for _ in range(count):
            self._application.cycle()
            self._application.clock_ns += self._cycle_ns

    def text(self, path: str) -> str:
        return self._application.literal(f"Main.{path}")

    def number(self, path: str) -> float:
        return float(self.text(path))

    def until(self, path: str, at_most: int = 40_000) -> int:
        for gone in range(at_most):
            if self.text(path) == "TRUE":
                return gone
            self.cycle()
        raise AssertionError(f"{path} never came; the axis is at {self.text('fPlace')}")


@contextmanager
def machine(cycle: float = CYCLE) -> Iterator[Machine]:
    with loaded(_package(cycle)) as application:
        yield Machine(application, cycle)


@pytest.mark.parametrize("ramp", range(4))
@pytest.mark.parametrize("mode", MODES, ids=MODES.get)
def test_positions_count_from_the_switch(mode: int, ramp: int) -> None:
    """HOM-04, HOM-05, HOM-09."""
    with machine() as found:
        found.set("Axis", eRampType=ramp)
        if mode == 6:
            found.write(xOnwards=True, fIndex=-130.0)
        found.set("Homing", bExecute=True, nHomingMode=mode, Jerk=2000.0, **GIVEN)
        found.cycle()
        assert found.text("Axis.nAxisState") == "homing"
        found.until("Homing.bDone")
        assert found.text("Axis.nAxisState") == "standstill"
        # backwards off the switch is upwards here; without a delay the position is right to a cycle's way
        edge = {2: -90.0, 4: -120.0, 5: -120.0, 6: -130.0}.get(mode, -100.0)
        assert found.number("fPlace") - edge == pytest.approx(
            found.number("Axis.fSetPosition") - 5.0, abs=0.025
        )
        assert found.number("Axis.fActPosition") == pytest.approx(found.number("Axis.fSetPosition"), abs=1e-9)


@pytest.mark.parametrize(("cycle", "slow"), [(0.001, 10.0), (0.004, 5.0)], ids=["1 ms", "4 ms"])
def test_the_delay_of_the_switch_is_made_up(cycle: float, slow: float) -> None:
    """motion_semantics EX-13 and ax3000 EX-AX-10: 0.03 u where the switch, 2 ms late, is seen to open.

    It is seen in the cycle behind its place, so the position there may be less by the way of a cycle.
    """
    with machine(cycle) as found:
        found.set("Homing", bExecute=True, **GIVEN | {"fVelocitySlow": slow, "fHomePosition": 0.0})
        found.set("Homing", fSignalDelay=0.002)
        found.until("Homing.bDone")
        at_the_switch = found.number("Axis.fSetPosition") - (found.number("fPlace") + 100.0)
        assert 0.03 - slow * cycle - 1e-9 <= at_the_switch <= 0.03 + 1e-9
        stopping = slow**2 / (2 * 200.0)
        assert found.number("Axis.fSetPosition") == pytest.approx(0.03 + stopping, abs=2 * slow * cycle)


def test_a_closed_switch_is_left_at_once() -> None:
    with machine() as found:
        found.set("Homing", bExecute=True, **GIVEN)
        found.until("Homing.bDone")
        found.set("Homing", bExecute=False)
        found.set("Move", Execute=True, Position=-3.0, Velocity=20.0, Acceleration=200.0, Deceleration=200.0)
        found.until("Move.Done")
        assert found.text("Homing.bReferenceSwitch") == "FALSE"
        found.set("Homing", bExecute=True, fHomePosition=100.0)
        found.until("Homing.bDone", 2000)
        assert found.number("Axis.fSetPosition") == pytest.approx(100.0, abs=0.5)


def test_the_axis_returns_to_zero() -> None:
    """HOM-07, ax3000 HOME-05: with fVelocityFast."""
    with machine() as found:
        found.set("Homing", bExecute=True, bReturnToZero=True, **GIVEN)
        fastest = 0.0
        while found.text("Homing.bDone") != "TRUE":
            found.cycle()
            if found.number("fPlace") > -103.0 and found.number("Axis.fSetPosition") > 0.0:
                fastest = max(fastest, abs(found.number("Axis.fSetVelocity")))
        assert fastest > GIVEN["fVelocitySlow"]
        assert found.number("Axis.fSetPosition") == pytest.approx(0.0, abs=1e-9)
        assert found.number("fPlace") == pytest.approx(-105.0, abs=0.025)


def test_a_stop_ends_the_homing() -> None:
    """STA-10: MC_Stop is the only command in homing."""
    with machine() as found:
        found.set("Axis", bHWLimitEnable=True)
        found.set("Homing", bExecute=True, bIgnoreHWLimit=True, **GIVEN)
        found.cycle(300)
        assert found.text("Axis.bHWLimitEnable") == "FALSE"
        found.set("Move", Execute=True, Velocity=1.0, Acceleration=1.0, Deceleration=1.0)
        found.cycle()
        assert found.text("Move.ErrorID") == "SMC_AXIS_NOT_READY_FOR_MOTION"
        found.set("Stop", Execute=True, Deceleration=500.0)
        found.cycle(2)
        assert found.text("Axis.nAxisState") == "stopping"
        assert found.text("Homing.bCommandAborted") == "TRUE"
        assert found.text("Axis.bHWLimitEnable") == "TRUE"


def test_wrong_homing_is_refused() -> None:
    """HOM-02, HOM-08, STA-12."""
    with machine() as found:
        for name in ("fVelocityFast", "fVelocitySlow", "fAcceleration", "fDeceleration"):
            found.set("Homing", bExecute=True, **{**GIVEN, name: 0.0})
            found.cycle()
            assert found.text("Homing.nErrorID") == "SMC_3SH_INVALID_VELACC_VALUES"
            found.set("Homing", bExecute=False)
            found.cycle()
        found.set("Move", Execute=True, Position=1e3, Velocity=10.0, Acceleration=100.0, Deceleration=100.0)
        found.cycle(5)
        found.set("Homing", bExecute=True, **GIVEN)
        found.set("Home", Execute=True)
        found.cycle()
        assert found.text("Homing.nErrorID") == "SMC_H_AXIS_WASNT_STANDSTILL"
        assert found.text("Home.ErrorID") == "SMC_H_AXIS_WASNT_STANDSTILL"
        assert found.text("Axis.nAxisState") == "discrete_motion"


def test_an_axis_without_a_drive_takes_its_position_at_once() -> None:
    """HOM-02."""
    with machine() as found:
        found.set("Home", Execute=True, Position=42.0)
        found.cycle()
        assert found.text("Home.Busy") == "TRUE"
        found.cycle()
        assert found.text("Home.Done") == "TRUE"
        assert found.text("Axis.nAxisState") == "standstill"
        assert found.number("Axis.fSetPosition") == found.number("Axis.fActPosition") == 42.0
