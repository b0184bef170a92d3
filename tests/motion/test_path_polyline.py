"""Pieces of lines of path objects lie on the path, as near as they are to: against numpy and scipy."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from tests.libraries.cnc_paths import (
    CCLW,
    CLW,
    INITPOS,
    LINADDAXES,
    LINNODELTA,
    MCOMMAND,
    Geo,
    arc,
    ellipse,
    line,
    position,
    spline,
)
from tests.motion.path_objects import geo_info

from tappet.codegen.build import BuildOptions, LibraryReference, build_application
from tappet.iec.task import Task
from tappet.lang.source import Source
from tappet.motion.paths.geo_info import GEO_INFO
from tappet.motion.paths.polyline import polyline, tolerance_for

size = st.floats(0.1, 100.0)
place = st.floats(-100.0, 100.0)
angle = st.floats(-360.0, 360.0)
swept = st.floats(1.0, 1080.0).flatmap(lambda value: st.sampled_from([value, -value]))
factor = st.floats(-20.0, 20.0)


def in_plane(letters: str, kind: int) -> Geo:
    """A quarter of a helix in the plane of G17, G18 or G19."""
    axis = dict(zip("XYZ", np.eye(3), strict=True))
    along, across = axis[letters[0]], axis[letters[1]]
    sign = 1.0 if kind == CLW else -1.0
    geo = Geo(
        kind, position(), position(), {"dP1": 3.0, "dP2": 4.0, "dP3": 10.0, "dT1": 30.0, "dT2": 90 * sign}
    )
    geo.space, geo.plane = True, (along, across)
    geo.end[:3] = 7.0 * np.cross(along, across)
    geo.start[:3], geo.end[:3] = geo.curve(0.0), geo.curve(1.0)
    return geo


curves = st.one_of(
    st.builds(lambda x, y, r, a, s: arc((x, y), r, a, s), place, place, size, angle, swept),
    st.builds(
        lambda x, y, r, q, t, a, s: ellipse((x, y), (r, q * r), t, a, s),
        place, place, size, st.floats(0.05, 1.0), angle, angle, swept,
    ),
    st.builds(spline, *(st.lists(factor, min_size=4, max_size=4),) * 3),
    st.builds(spline, *(st.lists(factor, min_size=6, max_size=6),) * 2),
    st.builds(in_plane, st.sampled_from(["XY", "ZX", "YZ"]), st.sampled_from([CLW, CCLW])),
)  # fmt: skip


@given(curves, st.sampled_from([1e-3, 1e-4]))
def test_points_lie_on_the_curve_and_pieces_near_it(geo: Geo, tolerance: float) -> None:
    path = polyline([geo_info([geo])], tolerance)
    pieces = len(path.of)
    extent = 3 if geo.space else 2
    exact = np.array([geo.curve(n / pieces) for n in range(pieces + 1)])
    whole = float(np.abs(exact).max()) + 1.0
    assert np.abs(path.points[:, :extent] - exact[:, :extent]).max() < 1e-9 * whole
    middle = np.array([geo.curve((n + 0.5) / pieces) for n in range(0, pieces, max(1, pieces // 20))])
    chord = (path.points[:-1] + path.points[1:])[:: max(1, pieces // 20)] / 2
    reach = max(geo.member("dP3"), geo.member("dP5")) if geo.kind != 5 else geo.length()
    # A spline may run back over itself; then its bound is that of its whole way there and back.
    reach = max(reach, 0.0) if geo.kind != 5 else reach + sum(abs(v) for v in geo.members.values()) * 10
    assert np.linalg.norm((middle - chord)[:, :extent], axis=1).max() <= 1.01 * tolerance * reach + 1e-12


@given(curves)
def test_curvature_is_that_of_differences(geo: Geo) -> None:
    path = polyline([geo_info([geo])], 1e-4)
    pieces = len(path.of)
    n = pieces // 2
    u, h = (n + 0.5) / pieces, 1e-4
    first = geo.slope(u)
    second = (geo.curve(u + h) - 2 * geo.curve(u) + geo.curve(u - h)) / h**2
    speed = float(np.linalg.norm(first))
    if speed < 0.1:
        return
    expected = float(np.linalg.norm(np.cross(first, second))) / speed**3
    assert path.bend[n] == pytest.approx(expected, rel=1e-3, abs=1e-3)


@given(st.lists(curves, min_size=1, max_size=8), st.integers(1, 8))
def test_parts_are_as_the_whole(objects: list[Geo], length: int) -> None:
    whole = geo_info(objects)
    parts = [whole[n : n + length] for n in range(0, len(whole), length)]
    one, other = polyline([whole], 1e-3), polyline(parts, 1e-3)
    for name in ("points", "of", "bend", "kind", "line", "first"):
        np.testing.assert_array_equal(getattr(one, name), getattr(other, name))


def test_what_touches_is_one_row_and_what_does_not_has_a_gap() -> None:
    objects = [
        line(position(0, 0), position(10, 0)),
        line(position(10, 0), position(10, 5)),
        line(position(20, 5), position(20, 8)),
    ]
    path = polyline([geo_info(objects)], 1e-3)
    assert path.of.tolist() == [0, 1, -1, 2]
    assert path.points[:, 0].tolist() == [0, 10, 10, 20, 20]
    assert path.points_of(2).tolist() == [[20, 5, 0], [20, 8, 0]]


def test_blind_positioning_and_m_functions_draw_nothing() -> None:
    objects = [
        Geo(INITPOS, position(), position(5, 5)),
        line(position(5, 5), position(5, 9)),
        Geo(MCOMMAND, position(5, 9), position(5, 9)),
        Geo(LINADDAXES, position(5, 9), position(5, 9, dA1=3)),
        Geo(LINNODELTA, position(5, 9), position(5, 9, 4)),
    ]
    path = polyline([geo_info(objects)], 1e-3)
    assert path.of.tolist() == [1, 4]
    assert path.points.tolist() == [[5, 5, 0], [5, 9, 0], [5, 9, 4]]
    assert path.points_of(2).tolist() == [[5, 9, 0]]


def test_z_of_an_ellipse_in_2d_mode_grows_with_its_length() -> None:
    geo = ellipse((0, 0), (10, 2), 0.0, 0.0, -180.0)
    geo.end[2] = 6.0
    path = polyline([geo_info([geo])], 1e-5)
    pieces = len(path.of)
    for share in (0.125, 0.25, 0.5, 0.8):
        n = round(share * pieces)
        assert path.points[n, 2] == pytest.approx(6.0 * geo.length(n / pieces) / geo.length(), abs=1e-3)


def test_z_in_an_s_shape() -> None:
    objects = geo_info([arc((0, 0), 10, 0, -180)])
    objects["piDestPos"]["dZ"], objects["piDestPos"]["wSProfile"] = 8.0, 4
    path = polyline([objects], 1e-4)
    u = np.arange(len(path.of) + 1) / len(path.of)
    np.testing.assert_allclose(path.points[:, 2], 8 * (6 * u**5 - 15 * u**4 + 10 * u**3), atol=1e-9)


def test_length_of_worked_examples() -> None:
    """cnc EX-16, EX-20."""
    objects = [arc((150, 100), 50, 180, 180), ellipse((0, 0), (100, 50), 0, 0, -90)]
    path = polyline([geo_info(objects)], tolerance_for(2))
    for number, length in enumerate((157.0796, 121.1056)):
        points = path.points_of(number)
        assert np.linalg.norm(np.diff(points, axis=0), axis=1).sum() == pytest.approx(length, abs=1e-3)
    assert path.points_of(0)[:, 1].max() == pytest.approx(150, abs=1e-3)


def test_no_objects() -> None:
    path = polyline([], 1e-3)
    assert (path.count, path.points.shape, path.first.tolist()) == (0, (0, 3), [0])


def test_absurd_numbers_do_not_hang() -> None:
    objects = geo_info([arc((0, 0), math.inf, 0, 1e300), spline([1e300] * 4, [math.nan] * 4)])
    with np.errstate(all="ignore"):
        assert len(polyline([objects], 1e-6).of) <= 3 * 4096


def test_objects_are_laid_out_as_those_of_the_library() -> None:
    text = "PROGRAM Main\nVAR geo : SMC_GEOINFO; END_VAR\nEND_PROGRAM\n"
    options = BuildOptions(libraries=(LibraryReference("SM3_CNC"),), once=True)
    task = Task("Task", interval_ns=1_000_000, programs=("Main",))
    package = build_application([Source("main.st", text)], [task], options=options).package
    assert package is not None
    compiled = package.symbols.resolve("Main.geo")
    assert compiled.size == GEO_INFO.itemsize
    assert GEO_INFO.fields is not None
    assert {m.name: m.offset for m in compiled.type.members} == {
        name: found[1] for name, found in GEO_INFO.fields.items()
    }
