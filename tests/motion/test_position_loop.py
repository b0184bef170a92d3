"""Answers, margins and gains of the controller's position loop against simulations by scipy."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from servo_axis import Encoder, ServoAxis

from tappet.motion.loops import ControllerLoop
from tappet.motion.position_loop import (
    Plant,
    controller_answer,
    margins,
    plant_answer,
    proposed_gain,
)

CYCLE = 0.002
EXACT = Encoder()
dead_times = st.floats(0.5, 8.0).map(lambda cycles: round(cycles * 200) / 200)
lags = st.floats(0.3, 10.0)
factors = st.floats(0.8, 1.25)


def step(count: int, at: int = 10) -> np.ndarray:
    return np.where(np.arange(count) >= at, 1.0, 0.0)


@settings(max_examples=10, deadline=None)
@given(factors, dead_times, lags, st.integers(0, 5))
def test_the_controllers_loop_answers_as_scipy_says(factor: float, dead: float, lag: float, old: int) -> None:
    axis = ServoAxis(factor, dead, lag, CYCLE)
    gain = 0.3 / ((dead + lag) * CYCLE)
    where = step(120)
    speeds = 0.5 * np.sin(np.arange(120) / 9)
    known, commands = axis.controlled(where, speeds, gain, old, EXACT)
    plant = Plant(factor, dead * CYCLE, lag * CYCLE)
    loop = ControllerLoop(gain, old)
    np.testing.assert_allclose(controller_answer(loop, plant, where, speeds, CYCLE), known, atol=1e-9)
    np.testing.assert_allclose(plant_answer(plant, commands, CYCLE), known, atol=1e-9)


@settings(max_examples=100, deadline=None)
@given(factors, st.floats(0.5, 8.0), st.floats(0.0, 10.0), st.sampled_from(["no_overshoot", "fast"]))
def test_margins_are_those_of_the_frequency_response(
    factor: float, dead: float, lag: float, aim: str
) -> None:
    """Read off the frequency response of Kp b exp(-s T) / (s (1 + s T1)); the proposals have ample ones."""
    plant = Plant(factor, dead * CYCLE, lag * CYCLE)
    gain = proposed_gain(plant, CYCLE, aim)  # type: ignore[arg-type]
    s = 1j * np.geomspace(1e-3, 1e2, 400_001) * gain
    response = gain * factor * np.exp(-s * (plant.dead_time_s + CYCLE / 2)) / (s * (1 + s * plant.lag_s))
    phases = np.unwrap(np.angle(response))
    crossover = int(np.argmax(np.abs(response) < 1.0))
    turn = int(np.argmax(phases < -math.pi))
    found = margins(plant, CYCLE, gain)
    assert found.phase_deg == pytest.approx(180 + math.degrees(phases[crossover]), abs=0.05)
    assert found.gain == pytest.approx(1 / abs(response[turn]), rel=1e-3)
    assert found.phase_deg > (60 if aim == "fast" else 74)
    assert found.gain > (3 if aim == "fast" else 6)


@settings(max_examples=15, deadline=None)
@given(factors, dead_times, lags)
def test_the_proposed_gains_overshoot_as_they_say(factor: float, dead: float, lag: float) -> None:
    axis = ServoAxis(factor, dead, lag, CYCLE)
    plant = Plant(factor, dead * CYCLE, lag * CYCLE)
    most = {}
    for aim in ("no_overshoot", "fast"):
        gain = proposed_gain(plant, CYCLE, aim)  # type: ignore[arg-type]
        count = 20 + round(15 * (dead + lag + 1))
        most[aim] = float(np.max(axis.controlled(step(count), np.zeros(count), gain, 0, EXACT)[0]))
    assert most["no_overshoot"] < 1.001
    assert 1.0 < most["fast"] < 1.06
