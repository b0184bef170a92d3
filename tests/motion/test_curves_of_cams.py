"""Curves of cams by the compiled library, against scipy and closed forms (cam.md sections 1, 2 and 5)."""

from __future__ import annotations

import math

import numpy as np
import numpy.typing as npt
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from tests.motion.random_cams import cams

from tappet.motion.cam_curves import cam_curves
from tappet.motion.cam_program import CamProgram
from tappet.project.cams.laws import values_in
from tappet.project.cams.table import CamPoint, CamSegment, CamTable

Numbers = npt.NDArray[np.float64]
shared = settings(max_examples=60, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture])
DEFAULT = CamTable()


def _points(*rows: tuple[float, ...]) -> tuple[CamPoint, ...]:
    return tuple(CamPoint(**dict(zip("xyva", row, strict=False))) for row in rows)


def test_the_default_cam_has_the_values_of_the_specification(program: CamProgram) -> None:
    """cam EX-01: values at positions, and what the columns of the table show."""
    at = [0, 30, 60, 90, 120, 180, 300, 360]
    curves = cam_curves(program, DEFAULT, 100, at)
    expected = [
        (0, 0, 0, 0.0025),
        (7.8515625, 0.68359375, 0.0328125, -0.0000520833),
        (41.25, 1.4375, 0.0125, -0.0010416667),
        (85.4296875, 1.37109375, -0.0140625, -0.00046875),
        (120, 1, 0, 0),
        (180, 1, 0, 0),
        (318.75, 1.4375, -0.0125, -0.0010416667),
        (360, 0, 0, 0.0025),
    ]
    np.testing.assert_allclose(curves.at[:, 0], at)
    np.testing.assert_allclose(curves.at[:, 1:], expected, rtol=0, atol=5e-11)
    first, second, third = curves.segments
    assert first.samples[-1, 4] == pytest.approx(0.0016666667, abs=1e-10), "left of 120"
    assert second.samples[0, 4] == 0, "right of it"
    for one, low, high in ((first, 0, 120), (third, 240, 360)):
        assert (one.least, one.greatest) == pytest.approx((low, high), rel=1e-15)
        assert one.velocity == pytest.approx(1.512, rel=1e-14)
        assert one.acceleration == pytest.approx(0.0328352829, abs=5e-11)
        assert one.jerk == pytest.approx(0.0025, rel=1e-14)
    assert (second.least, second.greatest, second.velocity, second.acceleration) == (120, 240, 1, 0)


def test_lines_around_a_polynomial(program: CamProgram) -> None:
    """cam EX-02: it rises above both of its ends."""
    cam = CamTable(
        points=_points((0, 0), (140, 100, 100 / 140), (280, 180, -0.5), (360, 140)),
        segments=(CamSegment(law="line"), CamSegment(), CamSegment(law="line")),
    )
    curves = cam_curves(program, cam, 50, [70, 210, 245, 320])
    np.testing.assert_allclose(
        curves.at[:, 1:4],
        [
            (50, 100 / 140, 0),
            (166.5625, 0.9776786, -0.0130102),
            (188.447266, *curves.at[2, 2:4]),
            (160, -0.5, 0),
        ],
        atol=5e-7,
    )
    x = np.linspace(140, 280, 2_000_001)
    dense = _piecewise(cam.points[1:3], 3)(x)
    assert curves.segments[1].greatest == pytest.approx(dense.max(), rel=1e-12)
    assert curves.segments[1].greatest > 180


def test_a_point_on_the_curve_changes_nothing(program: CamProgram) -> None:
    """cam EX-03: a polynomial split by a point with its own derivatives is the same one."""
    x, y, v, a, _ = cam_curves(program, DEFAULT, 2, [60]).at[0]
    points = (DEFAULT.points[0], CamPoint(x=x, y=y, v=v, a=a), *DEFAULT.points[1:])
    split = DEFAULT.model_copy(update={"points": points, "segments": (CamSegment(), *DEFAULT.segments)})
    at = list(np.linspace(0, 360, 200))
    np.testing.assert_allclose(
        cam_curves(program, split, 2, at).at[:, 1:4],
        cam_curves(program, DEFAULT, 2, at).at[:, 1:4],
        atol=1e-12,
    )


def test_points_join_their_segments_when_one_is_deleted(program: CamProgram) -> None:
    """cam EX-04 and EX-05."""
    cam = CamTable(points=(DEFAULT.points[0], *DEFAULT.points[2:]), segments=DEFAULT.segments[:2])
    np.testing.assert_allclose(
        cam_curves(program, cam, 2, [120]).at[0, 1:4], (82.5, 1.4375, 0.00625), rtol=1e-13
    )
    line = DEFAULT.model_copy(update={"segments": (CamSegment(), CamSegment(law="line"), CamSegment())})
    middle = cam_curves(program, line, 2).segments[1]
    assert (middle.least, middle.greatest, middle.velocity, middle.acceleration) == (120, 240, 1, 0)


def _piecewise(points: tuple[CamPoint, ...], derivatives: int):  # type: ignore[no-untyped-def]
    from scipy.interpolate import BPoly

    states = [[getattr(point, name) for name in "yvaj"[:derivatives]] for point in points]
    return BPoly.from_derivatives([point.x for point in points], states)


