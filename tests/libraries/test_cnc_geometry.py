"""SM3_CNC: length, points, tangents and curvature of path objects, against numpy and scipy."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from tests.libraries.cnc_paths import (
    AXES,
    CCLW,
    CLW,
    INITPOS,
    LIN,
    LINADDAXES,
    LINNODELTA,
    LINPOS,
    MCOMMAND,
    Geo,
    arc,
    ellipse,
    line,
    position,
    spline,
)
from tests.libraries.st_program import Program, run

SAMPLES = 9
PROGRAM = f"""
PROGRAM Main
VAR
    geo     : SMC_GEOINFO;
    pi      : SMC_POSINFO;
    pAxes   : POINTER TO ARRAY[0..11] OF LREAL;
    v       : SMC_VECTOR3D;
    n, k    : DINT;
    xLength, xStart, xEnd : BOOL;
    dS      : LREAL;
    aU, aCurvature : ARRAY[0..{SAMPLES - 1}] OF LREAL;
    aPoints        : ARRAY[0..{SAMPLES * 12 - 1}] OF LREAL;
    aTangents      : ARRAY[0..{SAMPLES * 3 - 1}] OF LREAL;
END_VAR
xLength := SMC_CalcLengthGeo(ADR(geo));
FOR n := 0 TO {SAMPLES - 1} DO
    dS := geo.dLength * n / {SAMPLES - 1}.0;
    pi.wAuxData := 0;
    PathPoint(ADR(geo), dS, pi);
    aU[n] := ParameterAt(ADR(geo), dS);
    aCurvature[n] := CurvatureAt(ADR(geo), ParameterAt(ADR(geo), dS));
    v := PathTangent(ADR(geo), dS);
    aTangents[3 * n] := v.dX;
    aTangents[3 * n + 1] := v.dY;
    aTangents[3 * n + 2] := v.dZ;
    pAxes := AxesOf(pi);
    FOR k := 0 TO 11 DO
        aPoints[12 * n + k] := pAxes^[k];
    END_FOR
