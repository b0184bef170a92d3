"""SM3_CNC: worked examples of the preprocessing blocks. Spec cnc_runtime 5: cnc_runtime EX-10 and on."""

from __future__ import annotations

import math
from itertools import pairwise

import numpy as np
import pytest
from tests.libraries.cnc_chain import TINY, Block, Result, gaps, length_of, through
from tests.libraries.cnc_paths import CCLW, CLW, LIN, LINPOS, MCOMMAND, SPLINE, Geo, arc, line, path, position
from tests.libraries.st_program import run

LEFT, RIGHT, CORRECTION_OFF = 2, 4, 1
SMOOTH, ROUND, CORNERS_OFF = 16, 32, 8
LOOPS, LOOPS_OFF = 128, 64


def polyline(*points: tuple[float, ...], marks: dict[int, int] | None = None, **members: float) -> list[Geo]:
    """Lines from point to point; marks are byInternMark by the number of the line."""
    given = {"dVel": 100.0, "dVelEnd": 100.0} | members
    return [
        line(position(*first), position(*second), byInternMark=(marks or {}).get(n, 0), **given)
        for n, (first, second) in enumerate(pairwise(points))
    ]


def shape(result: Result) -> list[tuple[int, tuple[float, ...], tuple[float, ...]]]:
    assert result.error == 0
    assert gaps(result.objects) < 1e-9
    return [
        (geo.kind, tuple(geo.start[:2].round(9) + 0.0), tuple(geo.end[:2].round(9) + 0.0))
        for geo in result.objects
    ]


CORNERS = [(0, 0), (10, 0), (10, 20), (30, 20), (40, 20)]


@pytest.mark.parametrize(
    ("side", "mode", "expected"),
    [
        (
            LEFT,
            "TC_RAMP_IN",
            [
                (LIN, (0, 0), (8, 0)),
                (LIN, (8, 0), (8, 20)),
                (CLW, (8, 20), (10, 22)),
                (LIN, (10, 22), (30, 22)),
                (LIN, (30, 22), (40, 20)),
            ],
        ),
        (
            RIGHT,
            "TC_RAMP_IN",
            [
                (LIN, (0, 0), (12, 0)),
                (LIN, (12, 0), (12, 18)),
                (LIN, (12, 18), (30, 18)),
                (LIN, (30, 18), (40, 20)),
            ],
        ),
        (
            LEFT,
            "TC_BLIND_POS",
            [
                (LINPOS, (0, 0), (0, 2)),
                (LIN, (0, 2), (8, 2)),
                (LIN, (8, 2), (8, 20)),
                (CLW, (8, 20), (10, 22)),
                (LIN, (10, 22), (30, 22)),
                (LINPOS, (30, 22), (30, 20)),
                (LIN, (30, 20), (40, 20)),
            ],
        ),
    ],
)
def test_tool_correction_of_lines(side: int, mode: str, expected: list[object]) -> None:
    """cnc_runtime EX-10. Spec CNCR-61, CNCR-62, CNCR-64 to CNCR-67, PRE-01."""
    block = Block("SMC_ToolCorr", f"eMode := SM3_CNC.SMC_TOOLCORRMODE.{mode}")
    result = through(polyline(*CORNERS, marks={0: side, 2: CORRECTION_OFF}, dToolRadius=2), block)
    assert shape(result) == expected
    assert result.byte == 14
    for geo in result.objects:
        if geo.kind == CLW:
            assert length_of(geo) == pytest.approx(math.pi, rel=1e-12)
            assert (geo.member("dP1"), geo.member("dP2"), geo.member("dP3")) == (10, 20, 2)


def test_the_radius_is_input_plus_word_d() -> None:
    """Spec CNCR-60: 1.5 and 0.5 are 2; without both the path stays."""
    objects = polyline(*CORNERS, marks={0: LEFT, 2: CORRECTION_OFF}, dToolRadius=0.5)
    added = through(objects, Block("SMC_ToolCorr", "dToolRadius := 1.5"))
    assert shape(added)[1] == (LIN, (8, 0), (8, 20))
    plain = polyline(*CORNERS, marks={0: LEFT, 2: CORRECTION_OFF})
    assert shape(through(plain, Block("SMC_ToolCorr"))) == [(LIN, *ends) for ends in pairs(CORNERS)]


def pairs(points: list[tuple[float, float]]) -> list[tuple[tuple[float, float], tuple[float, float]]]:
    return list(pairwise(points))


@pytest.mark.parametrize(("side", "radius"), [(LEFT, 8), (RIGHT, 12)])
def test_tool_correction_of_an_arc(side: int, radius: float) -> None:
    """cnc_runtime EX-10, arc. Spec CNCR-63."""
    objects = [
        line(position(-10, 0), position(0, 0), byInternMark=side, dToolRadius=2),
        line(position(0, 0), position(20, 0), dToolRadius=2),
        arc((20, 10), 10, 270, -90, dToolRadius=2),
    ]
    found = through(objects, Block("SMC_ToolCorr")).objects
    assert [geo.kind for geo in found] == [LIN, LIN, CCLW]
    assert found[2].member("dP3") == pytest.approx(radius)
    np.testing.assert_allclose(found[2].end[:2], (20 + radius, 10), atol=1e-12)
    assert found[1].start[1] == pytest.approx(2 if side == LEFT else -2)


