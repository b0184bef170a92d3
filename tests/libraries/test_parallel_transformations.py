"""Bipod and tripods of SM3_CNC there and back over what they reach, against the lengths of their rods.

Spec CNCR-200 to CNCR-203.
"""

from __future__ import annotations

import numpy as np
import pytest
from tests.libraries import kinematic_models as models
from tests.libraries.transformations import ROWS, Given, Numbers, Transformations, back_from, near, uniform


def test_bipod(transform: Transformations, random: np.random.Generator) -> None:
    """Where both rods are nearly in line the point is not determined by the motors; all others come back."""
    arm, rod, distance = 150.0, 250.0, 100.0
    shared: Given = {"dArmLength1": arm, "dArmLength2": rod, "dDistance": distance}
    shared |= uniform(random, -180.0, 180.0, "dOffsetA", "dOffsetB")
    x, y = random.uniform(-400.0, 400.0, ROWS), random.uniform(-400.0, 0.0, ROWS)
    there = transform("SMC_TRAFO_Bipod_Arm", {"pi.dX": x, "pi.dY": y, **shared}, ["bError", "dA", "dB"])
    angles = [there[f"d{axis}"] - shared[f"dOffset{axis}"] for axis in "AB"]
    far = [np.hypot(side * x - distance / 2, y) for side in (-1.0, 1.0)]
    reached = np.all([(r <= arm + rod) & (r >= rod - arm) for r in far], axis=0)
    assert np.all((there["bError"] == 0.0) == reached)
    for length in models.bipod_rods([x, y], angles, arm, distance):
        near(length[reached], rod, arm + rod)
    for side, angle in zip((-1.0, 1.0), angles, strict=True):
        line = np.degrees(np.arctan2(y, side * x - distance / 2))
        other = -2.0 * line - angle
        assert np.all((np.cos(np.radians(angle)) >= np.cos(np.radians(other)) - 1e-9)[reached])
    elbows = [
        np.stack([s * (distance / 2 + arm * np.cos(np.radians(a))), -arm * np.sin(np.radians(a))])
        for s, a in zip((-1.0, 1.0), angles, strict=True)
    ]
    across = elbows[1] - elbows[0]
    below = (across[0] * (y - elbows[0][1]) - across[1] * (x - elbows[0][0])) / np.hypot(*across) / rod
    regular = reached & (below * np.sign(across[0]) < -0.05)
    assert np.count_nonzero(regular) > 0.7 * np.count_nonzero(reached)
    back = back_from(
        transform,
        "SMC_TRAFOF_Bipod_Arm",
        {"DriveA": there["dA"], "DriveB": there["dB"]},
        shared,
        "bError",
        "dx",
        "dy",
    )
    assert not np.any(back["bError"][regular])
    near(back["dx"][regular], x[regular], arm + rod)
    near(back["dy"][regular], y[regular], arm + rod)


def _lower(point: Numbers, centres: Numbers) -> Numbers:
    """How far a point is below the plane of three centres, along the normal that points upwards."""
    normal = np.cross(centres[1] - centres[0], centres[2] - centres[0])
    normal /= np.linalg.norm(normal, axis=-1)[:, None]
    normal *= np.sign(normal[:, 2:])
    return np.asarray(np.sum((centres[0] - point) * normal, axis=-1))


