"""Values of cams of all types against scipy, numpy and the formulas of VDI 2143."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st
from tests.libraries.cam_curves import CUBIC, LINEAR, POLY, POSITIONS, Cams, Numbers, cams

DEFAULT = np.array([(0, 0, 0, 0), (120, 120, 1, 0), (240, 240, 1, 0), (360, 360, 0, 0)], dtype=float)
seeds = st.integers(0, 2**32 - 1)
thorough = settings(max_examples=150, deadline=None)


@pytest.fixture(scope="module")
def given_cams() -> Iterator[Cams]:
    with cams() as found:
        yield found


def _piecewise(points: Numbers) -> Any:
    """By scipy: the polynomials that have the derivatives of the points, in rows, at their first column."""
    from scipy.interpolate import BPoly

    return BPoly.from_derivatives(points[:, 0], points[:, 1:])


def _compare(found: Numbers, expected: Numbers, width: float, tolerance: float = 1e-12) -> None:
    """Derivatives relative to the largest one, and to what the others come to over the width."""
    size = max(np.abs(expected[:, order]).max() * width**order for order in range(expected.shape[1]))
    for order in range(expected.shape[1]):
        np.testing.assert_allclose(
            found[:, order], expected[:, order], rtol=0, atol=tolerance * size / width**order
        )


def _derivatives(curve: Any, x: Numbers) -> Numbers:
    return np.stack([curve(x), *(curve.derivative(order)(x) for order in (1, 2, 3))], axis=1)


def _within(borders: Numbers, random: np.random.Generator) -> Numbers:
    """Positions inside the intervals, where no derivative jumps."""
    first = random.integers(0, len(borders) - 1, POSITIONS)
    return borders[first] + np.diff(borders)[first] * random.uniform(0.001, 0.999, POSITIONS)


def test_the_default_cam_has_the_values_of_the_specification(given_cams: Cams) -> None:
    """Spec cam EX-01."""
    given_cams.xyva(DEFAULT)
    expected = {
        0: (0, 0, 0, 0.0025),
        30: (7.8515625, 0.68359375, 0.0328125, -0.0000520833),
        60: (41.25, 1.4375, 0.0125, -0.0010416667),
        90: (85.4296875, 1.37109375, -0.0140625, -0.00046875),
        120: (120, 1, 0, 0),
        180: (180, 1, 0, 0),
        300: (318.75, 1.4375, -0.0125, -0.0010416667),
        360: (360, 0, 0, 0.0025),
    }
    found = given_cams.values(list(map(float, expected)))
    np.testing.assert_allclose(found, list(expected.values()), rtol=0, atol=1e-9)
    fastest = given_cams.values([72.0])[0]
    assert fastest[1] == pytest.approx(1.512, abs=1e-12)
    assert fastest[2] == pytest.approx(0.0, abs=1e-12)
    assert given_cams.values([29.13])[0][2] == pytest.approx(0.0328352829, abs=1e-8)


def test_test_cam_a_has_the_values_of_the_specification(given_cams: Cams) -> None:
    """Spec ax3000 EX-AX-14: values, largest slope and largest curvature."""
    given_cams.xyva(np.array([(0, 0, 0, 0), (180, 180, 0, 0), (360, 0, 0, 0)], dtype=float))
    expected = {20: 2.0759, 45: 18.63281, 90: 90.0, 100: 108.59625, 120: 142.22222, 180: 180.0, 270: 90.0}
    expected[340] = 2.0759
    found = given_cams.values(list(map(float, expected)))[:, 0]
    np.testing.assert_allclose(found, list(expected.values()), rtol=0, atol=5e-5)
    curve = given_cams.values(np.linspace(0.0, 180.0, POSITIONS).tolist())
    assert given_cams.values([90.0])[0][1] == pytest.approx(1.875, abs=1e-12)
    assert curve[:, 1].max() <= 1.875 + 1e-12
    assert np.abs(curve[:, 2]).max() == pytest.approx(0.032075, abs=1e-5)


def test_a_polynomial_between_two_lines(given_cams: Cams) -> None:
    """Spec cam EX-02: points that stand twice bend the slope."""
    rise = 100 / 140
    given_cams.xyva(
        np.array([(0, 0, rise, 0), (140, 100, rise, 0), (280, 180, -0.5, 0), (360, 140, -0.5, 0)])
    )
    found = given_cams.values([70.0, 210.0, 245.0, 320.0])
    np.testing.assert_allclose(found[0], (50, rise, 0, 0), atol=1e-12)
    np.testing.assert_allclose(found[1][:3], (166.5625, 0.9776786, -0.0130102), atol=1e-7)
    assert found[2][0] == pytest.approx(188.447266, abs=1e-6)
    np.testing.assert_allclose(found[3], (160, -0.5, 0, 0), atol=1e-12)


def test_lines_of_different_slopes_meet_in_a_point_that_stands_twice(given_cams: Cams) -> None:
    given_cams.xyva(np.array([(0, 0, 1, 0), (10, 10, 1, 0), (10, 10, -2, 0), (20, -10, -2, 0)], dtype=float))
    found = given_cams.values([5.0, 9.999, 10.0, 15.0])
    np.testing.assert_allclose(found[:, 0], (5, 9.999, 10, 0), atol=1e-12)
    np.testing.assert_allclose(found[:, 1], (1, 1, -2, -2), atol=1e-9)


@thorough
@given(seed=seeds, count=st.integers(2, 40), scale=st.sampled_from((1e-3, 1.0, 1e4)))
def test_xyva_points_give_the_polynomials_of_scipy(
    given_cams: Cams, seed: int, count: int, scale: float
) -> None:
    random = np.random.default_rng(seed)
    x = np.cumsum(random.uniform(0.5, 2.0, count)) * scale + random.uniform(-10, 10) * scale
    points = np.column_stack(
        [
            x,
            random.uniform(-1, 1, count),
            random.uniform(-1, 1, count) / scale,
            random.uniform(-1, 1, count) / scale**2,
        ]
    )
    given_cams.xyva(points)
    at = _within(x, random)
    _compare(given_cams.values(at), _derivatives(_piecewise(points), at), scale)


@thorough
@given(seed=seeds, count=st.integers(1, 20))
def test_polynomials_give_their_powers(given_cams: Cams, seed: int, count: int) -> None:
    from scipy.interpolate import PPoly

    random = np.random.default_rng(seed)
    x = np.cumsum(random.uniform(0.5, 2.0, count + 1))
    powers = random.uniform(-1, 1, (count, 6))
    elements = np.column_stack([x[:-1], powers]).astype("<f8")
    given_cams.take(POLY, elements.tobytes(), count, (x[0], x[-1]))
    at = _within(x, random)
    _compare(given_cams.values(at), _derivatives(PPoly(powers[:, ::-1].T, x), at), 1.0)


def _table(random: np.random.Generator, kind: str, size: int) -> Numbers:
    """Numbers that a table of the type can hold."""
    if np.issubdtype(np.dtype(kind), np.integer):
        low = 0 if kind.startswith("u") else -20000
        return random.integers(low, 20000, size).astype(float)
    return random.uniform(-100, 100, size).astype(kind).astype(float)


@thorough
@given(
    seed=seeds,
    count=st.integers(2, 256),
    kind=st.sampled_from(("int16", "uint16", "int32", "uint32", "float32", "float64")),
)
@example(seed=1, count=2, kind="float64")
@example(seed=2, count=3, kind="uint16")
def test_equidistant_tables_give_lines_and_cubics(given_cams: Cams, seed: int, count: int, kind: str) -> None:
    from scipy.interpolate import CubicHermiteSpline

    random = np.random.default_rng(seed)
    slaves = _table(random, kind, count)
    limits = [10.0, 370.0, 0.0, 90.0, 0.0, 1000.0, 0.0, 10000.0]
    x = np.linspace(10.0, 370.0, count)
    y = slaves * 90.0 / 10000.0
    at = _within(x, random)
    given_cams.table(slaves, limits, kind, LINEAR)
    found = given_cams.values(at)
    size = np.abs(y).max() + 1.0
    np.testing.assert_allclose(found[:, 0], np.interp(at, x, y), rtol=0, atol=1e-12 * size)
    slope = np.diff(y) / np.diff(x)
    np.testing.assert_allclose(found[:, 1], slope[np.searchsorted(x, at) - 1], atol=1e-11 * size)
    assert not found[:, 2:].any()
    given_cams.table(slaves, limits, kind, CUBIC)
    slopes = np.gradient(y, x, edge_order=2) if count > 2 else np.repeat(slope, 2)
    _compare(given_cams.values(at), _derivatives(CubicHermiteSpline(x, y, slopes), at), 360.0 / count, 1e-11)


@thorough
@given(
    seed=seeds,
    count=st.integers(2, 128),
    kind=st.sampled_from(("int16", "uint16", "int32", "uint32", "float32", "float64")),
)
@example(seed=1, count=2, kind="float64")
def test_tables_of_pairs_give_lines_and_cubics(given_cams: Cams, seed: int, count: int, kind: str) -> None:
    from scipy.interpolate import CubicHermiteSpline

    random = np.random.default_rng(seed)
    masters = np.sort(random.choice(20000, count, replace=False)).astype(float)
    slaves = _table(random, kind, count)
    limits = [0.0, 360.0, 10.0, 110.0, masters[0], masters[-1], 0.0, 20000.0]
    x = (masters - masters[0]) * 360.0 / (masters[-1] - masters[0])
    y = 10.0 + slaves * 100.0 / 20000.0
    at = _within(x, random)
    given_cams.table(np.column_stack([masters, slaves]), limits, kind, LINEAR)
    size = np.abs(y).max() + 1.0
    found = given_cams.values(at)
    np.testing.assert_allclose(found[:, 0], np.interp(at, x, y), rtol=0, atol=1e-11 * size)
    given_cams.table(np.column_stack([masters, slaves]), limits, kind, CUBIC)
    slopes = np.gradient(y, x, edge_order=2) if count > 2 else np.repeat(np.diff(y) / np.diff(x), 2)
    _compare(
        given_cams.values(at), _derivatives(CubicHermiteSpline(x, y, slopes), at), np.diff(x).min(), 1e-9
    )


def test_the_ends_of_a_cam_hold_outside_of_it(given_cams: Cams) -> None:
    given_cams.xyva(DEFAULT)
    np.testing.assert_array_equal(given_cams.values([-1e9, 0.0, 360.0, 1e9])[:, 0], (0, 0, 360, 360))
    given_cams.table(np.array([5.0, 7.0]), [0, 10, 0, 10, 0, 1, 0, 10], "float64", CUBIC)
    np.testing.assert_allclose(given_cams.values([-5.0, 0.0, 10.0, 15.0])[:, 0], (5, 5, 7, 7))


@thorough
@given(seed=seeds, count=st.integers(2, 60))
def test_what_was_asked_before_does_not_matter(given_cams: Cams, seed: int, count: int) -> None:
    random = np.random.default_rng(seed)
    points = random.uniform(-1, 1, (count, 4))
    points[:, 0] = np.cumsum(random.uniform(0.1, 2.0, count))
    given_cams.xyva(points)
    at = random.uniform(points[0, 0] - 1, points[-1, 0] + 1, POSITIONS)
    order = np.argsort(at)
    np.testing.assert_array_equal(given_cams.values(at)[order], given_cams.values(at[order]))


STATE = st.lists(st.floats(-2, 2).map(lambda number: round(number, 3)), min_size=4, max_size=4)
WIDTH = 2.5


def _segment(law: str, left: list[float], right: list[float], inflection: float = 0.5) -> Any:
    return (law, [1.0, *left], [1.0 + WIDTH, *right], inflection)


@pytest.mark.parametrize(("law", "derivatives"), [("Line", 1), ("Poly3", 2), ("Poly5", 3), ("Poly7", 4)])
@settings(max_examples=60, deadline=None)
@given(left=STATE, right=STATE)
def test_polynomial_laws_meet_the_states_at_their_ends(
    given_cams: Cams, law: str, derivatives: int, left: list[float], right: list[float]
) -> None:
    given_cams.segments(_segment(law, left, right))
    at = np.linspace(1.0, 1.0 + WIDTH, POSITIONS)
    points = np.array([[1.0, *left[:derivatives]], [1.0 + WIDTH, *right[:derivatives]]])
    expected = _derivatives(_piecewise(points), at)
    _compare(given_cams.values(at), expected, WIDTH, 1e-12 if expected.any() else 1.0)


@settings(max_examples=60, deadline=None)
@given(left=STATE, right=STATE)
def test_harmonics_meet_the_states_at_their_ends(
    given_cams: Cams, left: list[float], right: list[float]
) -> None:
    """The six coefficients by numpy from the six conditions."""
    given_cams.segments(_segment("Harmonic", left, right))
    at = np.linspace(1.0, 1.0 + WIDTH, POSITIONS)
    s = (at - 1.0) / WIDTH

    def basis(order: int, s: Numbers) -> Numbers:
        """The functions' derivatives, in columns."""
        line = [np.ones_like(s), s] if order == 0 else [np.zeros_like(s), np.full_like(s, float(order == 1))]
        waves = [
            (k * np.pi) ** order * wave(k * np.pi * s + order * np.pi / 2)
            for k in (1, 2)
            for wave in (np.cos, np.sin)
        ]
        return np.stack([*line, *waves], axis=1) / WIDTH**order

    ends = np.array([0.0, 1.0])
    conditions = np.concatenate([basis(order, ends) for order in (0, 1, 2)])
    wanted = np.array([[a, b] for a, b in zip(left[:3], right[:3], strict=True)]).ravel()
    coefficients = np.linalg.solve(conditions, wanted)
    expected = np.stack([basis(order, s) @ coefficients for order in range(4)], axis=1)
    _compare(given_cams.values(at), expected, WIDTH, 1e-12 if expected.any() else 1.0)


