"""SM3_CNC: additional axes over several objects (SMC_SmoothAddAxes, SMC_RecomputeABCSlopes), cubic axes."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.interpolate import CubicHermiteSpline
from tests.libraries.cnc_chain import Block, length_of, through
from tests.libraries.cnc_paths import INITPOS, LIN, LINPOS, MCOMMAND, Geo, line, position
from tests.libraries.st_program import run
from tests.libraries.test_cnc_preprocessing_random import paths

SLOPES = Block("SMC_RecomputeABCSlopes")
SMOOTH = Block("SMC_SmoothAddAxes")
CUBIC = 0b111000


def axis_of(geo: Geo, axis: int) -> CubicHermiteSpline:
    """The way of an axis by the length in the object."""
    size = length_of(geo)
    if axis in (3, 4, 5) and int(geo.member("wCubic")) >> axis & 1:
        slopes = [geo.member(f"{name}[{axis - 3}]") / size for name in ("adSlopeStart", "adSlopeEnd")]
    else:
        slopes = [(geo.end[axis] - geo.start[axis]) / size] * 2
    return CubicHermiteSpline([0, size], [geo.start[axis], geo.end[axis]], slopes)


def straight(lengths: list[float], axes: list[float], axis: int, **members: float) -> list[Geo]:
    """Lines along X whose axis is at `axes` behind each."""
    found, x, value = [], 0.0, 0.0
    for size, target in zip(lengths, axes, strict=True):
        geo = line(position(x), position(x + size), dVel=10.0, dVelEnd=10.0, **members)
        geo.start[axis], geo.end[axis] = value, target
        x, value = x + size, target
        found.append(geo)
    return found


size = st.floats(0.5, 20).map(lambda value: round(value, 2))
target = st.floats(-50, 50).map(lambda value: round(value, 2))


@settings(max_examples=20, deadline=None)
@given(st.lists(st.tuples(size, target), min_size=1, max_size=8), st.sampled_from([3, 4, 5]))
def test_slopes(pieces: list[tuple[float, float]], axis: int) -> None:
    """Catalog: the mean of the neighbours weighted with the length, 0 at both ends; the values stay."""
    objects = straight([a for a, _ in pieces], [b for _, b in pieces], axis)
    found = through(objects, SLOPES).objects
    values = [0.0, *(b for _, b in pieces)]
    sizes = [a for a, _ in pieces]
    inner = [(values[n + 2] - values[n]) / (sizes[n] + sizes[n + 1]) for n in range(len(pieces) - 1)]
    for geo, first, second in zip(found, [0.0, *inner], [*inner, 0.0], strict=True):
        way = axis_of(geo, axis)
        assert float(way(0, 1)) == pytest.approx(first, abs=1e-12)
        assert float(way(length_of(geo), 1)) == pytest.approx(second, abs=1e-12)
        assert int(geo.member("wCubic")) == CUBIC
    for before, after in zip(objects, found, strict=True):
        np.testing.assert_array_equal((before.start, before.end), (after.start, after.end))
    again = through(found, SLOPES).objects
    assert [geo.members for geo in again] == [geo.members for geo in found]


@pytest.mark.parametrize("stop", ["corner", "rapid", "function", "end velocity", "set position"])
def test_no_slope_where_the_path_stops(stop: str) -> None:
    objects = straight([10.0] * 4, [5.0, 10.0, 15.0, 20.0], 3)
    inserted: list[Geo] = []
    if stop == "corner":
        objects[2].end[1], objects[3].start[1], objects[3].end[1] = 5.0, 5.0, 10.0
    elif stop == "function":
        inserted = [Geo(MCOMMAND, objects[1].end, objects[1].end, {"iHelpID[0]": 4.0})]
    elif stop == "end velocity":
        objects[1].members["dVelEnd"] = 0.0
    else:
        objects[2].kind = LINPOS if stop == "rapid" else INITPOS
    found = [
        geo
        for geo in through([*objects[:2], *inserted, *objects[2:]], SLOPES).objects
        if geo.kind != MCOMMAND
    ]
    assert [geo.member("adSlopeEnd[0]") for geo in found][:3] == [
        5.0,
        0.0,
        0.0 if stop in ("rapid", "set position") else pytest.approx(found[2].member("adSlopeEnd[0]")),
    ]
    assert found[2].member("adSlopeStart[0]") == 0.0


@settings(max_examples=25, deadline=None)
@given(st.lists(st.tuples(size, target), min_size=3, max_size=9), st.integers(3, 10), st.data())
def test_a_range_of_an_axis(pieces: list[tuple[float, float]], axis: int, data: st.DataObject) -> None:
    """P to W one slope over the range; A, B, C the cubic with the slopes of the neighbours."""
    first = data.draw(st.integers(0, len(pieces) - 1), label="first")
    last = data.draw(st.integers(first, len(pieces) - 1), label="last")
    objects = straight([a for a, _ in pieces], [b for _, b in pieces], axis)
    for geo in objects[first : last + 1]:
        geo.members["wSmoothAxes"] = float(1 << axis)
    found = through(objects, SMOOTH).objects
    assert len(found) == len(objects)
    values = [0.0, *(b for _, b in pieces)]
    whole = sum(a for a, _ in pieces[first : last + 1])

    def slope(n: int) -> float:
        return (values[n + 1] - values[n]) / pieces[n][0]

    if axis <= 5:
        ends = [slope(first - 1) if first > 0 else 0.0, slope(last + 1) if last + 1 < len(pieces) else 0.0]
    else:
        ends = [(values[last + 1] - values[first]) / whole] * 2
    expected = CubicHermiteSpline([0, whole], [values[first], values[last + 1]], ends)
    gone = 0.0
    for geo in found[first : last + 1]:
        for u in np.linspace(0, 1, 5):
            s = u * length_of(geo)
            assert float(axis_of(geo, axis)(s)) == pytest.approx(float(expected(gone + s)), abs=1e-9)
        gone += length_of(geo)
    for n in [*range(first), *range(last + 1, len(pieces))]:
        np.testing.assert_array_equal((found[n].start, found[n].end), (objects[n].start, objects[n].end))


def test_ranges_of_two_axes_overlap() -> None:
    """The example of today's documentation: G71 L8 around G71 L4."""
    objects = straight([100.0, 100, 50, 50, 50, 50, 100], [0.0, 0, 0, 0, 0, 100, 100], 3)
    for n, geo in enumerate(objects):
        geo.start[7], geo.end[7] = (0 if n == 0 else 100), (100 if n < 6 else 0)
        geo.members["wSmoothAxes"] = float((0x80 if n > 0 else 0) | (0x08 if 2 <= n < 6 else 0))
    found = through(objects, SMOOTH).objects
    ways = [axis_of(geo, 7) for geo in found[1:]]
    assert {round(float(way(0, 1)), 12) for way in ways} == {-0.25}
    expected = CubicHermiteSpline([0, 200], [0, 100], [0, 0])
    assert [geo.end[3] for geo in found[2:6]] == pytest.approx(
        [float(expected(s)) for s in (50, 100, 150, 200)]
    )


