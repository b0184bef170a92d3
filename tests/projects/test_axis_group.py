"""The project of the paper's table 2: three lines of an axis group, blended at the corners."""

from __future__ import annotations

import pytest
from tests.projects.axis_group_curve import PICTURE, Motion, Reference, picture, recorded
from tests.projects.example_machines import machine, number, run

CYCLE = 0.004
TOLERANCE = 3 * CYCLE + 0.02


def test_the_times_and_velocities_of_the_paper() -> None:
    """EX-AG-01, AG-05: 40 mm/s at A, 70 mm/s at B, at rest in C after 191.2958 s."""
    with machine("axis_group") as group:
        speeds = {}
        for place, start in (("A", 59.0), ("B", 149.4), ("C", 191.2)):
            run(group, start - number(group, "GVL_Group.lrTime"))
            block = f"PLC_PRG.Block{'ABC'.index(place) + 1}.Done"
            while group.read(block) is False:
                run(group, CYCLE)
                assert number(group, "GVL_Group.lrTime") < 192
            speeds[place] = number(group, "Machine.fPathVelocity")
        assert speeds == pytest.approx({"A": 40, "B": 70, "C": 0}, abs=0.1)
        assert number(group, "GVL_Group.lrAtA") == pytest.approx(59.1016, abs=TOLERANCE)
        assert number(group, "GVL_Group.lrAtB") == pytest.approx(149.5733, abs=TOLERANCE)
        assert number(group, "GVL_Group.lrTime") == pytest.approx(191.2958, abs=TOLERANCE)
        end = [number(group, f"{axis}.fSetPosition") for axis in "XYZ"]
        assert end == pytest.approx([4500, 4200, 4800], abs=1e-9)


@pytest.fixture(scope="module")
def trace() -> list[Motion]:
    return recorded()


def test_the_recorded_trace_is_the_curve_of_the_paper(trace: list[Motion]) -> None:
    """Every tenth of a second: the velocity along the path and the places of all axes."""
    paper = Reference()
    assert paper.ends[1:] == pytest.approx([59.10165, 149.57332, 191.29582], abs=1e-5)
    assert len(trace) > 1900
    for motion in trace:
        expected = paper.at(motion.time)
        assert motion.velocity == pytest.approx(expected.velocity, abs=1e-6)
        assert motion.places == pytest.approx(expected.places, abs=1e-6)


def test_the_picture_of_the_manual_is_that_of_the_run(trace: list[Motion]) -> None:
    """`make generate` draws it."""
    assert PICTURE.read_text(encoding="utf-8") == picture(trace)
