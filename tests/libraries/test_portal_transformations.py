"""Portals of SM3_CNC there and back, against models of their own, and their velocities.

Spec CNCR-200, CNCR-201, CNCR-204, CNCR-205.
"""

from __future__ import annotations

import numpy as np
import pytest
from tests.libraries import kinematic_models as models
from tests.libraries.transformations import ROWS, Given, Transformations, back_from, near, uniform

PLANAR = ("Gantry2", "Gantry2Tool1", "Gantry2Tool2", "GantryCutter2", "GantryH2", "GantryT2")


@pytest.mark.parametrize("name", PLANAR)
def test_planar_portals(transform: Transformations, random: np.random.Generator, name: str) -> None:
    pose = uniform(random, -1e3, 1e3, "pi.dX", "pi.dY")
    shared = uniform(random, -1e2, 1e2, "dOffsetX", "dOffsetY")
    if "Tool" in name:
        shared |= uniform(random, -720.0, 720.0, "dAlpha") | uniform(random, -50.0, 50.0, "dToolA")
    if name.endswith("Tool2"):
        shared |= uniform(random, -50.0, 50.0, "dToolB")
    axes: tuple[str, ...] = ("A", "B") if name[-2] in "HT" else ("X", "Y")
    if name == "GantryCutter2":
        pose |= uniform(random, -1.0, 1.0, "v.dX", "v.dY")
        shared |= uniform(random, -360.0, 360.0, "dOffsetR")
        shared["iDirectionR"] = random.choice([-1.0, 1.0], ROWS)
        axes = (*axes, "R")
    there = transform(f"SMC_TRAFO_{name}", {**pose, **shared}, [f"d{axis.lower()}" for axis in axes])
    moved = {f"Drive{axis}": there[f"d{axis.lower()}"] for axis in axes}
    back = back_from(transform, f"SMC_TRAFOF_{name}", moved, shared, "dx", "dy")
    for coordinate in ("X", "Y"):
        near(back[f"d{coordinate.lower()}"], np.asarray(pose[f"pi.d{coordinate}"]), 1e3)
    if name == "GantryCutter2":
        direction = back_from(transform, f"SMC_TRAFOF_{name}", moved, shared, "dr")["dr"]
        assert np.all((direction >= -1e-12) & (direction < 360.0 + 1e-12))
        expected = np.arctan2(pose["v.dY"], pose["v.dX"])
        near(np.cos(np.radians(direction)), np.cos(expected), 1.0)
        near(np.sin(np.radians(direction)), np.sin(expected), 1.0)


@pytest.mark.parametrize("name", ["Gantry3", "Gantry3D", "GantryCutter3"])
def test_portals_in_space(transform: Transformations, random: np.random.Generator, name: str) -> None:
    pose = uniform(random, -1e3, 1e3, "pi.dX", "pi.dY", "pi.dZ")
    offsets = uniform(random, -1e2, 1e2, "dOffsetX", "dOffsetY", "dOffsetZ")
    there = transform(f"SMC_TRAFO_{name.removesuffix('D')}", {**pose, **offsets}, ["dx", "dy", "dz"])
    drives = {f"Drive{axis}": there[f"d{axis.lower()}"] for axis in "XYZ"}
    back = back_from(transform, f"SMC_TRAFOF_{name}", drives, offsets, "dx", "dy", "dz")
    for axis in "XYZ":
        near(back[f"d{axis.lower()}"], np.asarray(pose[f"pi.d{axis}"]), 1e3)


def test_normed_positions_of_a_portal_in_space(transform: Transformations) -> None:
    """Spec CNCR-204."""
    given = {"DriveX.fSetPosition": 5.0, "DriveY.fSetPosition": 10.0, "DriveZ.fSetPosition": 30.0}
    ranges = {"maxX": 20.0, "minY": 5.0, "maxY": 15.0, "minZ": -10.0, "maxZ": 90.0, "dOffsetZ": 15.0}
    found = transform("SMC_TRAFOF_Gantry3D", {**given, **ranges}, ["dnx", "dny", "dz", "dnz"])
    assert [float(found[name][0]) for name in ("dnx", "dny", "dz", "dnz")] == [0.25, 0.5, 15.0, 0.25]


PORTALS: dict[str, list[list[float]]] = {
    "Gantry2": [[1, 0], [0, 1]],
    "GantryCutter2": [[1, 0], [0, 1]],
    "Gantry3": [[1, 0, 0], [0, 1, 0], [0, 0, 1]],
    "GantryCutter3": [[1, 0, 0], [0, 1, 0], [0, 0, 1]],
    "GantryH2": [[0.5, -0.5], [-0.5, -0.5]],
    "GantryT2": [[0.5, 0.5], [-0.5, 0.5]],
}
"""How axes move a portal, by the forward formulas of spec cnc_runtime 10.1 and 10.4."""


