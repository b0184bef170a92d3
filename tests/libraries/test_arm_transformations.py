"""SCARA and palletizer of SM3_CNC there and back over all they reach, against products of matrices.

Spec CNCR-200 to CNCR-203.
"""

from __future__ import annotations

import numpy as np
import pytest
from tests.libraries import kinematic_models as models
from tests.libraries.transformations import ROWS, Given, Numbers, Transformations, back_from, near, uniform


def _joints(random: np.random.Generator) -> Numbers:
    """Angles all around, some of them within rounding and a little more of 0 and of 180."""
    angles = random.uniform(-180.0, 180.0, ROWS)
    special = random.choice([0.0, 180.0], ROWS) + 10.0 ** random.uniform(-17.0, 0.0, ROWS)
    return np.where(random.random(ROWS) < 0.2, special, angles)


@pytest.mark.parametrize("low", [True, False])
def test_scara_of_two_joints(transform: Transformations, random: np.random.Generator, low: bool) -> None:
    lengths = [random.uniform(0.1, 1.0, ROWS) * 10.0 ** random.uniform(-3, 4, ROWS) for _ in range(2)]
    lengths[1] = np.where(random.random(ROWS) < 0.2, lengths[0], lengths[1])
    upper = models.rotation(2, _joints(random)) @ models.translation(lengths[0], 0.0, 0.0)
    lower = models.rotation(2, _joints(random)) @ models.translation(lengths[1], 0.0, 0.0)
    point = (upper @ lower)[:, :2, 3]
    shared: Given = {"dArmLength1": lengths[0], "dArmLength2": lengths[1]}
    shared |= uniform(random, -180.0, 180.0, "dOffsetA", "dOffsetB")
    pose: Given = {"pi.dX": point[:, 0], "pi.dY": point[:, 1], "bElbowLow": low}
    there = transform("SMC_TRAFO_Scara2", {**pose, **shared}, ["bError", "dA", "dB"])
    assert not np.any(there["bError"])
    alpha, beta = there["dA"] - shared["dOffsetA"], there["dB"] - shared["dOffsetB"]
    within = (alpha > -180.0 - 1e-9) & (alpha < 180.0 + 1e-9)
    assert np.all(within)
    sign = 1.0 if low else -1.0
    assert np.all(sign * np.sin(np.radians(beta)) >= -1e-12)
    elbow = np.stack([lengths[0] * np.cos(np.radians(alpha)), lengths[0] * np.sin(np.radians(alpha))])
    side = (point[:, 0] * elbow[1] - point[:, 1] * elbow[0]) / (lengths[0] * (lengths[0] + lengths[1]))
    assert np.all(sign * side <= 1e-9), "a low elbow is to the right of the line to the tool"
    back = back_from(
        transform,
        "SMC_TRAFOF_Scara2",
        {"DriveA": there["dA"], "DriveB": there["dB"]},
        shared,
        "bError",
        "dx",
        "dy",
    )
    assert not np.any(back["bError"])
    reach = lengths[0] + lengths[1]
    for index, coordinate in enumerate(("dx", "dy")):
        near(back[coordinate], point[:, index], reach)


@pytest.mark.parametrize("low", [True, False])
def test_scara_of_three_joints(transform: Transformations, random: np.random.Generator, low: bool) -> None:
    lengths = (150.0, 120.0, 40.0)
    pose_of = models.scara([_joints(random) for _ in lengths], lengths)
    point = pose_of[:, :2, 3]
    heading = np.degrees(np.arctan2(pose_of[:, 1, 0], pose_of[:, 0, 0]))
    turns = 360.0 * random.integers(-3, 4, ROWS)
    shared: Given = {f"dArmLength{number}": length for number, length in enumerate(lengths, 1)}
    shared |= uniform(random, -180.0, 180.0, "dOffsetA", "dOffsetB", "dOffsetC")
    pose: Given = {
        "pi.dX": point[:, 0],
        "pi.dY": point[:, 1],
        "dDirection": 180.0 - heading + turns,
        "bElbowLow": low,
    }
    there = transform("SMC_TRAFO_Scara3", {**pose, **shared}, ["bError", "dA", "dB", "dC"])
    assert np.count_nonzero(there["bError"]) < ROWS / 1000, "the wrist lies on the border within rounding"
    good = there["bError"] == 0.0
    gamma = there["dC"] - shared["dOffsetC"]
    assert np.all((gamma > -180.0 - 1e-9) & (gamma <= 180.0 + 1e-9))
    drives = {f"Drive{axis}": there[f"d{axis}"] for axis in "ABC"}
    outputs = ("bError", "dx", "dy", "dAlpha", "dBeta", "dGamma", "dpx", "dppx", "dppy")
    back = back_from(transform, "SMC_TRAFOF_Scara3", drives, shared, *outputs)
    for index, coordinate in enumerate(("dx", "dy")):
        near(back[coordinate][good], point[good, index], sum(lengths))
    joints = [back[name] for name in ("dAlpha", "dBeta", "dGamma")]
    end = models.scara(joints, lengths)
    wrist = models.scara(joints[:2], lengths[:2])
    near(back["dx"], end[:, 0, 3], sum(lengths))
    near(back["dppx"], wrist[:, 0, 3] / sum(lengths), 1.0)
    near(back["dppy"], wrist[:, 1, 3] / sum(lengths), 1.0)
    turned = np.degrees(np.arctan2(end[:, 1, 0], end[:, 0, 0]))
    error = (turned - heading + 180.0) % 360.0 - 180.0
    assert np.all(np.abs(error[good]) <= 1e-10)


