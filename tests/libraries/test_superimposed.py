"""Superimposed motions, overrides and moves through positions, against closed forms."""

from __future__ import annotations

from collections.abc import Iterator

import pytest
from tests.libraries.coupled_axes import CoupledAxes, coupled_axes
from tests.libraries.one_axis import CYCLE

RAMP = {"Acceleration": 1000.0, "Deceleration": 1000.0}
SLOW = {"Acceleration": 100.0, "Deceleration": 100.0}
BASE = {"Position": 6000.0, "Velocity": 1000.0, **RAMP}
SUPER = {"Distance": 1000.0, "VelocityDiff": 500.0, **RAMP}
TWO = 2 * CYCLE + 1e-9


@pytest.fixture
def axes() -> Iterator[CoupledAxes]:
    with coupled_axes() as found:
        yield found


def test_the_end_is_farther_and_the_time_the_same(axes: CoupledAxes) -> None:
    axes.start("Absolute", **BASE)
    axes.after(1.5)
    axes.start("Super1", **SUPER)
    fastest = 0.0
    gone = 1.5 + 2 * CYCLE
    while "Done" not in axes.outputs("Absolute"):
        axes.cycle()
        gone += CYCLE
        fastest = max(fastest, axes.velocity)
        assert not ({"Done", "CommandAborted"} <= axes.outputs("Super1"))
    assert gone == pytest.approx(7.0, abs=TWO)
    assert fastest == pytest.approx(1500.0, abs=1e-6)
    assert axes.position == pytest.approx(7000.0, abs=1e-9)
    assert axes.number("Super1.CoveredDistance") == pytest.approx(1000.0)
    assert axes.state == "standstill"


def test_a_second_edge_keeps_what_has_been_added(axes: CoupledAxes) -> None:
    """motion_semantics EX-07."""
    axes.start("Absolute", **BASE)
    axes.after(2.0)
    axes.start("Super1", **SUPER)
    axes.after(1.0)
    axes.release("Super1")
    covered = axes.number("Super1.CoveredDistance")
    assert 0.0 < covered < 1000.0
    axes.start("Super1")
    axes.until("Super1", "Done")
    axes.until("Absolute", "Done")
    assert axes.position == pytest.approx(7000.0 + covered, abs=1.0)
    assert 7000.0 < axes.position < 8000.0


def test_another_instance_replaces_the_superimposed_motion(axes: CoupledAxes) -> None:
    axes.start("Absolute", **BASE)
    axes.after(2.0)
    axes.start("Super1", **SUPER)
    axes.after(0.5)
    axes.start("Super2", **SUPER | {"Distance": -300.0})
    axes.cycle()
    assert axes.outputs("Super1") == {"CommandAborted"}
    assert axes.outputs("Absolute") == {"Busy", "Active"}
    covered = axes.number("Super1.CoveredDistance")
    axes.until("Absolute", "Done")
    assert axes.position == pytest.approx(5700.0 + covered, abs=0.5 + 1e-6)


def test_an_aborting_command_ends_both_motions_without_a_step(axes: CoupledAxes) -> None:
    axes.start("Absolute", **BASE)
    axes.after(2.0)
    axes.start("Super1", **SUPER)
    axes.after(0.7)
    before = axes.position, axes.velocity
    assert before[1] == pytest.approx(1500.0)
    axes.start("Velocity", Velocity=100.0, Direction=1, **RAMP)
    assert axes.velocity == pytest.approx(1499.0)
    assert axes.position == pytest.approx(before[0] + CYCLE * (before[1] + axes.velocity) / 2, abs=1e-9)
    axes.cycle()
    assert axes.outputs("Super1") == {"CommandAborted"}
    assert axes.outputs("Absolute") == {"CommandAborted"}


def test_in_standstill_it_moves_like_a_relative_move(axes: CoupledAxes) -> None:
    axes.start("Super1", Distance=-50.0, VelocityDiff=10.0, **SLOW)
    assert axes.state == "discrete_motion"
    assert axes.until("Super1", "Done") == pytest.approx(5.1, abs=TWO)
    assert axes.position == pytest.approx(-50.0, abs=1e-9)
    assert axes.state == "standstill"
    assert axes.velocity == 0.0