@pytest.mark.parametrize(
    ("mode", "expected"),
    [
        ("TC_RAMP_IN", [(LIN, (0, 0), (100, 5)), (LIN, (100, 5), (200, 0))]),
        (
            "TC_BLIND_POS",
            [
                (LINPOS, (0, 0), (0, 5)),
                (LIN, (0, 5), (100, 5)),
                (LINPOS, (100, 5), (100, 0)),
                (LIN, (100, 0), (200, 0)),
            ],
        ),
    ],
)
def test_one_corrected_object(mode: str, expected: list[object]) -> None:
    """cnc EX-25. Spec CNCR-66, CNCR-67."""
    objects = polyline((0, 0), (100, 0), (200, 0), marks={0: LEFT | CORRECTION_OFF}, dToolRadius=5)
    assert (
        shape(through(objects, Block("SMC_ToolCorr", f"eMode := SM3_CNC.SMC_TOOLCORRMODE.{mode}")))
        == expected
    )


def test_a_positioning_in_front_is_redirected() -> None:
    """Spec CNCR-67: no further object."""
    objects = polyline((0, 0), (10, 0), (20, 0), marks={1: LEFT}, dToolRadius=2)
    objects[0].kind = LINPOS
    block = Block("SMC_ToolCorr", "eMode := SM3_CNC.SMC_TOOLCORRMODE.TC_BLIND_POS")
    assert shape(through(objects, block)) == [(LINPOS, (0, 0), (10, 2)), (LIN, (10, 2), (20, 2))]


@pytest.mark.parametrize(
    ("side", "expected"),
    [
        (LEFT, [(LIN, (8, 0), (8, 20)), (CLW, (8, 20), (10, 22)), (LINPOS, (10, 22), (30, 22))]),
        (RIGHT, [(LIN, (12, 0), (12, 18)), (LINPOS, (12, 18), (30, 18))]),
    ],
)
def test_a_positioning_between_corrected_objects_is_corrected(side: int, expected: list[object]) -> None:
    """Spec CNCR-61, CNCR-64, CNCR-65: G0 between G41 and G40; the arc in front of it goes at the feed."""
    objects = polyline(*CORNERS, marks={0: side}, dToolRadius=2)
    objects[2].kind = LINPOS
    objects[2].members |= {"dVel": 1000.0}
    result = through(objects, Block("SMC_ToolCorr"))
    assert shape(result)[1 : 1 + len(expected)] == expected
    assert [geo.kind for geo in result.objects].count(LINPOS) == 1
    assert all(geo.member("dVel") == (1000 if geo.kind == LINPOS else 100) for geo in result.objects)


def test_an_arc_smaller_than_the_tool_disappears() -> None:
    """Spec CNCR-63: its neighbours are joined where they meet."""
    objects = [
        line(position(-10, 0), position(0, 0), byInternMark=LEFT, dToolRadius=3),
        line(position(0, 0), position(20, 0), dToolRadius=3),
        arc((20, 2), 2, 270, -90, dToolRadius=3),
        line(position(22, 2), position(22, 30), dToolRadius=3),
    ]
    assert shape(through(objects, Block("SMC_ToolCorr")))[1:] == [
        (LIN, (0, 3), (19, 3)),
        (LIN, (19, 3), (19, 30)),
    ]


@pytest.mark.parametrize(("end", "expected"), [(0, 0), (7, 7), (20, 100)])
def test_an_arc_that_disappears_leaves_its_end_velocity(end: float, expected: float) -> None:
    """Spec CNCR-112: what an earlier block has prescribed holds; its own velocity prescribes nothing."""
    objects = polyline((-10, 0), (0, 0), (20, 0), marks={0: LEFT}, dToolRadius=3)
    objects.append(arc((20, 2), 2, 270, -90, dToolRadius=3, dVel=20, dVelEnd=end))
    objects += polyline((22, 2), (22, 30), dToolRadius=3)
    found = through(objects, Block("SMC_ToolCorr")).objects
    assert [geo.member("dVelEnd") for geo in found] == [100, expected, 100]


