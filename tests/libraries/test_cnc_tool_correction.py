"""SM3_CNC: correction of the tool radius, and loops of the corrected path. Spec cnc_runtime 5.2, 5.3."""

from __future__ import annotations

import math
from itertools import pairwise

import numpy as np
import pytest
from tests.libraries.cnc_chain import (
    CORRECTION_OFF,
    LEFT,
    LOOPS,
    LOOPS_OFF,
    RIGHT,
    TINY,
    Block,
    gaps,
    length_of,
    polyline,
    shape,
    through,
)
from tests.libraries.cnc_paths import CCLW, CLW, LIN, LINPOS, Geo, arc, line, position

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