def test_a_buffered_absolute_move_behind_it_goes_to_its_target(axes: CoupledAxes) -> None:
    axes.start("Absolute", **BASE)
    axes.after(5.5)
    axes.start("Super1", **SUPER)
    axes.set("Through", Position=8000.0, Velocity=1000.0, EndVelocity=10.0, BufferMode=1, **RAMP)
    axes.start("Through")
    axes.until("Through", "DistanceTravelled")
    assert axes.position == pytest.approx(8000.0, abs=0.02)


def test_a_superimposed_motion_is_halted(axes: CoupledAxes) -> None:
    axes.start("Absolute", **BASE)
    axes.after(2.0)
    axes.start("Super1", **SUPER)
    axes.after(1.0)
    axes.start("HaltSuper", Deceleration=1000.0)
    assert axes.until("HaltSuper", "Done") == pytest.approx(0.5, abs=TWO)
    assert axes.outputs("Super1") == {"CommandAborted"}
    assert axes.velocity == pytest.approx(1000.0)
    assert axes.outputs("Absolute") == {"Busy", "Active"}


def test_abort_takes_the_superimposed_motion_back(axes: CoupledAxes) -> None:
    axes.start("Velocity", Velocity=10.0, Direction=1, **RAMP)
    axes.start("Super1", **SUPER)
    axes.after(1.0)
    with_it, covered = axes.position, axes.number("Super1.CoveredDistance")
    axes.set("Super1", Abort=True)
    axes.cycle()
    assert axes.position == pytest.approx(with_it - covered + 10.0 * CYCLE, abs=1e-6)
    assert axes.outputs("Super1") == {"CommandAborted"}


def test_a_superimposed_motion_that_is_not_called_is_an_error(axes: CoupledAxes) -> None:
    axes.start("Super1", **SUPER)
    axes.write("sSkipped", "Super1")
    axes.cycle(2)
    assert axes.state == "errorstop"
    axes.write("sSkipped", "")
    axes.cycle()
    assert axes.text("Super1.ErrorID") == "SMC_FB_WASNT_CALLED_DURING_MOTION"


def test_wrong_values_are_refused(axes: CoupledAxes) -> None:
    for name in ("VelocityDiff", "Acceleration", "Deceleration"):
        axes.start("Super1", **SUPER | {name: 0.0})
        assert (axes.outputs("Super1"), axes.text("Super1.ErrorID")) == (
            {"Error"},
            "SMC_MSI_INVALID_VELACC_VALUES",
        )
        axes.release("Super1")
    for block in ("Through", "ThroughBy"):
        axes.start(block, Velocity=10.0, EndVelocityDirection=3, **RAMP)
        assert axes.text(f"{block}.ErrorID").endswith("_INVALID_DIRECTION")
        axes.release(block)
        axes.start(block, Velocity=0.0, EndVelocityDirection=1, **RAMP)
        assert axes.text(f"{block}.ErrorID").endswith("_INVALID_VELACC_VALUES")
        axes.release(block)
    axes.start("Through", Velocity=10.0, Direction=3)
    assert axes.text("Through.ErrorID") == "SMC_MCA_DIRECTION_NOT_APPLICABLE"
    axes.set("Override", Enable=True, VelFactor=1.5)
    axes.cycle()
    assert (axes.outputs("Override"), axes.text("Override.ErrorID")) == (
        {"Error"},
        "SMC_OVERRIDE_OUT_OF_RANGE",
    )