@pytest.mark.parametrize(("law", "derivatives"), [("line", 1), ("poly3", 2), ("poly5", 3), ("poly7", 4)])
@shared
@given(data=st.data())
def test_polynomials_are_those_of_scipy(
    program: CamProgram, law: str, derivatives: int, data: st.DataObject
) -> None:
    cam = data.draw(cams(laws=(law,)))
    reference = _piecewise(cam.points, derivatives)
    for number, curve in enumerate(cam_curves(program, cam, 200).segments):
        inner = curve.samples[1:-1] if len(curve.samples) > 2 else curve.samples[:1]
        width = cam.points[number + 1].x - cam.points[number].x
        exact = [inner[:, 0] * 0 + reference(inner[:, 0])]
        exact += [reference.derivative(order)(inner[:, 0]) for order in (1, 2, 3)]
        for order in range(4):
            size = max(abs(curve.least), abs(curve.greatest), 1) / width**order * 400
            np.testing.assert_allclose(inner[:, 1 + order], exact[order], rtol=0, atol=1e-12 * size)


@shared
@given(cam=cams())
def test_extremes_are_above_all_samples_and_touched(program: CamProgram, cam: CamTable) -> None:
    """Against the values at 4,000 places, and at those near the largest ones."""
    for number, curve in enumerate(cam_curves(program, cam, 2).segments):
        left, right = cam.points[number], cam.points[number + 1]

        def values(
            x: Numbers, left: CamPoint = left, number: int = number, right: CamPoint = right
        ) -> Numbers:
            found = [values_in(left, cam.segments[number], right, one) for one in np.clip(x, left.x, right.x)]
            return np.array(found)

        x = np.linspace(left.x, right.x, 1000)
        step = (right.x - left.x) / 999
        coarse = values(x)
        told = [
            (curve.greatest, lambda rows: rows[:, 0]),
            (-curve.least, lambda rows: -rows[:, 0]),
            (curve.velocity, lambda rows: np.abs(rows[:, 1])),
            (curve.acceleration, lambda rows: np.abs(rows[:, 2])),
            (curve.jerk, lambda rows: np.abs(rows[:, 3])),
        ]
        for peak, of in told:
            size = max(1.0, float(np.abs(of(coarse)).max()))
            assert peak >= of(coarse).max() - 1e-11 * size
            best = x[of(coarse).argmax()]
            near = values(np.linspace(best - step, best + step, 1000))
            assert peak <= of(near).max() + 2e-5 * size, "an extreme that nothing reaches"


REST = (CamPoint(x=10, y=3), CamPoint(x=14, y=5))


@pytest.mark.parametrize(
    ("law", "velocity", "acceleration", "jerk"),
    [
        ("poly3", 1.5, 6.0, 12.0),
        ("poly5", 1.875, 10 / math.sqrt(3), 60.0),
        ("poly7", 2.1875, 84 * math.sqrt(5) / 25, 52.5),
        ("sine", math.pi / 2, math.pi**2 / 2, math.pi**3 / 2),
        ("inclined_sine", 2.0, 2 * math.pi, 4 * math.pi**2),
        (
            "modified_sine",
            4 * math.pi / (4 + math.pi),
            4 * math.pi**2 / (4 + math.pi),
            16 * math.pi**3 / (4 + math.pi),
        ),
    ],
)
def test_the_laws_have_the_characteristic_values_of_vdi_2143(
    program: CamProgram, law: str, velocity: float, acceleration: float, jerk: float
) -> None:
    """From rest to rest: largest velocity, acceleration and jerk of the normalised law."""
    cam = CamTable(points=REST, segments=(CamSegment.model_validate({"law": law}),), tracks=())
    (curve,) = cam_curves(program, cam, 2).segments
    rise, width = 2.0, 4.0
    assert curve.velocity == pytest.approx(velocity * rise / width, rel=1e-13)
    assert curve.acceleration == pytest.approx(acceleration * rise / width**2, rel=1e-13)
    assert curve.jerk == pytest.approx(jerk * rise / width**3, rel=1e-13)


@pytest.mark.parametrize("samples", [2, 3, 17, 1000])
def test_samples_are_spread_by_width_and_have_all_ends(program: CamProgram, samples: int) -> None:
    cam = CamTable(points=_points((0, 0), (1, 1), (100, 2)), segments=(CamSegment(),) * 2, tracks=())
    narrow, wide = cam_curves(program, cam, samples).segments
    assert (narrow.samples[0, 0], narrow.samples[-1, 0]) == (0, 1)
    assert (wide.samples[0, 0], wide.samples[-1, 0]) == (1, 100)
    assert len(narrow.samples) == max(2, min(samples, 9), round(samples / 100))
    assert len(wide.samples) == max(2, min(samples, 9), round(samples * 0.99))
    assert np.allclose(np.diff(wide.samples[:, 0], 2), 0)


def test_largest_cam_is_drawn(program: CamProgram) -> None:
    random = np.random.default_rng(1)
    points = tuple(CamPoint(x=x, y=y) for x, y in enumerate(random.uniform(-1, 1, 10_000)))
    cam = CamTable(points=points, segments=(CamSegment(),) * 9999, tracks=())
    curves = cam_curves(program, cam, 20_000, [-1.0, 5000.0, 1e9])
    assert sum(len(one.samples) for one in curves.segments) == 19_998
    np.testing.assert_allclose(curves.at[:, 1], [points[0].y, points[5000].y, points[-1].y])
