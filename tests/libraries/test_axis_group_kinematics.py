"""Kinematics of axis groups: paths in space against products of matrices, limits, places out of reach."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import numpy as np
import numpy.typing as npt
import pytest
from tests.libraries import kinematic_models as models
from tests.libraries.axis_group import CYCLE, ERRORS
from tests.libraries.group_machine import LIMITS, Machine, machine

Numbers = npt.NDArray[np.float64]
DYNAMICS: dict[str, Any] = {"Velocity": 100.0, "Acceleration": 800.0, "Deceleration": 800.0, "Jerk": 2e4}
MCS, PCS_1 = 1, 3


def _turned(a: float, b: float, c: float) -> Numbers:
    return models.orientation("ZYX", np.array(a), np.array(b), np.array(c))


def _scara(axes: Numbers) -> Numbers:
    pose = models.scara([axes[..., 0], axes[..., 1], axes[..., 2]], [300.0, 250.0, 50.0])
    return models.translation(0.0, 0.0, axes[..., 3]) @ pose


def _palletizer(axes: Numbers) -> Numbers:
    q = [axes[..., index] for index in range(4)]
    return models.palletizer(q, 50.0, 200.0, 400.0, 350.0, 60.0, 80.0)


ARM = {"dA1": 75.0, "dA2": 300.0, "dA3": 40.0, "dD1": 350.0, "dD3": 0.0, "dD4": 320.0, "dD6": 80.0}


def _robot(axes: Numbers) -> Numbers:
    return models.articulated([axes[..., index] for index in range(6)], {**ARM, "bZUp": 1.0})


def _gantry(axes: Numbers) -> Numbers:
    return models.five_axes([axes[..., index] for index in range(5)], 120.0)


def _portal(axes: Numbers) -> Numbers:
    pose = models.translation(axes[..., 0], axes[..., 1], axes[..., 2])
    return pose @ models.rotation(2, axes[..., 3])


def _belt_portal(sign: float) -> Callable[[Numbers], Numbers]:
    def model(axes: Numbers) -> Numbers:
        first, second = axes[..., 0], axes[..., 1]
        return models.translation((first - sign * second) / 2, (second * -sign - first * sign) / 2, 0.0)

    return model


def _t_portal(axes: Numbers) -> Numbers:
    first, second = axes[..., 0], axes[..., 1]
    return models.translation((first + second) / 2, (second - first) / 2, 0.0)


def _polar(axes: Numbers) -> Numbers:
    move = models.translation(0.0, 0.0, axes[..., 2]) @ models.rotation(2, axes[..., 1])
    pose = move @ models.translation(axes[..., 0], 0.0, 0.0)
    return models.translation(pose[..., 0, 3], pose[..., 1, 3], pose[..., 2, 3])


_ROBOT = (
    "TRAFO.Kin_ArticulatedRobot_6DOF := (stArm := (fA1 := 75, fA2 := 300, fA3 := 40, fD1 := 350, "
    "fD4 := 320, fD6 := 80, xZUp := TRUE))"
)
_SCARA = "TRAFO.Kin_Scara3_Z := (dArmLength1 := 300, dArmLength2 := 250, dArmLength3 := 50)"
_SERIAL: dict[str, tuple[int, str, Callable[[Numbers], Numbers], tuple[float, ...], tuple[float, ...]]] = {
    "portal": (4, "TRAFO.Kin_Gantry3C", _portal, (10, 20, 30, 15), (60, -20, 10, 80, 0, 0)),
    "H-portal": (2, "TRAFO.Kin_GantryH2", _belt_portal(1.0), (10, 30), (60, -20, 0, 0, 0, 0)),
    "T-portal": (2, "TRAFO.Kin_GantryT2", _t_portal, (10, 30), (60, -20, 0, 0, 0, 0)),
    "polar": (3, "TRAFO.Kin_Polar_Z", _polar, (100, 30, 5), (-30, 90, 20, 0, 0, 0)),
    "scara": (4, _SCARA, _scara, (20, 60, 10, -30), (150, 330, -60, 20, 0, 0)),
    "palletizer": (
        4,
        "TRAFO.Kin_4AxisPalletizer := (dA1 := 50, dD1 := 200, dL1 := 400, dL2 := 350, dA4 := 60, dD4 := 80)",
        _palletizer,
        (10, 10, -20, 5),
        (350, 250, 300, 60, 0, 0),
    ),
    "five axes": (
        5,
        "TRAFO.Kin_5AxisGantry := (dTool := 120)",
        _gantry,
        (10, 20, 200, 20, 30),
        (60, -40, 60, 75, -35, 0),
    ),
    "robot": (6, _ROBOT, _robot, (10, 5, 10, 20, -40, 15), (330, 200, 420, 20, 100, -30)),
}


def _trace(group: Machine, block: str) -> Numbers:
    rows = [group.position]
    while not group.done(block):
        assert not group.flag(f"{block}.Error"), group.error(block)
        group.cycle()
        rows.append(group.position)
        assert len(rows) * CYCLE < 60
    return np.array(rows)


def _off_line(points: Numbers, start: Numbers, end: Numbers) -> float:
    way = (end - start) / np.linalg.norm(end - start)
    return float(np.linalg.norm((points - start) - np.outer((points - start) @ way, way), axis=1).max())


def _angle(first: Numbers, second: Numbers) -> Numbers:
    """Angles between orientations [deg], exact also where they are small."""
    turn = np.swapaxes(first[..., :3, :3], -1, -2) @ second[..., :3, :3]
    apart = turn - np.eye(3)
    angle: Numbers = np.degrees(2 * np.arcsin(np.clip(np.sqrt((apart**2).sum(axis=(-1, -2)) / 8), 0, 1)))
    return angle


@pytest.mark.parametrize("name", _SERIAL)
def test_a_line_in_space(name: str) -> None:
    """The tool is on the line, its orientation on the great circle, by a model of its own."""
    axes, kinematics, model, start, target = _SERIAL[name]
    with machine(axes, kinematics, start) as group:
        group.give("Linear1", Position=target, CoordSystem=MCS, **DYNAMICS)
        trace = _trace(group, "Linear1")
        read = group.coordinates(MCS)
    poses = model(trace)
    points = poses[:, :3, 3]
    end = np.array(target[:3], dtype=float)
    assert points[-1] == pytest.approx(end, abs=1e-8)
    assert _off_line(points, points[0], end) < 1e-8
    assert read[:3] == pytest.approx(end, abs=1e-8)
    if name in ("portal", "scara", "palletizer", "robot"):
        wanted = _turned(*target[3:])
        assert _angle(poses[-1], wanted) < 1e-5
        whole = float(_angle(poses[0], wanted))
        turned = _angle(poses[0], poses)
        assert turned + _angle(poses, wanted) == pytest.approx(np.full(len(poses), whole), abs=1e-4)
        share = np.linalg.norm(points - points[0], axis=1) / np.linalg.norm(end - points[0])
        assert turned == pytest.approx(share * whole, abs=1e-4)


@pytest.mark.parametrize("name", _SERIAL)
def test_limits_of_axes_are_kept_through_the_kinematics(name: str) -> None:
    """Velocity, acceleration and jerk of each axis by differences of its positions, on a fast path."""
    axes, kinematics, _, start, target = _SERIAL[name]
    fast = {"Velocity": 1e5, "Acceleration": 1e7, "Deceleration": 1e7, "Jerk": 1e9}
    with machine(axes, kinematics, start) as group:
        group.give("Linear1", Position=target, CoordSystem=MCS, **fast)
        trace = _trace(group, "Linear1")
    velocity = np.diff(trace, axis=0) / CYCLE
    acceleration = np.diff(velocity, axis=0) / CYCLE
    jerk = np.diff(acceleration, axis=0) / CYCLE
    assert np.abs(velocity).max() <= LIMITS["fSWMaxVelocity"] * 1.001
    assert np.abs(acceleration).max() <= LIMITS["fSWMaxAcceleration"] * 1.001
    assert np.abs(jerk).max() <= LIMITS["fSWMaxJerk"] * 1.01
    used = max(
        float(np.abs(velocity).max()) / LIMITS["fSWMaxVelocity"],
        float(np.abs(acceleration).max()) / LIMITS["fSWMaxAcceleration"],
        float(np.abs(jerk).max()) / LIMITS["fSWMaxJerk"],
    )
    assert used > 0.3


def test_set_velocities_are_the_derivatives_of_positions() -> None:
    """Of each axis of a robot: what drives are given for their feed-forward."""
    axes, kinematics, _, start, target = _SERIAL["robot"]
    with machine(axes, kinematics, start) as group:
        group.give("Linear1", Position=target, CoordSystem=MCS, **DYNAMICS)
        rows = []
        while not group.done("Linear1"):
            group.cycle()
            rows.append([group.position, group.velocity, group.acceleration])
    position, velocity, acceleration = np.swapaxes(np.array(rows), 0, 1)
    slope = (position[2:] - position[:-2]) / (2 * CYCLE)
    assert np.abs(slope - velocity[1:-1]).max() < 2e4 * CYCLE**2
    slope = (velocity[2:] - velocity[:-2]) / (2 * CYCLE)
    assert np.abs(slope - acceleration[1:-1])[5:-5].max() < 2e4 * CYCLE


@pytest.mark.parametrize("name", ["scara", "robot"])
def test_an_arc_in_space(name: str) -> None:
    """All points of the tool are on the circle around the centre, in its plane."""
    axes, kinematics, model, start, _ = _SERIAL[name]
    with machine(axes, kinematics, start) as group:
        first = np.array(group.coordinates(MCS))
        centre = first[:3] + np.array((0.0, 40.0, 0.0))
        end = (*(centre - np.array((40.0, 0.0, 0.0))), *first[3:])
        group.give(
            "Circular",
            CircMode=1,
            AuxPoint=centre.tolist(),
            EndPoint=end,
            PathChoice=0,
            CoordSystem=MCS,
            **DYNAMICS,
        )
        points = model(_trace(group, "Circular"))[:, :3, 3]
    assert np.linalg.norm(points - centre, axis=1) == pytest.approx(np.full(len(points), 40.0), abs=1e-8)
    assert np.abs(points[:, 2] - centre[2]).max() < 1e-8
    assert points[-1] == pytest.approx(end[:3], abs=1e-8)


@pytest.mark.parametrize(
    ("kinematics", "start", "target", "rods"),
    [
        (
            "TRAFO.Kin_Tripod_Rotary := (dArmLength1 := 200, dArmLength2 := 500, "
            "dArm1Radius := 120, dStewartRadius := 40)",
            (20.0, 20.0, 20.0),
            (60, -80, -480),
            lambda point, q: models.delta_rods(point, q, 200.0, 120.0, 40.0, 0.0, 0.0) - 500.0,
        ),
        (
            "TRAFO.Kin_Tripod_Linear := (dInnerRadius := 50, dOuterRadius := 250, dLength := 600)",
            (700.0, 700.0, 700.0),
            (60, -80, 220),
            lambda point, q: models.tripod_rods(point, q, 50.0, 250.0, 0.0, 0.0) - 600.0,
        ),
    ],
)
def test_parallel_kinematics(
    kinematics: str, start: tuple[float, ...], target: tuple[float, ...], rods: Callable[[Any, Any], Numbers]
) -> None:
    """The points that the way along the line gives leave all rods their lengths."""
    with machine(3, kinematics, start) as group:
        first = np.array(group.coordinates(MCS)[:3])
        group.give("Linear1", Position=(*target, 0, 0, 0), CoordSystem=MCS, **DYNAMICS)
        way = np.array(target, dtype=float) - first
        length = float(np.linalg.norm(way))
        seen = 0
        while not group.done("Linear1"):
            group.cycle()
            along = group.number("Group.fPathPosition")
            if group.state == "GroupMoving":
                point = first + way * along / length
                q = group.position
                wrong = rods([np.array(value) for value in point], [np.array(value) for value in q])
                assert np.abs(wrong).max() < 1e-7
                seen += 1
    assert seen > 100


def test_products_and_relative_ways_in_space() -> None:
    """A static product turned and moved, a distance in it, and a direct move to a place of it."""
    axes, kinematics, model, start, _ = _SERIAL["scara"]
    with machine(axes, kinematics, start) as group:
        group.place("Frame.CoordTransform", X=200.0, Y=250.0, Z=-20.0, A=30.0)
        group.start("Frame")
        frame = models.translation(200.0, 250.0, -20.0) @ models.rotation(2, 30.0)
        for block, inputs, seen in (
            ("Linear1", {"Position": (10, 20, 5, 40, 0, 0), **DYNAMICS}, (10, 20, 5, 40)),
            ("Relative", {"Distance": (30, 0, 0, 10, 0, 0), **DYNAMICS}, (40, 20, 5, 50)),
            ("Direct", {"Position": (-20, 0, 10, 0, 0, 0)}, (-20, 0, 10, 0)),
        ):
            group.give(block, CoordSystem=PCS_1, **inputs)
            _trace(group, block)
            group.put(block, Execute=False)
            group.cycle()
            wanted = frame @ models.translation(*seen[:3]) @ models.rotation(2, seen[3])
            pose = model(group.position)
            assert pose[:3, 3] == pytest.approx(wanted[:3, 3], abs=1e-8)
            assert _angle(pose, wanted) < 1e-5
            assert group.coordinates(PCS_1)[:4] == pytest.approx(seen, abs=1e-7)


def test_orientation_by_its_angles() -> None:
    """OrientationMode Axis: each angle changes evenly with the way."""
    axes, kinematics, model, start, target = _SERIAL["robot"]
    with machine(axes, kinematics, start) as group:
        first = np.array(group.coordinates(MCS))
        group.give("Linear1", Position=target, CoordSystem=MCS, OrientationMode="Axis", **DYNAMICS)
        poses = model(_trace(group, "Linear1"))
    points = poses[:, :3, 3]
    share = np.linalg.norm(points - points[0], axis=1) / np.linalg.norm(points[-1] - points[0])
    change = (np.array(target[3:]) - first[3:] + 180) % 360 - 180
    wanted = np.array([_turned(*(first[3:] + part * change)) for part in share])
    assert _angle(poses, wanted).max() < 1e-4


def test_additional_axes_stay_while_the_kinematics_moves() -> None:
    """AG-02: axes behind those of the kinematics."""
    with machine(5, _SCARA, (20, 60, 10, -30, 77)) as group:
        group.give("Linear1", Position=(150, 330, -60, 20, 0, 0), CoordSystem=MCS, **DYNAMICS)
        trace = _trace(group, "Linear1")
    assert np.abs(trace[:, 4] - 77).max() == 0


def test_turns_of_joints_are_counted_on() -> None:
    """A finite joint that has turned beyond 180 degrees goes on from there, without a turn back."""
    with machine(4, _SCARA, (170, 40, 0, 0)) as group:
        first = np.array(group.coordinates(MCS))
        target = models.translation(0, 0, 0) @ models.rotation(2, 30.0) @ np.array([*first[:3], 1.0])
        group.give("Linear1", Position=(*target[:3], first[3] + 30, 0, 0), CoordSystem=MCS, **DYNAMICS)
        trace = _trace(group, "Linear1")
    assert np.abs(np.diff(trace, axis=0)).max() < 5
    assert trace[-1] == pytest.approx((200, 40, 0, 0), abs=1e-7)


def test_a_rotary_axis_of_a_kinematics_goes_on_through_its_period() -> None:
    """From 350 to 20 degrees of a modulo axis it is 30 degrees forwards."""
    with machine(4, "TRAFO.Kin_Gantry3C") as group:
        group.start("Disable")
        group.put("A3", iMovementType=0, fPositionPeriod=360.0)
        group.start("Enable")
        group.cycle()
        group.give("Direct", Position=(0, 0, 0, 350), CoordSystem=0)
        _trace(group, "Direct")
        group.cycle(2)
        group.give("Linear1", Position=(60, 0, 0, 20, 0, 0), CoordSystem=MCS, **DYNAMICS)
        turned = np.unwrap(_trace(group, "Linear1")[:, 3], period=360.0)
    assert turned[-1] - turned[0] == pytest.approx(30, abs=1e-9)
    assert np.all(np.diff(turned) > -1e-12)


def test_places_out_of_reach_are_refused() -> None:
    """The end, a point in between and a singular start: an error of the block, and nothing moves."""
    axes, kinematics, _, start, _ = _SERIAL["scara"]
    with machine(axes, kinematics, start) as group:
        group.start("Linear1", Position=(700, 0, 0, 0, 0, 0), CoordSystem=MCS, **DYNAMICS)
        assert group.outputs("Linear1") == {"Error"}
        assert group.error("Linear1") == ERRORS["UNREACHABLE"]
        group.start("Direct", Position=(700, 0, 0, 0, 0, 0), CoordSystem=MCS)
        assert group.error("Direct") == ERRORS["UNREACHABLE"]
        assert group.state == "GroupStandby"
    with machine(4, "TRAFO.Kin_Scara3_Z := (dArmLength1 := 300, dArmLength2 := 100)", (0, 90, 0, 0)) as group:
        first = group.coordinates(MCS)
        group.start(
            "Linear1", Position=(-first[0], -first[1], 0, first[3], 0, 0), CoordSystem=MCS, **DYNAMICS
        )
        assert group.error("Linear1") == ERRORS["UNREACHABLE"]
    with machine(6, _ROBOT, (0, 0, 0, 30, 0, 10)) as group:
        group.start("Linear1", Position=(300, 100, 400, 0, 90, 0), CoordSystem=MCS, **DYNAMICS)
        assert group.error("Linear1") == ERRORS["SINGULAR"]
        assert group.state == "GroupStandby"


def test_software_limits_through_the_kinematics() -> None:
    """A joint that passes its limit between start and end of a line that begins and ends within it."""
    with machine(3, "TRAFO.Kin_Polar_Z", (100, -60, 0)) as group:
        group.put("A0", bSWLimitEnable=True, fSWLimitNegative=60.0, fSWLimitPositive=500.0)
        target = (100 * math.cos(math.radians(60)), 100 * math.sin(math.radians(60)), 0, 0, 0, 0)
        group.start("Linear1", Position=target, CoordSystem=MCS, **DYNAMICS)
        assert group.error("Linear1") == ERRORS["LIMITS"]
        group.start("Direct", Position=target, CoordSystem=MCS)
        assert group.error("Direct") == 0


def test_the_kinematics_needs_its_axes_and_standstill() -> None:
    """AG-02: fewer axes than it has, and a group that moves."""
    with machine(2, "TRAFO.Kin_GantryH2") as group:
        group.give("Linear1", Position=(500, 0, 0, 0, 0, 0), CoordSystem=MCS, **DYNAMICS)
        group.cycle(50)
        group.start("SetKin")
        assert group.error("SetKin") == ERRORS["WRONG_STATE"]
        group.until_done("Linear1")
    with pytest.raises(AssertionError, match=str(ERRORS["NUMBER_OF_AXES"])), machine(2, "TRAFO.Kin_Gantry3"):
        pass


def test_corners_in_space_are_rounded() -> None:
    """TMCornerDistance between two lines of a robot: the tool leaves them at the distance, without a stop."""
    axes, kinematics, model, start, _ = _SERIAL["robot"]
    with machine(axes, kinematics, start) as group:
        first = np.array(group.coordinates(MCS))
        corner = first + np.array((0, 60, 0, 0, 0, 0))
        end = first + np.array((0, 60, 50, 10, 0, 0))
        group.give("Linear1", Position=corner.tolist(), CoordSystem=MCS, **DYNAMICS)
        group.give(
            "Linear2",
            Position=end.tolist(),
            CoordSystem=MCS,
            **DYNAMICS,
            BufferMode=2,
            TransitionMode=3,
            TransitionParameter=(15.0,),
        )
        points = model(_trace(group, "Linear2"))[:, :3, 3]
    apart = np.linalg.norm(points - corner[:3], axis=1)
    assert apart.min() == pytest.approx(15 * 0.21875 * math.sqrt(0.5), abs=0.05)
    speed = np.linalg.norm(np.diff(points, axis=0), axis=1) / CYCLE
    bent = speed[(apart[:-1] < 14) & (apart[1:] < 14)]
    assert bent.min() > 20
    acceleration = np.diff(points, n=2, axis=0) / CYCLE**2
    sharpest = 5.859375 / (0.78125 * math.sqrt(2)) ** 3 / 15  # curvature in the middle of the curve
    assert np.linalg.norm(acceleration, axis=1).max() < 100**2 * sharpest * 1.02
    assert points[-1] == pytest.approx(end[:3], abs=1e-8)