@pytest.mark.parametrize("plane", [((1, 0, 0), (0, 1, 0)), ((0, 0, 1), (1, 0, 0)), ((0, 1, 0), (0, 0, 1))])
def test_correction_in_the_planes_of_g17_to_g19(plane: tuple[tuple[int, ...], tuple[int, ...]]) -> None:
    """Spec CNCR-C19: the same figure in each plane; the third coordinate follows linearly."""
    along, across = np.array(plane[0], float), np.array(plane[1], float)
    normal = np.cross(along, across)
    objects = polyline(*CORNERS, marks={0: LEFT, 2: CORRECTION_OFF}, dToolRadius=2)
    for n, geo in enumerate(objects):
        geo.space, geo.plane = True, (along, across)
        geo.start[:3] = geo.start[0] * along + geo.start[1] * across + n * normal
        geo.end[:3] = geo.end[0] * along + geo.end[1] * across + (n + 1) * normal
    result = through(objects, Block("SMC_ToolCorr"))
    assert result.error == 0
    assert gaps(result.objects) < 1e-9
    ends = [(0, 0, 0), (8, 0, 1), (8, 20, 2), (10, 22, 2), (30, 22, 3), (40, 20, 4)]
    for geo, first, second in zip(result.objects, ends[:-1], ends[1:], strict=True):
        for place, expected in ((geo.start, first), (geo.end, second)):
            seen = (place[:3] @ along, place[:3] @ across, place[:3] @ normal)
            np.testing.assert_allclose(seen, expected, atol=1e-12)


def test_a_curve_that_leaves_the_plane_is_refused() -> None:
    """Spec CNCR-C19, error 1600."""
    objects = [
        line(position(-10, 0), position(0, 0), byInternMark=LEFT, dToolRadius=2),
        Geo(CCLW, position(0, 0), position(0, 0), {"dP3": 5, "dT2": -90, "dToolRadius": 2}, True),
    ]
    objects[0].space = True
    objects[1].plane = (np.array([0, 1.0, 0]), np.array([0, 0, 1.0]))
    assert through(objects, Block("SMC_ToolCorr")).error == 1600


def test_a_plunge_in_an_outer_corner_stands_at_the_corner_of_the_corrected_path() -> None:
    """Z alone does not move the tool in the plane: it comes where the corner is."""
    objects = polyline((0, 0), (10, 0), (10, 20), (30, 20), marks={0: LEFT}, dToolRadius=2)
    plunge = Geo(101, position(10, 20), position(10, 20, -5), {"dToolRadius": 2})
    for geo in objects[2:]:
        geo.start[2] = geo.end[2] = -5
    result = through([*objects[:2], plunge, *objects[2:]], Block("SMC_ToolCorr"))
    assert [geo.kind for geo in result.objects] == [LIN, LIN, CLW, 101, LIN]
    np.testing.assert_allclose(result.objects[3].start[:3], (10, 22, 0), atol=1e-12)
    np.testing.assert_allclose(result.objects[3].end[:3], (10, 22, -5), atol=1e-12)


LOOP = [(0, 0), (20, 0), (20, 10), (10, 10), (10, -10)]


def test_loops() -> None:
    """cnc_runtime EX-11. Spec CNCR-70 to CNCR-72, PRE-04."""
    block = Block("SMC_AvoidLoop")
    marked = through(polyline(*LOOP, marks={0: LOOPS, 3: LOOPS_OFF}), block)
    assert shape(marked) == [(LIN, (0, 0), (10, 0)), (LIN, (10, 0), (10, -10))]
    assert marked.byte == 10
    assert shape(through(polyline(*LOOP), block)) == [(LIN, *ends) for ends in pairs(LOOP)]


def test_a_loop_larger_than_the_input_is_not_found() -> None:
    """Spec CNCR-73: five places are full with two objects."""
    objects = polyline(*LOOP, marks={0: LOOPS, 3: LOOPS_OFF})
    assert len(through(objects, Block("SMC_AvoidLoop"), capacity=TINY).objects) == 4


def test_loops_keep_the_sum_of_additional_axes() -> None:
    """Spec CNCR-72: the values at the cut; nothing jumps."""
    objects = polyline(*LOOP, marks={0: LOOPS, 3: LOOPS_OFF})
    for n, geo in enumerate(objects):
        geo.start[6], geo.end[6] = 3.0 * n, 3.0 * n + 3
    found = through(objects, Block("SMC_AvoidLoop")).objects
    assert found[0].end[6] == found[1].start[6] == pytest.approx(1.5)
    assert found[1].end[6] == pytest.approx(12)


SMOOTHED = [(0, 0), (10, 0), (10, 20), (20, 20), (20, 0), (30, 0)]


@pytest.mark.parametrize(("mode", "middle"), [("SP_SPLINE3", (10.5, 19.5)), ("SP_SPLINE5", (10.375, 19.625))])
def test_smoothing(mode: str, middle: tuple[float, float]) -> None:
    """cnc_runtime EX-12. Spec CNCR-80, CNCR-81, CNCR-85, PRE-02."""
    block = Block("SMC_SmoothPath", f"eMode := SM3_CNC.SMC_SMOOTHPATHMODE.{mode}")
    result = through(polyline(*SMOOTHED, marks={1: SMOOTH, 3: CORNERS_OFF}, dToolRadius=2), block)
    assert shape(result) == [
        (LIN, (0, 0), (10, 0)),
        (LIN, (10, 0), (10, 18)),
        (SPLINE, (10, 18), (12, 20)),
        (LIN, (12, 20), (18, 20)),
        (SPLINE, (18, 20), (20, 18)),
        (LIN, (20, 18), (20, 0)),
        (LIN, (20, 0), (30, 0)),
    ]
    np.testing.assert_allclose(result.objects[2].curve(0.5)[:2], middle, atol=1e-12)
    assert result.byte == 13


