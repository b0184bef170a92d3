"""Profiles, jogging, inching and set values that a program writes, against scipy and closed forms."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from scipy.interpolate import BPoly, PchipInterpolator
from tests.libraries.coupled_axes import CoupledAxes, coupled_axes
from tests.libraries.one_axis import CYCLE

RAMP = {"Acceleration": 100.0, "Deceleration": 100.0}
MEMBER = {"Positions": "P", "Velocities": "V", "Accelerations": "A"}
VALUE = {"Positions": "position", "Velocities": "velocity", "Accelerations": "acceleration"}


@pytest.fixture
def axes() -> Iterator[CoupledAxes]:
    with coupled_axes() as found:
        yield found


def _fill(axes: CoupledAxes, block: str, points: list[tuple[int, float]], absolute: bool = True) -> None:
    table = f"{block}Table"
    for number, (milliseconds, value) in enumerate(points, 1):
        row = f"{table}.MC_T{MEMBER[block]}_Array[{number}]"
        axes.write(f"{row}.delta_time", f"T#{milliseconds}ms")
        axes.write(f"{row}.{VALUE[block]}", value)
    axes.write(f"{table}.Number_of_pairs", len(points))
    axes.write(f"{table}.IsAbsolute", absolute)


def test_accelerations_are_connected_by_lines(axes: CoupledAxes) -> None:
    """motion_semantics EX-11."""
    _fill(axes, "Accelerations", [(1000, 10.0), (2000, 10.0), (1000, -20.0)])
    axes.start("Accelerations", ArraySize=3)
    found = []
    for seconds in (1.0 - CYCLE, 2.0, 1.0):
        axes.after(seconds)
        found.append(axes.velocity)
    assert found == pytest.approx([5.0, 25.0, 20.0], abs=1e-9)
    assert axes.state == "continuous_motion"
    axes.cycle()
    assert axes.outputs("Accelerations") == {"Busy", "Active", "Done"}
    axes.release("Accelerations")
    assert axes.outputs("Accelerations") == {"Busy", "Active"}
    axes.after(0.5)
    assert axes.velocity == pytest.approx(20.0)
    # position: 10/6, + 5*2 + 10*2^2/2, + 25 + 10/2 - 30/6
    assert axes.position == pytest.approx(
        10 / 6 + 30.0 + 25.0 + 5.0 - 5.0 + 20.0 * (0.5 + 2 * CYCLE), abs=1e-6
    )


def test_velocities_are_connected_by_lines(axes: CoupledAxes) -> None:
    _fill(axes, "Velocities", [(500, 10.0), (1000, 5.0), (250, -15.0)], absolute=False)
    axes.start("Velocities", ArraySize=3, VelocityScale=2.0)
    assert axes.state == "continuous_motion"
    found = []
    for seconds in (0.5 - CYCLE, 1.0, 0.25):
        axes.after(seconds)
        found.append(axes.velocity)
    assert found == pytest.approx([20.0, 30.0, 0.0], abs=1e-9)
    assert axes.position == pytest.approx(5.0 + 25.0 + 3.75, abs=1e-9)
    axes.cycle()
    assert axes.outputs("Velocities") == {"Done"}
    assert axes.state == "standstill"


POINTS = st.lists(
    st.tuples(st.integers(50, 800), st.floats(-100.0, 100.0).map(lambda x: round(x, 3))),
    min_size=1,
    max_size=12,
)


@settings(max_examples=20, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(points=POINTS)
def test_positions_are_those_of_scipy(points: list[tuple[int, float]]) -> None:
    times = np.cumsum([0.0, *(t / 1000.0 for t, _ in points)])
    places = np.array([0.0, *(p for _, p in points)])
    slopes = np.zeros(len(times))
    if len(points) > 1:
        slopes[1:-1] = PchipInterpolator(times, places).derivative()(times[1:-1])
    curve = BPoly.from_derivatives(times, [[p, v, 0.0] for p, v in zip(places, slopes, strict=True)])
    with coupled_axes() as axes:
        _fill(axes, "Positions", points)
        axes.start("Positions", ArraySize=len(points))
        for cycle in range(1, round(times[-1] / CYCLE)):
            now = cycle * CYCLE
            assert axes.position == pytest.approx(float(curve(now)), abs=1e-8)
            assert axes.velocity == pytest.approx(float(curve.derivative()(now)), abs=1e-6)
            axes.cycle()
        axes.cycle(2)
        assert axes.position == pytest.approx(points[-1][1], abs=1e-9)
        assert axes.outputs("Positions") == {"Done"}
        assert axes.state == "standstill"


def test_a_position_profile_stays_between_its_points(axes: CoupledAxes) -> None:
    _fill(axes, "Positions", [(1000, 10.0), (1000, 20.0), (1000, 20.0)])
    axes.start("Positions", ArraySize=3)
    assert axes.state == "discrete_motion"
    reached = []
    before = 0.0
    for _ in range(3):
        axes.after(1.0 - (CYCLE if not reached else 0.0))
        reached.append(axes.position)
        assert axes.position >= before
        before = axes.position
    assert reached == pytest.approx([10.0, 20.0, 20.0], abs=1e-9)


@pytest.mark.parametrize("block", MEMBER)
def test_wrong_profiles_are_refused(axes: CoupledAxes, block: str) -> None:
    prefix = f"SMC_{MEMBER[block]}P"
    _fill(axes, block, [(100, 1.0), (0, 2.0)])
    for size, error in ((0, "_ARRAYSIZE"), (3, "_ARRAYSIZE"), (101, "_ARRAYSIZE"), (2, "_STEP0MS")):
        axes.start(block, ArraySize=size)
        assert (axes.outputs(block), axes.text(f"{block}.ErrorID")) == ({"Error"}, prefix + error)
        axes.release(block)
    axes.start("Velocity", Velocity=10.0, **RAMP)
    axes.start(block, ArraySize=1)
    assert axes.text(f"{block}.ErrorID") == "SMC_AXIS_NOT_READY_FOR_MOTION"
    assert axes.state == "continuous_motion"


def test_a_profile_is_aborted_without_a_step(axes: CoupledAxes) -> None:
    _fill(axes, "Velocities", [(1000, 100.0), (5000, 100.0)])
    axes.start("Velocities", ArraySize=2)
    axes.after(2.0)
    axes.start("Halt", Deceleration=100.0)
    assert axes.velocity == pytest.approx(100.0, abs=0.11)
    axes.cycle()
    assert axes.outputs("Velocities") == {"CommandAborted"}
    assert axes.until("Halt", "Done") == pytest.approx(1.0, abs=3 * CYCLE)


def test_jogging_lasts_as_long_as_its_input(axes: CoupledAxes) -> None:
    axes.set("Jog", JogForward=True, Velocity=50.0, **RAMP)
    axes.after(2.0)
    assert (axes.velocity, axes.state, axes.outputs("Jog")) == (50.0, "continuous_motion", {"Busy"})
    axes.set("Jog", JogForward=False)
    axes.after(0.49)
    assert axes.outputs("Jog") == {"Busy"}
    axes.cycle(12)
    assert (axes.position, axes.outputs("Jog"), axes.state) == (pytest.approx(100.0), set(), "standstill")
    axes.set("Jog", JogForward=True, JogBackward=True)
    axes.after(0.1)
    assert axes.state == "standstill"
    axes.set("Jog", JogForward=False)
    axes.after(1.0)
    assert axes.velocity == -50.0
    axes.set("Jog", JogForward=True)
    axes.after(1.0)
    assert axes.velocity == 0.0


def test_jogging_says_what_went_wrong_as_long_as_its_input(axes: CoupledAxes) -> None:
    axes.set("Jog", JogBackward=True, Velocity=50.0, Acceleration=0.0, Deceleration=1.0)
    axes.cycle(3)
    assert (axes.outputs("Jog"), axes.text("Jog.ErrorID")) == ({"Error"}, "SMC_MV_INVALID_ACCDEC_VALUES")
    axes.set("Jog", JogBackward=False)
    axes.cycle()
    assert axes.outputs("Jog") == set()
    axes.set("Jog", JogForward=True, **RAMP)
    axes.after(0.2)
    axes.start("Stop", Deceleration=1000.0)
    axes.cycle(3)
    assert axes.outputs("Jog") == {"CommandAborted"}
    axes.set("Jog", JogForward=False)
    axes.cycle(2)
    assert axes.outputs("Jog") == set()


def test_wrong_values_while_jogging_stop_the_axis(axes: CoupledAxes) -> None:
    axes.set("Jog", JogForward=True, Velocity=50.0, **RAMP)
    axes.after(1.0)
    axes.set("Jog", JogForward=False, JogBackward=True, Acceleration=-1.0)
    axes.after(0.6)
    assert axes.velocity == 0.0
    assert axes.text("Jog.ErrorID") == "SMC_MV_INVALID_ACCDEC_VALUES"


def test_inching_moves_a_step_for_each_edge(axes: CoupledAxes) -> None:
    axes.set("Inch", InchForward=True, Distance=10.0, Velocity=20.0, Acceleration=200.0, Deceleration=200.0)
    axes.cycle()
    assert (axes.state, axes.outputs("Inch")) == ("discrete_motion", {"Busy"})
    axes.after(2.0)
    assert (axes.position, axes.state, axes.outputs("Inch")) == (10.0, "standstill", set())
    axes.set("Inch", InchForward=False)
    axes.cycle()
    axes.set("Inch", InchBackward=True)
    while axes.position > 6.0:
        axes.cycle()
    axes.set("Inch", InchBackward=False)
    axes.after(1.0)
    # released after 4 u at 20 u/s: 20^2 / (2*200) = 1 u to standstill
    assert axes.position == pytest.approx(5.0, abs=0.05)
    assert axes.outputs("Inch") == set()


def test_a_program_writes_positions(axes: CoupledAxes) -> None:
    """ax3000 EX-AX-21: a cam that the program computes; MC_CamOut ends it."""
    axes.write("xWave", True)
    axes.start("Follow")
    assert axes.state == "synchronized_motion"
    axes.after(1.0)
    wave = axes.number("fWave")
    assert axes.position == pytest.approx(50.0 * math.sin(3.0 * wave), abs=1e-9)
    mean = 50.0 * (math.sin(3.0 * wave) - math.sin(3.0 * (wave - CYCLE))) / CYCLE
    assert axes.velocity == pytest.approx(mean, abs=1e-9)
    axes.start("CamOut")
    assert axes.state == "continuous_motion"
    axes.cycle()
    assert axes.outputs("Follow") == {"bCommandAborted"}


def test_the_velocity_of_written_positions_is_their_increment(axes: CoupledAxes) -> None:
    """motion_semantics EX-26, ax3000 CONFLICT-11: 0.1 u in each cycle of 1 ms are 100 u/s."""
    axes.start("Follow", fSetPosition=0.1)
    for cycle in range(2, 50):
        axes.set("Follow", fSetPosition=0.1 * cycle)
        axes.cycle()
        assert axes.velocity == pytest.approx(100.0, abs=1e-9)
    assert axes.state == "synchronized_motion"
    axes.start("Halt", Deceleration=1000.0)
    axes.cycle()
    assert axes.outputs("Follow") == {"bCommandAborted"}


def test_a_program_writes_velocities(axes: CoupledAxes) -> None:
    axes.start("FollowVelocity", fSetVelocity=20.0)
    assert (axes.velocity, axes.position) == (20.0, pytest.approx(0.02))
    axes.set("FollowVelocity", fSetVelocity=-5.0)
    axes.cycle()
    assert (axes.velocity, axes.position) == (-5.0, pytest.approx(0.015))
    axes.start("FollowBoth", fSetPosition=0.1, fSetVelocity=3.0)
    axes.cycle()
    assert (axes.position, axes.velocity) == (pytest.approx(0.1), 3.0)
    assert axes.outputs("FollowVelocity") == {"bCommandAborted"}
    axes.start(
        "FollowValues",
        dwValueMask=0b11110,
        fSetVelocity=7.0,
        fSetAcceleration=2.0,
        fSetTorque=3.0,
        fSetCurrent=4.0,
    )
    axes.cycle()
    found = [
        axes.number(f"Axis.{name}")
        for name in ("fSetVelocity", "fSetAcceleration", "fSetTorque", "fSetCurrent")
    ]
    assert found == [7.0, 2.0, 3.0, 4.0]


def test_written_positions_go_the_shorter_way_around(axes: CoupledAxes) -> None:
    axes.set("Axis", iMovementType=0, fPositionPeriod=360.0)
    axes.start("Follow", fSetPosition=359.9)
    axes.set("Follow", fSetPosition=0.1)
    axes.cycle()
    assert axes.velocity == pytest.approx(200.0, abs=1e-6)
    assert axes.position == pytest.approx(0.1, abs=1e-9)


def test_a_profile_of_a_rotary_axis_takes_its_slave_along(axes: CoupledAxes) -> None:
    axes.set("Axis", iMovementType=0, fPositionPeriod=360.0)
    _fill(axes, "Velocities", [(1000, 720.0), (1000, 720.0), (1000, 0.0)])
    axes.start("Velocities", ArraySize=3)
    fastest = 0.0
    while "Done" not in axes.outputs("Velocities"):
        axes.cycle()
        fastest = max(fastest, abs(axes.number("Axis.fTravel")))
    assert axes.position == pytest.approx(1440.0 % 360.0, abs=1e-9)
    assert fastest == pytest.approx(720.0 * CYCLE, rel=1e-6)