def test_tripod_with_linear_drives(transform: Transformations, random: np.random.Generator) -> None:
    inner, outer, rod, pair = 50.0, 200.0, 400.0, 30.0
    shared: Given = {"dInnerRadius": inner, "dOuterRadius": outer, "dLength": rod, "dDistance": pair}
    shared |= {"dRotationOffset": 17.0, "dOffsetA": 10.0, "dOffsetB": -20.0, "dOffsetC": 30.0}
    point = random.uniform([-400.0, -400.0, -600.0], [400.0, 400.0, 0.0], (ROWS, 3))
    pose: Given = {f"pi.d{c}": point[:, i] for i, c in enumerate("XYZ")}
    there = transform("SMC_TRAFO_Tripod", {**pose, **shared}, ["bError", "dA", "dB", "dC"])
    good = there["bError"] == 0.0
    assert 0.1 * ROWS < np.count_nonzero(good) < 0.9 * ROWS
    heights = [there[f"d{axis}"] - shared[f"dOffset{axis}"] for axis in "ABC"]
    lengths = models.tripod_rods(list(point.T), heights, inner, outer, 17.0, pair)
    near(lengths[good], rod, rod)
    assert np.all(np.array(heights)[:, good] >= point[good, 2])
    turned = np.radians(17.0 + 120.0 * np.arange(3))
    flat = [np.hypot(*(point[:, :2] - (outer - inner) * np.array([np.cos(t), np.sin(t)])).T) for t in turned]
    assert np.all(good == np.all(np.array(flat) <= rod, axis=0))
    centres = np.stack(
        [
            np.stack(
                [np.full(ROWS, (outer - inner) * np.cos(t)), np.full(ROWS, (outer - inner) * np.sin(t)), h],
                axis=-1,
            )
            for t, h in zip(turned, heights, strict=True)
        ]
    )
    regular = good & (_lower(point, centres) > 0.02 * rod)
    assert np.count_nonzero(regular) > 0.9 * np.count_nonzero(good)
    drives = {f"Drive{axis}": there[f"d{axis}"] for axis in "ABC"}
    ends = [f"adn{c}{ring}[{rod_of}]" for c in "xy" for ring in "io" for rod_of in range(6)]
    back = back_from(transform, "SMC_TRAFOF_Tripod", drives, shared, "bError", "dx", "dy", "dz", *ends)
    assert not np.any(back["bError"][regular])
    for index, name in enumerate(("dx", "dy", "dz")):
        near(back[name][regular], point[regular, index], rod)
    for number in range(6):
        base = models.rotation(2, 17.0 + 120.0 * (number // 2))
        side = pair / 2 * (1.0 if number % 2 == 0 else -1.0)
        fixed = (base @ models.translation(outer, side, 0.0))[:2, 3] / outer
        assert back[f"adnxo[{number}]"] == pytest.approx(fixed[0])
        assert back[f"adnyo[{number}]"] == pytest.approx(fixed[1])
        moving = (base @ models.translation(inner, side, 0.0))[:2, 3]
        near(back[f"adnxi[{number}]"][regular], (point[regular, 0] + moving[0]) / outer, 4.0)
        near(back[f"adnyi[{number}]"][regular], (point[regular, 1] + moving[1]) / outer, 4.0)


def test_delta_robot(transform: Transformations, random: np.random.Generator) -> None:
    arm, rod, motors, platform, pair = 150.0, 350.0, 120.0, 40.0, 30.0
    shared: Given = {
        "dArmLength1": arm,
        "dArmLength2": rod,
        "dArm1Radius": motors,
        "dStewartRadius": platform,
    }
    shared |= {
        "dDistance": pair,
        "dRotationOffset": -33.0,
        "dOffsetA": 10.0,
        "dOffsetB": -20.0,
        "dOffsetC": 30.0,
    }
    point = random.uniform([-300.0, -300.0, -500.0], [300.0, 300.0, -50.0], (ROWS, 3))
    pose: Given = {f"pi.d{c}": point[:, i] for i, c in enumerate("XYZ")}
    there = transform("SMC_TRAFO_Tripod_Arm", {**pose, **shared}, ["bError", "dA", "dB", "dC"])
    good = there["bError"] == 0.0
    assert 0.1 * ROWS < np.count_nonzero(good) < 0.9 * ROWS
    angles = [there[f"d{axis}"] - shared[f"dOffset{axis}"] for axis in "ABC"]
    lengths = models.delta_rods(list(point.T), angles, arm, motors, platform, -33.0, pair)
    near(lengths[good], rod, arm + rod)
    centres = []
    tilts = []
    for axis, angle in enumerate(angles):
        base = models.rotation(2, -33.0 + 120.0 * axis)
        local = np.linalg.inv(base)[:3, :3] @ point.T
        line = np.degrees(np.arctan2(local[2], local[0] + platform - motors))
        assert np.all((np.cos(np.radians(angle)) >= np.cos(np.radians(-2.0 * line - angle)) - 1e-9)[good])
        elbow = base @ models.translation(motors - platform, 0.0, 0.0) @ models.rotation(1, angle)
        centres.append((elbow @ models.translation(arm, 0.0, 0.0))[:, :3, 3])
        tilts.append(np.degrees(np.arcsin(np.clip(np.abs(local[1]) / rod, 0.0, 1.0))))
    regular = good & (_lower(point, np.stack(centres)) > 0.05 * rod)
    assert np.count_nonzero(regular) > 0.8 * np.count_nonzero(good)
    drives = {f"Drive{axis}": there[f"d{axis}"] for axis in "ABC"}
    back = back_from(transform, "SMC_TRAFOF_Tripod_Arm", drives, shared, "bError", "dx", "dy", "dz")
    assert not np.any(back["bError"][regular])
    for index, name in enumerate(("dx", "dy", "dz")):
        near(back[name][regular], point[regular, index], arm + rod)
    joint = transform("SMC_TRAFO_Tripod_Arm", {**pose, **shared, "dMaxAngleBallJoint": 20.0}, ["bError"])
    assert np.all((joint["bError"] == 0.0) == (good & (np.max(tilts, axis=0) <= 20.0)))


def test_delta_robots_of_any_dimensions(transform: Transformations, random: np.random.Generator) -> None:
    """Each row is a robot of its own; where its three elbows are nearly in line no point is determined."""
    arm = 10.0 ** random.uniform(-1.0, 2.0, ROWS)
    rod = arm * random.uniform(1.05, 5.0, ROWS)
    motors = arm * random.uniform(0.0, 3.0, ROWS)
    platform = motors * random.uniform(0.0, 1.2, ROWS)
    turned = random.uniform(-360.0, 360.0, ROWS)
    reach = arm + rod
    point = (reach * random.uniform([[-0.4], [-0.4], [-1.0]], [[0.4], [0.4], [-0.1]], (3, ROWS))).T
    shared: Given = {
        "dArmLength1": arm,
        "dArmLength2": rod,
        "dArm1Radius": motors,
        "dStewartRadius": platform,
    }
    shared["dRotationOffset"] = turned
    pose: Given = {f"pi.d{c}": point[:, i] for i, c in enumerate("XYZ")}
    there = transform("SMC_TRAFO_Tripod_Arm", {**pose, **shared}, ["bError", "dA", "dB", "dC"])
    good = there["bError"] == 0.0
    angles = [there[f"d{axis}"] for axis in "ABC"]
    lengths = models.delta_rods(list(point.T), angles, arm, motors, platform, turned, 0.0)
    near(lengths[good, :, 0], rod[good, None], reach[good, None])
    elbows = []
    for axis, angle in enumerate(angles):
        base = models.rotation(2, turned + 120.0 * axis) @ models.translation(motors - platform, 0.0, 0.0)
        elbows.append((base @ models.rotation(1, angle) @ models.translation(arm, 0.0, 0.0))[:, :3, 3])
    area = np.linalg.norm(np.cross(elbows[1] - elbows[0], elbows[2] - elbows[0]), axis=1) / reach**2
    regular = good & (area > 0.02) & (_lower(point, np.stack(elbows)) > 0.02 * rod)
    assert np.count_nonzero(regular) > 0.3 * ROWS
    drives = {f"Drive{axis}": there[f"d{axis}"] for axis in "ABC"}
    back = back_from(transform, "SMC_TRAFOF_Tripod_Arm", drives, shared, "bError", "dx", "dy", "dz")
    assert not np.any(back["bError"][regular])
    for index, name in enumerate(("dx", "dy", "dz")):
        near(back[name][regular], point[regular, index], reach[regular])
