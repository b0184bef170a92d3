"""What PLCopen part 4, version 2.0, has beyond the catalog: reading, dynamics, limits, jogging."""

from __future__ import annotations

import math
from collections.abc import Iterator
from functools import cache
from itertools import pairwise
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tappet.codegen.build import BuildOptions, BuildSession, LibraryReference, build_application
from tappet.codegen.package import CodePackage
from tappet.iec.task import Task
from tappet.lang.source import Source
from tappet.runtime.local import LocalRuntime

CYCLE = 0.004
BLOCKS = {
    "Power": "MC_GroupPower",
    "Enable": "MC_GroupEnable",
    "Move": "MC_MoveLinearAbsolute",
    "Second": "MC_MoveLinearAbsolute",
    "Wait": "MC_GroupWaitTime",
    "Position": "MC_GroupReadPosition",
    "Velocity": "MC_GroupReadVelocity",
    "Acceleration": "MC_GroupReadAcceleration",
    "MotionState": "MC_GroupReadMotionState",
    "Transform": "MC_GroupTransformPosition",
    "Frame": "MC_SetCoordinateTransform",
    "WriteDefault": "MC_GroupWriteDefaultDynamics",
    "ReadDefault": "MC_GroupReadDefaultDynamics",
    "WriteReference": "MC_GroupWriteReferenceDynamics",
    "ReadReference": "MC_GroupReadReferenceDynamics",
    "WriteJogging": "MC_GroupWriteJoggingDynamics",
    "ReadJogging": "MC_GroupReadJoggingDynamics",
    "WriteParameter": "MC_GroupWriteParameter",
    "ReadParameter": "MC_GroupReadParameter",
    "WriteBool": "MC_GroupWriteBoolParameter",
    "ReadBool": "MC_GroupReadBoolParameter",
    "WriteLimits": "MC_GroupWriteSWLimits",
    "ReadLimits": "MC_GroupReadSWLimits",
    "Jog": "MC_GroupJog",
    "JogVector": "MC_GroupJogVector",
}
_AXIS = (
    f"(fTaskCycle := {CYCLE}, fMaxVelocity := 1E5, fSWMaxVelocity := 1E4, fMaxAcceleration := 1E6, "
    "fMaxDeceleration := 1E6, fSWMaxAcceleration := 1E4, fSWMaxDeceleration := 1E4, fSWMaxJerk := 1E6)"
)
_INSTANCES = "\n".join(f"    {name} : {block};" for name, block in BLOCKS.items())
_CALLS = "\n".join(f"{name}(AxisGroup := Group);" for name in BLOCKS)
PROGRAM = f"""PROGRAM Main
VAR
    X, Y  : AXIS_REF_VIRTUAL_SM3 := {_AXIS};
    Alone : AXIS_REF_VIRTUAL_SM3 := {_AXIS};
    Group : AXIS_GROUP_REF_SM3;
    AddX, AddY : MC_AddAxisToGroup;
    Info, InfoAlone : MC_ReadAxisGroupInfo;
    Kin : TRAFO.Kin_GantryT2;
    SetKin : MC_SetKinTransform;
{_INSTANCES}
END_VAR
X.BeginCycle();
Y.BeginCycle();
AddX(AxisGroup := Group, Axis := X, Execute := TRUE);
AddY(AxisGroup := Group, Axis := Y, Execute := TRUE);
SetKin(AxisGroup := Group, KinTransform := Kin);
Info(AxisGroup := Group, Axis := Y, Enable := TRUE);
InfoAlone(AxisGroup := Group, Axis := Alone, Enable := TRUE);
{_CALLS}
X.EndCycle();
Y.EndCycle();
END_PROGRAM
"""
VALUES, LIMITS = "SMC_AXIS_GROUP_INVALID_VALUES", "SMC_DI_SWLIMITS_EXCEEDED"
DYNAMICS = {"Velocity": 100.0, "Acceleration": 500.0, "Deceleration": 400.0, "Jerk": 0.0}


