"""Models identified from recorded answers of known axes, with an encoder's increments and noise."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.signal import TransferFunction
from scipy.signal import step as step_response
from servo_axis import Encoder, ServoAxis, ServoDrive

from tappet.motion.loop_tuning import evaluate
from tappet.motion.loops import ControllerLoop, DriveLoops
from tappet.motion.measured_response import (
    Recording,
    UnusableMeasurementError,
    figures,
    recording_of,
)

CYCLE = 0.002
RESTING = 50
INCREMENT = 0.002
"""Of a step of 1: 500 increments."""
NOISE = 0.002
dead_times = st.floats(1.0, 8.0).map(lambda cycles: round(cycles * 200) / 200)
lags = st.floats(0.5, 8.0)
factors = st.floats(0.85, 1.15)
seeds = st.integers(0, 1000)


def recorded(
    places: np.ndarray, wanted: np.ndarray, commands: np.ndarray | None = None, **more: object
) -> Recording:
    zeros = np.zeros(len(places))
    return recording_of(
        ["Resting"] * RESTING + ["Responding"] * (len(places) - RESTING),
        CYCLE,
        set_position=wanted,
        act_position=places,
        set_velocity=zeros,
        act_velocity=zeros,
        command=commands,
        resolution=INCREMENT,
        **more,  # type: ignore[arg-type]
    )


def step(height: float = 1.0, count: int = 350) -> np.ndarray:
    return np.where(np.arange(count) >= RESTING, height, 0.0)


def controlled(axis: ServoAxis, gain: float, seed: int = 1, old: int = 0, height: float = 1.0) -> Recording:
    encoder = Encoder(INCREMENT, NOISE, seed)
    wanted = step(height)
    places, commands = axis.controlled(wanted, np.zeros(len(wanted)), gain, old, encoder)
    return recorded(places, wanted, commands)


@settings(max_examples=12, deadline=None)
@given(factors, dead_times, lags, seeds, st.floats(0.1, 0.7), st.sampled_from([1.0, -1.0]))
def test_what_the_controllers_loop_acts_on_is_found(
    factor: float, dead: float, lag: float, seed: int, share: float, height: float
) -> None:
    """Within 2 % and a tenth of a cycle of the sum of times, which decides about the gain; the dead time
    within half a cycle, the factor within 2 %."""
    gain = share / ((dead + lag) * CYCLE)
    recording = controlled(ServoAxis(factor, dead, lag, CYCLE), gain, seed, 2, height)
    found = evaluate(recording, ControllerLoop(gain, 2))
    assert found.problem is None
    assert found.identified is not None
    plant = found.identified
    assert plant.factor == pytest.approx(factor, rel=0.02)
    assert plant.dead_time_s / CYCLE == pytest.approx(dead, abs=0.5)
    assert (plant.dead_time_s + plant.lag_s) / CYCLE == pytest.approx(dead + lag, rel=0.02, abs=0.1)
    assert found.identified.residual < 2 * NOISE
    exact = 0.25 / (factor * CYCLE * (dead + lag + 0.5))
    assert found.proposals[0].gains["position_gain"] == pytest.approx(exact, rel=0.04)


@settings(max_examples=10, deadline=None)
@given(
    st.floats(1.0, 3.0).map(lambda cycles: round(cycles * 200) / 200),
    st.floats(0.7, 4.0),
    st.sampled_from([0.0, 8.0, 20.0]),
    st.floats(0.1, 0.3),
    st.floats(0.0, 0.1),
    seeds,
)
def test_the_lag_of_the_velocity_loop_of_a_drive_is_found(
    dead: float, lag: float, integral: float, share: float, friction: float, seed: int
) -> None:
    """Within 6 % and a quarter of a cycle, also behind a friction of a tenth of the torque of the step."""
    gain = share / (lag * CYCLE)
    time = integral * lag * CYCLE
    drive = ServoDrive(lag, 0.25, dead, gain, time, CYCLE, friction * gain)
    recording = recorded(drive.answer(step(), Encoder(INCREMENT, NOISE, seed)), step())
    loops = DriveLoops(gain, 0.03, time, 0.25 * CYCLE)
    found = evaluate(recording, loops)
    assert found.problem is None
    assert found.identified is not None
    assert found.identified.dead_time_s / CYCLE == pytest.approx(dead, abs=0.3)
    assert found.identified.lag_s / CYCLE == pytest.approx(lag, rel=0.06, abs=0.25)
    inertia = found.identified.lag_s * 0.03
    assert found.proposals[0].gains["velocity_gain"] == pytest.approx(inertia / (3 * 0.25 * CYCLE))


def test_the_prediction_is_what_comes_with_the_new_gain() -> None:
    axis = ServoAxis(1.02, 2.5, 3.0, CYCLE)
    found = evaluate(controlled(axis, 20.0), ControllerLoop(20.0))
    assert found.figures is not None
    for proposal in found.proposals:
        old = found.figures.dead_time_cycles
        assert old is not None
        known, _ = axis.controlled(step(), np.zeros(350), proposal.gains["position_gain"], old, Encoder())
        np.testing.assert_allclose(proposal.answer, known, atol=0.02)


@pytest.mark.parametrize("damping", [0.4, 0.7])
def test_the_figures_are_those_of_a_system_of_second_order(damping: float) -> None:
    """Overshoot exp(-pi d / sqrt(1 - d2)); rise and settling time by scipy."""
    omega = 60.0
    fine = np.linspace(0, 0.6, 60_001)
    _, curve = step_response(TransferFunction([omega**2], [1, 2 * damping * omega, omega**2]), T=fine)
    times = np.arange(300) * CYCLE
    places = np.concatenate([np.zeros(RESTING), np.interp(times, fine, curve)])
    found = figures(replace(recorded(3 * places, step(3.0)), resolution=0.0))
    known = np.exp(-np.pi * damping / np.sqrt(1 - damping**2))
    assert found.overshoot == pytest.approx(known, abs=0.003)
    rise = fine[np.argmax(curve >= 0.9)] - fine[np.argmax(curve >= 0.1)]
    assert found.rise_time_s == pytest.approx(rise, abs=2e-4)
    settled = fine[np.flatnonzero(np.abs(curve - 1) > 0.02)[-1]]
    assert found.settling_time_s == pytest.approx(settled, abs=CYCLE)
    assert found.steady_error == pytest.approx(0.0, abs=1e-3)


@pytest.mark.parametrize("dead", [1.0, 2.0, 3.0, 5.0])
def test_the_dead_time_is_counted_from_the_first_motion_to_the_first_reaction(dead: float) -> None:
    """AXIS-40, devices EX-07: as one reads it off a trace, at a drive that follows within a cycle."""
    recording = controlled(ServoAxis(1.0, dead, 0.05, CYCLE), 30.0, old=3)
    assert figures(recording).dead_time_cycles == dead + 1  # it is at the end of the next cycle elsewhere
    wanted = np.clip((np.arange(200) - RESTING) / 4, 0, 1)
    places = np.interp(np.arange(200) - dead, np.arange(200), wanted)
    assert figures(recorded(places, wanted)).dead_time_cycles == dead


def test_a_rotary_axis_may_pass_its_zero() -> None:
    wanted = 359.5 + step()
    places = wanted - 0.01
    recording = recorded(places % 360.0, wanted % 360.0, period=360.0)
    assert recording.height == pytest.approx(1.0)
    assert recording.act_position[-1] == pytest.approx(1.0)


def evaluated(recording: Recording, loop: ControllerLoop | DriveLoops, torque: float | None = None) -> str:
    found = evaluate(recording, loop, torque)
    assert found.proposals == ()
    assert found.problem is not None
    return found.problem


def test_bad_data_is_said_and_nothing_is_proposed() -> None:
    loop = ControllerLoop(20.0)
    good = controlled(ServoAxis(1.0, 2.0, 2.0, CYCLE), 20.0)
    assert evaluate(good, loop).problem is None
    still = replace(good, act_position=good.act_position * 0.0)
    assert "did not follow the set position" in evaluated(still, loop)
    small = replace(good, resolution=0.1)
    assert "only 10.0 increments" in evaluated(small, loop)
    assert good.command is not None
    clipped = replace(good, command=np.clip(good.command, -10, 10))
    assert "velocity of the drive was at its limit" in evaluated(
        clipped, replace(loop, largest_velocity=10.0)
    )
    drive = DriveLoops(20.0, 0.03, 0.02, 0.0005)
    full = replace(good, torque=-np.minimum(8.0 * step(), 3.8))
    assert "torque of the drive was at its limit" in evaluated(full, drive, 3.8)
    against = replace(good, act_position=-good.act_position)
    assert "moves against the set position" in evaluated(against, loop)
    other = replace(good, act_position=step() * np.sin(np.arange(len(good.act_position)) / 7.0))
    assert "not that of a position loop" in evaluated(other, loop)
    move = replace(good, set_position=np.clip((np.arange(350) - RESTING) / 10, 0, 1))
    assert "measure a step for their gains" in evaluated(move, drive)
    assert "must be above 0" in evaluated(good, replace(drive, position_gain=0.0))


def test_a_measurement_that_was_cut_off_is_refused() -> None:
    with pytest.raises(UnusableMeasurementError, match="only 3 cycles at rest and 4 of the answer"):
        recording_of(
            ["Idle"] * 5 + ["Resting"] * 3 + ["Responding"] * 4,
            CYCLE,
            set_position=np.zeros(12),
            act_position=np.zeros(12),
            set_velocity=np.zeros(12),
            act_velocity=np.zeros(12),
        )
