"""SM3_CNC: lines that become splines, SMC_SmoothBSpline and SMC_SmoothMerge, against scipy and numpy."""

from __future__ import annotations

import math
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.interpolate import BSpline
from tests.libraries.cnc_chain import Block, gaps, length_of, through, turn
from tests.libraries.cnc_paths import CLW, LIN, LINPOS, MCOMMAND, SPLINE, Geo, Vector, arc, line, position

FLAG = {"dwFlags": 1.0}
B_SPLINE = Block("SMC_SmoothBSpline")
DYNAMICS = {"dVel": 100.0, "dVelEnd": 100.0}


def lines(points: np.ndarray, space: bool = False, **members: float) -> list[Geo]:
    """Lines from point to point: X, Y, Z and the additional axes."""
    found = []
    for first, second in pairwise(points):
        geo = line(
            position(*first[:3]), position(*second[:3]), **DYNAMICS | {"iSourceLine_No": len(found)} | members
        )
        geo.start[3 : len(first)], geo.end[3 : len(first)] = first[3:], second[3:]
        geo.space = space
        found.append(geo)
    return found


coordinate = st.floats(-50, 50).map(lambda value: round(value, 3))


@st.composite
def points(draw: st.DrawFn, least: int, most: int, size: int = 12) -> np.ndarray:
    """Points of a path that never stands still."""
    found = [np.array([draw(coordinate) for _ in range(size)])]
    for _ in range(draw(st.integers(least, most))):
        step = np.array([draw(coordinate) for _ in range(size)])
        step[0] = math.copysign(abs(step[0]) + 0.5, step[0])
        found.append(found[-1] + step)
    return np.array(found)


def b_spline(given: np.ndarray) -> BSpline:
    count = len(given) - 5
    return BSpline(np.concatenate([np.zeros(5), np.arange(count + 1), np.full(5, count)]), given, 5)


@pytest.mark.slow
@settings(max_examples=25, deadline=None)
@given(points(5, 16))
def test_a_b_spline(given: np.ndarray) -> None:
    """n lines become the n - 4 polynomials of the clamped uniform B-spline of fifth degree through scipy."""
    expected = b_spline(given)
    objects = lines(given, space=True, **FLAG)
    result = through(objects, B_SPLINE)
    assert result.error == 0
    found = result.objects
    assert [geo.kind for geo in found] == [SPLINE] * (len(objects) - 4)
    scale = float(np.abs(given).max())
    for n, geo in enumerate(found):
        for u in np.linspace(0, 1, 7):
            np.testing.assert_allclose(geo.curve(u), expected(n + u)[:3], atol=1e-11 * scale)
        np.testing.assert_allclose(geo.start, expected(n), atol=1e-11 * scale)
        np.testing.assert_allclose(geo.end, expected(n + 1), atol=1e-11 * scale)
        assert length_of(geo) == pytest.approx(geo.length(), rel=1e-9)
        # The slopes of A, B, C by the length at both ends
        for u, member in ((0.0, "adSlopeStart"), (1.0, "adSlopeEnd")):
            slope = expected(n + u, 1)
            by_length = slope[3:6] / np.linalg.norm(slope[:3])
            ours = np.array([geo.member(f"{member}[{k}]") for k in range(3)]) / length_of(geo)
            np.testing.assert_allclose(ours, by_length, atol=1e-7 * float(np.abs(by_length).max() + 1e-9))
    np.testing.assert_array_equal(found[0].start, objects[0].start)
    np.testing.assert_array_equal(found[-1].end, objects[-1].end)


@pytest.mark.parametrize("count", [1, 3, 4])
def test_too_few_lines_for_a_b_spline_stay(count: int) -> None:
    objects = lines(np.array([[n, n * n, 0.0] for n in range(count + 1)]), space=True, **FLAG)
    found = through(objects, B_SPLINE).objects
    assert [(geo.kind, *geo.end[:2]) for geo in found] == [(LIN, *geo.end[:2]) for geo in objects]