@cache
def _package() -> CodePackage:
    libraries = tuple(map(LibraryReference, ("SM3_Basic", "SM3_AxisGroup", "SM3_Transformation")))
    tasks = [Task("Motion", interval_ns=4_000_000, programs=("Main",))]
    result = build_application(
        [Source("Main", PROGRAM)],
        tasks,
        options=BuildOptions(libraries=libraries, level=1),
        session=BuildSession(),
    )
    assert [str(d) for d in result.diagnostics if d.severity != "info"] == []
    assert result.package is not None
    return result.package


class Machine:
    """The running program."""

    def __init__(self, plc: LocalRuntime) -> None:
        self.plc = plc

    def after(self, seconds: float) -> None:
        self.plc.run(cycles=round(seconds / CYCLE))

    def put(self, block: str, **inputs: Any) -> None:
        for name, value in inputs.items():
            self.plc.write(f"Main.{block}.{name}", value)

    def start(self, block: str, **inputs: Any) -> None:
        """A rising edge of Execute."""
        self.put(block, **inputs, Execute=False)
        self.plc.run(cycles=1)
        self.put(block, Execute=True)
        self.plc.run(cycles=1)

    def get(self, path: str) -> Any:
        return self.plc.read(f"Main.{path}")

    def word(self, path: str) -> str:
        return self.plc.literal(f"Main.{path}")

    def to(self, block: str, x: float, y: float = 0.0, **inputs: Any) -> None:
        """A movement to a place of the axes."""
        self.put(block, **{"Position.a[0]": x, "Position.a[1]": y, "CoordSystem": 0})
        self.start(block, **inputs)

    def place(self) -> tuple[float, float]:
        return float(self.get("X.fSetPosition")), float(self.get("Y.fSetPosition"))

    def speed(self) -> float:
        return float(self.get("Group.fPathVelocity"))


@pytest.fixture
def machine() -> Iterator[Machine]:
    """With power and enabled."""
    with LocalRuntime(_package()) as plc:
        made = Machine(plc)
        made.put("Power", Enable=True)
        made.after(0.04)
        made.start("Enable")
        assert made.word("Group.eState") == "GroupStandby"
        yield made


def test_power_of_all_axes(machine: Machine) -> None:
    assert machine.get("Power.Status")
    assert machine.get("Power.Valid")
    machine.put("Power", Enable=False)
    machine.after(0.04)
    assert not machine.get("Power.Status")
    assert machine.word("X.nAxisState") == "power_off"


def test_which_axis_has_which_number(machine: Machine) -> None:
    assert (machine.get("Info.InGroup"), machine.get("Info.IdentInGroup")) == (True, 2)
    assert (machine.get("InfoAlone.InGroup"), machine.get("InfoAlone.IdentInGroup")) == (False, 0)


@pytest.mark.parametrize("source", [0, 1, 2])
def test_position_by_its_source(machine: Machine, source: int) -> None:
    """The actual position of a virtual axis is its set position; in ACS and MCS alike without kinematics."""
    machine.put("Position", Enable=True, Source=source, CoordSystem=1)
    machine.to("Move", 30.0, 40.0, **DYNAMICS)
    machine.after(2.0)
    assert machine.get("Position.Valid")
    read = [float(machine.get(f"Position.Position.a[{axis}]")) for axis in range(2)]
    assert read == pytest.approx([30.0, 40.0])
    machine.put("Position", CoordSystem=9)
    machine.plc.run(cycles=1)
    assert machine.word("Position.ErrorID") == VALUES
    assert float(machine.get("Position.Position.a[0]")) == 0.0


