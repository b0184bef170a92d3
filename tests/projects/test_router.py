"""The router cuts a plate by its CNC program: tools, spindle, contour, holes and a smoothed wave."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise

import numpy as np
import pytest
from tests.projects.example_machines import machine, number, run

CYCLE = 0.002
DEPTH = -3.0
LEFT, RIGHT, BOTTOM, TOP, ROUND = 100.0, 300.0, 80.0, 200.0, 15.0
"""The plate that is left, with the radius of its corners [mm]."""
MILL = 3.0
"""Radius of the first tool [mm]."""
HOLES = [(133.0 + 33.0 * n, 180.0) for n in range(5)]
WAVE = [(120.0 + 20.0 * n, 110.0 if n % 2 == 0 else 150.0) for n in range(9)]
DISTANCE = 8.0
"""Of the smoothed pieces from the corners of the wave [mm]."""


@dataclass(frozen=True)
class Run:
    """A plate, cycle by cycle."""

    places: np.ndarray
    """X, Y and Z [mm]."""
    lines: np.ndarray
    """Block numbers of the program."""
    tools: np.ndarray
    speeds: np.ndarray
    """Of the spindle [rpm]."""
    suction: np.ndarray


@pytest.fixture(scope="module")
def plate() -> Run:
    rows = []
    with machine("router") as router:
        while router.literal("GVL_Router.eState") != "Cut":
            run(router, CYCLE)
        while router.literal("GVL_Router.eState") == "Cut":
            run(router, CYCLE)
            names = (
                "X.fSetPosition", "Y.fSetPosition", "Z.fSetPosition", "PLC_PRG.fbIpo.iActObjectSourceNo",
                "GVL_Router.iTool", "GVL_Router.lrSpeed", "GVL_Router.xSuction",
            )  # fmt: skip
            rows.append([float(router.read(name) or 0) for name in names])
            assert len(rows) < 30_000
        assert router.literal("GVL_Router.eState") == "Unload"
        assert [number(router, f"{axis}.fSetPosition") for axis in "XYZ"] == [0.0, 0.0, 40.0]
    table = np.array(rows)
    return Run(table[:, :3], table[:, 3], table[:, 4], table[:, 5], table[:, 6])


def from_the_plate(places: np.ndarray) -> np.ndarray:
    """Distances of points from a rectangle with round corners, below 0 inside."""
    middle = np.array([(LEFT + RIGHT) / 2, (BOTTOM + TOP) / 2])
    half = np.array([(RIGHT - LEFT) / 2, (TOP - BOTTOM) / 2]) - ROUND
    out = np.abs(places[:, :2] - middle) - half
    outside = np.linalg.norm(np.maximum(out, 0.0), axis=1)
    return outside + np.minimum(out.max(axis=1), 0.0) - ROUND


def test_the_mill_keeps_its_radius_from_the_plate(plate: Run) -> None:
    """The path of the first tool is the outline, 3 mm outside of it."""
    deep = (plate.places[:, 2] < -1e-9) & (plate.tools == 1)
    assert from_the_plate(plate.places[deep]).min() >= MILL - 1e-6
    outline = (plate.lines >= 90) & (plate.lines <= 170) & (plate.tools == 1)
    assert from_the_plate(plate.places[outline]) == pytest.approx(MILL, abs=1e-6)
    assert plate.places[outline, 2] == pytest.approx(DEPTH, abs=1e-9)
    corners = plate.places[outline, :2]
    assert corners.min(axis=0) == pytest.approx([LEFT - MILL, BOTTOM - MILL], abs=1e-6)
    assert corners.max(axis=0) == pytest.approx([RIGHT + MILL, TOP + MILL], abs=1e-6)


def test_the_drill_makes_five_holes(plate: Run) -> None:
    drilled = plate.places[(plate.tools == 2) & (plate.places[:, 2] <= DEPTH + 1e-9)]
    found = sorted({(round(x, 6), round(y, 6)) for x, y, _ in drilled})
    assert found == HOLES


def test_the_wave_is_smoothed_at_its_corners(plate: Run) -> None:
    """Lines of the wave, but for 8 mm beside each corner; there inside of the corner."""
    cut = plate.places[(plate.places[:, 2] < -0.4) & (plate.lines >= 380) & (plate.lines <= 450)]
    distances = []
    for start, end in pairwise(WAVE):
        way = np.subtract(end, start)
        along = np.clip(((cut[:, :2] - start) @ way) / (way @ way), 0.0, 1.0)
        distances.append(np.linalg.norm(cut[:, :2] - start - along[:, None] * way, axis=1))
    off = np.min(distances, axis=0)
    corner = np.min([np.linalg.norm(cut[:, :2] - place, axis=1) for place in WAVE[1:-1]], axis=0)
    assert off[corner > DISTANCE + 0.5] == pytest.approx(0.0, abs=1e-6)
    assert 0.5 < off.max() < DISTANCE
    assert corner.min() > 1.0


def test_no_tool_cuts_without_its_spindle(plate: Run) -> None:
    wanted = np.where(plate.tools == 1, 18_000.0, 12_000.0)
    cutting = plate.places[:, 2] < 5.0 - 1e-9
    assert np.abs(plate.speeds[cutting] / wanted[cutting] - 1.0).max() <= 0.01
    changed = np.flatnonzero(np.diff(plate.tools))
    assert plate.tools[np.append(changed, -1)].tolist() == [0, 1, 0, 2]
    assert plate.speeds[changed].tolist() == [0.0, 0.0, 0.0]
    assert plate.places[changed, 2].tolist() == [40.0, 40.0, 40.0]


def test_the_suction_is_on_around_the_outline(plate: Run) -> None:
    """Switch points H1 L1 and H-1 L1: one millimetre behind the starts of their lines."""
    on = np.flatnonzero(plate.suction)
    assert np.all(np.diff(on) == 1)
    assert plate.lines[on[0]] == 80
    assert plate.lines[on[-1] + 1] == 190


def test_the_axes_keep_to_their_limits(plate: Run) -> None:
    velocity = np.diff(plate.places, axis=0) / CYCLE
    acceleration = np.diff(velocity, axis=0) / CYCLE
    assert np.abs(velocity).max() <= 400.0
    assert np.abs(acceleration).max() <= 3000.0


def test_feed_hold_and_override() -> None:
    with machine("router", 8.0) as router:
        router.write("GVL_Router.xRun", False)
        run(router, 1.0)
        place = number(router, "Y.fSetPosition")
        run(router, 1.0)
        assert number(router, "Y.fSetPosition") == place
        router.write("GVL_Router.lrOverride", 0.5)
        router.write("GVL_Router.xRun", True)
        run(router, 2.0)
        assert number(router, "PLC_PRG.fbIpo.dVel") == pytest.approx(30.0)


def test_a_tool_that_is_not_there_is_a_fault() -> None:
    with machine("router") as router:
        run(router, 2.1)
        assert router.literal("GVL_Router.eChange") == "Approach"
        router.write("GVL_Router.eChange", 0)
        router.write("GVL_Router.lrSpeed", 100.0)
        run(router, 0.01)
        assert router.literal("GVL_Router.eState") == "Fault"
        router.write("GVL_Router.lrSpeed", 0.0)
        router.write("GVL_Router.xReset", True)
        run(router, 0.1)
        router.write("GVL_Router.xReset", False)
        run(router, 3.0)
        assert router.literal("GVL_Router.eState") == "Cut"
