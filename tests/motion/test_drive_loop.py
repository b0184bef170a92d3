"""Answers, margins and gains of the loops of a drive against scipy and closed forms."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.integrate import solve_ivp
from scipy.signal import TransferFunction, bode, lsim
from servo_axis import Encoder, ServoDrive

from tappet.motion.drive_loop import (
    drive_answer,
    drive_margins,
    friction_answer,
    proposed_loops,
)
from tappet.motion.loops import Aim, DriveLoops

CYCLE = 0.002
AIMS: tuple[Aim, ...] = ("no_overshoot", "fast")
lags = st.floats(0.001, 0.02)
times = st.floats(0.0002, 0.001)


def step(count: int, at: int = 10) -> np.ndarray:
    return np.where(np.arange(count) >= at, 1.0, 0.0)


@settings(max_examples=10, deadline=None)
@given(
    lags,
    times,
    st.sampled_from([0.0, 4.0, 20.0]),
    st.floats(0.05, 0.4),
    st.floats(1.0, 4.0).map(lambda cycles: round(cycles * 200) / 200),
)
def test_the_answer_is_the_one_of_scipy(
    lag: float, current: float, integral: float, share: float, dead: float
) -> None:
    loops = DriveLoops(share / lag, 0.03, integral * lag, current)
    wanted = np.clip((np.arange(150) - 10) / 10, 0, 1)
    drive = ServoDrive(lag / CYCLE, current / CYCLE, dead, loops.position_gain, loops.integral_time_s, CYCLE)
    known = drive.answer(wanted, Encoder())
    np.testing.assert_allclose(drive_answer(loops, lag, dead * CYCLE, wanted, CYCLE), known, atol=1e-3)


def test_the_answer_of_a_p_loop_is_that_of_solve_ivp() -> None:
    """Without an integral part; the set position goes up within a cycle."""
    lag, current, gain = 0.004, 0.0005, 60.0

    def motion(time: float, state: np.ndarray) -> list[float]:
        wanted = gain * (min(time / CYCLE, 1.0) - state[0])
        return [state[1], state[2] / lag, (wanted - state[1] - state[2]) / current]

    at = np.arange(100) * CYCLE
    known = solve_ivp(motion, (0, at[-1]), [0, 0, 0], t_eval=at, rtol=1e-9, atol=1e-12, max_step=CYCLE / 8)
    found = drive_answer(DriveLoops(gain, 1.0, 0.0, current), lag, 0.0, step(101, 1), CYCLE)
    np.testing.assert_allclose(found[:-1], known.y[0], atol=1e-6)


@pytest.mark.parametrize("integral", [0.0, 0.02])
def test_friction_is_a_step_of_torque(integral: float) -> None:
    """By lsim, as a disturbance of the motor; a P loop stays behind by 1 / Kp."""
    lag, current, gain = 0.003, 0.0005, 50.0
    free = np.polymul([integral, 0.0] if integral else [1.0], [current, 1.0])
    control = [integral, 1.0] if integral else [1.0]
    inert = np.polymul([lag, 0.0, 0.0], free)
    system = TransferFunction(-free, np.polyadd(inert, np.polymul(control, [1.0, gain])))
    fine = np.arange(400) * CYCLE
    _, known, _ = lsim(system, np.ones(400), fine)
    found = friction_answer(DriveLoops(gain, 1.0, integral, current), lag, CYCLE, 0, 400, CYCLE)
    np.testing.assert_allclose(found, known, atol=1e-9)
    assert found[-1] == pytest.approx(0.0 if integral else -1.0 / gain, abs=1e-6)


@settings(max_examples=30, deadline=None)
@given(lags, times, st.sampled_from([0.0, 5.0, 20.0]), st.floats(0.05, 0.5))
def test_margins_are_those_of_a_bode_plot(lag: float, current: float, integral: float, share: float) -> None:
    loops = DriveLoops(share / lag, 1.0, integral * lag, current)
    ti = loops.integral_time_s
    control = [ti, 1.0] if ti else [1.0]
    inert = np.polymul([lag, 0.0], np.polymul([ti, 0.0] if ti else [1.0], [current, 1.0]))
    inner = np.polymul(control, [loops.position_gain])
    whole = np.polymul([1.0, 0.0], np.polyadd(inert, control))
    omega = np.geomspace(1e-2 * share / lag, 1e4 / lag, 200_000)
    for system, found in zip(((inner, whole), (control, inert)), drive_margins(loops, lag), strict=True):
        _, size, phase = bode(TransferFunction(*system), omega)
        phase = phase - 360.0 * round((phase[0] + 135.0) / 360.0)
        crossing = int(np.argmax(size < 0.0))
        assert found.phase_deg == pytest.approx(180.0 + phase[crossing], abs=0.1)
        turn = crossing + int(np.argmax(phase[crossing:] <= -180.0))
        if phase[turn] <= -180.0 and found.gain is not None:
            assert found.gain == pytest.approx(10 ** (-size[turn] / 20), rel=0.01)
        else:
            assert (found.gain is None) or found.gain > 100


@settings(max_examples=20, deadline=None)
@given(lags, times)
def test_the_proposed_gains_are_those_of_the_symmetrical_optimum(lag: float, current: float) -> None:
    """Phase margins of the textbook: atan(a) - atan(1/a); no overshoot of the position by scipy."""
    before = DriveLoops(10.0, 0.03, 0.1, current)
    rises = []
    for aim, a in zip(AIMS, (3.0, 1.0 + math.sqrt(2.0)), strict=True):
        new = proposed_loops(before, lag, aim)
        assert new.velocity_gain * a * current == pytest.approx(0.03 * lag)
        assert new.integral_time_s == pytest.approx(a * a * current)
        of_new = lag * before.velocity_gain / new.velocity_gain
        position, velocity = drive_margins(new, of_new)
        assert velocity.phase_deg == pytest.approx(math.degrees(math.atan(a) - math.atan(1 / a)), abs=0.05)
        assert position.phase_deg > 60
        assert position.gain is not None
        assert position.gain > 3
        kp, ti = new.position_gain, new.integral_time_s
        inert = np.polymul([of_new * ti, 0.0, 0.0, 0.0], [current, 1.0])
        whole = np.polyadd(inert, np.polymul([ti, 1.0], [1.0, kp]))
        fine = np.linspace(0, 12 / kp, 4000)
        _, answer = TransferFunction(np.polymul([kp], [ti, 1.0]), whole).step(T=fine)
        assert float(np.max(answer)) < 1.002
        rises.append(fine[np.argmax(answer > 0.9)])
    assert rises[1] < rises[0]