@pytest.mark.parametrize("source", [0, 1, 2])
def test_velocities_and_accelerations_by_their_source(machine: Machine, source: int) -> None:
    """Along (3, 4) / 5 at 100 mm/s; with 500 mm/s² while the speed rises."""
    for block in ("Velocity", "Acceleration"):
        machine.put(block, Enable=True, Source=source, CoordSystem=0)
    machine.to("Move", 300.0, 400.0, **DYNAMICS)
    machine.after(0.1)
    accelerations = [float(machine.get(f"Acceleration.Acceleration[{axis}]")) for axis in range(2)]
    assert accelerations == pytest.approx([300.0, 400.0], rel=1e-6)
    assert float(machine.get("Acceleration.PathAcceleration")) == pytest.approx(500.0)
    machine.after(0.5)
    velocities = [float(machine.get(f"Velocity.Velocity[{axis}]")) for axis in range(2)]
    assert velocities == pytest.approx([60.0, 80.0], rel=1e-6)
    assert float(machine.get("Velocity.PathVelocity")) == pytest.approx(100.0)


ANGLE = math.radians(30.0)
PLACE = (70.0, -20.0)
PRODUCT = (
    10.0 + PLACE[0] * math.cos(ANGLE) - PLACE[1] * math.sin(ANGLE),
    5.0 + PLACE[0] * math.sin(ANGLE) + PLACE[1] * math.cos(ANGLE),
)
"""PLACE in a product that lies at (10, 5), turned by 30 degrees, in the machine."""


@pytest.mark.parametrize(
    ("kinematics", "systems", "expected"),
    [
        (False, (3, 1), PRODUCT),
        (False, (3, 0), PRODUCT),
        (False, (0, 1), PLACE),
        (True, (3, 1), PRODUCT),
        (True, (1, 0), (PLACE[0] - PLACE[1], PLACE[0] + PLACE[1])),
        (True, (3, 0), (PRODUCT[0] - PRODUCT[1], PRODUCT[0] + PRODUCT[1])),
        (True, (0, 1), ((PLACE[0] + PLACE[1]) / 2, (PLACE[1] - PLACE[0]) / 2)),
    ],
)
def test_a_position_in_another_coordinate_system(
    machine: Machine, kinematics: bool, systems: tuple[int, int], expected: tuple[float, float]
) -> None:
    """Without a kinematics, and with that of a T portal: the axes are X - Y and X + Y."""
    machine.start("Frame", **{"CoordTransform.X": 10.0, "CoordTransform.Y": 5.0, "CoordTransform.A": 30.0})
    if kinematics:
        machine.start("SetKin")
        assert machine.word("SetKin.ErrorID") == "SMC_NO_ERROR"
    places = {f"InputPosition.a[{axis}]": PLACE[axis] for axis in range(2)}
    machine.put("Transform", Enable=True, InputCoordSystem=systems[0], OutputCoordSystem=systems[1], **places)
    machine.plc.run(cycles=1)
    assert machine.word("Transform.ErrorID") == "SMC_NO_ERROR"
    found = [float(machine.get(f"Transform.OutputPosition.a[{axis}]")) for axis in range(2)]
    assert found == pytest.approx(expected)
    machine.put("Transform", InputCoordSystem=9)
    machine.plc.run(cycles=1)
    assert machine.word("Transform.ErrorID") == VALUES


def test_the_motion_state_follows_the_profile(machine: Machine) -> None:
    """500 mm/s² to 100 mm/s: 0.2 s; braking with 400: 0.25 s; 100 mm take 0.2 + 0.775 + 0.25 s."""
    machine.put("MotionState", Enable=True)
    machine.plc.run(cycles=1)
    assert machine.get("MotionState.Standstill")
    machine.to("Move", 100.0, **DYNAMICS)
    seen = []
    for seconds in (0.1, 0.4, 0.61):
        machine.after(seconds)
        flags = ("Accelerating", "ConstantVelocity", "Decelerating", "Standstill", "InPosition")
        seen.append([flag for flag in flags if machine.get(f"MotionState.{flag}")])
        assert machine.get("MotionState.ActiveCommandID") == machine.get("Move.CommandID")
    assert seen == [["Accelerating"], ["ConstantVelocity"], ["Decelerating"]]
    machine.after(0.3)
    assert machine.get("MotionState.Standstill")
    assert machine.get("MotionState.InPosition")
    assert machine.get("MotionState.ActiveCommandID") == 0


