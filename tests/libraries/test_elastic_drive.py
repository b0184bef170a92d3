"""The elastic shaft of the simulated drive against closed forms and scipy."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from contextlib import contextmanager

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from tests.libraries.st_program import Program, run

CYCLE = 0.001
RADIANS = 2 * math.pi / 65536
MOTOR, LOAD = 4e-5, 9e-5
KP, TN, TAU, KV = 0.03, 0.02, 0.0005, 60.0
PROGRAM = """
PROGRAM Main
VAR
    Drive   : SM3_Basic.SimulatedDrive := (stSettings := (fInertia := 4E-5, fLoadInertia := 9E-5,
        diMaxLag := 0, {settings}));
    Control : SM3_Basic.CiA402Control;
END_VAR
Control(wStatusWord := Drive.stIn.wStatusWord, bStart := TRUE);
Drive.stOut.wControlWord := Control.wControlWord;
Drive(fCycle := 0.001);
END_PROGRAM
"""
FREE = "fDry := 0.0, fViscous := 0.0"


@contextmanager
def drive(settings: str) -> Iterator[Program]:
    with run(PROGRAM.format(settings=settings), 3, CYCLE * 1000) as program:
        yield program


def number(program: Program, name: str) -> float:
    return float(program.literal(f"Main.{name}"))


def switch_on(program: Program, mode: int) -> None:
    program.set("Main.Drive", **{"stOut.byModesOfOperation": mode})
    program.set("Main.Control", bPower=True)
    for _ in range(10):
        program.cycle()
    assert program.literal("Main.Control.bFollows") == "TRUE"


def motion(program: Program, cycles: int) -> np.ndarray:
    """Angles and velocities of motor and load, a row each cycle."""
    found = []
    for _ in range(cycles):
        program.cycle()
        found.append(
            [number(program, f"Drive.f{name}") for name in ("Angle", "Velocity", "LoadAngle", "LoadVelocity")]
        )
    return np.array(found)


@pytest.mark.parametrize("stiffness", [1e-3, 0.1, 10.0, 300.0, 3000.0, 1e5])
@pytest.mark.parametrize("ratio", [0.0, 0.02, 0.3])
def test_a_free_shaft_oscillates_as_its_closed_form(stiffness: float, ratio: float) -> None:
    """A load torque steps: the twist has the eigenfrequency, the centre of gravity accelerates evenly."""
    inverse = 1 / MOTOR + 1 / LOAD
    omega = math.sqrt(stiffness * inverse)
    damping = 2 * ratio * omega / inverse
    torque = 0.05
    with drive(f"{FREE}, fStiffness := {stiffness:.17E}, fDamping := {damping:.17E}") as program:
        program.set("Main.Drive", fLoadTorque=torque)
        found = motion(program, 300)
    times = np.arange(1, 301) * CYCLE
    damped = omega * math.sqrt(1 - ratio**2)
    decay = np.exp(-ratio * omega * times)
    still = torque / LOAD / omega**2
    twist = still * (1 - decay * (np.cos(damped * times) + ratio * omega / damped * np.sin(damped * times)))
    centre = -0.5 * torque / (MOTOR + LOAD) * times**2
    np.testing.assert_allclose(
        found[:, 0], centre + LOAD / (MOTOR + LOAD) * twist, rtol=1e-7, atol=1e-7 * still
    )
    np.testing.assert_allclose(
        found[:, 2], centre - MOTOR / (MOTOR + LOAD) * twist, rtol=1e-7, atol=1e-7 * still
    )


def test_a_load_swings_on_a_motor_that_sticks() -> None:
    """The torque of the shaft stays below the dry friction: the eigenfrequency is that of the load alone."""
    stiffness = 5.0
    with drive(f"fDry := 0.5, fStiffness := {stiffness}, fDamping := 0.0") as program:
        program.set("Main.Drive", fLoadTorque=0.1)
        found = motion(program, 200)
    times = np.arange(1, 201) * CYCLE
    omega = math.sqrt(stiffness / LOAD)
    assert np.abs(found[:, :2]).max() == 0.0
    np.testing.assert_allclose(found[:, 2], -0.1 / stiffness * (1 - np.cos(omega * times)), atol=1e-10)


def simulated(
    torque: Callable[[float, np.ndarray], float],
    settings: dict[str, float],
    extra: int,
    times: np.ndarray,
    more: Callable[[float, np.ndarray], list[float]],
) -> np.ndarray:
    """Motion by scipy: state is both angles and velocities, then `extra` states whose rates `more` says."""
    k, c, b, dry = (settings[name] for name in ("k", "c", "b", "dry"))

    def rates(time: float, state: np.ndarray) -> list[float]:
        motor, turning, load, swinging = state[:4]
        shaft = k * (motor - load) + c * (turning - swinging)
        friction = b * turning + dry * math.tanh(turning / 1e-4)
        return [
            turning,
            (torque(time, state) - shaft - friction) / MOTOR,
            swinging,
            shaft / LOAD,
            *more(time, state),
        ]

    known = solve_ivp(
        rates,
        (0.0, times[-1]),
        [0.0] * (4 + extra),
        t_eval=times,
        method="LSODA",
        rtol=1e-9,
        atol=1e-12,
        max_step=CYCLE / 4,
    )
    return np.asarray(known.y.T)


@pytest.mark.parametrize("stiffness", [2.0, 50.0, 1000.0])
def test_a_torque_step_moves_motor_and_load_as_scipy_says(stiffness: float) -> None:
    """The current follows its set value by its time constant; friction is dry and by velocity."""
    settings = {"k": stiffness, "c": 0.001, "b": 1e-4, "dry": 0.01}
    with drive(f"fStiffness := {stiffness}") as program:
        switch_on(program, 10)
        program.set("Main.Drive", **{"stOut.wSetTorque": 200})
        found = motion(program, 150)
    times = np.arange(1, 151) * CYCLE
    wanted = 0.2 * 1.27
    known = simulated(lambda _, s: s[4], settings, 1, times, lambda _, s: [(wanted - s[4]) / TAU])
    for column in range(4):
        largest = np.abs(known[:, column]).max()
        np.testing.assert_allclose(found[:, column], known[:, column], atol=0.01 * largest)


@pytest.mark.parametrize("stiffness", [2.0, 50.0, 1000.0])
def test_the_closed_loops_move_the_load_as_scipy_says(stiffness: float) -> None:
    """Position P, velocity PI, current of first order; the set position comes within a cycle."""
    settings = {"k": stiffness, "c": 0.002, "b": 1e-4, "dry": 0.0}
    step = 200 * RADIANS
    with drive(f"fStiffness := {stiffness}, fDamping := 0.002, fDry := 0.0, fFeedForward := 0.0") as program:
        switch_on(program, 8)
        program.set("Main.Drive", **{"stOut.diSetPosition": 200})
        found = motion(program, 200)
    times = np.arange(1, 201) * CYCLE

    def error(time: float, state: np.ndarray) -> float:
        return KV * (step * min(time / CYCLE, 1.0) - float(state[0])) - float(state[1])

    known = simulated(
        lambda _, s: s[4],
        settings,
        2,
        times,
        lambda t, s: [(KP * (error(t, s) + s[5]) - s[4]) / TAU, error(t, s) / TN],
    )
    np.testing.assert_allclose(found[:, 0], known[:, 0], atol=0.02 * step)
    np.testing.assert_allclose(found[:, 2], known[:, 2], atol=0.02 * step)


@pytest.mark.parametrize("stiffness", [0.0, 1e-9, 1e-3, 1.0, 1e2, 1e4, 1e5, 1e6, 1e9, 1e300])
@pytest.mark.parametrize("damping", [0.0, 0.001, 1.0, 1e6, 1e300])
def test_motion_stays_bounded_at_any_stiffness(stiffness: float, damping: float) -> None:
    """The torque of the motor is bounded and friction takes energy: no part of the cycle may add any."""
    with drive(f"fStiffness := {stiffness:.17E}, fDamping := {damping:.17E}") as program:
        switch_on(program, 10)
        program.set("Main.Drive", **{"stOut.wSetTorque": 500})
        motion(program, 5)
        program.set("Main.Drive", **{"stOut.wSetTorque": 0})
        motion(program, 10)
        fastest = math.sqrt((MOTOR + LOAD) / MOTOR) * 0.635 * 0.006 / min(MOTOR, LOAD)
        found = motion(program, 300)
        assert np.isfinite(found).all()
        assert np.abs(found[:, [1, 3]]).max() < fastest
        if program.literal("Main.Drive.fbShaft.bFollows") == "TRUE":
            energy = [
                MOTOR * v * v + LOAD * w * w + stiffness * (a - b) ** 2 for a, v, b, w in found.tolist()
            ]
            assert (np.diff(energy) <= 1e-9 * max(energy)).all()


@pytest.mark.parametrize(
    "settings",
    [{"fStiffness": 1e7}, {"fStiffness": -1.0}, {"fStiffness": 0.0}, {"fDamping": 1e9}, {"fDamping": -1.0}],
)
def test_a_shaft_that_cannot_be_followed_is_rigid(settings: dict[str, float]) -> None:
    """Exactly as a motor that has both inertias."""
    together = {"fLoadInertia": 0.0, "fInertia": MOTOR + LOAD}
    found = []
    for changes in (settings, together):
        with drive("fNoise := 0.0") as program:
            program.set("Main.Drive.stSettings", **changes)
            switch_on(program, 8)
            program.set("Main.Drive", **{"stOut.diSetPosition": 5000})
            found.append(motion(program, 100))
    np.testing.assert_allclose(found[0], found[1], rtol=1e-12)
    np.testing.assert_array_equal(found[0][:, 0], found[0][:, 2])


def test_a_shaft_is_taken_away_and_comes_back_without_a_twist() -> None:
    with drive(f"{FREE}, fStiffness := 5.0") as program:
        program.set("Main.Drive", fLoadTorque=0.05)
        motion(program, 20)
        program.set("Main.Drive.stSettings", fLoadInertia=0.0)
        motion(program, 20)
        program.set("Main.Drive.stSettings", fLoadInertia=LOAD)
        (found,) = motion(program, 1)
        omega = math.sqrt(5.0 * (1 / MOTOR + 1 / LOAD))
        twist = 0.05 / LOAD / omega**2 * (1 - math.cos(omega * CYCLE))
        assert found[0] - found[2] == pytest.approx(twist, rel=0.02)
