"""SM3_CNC: SMC_NCDecoder on random programs against a reference. Spec GEO-01 to GEO-13, GEO-21."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from tests.libraries.cnc_decoder import path
from tests.libraries.cnc_reference import Reference

NUMBER = st.one_of(st.integers(-60, 60).map(float), st.floats(-60, 60).map(lambda value: round(value, 3)))
SIZE = st.floats(1, 60).map(lambda value: round(value, 3))
ANGLE = st.floats(5, 355).map(lambda value: round(value, 2))
TURN = st.floats(-180, 180).map(lambda value: round(value, 2))
STATES = st.dictionaries(st.sampled_from("XYZXYZXYPUA"), NUMBER, min_size=1, max_size=4)
ARCS = st.sampled_from([2, 3])
Step = Callable[[Reference], None]


def in_plane(step: Step) -> Step:
    """A step of ellipses and parabolas, which there are in 2D mode only."""

    def go(reference: Reference) -> None:
        if not reference.space:
            step(reference)

    return go


STEPS: st.SearchStrategy[Step] = st.one_of(
    st.sampled_from([15, 17, 18, 19, 90, 91, 98, 99]).map(lambda n: lambda r: r.mode(n)),
    st.tuples(NUMBER, NUMBER, SIZE).map(lambda n: lambda r: r.normal(*n)),
    st.tuples(st.sampled_from([54, 55, 56]), STATES).map(lambda s: lambda r: r.shifted(*s)),
    st.just(lambda r: r.shifted(53, {})),
    st.just(lambda r: r.function()),
    *[
        st.tuples(st.sampled_from(numbers), STATES).map(lambda s: lambda r: r.go(*s))
        for numbers in ([0, 1], [1], [5, 10], [5, 10], [5])
    ],
    st.tuples(ARCS, STATES, SIZE).map(lambda s: lambda r: r.arc_of_radius(*s)),
    st.tuples(ARCS, st.tuples(SIZE, NUMBER), ANGLE, NUMBER, st.just(False)).map(
        lambda s: lambda r: r.arc_of_centre(*s)
    ),
    st.tuples(
        ARCS, st.tuples(NUMBER, SIZE), st.floats(5, 1080).map(lambda v: round(v, 2)), NUMBER, st.just(True)
    ).map(lambda s: lambda r: r.arc_of_centre(*s)),
    st.tuples(st.sampled_from([8, 9]), st.tuples(st.floats(20, 60), st.floats(2, 19)), TURN, TURN, ANGLE).map(
        lambda s: in_plane(lambda r: r.ellipse(*s))
    ),
    st.tuples(STATES, st.tuples(NUMBER, NUMBER)).map(lambda s: in_plane(lambda r: r.parabola(*s))),
)


@settings(max_examples=80, deadline=None)
@given(st.lists(STEPS, min_size=1, max_size=14))
def test_any_program_agrees_with_the_reference(steps: list[Step]) -> None:
    """The same kinds, ends, curves and lengths; the path has no gaps."""
    reference = Reference()
    for step in steps:
        step(reference)
    found = path("\n".join(["F10", *reference.lines]))
    expected = reference.path()
    assert [geo.kind for geo in found] == [piece.kind for piece in expected]
    before = np.zeros(11)
    for geo, piece in zip(found, expected, strict=True):
        near = {"rtol": 1e-9, "atol": 1e-9 * (1 + np.abs([geo.start, geo.dest]).max())}
        assert np.array_equal(geo.start, before)
        before = geo.dest
        np.testing.assert_allclose(geo.start, piece.start, **near)
        np.testing.assert_allclose(geo.dest, piece.dest, **near)
        size = 1 + np.abs([geo.start, geo.dest]).max() + abs(geo["dP3"] if geo.kind in ("CLW", "CCLW") else 0)
        for u in (0.0, 0.3, 0.7, 1.0):
            shown = geo.at(u)
            wanted = piece.curve(u)
            if geo.kind == "SPLINE" and not piece.space:
                shown, wanted = shown[:2], wanted[:2]
            np.testing.assert_allclose(shown, wanted, rtol=1e-8, atol=1e-9 * size)
        if geo.kind != "MCOMMAND":
            assert geo.length == pytest.approx(piece.length, rel=1e-6, abs=1e-9 * size)
