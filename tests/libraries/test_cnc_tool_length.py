"""SM3_CNC: SMC_ToolLengthCorr against the shifted curves of numpy."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from tests.libraries.cnc_chain import Block, gaps, length_of, through
from tests.libraries.cnc_paths import (
    CCLW,
    CLW,
    ELLCCLW,
    ELLCLW,
    LIN,
    LINADDAXES,
    LINNODELTA,
    MCOMMAND,
    Geo,
    Vector,
    arc,
    line,
    position,
    spline,
)
from tests.libraries.test_cnc_preprocessing_random import paths

BLOCK = Block("SMC_ToolLengthCorr")


def with_tool(objects: list[Geo], tools: list[Vector]) -> list[Geo]:
    for geo, tool in zip(objects, tools, strict=True):
        geo.members |= {f"vToolLength.d{axis}": float(value) for axis, value in zip("XYZ", tool, strict=True)}
    return objects


vector = st.sampled_from([(0.0, 0, 0), (0, 0, 5), (0, 0, 5), (1, -2, 0), (0.5, 3, -4)]).map(np.array)


@pytest.mark.slow
@settings(max_examples=30, deadline=None)
@given(paths(marks=0), st.data(), st.booleans())
def test_each_object_is_shifted(objects: list[Geo], data: st.DataObject, space: bool) -> None:
    """Minus the vector of the object; where it changes, an even run over, or a line in front."""
    for geo in objects:
        geo.space = space and geo.kind not in (ELLCLW, ELLCCLW)
    tools = [data.draw(vector) for _ in objects]
    result = through(with_tool(objects, tools), BLOCK)
    assert result.error == 0
    found = list(result.objects)
    assert gaps(found) < 1e-9
    shift = np.zeros(3)
    for geo, tool in zip(objects, tools, strict=True):
        if geo.kind == MCOMMAND:
            here = found.pop(0)
            np.testing.assert_allclose(here.start[:3], geo.start[:3] - shift, atol=1e-9)
            assert here.member("iHelpID[0]") == geo.member("iHelpID[0]")
            continue
        if geo.kind in (CLW, CCLW, ELLCLW, ELLCCLW) and np.abs((tool - shift)[:2]).max() > 0:
            joint = found.pop(0)
            np.testing.assert_allclose(joint.start[:3], geo.start[:3] - shift, atol=1e-9)
            np.testing.assert_allclose(joint.end[:3], geo.start[:3] - tool, atol=1e-9)
            np.testing.assert_array_equal((joint.start[3:], joint.end[3:]), (geo.start[3:], geo.start[3:]))
            assert joint.kind == LIN
            assert length_of(joint) == pytest.approx(joint.length(), rel=1e-9)
            shift = tool
        here = found.pop(0)
        assert here.kind == geo.kind
        for u in np.linspace(0, 1, 5):
            moved = geo.curve(u) - (1 - u) * shift - u * tool
            np.testing.assert_allclose(here.curve(u)[:2], moved[:2], atol=1e-9)
            if geo.space:
                assert here.curve(u)[2] == pytest.approx(moved[2], abs=1e-9)
        np.testing.assert_allclose(here.start[:3], geo.start[:3] - shift, atol=1e-9)
        np.testing.assert_allclose(here.end[:3], geo.end[:3] - tool, atol=1e-9)
        np.testing.assert_array_equal((here.start[3:], here.end[3:]), (geo.start[3:], geo.end[3:]))
        assert length_of(here) == pytest.approx(here.length(), rel=1e-8)
        assert here.member("iHelpID[0]") == geo.member("iHelpID[0]")
        shift = tool
    assert found == []


@pytest.mark.parametrize("space", [False, True])
def test_a_spline_runs_over(space: bool) -> None:
    """A polynomial in t gets a linear term; a cut one too."""
    coefficients = [1.0, -2, 3, 0.5]
    geo = spline([3, 1, -2, 5], coefficients, [1, 1, 1, 1] if space else None, dT1=0.25, dT2=0.75)
    geo.start[:2], geo.end[:2] = geo.curve(0)[:2], geo.curve(1)[:2]
    if space:
        geo.start[2], geo.end[2] = geo.curve(0)[2], geo.curve(1)[2]
    tool = np.array([1.0, -2, 4])
    (found,) = through(with_tool([geo], [tool]), BLOCK).objects
    for u in np.linspace(0, 1, 7):
        expected = geo.curve(u) - u * tool * (np.ones(3) if space else [1, 1, 0])
        np.testing.assert_allclose(found.curve(u), expected, atol=1e-12)
    assert found.end[2] == pytest.approx(geo.end[2] - 4)


def test_a_helix_takes_a_change_along_its_normal() -> None:
    """No line in front: the arc rises by it."""
    geo = arc((0, 0), 10, 0, -90)
    geo.space = True
    (found,) = through(with_tool([geo], [np.array([0, 0, 7.0])]), BLOCK).objects
    assert (found.kind, found.end[2]) == (CCLW, -7)
    assert length_of(found) == pytest.approx(np.hypot(10 * np.pi / 2, 7))


def test_kinds_follow_what_moves() -> None:
    """A line of an additional axis alone becomes one of Z when the tool changes in it."""
    objects = [line(position(), position(dA1=5.0), LINADDAXES), line(position(dA1=5.0), position(3, dA1=5.0))]
    found = through(with_tool(objects, [np.array([0, 0, 2.0])] * 2), BLOCK).objects
    assert [(geo.kind, length_of(geo), geo.end[2]) for geo in found] == [(LINNODELTA, 2, -2), (LIN, 3, -2)]
    found = through(with_tool(objects, [np.array([4.0, 0, 0]), np.zeros(3)]), BLOCK).objects
    assert [(geo.kind, length_of(geo), geo.end[0]) for geo in found] == [(LIN, 4, -4), (LIN, 7, 3)]