@pytest.mark.parametrize(
    ("symmetrical", "expected"),
    [
        ("FALSE", [(SPLINE, (10, 10), (15, 20)), (SPLINE, (15, 20), (20, 10))]),
        (
            "TRUE",
            [
                (SPLINE, (10, 15), (15, 20)),
                (LIN, (15, 20), (17.5, 20)),
                (SPLINE, (17.5, 20), (20, 17.5)),
            ],
        ),
    ],
)
def test_distances_of_smoothing(symmetrical: str, expected: list[object]) -> None:
    """cnc_runtime EX-13. Spec CNCR-83, CNCR-84."""
    objects = polyline(*SMOOTHED, marks={1: SMOOTH, 3: CORNERS_OFF}, dToolRadius=10)
    block = Block("SMC_SmoothPath", f"bSymmetricalDistances := {symmetrical}")
    assert shape(through(objects, block))[2:-2] == expected


@pytest.mark.parametrize(("mode", "jumps"), [("SP_SPLINE3", True), ("SP_SPLINE5", False)])
def test_the_acceleration_at_the_ends_of_splines(mode: str, jumps: bool) -> None:
    """cnc_runtime EX-14: by the second derivative of X at constant path velocity."""
    objects = polyline((0, 0), (0, 10), (10, 10), (10, 0), marks={0: SMOOTH, 2: CORNERS_OFF}, dToolRadius=10)
    found = through(objects, Block("SMC_SmoothPath", f"eMode := SM3_CNC.SMC_SMOOTHPATHMODE.{mode}")).objects
    splines = [geo for geo in found if geo.kind == SPLINE]
    assert [tuple(geo.start[:2]) + tuple(geo.end[:2]) for geo in splines] == [
        (0, 5, 5, 10),
        (7.5, 10, 10, 7.5),
    ]
    for geo in splines:
        h = 1e-3
        for u in (0.0, 1.0):
            first = geo.slope(u)
            second = (geo.slope(u + h) - geo.slope(u - h)) / (2 * h)
            bent = np.linalg.norm(np.cross(first, second)) / np.linalg.norm(first) ** 3
            assert (bent > 0.05) == jumps


@pytest.mark.parametrize(
    ("mode", "corner", "behind"),
    [
        ("SPAA_LATE", (10, 10), (10, 11)),
        ("SPAA_EARLY", (9, 10), (10, 10)),
        ("SPAA_SYMMETRIC", (9, 11), (11, 11)),
    ],
)
def test_additional_axes_of_smoothing(
    mode: str, corner: tuple[float, float], behind: tuple[float, float]
) -> None:
    """Spec CNCR-86: lines of 10 with P 0 to 10 and 10 to 20 lose 1 each."""
    objects = polyline((0, 0), (10, 0), (10, 10), marks={0: SMOOTH}, dToolRadius=1)
    for n, geo in enumerate(objects):
        geo.start[6], geo.end[6] = 10.0 * n, 10.0 * n + 10
    block = Block("SMC_SmoothPath", f"eAddAxMode := SM3_CNC.SMC_SMOOTHPATHADDAXMODE.{mode}")
    first, spline, second = through(objects, block).objects
    expected = {"SPAA_LATE": (10, 11), "SPAA_EARLY": (9, 10), "SPAA_SYMMETRIC": (9, 11)}[mode]
    assert (spline.start[6], spline.end[6]) == pytest.approx(expected)
    assert (first.start[6], first.end[6]) == pytest.approx((0, expected[0]))
    assert (second.start[6], second.end[6]) == pytest.approx((expected[1], 20))


def test_m_functions_and_switch_points_in_a_corner() -> None:
    """Spec CNCR-87: M behind the spline; switch points keep their distance and do not cross the middle."""
    objects = polyline((0, 0), (10, 0), (10, 10), marks={0: SMOOTH}, dToolRadius=2)
    objects[0].members |= {"dHelpPos[0]": 0.9, "iHelpID[0]": 3, "dHelpPos[1]": 0.5, "iHelpID[1]": 4}
    objects[1].members |= {"dHelpPos[0]": 0.1, "iHelpID[0]": 5}
    stop = Geo(MCOMMAND, position(10, 0), position(10, 0), {"iHelpID[0]": 7})
    first, spline, function, second = through([objects[0], stop, objects[1]], Block("SMC_SmoothPath")).objects
    assert [first.kind, spline.kind, function.kind, second.kind] == [LIN, SPLINE, MCOMMAND, LIN]
    assert switches(first) == {4: pytest.approx(0.625)}
    length = length_of(spline)
    assert switches(spline) == {3: pytest.approx(1 / length), 5: pytest.approx(1 - 1 / length)}
    assert switches(second) == {}


def switches(geo: Geo) -> dict[int, float]:
    return {
        int(geo.member(f"iHelpID[{n}]")): geo.member(f"dHelpPos[{n}]")
        for n in range(3)
        if geo.member(f"iHelpID[{n}]")
    }


