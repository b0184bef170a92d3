"""Outputs switched by the position of an axis, against a model by intervals on a straight line."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt
import pytest
from tests.libraries.st_program import Program, run

CYCLE = 0.005
SWITCHES = 8
PERIOD = 5000.0
PROGRAM = f"""
PROGRAM Main
VAR
    Axis      : SM3_Basic.AXIS_REF_SM3 := (fTaskCycle := {CYCLE}, fPositionPeriod := {PERIOD},
        iMovementType := 0, wCommunicationState := 100);
    Switch    : SM3_Basic.MC_DigitalCamSwitch := (
        TappetMode := SM3_Basic.MC_TAPPETMODE.tp_mode_actualposition);
    aSwitches : ARRAY[1..{SWITCHES}] OF SM3_Basic.MC_CAMSWITCH_TR;
    Switches  : SM3_Basic.MC_CAMSWITCH_REF := (CamSwitchPtr := ADR(aSwitches));
    Outputs   : SM3_Basic.MC_OUTPUT_REF;
    Options   : SM3_Basic.MC_TRACK_REF;
    dwOutputs : DWORD;
    iTrack    : INT;
END_VAR
Switch(Axis := Axis, Switches := Switches, Outputs := Outputs, TrackOptions := Options);
dwOutputs := 0;
FOR iTrack := 0 TO 31 DO
    IF Outputs[iTrack] THEN dwOutputs := dwOutputs OR SHL(DWORD#1, iTrack); END_IF
END_FOR
END_PROGRAM
"""


@dataclass(frozen=True)
class Dog:
    track: int
    first: float
    last: float = 0.0
    direction: int = 0
    ms: int | None = None


EXAMPLE = (
    Dog(1, 2000, 3000, 1),
    Dog(1, 2500, 3000, 2),
    Dog(1, 4000, 1000),
    Dog(2, 3000, ms=1350),
)
"""motion_semantics EX-25; the direction of switch 02 is that of the manual."""


class Shaft:
    def __init__(self, program: Program, dogs: tuple[Dog, ...], rotary: bool) -> None:
        self._program = program
        self._rotary = rotary
        for number, dog in enumerate(dogs, start=1):
            program.set(
                f"Main.aSwitches[{number}]",
                TrackNumber=dog.track,
                FirstOnPosition=dog.first,
                LastOnPosition=dog.last,
                AxisDirection=dog.direction,
                CamSwitchMode=0 if dog.ms is None else 1,
                Duration=f"T#{dog.ms or 0}ms",
            )
        program.set("Main.Switches", NoOfSwitches=len(dogs))
        program.set("Main.Axis", iMovementType=0 if rotary else 1)
        program.set("Main.Switch", Enable=True)

    def set(self, variable: str, **members: float | bool | str) -> None:
        self._program.set(f"Main.{variable}", **members)

    def text(self, path: str) -> str:
        return self._program.literal(f"Main.{path}")

    def switch_on(self, track: int) -> None:
        self._program.set("Main", **{f"Outputs[{track - 1}]": True})

    def cycle(self) -> int:
        self._program.cycle()
        return int(float(self.text("dwOutputs")))

    def at(self, position: float, velocity: float) -> int:
        """The outputs with the axis there; bit t-1 is track t."""
        seen = position % PERIOD if self._rotary else position
        self.set("Axis", fActPosition=seen, fActVelocity=velocity)
        return self.cycle()


@contextmanager
def shaft(dogs: tuple[Dog, ...], rotary: bool = True, **options: float) -> Iterator[Shaft]:
    with run(PROGRAM, 0) as program:
        program.set("Main.Options", **options)
        yield Shaft(program, dogs, rotary)


def along(start: float, velocity: float, seconds: float) -> npt.NDArray[np.float64]:
    return start + velocity * CYCLE * np.arange(round(seconds / CYCLE) + 1)


def test_worked_example_in_positive_direction() -> None:
    """motion_semantics EX-25: switch 02 does not act, switch 03 goes over the end of the period."""
    with shaft(EXAMPLE) as one:
        positions = along(1500.5, 500.0, 20.0)
        found = np.array([one.at(position, 500.0) for position in positions])
    angle = positions % PERIOD
    first = ((angle >= 2000) & (angle <= 3000)) | (angle >= 4000) | (angle <= 1000)
    assert ((found & 1) == 1).tolist() == first.tolist()
    passed = np.nonzero((positions[:-1] < 3000) & (positions[1:] >= 3000))[0][0] + 1
    again = np.nonzero((positions[:-1] < 8000) & (positions[1:] >= 8000))[0][0] + 1
    second = np.zeros(len(positions), dtype=bool)
    for since in (passed, again):
        second[since : since + round(1.35 / CYCLE)] = True
    assert ((found & 2) == 2).tolist() == second.tolist()
    assert not (found & ~3).any()


def test_worked_example_in_negative_direction() -> None:
    """motion_semantics EX-25: switch 01 does not act."""
    with shaft(EXAMPLE) as one:
        positions = along(3999.5, -500.0, 9.0)
        found = np.array([one.at(position, -500.0) for position in positions])
    angle = positions % PERIOD
    first = ((angle >= 2500) & (angle <= 3000)) | (angle >= 4000) | (angle <= 1000)
    assert ((found & 1) == 1).tolist() == first.tolist()
    passed = np.nonzero(positions <= 3000)[0][0]
    second = np.zeros(len(positions), dtype=bool)
    second[passed : passed + round(1.35 / CYCLE)] = True
    assert ((found & 2) == 2).tolist() == second.tolist()


@pytest.mark.parametrize("velocity", [400.0, 1000.0])
def test_worked_example_with_compensation(velocity: float) -> None:
    """motion_semantics EX-25: switch 01 is on from 2000 - 0.125 v to 3000 + 0.25 v."""
    with shaft(EXAMPLE[:1], OnCompensation=-0.125, OffCompensation=0.25) as one:
        positions = along(1500.5, velocity, 3.0)
        found = np.array([one.at(position, velocity) for position in positions])
    wanted = (positions >= 2000 - 0.125 * velocity) & (positions <= 3000 + 0.25 * velocity)
    assert (found == 1).tolist() == wanted.tolist()
    assert wanted.any()


def test_compensation_in_negative_direction_is_earlier_as_well() -> None:
    """DCS-07: entered at the last position, which the axis reaches 0.125 s later than the output."""
    with shaft((Dog(3, 2000, 3000),), OnCompensation=-0.125, OffCompensation=0.25) as one:
        positions = along(4000.5, -400.0, 7.0)
        found = np.array([one.at(position, -400.0) for position in positions])
    wanted = (positions <= 3000 + 50) & (positions >= 2000 - 100)
    assert (found == 4).tolist() == wanted.tolist()


def test_hysteresis_keeps_a_switch_from_switching_again() -> None:
    """DCS-07: going back by less than it changes nothing."""
    forth_and_back = [990.0, 1000.5, 999.0, 1000.5, 999.0, 1001.0]
    for hysteresis, wanted in ((0.0, [0, 1, 0, 1, 0, 1]), (2.0, [0, 1, 1, 1, 1, 1])):
        with shaft((Dog(1, 1000, 2000),), rotary=False, Hysteresis=hysteresis) as one:
            assert [one.at(position, 0.0) for position in forth_and_back] == wanted
            if hysteresis:
                assert one.at(998.9, 0.0) == 0
                assert one.at(1000.5, 0.0) == 0
                assert one.at(1000.95, 0.0) == 1


def test_time_begins_again_when_the_position_is_passed_again() -> None:
    with shaft((Dog(1, 100, ms=20),), rotary=False) as one:
        found = [one.at(position, 1.0) for position in (99, 101, 101, 99, 99, 99, 99, 99, 99)]
    assert found == [0, 1, 1, 1, 1, 1, 1, 0, 0]


def test_time_is_not_begun_at_the_opposite_place_nor_by_standing_there() -> None:
    with shaft((Dog(1, 100, ms=50),)) as one:
        assert {one.at(position, 900.0) for position in along(2500.0, 900.0, 0.6)} == {0}
        one.set("Switch", Enable=False)
        one.cycle()
        one.set("Switch", Enable=True)
        assert [one.at(position, 1.0) for position in (100, 100, 101)] == [0, 0, 0]


def model(
    dog: Dog,
    positions: npt.NDArray[np.float64],
    velocity: npt.NDArray[np.float64],
    rotary: bool,
    on: float,
    off: float,
) -> npt.NDArray[np.bool_]:
    """When a switch is on, by its intervals in each turn; without hysteresis, of a moving axis."""
    forward = velocity > 0
    acts = np.full(len(positions), True) if dog.direction == 0 else forward == (dog.direction == 1)
    turns = range(-12, 13) if rotary else (0,)
    if dog.ms is None:
        last = dog.last + (PERIOD if rotary and dog.last < dog.first else 0.0)
        low = dog.first + np.where(forward, on, off) * velocity
        high = last + np.where(forward, off, on) * velocity
        inside = [(positions >= low + k * PERIOD) & (positions <= high + k * PERIOD) for k in turns]
        return acts & np.any(inside, axis=0)
    found = np.zeros(len(positions), dtype=bool)
    behind = np.array([dog.first + on * velocity + k * PERIOD - positions for k in turns])
    for cycle in range(1, len(positions)):
        up = (behind[:, cycle - 1] > 0) & (behind[:, cycle] <= 0)
        down = (behind[:, cycle - 1] < 0) & (behind[:, cycle] >= 0)
        if acts[cycle] and np.any(up if forward[cycle] else down):
            found[cycle : cycle + int(np.ceil(dog.ms / 1000 / CYCLE - 1e-9))] = True
    return found


def random_motion(
    random: np.random.Generator, cycles: int
) -> tuple[npt.NDArray[np.float64], npt.NDArray[np.float64]]:
    """Positions and velocities of an axis that reverses, and passes less than half a turn a cycle."""
    velocity = np.repeat(random.uniform(-6e4, 6e4, cycles // 20), 20) + random.uniform(-100, 100, cycles)
    positions = random.uniform(0, PERIOD) + np.cumsum(velocity * CYCLE)
    return positions, velocity


@pytest.mark.parametrize("seed", range(60))
def test_random_switches_against_the_model(seed: int) -> None:
    """DCS-02 to DCS-08 over random tables, motions and compensations."""
    random = np.random.default_rng(seed)
    rotary = seed % 3 > 0
    on, off = (0.0, 0.0) if seed % 2 else random.uniform(-0.01, 0.01, 2)
    dogs = []
    for _ in range(random.integers(1, SWITCHES + 1)):
        first, last = random.uniform(0, PERIOD, 2) if rotary else np.sort(random.uniform(-9e3, 9e3, 2))
        ms = int(random.integers(1, 200)) if random.random() < 0.4 else None
        dogs.append(
            Dog(int(random.integers(1, 5)), float(first), float(last), int(random.choice([-1, 0, 1, 2])), ms)
        )
    positions, velocity = random_motion(random, 200)
    mask = int(random.integers(0, 16)) | 0b1001
    with shaft(tuple(dogs), rotary=rotary, OnCompensation=on, OffCompensation=off) as one:
        one.set("Switch", EnableMask=mask)
        found = np.array([one.at(float(p), float(v)) for p, v in zip(positions, velocity, strict=True)])
    for track in range(1, 5):
        wanted = np.zeros(len(positions), dtype=bool)
        for dog in dogs:
            if dog.track == track and mask >> (track - 1) & 1:
                wanted |= model(dog, positions, velocity, rotary, float(on), float(off))
        assert (found >> (track - 1) & 1).astype(bool).tolist() == wanted.tolist(), track


@pytest.mark.parametrize(
    ("mode", "powered", "actual"),
    [(0, True, False), (0, False, True), (1, False, False), (2, True, True)],
)
def test_which_position_counts(mode: int, powered: bool, actual: bool) -> None:
    """DCS-06."""
    with shaft((Dog(1, 100, 200), Dog(2, 300, 400))) as one:
        one.set("Switch", TappetMode=mode)
        one.set("Axis", bRegulatorOn=powered, fSetPosition=150.0)
        assert one.at(350.0, 0.0) == (2 if actual else 1)


def test_outputs_go_off_with_enable_and_are_then_left_alone() -> None:
    """DCS-05, ENA-05."""
    with shaft((Dog(1, 100, 200), Dog(32, 100, 200))) as one:
        assert one.at(150.0, 0.0) == 1 << 31 | 1
        assert (one.text("Switch.InOperation"), one.text("Switch.Busy")) == ("TRUE", "TRUE")
        one.set("Switch", EnableMask=0x7FFFFFFF)
        assert one.cycle() == 1
        one.set("Switch", Enable=False)
        assert one.cycle() == 0
        assert (one.text("Switch.InOperation"), one.text("Switch.Busy")) == ("FALSE", "FALSE")
        one.switch_on(5)
        assert one.cycle() == 16


@pytest.mark.parametrize(
    ("variable", "members"),
    [
        ("aSwitches[1]", {"TrackNumber": 0}),
        ("aSwitches[1]", {"TrackNumber": 33}),
        ("aSwitches[1]", {"AxisDirection": 3}),
        ("aSwitches[1]", {"CamSwitchMode": 2}),
        ("aSwitches[1]", {"FirstOnPosition": float("nan")}),
        ("aSwitches[1]", {"LastOnPosition": float("inf")}),
        ("Options", {"Hysteresis": -1.0}),
        ("Options", {"OnCompensation": float("nan")}),
        ("Switches", {"CamSwitchPtr": 0}),
    ],
)
def test_switches_that_are_none(variable: str, members: dict[str, float]) -> None:
    with shaft((Dog(1, 100, 200),)) as one:
        assert one.at(150.0, 0.0) == 1
        one.set(variable, **members)
        assert one.cycle() == 0
        assert (one.text("Switch.Error"), one.text("Switch.ErrorID")) == ("TRUE", "SMC_DCS_INVALID_SWITCHES")
        assert one.text("Switch.InOperation") == "FALSE"
        one.cycle()
        kept = [one.text(f"Axis.fbeFBError[{entry}].eErrorID") for entry in range(2)]
        assert kept == ["SMC_DCS_INVALID_SWITCHES", "SMC_NO_ERROR"]
        assert one.text("Axis.nAxisState") == "power_off"


def test_an_axis_without_a_bus_switches_nothing() -> None:
    with shaft((Dog(1, 100, 200),)) as one:
        one.set("Axis", wCommunicationState=7)
        assert one.at(150.0, 0.0) == 0
        assert one.text("Switch.ErrorID") == "SMC_AXIS_IS_NOT_OPERATIONAL"