@pytest.mark.parametrize("backwards", [True, False])
@pytest.mark.parametrize("low", [True, False])
def test_palletizer(
    transform: Transformations, random: np.random.Generator, low: bool, backwards: bool
) -> None:
    a1, d1, l1, l2, a4, d4 = dimensions = (100.0, 400.0, 600.0, 500.0, 80.0, 120.0)
    q0, q1, bend, q3 = (_joints(random) for _ in range(4))
    flange = models.palletizer([q0, q1, bend - 90.0, q3], *dimensions)
    point, direction = flange[:, :3, 3], q0 + q3
    out = a1 + l1 * np.sin(np.radians(q1)) + l2 * np.sin(np.radians(q1 + bend)) + a4
    chosen = (out < -1.0) if backwards else (out > 1.0)
    config: Given = {
        f"config.d{name}": value
        for name, value in zip(("A1", "D1", "L1", "L2", "A4", "D4"), dimensions, strict=True)
    }
    config |= {f"config.adOffset[{axis}]": 7.0 * axis - 10.0 for axis in range(4)}
    pose: Given = {f"pi.d{c}": point[:, i] for i, c in enumerate("XYZ")}
    pose |= {"pi.dC": direction, "bElbowLow": low, "bBackwards": backwards}
    names = ["bError", "dQ0", "dQ1", "dQ2", "dQ3"]
    there = transform("SMC_Trafo_4AxisPalletizer", {**pose, **config}, names)
    assert not np.any(there["bError"][chosen])
    drives = {f"Drive{axis + 1}": there[f"dQ{axis}"] for axis in range(4)}
    outputs = ("dX", "dY", "dZ", "dC", "bElbowLow", "bBackwards", "vK3Pos.dX", "vK3Pos.dZ")
    back = back_from(transform, "SMC_TrafoF_4AxisPalletizer", drives, config, *outputs)
    scale = a1 + d1 + l1 + l2 + a4 + d4
    for index, name in enumerate(("dX", "dY", "dZ")):
        near(back[name][chosen], point[chosen, index], scale)
    near(back["dC"][chosen], direction[chosen], 720.0)
    bent = np.abs(np.sin(np.radians(there["dQ2"] - config["config.adOffset[2]"] + 90.0))) > 1e-9
    assert np.all((back["bElbowLow"] == low)[chosen & bent])
    assert np.all((back["bBackwards"] == backwards)[chosen])
    joints = [there[f"dQ{axis}"] - config[f"config.adOffset[{axis}]"] for axis in range(4)]
    again = models.palletizer(joints, *dimensions)
    near(again[chosen, :3, 3], point[chosen], scale)
    near(back["vK3Pos.dZ"], back["dZ"] + d4, scale)


def test_a_palletizer_keeps_axis_0_where_its_flange_is_on_it(transform: Transformations) -> None:
    sizes = {"A1": 0.0, "D1": 400.0, "L1": 600.0, "L2": 500.0, "A4": 0.0, "D4": 120.0}
    config: Given = {f"config.d{name}": value for name, value in sizes.items()}
    config["config.adOffset[0]"] = 3.0
    pose: Given = {"pi.dX": np.array([300.0, 0.0]), "pi.dY": np.array([300.0, 0.0]), "pi.dZ": 1000.0}
    found = transform("SMC_Trafo_4AxisPalletizer", {**pose, **config}, ["bError", "dQ0"])
    assert not np.any(found["bError"])
    assert found["dQ0"] == pytest.approx([48.0, 48.0])