def test_m_functions_and_synchronisations_in_a_range() -> None:
    """An M function lies in it; a synchronisation ends it: who made the path waits for it."""
    objects = straight([10.0] * 4, [0.0, 0.0, 0.0, 40.0], 6, wSmoothAxes=64.0)
    function = Geo(MCOMMAND, objects[0].end, objects[0].end, {"iHelpID[0]": 4.0, "wSmoothAxes": 64.0})
    found = through([objects[0], function, *objects[1:]], SMOOTH).objects
    assert [geo.end[6] for geo in found] == pytest.approx([10, 10, 20, 30, 40])
    function.members["iHelpID[0]"] = -2.0
    found = through([*objects[:3], function, *objects[3:]], SMOOTH).objects
    assert [geo.end[6] for geo in found] == pytest.approx([0, 0, 0, 0, 40])


@pytest.mark.parametrize(("count", "error"), [(7, 0), (8, 10030)])
def test_a_range_longer_than_the_buffer(count: int, error: int) -> None:
    """Catalog: a buffer for n objects has room for a range of n - 3."""
    objects = straight([1.0] * count, [float(n) for n in range(count)], 6, wSmoothAxes=64.0)
    free = straight([1.0], [0.0], 6)
    result = through([*objects, *free], SMOOTH, capacity=10, cycles=50)
    assert result.error == error
    assert len(result.objects) == (count + 1 if error == 0 else 0)


@pytest.mark.slow
@settings(max_examples=8, deadline=None)
@given(
    paths(marks=0),
    st.lists(st.sampled_from([0, 8, 64, 72]), min_size=25, max_size=25),
    st.sampled_from([9, 12, 20]),
)
def test_ranges_in_a_small_buffer(objects: list[Geo], ranges: list[int], capacity: int) -> None:
    """Ranges of at most five objects come out of any buffer as of a large one."""
    run_of = 0
    for geo, axes in zip(objects, ranges, strict=False):
        run_of = run_of + 1 if axes and run_of < 5 else 0
        geo.members["wSmoothAxes"] = float(axes if run_of else 0)
    large = through(objects, SMOOTH)
    small = through(objects, SMOOTH, capacity=capacity, gives=2, takes=1, cycles=600)
    assert small.literals == large.literals
    moving = [geo for geo in large.objects if geo.kind != MCOMMAND]
    for first, second in pairwise(moving):
        np.testing.assert_allclose(first.end, second.start, atol=1e-9)