END_FOR
xStart := SMC_CalcStartPnt(ADR(geo));
xEnd := SMC_CalcEndPnt(ADR(geo));
END_PROGRAM
"""

number = st.floats(-100, 100).map(lambda value: round(value, 3))
positive = st.floats(0.1, 200).map(lambda value: round(value, 3))
angle = st.floats(-360, 360).map(lambda value: round(value, 2))
swept = st.floats(1, 700).map(lambda value: round(value, 2)) | st.floats(-700, -1).map(
    lambda value: round(value, 2)
)
PLANES = [
    ([1.0, 0, 0], [0, 1.0, 0]),
    ([0, 0, 1.0], [1.0, 0, 0]),
    ([0, 1.0, 0], [0, 0, 1.0]),
    ([0.6, 0.8, 0], [0, 0, 1.0]),
]


@st.composite
def objects(draw: st.DrawFn) -> Geo:
    """Any object that moves, with further axes."""
    kind = draw(st.sampled_from(["line", "arc", "helix", "ellipse", "spline", "space spline"]))
    if kind == "line":
        found = line(position(*(draw(number) for _ in range(3))), position(*(draw(number) for _ in range(3))))
        found.space = draw(st.booleans())
    elif kind == "arc":
        found = arc((draw(number), draw(number)), draw(positive), draw(angle), draw(swept))
    elif kind == "helix":
        found = arc((draw(number), draw(number)), draw(positive), draw(angle), draw(swept))
        found.space = True
        along, across = draw(st.sampled_from(PLANES))
        found.plane = (np.array(along), np.array(across))
        normal = np.cross(along, across)
        for place, u in ((found.start, 0.0), (found.end, 1.0)):
            place[:3] = 0.0
            place[:3] = found.curve(u) + normal * draw(number)
    elif kind == "ellipse":
        main = draw(positive)
        found = ellipse(
            (draw(number), draw(number)),
            (main, main * draw(st.floats(0.01, 1))),
            draw(angle),
            draw(angle),
            draw(swept),
        )
    else:
        size = draw(st.sampled_from([4, 6]))
        x, y, z = ([draw(number) for _ in range(size)] for _ in range(3))
        found = spline(x, y, z if kind == "space spline" else None, dT2=draw(st.sampled_from([1.0, 0.4])))
    for axis in range(3 if found.space else 2, 12):
        found.start[axis], found.end[axis] = draw(number), draw(number)
    return found


def load(program: Program, geo: Geo) -> None:
    program.set("Main", **{f"geo.{name}": value for name, value in geo.values().items()})
    program.cycle()


@settings(max_examples=40, deadline=None)
@given(objects(), st.integers(0, 0xFFF))
def test_any_object_is_where_its_formulas_say(geo: Geo, s_shaped: int) -> None:
    """Spec cnc_runtime 2, GEO-02, GEO-08 to GEO-11, CNCR-126, CNCR-C18: lengths and points by quadrature."""
    length = geo.length()
    assume(length > 1e-3)
    scale = max(1.0, float(np.abs(geo.start).max()), float(np.abs(geo.end).max()), length)
    with run(PROGRAM, cycles=0, inside="SM3_CNC") as program:
        program.set("Main", **{"geo.piStartPos.wSProfile": s_shaped})
        load(program, geo)
        assert program.literal("Main.xLength") == "TRUE"
        found = float(program.literal("Main.geo.dLength"))
        us = program.numbers("Main.aU")
        points = np.array(program.numbers("Main.aPoints")).reshape(SAMPLES, 12)
        tangents = np.array(program.numbers("Main.aTangents")).reshape(SAMPLES, 3)
        curvatures = program.numbers("Main.aCurvature")
        ends = [
            [float(program.literal(f"Main.geo.{place}.{axis}")) for axis in AXES[:3]]
            for place in ("piStartPos", "piDestPos")
        ]
    assert found == pytest.approx(length, rel=1e-9, abs=1e-12)
    np.testing.assert_allclose(ends, [geo.start[:3], geo.end[:3]], atol=1e-10 * scale)
    for n, (u, point) in enumerate(zip(us, points, strict=True)):
        share = n / (SAMPLES - 1)
        assert geo.length(u) == pytest.approx(share * length, abs=1e-9 * scale)
        place = geo.curve(u)
        np.testing.assert_allclose(point[:2], place[:2], atol=1e-9 * scale)
        for axis in range(2, 12):
            if axis == 2 and geo.space:
                assert point[2] == pytest.approx(place[2], abs=1e-9 * scale)
                continue
            way = np.polyval([6, -15, 10, 0, 0, 0], share) if s_shaped >> axis & 1 else share
            expected = geo.start[axis] + way * (geo.end[axis] - geo.start[axis])
            assert point[axis] == pytest.approx(expected, abs=1e-10 * scale)
        slope = geo.slope(u)
        speed = float(np.linalg.norm(slope))
        if speed > 1e-2 * length:
            np.testing.assert_allclose(tangents[n], slope / speed, atol=1e-7)
            turned = bend(geo, u)
            if float(np.linalg.norm(turned)) < 50 / length:
                side = float(turned @ np.cross(*geo.plane))
                sign = 1.0 if side >= -1e-12 else -1.0
                expected = sign * float(np.linalg.norm(turned))
                assert curvatures[n] == pytest.approx(expected, rel=1e-4, abs=1e-5 / length)


def bend(geo: Geo, u: float) -> np.ndarray:
    """The change of the tangent by the length of the path, as the vector it turns about."""
    h = 1e-3
    steps = {1: 4 / 5, 2: -1 / 5, 3: 4 / 105, 4: -1 / 280}
    slope = geo.slope(u)
    second = sum(
        ((c / h) * (geo.slope(u + k * h) - geo.slope(u - k * h)) for k, c in steps.items()), np.zeros(3)
    )
    return np.cross(slope, second) / float(np.linalg.norm(slope)) ** 3


@pytest.mark.parametrize(
    ("geo", "length"),
    [
        (line(position(0, 0, 0), position(3, 4, 12)), 5),
        (Geo(LIN, position(0, 0, 0), position(3, 4, 12), space=True), 13),
        (line(position(1, 2, 3), position(1, 2, -4), LINNODELTA), 7),
        (line(position(dA1=1, dA5=2), position(dA1=4, dA5=-2), LINADDAXES), 5),
        (line(position(), position(3, 4), LINPOS), 5),
        (line(position(), position(3, 4), MCOMMAND), 0),
        (arc((5, 0), 5, 180, 180), 5 * math.pi),
        (arc((0, 0), 50, 0, 720), 628.318530717958647),
        (ellipse((0, 0), (100, 50), 0, 0, -90), 121.105602756846),
        (ellipse((3, 4), (7, 7), 25, 10, 360), 14 * math.pi),
        (spline([0, 0, 10, 0], [0, 0, 0, 3]), 10),
    ],
)
def test_lengths(geo: Geo, length: float) -> None:
    """Spec cnc_runtime 2, cnc EX-16, EX-20: by closed forms."""
    with run(PROGRAM, cycles=0, inside="SM3_CNC") as program:
        load(program, geo)
        assert program.literal("Main.xLength") == "TRUE"
        assert float(program.literal("Main.geo.dLength")) == pytest.approx(length, rel=1e-12)


@pytest.mark.parametrize("flatness", [1.0, 0.5, 0.1, 1e-3, 1e-6, 0.0])
def test_flat_ellipses(flatness: float) -> None:
    """An ellipse whose minor half-axis is 0 is its main axis there and back: exact; between, by scipy."""
    from scipy.special import ellipe

    with run(PROGRAM, cycles=0, inside="SM3_CNC") as program:
        load(program, ellipse((1, 2), (100, 100 * flatness), 30, 17, -360))
        found = float(program.literal("Main.geo.dLength"))
    assert found == pytest.approx(400 * ellipe(1 - flatness**2), rel=1e-9)


def test_a_spline_with_a_cusp() -> None:
    """x = t^2, y = t^3 about t = 0.5: the curve stands and turns back; length in closed form."""
    x = [0, 1, -1, 0.25]
    y = [1, -1.5, 0.75, -0.125]

    def half(t: float) -> float:
        return ((4 + 9 * t * t) ** 1.5 - 8) / 27

    with run(PROGRAM, cycles=0, inside="SM3_CNC") as program:
        load(program, spline(x, y))
        assert float(program.literal("Main.geo.dLength")) == pytest.approx(2 * half(0.5), rel=1e-9)
        tangents = np.array(program.numbers("Main.aTangents")).reshape(SAMPLES, 3)
    np.testing.assert_allclose(np.linalg.norm(tangents, axis=1), 1.0, atol=1e-12)


@pytest.mark.parametrize(
    ("p0", "start", "end"),
    [
        ([1.0, 0.0, 0.0, 0.0], (1, 0), (1, 0)),  # x = t^3
        ([0.0, 1.0, 0.0, 0.0], (1, 0), (1, 0)),  # x = t^2
        ([1.0, -3.0, 3.0, 0.0], (1, 0), (1, 0)),  # x = 1 - (1 - t)^3
        ([0.0, -1.0, 2.0, 0.0], (1, 0), (1, 0)),  # x = 1 - (1 - t)^2
    ],
)
def test_tangents_of_splines_that_stand_at_their_ends(
    p0: list[float], start: tuple[float, float], end: tuple[float, float]
) -> None:
    """They point along the path although the first derivatives are 0 there."""
    with run(PROGRAM, cycles=0, inside="SM3_CNC") as program:
        load(program, spline(p0, [0.0, 0.0, 0.0, 0.0]))
        tangents = np.array(program.numbers("Main.aTangents")).reshape(SAMPLES, 3)
    np.testing.assert_allclose(tangents[0][:2], start, atol=1e-12)
    np.testing.assert_allclose(tangents[-1][:2], end, atol=1e-12)


@pytest.mark.parametrize("value", ["NaN", "Infinity"])
@pytest.mark.parametrize("member", ["dP1", "dP3", "dT1", "dT2"])
@pytest.mark.parametrize("kind", [CLW, CCLW])
def test_values_that_are_no_numbers_change_nothing(kind: int, member: str, value: str) -> None:
    """FALSE, and length and positions stay."""
    geo = arc((5, 0), 5, 180, 180)
    bad = float("nan") if value == "NaN" else float("inf")
    geo.members[member] = bad
    with run(PROGRAM, cycles=0, inside="SM3_CNC") as program:
        program.set("Main", **{"geo.dLength": 7.0})
        load(program, geo)
        places = (member in ("dP3", "dT2"), True)
        if places[0]:
            assert program.literal("Main.xLength") == "FALSE"
            assert float(program.literal("Main.geo.dLength")) == 7.0
        assert program.literal("Main.xEnd") == "FALSE"
        assert float(program.literal("Main.geo.piDestPos.dX")) == pytest.approx(10.0)


CORNERS = """
PROGRAM Main
VAR
    a, b : SMC_GEOINFO;
    k : LREAL;
