"""The bottling line does what its operator expects, on virtual time."""

from __future__ import annotations

import itertools
from collections.abc import Iterator
from functools import cache
from pathlib import Path

import pytest

from tappet.cli.inputs import one_application
from tappet.codegen.build import build_application
from tappet.codegen.package import CodePackage
from tappet.runtime.local import LocalRuntime

PROJECT = Path(__file__).parents[2] / "projects" / "bottling"
SECOND = 1_000_000_000


@cache
def package() -> CodePackage:
    application = one_application([PROJECT])
    result = build_application(application.sources, application.tasks, application.options)
    assert result.package is not None, [d.message for d in result.diagnostics]
    assert not result.diagnostics
    return result.package


@pytest.fixture
def line() -> Iterator[LocalRuntime]:
    """The line ten seconds after download: producing."""
    with LocalRuntime(package()) as runtime:
        runtime.run(time_ns=10 * SECOND)
        assert runtime.literal("GVL_Line.eMode") == "Execute"
        yield runtime


def press(line: LocalRuntime, button: str) -> None:
    line.force(f"GVL_IO.{button}", True)
    line.run(time_ns=SECOND // 2)
    line.force(f"GVL_IO.{button}", False)
    line.run(time_ns=SECOND // 2)
    line.unforce(f"GVL_IO.{button}")


def test_the_horn_sounds_before_the_belt_moves() -> None:
    with LocalRuntime(package()) as line:
        line.run(time_ns=SECOND // 2)
        assert line.read("GVL_IO.xHorn") is True
        assert line.read("GVL_IO.lrBeltActual") == 0.0
        line.run(time_ns=SECOND)
        assert line.read("GVL_IO.xHorn") is False
        assert line.read("GVL_IO.xBeltOn") is True


def test_three_minutes_of_production_make_good_bottles(line: LocalRuntime) -> None:
    line.run(time_ns=170 * SECOND)
    filled, capped = line.read("GVL_Line.udiFilled"), line.read("GVL_Line.udiCapped")
    assert isinstance(filled, int)
    assert isinstance(capped, int)
    assert 55 <= filled <= 65
    assert filled - 12 <= capped <= filled
    assert line.read("GVL_Line.udiRejected") == 0
    assert line.read("PersistentVars.udiTotalBottles") == capped
    assert line.read("PersistentVars.udiOperatingTime") == pytest.approx(179, abs=2)
    assert line.read("GVL_Line.lrRate") == pytest.approx(21.3, abs=0.5)


def test_every_bottle_behind_the_filler_holds_the_recipe_within_one_percent(line: LocalRuntime) -> None:
    line.run(time_ns=60 * SECOND)
    bottles = line.read("GVL_Plant.aBottles")
    count = line.read("GVL_Plant.iBottles")
    assert isinstance(bottles, list)
    assert isinstance(count, int)
    behind = [b for b in bottles[:count] if isinstance(b, dict) and float(str(b["lrPosition"])) > 1010.0]
    assert len(behind) >= 3
    for bottle in behind:
        assert float(str(bottle["lrLevel"])) == pytest.approx(500.0, rel=0.01)


def test_emergency_stop_stops_belt_and_valve_and_needs_reset_and_start(line: LocalRuntime) -> None:
    line.force("GVL_IO.xEmergencyStop", True)
    line.run(time_ns=SECOND)
    assert line.literal("GVL_Line.eMode") == "Aborted"
    assert line.read("GVL_IO.lrBeltActual") == 0.0
    assert line.read("GVL_IO.xValve") is False
    assert line.read("GVL_IO.xLampRed") is True
    line.force("GVL_IO.xEmergencyStop", False)
    line.run(time_ns=SECOND)
    assert line.literal("GVL_Line.eMode") == "Aborted"
    press(line, "xResetButton")
    press(line, "xResetButton")
    assert line.literal("GVL_Line.eMode") == "Stopped"
    press(line, "xStartButton")
    line.run(time_ns=2 * SECOND)
    assert line.literal("GVL_Line.eMode") == "Execute"
    assert line.read("GVL_IO.xBeltOn") is True


def test_one_press_of_reset_acknowledges_the_alarm_and_leaves_the_abort(line: LocalRuntime) -> None:
    line.force("GVL_IO.xEmergencyStop", True)
    line.run(time_ns=SECOND)
    # A reset button that is held does nothing while the cause is there, nor when it goes away.
    line.force("GVL_IO.xResetButton", True)
    line.run(time_ns=SECOND)
    line.force("GVL_IO.xEmergencyStop", False)
    line.run(time_ns=SECOND)
    assert line.literal("GVL_Line.eMode") == "Aborted"
    line.force("GVL_IO.xResetButton", False)
    line.run(time_ns=SECOND)
    line.force("GVL_IO.xResetButton", True)
    line.run(time_ns=SECOND // 5)
    assert line.literal("GVL_Line.eMode") == "Stopped"


def test_a_jammed_belt_is_an_alarm_that_stops_the_line(line: LocalRuntime) -> None:
    line.write("GVL_Plant.xBeltJammed", True)
    line.run(time_ns=4 * SECOND)
    assert line.literal("GVL_Line.eMode") == "Aborted"
    assert line.read("GVL_Line.aAlarms[3].xLatched") is True
    assert line.read("GVL_Line.aAlarms[3].udiCount") == 1
    assert line.read("GVL_Line.aAlarms[3].sText") == "Belt jammed"


def test_a_stuck_valve_times_out(line: LocalRuntime) -> None:
    line.write("GVL_Plant.xValveStuck", True)
    line.run(time_ns=14 * SECOND)
    assert line.literal("PLC_PRG.fbFiller.eState") == "Fault"
    assert line.read("GVL_Line.aAlarms[4].xLatched") is True


def test_an_empty_tank_holds_the_line_until_it_is_refilled(line: LocalRuntime) -> None:
    line.write("GVL_Plant.xTankEmpty", True)
    line.run(time_ns=2 * SECOND)
    assert line.literal("GVL_Line.eMode") == "Holding"
    line.write("GVL_Plant.xTankEmpty", False)
    line.run(time_ns=4 * SECOND)
    assert line.literal("GVL_Line.eMode") == "Execute"


def test_another_recipe_is_taken_over_between_two_bottles(line: LocalRuntime) -> None:
    line.write("GVL_Line.iRecipe", 2)
    line.run(time_ns=6 * SECOND)
    assert line.read("GVL_Line.stRecipe.sName") == "Juice 0.33 l"
    assert line.read("GVL_IO.lrBeltSetpoint") == 240.0


def test_an_invalid_recipe_is_not_taken_over(line: LocalRuntime) -> None:
    line.write("GVL_Line.aRecipes[3].lrVolume", 5000.0)
    line.write("GVL_Line.iRecipe", 3)
    line.run(time_ns=6 * SECOND)
    assert line.read("GVL_Line.stRecipe.sName") == "Water 0.5 l"


def test_counters_survive_a_warm_reset_and_totals_a_cold_one(line: LocalRuntime) -> None:
    line.run(time_ns=60 * SECOND)
    filled, total = line.read("GVL_Line.udiFilled"), line.read("PersistentVars.udiTotalBottles")
    assert filled
    line.stop()
    line.reset("warm")
    assert line.read("GVL_Line.udiFilled") == filled
    assert line.read("GVL_Plant.iBottles") == 0
    line.reset("cold")
    assert line.read("GVL_Line.udiFilled") == 0
    assert line.read("PersistentVars.udiTotalBottles") == total


def test_no_two_bottles_ever_overlap(line: LocalRuntime) -> None:
    for _ in range(60):
        line.run(time_ns=SECOND)
        count = line.read("GVL_Plant.iBottles")
        assert isinstance(count, int)
        places = [float(str(line.read(f"GVL_Plant.aBottles[{i}].lrPosition"))) for i in range(1, count + 1)]
        assert all(front - back >= 90.0 - 1e-6 for front, back in itertools.pairwise(places))
