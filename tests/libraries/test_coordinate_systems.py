"""Coordinate systems of SM3_CNC there and back, taught and probed. Spec CNCR-180 to CNCR-185."""

from __future__ import annotations

import numpy as np
from tests.libraries import kinematic_models as models
from tests.libraries.transformations import ROWS, Given, Transformations, near


def test_coordinate_systems(transform: Transformations, random: np.random.Generator) -> None:
    """Spec CNCR-180, CNCR-181."""
    turn = models.orientation("ZYX", *random.uniform(-180.0, 180.0, (3, ROWS)))
    origin = random.uniform(-100.0, 100.0, (ROWS, 3))
    frame: Given = {f"v{v}.d{c}": turn[:, i, k] for k, v in enumerate("XYZ") for i, c in enumerate("XYZ")}
    frame |= {f"vTranslation.d{c}": origin[:, i] for i, c in enumerate("XYZ")}
    point = random.uniform(-100.0, 100.0, (ROWS, 3))
    given: Given = {f"piIn.d{c}": point[:, i] for i, c in enumerate("XYZ")}
    kept = ("dA", "dB", "dC", "dA1", "dA6")
    given |= {f"piIn.{name}": float(number) for number, name in enumerate(kept)}
    outputs = [f"piOut.d{c}" for c in "XYZ"]
    there = transform(
        "SMC_CoordinateTransformation3D", {**given, **frame}, outputs + [f"piOut.{name}" for name in kept]
    )
    whole = np.linalg.inv(models.translation(*origin.T) @ turn)
    local = (whole @ np.concatenate([point, np.ones((ROWS, 1))], axis=1)[:, :, None])[:, :3, 0]
    for index, name in enumerate(outputs):
        near(there[name], local[:, index], 300.0)
    assert all(np.all(there[f"piOut.{name}"] == number) for number, name in enumerate(kept))
    moved = {name.replace("Out", "In"): there[name] for name in outputs}
    back = transform("SMC_InvCoordinateTransformation3D", {**moved, **frame}, outputs)
    for index, name in enumerate(outputs):
        near(back[name], point[:, index], 300.0)


def test_taught_coordinate_systems_and_their_angles(
    transform: Transformations, random: np.random.Generator
) -> None:
    """Spec CNCR-182, CNCR-183."""
    roll, pitch, yaw = random.uniform([[-180.0], [-90.0], [-180.0]], [[180.0], [90.0], [180.0]], (3, ROWS))
    pitch = np.where(random.random(ROWS) < 0.1, random.choice([-90.0, 90.0], ROWS), pitch)
    turn = models.orientation("ZYX", yaw, pitch, roll)[:, :3, :3]
    origin = random.uniform(-100.0, 100.0, (ROWS, 3))
    on_x = origin + turn[:, :, 0] * random.uniform(1.0, 100.0, (ROWS, 1))
    askew = np.radians(random.uniform(20.0, 160.0, ROWS))
    direction = turn[:, :, 0] * np.cos(askew)[:, None] + turn[:, :, 1] * np.sin(askew)[:, None]
    on_y = origin + direction * random.uniform(1.0, 100.0, (ROWS, 1))
    points = {"vOrigin": origin, "vPointOnX": on_x, "vPointOnY": on_y}
    given: Given = {
        f"{name}.d{c}": value[:, i] for name, value in points.items() for i, c in enumerate("XYZ")
    }
    columns = [f"v{v}.d{c}" for v in "XYZ" for c in "XYZ"]
    taught = transform("SMC_TeachCoordinateSystem", given, [*columns, "fQuality"])
    for k, v in enumerate("XYZ"):
        for i, c in enumerate("XYZ"):
            assert np.all(np.abs(taught[f"v{v}.d{c}"] - turn[:, i, k]) < 1e-11)
    assert np.all(np.abs(taught["fQuality"] - np.sin(askew)) < 1e-11)
    angles = transform(
        "SMC_UnitVectorToRPY", {name: taught[name] for name in columns}, ["dA", "dB", "dC", "nError"]
    )
    assert np.all(angles["nError"] == 1.0)
    again = models.orientation("ZYX", *(np.degrees(angles[name]) for name in ("dC", "dB", "dA")))
    assert np.all(np.abs(again[:, :3, :3] - turn) < 1e-10)
    assert np.all(np.abs(angles["dB"]) <= np.pi / 2 + 1e-12)


def test_probed_cuboids(transform: Transformations, random: np.random.Generator) -> None:
    """Spec CNCR-184: any cuboid, in any bearing, from points on its faces."""
    turn = models.orientation("ZYX", *random.uniform(-180.0, 180.0, (3, ROWS)))[:, :3, :3]
    corner = random.uniform(-100.0, 100.0, (ROWS, 3))
    along = random.uniform(5.0, 50.0, (6, ROWS, 3))
    along[1] = along[0] + [7.0, 0.0, 0.0]
    along[2] = along[0] + [0.0, 9.0, 0.0]
    along[4] = along[3] + [11.0, 0.0, 3.0]
    face = {"A1": 2, "A2": 2, "A3": 2, "B1": 1, "B2": 1, "C1": 0}
    given: Given = {}
    for index, (name, normal) in enumerate(face.items()):
        along[index][:, normal] = 0.0
        point = corner + (turn @ along[index][:, :, None])[:, :, 0]
        given |= {f"{name}.d{c}": point[:, i] for i, c in enumerate("XYZ")}
    vectors = {"M": corner, "vAB": turn[:, :, 0], "vBC": turn[:, :, 2], "vCA": turn[:, :, 1]}
    outputs = [f"{name}.d{c}" for name in vectors for c in "XYZ"]
    found = transform("SMC_DetermineCuboidBearing", given, [*outputs, "nError"])
    assert np.all(found["nError"] == 0.0)
    for name, expected in vectors.items():
        for i, c in enumerate("XYZ"):
            assert np.all(np.abs(found[f"{name}.d{c}"] - expected[:, i]) < 1e-9)