def test_dynamics_of_a_spline() -> None:
    """Spec CNCR-88: the smaller of both."""
    objects = polyline((0, 0), (10, 0), (10, 10), marks={0: SMOOTH}, dToolRadius=2)
    objects[0].members |= {"dVel": 30.0, "dVelEnd": 30.0, "dAccel": 7.0, "dDecel": 9.0}
    objects[1].members |= {"dVel": 50.0, "dVelEnd": 50.0, "dAccel": 8.0, "dDecel": 6.0}
    spline = through(objects, Block("SMC_SmoothPath")).objects[1]
    assert [spline.member(name) for name in ("dVel", "dAccel", "dDecel")] == [30, 7, 6]


@pytest.mark.parametrize("function", [False, True])
@pytest.mark.parametrize(("end", "expected"), [(100, [50, 50, 50]), (7, [50, 7, 50]), (0, [50, 0, 50])])
@pytest.mark.parametrize("name", ["SMC_SmoothPath", "SMC_RoundPath"])
def test_end_velocities_in_a_corner(name: str, end: float, expected: list[float], function: bool) -> None:
    """Spec CNCR-112: what is prescribed for the corner holds behind it.

    A stop at an M function is left to SMC_CheckVelocities: it may be acknowledged in advance (CNCR-152).
    """
    mark = SMOOTH if name == "SMC_SmoothPath" else ROUND
    objects = polyline((0, 0), (10, 0), (10, 10), marks={0: mark}, dToolRadius=2)
    objects[0].members |= {"dVelEnd": end}
    objects[1].members |= {"dVel": 50.0, "dVelEnd": 50.0}
    if function:
        objects.insert(1, Geo(MCOMMAND, position(10, 0), position(10, 0), {"iHelpID[0]": 7}))
    found = [geo for geo in through(objects, Block(name)).objects if geo.kind != MCOMMAND]
    assert [geo.member("dVelEnd") for geo in found] == expected


@pytest.mark.parametrize("kind", [LINPOS, LIN])
def test_positioning_is_never_cut(kind: int) -> None:
    """Spec CNCR-80: a corner at G0 stays."""
    objects = polyline((0, 0), (10, 0), (10, 10), marks={0: SMOOTH | ROUND}, dToolRadius=2)
    objects[1].kind = kind
    for name in ("SMC_SmoothPath", "SMC_RoundPath"):
        assert len(through(objects, Block(name)).objects) == (2 if kind == LINPOS else 3)


@pytest.mark.parametrize(("tolerance", "count"), [("29.9", 3), ("30.1", 2)])
@pytest.mark.parametrize("block", ["SMC_SmoothPath", "SMC_RoundPath"])
def test_small_angles_stay(block: str, tolerance: str, count: int) -> None:
    """Spec CNCR-82, CNCR-93."""
    end = (10 + 10 * math.cos(math.radians(30)), 10 * math.sin(math.radians(30)))
    objects = polyline((0, 0), (10, 0), end, marks={0: SMOOTH if "Smooth" in block else ROUND}, dToolRadius=2)
    assert len(through(objects, Block(block, f"dAngleTol := {tolerance}")).objects) == count


def test_rounding() -> None:
    """cnc_runtime EX-15. Spec CNCR-90 to CNCR-92, PRE-03."""
    objects = polyline((0, 0), (10, 0), (10, 10), marks={0: ROUND})
    result = through(objects, Block("SMC_RoundPath", "dRadius := 2"))
    assert shape(result) == [(LIN, (0, 0), (8, 0)), (CCLW, (8, 0), (10, 2)), (LIN, (10, 2), (10, 10))]
    turned = result.objects[1]
    found = [turned.member(name) for name in ("dP1", "dP2", "dP3", "dT1", "dT2")]
    assert found == pytest.approx([8, 2, 2, 270, -90])
    assert length_of(turned) == pytest.approx(math.pi)
    assert result.byte == 12
    half = through(objects, Block("SMC_RoundPath", "dRadius := 20"))
    assert shape(half) == [(LIN, (0, 0), (5, 0)), (CCLW, (5, 0), (10, 5)), (LIN, (10, 5), (10, 10))]


def test_a_bend_by_rounding_stays() -> None:
    """Two lines of one direction, but for the last binary place: an arc would be beyond all bounds."""
    ends = [(8 + k * math.cos(math.radians(1)), k * math.sin(math.radians(1))) for k in (0, 8, 17)]
    result = through(polyline((0, 0), *ends, marks={0: ROUND}), Block("SMC_RoundPath", "dRadius := 1.5"))
    assert [geo.kind for geo in result.objects] == [LIN, CCLW, LIN, LIN]


