"""MC_TouchProbe and MC_AbortTrigger with triggers of the bus task, at places of a moving axis."""

from __future__ import annotations

from collections.abc import Iterator
from functools import cache

import pytest
from linked_application import LoadedApplication, loaded
from tests.libraries.one_axis import CYCLE

from tappet.codegen.build import BuildOptions, BuildSession, LibraryReference, build_application
from tappet.codegen.package import CodePackage
from tappet.lang.source import Source

SPEED = 100.0
WAY = SPEED * CYCLE
PROGRAM = f"""
PROGRAM Main
VAR
    Axis    : SM3_Basic.AXIS_REF_VIRTUAL_SM3 := (
        fTaskCycle := {CYCLE}, fMaxVelocity := 1E5, fMaxAcceleration := 1E9, fMaxDeceleration := 1E9);
    Power   : SM3_Basic.MC_Power;
    Move    : SM3_Basic.MC_MoveVelocity;
    Trigger : SM3_Basic.TRIGGER_REF := (bFastLatching := FALSE);
    Probe1, Probe2 : SM3_Basic.MC_TouchProbe;
    Abort   : SM3_Basic.MC_AbortTrigger;
    fEvery  : LREAL := 50.0; (* The signal is TRUE for 5 u behind each multiple of it *)
END_VAR
Axis.BeginCycle();
Trigger.bInput := Axis.fActPosition - fEvery * INT_TO_LREAL(TRUNC_INT(Axis.fActPosition / fEvery)) < 5.0;
Power(Axis := Axis, Enable := TRUE, bRegulatorOn := TRUE, bDriveStart := TRUE);
Move(Axis := Axis, Execute := Power.Status, Velocity := {SPEED}, Acceleration := 1E8, Deceleration := 1E8);
Probe1(Axis := Axis, TriggerInput := Trigger);
Probe2(Axis := Axis, TriggerInput := Trigger);
Abort(Axis := Axis, TriggerInput := Trigger);
Axis.EndCycle();
END_PROGRAM
"""


@cache
def _package() -> CodePackage:
    options = BuildOptions(libraries=(LibraryReference("SM3_Basic"),), level=1)
    result = build_application([Source("program", PROGRAM)], options=options, session=BuildSession())
    assert [str(d) for d in result.diagnostics if d.severity == "error"] == []
    assert result.package is not None
    return result.package


class Machine:
    """The running program; the axis moves from 0 upwards."""

    def __init__(self, application: LoadedApplication) -> None:
        self._application = application

    def set(self, block: str, **values: float | bool) -> None:
        for name, value in values.items():
            self._application.write(f"Main.{block}.{name}", value)

    def cycle(self, count: int = 1) -> None:
        for _ in range(count):
            self._application.cycle()
            self._application.clock_ns += round(CYCLE * 1e9)

    def text(self, path: str) -> str:
        return self._application.literal(f"Main.{path}")

    def says(self, block: str) -> set[str]:
        outputs = ("Done", "Busy", "Error", *(("CommandAborted",) if block != "Abort" else ()))
        return {name for name in outputs if self.text(f"{block}.{name}") == "TRUE"}

    def until_over(self, block: str) -> float:
        """The recorded position."""
        for _ in range(20_000):
            if "Busy" not in self.says(block):
                return float(self.text(f"{block}.RecordedPosition"))
            self.cycle()
        raise AssertionError(f"{block} still waits")


@pytest.fixture
def machine() -> Iterator[Machine]:
    with loaded(_package()) as application:
        found = Machine(application)
        found.cycle(20)
        yield found


def test_the_first_event_is_recorded(machine: Machine) -> None:
    """TPR-01: a signal that is TRUE already is no event."""
    machine.set("Probe1", Execute=True)
    machine.cycle()
    assert machine.says("Probe1") == {"Busy"}
    assert 50.0 <= machine.until_over("Probe1") <= 50.0 + WAY
    assert machine.says("Probe1") == {"Done"}
    recorded = machine.text("Probe1.RecordedPosition")
    machine.cycle(1000)
    assert (machine.says("Probe1"), machine.text("Probe1.RecordedPosition")) == ({"Done"}, recorded)
    machine.set("Probe1", Execute=False)
    machine.cycle()
    assert machine.says("Probe1") == set()
    machine.set("Probe1", Execute=True)
    machine.cycle()
    assert machine.until_over("Probe1") > 150.0


def test_only_events_in_the_window_count(machine: Machine) -> None:
    """TPR-03."""
    machine.set("Probe1", Execute=True, WindowOnly=True, FirstPosition=120.0, LastPosition=210.0)
    machine.cycle()
    assert 150.0 <= machine.until_over("Probe1") <= 150.0 + WAY


def test_a_window_may_lie_over_the_end_of_a_period(machine: Machine) -> None:
    machine.set("Axis", iMovementType=0, fPositionPeriod=360.0)
    machine.set("Probe1", Execute=True, WindowOnly=True, FirstPosition=340.0, LastPosition=40.0)
    machine.cycle()
    assert 350.0 <= machine.until_over("Probe1") <= 350.0 + WAY or machine.until_over("Probe1") < 40.0


def test_another_edge_while_it_waits_takes_another_window(machine: Machine) -> None:
    """EXE-03."""
    machine.set("Probe1", Execute=True)
    machine.cycle()
    machine.set("Probe1", Execute=False)
    machine.cycle()
    assert machine.says("Probe1") == {"Busy"}
    machine.set("Probe1", Execute=True, WindowOnly=True, FirstPosition=190.0, LastPosition=260.0)
    machine.cycle()
    assert 200.0 <= machine.until_over("Probe1") <= 200.0 + WAY


def test_a_trigger_serves_one_probe(machine: Machine) -> None:
    """TPR-04."""
    machine.set("Probe1", Execute=True)
    machine.set("Probe2", Execute=True)
    machine.cycle()
    assert machine.says("Probe1") == {"Busy"}
    assert (machine.says("Probe2"), machine.text("Probe2.ErrorID")) == ({"Error"}, "SMC_TP_TRIGGEROCCUPIED")
    machine.until_over("Probe1")
    machine.set("Probe2", Execute=False)
    machine.cycle()
    machine.set("Probe2", Execute=True)
    machine.cycle()
    assert machine.says("Probe2") == {"Busy"}


def test_a_probe_is_aborted(machine: Machine) -> None:
    """TPR-05."""
    machine.set("Abort", Execute=True)
    machine.cycle()
    assert (machine.says("Abort"), machine.text("Abort.ErrorID")) == ({"Error"}, "SMC_AT_TRIGGERNOTOCCUPIED")
    machine.set("Abort", Execute=False)
    machine.set("Probe1", Execute=True)
    machine.cycle()
    machine.set("Probe1", Execute=False)
    machine.set("Abort", Execute=True)
    machine.cycle()
    assert machine.says("Abort") == {"Done"}
    machine.cycle()
    assert machine.says("Probe1") == {"CommandAborted"}
    machine.cycle()
    assert machine.says("Probe1") == set()


def test_what_cannot_latch_says_so(machine: Machine) -> None:
    machine.set("Trigger", bFastLatching=True)
    machine.set("Probe1", Execute=True)
    machine.cycle()
    assert machine.text("Probe1.ErrorID") == "SMC_TP_COMM_ERROR"
    machine.set("Trigger", bFastLatching=False)
    machine.set("Probe2", Execute=True, WindowOnly=True, FirstPosition=5.0, LastPosition=1.0)
    machine.cycle()
    assert machine.text("Probe2.ErrorID") == "SMC_TP_COULDNT_SET_WINDOW"