def test_a_command_says_that_it_was_accepted(machine: Machine) -> None:
    """CommandAccepted and CommandID from the edge until Execute falls; not of a refused command."""
    machine.to("Move", 100.0, **DYNAMICS)
    first = machine.get("Move.CommandID")
    assert machine.get("Move.CommandAccepted")
    assert first == machine.get("Move.MovementId") > 0
    machine.to("Second", 50.0, **{**DYNAMICS, "BufferMode": 1})
    assert machine.get("Second.CommandID") == first + 1
    machine.after(3.0)
    assert machine.get("Second.Done")
    assert machine.get("Second.CommandAccepted")
    machine.put("Second", Execute=False)
    machine.plc.run(cycles=1)
    assert (machine.get("Second.CommandAccepted"), machine.get("Second.CommandID")) == (False, 0)
    machine.to("Move", 100.0, **{**DYNAMICS, "Velocity": -1.0})
    assert (machine.get("Move.CommandAccepted"), machine.get("Move.CommandID")) == (False, 0)
    assert machine.word("Move.ErrorID") == VALUES


def test_a_wait_of_a_time(machine: Machine) -> None:
    machine.start("Wait", Duration=500, BufferMode=0)
    cycles = 1
    while machine.get("Wait.Busy"):
        machine.plc.run(cycles=1)
        cycles += 1
        assert cycles < 1000
    assert cycles * CYCLE == pytest.approx(0.5, abs=2 * CYCLE)
    assert machine.get("Wait.Done")


@pytest.mark.parametrize("kind", ["Default", "Reference", "Jogging"])
def test_dynamics_are_written_and_read(machine: Machine, kind: str) -> None:
    machine.put(f"Read{kind}", Enable=True)
    machine.start(f"Write{kind}", **DYNAMICS)
    assert machine.get(f"Write{kind}.Done")
    read = {name: float(machine.get(f"Read{kind}.{name}")) for name in DYNAMICS}
    assert read == DYNAMICS
    machine.start(f"Write{kind}", **{**DYNAMICS, "Jerk": -1.0})
    assert machine.word(f"Write{kind}.ErrorID") == VALUES
    assert float(machine.get(f"Read{kind}.Jerk")) == 0.0
    machine.put(f"Read{kind}", Enable=False)
    machine.plc.run(cycles=1)
    assert float(machine.get(f"Read{kind}.Velocity")) == 0.0


def test_per_cent_of_the_reference_dynamics(machine: Machine) -> None:
    """40 per cent of 100 mm/s and 20 per cent of 500 mm/s²."""
    machine.start("WriteReference", **DYNAMICS)
    machine.start("WriteParameter", ParameterNumber=1, Value=1.0)
    assert machine.get("WriteParameter.Done")
    machine.to("Move", 1000.0, Velocity=40.0, Acceleration=20.0, Deceleration=25.0)
    machine.after(0.2)
    assert float(machine.get("Group.fPathAcceleration")) == pytest.approx(100.0)
    machine.after(0.4)
    assert machine.speed() == pytest.approx(40.0)


@given(
    factors=st.tuples(st.floats(1, 100), st.floats(5, 100), st.floats(5, 100)),
    distance=st.floats(1.0, 500.0),
)
@settings(max_examples=10, deadline=None)
def test_per_cent_is_the_same_motion_as_units(factors: tuple[float, float, float], distance: float) -> None:
    """The trapezoid of the reference times the percentage, in closed form."""
    velocity, acceleration, deceleration = (
        part / 100 * whole for part, whole in zip(factors, (100.0, 500.0, 400.0), strict=True)
    )
    peak = min(velocity, math.sqrt(2 * distance / (1 / acceleration + 1 / deceleration)))
    ramps = peak / acceleration + peak / deceleration
    expected = ramps + (distance - peak * ramps / 2) / velocity
    with LocalRuntime(_package()) as plc:
        machine = Machine(plc)
        machine.put("Power", Enable=True)
        machine.after(0.04)
        machine.start("Enable")
        machine.start("WriteReference", **DYNAMICS)
        machine.start("WriteParameter", ParameterNumber=1, Value=1.0)
        given = dict(zip(("Velocity", "Acceleration", "Deceleration"), factors, strict=True))
        machine.to("Move", distance, **given)
        machine.after(expected - 3 * CYCLE)
        assert machine.get("Move.Busy")
        machine.after(6 * CYCLE)
        assert machine.get("Move.Done")
        assert machine.place()[0] == pytest.approx(distance)