END_VAR
k := TurnAngle(ADR(a), ADR(b));
END_PROGRAM
"""


@pytest.mark.parametrize("degrees", [0.0, 1e-7, 0.5, 30, 90, 135, 180])
@pytest.mark.parametrize("heading", [0.0, 77.0, -150.0])
def test_the_angle_of_a_corner(degrees: float, heading: float) -> None:
    """0 is straight on, 180 a reversal; an angle of 1E-7 degrees is still seen."""

    def way(angle: float) -> np.ndarray:
        return np.array([math.cos(math.radians(angle)), math.sin(math.radians(angle))])

    middle = 10 * way(heading)
    last = middle + 7 * way(heading + degrees)
    with run(CORNERS, cycles=0, inside="SM3_CNC") as program:
        for name, geo in (
            ("a", line(position(), position(*middle))),
            ("b", line(position(*middle), position(*last))),
        ):
            program.set("Main", **{f"{name}.{member}": value for member, value in geo.values().items()})
        program.cycle()
        assert float(program.literal("Main.k")) == pytest.approx(degrees, abs=1e-12, rel=1e-6)


@settings(max_examples=30, deadline=None)
@given(
    st.sampled_from([LIN, LINPOS, INITPOS]), st.booleans(), number, st.lists(number, min_size=9, max_size=9)
)
def test_a_line_without_a_way_in_the_plane_has_that_of_what_moves(
    kind: int, space: bool, height: float, axes: list[float]
) -> None:
    """Spec GEO-02: a positioning of Z alone goes |Z|, one of additional axes alone their Euclidean way."""
    geo = line(position(3, 4, 5), position(3, 4, 5), kind)
    geo.space = space
    geo.end[2] += height
    geo.end[3:] = axes
    expected = abs(height) or float(np.linalg.norm(axes))
    with run(PROGRAM, cycles=0, inside="SM3_CNC") as program:
        load(program, geo)
        assert program.literal("Main.xLength") == "TRUE"
        assert float(program.literal("Main.geo.dLength")) == pytest.approx(expected, rel=1e-12)
        points = np.array(program.numbers("Main.aPoints")).reshape(SAMPLES, 12)
    if kind != INITPOS:
        shares = np.linspace(0, 1, SAMPLES)[:, None]
        np.testing.assert_allclose(points, geo.start + shares * (geo.end - geo.start), atol=1e-12)