def test_a_position_is_passed_with_its_velocity(axes: CoupledAxes) -> None:
    axes.start("Through", Position=100.0, Velocity=50.0, EndVelocity=20.0, **SLOW)
    assert axes.state == "discrete_motion"
    gone = axes.until("Through", "InEndVelocity") + CYCLE
    # 0.5 s to 50 u/s, 0.3 s down to 20 u/s over 10.5 u, the rest at 50 u/s
    assert gone == pytest.approx(0.5 + (100.0 - 12.5 - 10.5) / 50.0 + 0.3, abs=TWO)
    assert axes.position == pytest.approx(100.0, abs=20.0 * TWO)
    assert axes.outputs("Through") == {"Busy", "Active", "InEndVelocity", "DistanceTravelled"}
    assert axes.state == "continuous_motion"
    axes.after(1.0)
    assert axes.velocity == pytest.approx(20.0)


def test_an_end_velocity_against_the_way_brings_the_axis_back(axes: CoupledAxes) -> None:
    axes.start("ThroughBy", Distance=100.0, Velocity=50.0, EndVelocity=20.0, EndVelocityDirection=-1, **SLOW)
    highest = 0.0
    while "InEndVelocity" not in axes.outputs("ThroughBy"):
        axes.cycle()
        highest = max(highest, axes.position)
    assert highest == pytest.approx(102.0, abs=1e-3)
    assert axes.position == pytest.approx(100.0, abs=20.0 * TWO)
    assert axes.velocity == pytest.approx(-20.0)


def test_an_end_velocity_is_adapted_so_that_nothing_turns(axes: CoupledAxes) -> None:
    axes.start(
        "ThroughBy",
        Distance=2.0,
        Velocity=50.0,
        EndVelocity=40.0,
        EndVelocityDirection=1,
        AdaptEndVelToAvoidOvershoot=True,
        **SLOW,
    )
    axes.until("ThroughBy", "DistanceTravelled")
    assert axes.velocity == pytest.approx(20.0, abs=0.2)
    assert "InEndVelocity" not in axes.outputs("ThroughBy")
    assert axes.until("ThroughBy", "InEndVelocity") == pytest.approx(0.2, abs=2 * TWO)
    assert axes.velocity == pytest.approx(40.0)


def test_an_adapted_end_velocity_against_the_way_begins_at_the_position(axes: CoupledAxes) -> None:
    axes.start(
        "ThroughBy",
        Distance=100.0,
        Velocity=50.0,
        EndVelocity=20.0,
        EndVelocityDirection=-1,
        AdaptEndVelToAvoidOvershoot=True,
        **SLOW,
    )
    highest = 0.0
    while "InEndVelocity" not in axes.outputs("ThroughBy"):
        axes.cycle()
        highest = max(highest, axes.position)
    assert highest == pytest.approx(100.0, abs=1e-9)
    assert axes.velocity == pytest.approx(-20.0)


def test_an_override_holds_in_motion(axes: CoupledAxes) -> None:
    axes.set("Override", Enable=True, VelFactor=0.5, AccFactor=1.0, JerkFactor=1.0)
    axes.start("Absolute", Position=100.0, Velocity=10.0, **SLOW)
    axes.after(5.0)
    assert axes.velocity == pytest.approx(5.0)
    axes.set("Override", VelFactor=0.0)
    axes.after(0.1)
    assert (axes.velocity, axes.outputs("Absolute")) == (0.0, {"Busy", "Active"})
    stood = axes.position
    axes.after(1.0)
    assert axes.position == stood
    axes.set("Override", VelFactor=1.0, AccFactor=0.5)
    gone = axes.until("Absolute", "Done")
    assert axes.position == 100.0
    assert gone == pytest.approx((100.0 - stood) / 10.0 + 10.0 / 50.0, abs=TWO)


def test_an_override_moves_a_velocity(axes: CoupledAxes) -> None:
    axes.start("Velocity", Velocity=100.0, Direction=1, **SLOW)
    axes.until("Velocity", "InVelocity")
    axes.set("Override", Enable=True, VelFactor=0.25, AccFactor=1.0, JerkFactor=1.0)
    axes.cycle(2)
    assert axes.until("Velocity", "InVelocity") == pytest.approx(0.75, abs=TWO)
    assert axes.velocity == pytest.approx(25.0)
    axes.start("Halt", Deceleration=100.0)
    assert axes.until("Halt", "Done") == pytest.approx(0.25, abs=TWO)
