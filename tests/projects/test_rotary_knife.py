"""The rotary knife cuts on the print while the print wanders."""

from __future__ import annotations

import pytest
from tests.projects.example_machines import machine, number, run


def _errors(register: bool) -> list[float]:
    """Of all cuts of a minute against the print, once the register has settled."""
    errors: list[float] = []
    with machine("rotary_knife") as knife:
        knife.write("GVL_Knife.xRegister", register)
        run(knife, 10.0)
        for _ in range(600):
            cuts = number(knife, "GVL_Knife.udiCuts")
            run(knife, 0.1)
            if number(knife, "GVL_Knife.udiCuts") > cuts:
                errors.append(number(knife, "GVL_Knife.lrError"))
        assert knife.read("Knife.bError") is False
    return errors


def test_the_register_keeps_the_cut_on_the_print() -> None:
    errors = _errors(register=True)
    assert len(errors) == pytest.approx(60.0 * 400.0 / 500.0, abs=2)
    # the print wanders by at most 6 mm * 2 pi / 60 s * 1.25 s from one mark to the next
    assert max(map(abs, errors)) < 0.8 + 0.2


def test_without_the_register_the_print_runs_away() -> None:
    assert max(map(abs, _errors(register=False))) > 5.0


def test_the_edge_is_as_fast_as_the_web_at_the_cut() -> None:
    with machine("rotary_knife", 5.0) as knife:
        knife.write("GVL_Knife.xRegister", False)
        run(knife, 5.0)
        seen = 0
        for _ in range(3000):
            run(knife, 0.002)
            if 170.0 < number(knife, "Knife.fSetPosition") < 190.0:
                seen += 1
                assert number(knife, "Knife.fSetVelocity") == pytest.approx(0.9 * 400.0, abs=1e-6)
        assert seen > 50


def test_another_speed_keeps_the_knife_on_its_cam() -> None:
    with machine("rotary_knife", 5.0) as knife:
        knife.write("GVL_Knife.lrSpeed", 700.0)
        run(knife, 10.0)
        assert number(knife, "Web.fSetVelocity") == pytest.approx(700.0)
        assert abs(number(knife, "GVL_Knife.lrError")) < 1.5
        knife.write("GVL_Knife.xRun", False)
        run(knife, 5.0)
        assert number(knife, "Knife.fSetVelocity") == 0.0
        assert knife.literal("Knife.nAxisState") == "synchronized_motion"
