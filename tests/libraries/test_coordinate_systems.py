"""Coordinate systems of SM3_CNC there and back, taught and probed. Spec CNCR-180 to CNCR-185."""

from __future__ import annotations

import numpy as np
import pytest
from tests.libraries import kinematic_models as models
from tests.libraries.transformations import ROWS, Given, Numbers, Transformations, near


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


def _vector(name: str, *numbers: float) -> Given:
    return {f"{name}.d{c}": number for c, number in zip("XYZ", numbers, strict=True)}


def _read(found: dict[str, Numbers], name: str) -> list[float]:
    return [float(found[f"{name}.d{c}"][0]) for c in "XYZ"]


def _names(*vectors: str) -> list[str]:
    return [f"{vector}.d{c}" for vector in vectors for c in "XYZ"]


def test_the_worked_example(transform: Transformations) -> None:
    """Spec cnc_runtime EX-41."""
    frame = _vector("vX", 0, 1, 0) | _vector("vY", -1, 0, 0) | _vector("vZ", 0, 0, 1)
    frame |= _vector("vTranslation", 100, 50, 10)
    point = {**frame, **_vector("piIn", 120, 80, 35)}
    there = transform("SMC_CoordinateTransformation3D", point, _names("piOut"))
    assert _read(there, "piOut") == [30.0, -20.0, 25.0]
    point = {**frame, **_vector("piIn", 30, -20, 25)}
    back = transform("SMC_InvCoordinateTransformation3D", point, _names("piOut"))
    assert _read(back, "piOut") == [120.0, 80.0, 35.0]
    points = _vector("vOrigin", 1, 1, 0) | _vector("vPointOnX", 3, 1, 0) | _vector("vPointOnY", 2, 3, 0)
    taught = transform("SMC_TeachCoordinateSystem", points, [*_names("vX", "vY", "vZ"), "fQuality"])
    assert [_read(taught, name) for name in ("vX", "vY", "vZ")] == [[1, 0, 0], [0, 1, 0], [0, 0, 1]]
    assert taught["fQuality"][0] == pytest.approx(2 / np.sqrt(5))
    probed = _vector("A1", 13, 24, 5) | _vector("A2", 18, 22, 5) | _vector("A3", 12, 29, 5)
    probed |= _vector("B1", 15, 20, 8) | _vector("B2", 19, 20, 7) | _vector("C1", 10, 25, 9)
    found = transform("SMC_DetermineCuboidBearing", probed, _names("M", "vAB", "vBC", "vCA"))
    assert _read(found, "M") == [10, 20, 5]
    assert [_read(found, name) for name in ("vAB", "vBC", "vCA")] == [[1, 0, 0], [0, 0, 1], [0, 1, 0]]


def test_a_work_piece_that_was_probed(transform: Transformations) -> None:
    """Spec CNCR-185: points of a program lie on the work piece as it was clamped."""
    turn = models.orientation("ZYX", *(np.array([angle]) for angle in (20.0, -10.0, 5.0)))[0, :3, :3]
    corner = np.array([200.0, 100.0, 30.0])
    local = {
        "A1": (5, 5, 0),
        "A2": (60, 5, 0),
        "A3": (5, 40, 0),
        "B1": (5, 0, 9),
        "B2": (70, 0, 4),
        "C1": (0, 8, 6),
    }
    probed: Given = {}
    for name, place in local.items():
        probed |= _vector(name, *(corner + turn @ np.array(place, dtype=float)))
    found = transform("SMC_DetermineCuboidBearing", probed, _names("M", "vAB", "vBC", "vCA"))
    axes = {"vX": "vAB", "vY": "vCA", "vZ": "vBC", "vTranslation": "M"}
    frame: Given = {}
    for pin, output in axes.items():
        frame |= _vector(pin, *_read(found, output))
    point = {**frame, **_vector("piIn", 12, 34, 5)}
    machine = transform("SMC_InvCoordinateTransformation3D", point, _names("piOut"))
    assert _read(machine, "piOut") == pytest.approx(corner + turn @ [12.0, 34.0, 5.0])