@pytest.mark.parametrize(
    ("number", "value", "taken"), [(1, 2.0, False), (1000, 30.0, True), (1000, -1.0, False), (7, 1.0, False)]
)
def test_parameters_are_checked(machine: Machine, number: int, value: float, taken: bool) -> None:
    machine.start("WriteParameter", ParameterNumber=number, Value=value)
    assert machine.get("WriteParameter.Done") == taken
    assert machine.word("WriteParameter.ErrorID") == ("SMC_NO_ERROR" if taken else VALUES)
    machine.put("ReadParameter", Enable=True, ParameterNumber=number)
    machine.plc.run(cycles=1)
    assert machine.get("ReadParameter.Valid") == (number != 7)
    if taken:
        assert float(machine.get("ReadParameter.Value")) == value
        machine.to("Move", 1000.0, **DYNAMICS)
        machine.after(1.0)
        assert machine.speed() == pytest.approx(value)


def limit(machine: Machine, axis: int, low: float, high: float) -> None:
    values = {"Enable": True, "Negative": low, "Positive": high}
    machine.put(
        "WriteLimits", **{f"LimitValues.Axes[{axis}].{name}": value for name, value in values.items()}
    )
    machine.start("WriteLimits")


def test_software_limits_of_the_group(machine: Machine) -> None:
    limit(machine, 1, -10.0, 20.0)
    assert machine.get("WriteLimits.Done")
    machine.put("ReadLimits", Enable=True)
    machine.to("Move", 500.0, 20.001, **DYNAMICS)
    assert machine.word("Move.ErrorID") == LIMITS
    assert float(machine.get("ReadLimits.LimitValues.Axes[1].Positive")) == 20.0
    machine.to("Move", 500.0, 20.0, **DYNAMICS)
    assert machine.get("Move.Busy")
    machine.start("WriteBool", ParameterNumber=1004, Value=False)
    machine.put("ReadBool", Enable=True)
    machine.to("Move", 500.0, 30.0, **DYNAMICS)
    assert machine.get("Move.Busy")
    assert (machine.get("ReadBool.Valid"), machine.get("ReadBool.Value")) == (True, False)
    limit(machine, 0, 5.0, 5.0)
    assert machine.word("WriteLimits.ErrorID") == VALUES


def jogged(machine: Machine, seconds: float) -> list[tuple[float, float]]:
    """The places of the axes in each cycle."""
    places = [machine.place()]
    for _ in range(round(seconds / CYCLE)):
        machine.plc.run(cycles=1)
        places.append(machine.place())
    return places


def check_limits(places: list[tuple[float, float]]) -> None:
    """By differences: neither axis jumps in its velocity."""
    for axis in range(2):
        speeds = [(b[axis] - a[axis]) / CYCLE for a, b in pairwise(places)]
        rises = [abs(b - a) / CYCLE for a, b in pairwise(speeds)]
        assert max(rises) <= 500.0 * (1 + 1e-6)


