"""The winder keeps its web tight by torque, changes full rolls, and stops when the web breaks."""

from __future__ import annotations

import pytest
from tests.projects.example_machines import machine, number, run

from tappet.runtime.local import LocalRuntime

CORE, LARGEST, TENSION, TAPER, SPEED = 50.0, 150.0, 30.0, 0.3, 1500.0


def _until(winder: LocalRuntime, state: str, seconds: float = 60.0) -> None:
    for _ in range(round(seconds / 0.05)):
        if winder.literal("GVL_Winder.eState") == state:
            return
        run(winder, 0.05)
    pytest.fail(f"the winder is in {winder.literal('GVL_Winder.eState')}, not in {state}")


def test_the_tension_is_that_of_the_radius() -> None:
    """Torque of the motor = tension * radius / gear, which the web answers with its tension."""
    with machine("winder", 7.0) as winder:
        assert winder.literal("Winder.byRealControllerMode") == "1"
        radii = []
        while winder.literal("GVL_Winder.eState") == "Wind":
            radius = number(winder, "GVL_Plant.lrRadius")
            wanted = TENSION * (1.0 - TAPER * (1.0 - CORE / radius))
            assert number(winder, "GVL_Plant.lrTension") == pytest.approx(wanted, rel=0.04)
            assert number(winder, "GVL_Winder.lrRadius") == pytest.approx(radius, abs=2.0)
            turns = number(winder, "Winder.fActVelocity") / 360.0
            assert 6.283185 * turns * radius == pytest.approx(SPEED, rel=0.01)
            radii.append(radius)
            run(winder, 0.5)
        assert radii[0] < 90.0
        assert radii[-1] > 145.0


def test_a_full_roll_is_changed_at_standstill() -> None:
    with machine("winder", 3.0) as winder:
        _until(winder, "Full")
        assert number(winder, "GVL_Plant.lrRadius") >= LARGEST - 2.0
        _until(winder, "Change")
        run(winder, 0.1)
        assert number(winder, "Nip.fSetVelocity") == 0.0
        assert number(winder, "Winder_Drive.fVelocity") == pytest.approx(0.0, abs=0.05)
        assert number(winder, "GVL_Winder.udiRolls") == 1.0
        _until(winder, "Wind")
        run(winder, 6.0)
        assert number(winder, "GVL_Plant.lrTension") > 24.0
        assert winder.read("Winder.bError") is False


def test_a_broken_web_stops_the_winder_until_it_is_mended() -> None:
    with machine("winder", 10.0) as winder:
        winder.write("GVL_Plant.xBreaks", True)
        run(winder, 1.0)
        assert winder.literal("GVL_Winder.eState") == "Broken"
        assert number(winder, "GVL_Plant.lrTension") == 0.0
        run(winder, 8.0)
        assert number(winder, "Nip.fSetVelocity") == 0.0
        assert abs(number(winder, "Winder.fActVelocity")) < 1.0
        assert winder.read("Winder.bRegulatorOn") is False
        winder.write("GVL_Winder.xMend", True)
        run(winder, 8.0)
        assert winder.literal("GVL_Winder.eState") == "Wind"
        assert number(winder, "GVL_Plant.lrTension") > 20.0
        assert winder.read("GVL_Plant.xBreaks") is False
