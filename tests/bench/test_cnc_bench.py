"""What `tappet bench cnc` measures goes through the blocks as it says; its times are never asserted."""

from __future__ import annotations

import math
from pathlib import Path

import pytest

from tappet.bench import cnc
from tappet.bench.native import CProgram, NativeLoop, gcc_version

LINES = 300


@pytest.mark.parametrize("element", cnc.ELEMENTS)
def test_all_elements_come_through_with_their_plan(element: str) -> None:
    # raises where an error stops the chain, or fewer objects come out than lines went in
    _, deepest = cnc.passing(NativeLoop(), element, [cnc.PLAN], LINES)
    assert deepest > cnc.LEFT


@pytest.mark.slow
def test_lines_come_through_all_stages() -> None:
    cnc.passing(NativeLoop(), "lines", [*cnc.STAGES.items(), cnc.PLAN], LINES)


def test_a_chain_that_is_refused_is_not_measured() -> None:
    wrong = cnc.Stage("SMC_LimitCircularVelocity", "dMaxAcc := -1.0")
    with pytest.raises(ValueError, match="of 300 came out"):
        cnc.passing(NativeLoop(), "lines", [("limits on arcs", wrong)], LINES)


def test_the_interpolator_is_measured_in_motion() -> None:
    cnc.interpolation(NativeLoop(), cnc.MODES[0])  # raises where it stands


def test_memory_does_not_grow_with_the_program() -> None:
    """Spec CNCR-03: nothing but the words of the program."""
    few, many = (cnc.queue_bytes(NativeLoop(), lines) for lines in (100, LINES))
    assert few == pytest.approx(many, abs=4096)  # addresses are rounded


@pytest.mark.skipif(gcc_version() is None, reason="the baseline needs gcc")
def test_the_programs_in_c_do_what_they_say(tmp_path: Path) -> None:
    """All but the last 100 lines are taken; each ring ends at rest, and F is not reached in it."""
    loop = NativeLoop()
    lines = CProgram(cnc.SOURCES / "lines.c", tmp_path)
    loop.seconds(lines.cycle, 1)
    ring = sum(math.sqrt(2 * 100.0 * 0.1 * behind) for behind in range(100))
    assert lines.result == pytest.approx((cnc.LINES / 100 - 1) * ring)
    along = CProgram(cnc.SOURCES / "along.c", tmp_path)
    loop.seconds(along.cycle, 1)
    assert along.result == pytest.approx(50.0)