def test_jogging_along_coordinates(machine: Machine) -> None:
    """X at 100 mm/s, then X and Y with it along the diagonal, then back: each turn begins from standstill."""
    machine.start("WriteJogging", **DYNAMICS)
    machine.put("Jog", **{"Enable": True, "CoordSystem": 0, "JogForward[0]": True})
    places = jogged(machine, 1.0)
    assert machine.speed() == pytest.approx(100.0)
    assert machine.get("Jog.Active")
    machine.put("Jog", **{"JogForward[1]": True})
    places += jogged(machine, 1.5)[1:]
    (x0, y0), (x1, y1) = places[-2:]
    assert (x1 - x0) / CYCLE == pytest.approx(100.0 / math.sqrt(2))
    assert y1 - y0 == pytest.approx(x1 - x0)
    machine.put("Jog", **{"JogForward[0]": False, "JogForward[1]": False})
    places += jogged(machine, 0.4)[1:]
    assert machine.speed() == 0.0
    assert not machine.get("Jog.Active")
    assert machine.word("Group.eState") == "GroupStandby"
    machine.put("Jog", **{"JogBackward[0]": True, "VelFactor": 0.5})
    places += jogged(machine, 0.5)[1:]
    assert machine.speed() == pytest.approx(50.0)
    assert places[-1][0] < places[-2][0]
    check_limits(places)


def test_jogging_ends_at_the_software_limits(machine: Machine) -> None:
    limit(machine, 0, -5.0, 30.0)
    machine.start("WriteJogging", **DYNAMICS)
    machine.put("Jog", **{"Enable": True, "CoordSystem": 0, "JogForward[0]": True, "JogForward[1]": False})
    places = jogged(machine, 2.0)
    assert places[-1] == pytest.approx((30.0, 0.0), abs=1e-6)
    assert not machine.get("Jog.Error")
    machine.put("Jog", **{"JogForward[0]": False, "JogBackward[0]": True})
    places += jogged(machine, 2.0)[1:]
    assert places[-1] == pytest.approx((-5.0, 0.0), abs=1e-6)
    check_limits(places)


def test_jogging_without_dynamics_is_an_error_until_the_key_is_let_go(machine: Machine) -> None:
    machine.put("Jog", **{"Enable": True, "CoordSystem": 0, "JogForward[0]": True})
    machine.after(0.1)
    assert machine.word("Jog.ErrorID") == VALUES
    machine.start("WriteJogging", **DYNAMICS)
    machine.after(0.1)
    assert machine.get("Jog.Error")
    machine.put("Jog", **{"JogForward[0]": False})
    machine.after(0.1)
    assert not machine.get("Jog.Error")
    machine.put("Jog", **{"JogForward[0]": True})
    machine.after(0.5)
    assert machine.speed() == pytest.approx(100.0)


def test_another_command_takes_the_group_from_the_hand(machine: Machine) -> None:
    machine.start("WriteJogging", **DYNAMICS)
    machine.put("Jog", **{"Enable": True, "CoordSystem": 0, "JogForward[0]": True})
    machine.after(0.5)
    machine.to("Move", 500.0, **DYNAMICS)
    machine.after(0.1)
    assert machine.get("Jog.CommandAborted")
    assert machine.get("Move.Active")
    machine.after(6.0)
    assert machine.place()[0] == pytest.approx(500.0)
    machine.put("Jog", **{"JogForward[0]": False})
    machine.plc.run(cycles=2)
    assert not machine.get("Jog.CommandAborted")


@given(vector=st.tuples(st.floats(-1, 1), st.floats(-1, 1)).filter(lambda v: math.hypot(*v) > 0.05))
@settings(max_examples=10, deadline=None)
def test_jogging_along_a_vector(vector: tuple[float, float]) -> None:
    """The velocity of each axis is its part of the vector, whose length is at most 1."""
    length = math.hypot(*vector)
    part = min(length, 1.0) / length
    with LocalRuntime(_package()) as plc:
        machine = Machine(plc)
        machine.put("Power", Enable=True)
        machine.after(0.04)
        machine.start("Enable")
        machine.start("WriteJogging", **DYNAMICS)
        machine.put(
            "JogVector", Enable=True, CoordSystem=0, **{f"Vector[{n}]": v for n, v in enumerate(vector)}
        )
        places = jogged(machine, 0.5)
        for axis in range(2):
            speed = (places[-1][axis] - places[-2][axis]) / CYCLE
            assert speed == pytest.approx(100.0 * part * vector[axis], abs=1e-6)
        check_limits(places)