@pytest.mark.parametrize(
    ("angle", "radius"),
    [(30, 7.464102), (45, 4.828427), (60, 3.464102), (90, 2), (120, 1.154701), (135, 0.828427)],
)
@pytest.mark.parametrize("side", [1, -1])
@pytest.mark.parametrize("space", [False, True])
def test_the_radius_by_the_angle(angle: float, radius: float, side: int, space: bool) -> None:
    """cnc_runtime EX-15, also of corners that stand upright in space."""
    turn = math.radians(angle)
    objects = polyline(
        (0, 0), (10, 0), (10 + 10 * math.cos(turn), side * 10 * math.sin(turn)), marks={0: ROUND}
    )
    for geo in objects:
        geo.space = space
        if space:
            for place in (geo.start, geo.end):
                place[1], place[2] = 0.6 * place[1], 0.8 * place[1]
    result = through(objects, Block("SMC_RoundPath", "dRadius := 2"))
    assert gaps(result.objects) < 1e-9
    assert result.objects[1].member("dP3") == pytest.approx(radius, abs=1e-6)
    assert length_of(result.objects[1]) == pytest.approx(radius * turn, abs=1e-5)


@pytest.mark.parametrize(
    ("objects", "vel_end"),
    [
        ([line(position(0, 0), position(10, 0)), arc((10, 25), 25, 270, -90)], 50),
        ([arc((0, 25), 25, 270, -90), line(position(25, 25), position(25, 60))], 50),
        ([arc((0, 0), 25, 180, 180), arc((50, 0), 25, 180, -180)], 35.355339),
        ([arc((0, 0), 25, 270, -90), arc((-25, 0), 50, 0, -90)], 70.710678),
    ],
)
def test_velocities_at_arcs(objects: list[Geo], vel_end: float) -> None:
    """cnc_runtime EX-16. Spec CNCR-100."""
    for geo in objects:
        geo.members |= {"dVel": 1000.0, "dVelEnd": 1000.0}
    limited = through(objects, Block("SMC_LimitCircularVelocity", "dMaxAccJump := 100"))
    assert limited.objects[0].member("dVelEnd") == pytest.approx(vel_end, abs=1e-6)
    assert limited.byte == 11
    free = through(objects, Block("SMC_LimitCircularVelocity"))
    assert [geo.member("dVelEnd") for geo in free.objects] == [1000, 1000]


def test_the_velocity_on_an_arc() -> None:
    """cnc_runtime EX-16: also on the only object of a path."""
    objects = [arc((0, 25), 25, 270, -90, dVel=1000, dVelEnd=1000)]
    found = through(objects, Block("SMC_LimitCircularVelocity", "dMaxAcc := 400")).objects
    assert found[0].member("dVel") == pytest.approx(100)


def test_limits_of_the_program() -> None:
    """cnc_runtime EX-16, cnc EX-29. Spec CNCR-101, GEO-22; in an S shape 1.875 times as fast."""
    objects = [line(position(0, 0), position(100, 0), dVel=50, dVelEnd=50) for _ in range(2)]
    for geo in objects:
        geo.end[6] = 50
        geo.members |= {"adVelAddAx[2]": 10.0, "adAccAddAx[2]": 20.0, "adDecAddAx[2]": 30.0}
    objects[1].members["piStartPos.wSProfile"] = 64
    linear, s_shaped = through(objects, Block("SMC_ExtendedVelocityChecks")).objects
    assert [linear.member(name) for name in ("dVel", "dAccel", "dDecel")] == [20, 40, 60]
    assert s_shaped.member("dVel") == pytest.approx(20 / 1.875)
    assert [s_shaped.member(name) for name in ("dAccel", "dDecel")] == [100, 100]


def test_limits_of_the_inputs() -> None:
    """cnc_runtime EX-16. Spec CNCR-102: in 3D mode Z belongs to the path."""
    flat = line(position(0, 0, 0), position(100, 0, 20, dA3=50), dVel=100, dVelEnd=100)
    space = line(position(0, 0, 0), position(100, 0, 75), dVel=100, dVelEnd=100)
    space.space = True
    block = Block(
        "SMC_LimitAddAxisDynamics", "wAddAxis := 16#104, dMaxVel := 10, dMaxAcc := 10, dMaxDec := 5"
    )
    found = through([flat, space], block).objects
    assert [found[0].member(name) for name in ("dVel", "dAccel", "dDecel")] == [20, 20, 10]
    assert [found[1].member(name) for name in ("dVel", "dAccel", "dDecel")] == [100, 100, 100]


def test_turned_shifted_and_stretched() -> None:
    """Spec CNCR-50, CNCR-51, CNCR-53: examples of the blocks."""
    objects = [line(position(0, 0, 0), position(10, 0, 0)), arc((5, 0), 5, 180, 180)]
    turned = through(objects, Block("SMC_RotateQueue2D", "dPhi := 90"))
    assert turned.byte == 30
    np.testing.assert_allclose(turned.objects[0].end[:2], (0, 10), atol=1e-12)
    found = [turned.objects[1].member(name) for name in ("dP1", "dP2", "dT1")]
    np.testing.assert_allclose(found, (0, 5, 270), atol=1e-12)
    shifted = through(objects, Block("SMC_TranslateQueue3D", "vec := vec"), vec=(1, 2, 3))
    assert shifted.byte == 32
    assert tuple(shifted.objects[0].start[:3]) + tuple(shifted.objects[0].end[:3]) == (1, 2, 3, 11, 2, 3)
    stretched = through(objects, Block("SMC_ScaleQueue3D", "dScaleFactor := 2"))
    assert stretched.byte == 31
    assert [stretched.objects[1].member(name) for name in ("dP1", "dP3")] == [10, 10]
    assert length_of(stretched.objects[1]) == pytest.approx(31.415927, abs=1e-6)


