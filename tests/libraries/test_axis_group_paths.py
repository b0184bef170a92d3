"""Arcs, direct moves, rounded corners, products and impossible inputs of axis groups against closed forms."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import Any

import numpy as np
import pytest
from tests.libraries.axis_group import CYCLE, ERRORS, AxisGroup, axis_group

DYNAMICS: dict[str, Any] = {
    "Velocity": 50.0,
    "Acceleration": 500.0,
    "Deceleration": 500.0,
    "Jerk": 0.0,
    "CoordSystem": 0,
}
BORDER, CENTER, RADIUS = 0, 1, 2


@pytest.fixture
def group() -> Iterator[AxisGroup]:
    with axis_group() as one:
        yield one


def _run(group: AxisGroup, block: str) -> np.ndarray:
    rows = []
    while not group.done(block):
        assert not group.flag(f"{block}.Error"), group.error(block)
        group.cycle()
        rows.append([*group.position, *group.velocity])
        assert len(rows) * CYCLE < 60
    return np.array(rows)


@pytest.mark.parametrize(
    ("mode", "aux", "end", "choice", "centre", "angle"),
    [
        (BORDER, (50, 50, 0), (100, 0, 0), 0, (50, 0, 0), math.pi),
        (CENTER, (50, 0, 0), (50, 50, 0), 0, (50, 0, 0), math.pi / 2),
        (CENTER, (50, 0, 0), (50, 50, 0), 1, (50, 0, 0), 3 * math.pi / 2),
        (CENTER, (50, 0, 0), (0, 0, 0), 1, (50, 0, 0), 2 * math.pi),
        (RADIUS, (0, 0, 50), (50, 50, 0), 0, (50, 0, 0), math.pi / 2),
        (RADIUS, (0, 0, 50), (50, 50, 0), 1, (0, 50, 0), math.pi / 2),
    ],
)
def test_arcs(
    group: AxisGroup,
    mode: int,
    aux: tuple[float, ...],
    end: tuple[float, ...],
    choice: int,
    centre: tuple[float, ...],
    angle: float,
) -> None:
    """All points are on the circle; the length is that of radius and angle."""
    group.give("Circular1", CircMode=mode, AuxPoint=aux, EndPoint=end, PathChoice=choice, **DYNAMICS)
    trace = _run(group, "Circular1")
    assert np.abs(np.linalg.norm(trace[:, :3] - centre, axis=1) - 50).max() < 1e-9
    assert trace[-1, :3] == pytest.approx(end, abs=1e-9)
    assert group.number("Group.CommandQueue[0].stPath.fLength") == pytest.approx(50 * angle, rel=1e-12)
    assert len(trace) * CYCLE == pytest.approx(50 * angle / 50 + 0.1, abs=3 * CYCLE)
    assert np.linalg.norm(trace[:, 3:], axis=1).max() == pytest.approx(50, rel=1e-9)


@pytest.mark.parametrize(
    ("mode", "aux", "end"),
    [(BORDER, (50, 0, 0), (100, 0, 0)), (CENTER, (50, 0, 0), (0, 60, 0)), (RADIUS, (0, 0, 20), (100, 0, 0))],
)
def test_arcs_that_are_none(
    group: AxisGroup, mode: int, aux: tuple[float, ...], end: tuple[float, ...]
) -> None:
    """Collinear points, unequal radii, a radius below half the chord."""
    group.start("Circular1", CircMode=mode, AuxPoint=aux, EndPoint=end, **DYNAMICS)
    assert group.error("Circular1") == ERRORS["CIRCLE"]
    assert group.state == "GroupStandby"


def test_direct_moves_are_as_fast_as_the_slowest_axis(group: AxisGroup) -> None:
    """The axis with the longest way by its velocity decides; all are on one line and end together."""
    group.start("Disable")
    for axis, speed in (("X", 10.0), ("Y", 100.0), ("Z", 50.0)):
        group.put(axis, fSWMaxVelocity=speed, fSWMaxAcceleration=1e3, fSWMaxDeceleration=1e3, fSWMaxJerk=0.0)
    group.start("Enable")
    group.give("Direct1", Position=(20, 30, -40), CoordSystem=0)
    trace = _run(group, "Direct1")
    assert len(trace) * CYCLE == pytest.approx(2.0 + 10 / 500, abs=3 * CYCLE)  # Z limits: half of 1000 for X
    assert np.abs(trace[:, 1] - 1.5 * trace[:, 0]).max() < 1e-9
    assert np.abs(trace[:, 2] + 2 * trace[:, 0]).max() < 1e-9
    assert trace[:, 3].max() == pytest.approx(10, rel=1e-9)


@pytest.mark.parametrize(
    ("mode", "parameter", "reach"), [(3, 10.0, 10.0), (4, 1.0, 1 / (0.21875 * math.sqrt(0.5)))]
)
def test_a_rounded_corner(group: AxisGroup, mode: int, parameter: float, reach: float) -> None:
    """Velocities of the axes are continuous, the path leaves both lines at the distance, symmetrically."""
    group.give("Linear1", Position=(100, 0, 0), **DYNAMICS)
    group.give(
        "Linear2",
        Position=(100, 100, 0),
        **DYNAMICS,
        BufferMode=2,
        TransitionMode=mode,
        TransitionParameter=(parameter,),
    )
    trace = _run(group, "Linear2")
    bent = trace[(trace[:, 1] > 1e-9) & (trace[:, 0] < 100 - 1e-9)]
    assert bent[0, 0] == pytest.approx(100 - reach, abs=50 * 2 * CYCLE + 0.6)
    assert bent[0, 0] > 100 - reach
    assert bent[-1, 1] < reach
    apart = np.hypot(100 - bent[:, 0], bent[:, 1]).min()
    assert apart == pytest.approx(reach * 0.21875 * math.sqrt(0.5), abs=0.02)
    jumps = np.abs(np.diff(trace[:, 3:], axis=0)).max()
    sharpest = 5.859375 / (0.78125 * math.sqrt(2)) ** 3 / reach  # curvature in the middle of the curve
    assert jumps < 50**2 * sharpest * CYCLE * 1.001
    assert np.linalg.norm(bent[:, 3:], axis=1) == pytest.approx(np.full(len(bent), 50.0), rel=1e-6)
    assert trace[-1, :3] == pytest.approx((100, 100, 0), abs=1e-12)


def test_a_product_in_the_machine(group: AxisGroup) -> None:
    """PCS_1: turned by 90 degrees about Z and shifted; positions and distances."""
    for member, value in {"X": 10.0, "Y": 20.0, "Z": 30.0, "A": 90.0}.items():
        group.write(f"Frame.CoordTransform.{member}", value)
    group.start("Frame")
    assert group.outputs("Frame") == {"Done"}
    group.give("Linear1", Position=(1, 2, 3), **{**DYNAMICS, "CoordSystem": 3})
    _run(group, "Linear1")
    assert group.position == pytest.approx((8, 21, 33), abs=1e-12)
    group.give("Relative1", Distance=(5, 0, 0), **{**DYNAMICS, "CoordSystem": 3})
    _run(group, "Relative1")
    assert group.position == pytest.approx((8, 26, 33), abs=1e-12)
    group.put("SetValue", Enable=True, CoordSystem=3)
    group.cycle()
    place = [group.number(f"SetValue.Position.a[{index}]") for index in range(3)]
    assert place == pytest.approx((6, 2, 3), abs=1e-12)


ABSURD = [float("nan"), float("inf"), -1.0, 1e300]


@pytest.mark.parametrize("value", [*ABSURD, 0.0])
@pytest.mark.parametrize(
    "pin", ["Velocity", "Acceleration", "Deceleration", "VelFactor", "AccFactor", "JerkFactor"]
)
def test_impossible_values_are_refused(group: AxisGroup, pin: str, value: float) -> None:
    """AG-52, AG-58: an error of the block, and the group stays as it is."""
    group.start("Linear1", Position=(1, 2, 3), **{**DYNAMICS, pin: value})
    assert group.outputs("Linear1") == {"Error"}
    assert group.error("Linear1") == ERRORS["VALUES"]
    assert group.state == "GroupStandby"


@pytest.mark.parametrize(
    ("block", "inputs"),
    [
        *[("Linear1", {"Position": (value, 0, 0)}) for value in (float("nan"), float("inf"), 1e300)],
        *[("Linear1", {"Jerk": value}) for value in ABSURD],
        *[("Linear1", {"CoordSystem": value}) for value in (-1, 5, 99)],
        *[("Linear1", {"BufferMode": value}) for value in (-1, 6, 99)],
        *[("Linear1", {"TransitionMode": value}) for value in (-1, 2, 99)],
        *[("Linear1", {"TransitionMode": 3, "TransitionParameter": (value,)}) for value in (*ABSURD, 0.0)],
        *[("Circular1", {"CircMode": value}) for value in (-1, 3)],
        *[("Circular1", {"PathChoice": value}) for value in (-1, 2)],
    ],
)
def test_impossible_modes_are_refused(group: AxisGroup, block: str, inputs: dict[str, Any]) -> None:
    """AG-52, AG-58."""
    group.start(block, **{**DYNAMICS, **inputs})
    assert group.outputs(block) == {"Error"}
    assert group.error(block) == ERRORS["VALUES"]
    assert group.state == "GroupStandby"


def test_software_limits_of_targets_and_arcs(group: AxisGroup) -> None:
    """AG-52: also where an arc turns beyond a limit."""
    group.put("Y", bSWLimitEnable=True, fSWLimitNegative=-10.0, fSWLimitPositive=40.0)
    group.start("Linear1", Position=(0, 41, 0), **DYNAMICS)
    assert group.error("Linear1") == ERRORS["LIMITS"]
    group.start("Circular1", CircMode=BORDER, AuxPoint=(50, 50, 0), EndPoint=(100, 0, 0), **DYNAMICS)
    assert group.error("Circular1") == ERRORS["LIMITS"]
    assert group.state == "GroupStandby"


def test_inputs_are_latched(group: AxisGroup) -> None:
    """AG-35, AG-36, AG-66: changes while it is busy, and further edges, have no effect."""
    group.start("Linear1", Position=(100, 0, 0), **DYNAMICS)
    group.start("Linear2", Position=(200, 0, 0), **DYNAMICS, BufferMode=1)
    group.put("Linear2", Velocity=5.0, Position=(0, 0, 0))
    group.start("Linear2")
    assert group.number("Group.iCommands") == 2
    assert group.until_done("Linear2") == pytest.approx(2 * 2.1, abs=5 * CYCLE)
    assert group.position == pytest.approx((200, 0, 0), abs=1e-12)


def test_the_override_keeps_the_path(group: AxisGroup) -> None:
    """Half the velocity, none, and all again: the end is exact, the line is kept."""
    group.put("Override", Enable=True)
    group.give("Linear1", Position=(60, 30, 0), **DYNAMICS)
    group.after(0.3)
    group.put("Override", VelFactor=0.5)
    group.after(0.3)
    assert group.path_velocity == pytest.approx(25)
    group.put("Override", VelFactor=0.0)
    group.after(0.3)
    assert group.path_velocity == 0
    assert group.outputs("Linear1") == {"Busy", "Active"}
    group.put("Override", VelFactor=1.0)
    trace = _run(group, "Linear1")
    assert np.abs(trace[:, 0] - 2 * trace[:, 1]).max() < 1e-9
    assert trace[-1, :3] == pytest.approx((60, 30, 0), abs=1e-12)
    for value in (-0.1, 1.1, float("nan")):
        group.put("Override", VelFactor=value)
        group.cycle()
        assert group.error("Override") == ERRORS["OVERRIDE"]