def test_what_interrupts_a_b_spline() -> None:
    """No flag, 2D mode, a switch point, G0, an arc, an M function: what is between stays as it is."""
    given = np.array([[n, math.sin(n), 0.0] for n in range(22)])
    for change in (
        {"dwFlags": 2.0},
        {"b3D": 0.0},
        {"iHelpID[0]": 3.0, "dHelpPos[0]": 0.5},
        {"iMoveType": float(LINPOS)},
        {"wSmoothAxes": 8.0},
        {"dToolRadius": 1.0},
    ):
        objects = lines(given, space=True, **FLAG)
        changed = objects[10]
        changed.kind = int(change.get("iMoveType", changed.kind))
        changed.space = "b3D" not in change
        changed.members |= {name: value for name, value in change.items() if name not in ("iMoveType", "b3D")}
        found = through(objects, B_SPLINE).objects
        assert [geo.kind for geo in found] == [SPLINE] * 6 + [changed.kind] + [SPLINE] * 6, change
        np.testing.assert_array_equal(found[6].end, changed.end)
        assert gaps(found) < 1e-12
    objects = lines(given, space=True, **FLAG)
    function = Geo(MCOMMAND, objects[9].end, objects[9].end, {"iHelpID[0]": 5.0})
    found = through([*objects[:10], function, *objects[10:20]], B_SPLINE).objects
    assert [geo.kind for geo in found] == [SPLINE] * 6 + [MCOMMAND] + [SPLINE] * 6


def test_marks_and_dynamics_of_a_b_spline() -> None:
    """The slowest line that a polynomial depends on counts; marks stay at both ends."""
    objects = lines(np.array([[n, n % 3, 0.0] for n in range(10)]), space=True, **FLAG)
    objects[0].members["byInternMark"] = 16 | 2
    objects[8].members["byInternMark"] = 8 | 1
    objects[6].members["dVel"] = 20.0
    objects[8].members["dVelEnd"] = 7.0
    found = through(objects, B_SPLINE).objects
    assert [geo.member("byInternMark") for geo in found] == [18, 0, 0, 0, 9]
    assert [geo.member("dVel") for geo in found] == [100, 100, 20, 20, 20]
    assert [geo.member("dVelEnd") for geo in found] == [100, 100, 20, 20, 7]


def distance_from_lines(place: Vector, given: np.ndarray) -> float:
    first, second = given[:-1, :3], given[1:, :3]
    moves = np.linalg.norm(second - first, axis=1) > 0
    first, ways = first[moves], (second - first)[moves]
    shares = np.clip(np.sum((place - first) * ways, axis=1) / np.sum(ways * ways, axis=1), 0, 1)
    return float(np.linalg.norm(first + shares[:, None] * ways - place, axis=1).min())


@st.composite
def cam_paths(draw: st.DrawFn) -> np.ndarray:
    """Points as a CAM system writes them: of a smooth curve, with noise, and with corners between."""
    found = [np.zeros(12)]
    heading, pitch = draw(st.floats(-3, 3)), 0.0
    axis = 0.0
    for _ in range(draw(st.integers(1, 4))):
        heading += draw(st.sampled_from([0.0, 0.3, -1.0, 1.57, 2.5, -2.9]))
        bend = draw(st.floats(-0.15, 0.15))
        rise = draw(st.floats(-0.05, 0.05))
        for _ in range(draw(st.integers(1, 14))):
            length = draw(st.floats(0.2, 3.0))
            heading, pitch = heading + bend, pitch + rise
            step = np.zeros(12)
            step[:3] = length * np.array(
                [
                    math.cos(heading) * math.cos(pitch),
                    math.sin(heading) * math.cos(pitch),
                    math.sin(pitch),
                ]
            )
            axis = draw(st.floats(-0.2, 0.2))
            step[3], step[6] = axis, length
            found.append(found[-1] + step)
    return np.array(found)


