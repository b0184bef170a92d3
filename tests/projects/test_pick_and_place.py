"""Pick and place fills pallets, and hits nothing on its way."""

from __future__ import annotations

import pytest
from tests.projects.example_machines import machine, number, run

PALLET = (560.0, 120.0)
PITCH = 160.0
INFEED = (60.0, 120.0)


def test_a_pallet_is_filled_place_by_place() -> None:
    placed = []
    with machine("pick_and_place") as handling:
        while len(placed) < 14:
            before = number(handling, "GVL_Handling.udiParts")
            run(handling, 0.004)
            if number(handling, "GVL_Handling.udiParts") > before:
                placed.append((number(handling, "X.fSetPosition"), number(handling, "Y.fSetPosition")))
            assert handling.read("X.bError") is False
    expected = [(PALLET[0] + PITCH * (n % 4), PALLET[1] + PITCH * (n // 4)) for n in range(12)]
    expected += expected[:2]
    assert placed == [pytest.approx(place, abs=1e-9) for place in expected]


def test_the_gripper_moves_across_only_above_the_parts() -> None:
    with machine("pick_and_place", 5.0) as handling:
        before = number(handling, "X.fSetPosition"), number(handling, "Y.fSetPosition")
        for _ in range(2500):
            run(handling, 0.004)
            place = number(handling, "X.fSetPosition"), number(handling, "Y.fSetPosition")
            if place != before and number(handling, "Z.fSetPosition") > 150.0:
                # below that height only where it picks up or puts down, and no more than it rounds the corner
                gap = [abs(place[0] - INFEED[0]) + abs(place[1] - INFEED[1])]
                gap += [
                    abs(place[0] - PALLET[0] - PITCH * column) + abs(place[1] - PALLET[1] - PITCH * row)
                    for row in range(3)
                    for column in range(4)
                ]
                assert min(gap) < 5.0
            before = place


def test_parts_come_and_are_held() -> None:
    with machine("pick_and_place") as handling:
        held = 0
        for _ in range(3000):
            run(handling, 0.004)
            held += handling.read("GVL_Handling.xHolds") is True
        assert 500 < held < 2500


def test_it_waits_when_it_is_stopped() -> None:
    with machine("pick_and_place", 6.0) as handling:
        handling.write("GVL_Handling.xRun", False)
        run(handling, 4.0)
        parts = number(handling, "GVL_Handling.udiParts")
        run(handling, 5.0)
        assert handling.literal("GVL_Handling.eStep") == "Wait"
        assert number(handling, "GVL_Handling.udiParts") == parts


def test_a_lower_speed_takes_longer() -> None:
    cycles = []
    for percent in (100.0, 25.0):
        with machine("pick_and_place") as handling:
            handling.write("GVL_Handling.lrPercent", percent)
            run(handling, 30.0)
            cycles.append(30.0 / number(handling, "GVL_Handling.udiParts"))
    assert cycles[1] > 1.5 * cycles[0]
