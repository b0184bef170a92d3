"""SM3_CNC: what holds behind every preprocessing block, for any path and buffers of any size."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from tests.libraries.cnc_chain import LARGE, Block, Result, gaps, length_of, through, turn
from tests.libraries.cnc_paths import CCLW, CLW, LIN, LINPOS, MCOMMAND, SPLINE, Geo, line, path, position

SETTINGS = settings(max_examples=12, deadline=None)
BLOCKS = {
    "SMC_TranslateQueue3D": "vec := vec",
    "SMC_RotateQueue2D": "dPhi := 30",
    "SMC_ScaleQueue3D": "dScaleFactor := 2.5",
    "SMC_ToolCorr": "",
    "SMC_ToolRadiusCorr": "",
    "SMC_AvoidLoop": "",
    "SMC_SmoothPath": "",
    "SMC_RoundPath": "",
    "SMC_LimitCircularVelocity": "dMaxAcc := 100, dMaxAccJump := 50",
    "SMC_ExtendedVelocityChecks": "",
    "SMC_LimitAddAxisDynamics": "wAddAxis := 16#7C4, dMaxVel := 10",
    "SMC_ObjectSplitter": "dMaxLength := 13",
    "SMC_ReduceVelEndAtCorner": "dAngle := 5, dMaxVelJump := 10",
    "SMC_ToolLengthCorr": "",
    "SMC_SmoothMerge": "dTolerance := 0.05",
    "SMC_SmoothBSpline": "",
    "SMC_SmoothAddAxes": "",
    "SMC_RecomputeABCSlopes": "",
}
CHANGES_NOTHING = (
    {
        "SMC_TranslateQueue3D": "vec := vec",
        "SMC_RotateQueue2D": "",
        "SMC_ScaleQueue3D": "",
        "SMC_ObjectSplitter": "",
        "SMC_SmoothMerge": "",
    }
    | dict.fromkeys(("SMC_ToolCorr", "SMC_AvoidLoop", "SMC_SmoothPath", "SMC_RoundPath"), "")
    | dict.fromkeys(("SMC_ToolLengthCorr", "SMC_SmoothBSpline", "SMC_SmoothAddAxes"), "")
)

length = st.floats(8, 40).map(lambda value: round(value, 2))
corner = st.floats(-150, 150).map(lambda value: round(value, 1))
swept = st.floats(20, 170).map(lambda value: round(value, 1)) | st.floats(-170, -20).map(
    lambda value: round(value, 1)
)
pieces = st.one_of(
    st.tuples(corner, length),
    st.tuples(corner, length),
    st.tuples(corner, length, swept),
    st.tuples(corner, length.map(lambda a: a + 20), length, swept),
)
MARKS = 2 | 16 | 32 | 128


@st.composite
def paths(
    draw: st.DrawFn, kinds: st.SearchStrategy[tuple[float, ...]] = pieces, marks: int = MARKS
) -> list[Geo]:
    """Three to seven objects with additional axes and switch points, and M functions between them."""
    objects = path(draw(st.lists(kinds, min_size=3, max_size=7)), dVel=100.0, dVelEnd=100.0, dToolRadius=1.5)
    objects[0].members["byInternMark"] = marks
    found: list[Geo] = []
    axes = np.zeros(10)
    for n, geo in enumerate(objects):
        geo.members |= {"iSourceLine_No": 10.0 * n, "dHelpPos[0]": draw(st.floats(0, 1)), "iHelpID[0]": n + 1}
        geo.start[2:] = axes
        axes = axes + np.array([draw(st.integers(-5, 5)) for _ in range(10)])
        geo.end[2:] = axes
        found.append(geo)
        for m in range(draw(st.sampled_from([0, 0, 0, 1, 2]))):
            function = Geo(MCOMMAND, geo.end.copy(), geo.end.copy(), {"iHelpID[0]": 100 + 10 * n + m})
            found.append(function)
    return found


def functions(objects: list[Geo]) -> list[float]:
    return [geo.member("iHelpID[0]") for geo in objects if geo.kind == MCOMMAND]


@pytest.mark.slow
@pytest.mark.parametrize("name", BLOCKS)
@SETTINGS
@given(objects=paths())
def test_a_path_stays_one_path(name: str, objects: list[Geo]) -> None:
    """Spec 13: positions go on over each transition; sums of additional axes and M functions stay."""
    result = through(objects, Block(name, BLOCKS[name]), vec=(1, 2, 3))
    assert result.error == 0
    found = result.objects
    assert gaps(found) < 1e-7 if "Tool" in name else gaps(found) < 1e-9
    moving = [geo for geo in found if geo.kind != MCOMMAND]
    np.testing.assert_allclose(moving[0].start[3:], objects[0].start[3:], atol=1e-12)
    np.testing.assert_allclose(moving[-1].end[3:], objects[-1].end[3:], atol=1e-9)
    if name != "SMC_AvoidLoop":
        assert functions(found) == functions(objects)
    for geo in moving:
        if geo.kind in (LIN, CLW, CCLW, SPLINE):
            assert length_of(geo) == pytest.approx(geo.length(), rel=1e-8, abs=1e-9)


@pytest.mark.slow
@pytest.mark.parametrize("name", BLOCKS)
@settings(max_examples=5, deadline=None)
@given(
    objects=paths(),
    capacity=st.sampled_from([5, 6, 7, 9]),
    gives=st.integers(1, 4),
    takes=st.integers(1, 4),
)
def test_buffers_change_nothing(name: str, objects: list[Geo], capacity: int, gives: int, takes: int) -> None:
    """Spec CNCR-03, CNCR-05, CNCR-06: nothing is lost or doubled, whoever is faster."""
    if name in ("SMC_AvoidLoop", "SMC_SmoothMerge"):
        capacity = LARGE  # How far they look ahead is said by the buffer. Spec CNCR-73
    block = Block(name, BLOCKS[name])
    large = through(objects, block)
    tiny = through(objects, block, capacity=capacity, gives=gives, takes=takes, cycles=2000)
    assert tiny.literals == large.literals


CHAIN = [
    Block("SMC_ToolCorr"),
    Block("SMC_AvoidLoop"),
    Block("SMC_SmoothPath"),
    Block("SMC_RotateQueue2D", "dPhi := 30"),
]


@pytest.mark.slow
@settings(max_examples=5, deadline=None)
@given(paths(marks=2 | 16), st.sampled_from([5, 6, 8]), st.integers(1, 4), st.integers(1, 4))
def test_a_chain_with_tiny_buffers(objects: list[Geo], capacity: int, gives: int, takes: int) -> None:
    """Spec CNCR-01, CNCR-08: blocks one behind the other give the same with buffers of any size."""
    large = through(objects, *CHAIN)
    tiny = through(objects, *CHAIN, capacity=capacity, gives=gives, takes=takes, cycles=3000)
    assert tiny.literals == large.literals
    assert gaps(large.objects) < 1e-7


@pytest.mark.parametrize("name", CHANGES_NOTHING)
@settings(max_examples=5, deadline=None)
@given(st.lists(length, min_size=1, max_size=6))
def test_a_straight_path_stays(name: str, lengths: list[float]) -> None:
    """Spec 13: no corner, nothing to do."""
    objects = path([(0.0, value) for value in lengths], dVel=10.0, dVelEnd=10.0)
    objects[0].members["byInternMark"] = 16 | 32 | 128
    found = through(objects, Block(name, CHANGES_NOTHING[name])).objects
    assert len(found) == len(objects)
    for before, after in zip(objects, found, strict=True):
        np.testing.assert_array_equal((after.start, after.end), (before.start, before.end))
        assert (after.kind, after.member("dVel"), after.member("dVelEnd")) == (LIN, 10, 10)


@pytest.mark.slow
@pytest.mark.parametrize("mode", ["SP_SPLINE3", "SP_SPLINE5"])
@SETTINGS
@given(objects=paths(marks=16))
def test_smoothed_corners_are_tangential(mode: str, objects: list[Geo]) -> None:
    """Spec CNCR-85: at both ends; the spline of fifth degree has the curvature of its neighbours."""
    moving = [geo for geo in objects if geo.kind != MCOMMAND]
    block = Block("SMC_SmoothPath", f"eMode := SM3_CNC.SMC_SMOOTHPATHMODE.{mode}")
    found = through(moving, block).objects
    for first, second in pairwise(found):
        if SPLINE in (first.kind, second.kind):
            assert turn(first, second) < 1e-4
            if mode == "SP_SPLINE5":
                size = max(1.0, np.linalg.norm(curvature(first, 1.0)))
                np.testing.assert_allclose(curvature(first, 1.0), curvature(second, 0.0), atol=1e-5 * size)
    corners = sum(turn(a, b) > 1e-3 for a, b in pairwise(moving))
    assert sum(geo.kind == SPLINE for geo in found) == corners


def curvature(geo: Geo, u: float) -> np.ndarray:
    """Second derivative by the length."""
    h = 1e-3
    steps = {1: 4 / 5, 2: -1 / 5, 3: 4 / 105, 4: -1 / 280}
    second = sum(
        ((c / h) * (geo.slope(u + k * h) - geo.slope(u - k * h)) for k, c in steps.items()), np.zeros(3)
    )
    first = geo.slope(u)
    square = float(first @ first)
    return second / square - first * float(first @ second) / square**2


@pytest.mark.slow
@SETTINGS
@given(paths(kinds=st.one_of(st.tuples(corner, length), st.tuples(corner, length, swept)), marks=32))
def test_rounded_corners_are_tangential(objects: list[Geo]) -> None:
    """Spec CNCR-92: an arc touches both objects; line and line always get one."""
    moving = [geo for geo in objects if geo.kind != MCOMMAND]
    found = through(moving, Block("SMC_RoundPath")).objects
    lines = {float(geo.member("iSourceLine_No")) for geo in moving if geo.kind == LIN}
    inserted = [geo for geo in found if geo.kind != LIN and not any(same_circle(geo, m) for m in moving)]
    for first, second in pairwise(found):
        if any(first is geo or second is geo for geo in inserted):
            assert turn(first, second) < 1e-4
    for first, second in pairwise(moving):
        if first.kind == second.kind == LIN and turn(first, second) > 1e-3:
            assert any(geo.member("iSourceLine_No") == first.member("iSourceLine_No") for geo in inserted)
    assert lines <= {geo.member("iSourceLine_No") for geo in found}


def same_circle(first: Geo, second: Geo) -> bool:
    return second.kind in (CLW, CCLW) and all(
        abs(first.member(name) - second.member(name)) < 1e-9 for name in ("dP1", "dP2", "dP3")
    )


@pytest.mark.slow
@pytest.mark.parametrize("side", [2, 4])
@SETTINGS
@given(objects=paths(marks=0), radius=st.floats(0.5, 3), positionings=st.sets(st.integers(0, 6)))
def test_corrected_points_have_the_distance_of_the_radius(
    side: int, objects: list[Geo], radius: float, positionings: set[int]
) -> None:
    """Spec CNCR-61: each point of a corrected object lies beside an object of the program by the radius.

    Ellipses within 1E-5 of the radius; only straight joints, where nothing meets, may lie elsewhere.
    """
    moving = [geo for geo in objects if geo.kind != MCOMMAND]
    for n, geo in enumerate(moving):
        geo.members["dToolRadius"] = radius
        if geo.kind == LIN and n in positionings:
            geo.kind = LINPOS
    lead = line(position(-20, 0), position(0, 0), byInternMark=side, dToolRadius=radius)
    lead.end[2:] = lead.start[2:] = moving[0].start[2:]
    found = through([lead, *moving], Block("SMC_ToolCorr")).objects[1:]
    samples = np.array([geo.curve(u)[:2] for geo in moving for u in np.linspace(0, 1, 4001)])
    joints = 0
    for geo in found:
        off = 0.0
        for u in np.linspace(0.02, 0.98, 7):
            place = geo.curve(u)[:2]
            distances = np.linalg.norm(samples - place, axis=1)
            off = max(off, beside(moving, place, radius, distances))
        if off > 2e-5 * radius:
            joints += 1
            assert geo.kind == LIN, "only a straight joint may lie elsewhere"
    assert joints <= len(moving)


def beside(moving: list[Geo], place: np.ndarray, radius: float, distances: np.ndarray) -> float:
    """How far the distance to the best object is from the radius: dense samples, then Newton along it."""
    best = np.inf
    for n, geo in enumerate(moving):
        part = distances[n * 4001 : (n + 1) * 4001]
        for k in np.argsort(np.abs(part - radius))[:3]:
            u = k / 4000
            for _ in range(8):
                way = geo.curve(u)[:2] - place
                slope = geo.slope(u)[:2]
                u = min(1.0, max(0.0, u - float(way @ slope) / float(slope @ slope)))
            best = min(best, abs(float(np.linalg.norm(geo.curve(u)[:2] - place)) - radius))
    return float(best)


@SETTINGS
@given(
    st.lists(st.tuples(st.floats(10, 80), st.floats(20, 60)), min_size=3, max_size=5),
    st.floats(0.5, 5),
    st.sets(st.integers(0, 5)),
)
def test_outside_of_a_convex_path(
    corners: list[tuple[float, float]], radius: float, positionings: set[int]
) -> None:
    """Right of a path of lines that turns left the length grows by the angles times the radius."""
    pieces_ = [(0.0, 30.0), *corners]
    if sum(angle for angle, _ in corners) > 300:
        return
    moving = path([tuple(piece) for piece in pieces_], dToolRadius=radius)
    for n in positionings & set(range(len(moving))):
        moving[n].kind = LINPOS
    lead = line(position(-20, 0), position(0, 0), byInternMark=4, dToolRadius=radius)
    found = through([lead, *moving], Block("SMC_ToolCorr")).objects[1:]
    whole = sum(length_of(geo) for geo in found)
    angles = np.radians(sum(angle for angle, _ in corners))
    expected = 30 + sum(size for _, size in corners) + radius * angles
    assert whole == pytest.approx(expected, rel=1e-9)


def test_every_object_of_a_long_path_comes_out() -> None:
    """A path longer than all buffers."""
    objects = path([(10.0, 5.0)] * 24)
    result: Result = through(objects, *CHAIN, capacity=5, gives=1, takes=1, cycles=3000)
    assert len(result.objects) == 24