@pytest.mark.slow
@settings(max_examples=40, deadline=None)
@given(cam_paths(), st.sampled_from([0.003, 0.02, 0.1, 0.5]), st.booleans())
def test_merged_lines_keep_the_tolerance(given: np.ndarray, tolerance: float, space: bool) -> None:
    """Nowhere further away than the tolerance, each point of the path near, tangential everywhere."""
    if len(given) > 24:
        given = given[:24]
    objects = lines(given, space)
    if not space:
        given = given.copy()
        given[:, 2] = 0.0
    block = Block("SMC_SmoothMerge", f"dTolerance := {tolerance}, piMaxDifference := pi")
    result = through(objects, block, pi={"dA": 1.0})
    assert result.error == 0
    found = result.objects
    assert gaps(found) < 1e-9
    np.testing.assert_array_equal((found[0].start, found[-1].end), (objects[0].start, objects[-1].end))
    samples = np.array([geo.curve(u) for geo in found for u in np.linspace(0, 1, 150)])
    assert max(distance_from_lines(place, given) for place in samples) <= tolerance * (1 + 1e-9)
    for point in given:
        assert distance_from_lines(point[:3], samples) <= 1.01 * tolerance + 1e-3
    for first, second in pairwise(found):
        assert turn(first, second) < 0.01
    for geo in found:
        assert length_of(geo) == pytest.approx(geo.length(), rel=1e-8)


def test_a_circle_of_short_lines_becomes_few_splines() -> None:
    """22 lines of an arc; both ends have the directions of their lines, not of the arc."""
    angles = np.linspace(0, math.pi / 2, 23)
    given = np.array([[50 * math.cos(a), 50 * math.sin(a), 0.0] for a in angles])
    found = through(lines(given), Block("SMC_SmoothMerge", "dTolerance := 0.05")).objects
    assert [geo.kind for geo in found] == [SPLINE] * len(found)
    assert len(found) <= 3
    for geo in found:
        for u in np.linspace(0, 1, 50):
            assert np.linalg.norm(geo.curve(u)[:2]) == pytest.approx(50, abs=0.08)


def test_a_straight_path_of_short_lines_becomes_one_line() -> None:
    found = through(
        lines(np.array([[n, 2 * n, 0.0] for n in range(20)])), Block("SMC_SmoothMerge", "dTolerance := 0.01")
    ).objects
    assert [(geo.kind, *geo.end[:2]) for geo in found] == [(LIN, 19, 38)]
    assert length_of(found[0]) == pytest.approx(19 * math.sqrt(5))


def test_a_corner_is_cut_by_the_tolerance() -> None:
    """Closed form: a parabola whose middle has the distance of the tolerance from the corner."""
    given = np.array([[0.0, 0, 0], [10, 0, 0], [10, 10, 0]])
    found = through(lines(given), Block("SMC_SmoothMerge", "dTolerance := 0.1")).objects
    assert [geo.kind for geo in found] == [LIN, SPLINE, LIN]
    assert float(np.linalg.norm(found[1].curve(0.5) - given[1])) == pytest.approx(0.1)
    cut = 2 * 0.1 / math.sin(math.pi / 4)
    assert found[0].end[:2] == pytest.approx((10 - cut, 0))
    assert found[2].start[:2] == pytest.approx((10, cut))


