"""Instants of SMC_DigitalCamSwitch_HighPrecision against closed forms of the motion."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass

import pytest
from scipy.optimize import brentq
from tests.libraries.st_program import Program, run

CYCLE = 0.004
PERIOD = 360.0
PROGRAM = f"""
PROGRAM Main
VAR
    Axis      : SM3_Basic.AXIS_REF_VIRTUAL_SM3 := (fTaskCycle := {CYCLE}, iMovementType := 1,
        fPositionPeriod := {PERIOD}, fMaxVelocity := 1E5, fMaxAcceleration := 1E7, fMaxDeceleration := 1E7);
    Power     : SM3_Basic.MC_Power;
    Velocity  : SM3_Basic.MC_MoveVelocity;
    Place     : SM3_Basic.MC_SetPosition;
    Switch    : SM3_Basic.SMC_DigitalCamSwitch_HighPrecision;
    aSwitches : ARRAY[1..4] OF SM3_Basic.MC_CAMSWITCH_TR;
    Switches  : SM3_Basic.MC_CAMSWITCH_REF := (CamSwitchPtr := ADR(aSwitches));
    Options   : SM3_Basic.MC_TRACK_REF;
END_VAR
Axis.BeginCycle();
Power(Axis := Axis, Enable := TRUE, bRegulatorOn := TRUE, bDriveStart := TRUE);
Place(Axis := Axis);
Velocity(Axis := Axis);
Switch(Axis := Axis, Switches := Switches, TrackOptions := Options);
Axis.EndCycle();
END_PROGRAM
"""


@dataclass(frozen=True)
class Event:
    time: float
    """Since the axis got its command [s]."""
    value: bool
    switch: int


class Shaft:
    def __init__(self, program: Program) -> None:
        self._program = program
        self.gone = 0
        self.seen: dict[int, Event] = {}

    def set(self, variable: str, **members: float | bool | str) -> None:
        self._program.set(f"Main.{variable}", **members)

    def number(self, path: str) -> float:
        return float(self._program.literal(f"Main.{path}"))

    def text(self, path: str) -> str:
        return self._program.literal(f"Main.{path}")

    def dogs(self, *dogs: dict[str, float | str]) -> None:
        for number, dog in enumerate(dogs, start=1):
            self.set(f"aSwitches[{number}]", **{"TrackNumber": 1, **dog})
        self.set("Switches", NoOfSwitches=len(dogs))

    def enable(self) -> None:
        self.set("Switch", Enable=True)
        self._program.cycle()
        assert self.text("Switch.InOperation") == "TRUE"

    def move(self, velocity: float, acceleration: float) -> None:
        """A command, from the end of this cycle on; the times of events count from its start."""
        self.gone = 0
        self.set("Velocity", Execute=False)
        self.cycle()
        self.gone = 0
        self.set(
            "Velocity",
            Execute=True,
            Velocity=abs(velocity),
            Acceleration=acceleration,
            Deceleration=acceleration,
            Direction=1 if velocity > 0.0 else -1,
        )

    def cycle(self, count: int = 1, track: int = 1) -> None:
        for _ in range(count):
            self._program.cycle()
            for number in range(1, int(self.number(f"Switch.Events[{track}].NumberOfEvents")) + 1):
                place = f"Switch.Events[{track}].Events[{number}]"
                identity = int(self.number(f"{place}.ToggleEventId"))
                event = Event(
                    self.gone * CYCLE + self.number(f"{place}.Duration"),
                    self.text(f"{place}.NewValue") == "TRUE",
                    int(self.number(f"{place}.SwitchNumber")),
                )
                if identity in self.seen:
                    assert self.seen[identity].time == pytest.approx(event.time, abs=1e-12), "it is kept"
                self.seen[identity] = event
            self.gone += 1

    def told(self) -> list[tuple[float, bool]]:
        """Instants and values, in the order of their numbers."""
        return [(event.time, event.value) for _, event in sorted(self.seen.items())]


@pytest.fixture
def shaft() -> Iterator[Shaft]:
    with run(PROGRAM, 4, CYCLE * 1000) as program:
        yield Shaft(program)


def _told(shaft: Shaft, expected: list[tuple[float, bool]]) -> None:
    found = shaft.told()
    assert [value for _, value in found] == [value for _, value in expected]
    assert [time for time, _ in found] == pytest.approx([time for time, _ in expected], abs=1e-12)


@pytest.mark.parametrize("velocity", [37.0, -37.0, 2345.6, -2345.6])
@pytest.mark.parametrize(("on", "off"), [(0.0, 0.0), (0.0137, 0.002), (-0.0137, -0.031), (-0.01, 0.02)])
def test_at_a_constant_velocity(shaft: Shaft, velocity: float, on: float, off: float) -> None:
    """Way by velocity, shifted by the compensations: exact, though the cycle is 4 ms."""
    sign = 1.0 if velocity > 0.0 else -1.0
    shaft.set("Options", OnCompensation=on, OffCompensation=off)
    first, last = sorted((sign * 120.1, sign * 233.3))
    shaft.dogs({"FirstOnPosition": first, "LastOnPosition": last})
    shaft.move(velocity, 1e6)
    shaft.cycle(2)
    shaft.enable()
    start = shaft.number("Axis.fSetPosition")
    shaft.gone = 0
    shaft.cycle(math.ceil(300.0 / abs(velocity) / CYCLE))
    _told(
        shaft,
        [((sign * 120.1 - start) / velocity + on, True), ((sign * 233.3 - start) / velocity + off, False)],
    )


@pytest.mark.parametrize("acceleration", [250.0, 40_000.0])
@pytest.mark.parametrize(("on", "off"), [(0.0, 0.0), (0.01, 0.003), (-0.01, -0.003)])
@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_at_a_constant_acceleration(
    shaft: Shaft, acceleration: float, on: float, off: float, sign: float
) -> None:
    """From standstill: the root of twice the way by the acceleration."""
    shaft.set("Options", OnCompensation=on, OffCompensation=off)
    first, last = sorted((sign * 15.0, sign * 40.0))
    shaft.dogs({"FirstOnPosition": first, "LastOnPosition": last})
    shaft.enable()
    shaft.move(sign * 1e4, acceleration)
    shaft.cycle(math.ceil(math.sqrt(100.0 / acceleration) / CYCLE) + 5)
    times = [math.sqrt(2.0 * way / acceleration) for way in (15.0, 40.0)]
    _told(shaft, [(times[0] + on, True), (times[1] + off, False)])


def test_within_a_ramp_of_limited_jerk(shaft: Shaft) -> None:
    """The way of a constant jerk is jerk * t^3 / 6; each cycle of it is exact."""
    jerk = 3000.0
    shaft.set("Axis", eRampType=2)
    shaft.dogs({"FirstOnPosition": 0.7, "LastOnPosition": 9.1})
    shaft.enable()
    shaft.set("Velocity", Jerk=jerk)
    shaft.move(1e3, 1e5)
    shaft.cycle(80)
    _told(shaft, [((6.0 * way / jerk) ** (1.0 / 3.0), value) for way, value in ((0.7, True), (9.1, False))])


def test_a_motion_that_turns_within_a_cycle(shaft: Shaft) -> None:
    """From 100 u/s back with -1000 u/s2: out of a switch of both directions, and off by its direction."""
    shaft.dogs(
        {"FirstOnPosition": 4.0, "LastOnPosition": 50.0},
        {"FirstOnPosition": 4.0, "LastOnPosition": 50.0, "AxisDirection": 1, "TrackNumber": 2},
    )
    shaft.move(100.0, 1e7)
    shaft.cycle(3)
    shaft.enable()
    shaft.move(-100.0, 1000.0)
    start = shaft.number("Axis.fSetPosition")
    shaft.seen.clear()
    for track in (1, 2):
        assert shaft.text(f"Switch.Events[{track}].NumberOfEvents") == "0"

    def way(time: float) -> float:
        return start + 100.0 * time - 500.0 * time * time - 4.0

    numbers: dict[int, float] = {}
    for gone in range(60):
        shaft.cycle(track=1)
        if shaft.number("Switch.Events[2].NumberOfEvents") > 0.0:
            place = "Switch.Events[2].Events[1]"
            if shaft.text(f"{place}.NewValue") == "FALSE":
                numbers[gone] = gone * CYCLE + shaft.number(f"{place}.Duration")
    enter = brentq(way, 0.0, 0.1, xtol=1e-15)
    leave = brentq(way, 0.1, 0.3, xtol=1e-15)
    _told(shaft, [(enter, True), (leave, False)])
    assert list(numbers.values()) == pytest.approx([0.1], abs=1e-9)


def test_a_switch_of_a_time_goes_off_between_cycles_too(shaft: Shaft) -> None:
    """1 ms is shorter than the cycle; another way over it before its end makes it last longer."""
    shaft.dogs({"FirstOnPosition": 7.7, "CamSwitchMode": 1, "Duration": "T#1ms"})
    shaft.move(100.0, 1e7)
    shaft.cycle(2)
    shaft.enable()
    start = shaft.number("Axis.fSetPosition")
    shaft.gone = 0
    shaft.cycle(60)
    on = (7.7 - start) / 100.0
    _told(shaft, [(on, True), (on + 0.001, False)])


def test_a_rotary_axis_passes_a_switch_in_each_turn(shaft: Shaft) -> None:
    """From 350 over 0 to 10 degrees, at 720 degrees/s."""
    shaft.set("Axis", iMovementType=0)
    shaft.dogs({"FirstOnPosition": 350.0, "LastOnPosition": 10.0})
    shaft.move(720.0, 1e7)
    shaft.cycle(20)
    shaft.enable()
    start = shaft.number("Axis.fSetPosition")
    shaft.gone = 0
    shaft.cycle(round(1.4 / CYCLE))
    expected = [
        ((place - start) / 720.0 + turn * 0.5, value)
        for turn in range(3)
        for place, value in ((350.0, True), (370.0, False))
        if (place - start) / 720.0 + turn * 0.5 < 1.4
    ]
    _told(shaft, expected)


def test_an_output_is_on_as_long_as_one_of_its_switches(shaft: Shaft) -> None:
    shaft.dogs(
        {"FirstOnPosition": 10.0, "LastOnPosition": 20.0}, {"FirstOnPosition": 15.0, "LastOnPosition": 30.0}
    )
    shaft.move(100.0, 1e7)
    shaft.cycle(2)
    shaft.enable()
    start = shaft.number("Axis.fSetPosition")
    shaft.gone = 0
    shaft.cycle(100)
    _told(shaft, [((10.0 - start) / 100.0, True), ((30.0 - start) / 100.0, False)])
    assert [event.switch for event in shaft.seen.values()] == [1, 2]


def test_the_start_the_mask_and_the_end_switch_at_once(shaft: Shaft) -> None:
    shaft.dogs({"FirstOnPosition": -1.0, "LastOnPosition": 1.0})
    shaft.set("Switch", Enable=True)
    shaft.cycle()
    shaft.set("Switch", EnableMask=0)
    shaft.cycle()
    shaft.set("Switch", EnableMask=1)
    shaft.cycle()
    shaft.set("Place", Position=5.0, Execute=True)
    shaft.cycle()
    shaft.set("Place", Execute=False)
    shaft.cycle()
    shaft.set("Place", Position=0.5, Execute=True)
    shaft.cycle()
    shaft.set("Switch", Enable=False)
    shaft.cycle(2)
    _told(
        shaft,
        [
            (CYCLE, True),
            *((number * CYCLE, value) for number, value in ((1, False), (2, True), (3, False), (5, True))),
            (6 * CYCLE, False),
        ],
    )


def test_hysteresis_keeps_a_switch_when_the_axis_comes_back_a_little(shaft: Shaft) -> None:
    """Off at the place where it left the way that counts, when it has come back by 3."""
    shaft.set("Options", Hysteresis=3.0)
    shaft.dogs({"FirstOnPosition": -100.0, "LastOnPosition": 100.0, "AxisDirection": 1})
    shaft.move(100.0, 1e7)
    shaft.cycle(20)
    shaft.enable()
    shaft.cycle(10)
    turned = shaft.number("Axis.fSetPosition")
    shaft.move(-100.0, 1e7)
    shaft.seen.clear()
    turned = shaft.number("Axis.fSetPosition")
    shaft.cycle(30)
    [(time, value)] = shaft.told()
    assert not value
    assert time == pytest.approx(3.0 / 100.0, abs=CYCLE)
    assert turned > 0.0


@pytest.mark.parametrize(
    "wrong", [{"TrackNumber": 33}, {"FirstOnPosition": math.nan}, {"CamSwitchMode": 7}, {"AxisDirection": 9}]
)
def test_switches_that_cannot_be_are_errors(shaft: Shaft, wrong: dict[str, float | str]) -> None:
    shaft.dogs(wrong)
    shaft.set("Switch", Enable=True)
    shaft.cycle()
    assert shaft.text("Switch.ErrorID") == "SMC_DCS_INVALID_SWITCHES"
    assert shaft.text("Switch.Busy") == "FALSE"