BAD_INPUTS = [
    ("SMC_ScaleQueue3D", "dScaleFactor := 0"),
    ("SMC_ScaleQueue3D", "dScaleFactor := -1"),
    ("SMC_ScaleQueue3D", "dScaleFactor := SQRT(-1.0)"),
    ("SMC_RotateQueue2D", "dPhi := SQRT(-1.0)"),
    ("SMC_TranslateQueue3D", "vec := vec"),
    ("SMC_SmoothPath", "dEdgeDistance := SQRT(-1.0)"),
    ("SMC_SmoothPath", "dEdgeDistance := -1"),
    ("SMC_RoundPath", "dRadius := SQRT(-1.0)"),
    ("SMC_ToolCorr", "dToolRadius := SQRT(-1.0)"),
    ("SMC_LimitCircularVelocity", "dMaxAcc := SQRT(-1.0)"),
    ("SMC_ObjectSplitter", "dMaxLength := SQRT(-1.0)"),
]


@pytest.mark.parametrize(("name", "inputs"), BAD_INPUTS)
def test_inputs_that_are_none_are_refused(name: str, inputs: str) -> None:
    """Spec CNCR-53: an error and no output."""
    result = through(polyline((0, 0), (10, 0), (10, 10)), Block(name, inputs), vec=(math.nan, 0, 0))
    assert result.error == 10021
    assert result.objects == []


@pytest.mark.parametrize("piece", [(30.0, 20.0), (30.0, 20.0, 130.0), (0.0, 40.0, 15.0, -140.0)])
def test_dynamics_of_the_axes_of_the_path(piece: tuple[float, ...]) -> None:
    """SMC_LimitDynamics: X and Y keep their limits at every place, also on ramps."""
    geo = path([piece], dVel=1000.0, dVelEnd=1000.0, dAccel=10000.0, dDecel=10000.0)[0]
    block = Block("SMC_LimitDynamics", "wAxis := 3, dMaxVel := 12, dMaxAcc := 50, dMaxDec := 40")
    found = through([geo], block).objects[0]
    velocity, speed_up, brake = (found.member(name) for name in ("dVel", "dAccel", "dDecel"))
    largest = {"v": 0.0, "a": 0.0, "d": 0.0}
    h = 1e-4
    for u in np.linspace(0, 1, 721):
        slope = geo.slope(u)
        speed = np.linalg.norm(slope)
        tangent = slope[:2] / speed
        after, before = geo.slope(u + h), geo.slope(u - h)
        bend = (after / np.linalg.norm(after) - before / np.linalg.norm(before))[:2] / (2 * h * speed)
        largest["v"] = max(largest["v"], float(np.abs(velocity * tangent).max()))
        for name, value in (("a", speed_up), ("d", brake)):
            for sign in (1, -1):
                total = np.abs(sign * value * tangent + velocity**2 * bend).max()
                largest[name] = max(largest[name], float(total))
    assert largest["v"] <= 12 * (1 + 1e-9)
    assert largest["a"] <= 50 * (1 + 1e-5)
    assert largest["d"] <= 40 * (1 + 1e-5)
    assert largest["d"] > 20, "no more than what the limits ask for"


@pytest.mark.parametrize(
    ("degrees", "expected"), [(90, 10 / math.sqrt(2)), (60, 10.0), (180, 5.0), (4, 100.0)]
)
def test_the_velocity_at_a_corner(degrees: float, expected: float) -> None:
    """SMC_ReduceVelEndAtCorner: the velocity jumps by 10 at most; 4 degrees are below its angle."""
    end = (10 + 10 * math.cos(math.radians(degrees)), 10 * math.sin(math.radians(degrees)))
    objects = polyline((0, 0), (10, 0), end)
    found = through(objects, Block("SMC_ReduceVelEndAtCorner", "dAngle := 5, dMaxVelJump := 10")).objects
    assert found[0].member("dVelEnd") == pytest.approx(expected)


def test_long_objects_are_split() -> None:
    """SMC_ObjectSplitter: three parts; a switch point lies on one of them, marks on one end each."""
    objects = polyline((0, 0), (20, 0), marks={0: SMOOTH | CORNERS_OFF})
    objects[0].members |= {"dHelpPos[0]": 0.5, "iHelpID[0]": 3}
    found = through(objects, Block("SMC_ObjectSplitter", "dMaxLength := 7")).objects
    assert [length_of(geo) for geo in found] == pytest.approx([20 / 3] * 3)
    assert [switches(geo) for geo in found] == [{}, {3: pytest.approx(0.5)}, {}]
    assert [geo.member("byInternMark") for geo in found] == [SMOOTH, 0, CORNERS_OFF]


