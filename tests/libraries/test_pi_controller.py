"""SMC_PI against scipy, closed forms and a loop with a limited actuator."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np
import pytest
from scipy.signal import cont2discrete, lfilter
from tests.libraries.st_program import Program, run

CYCLE = 0.002
PROGRAM = f"""
PROGRAM Main
VAR
    Pi       : SM3_Basic.SMC_PI := (fCycle := {CYCLE});
    xPlant   : BOOL;          (* fActValue follows fOut with a lag of the first order *)
    fLag     : LREAL := 0.1;  (* [s] *)
END_VAR
IF xPlant THEN
    Pi.fActValue := Pi.fOut + (Pi.fActValue - Pi.fOut) * EXP(-{CYCLE} / fLag);
END_IF
Pi();
END_PROGRAM
"""


@pytest.fixture
def program() -> Iterator[Program]:
    with run(PROGRAM, 0, CYCLE * 1000) as running:
        yield running


def out(program: Program, name: str = "fOut") -> float:
    return float(program.literal(f"Main.Pi.{name}"))


def test_it_is_the_bilinear_transform_of_the_controller(program: Program) -> None:
    """Random deviations, by scipy's discrete form of kp * (1 + 1 / (tn * s))."""
    kp, tn = 2.5, 0.03
    numerator, denominator, _ = cont2discrete(([kp * tn, kp], [tn, 0.0]), CYCLE, "bilinear")
    deviations = np.random.default_rng(1).normal(size=300)
    deviations[0] = 0.0
    expected = lfilter(numerator.ravel(), denominator, deviations)
    program.set("Main.Pi", bEnable=True, fKp=kp, fTn=tn)
    for deviation, wanted in zip(deviations, expected, strict=True):
        program.set("Main.Pi", fSetValue=deviation)
        program.cycle()
        assert out(program) == pytest.approx(wanted, abs=1e-11)


def test_a_closed_loop_follows_its_closed_form(program: Program) -> None:
    """Plant 1 / (1 + lag * s) with tn = lag: the loop is of the first order, with the time lag / kp."""
    kp, lag = 2.0, 0.1
    program.set("Main", xPlant=True, fLag=lag)
    program.set("Main.Pi", fKp=kp, fTn=lag)
    program.cycle()
    program.set("Main.Pi", bEnable=True, fStart=kp, fSetValue=1.0)
    for count in range(400):
        program.cycle()
        expected = 1.0 - math.exp(-count * CYCLE * kp / lag)
        assert out(program, "fActValue") == pytest.approx(expected, abs=1.5 * CYCLE * kp / lag)
    assert out(program) == pytest.approx(1.0, abs=1e-6)


@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_at_a_limit_the_integral_stands(program: Program, sign: float) -> None:
    """A deviation that turns round leaves the limit in the same call: nothing has wound up."""
    program.set("Main.Pi", bEnable=True, fKp=1.0, fTn=0.01, fOutMin=-5.0, fOutMax=5.0, fSetValue=sign)
    for _ in range(2000):
        program.cycle()
    assert (out(program), program.literal("Main.Pi.bLimited")) == (5.0 * sign, "TRUE")
    program.set("Main.Pi", fSetValue=-0.1 * sign)
    program.cycle()
    assert abs(out(program)) < 5.0
    assert program.literal("Main.Pi.bLimited") == "FALSE"


def test_the_integral_that_just_reaches_the_limit_stays_there(program: Program) -> None:
    program.set("Main.Pi", bEnable=True, fKp=1.0, fTn=CYCLE, fOutMin=-1.5, fOutMax=1.5, fSetValue=0.4)
    for _ in range(10):
        program.cycle()
    assert out(program) == 1.5
    program.set("Main.Pi", fSetValue=0.0)
    program.cycle()
    assert out(program) == pytest.approx(1.1 + 0.5 * 0.4, abs=1e-12)


def test_it_begins_without_a_step_and_holds(program: Program) -> None:
    program.set("Main.Pi", bEnable=True, fKp=3.0, fTn=0.5, fSetValue=7.0, fStart=0.25, fFeedForward=10.0)
    program.cycle()
    assert out(program) == pytest.approx(0.25, abs=1e-12)
    program.set("Main.Pi", bHold=True)
    for _ in range(50):
        program.cycle()
    assert out(program) == pytest.approx(0.25, abs=1e-12)
    program.set("Main.Pi", bHold=False)
    program.cycle()
    assert out(program) == pytest.approx(0.25 + CYCLE * 3.0 / 0.5 * 7.0, abs=1e-12)
    program.set("Main.Pi", bEnable=False)
    program.cycle()
    assert (out(program), program.literal("Main.Pi.bBusy")) == (0.0, "FALSE")


def test_without_an_integral_time_it_is_proportional(program: Program) -> None:
    program.set(
        "Main.Pi", bEnable=True, fKp=-2.0, fSetValue=3.0, fActValue=1.0, fFeedForward=0.5, fStart=99.0
    )
    for _ in range(20):
        program.cycle()
    assert out(program) == -3.5


@pytest.mark.parametrize("pin", ["fSetValue", "fActValue", "fKp", "fTn", "fFeedForward", "fOutMin", "fCycle"])
@pytest.mark.parametrize("value", [math.nan, math.inf, -math.inf, 1e300])
def test_values_that_are_no_numbers_are_errors_and_forgotten(
    program: Program, pin: str, value: float
) -> None:
    program.set("Main.Pi", bEnable=True, fTn=0.1, fSetValue=1.0)
    program.cycle()
    before = out(program, pin)
    program.set("Main.Pi", **{pin: value})
    program.cycle()
    if not (pin == "fTn" and value > 0.0):
        assert program.literal("Main.Pi.eErrorID") == "SMC_PI_INVALID_VALUES"
        assert out(program) == 0.0
    program.set("Main.Pi", **{pin: before})
    program.cycle()
    assert program.literal("Main.Pi.bError") == "FALSE"
    assert math.isfinite(out(program))