@pytest.mark.parametrize("name", PORTALS)
def test_velocities_against_differences(
    transform: Transformations, random: np.random.Generator, name: str
) -> None:
    model = np.array(PORTALS[name])
    coordinates = "XYZ"[: len(model)]
    point = random.uniform(-1e3, 1e3, (ROWS, len(model)))
    tangent = random.normal(size=(ROWS, 3))
    tangent /= np.linalg.norm(tangent, axis=1)[:, None]
    speed = random.uniform(-500.0, 500.0, ROWS)
    given: Given = {f"pi.d{c}": point[:, i] for i, c in enumerate(coordinates)}
    given |= {f"v.d{c}": tangent[:, i] for i, c in enumerate("XYZ")} | {"dVel": speed}
    axes = "ab" if name[-2] in "HT" else coordinates.lower()
    found = transform(f"SMC_TRAFOV_{name}", given, [f"d{a}" for a in axes] + [f"dv{a}" for a in axes])
    way = tangent[:, : len(model)] * (speed / 1000)[:, None]
    ahead, behind = (np.linalg.solve(model, (point + side * way).T) for side in (1, -1))
    for index, axis in enumerate(axes):
        near(found[f"d{axis}"], (ahead[index] + behind[index]) / 2, 3e3)
        assert found[f"dv{axis}"] == pytest.approx((ahead[index] - behind[index]) * 500, abs=1e-6)


def test_no_velocity_at_rest(transform: Transformations) -> None:
    for name in PORTALS:
        names = ["dva", "dvb"] if name[-2] in "HT" else ["dvx", "dvy"]
        found = transform(f"SMC_TRAFOV_{name}", {"pi.dX": 5.0, "dVel": 100.0}, names)
        assert all(found[velocity][0] == 0.0 for velocity in names)


def test_polar(transform: Transformations, random: np.random.Generator) -> None:
    pose = uniform(random, -1e3, 1e3, "pi.dX", "pi.dY")
    offsets = uniform(random, -300.0, 300.0, "dOffsetR", "dOffsetPhi")
    there = transform("SMC_TRAFO_Polar", {**pose, **offsets}, ["dR", "dPhi"])
    drives = {"DriveR": there["dR"], "DrivePhi": there["dPhi"]}
    back = back_from(transform, "SMC_TRAFOF_Polar", drives, offsets, "dx", "dy")
    end = models.chain([(there["dPhi"] - offsets["dOffsetPhi"], 0.0, 0.0, 0.0)]) @ models.translation(
        there["dR"] - offsets["dOffsetR"], 0.0, 0.0
    )
    for index, axis in enumerate("XY"):
        near(back[f"d{axis.lower()}"], np.asarray(pose[f"pi.d{axis}"]), 1e3)
        near(back[f"d{axis.lower()}"], end[:, index, 3], 1e3)


def test_a_polar_system_keeps_its_direction_at_the_origin(transform: Transformations) -> None:
    found = transform(
        "SMC_TRAFO_Polar", {"pi.dX": np.array([0.0, 0.0]), "pi.dY": np.array([5.0, 0.0])}, ["dPhi"]
    )
    assert found["dPhi"].tolist() == [90.0, 90.0]


def test_five_axes(transform: Transformations, random: np.random.Generator) -> None:
    pose = uniform(random, -1e3, 1e3, "pi.dX", "pi.dY", "pi.dZ") | uniform(
        random, -180.0, 180.0, "pi.dB", "pi.dC"
    )
    names = ("dOffsetX", "dOffsetY", "dOffsetZ", "dOffsetIncl", "dOffsetAzi")
    given = uniform(random, -90.0, 90.0, *names)
    given["dTool"] = 80.0
    there = transform("SMC_TRAFO_5Axes", {**pose, **given}, ["dx", "dy", "dz", "dIncl", "dAzi"])
    drives = dict(zip(("DriveX", "DriveY", "DriveZ", "DriveIncl", "DriveAzi"), there.values(), strict=True))
    outputs = ("dx", "dy", "dz", "dInclination", "dAzimuth", "da", "db", "dc")
    back = back_from(transform, "SMC_TRAFOF_5Axes", drives, given, *outputs)
    moved = [axis - given[offset] for axis, offset in zip(there.values(), names, strict=True)]
    tip = models.five_axes(moved, 80.0)
    for index, (output, coordinate) in enumerate(zip(outputs[:3], "XYZ", strict=True)):
        near(back[output], np.asarray(pose[f"pi.d{coordinate}"]), 1e3)
        near(back[output], tip[:, index, 3], 1e3)
    near(back["dInclination"], np.asarray(pose["pi.dB"]), 360.0)
    near(back["dAzimuth"], np.asarray(pose["pi.dC"]), 360.0)
    for index, output in enumerate(("da", "db", "dc")):
        near(back[output], -tip[:, index, 2], 1.0)
