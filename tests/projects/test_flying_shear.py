"""The flying shear cuts to length while the web moves."""

from __future__ import annotations

import pytest
from tests.projects.example_machines import machine, number, run


def test_pieces_have_their_length_to_the_micrometre() -> None:
    with machine("flying_shear", 61.0) as shear:
        assert number(shear, "GVL_Shear.udiPieces") == pytest.approx(60.0 * 300.0 / 600.0, abs=1)
        assert number(shear, "GVL_Shear.lrWorst") < 1e-3
        assert shear.read("Shear.bError") is False


def test_another_length_and_speed_hold_from_the_next_piece_on() -> None:
    with machine("flying_shear", 10.0) as shear:
        shear.write("GVL_Shear.lrLength", 517.25)
        shear.write("GVL_Shear.lrSpeed", 250.0)
        run(shear, 10.0)
        assert number(shear, "GVL_Shear.lrLastLength") == pytest.approx(517.25, abs=1e-3)
        pieces = number(shear, "GVL_Shear.udiPieces")
        run(shear, 30.0)
        made = number(shear, "GVL_Shear.udiPieces") - pieces
        assert made == pytest.approx(30.0 * 250.0 / 517.25, abs=1)
        assert number(shear, "GVL_Shear.lrWorst") < 1e-3


def test_the_blade_moves_with_the_web_while_it_is_down() -> None:
    with machine("flying_shear", 5.0) as shear:
        seen = 0
        for _ in range(1000):
            run(shear, 0.004)
            if number(shear, "GVL_Plant.lrBlade") < 90.0 and shear.read("GVL_Shear.xBlade") is True:
                seen += 1
                assert number(shear, "Shear.fSetVelocity") == pytest.approx(300.0, abs=1e-6)
        assert seen > 10


@pytest.mark.parametrize("seconds", [8.0, 8.3, 8.7, 9.1, 9.5])
def test_a_web_that_stops_loses_no_piece(seconds: float) -> None:
    with machine("flying_shear", seconds) as shear:
        shear.write("GVL_Shear.xRun", False)
        run(shear, 5.0)
        assert number(shear, "Web.fSetVelocity") == 0.0
        pieces = number(shear, "GVL_Shear.udiPieces")
        shear.write("GVL_Shear.xRun", True)
        run(shear, 20.0)
        assert number(shear, "GVL_Shear.udiPieces") == pytest.approx(pieces + 10.0, abs=1)
        assert number(shear, "GVL_Shear.lrWorst") < 1e-3
        assert shear.read("Shear.bError") is False