def _rest_to_rest(given_cams: Cams, law: str, s: Numbers) -> Numbers:
    """A segment from 0 to 1 over a width of 1."""
    given_cams.segments((law, [0.0] * 5, [1.0, 1.0, 0.0, 0.0, 0.0], 0.5))
    return given_cams.values(s)


def test_sines_have_the_formulas_of_vdi_2143(given_cams: Cams) -> None:
    s = np.linspace(0.0, 1.0, POSITIONS)
    pi = np.pi
    sine = [(1 - np.cos(pi * s)) / 2, pi / 2 * np.sin(pi * s), pi**2 / 2 * np.cos(pi * s)]
    sine.append(-(pi**3) / 2 * np.sin(pi * s))
    _compare(_rest_to_rest(given_cams, "Sine", s), np.stack(sine, axis=1), 1.0)
    inclined = [s - np.sin(2 * pi * s) / (2 * pi), 1 - np.cos(2 * pi * s)]
    inclined += [2 * pi * np.sin(2 * pi * s), 4 * pi**2 * np.cos(2 * pi * s)]
    _compare(_rest_to_rest(given_cams, "InclinedSine", s), np.stack(inclined, axis=1), 1.0)


def test_the_modified_sine_has_the_formulas_of_vdi_2143(given_cams: Cams) -> None:
    """In eighths: a quarter of a sine, the middle one of three times its length, a quarter again."""
    s = np.linspace(0.0, 1.0, POSITIONS)
    pi = np.pi
    first = pi * s - np.sin(4 * pi * s) / 4
    middle = 2 + pi * s - 9 / 4 * np.sin((4 * pi * s + pi) / 3)
    last = 4 + pi * s - np.sin(4 * pi * s) / 4
    y = np.select([s <= 1 / 8, s <= 7 / 8], [first, middle], last) / (4 + pi)
    found = _rest_to_rest(given_cams, "ModifiedSine", s)
    np.testing.assert_allclose(found[:, 0], y, rtol=0, atol=1e-13)
    assert np.abs(found[:, 1]).max() == pytest.approx(1.7596, abs=2e-4)
    assert np.abs(found[:, 2]).max() == pytest.approx(5.5280, abs=2e-4)
    assert np.abs(found[:, 3]).max() == pytest.approx(69.466, abs=2e-2)


