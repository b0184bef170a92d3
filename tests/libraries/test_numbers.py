"""Controllers and statistics against numpy on random signals."""

import numpy as np
import pytest
from tests.libraries.st_program import run

COUNT = 60
GENERATOR = np.random.default_rng(20320)
SIGNAL = GENERATOR.normal(3.0, 2.0, COUNT).astype(np.float32)


def _literals(values: np.ndarray) -> str:
    return "[" + ", ".join(repr(float(value)) for value in values) + "]"


def _outputs(declaration: str, call: str) -> np.ndarray:
    """What `fb` gives at `rOut`, called once every 10 ms with the signal as `rIn`."""
    text = f"""
        PROGRAM Main
        VAR
            {declaration}
            arIn : ARRAY[0..{COUNT - 1}] OF REAL := {_literals(SIGNAL)};
            arOut : ARRAY[0..{COUNT - 1}] OF REAL; rIn : REAL; rOut : REAL; i : INT;
        END_VAR
        rIn := arIn[i];
        {call}
        arOut[i] := rOut;
        i := i + 1;
        END_PROGRAM"""
    with run(text, COUNT) as program:
        return np.array(program.numbers("Main.arOut"))


def test_variance_of_everything_so_far() -> None:
    ours = _outputs("fb : VARIANCE;", "fb(IN := rIn); rOut := fb.OUT;")
    expected = [np.var(SIGNAL[: n + 1], dtype=np.float64) for n in range(COUNT)]
    np.testing.assert_allclose(ours, expected, rtol=1e-6, atol=1e-6)


def test_mean_of_everything_so_far() -> None:
    ours = _outputs("fb : STATISTICS_REAL;", "fb(IN := rIn); rOut := fb.AVG;")
    expected = np.cumsum(SIGNAL, dtype=np.float64) / np.arange(1, COUNT + 1)
    np.testing.assert_allclose(ours, expected, rtol=1e-6)


def test_integral_is_the_trapezoidal_rule() -> None:
    ours = _outputs("fb : INTEGRAL;", "fb(IN := rIn, TM := 7); rOut := fb.OUT;")
    signal = SIGNAL.astype(np.float64)
    expected = [np.trapezoid(signal[: n + 1], dx=7.0) for n in range(COUNT)]
    np.testing.assert_allclose(ours, expected, rtol=1e-6)


def test_derivative_is_the_slope_of_the_best_line_through_four_points() -> None:
    ours = _outputs("fb : DERIVATIVE;", "fb(IN := rIn, TM := 10); rOut := fb.OUT;")
    seconds = np.arange(4) * 0.01
    expected = [np.polyfit(seconds, SIGNAL[n - 3 : n + 1].astype(np.float64), 1)[0] for n in range(3, COUNT)]
    np.testing.assert_allclose(ours[3:], expected, rtol=1e-5)


@pytest.mark.parametrize("block", ["PID", "PID_FIXCYCLE"])
def test_pid_without_limits_is_its_formula(block: str) -> None:
    cycle = ", CYCLE := 0.01" if block == "PID_FIXCYCLE" else ""
    call = f"fb(SET_POINT := rIn, ACTUAL := 1, KP := 1.5, TN := 0.25, TV := 0.02, Y_OFFSET := -2{cycle});"
    ours = _outputs(f"fb : {block};", f"{call} rOut := fb.Y;")
    error = SIGNAL.astype(np.float64) - 1.0
    integral = np.concatenate([[0.0], np.cumsum((error[1:] + error[:-1]) / 2 * 0.01)])
    slope = np.concatenate([[0.0], np.diff(error) / 0.01])
    np.testing.assert_allclose(
        ours, 1.5 * (error + integral / 0.25 + 0.02 * slope) - 2.0, rtol=1e-5, atol=1e-5
    )


def _loop(gain: float, lag: float, cycle: float, steps: int) -> np.ndarray:
    """Answer of the plant dx/dt = (u - x)/lag, 0 <= u <= 2, to a step of the set point; TN = lag."""
    text = f"""
        PROGRAM Main
        VAR fb : PID_FIXCYCLE; rPlant : LREAL; i : INT; arOut : ARRAY[0..{steps - 1}] OF LREAL; END_VAR
        fb(SET_POINT := 1, ACTUAL := LREAL_TO_REAL(rPlant), KP := {gain}, TN := {lag}, Y_MIN := 0, Y_MAX := 2,
           CYCLE := {cycle});
        rPlant := rPlant + (fb.Y - rPlant) * {cycle} / {lag};
        arOut[i] := rPlant;
        i := i + 1;
        END_PROGRAM"""
    with run(text, steps) as program:
        return np.array(program.numbers("Main.arOut"))


def test_pi_control_of_a_lag_is_a_lag_again() -> None:
    """TN = lag cancels the plant's pole: the loop is a lag of lag/KP (the error falls by exp(-t*KP/lag))."""
    gain, lag, cycle = 1.5, 0.2, 0.001
    error = 1.0 - _loop(gain, lag, cycle, 300)
    decay = np.log(error[0] / error[-1]) / (299 * cycle)
    assert decay == pytest.approx(gain / lag, rel=0.01)


def test_an_actuator_at_its_limit_does_not_wind_up_the_integral() -> None:
    """The same loop with a gain that wants 4 where the actuator gives 2: no overshoot follows."""
    answer = _loop(4.0, 0.2, 0.001, 1500)
    assert answer.max() < 1.001
    assert answer[-1] == pytest.approx(1.0, abs=0.001)