def test_what_is_not_merged() -> None:
    """Arcs and M functions stay; another velocity or a flag ends a spline; a reversal stays sharp."""
    smooth = np.array([[n, 0.01 * n * n, 0.0] for n in range(9)])
    objects = lines(smooth)
    for geo in objects[4:]:
        geo.members |= {"dVel": 50.0, "dVelEnd": 50.0}
    found = through(objects, Block("SMC_SmoothMerge", "dTolerance := 0.5")).objects
    assert [(geo.kind, geo.member("dVel")) for geo in found] == [(SPLINE, 100), (SPLINE, 50)]
    for geo in objects[:4]:
        geo.members["dwFlags"] = 4.0
    found = through(objects, Block("SMC_SmoothMerge", "dTolerance := 0.5, nFeatureFlag := 3")).objects
    assert [geo.kind for geo in found] == [SPLINE] + [LIN] * 4
    back = lines(np.array([[0.0, 0, 0], [10, 0, 0], [3, 0, 0]]))
    assert [geo.kind for geo in through(back, Block("SMC_SmoothMerge", "dTolerance := 0.1")).objects] == [
        LIN,
        LIN,
    ]
    other = arc((0, 0), 5, 0, -90, dVel=100.0, dVelEnd=100.0)
    other.start[:2], other.end[:2] = (5, 0), (0, 5)
    mixed = [*lines(np.array([[5.0, -3, 0], [5, -1, 0], [5, 0, 0]])), other]
    function = Geo(MCOMMAND, mixed[1].end, mixed[1].end, {"iHelpID[0]": 5.0})
    mixed.insert(2, function)
    found = through(mixed, Block("SMC_SmoothMerge", "dTolerance := 0.1")).objects
    assert [geo.kind for geo in found] == [LIN, MCOMMAND, CLW + 1]


def test_a_smallest_radius() -> None:
    """Lines of an arc of radius 2 do not become one spline where the radius is at least 3."""
    angles = np.linspace(0, math.pi / 2, 9)
    given = np.array([[2 * math.cos(a), 2 * math.sin(a), 0.0] for a in angles])
    for radius, one in ((1.5, True), (3.0, False)):
        inputs = f"dTolerance := 0.05, dMinCurvatureRadius := {radius}"
        found = through(lines(given), Block("SMC_SmoothMerge", inputs)).objects
        assert (len(found) == 1) == one


def test_additional_axes_limit_what_is_merged() -> None:
    """An axis that does not go evenly with the path keeps its own limit."""
    given = np.zeros((9, 12))
    given[:, 0] = np.arange(9)
    given[:, 6] = [0, 1, 2, 3, 4, 0, 0, 0, 0]
    block = Block("SMC_SmoothMerge", "dTolerance := 0.01, piMaxDifference := pi")
    for limit, count in ((0.0, 3), (9.0, 1)):
        found = through(lines(given), block, pi={"dA1": limit}).objects
        assert len(found) == count
        assert found[-1].end[6] == 0


@pytest.mark.parametrize("inputs", ["dTolerance := -1", "nFeatureFlag := 33", "piMaxDifference := pi"])
def test_inputs_that_are_none(inputs: str) -> None:
    block = Block("SMC_SmoothMerge", inputs)
    assert through(lines(np.eye(3)), block, cycles=5, pi={"dB": -1.0}).error == 10021


@pytest.mark.parametrize("capacity", [5, 8])
def test_a_b_spline_needs_no_large_buffer(capacity: int) -> None:
    """It keeps the lines that a polynomial depends on itself: any buffer gives the same."""
    objects = lines(np.array([[n, math.sin(n), math.cos(n)] for n in range(24)]), space=True, **FLAG)
    large = through(objects, B_SPLINE)
    small = through(objects, B_SPLINE, capacity=capacity, gives=1, takes=1, cycles=200)
    assert len(large.objects) == 19
    assert small.literals == large.literals


@pytest.mark.parametrize("capacity", [6, 12])
def test_a_small_buffer_merges_less_but_keeps_the_tolerance(capacity: int) -> None:
    """How far SMC_SmoothMerge looks ahead is said by its input; the path stays one path."""
    angles = np.linspace(0, math.pi / 2, 23)
    given = np.array([[50 * math.cos(a), 50 * math.sin(a), 0.0] for a in angles])
    block = Block("SMC_SmoothMerge", "dTolerance := 0.05")
    found = through(lines(given), block, capacity=capacity, gives=1, takes=1, cycles=300).objects
    assert 3 <= len(found) < 22
    assert gaps(found) < 1e-9
    for first, second in pairwise(found):
        assert turn(first, second) < 0.01
    samples = np.array([geo.curve(u) for geo in found for u in np.linspace(0, 1, 60)])
    assert max(distance_from_lines(place, given) for place in samples) <= 0.05
