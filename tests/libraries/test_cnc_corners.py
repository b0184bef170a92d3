"""SM3_CNC: corners of a path as splines and as arcs. Spec cnc_runtime 5.4, 5.5."""

from __future__ import annotations

import math

import numpy as np
import pytest
from tests.libraries.cnc_chain import (
    CORNERS_OFF,
    ROUND,
    SMOOTH,
    Block,
    gaps,
    length_of,
    polyline,
    shape,
    switches,
    through,
)
from tests.libraries.cnc_paths import CCLW, LIN, LINPOS, MCOMMAND, SPLINE, Geo, position

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
