"""SM3_CNC: path objects with numbers that are none, through every preprocessing block."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from tests.libraries.cnc_chain import Block, through
from tests.libraries.cnc_paths import CCLW, CLW, ELLCLW, LIN, LINPOS, MCOMMAND, SPLINE, Geo, path
from tests.libraries.test_cnc_preprocessing_random import BLOCKS

from tappet.libraries import load
from tappet.libraries.catalog import Item, items

INVALID_VALUE = 10021
"""SMC_CNC_INVALID_VALUE."""
OURS = {item.name: item for item in items(load("SM3_CNC"))}
NO_NUMBERS = (math.nan, math.inf, -math.inf, 1e200, -1e200)
SIZES = {"ARRAY[0..MAX_SWITCHES-1] OF LREAL": 3, "ARRAY[0..6] OF LREAL": 7, "ARRAY[0..3] OF LREAL": 4}
SIZES["ARRAY[0..2] OF LREAL"] = 3


def numbers_of(item: Item, prefix: str = "") -> Iterator[str]:
    """The members of a structure that are LREAL, with those of structures and arrays in it."""
    for member in item.members:
        name = f"{prefix}{member.name}"
        if member.type == "LREAL":
            yield name
        elif member.type in SIZES:
            yield from (f"{name}[{n}]" for n in range(SIZES[member.type]))
        elif member.type in OURS and OURS[member.type].kind == "struct":
            yield from numbers_of(OURS[member.type], f"{name}.")
        else:
            assert "REAL" not in member.type, f"{name} is not looked at"


MEMBERS = tuple(numbers_of(OURS["SMC_GEOINFO"]))


def straight() -> list[Geo]:
    """Lines without a corner: no block takes one of them away."""
    objects = path([(0.0, 10.0)] * 4, dVel=10.0, dVelEnd=10.0)
    objects[0].members["byInternMark"] = 2 | 16 | 32 | 128
    return objects


class Absurd(Geo):
    """An object with one member overwritten, whatever it is."""

    def values(self) -> dict[str, float]:
        found = super().values()
        return {name: value for name, value in found.items() if name not in self.members} | self.members


def absurd(geo: Geo, member: str, value: float) -> Geo:
    members = {"dLength": 10.0, **geo.members, member: value}
    return Absurd(geo.kind, geo.start, geo.end, members, geo.space, geo.plane)


def test_the_members_are_all_that_are_numbers() -> None:
    assert len(MEMBERS) == 24 + 17 + 3 + 21 + 6 + 4 + 6 + 9


@pytest.mark.slow
@pytest.mark.parametrize("name", BLOCKS)
def test_what_is_no_number_is_refused(name: str) -> None:
    """Each member of an object, no number or too large: SMC_CNC_INVALID_VALUE, nothing behind it."""
    for n, member in enumerate(MEMBERS):
        objects = straight()
        objects[2] = absurd(objects[2], member, NO_NUMBERS[n % len(NO_NUMBERS)])
        result = through(objects, Block(name, BLOCKS[name]), cycles=20)
        assert result.error == INVALID_VALUE, member
        assert len(result.objects) <= 2
        for geo in result.objects:
            assert np.isfinite([*geo.start, *geo.end, *geo.members.values()]).all(), member


@pytest.mark.parametrize("kind", [0, -1, 4, 6, 7, 103, 121, 32767])
def test_kinds_that_are_none_are_refused(kind: int) -> None:
    objects = straight()
    objects[1] = absurd(Geo(kind, objects[1].start, objects[1].end), "dLength", 10.0)
    for name in ("SMC_TranslateQueue3D", "SMC_SmoothPath", "SMC_ToolCorr", "SMC_AvoidLoop"):
        assert through(objects, Block(name, BLOCKS[name]), cycles=20).error == INVALID_VALUE


@pytest.mark.parametrize("member", ["dP1", "dP8", "dT1", "dT2"])
def test_parameters_of_an_m_function_are_of_the_program(member: str) -> None:
    """They are handed on as they are; the time of a dwell is none."""
    objects = straight()
    function = Geo(MCOMMAND, objects[1].end, objects[1].end, {"iHelpID[0]": 7.0, member: math.inf})
    result = through([*objects[:2], function, *objects[2:]], Block("SMC_SmoothPath"))
    assert (result.error, len(result.objects)) == (0, 5)
    assert math.isinf(result.objects[2].member(member))
    function.members |= {"iHelpID[0]": -1.0, "dP1": math.nan}
    assert through([*objects[:2], function], Block("SMC_SmoothPath"), cycles=20).error == INVALID_VALUE


VALUES = st.sampled_from([0.0, -1.0, 1e-300, -1e-300, 1e100, -1e100, 1e9, -720.0, 0.5])


@pytest.mark.slow
@pytest.mark.parametrize("name", BLOCKS)
@settings(max_examples=25, deadline=None)
@given(
    kind=st.sampled_from([LIN, CLW, CCLW, ELLCLW, SPLINE, LINPOS, 101, 102, 110]),
    changes=st.dictionaries(st.sampled_from(MEMBERS), VALUES, min_size=1, max_size=3),
    space=st.booleans(),
)
def test_numbers_without_sense_end_in_an_error_or_a_path(
    name: str, kind: int, changes: dict[str, float], space: bool
) -> None:
    """Whatever the geometry is: the block ends, by an error of its own or with numbers that are some."""
    objects = straight()
    for member, value in changes.items():
        objects[1] = absurd(objects[1], member, value)
    objects[1].kind, objects[1].space = kind, space
    result = through(objects, Block(name, BLOCKS[name]), cycles=60)
    assert result.error in (0, INVALID_VALUE, 1600)
    for geo in result.objects:
        assert np.isfinite([*geo.start, *geo.end, *geo.members.values()]).all()