POINTS = 9
PROGRAM = f"""
PROGRAM Main
VAR
    geo  : SMC_GEOINFO;
    cut, back : SMC_GEOINFO;
    pi   : SMC_POSINFO;
    n, nAxis : INT;
    dFrom, dTo : LREAL;
    aPoints, aCut, aBack : ARRAY[0..{3 * POINTS - 1}] OF LREAL;
    aMin, aMax : ARRAY[0..2] OF LREAL;
    dVel, dAccel : LREAL;
END_VAR
VAR_TEMP
    pAxes : POINTER TO ARRAY[0..11] OF LREAL;
END_VAR
SMC_CalcLengthGeo(ADR(geo));
cut := geo;
CutTo(ADR(cut), dFrom * geo.dLength, dTo * geo.dLength);
back := ReversedObject(ADR(geo), 0);
FOR n := 0 TO {POINTS - 1} DO
    PathPoint(ADR(geo), geo.dLength * n / {POINTS - 1}.0, pi);
    Store(pi, aPoints);
    PathPoint(ADR(cut), cut.dLength * n / {POINTS - 1}.0, pi);
    Store(pi, aCut);
    PathPoint(ADR(back), geo.dLength * n / {POINTS - 1}.0, pi);
    Store(pi, aBack);
END_FOR
FOR nAxis := 0 TO 2 DO
    PathExtremes(ADR(geo), nAxis + 3, dMin => aMin[nAxis], dMax => aMax[nAxis]);
END_FOR
geo.dVel := 1E9;
geo.dAccel := 1E9;
LimitByAxis(ADR(geo), 3, 10.0, 20.0, 20.0);
END_PROGRAM

METHOD Store
VAR_IN_OUT
    piAt   : SMC_POSINFO;
    aPlace : ARRAY[0..{3 * POINTS - 1}] OF LREAL;
END_VAR
aPlace[3 * n] := piAt.dA;
aPlace[3 * n + 1] := piAt.dB;
aPlace[3 * n + 2] := piAt.dC;
END_METHOD
"""


@settings(max_examples=30, deadline=None)
@given(
    st.lists(target, min_size=12, max_size=12),
    st.floats(0, 0.4),
    st.floats(0.5, 1),
    st.sampled_from([0.5, 3.0, 80.0]),
)
def test_cubic_axes(numbers: list[float], first: float, last: float, length: float) -> None:
    """A, B, C of the interpolator, of a piece, of the way back, their extremes and limits, against scipy."""
    geo = line(position(), position(length), LIN)
    geo.start[3:6], geo.end[3:6] = numbers[:3], numbers[3:6]
    geo.members |= {f"adSlopeStart[{k}]": numbers[6 + k] for k in range(3)}
    geo.members |= {f"adSlopeEnd[{k}]": numbers[9 + k] for k in range(3)}
    geo.members |= {"wCubic": float(CUBIC), "dLength": length}
    with run(PROGRAM, cycles=0, inside="SM3_CNC") as program:
        program.set("Main", dFrom=first, dTo=last)
        program.set("Main", **{f"geo.{name}": value for name, value in geo.values().items()})
        program.cycle()
        arrays = {
            name: np.array(program.numbers(f"Main.{name}")).reshape(POINTS, 3)
            for name in ("aPoints", "aCut", "aBack")
        }
        low, high = (program.numbers(f"Main.{name}") for name in ("aMin", "aMax"))
        velocity, acceleration = (float(program.literal(f"Main.geo.{name}")) for name in ("dVel", "dAccel"))
    shares = np.linspace(0, 1, POINTS)
    ways = [axis_of(geo, axis) for axis in (3, 4, 5)]
    for k, way in enumerate(ways):
        np.testing.assert_allclose(arrays["aPoints"][:, k], way(shares * length), atol=1e-9)
        np.testing.assert_allclose(arrays["aBack"][:, k], way((1 - shares) * length), atol=1e-9)
        np.testing.assert_allclose(
            arrays["aCut"][:, k], way((first + shares * (last - first)) * length), atol=1e-9
        )
        dense = way(np.linspace(0, length, 4001))
        assert (low[k], high[k]) == pytest.approx((dense.min(), dense.max()), abs=1e-4)
    slopes, bends = (np.abs(ways[0](np.linspace(0, length, 4001), n)) for n in (1, 2))
    assert (slopes * velocity).max() <= 10 * (1 + 1e-9)
    assert (bends * velocity**2 + slopes * acceleration).max() <= 20 * (1 + 1e-9)
