"""What `tappet bench axes` measures moves as it says; how fast it is is looked at, never asserted."""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest
from ruckig import InputParameter, Ruckig, Trajectory

from tappet.bench import axes
from tappet.bench.native import CProgram, NativeLoop, gcc_version


@pytest.mark.parametrize("ramp", range(len(axes.RAMP_TYPES)))
def test_axes_are_measured_in_motion(ramp: int) -> None:
    # raises where the axis is not in motion; how long a call took says nothing on a busy machine
    assert len(axes.moving(NativeLoop(), ramp, 10)) == 3


def test_axes_are_measured_with_their_drives() -> None:
    axes.driven(NativeLoop(), 5)  # raises where the axis is not in motion


def test_slaves_are_measured_in_gear() -> None:
    axes.coupled(NativeLoop(), axes.GEARS, 10)  # raises where the slave is not coupled


def test_slaves_are_measured_by_a_cam() -> None:
    axes.coupled(NativeLoop(), axes.CAMS, 10)


@pytest.mark.skipif(gcc_version() is None, reason="the baseline needs gcc")
def test_the_cam_in_c_is_that_of_the_library(tmp_path: Path) -> None:
    """Spec cam EX-01: at a quarter of the first segment, and in the last one."""
    program = CProgram(axes.MOTION / "cams.c", tmp_path)
    NativeLoop().seconds(program.cycle, 300)
    assert program.result == pytest.approx(7.8515625, rel=1e-9)
    NativeLoop().seconds(program.cycle, 2700)
    assert program.result == pytest.approx(318.75, rel=1e-9)


def test_slaves_that_are_not_in_gear_are_not_measured() -> None:
    variables, calls = axes.GEARS
    refused = calls.replace("RatioNumerator := 2", "RatioDenominator := 0")
    with pytest.raises(ValueError, match="something else was measured"):
        axes.coupled(NativeLoop(), (variables, refused), 10)


@pytest.mark.skipif(shutil.which("g++") is None, reason="the C++ version needs g++")
@pytest.mark.parametrize("targets", [axes.FAR, axes.NEAR])
def test_the_moves_in_c_are_those_of_the_wheel(tmp_path: Path, targets: tuple[float, float]) -> None:
    program = axes.ruckig(tmp_path, targets)
    assert program is not None
    given = InputParameter(1)
    given.max_velocity, given.max_acceleration, given.max_jerk = [50.0], [20.0], [200.0]
    trajectory = Trajectory(1)
    for number in range(4):
        if number:
            position, velocity, acceleration = trajectory.at_time(0.002)
            given.current_position = position
            given.current_velocity = velocity
            given.current_acceleration = acceleration
        given.target_position = [targets[number % 2]]
        Ruckig(1).calculate(given, trajectory)
        NativeLoop().seconds(program.cycle, 1)
        assert program.result == pytest.approx(trajectory.duration, rel=1e-12)


@pytest.mark.skipif(gcc_version() is None, reason="the baseline needs gcc")
def test_the_baseline_follows_its_segments(tmp_path: Path) -> None:
    program = CProgram(axes.MOTION / "segments.c", tmp_path)
    NativeLoop().seconds(program.cycle, 1000)
    time = 1.0
    assert program.result == pytest.approx(time * 1000.0 + time**2 + 1e-3 / 6.0, rel=1e-12)


def test_a_project_of_axes_is_built() -> None:
    row = axes.project(5)
    assert row.ours > 0.0
    assert "an axis" in row.note
