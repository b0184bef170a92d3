"""What blocks take over at the edge of Execute: the direction, and the state of the axis just then."""

from __future__ import annotations

from collections.abc import Iterator

import pytest
from tests.libraries.coupled_axes import CoupledAxes, coupled_axes
from tests.libraries.one_axis import CYCLE, one_axis

from tappet.libraries import load
from tappet.libraries.catalog import items

RAMP = {"Velocity": 100.0, "Acceleration": 1000.0, "Deceleration": 1000.0}
NEGATIVE, SHORTEST, POSITIVE, CURRENT, FASTEST = range(-1, 4)


@pytest.fixture
def axes() -> Iterator[CoupledAxes]:
    with coupled_axes() as found:
        yield found


@pytest.mark.parametrize(
    ("block", "direction", "error"),
    [
        ("Velocity", SHORTEST, "SMC_MV_DIRECTION_NOT_APPLICABLE"),
        ("Velocity", FASTEST, "SMC_MV_DIRECTION_NOT_APPLICABLE"),
        ("Velocity", CURRENT, ""),
        ("Through", FASTEST, "SMC_MCA_DIRECTION_NOT_APPLICABLE"),
        ("Through", SHORTEST, ""),
        ("Through", CURRENT, ""),
    ],
)
def test_a_direction_that_does_not_apply_is_refused(
    axes: CoupledAxes, block: str, direction: int, error: str
) -> None:
    """EXE-14."""
    axes.start(block, Direction=direction, **RAMP)
    assert axes.text(f"{block}.ErrorID") == (error or "SMC_NO_ERROR")
    assert axes.outputs(block) == ({"Error"} if error else {"Busy"})
    assert (axes.state == "standstill") == bool(error)


def test_a_stop_has_no_direction_that_could_not_apply() -> None:
    """EXE-14: neither catalog gives MC_Stop a Direction; it stops in the direction of the motion.

    The number that older libraries report of it has its name and text still.
    """
    found = {item.name: item for item in items(load("SM3_Basic"))}
    assert "Direction" not in {pin.name for pin in found["MC_Stop"].inputs}
    numbers = {value.name: int(value.value or -1) for value in found["SMC_ERROR"].values}
    assert numbers["SMC_MS_DIRECTION_NOT_APPLICABLE"] == 182
    assert numbers["SMC_MV_DIRECTION_NOT_APPLICABLE"] == 302
    assert numbers["SMC_MCA_DIRECTION_NOT_APPLICABLE"] == 453
    for direction in (NEGATIVE, POSITIVE):
        with one_axis() as axis:
            axis.start("Velocity1", Direction=direction, **RAMP)
            axis.after(0.2)
            axis.start("Stop1", Deceleration=1000.0)
            fastest = axis.velocity
            while "Done" not in axis.outputs("Stop1"):
                axis.cycle()
                assert -1e-9 <= axis.velocity * direction <= fastest * direction


def test_a_block_sees_the_state_before_what_later_blocks_of_the_cycle_do() -> None:
    """INF-02: called before MC_Stop that lets go of the axis, a move is refused; behind it, it is taken."""
    with one_axis() as axis:
        axis.start("Stop1", Deceleration=1000.0)
        axis.cycle(2)
        axis.set("Stop1", Execute=False)
        axis.start("Absolute1", Position=10.0, **RAMP)
        assert axis.state == "standstill"
        assert axis.outputs("Absolute1") == {"Error"}
        assert axis.text("Absolute1.ErrorID") == "SMC_AXIS_NOT_READY_FOR_MOTION"
        axis.cycle(5)
        assert axis.state == "standstill", "a refused command does not begin later"
    with coupled_axes() as axes:
        axes.start("Stop", Deceleration=1000.0)
        axes.cycle(2)
        axes.set("Stop", Execute=False)
        axes.start("Through", Position=10.0, EndVelocity=10.0, **RAMP)
        assert axes.state == "discrete_motion"
        assert axes.outputs("Through") == {"Busy"}


@pytest.mark.parametrize("offset", range(-3, 4))
@pytest.mark.parametrize("mode", [0, 1])
def test_the_end_of_a_motion_takes_no_accepted_command_along(offset: int, mode: int) -> None:
    """INF-02: around the cycle in which a move ends in standstill, the next one is taken and kept."""
    duration = 2 * (10.0 / 1000.0) ** 0.5
    with one_axis() as axis:
        axis.start("Relative1", Distance=10.0, **RAMP)
        axis.cycle(round(duration / CYCLE) - 1 + offset)
        axis.start("Relative2", Distance=10.0, **RAMP, BufferMode=mode)
        assert axis.outputs("Relative2") == {"Busy"}
        assert axis.state == "discrete_motion"
        axis.until_done("Relative2")
        reached = "Done" in axis.outputs("Relative1")
        assert reached or (mode == 0 and axis.outputs("Relative1") == {"CommandAborted"})
        if reached:
            assert axis.position == pytest.approx(20.0, abs=1e-9)


def test_a_state_that_a_command_of_the_same_cycle_brings_serves_the_next_block(axes: CoupledAxes) -> None:
    """INF-02: a phase needs a coupling; the gear that got its edge before it in the cycle is one."""
    axes.run_master(100.0)
    axes.after(0.2)
    axes.set("Gear1", Execute=True, RatioNumerator=1, Acceleration=1e4, Deceleration=1e4)
    axes.set("Phasing", PhaseShift=5.0, **RAMP)
    axes.start("Phasing")
    assert axes.state == "synchronized_motion"
    assert (axes.outputs("Gear1"), axes.outputs("Phasing")) == ({"Busy"}, {"Busy"})
    axes.until("Phasing", "Done")
