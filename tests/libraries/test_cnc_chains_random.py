"""SM3_CNC: preprocessing blocks one behind the other in any order, left out or repeated. Spec CNCR-01."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from tests.libraries.cnc_chain import Block, gaps, through
from tests.libraries.cnc_paths import MCOMMAND, Geo, Vector
from tests.libraries.test_cnc_preprocessing_random import BLOCKS, functions, paths

VEC = (1.0, 2.0, 3.0)


def moved(name: str, place: Vector) -> Vector:
    """Where a block brings a point of the path."""
    if name == "SMC_TranslateQueue3D":
        return place + VEC
    if name == "SMC_ScaleQueue3D":
        return place * 2.5
    if name == "SMC_RotateQueue2D":
        c, s = math.cos(math.radians(30)), math.sin(math.radians(30))
        return np.array([c * place[0] - s * place[1], s * place[0] + c * place[1], place[2]])
    return place


@pytest.mark.slow
@settings(max_examples=10, deadline=None)
@given(paths(marks=16), st.lists(st.sampled_from(sorted(BLOCKS)), min_size=2, max_size=7))
def test_any_chain(objects: list[Geo], names: list[str]) -> None:
    """One path comes out, from its start to its end, with its M functions and numbers that are some."""
    result = through(objects, *(Block(name, BLOCKS[name]) for name in names), vec=VEC)
    assert result.error == 0, names
    found = result.objects
    assert gaps(found) < 1e-7
    assert functions(found) == functions(objects)
    first, last = objects[0].start[:3], [geo for geo in objects if geo.kind != MCOMMAND][-1].end[:3]
    for name in names:
        first, last = moved(name, first), moved(name, last)
    moving = [geo for geo in found if geo.kind != MCOMMAND]
    np.testing.assert_allclose(moving[0].start[:2], first[:2], atol=1e-8)
    np.testing.assert_allclose(moving[-1].end[:2], last[:2], atol=1e-8)
    for geo in found:
        assert np.isfinite([*geo.start, *geo.end, *geo.members.values()]).all()
