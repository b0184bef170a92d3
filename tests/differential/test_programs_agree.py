"""Random programs on the compiler and on the reference; hypothesis makes a failing one small."""

from __future__ import annotations

from random import Random

import compared
import pytest
import reference
import write_st
from bytes_in_memory import Unsettled
from hypothesis import HealthCheck, Phase, given, settings
from hypothesis import strategies as st

from programs import ProgramMaker

QUICK = settings(
    max_examples=10,
    deadline=None,
    derandomize=True,
    suppress_health_check=[HealthCheck.too_slow, HealthCheck.data_too_large, HealthCheck.filter_too_much],
    phases=[Phase.generate, Phase.shrink],
)


def check(r: Random, level: int, size: int = 10) -> None:
    program = ProgramMaker(r, size=size).program()
    try:
        found = compared.differences(program, level)
    except (reference.TooLong, Unsettled):  # not worth comparing
        return
    if found:
        raise AssertionError("\n".join([*found, write_st.program(program)]))


@pytest.mark.parametrize("level", [0, 2])
@given(r=st.randoms(use_true_random=False))
@QUICK
def test_small_programs(r: Random, level: int) -> None:
    check(r, level, size=4)


@pytest.mark.parametrize("seed", range(30))
def test_programs(seed: int) -> None:
    check(Random(seed), 2 * (seed % 2))


@pytest.mark.slow
@pytest.mark.parametrize("block", range(30))
def test_many_programs(block: int) -> None:
    for seed in range(10_000 + 100 * block, 10_100 + 100 * block):
        try:
            check(Random(seed), 2 * (seed % 2), size=20)
        except AssertionError as error:
            raise AssertionError(f"seed {seed}") from error