LIMITS = """
PROGRAM Main
VAR
    a : ARRAY[0..2] OF SM3_CNC.SMC_GEOINFO;
    queue : SM3_CNC.SMC_OUTQUEUE;
    aBuffer : ARRAY[1..10] OF SM3_CNC.SMC_GEOINFO;
    check : SM3_CNC.SMC_CheckForLimits := (wAddAxis := 3);
    n : DINT;
    xBegun, xSame : BOOL;
END_VAR
IF NOT xBegun THEN
    queue.pbyBuffer := ADR(aBuffer);
    SM3_CNC.SMC_SetQueueCapacity(ADR(queue), SIZEOF(aBuffer));
    check.piMax.dX := 100;
    check.piMax.dY := 50;
    xBegun := TRUE;
END_IF
IF n <= 2 THEN
    SM3_CNC.SMC_CalcLengthGeo(ADR(a[n]));
    SM3_CNC.SMC_AppendObj(ADR(queue), ADR(a[n]));
    n := n + 1;
END_IF
check(bExecute := TRUE, poqDataIn := ADR(queue));
xSame := check.poqDataOut = ADR(queue) AND SM3_CNC.SMC_GetCount(ADR(queue)) = n;
END_PROGRAM
"""


@pytest.mark.parametrize(
    ("second", "positive", "negative"),
    [
        (arc((50, 50), 10, 180, 180), 2, 0),
        (arc((50, 50), 10, 180, -180), 0, 0),
        (arc((10, 40), 20, 90, -180), 2, 1),
        (line(position(40, 50), position(60, 50)), 0, 0),
        (line(position(40, 50), position(-1, 51)), 2, 1),
    ],
)
def test_the_box_of_a_path(second: Geo, positive: int, negative: int) -> None:
    """cnc_runtime EX-16. Spec CNCR-103, CNCR-26: the apex counts, a limit is inside, the path stays."""
    second.members["iSourceLine_No"] = 20.0
    objects = [line(position(0, 0), position(40, 50)), second, line(position(), position())]
    with run(LIMITS, cycles=0) as program:
        for n, geo in enumerate(objects):
            program.set("Main", **{f"a[{n}].{name}": value for name, value in geo.values().items()})
        for _ in range(4):
            program.cycle()
        found = [int(program.literal(f"Main.check.{pin}")) for pin in PINS]
        assert program.literal("Main.xSame") == "TRUE"
    out = positive | negative
    assert found == [out, 20 if out else 0, positive, negative]


PINS = ("wAxisOutOfLimits", "iSourceLine_No", "wLimitSwPositive", "wLimitSwNegative")


HANDSHAKE = [
    *("SMC_TranslateQueue3D", "SMC_RotateQueue2D", "SMC_ScaleQueue3D", "SMC_ToolCorr", "SMC_ToolRadiusCorr"),
    *("SMC_AvoidLoop", "SMC_SmoothPath", "SMC_RoundPath", "SMC_LimitCircularVelocity", "SMC_LimitDynamics"),
    *("SMC_ExtendedVelocityChecks", "SMC_LimitAddAxisDynamics", "SMC_ObjectSplitter"),
    *("SMC_ReduceVelEndAtCorner", "SMC_CheckForLimits"),
]


def test_what_is_no_queue_is_refused_and_no_queue_waited_for() -> None:
    """Spec CNCR-14, CNCR-25: every block, error 1501; with 0 it waits; without bExecute the error is gone."""
    blocks = "".join(f"    f{n} : SM3_CNC.{name};\n" for n, name in enumerate(HANDSHAKE))
    calls = ""
    for n, name in enumerate(HANDSHAKE):
        buffer = (
            ""
            if name == "SMC_CheckForLimits"
            else ", nSizeOutQueue := SIZEOF(aBuffer), pbyBufferOutQueue := ADR(aBuffer)"
        )
        calls += f"f{n}(bExecute := xExecute, poqDataIn := pIn{buffer}); a[{n}] := f{n}.wErrorID;\n"
    text = f"""
PROGRAM Main
VAR
{blocks}    aBuffer : ARRAY[1..6] OF SM3_CNC.SMC_GEOINFO;
    other : SM3_CNC.SMC_OUTQUEUE := (wOUTQUEUEStructID := 1);
    pIn : POINTER TO SM3_CNC.SMC_OUTQUEUE;
    xGiven, xExecute : BOOL;
    a : ARRAY[0..{len(HANDSHAKE) - 1}] OF INT;
END_VAR
pIn := 0;
IF xGiven THEN
    pIn := ADR(other);
END_IF
{calls}
END_PROGRAM
"""
    with run(text, cycles=0) as program:
        for given, execute, error in ((False, True, 0), (True, True, 1501), (True, False, 0)):
            program.set("Main", xGiven=given, xExecute=execute)
            program.cycle()
            assert program.numbers("Main.a") == [error] * len(HANDSHAKE)
