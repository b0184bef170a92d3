"""The gantry homes, squares its bridge, and keeps it square at work."""

from __future__ import annotations

import pytest
from tests.projects.example_machines import machine, number, run

from tappet.runtime.local import LocalRuntime

WHERE_SWITCHES_OPEN = 100.0


def _askew(gantry: LocalRuntime) -> float:
    return number(gantry, "GVL_Plant.lrPlace1") - number(gantry, "GVL_Plant.lrPlace2")


def test_homing_finds_what_the_bridge_is_askew() -> None:
    with machine("gantry") as gantry:
        assert _askew(gantry) == pytest.approx(3.0)
        states = []
        while gantry.literal("GVL_Gantry.eState") != "Work":
            state = gantry.literal("GVL_Gantry.eState")
            if not states or states[-1] != state:
                states.append(state)
            run(gantry, 0.002)
        assert states == ["Off", "Couple", "Home", "Leave", "Square"]
        # the switches are sampled once in 2 ms at 10 mm/s
        assert number(gantry, "GVL_Gantry.lrSkew") == pytest.approx(3.0, abs=0.05)
        assert abs(_askew(gantry)) < 0.05
        place = number(gantry, "GVL_Plant.lrPlace1") - WHERE_SWITCHES_OPEN
        assert number(gantry, "X1.fSetPosition") == pytest.approx(place, abs=0.1)


def test_the_bridge_stays_square_at_work() -> None:
    with machine("gantry", 15.0) as gantry:
        askew = _askew(gantry)
        fastest = 0.0
        for _ in range(2000):
            run(gantry, 0.004)
            fastest = max(fastest, abs(number(gantry, "X1.fSetVelocity")))
            assert _askew(gantry) == pytest.approx(askew, abs=1e-6)
        assert fastest == pytest.approx(800.0)
        assert number(gantry, "GVL_Gantry.udiStrokes") >= 5.0
        assert gantry.read("X2.bError") is False