@settings(max_examples=60, deadline=None)
@given(left=STATE, right=STATE, inflection=st.floats(0.1, 0.9))
def test_a_modified_sine_meets_velocities_and_its_inflection_point(
    given_cams: Cams, left: list[float], right: list[float], inflection: float
) -> None:
    """Its acceleration, of the given shape and integrated by scipy, gives its velocity and position."""
    from scipy.integrate import quad

    given_cams.segments(_segment("ModifiedSine", left, right, inflection))
    turn = 1.0 + inflection * WIDTH
    ends = given_cams.values([1.0, turn, 1.0 + WIDTH])
    np.testing.assert_allclose(ends[0, :3], (left[0], left[1], 0), atol=1e-11)
    np.testing.assert_allclose(ends[2, :3], (right[0], right[1], 0), atol=1e-11)
    assert ends[1, 2] == pytest.approx(0.0, abs=1e-11)
    peaks = given_cams.values([1.0 + inflection * WIDTH / 4, 1.0 + WIDTH - (1 - inflection) * WIDTH / 4])[
        :, 2
    ]

    def acceleration(x: float) -> float:
        up, way = (
            (0, (x - 1.0) / (inflection * WIDTH))
            if x <= turn
            else (1, (1.0 + WIDTH - x) / ((1 - inflection) * WIDTH))
        )
        shape = np.sin(2 * np.pi * way) if way <= 0.25 else np.cos(2 * np.pi / 3 * (way - 0.25))
        return float(peaks[up] * shape)

    borders = [1.0 + inflection * WIDTH / 4, turn, 1.0 + WIDTH - (1 - inflection) * WIDTH / 4]
    at = [*np.linspace(1.0, 1.0 + WIDTH, 7)[1:]]
    found = given_cams.values(at)
    for x, (y, v, a, _) in zip(at, found, strict=True):
        inside = [border for border in borders if border < x]
        gain = quad(acceleration, 1.0, x, points=inside, epsabs=1e-12)[0]
        way = quad(lambda t, x=x: (x - t) * acceleration(t), 1.0, x, points=inside, epsabs=1e-12)[0]
        assert a == pytest.approx(acceleration(x), abs=1e-9)
        assert v == pytest.approx(left[1] + gain, abs=1e-9)
        assert y == pytest.approx(left[0] + left[1] * (x - 1.0) + way, abs=1e-9)


def test_segments_follow_each_other(given_cams: Cams) -> None:
    given_cams.segments(
        ("Line", [0.0] * 5, [1.0, 2.0, 0.0, 0.0, 0.0], 0.5),
        ("Poly5", [1.0, 2.0, 2.0, 0.0, 0.0], [3.0, 0.0, 0.0, 0.0, 0.0], 0.5),
        ("Sine", [3.0, 0.0, 0.0, 0.0, 0.0], [4.0, 1.0, 0.0, 0.0, 0.0], 0.5),
    )
    found = given_cams.values([0.5, 1.0, 3.0, 3.5, 4.0, 5.0])[:, 0]
    np.testing.assert_allclose(found, (1.0, 2.0, 0.0, 0.5, 1.0, 1.0), atol=1e-12)
