"""The jerk of what brings a slave to its master is never above the given one, by differences.

Ramps by sin2 have no limit of the jerk (motion_semantics PRO-01), trapezoids of an axis none either;
a gear has its own.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
import pytest
from tests.libraries.cam_pair import FIRST, RAMP_IN, cam_pair
from tests.libraries.coupled_axes import CoupledAxes, coupled_axes
from tests.libraries.one_axis import CYCLE

JERK = 2000.0
QUADRATIC, SMOOTH = 2, 3
SHIFT = {"PhaseShift": 12.0, "Velocity": 30.0, "Acceleration": 200.0, "Deceleration": 150.0, "Jerk": JERK}
ROUNDING = 1e-12 / CYCLE**3
"""Of third differences of positions that are not above 1000."""


@pytest.fixture
def axes() -> Iterator[CoupledAxes]:
    with coupled_axes() as found:
        yield found


def _jerk(positions: list[float]) -> float:
    return float(np.abs(np.diff(positions, 3)).max()) / CYCLE**3


def _ahead(axes: CoupledAxes, block: str, output: str, ratio: float = 1.0) -> list[float]:
    """How far the slave is ahead of its gear in each cycle, from before the block starts until its end."""
    found = [axes.position - ratio * axes.master]
    axes.set(block, **{"bExecute" if block == "Backlash" else "Execute": True})
    for _ in range(5000):
        axes.cycle()
        found.append(axes.position - ratio * axes.master)
        if output in axes.outputs(block) and len(found) > 10:
            break
    else:
        raise AssertionError(f"{output} never came")
    for _ in range(20):
        axes.cycle()
        found.append(axes.position - ratio * axes.master)
    return found


@pytest.mark.parametrize("numerator", [1, -2, 3])
@pytest.mark.parametrize("moving", [0.0, 80.0, -40.0])
@pytest.mark.parametrize("accelerating", [False, True])
def test_a_gear_is_engaged_with_its_jerk(
    axes: CoupledAxes, numerator: int, moving: float, accelerating: bool
) -> None:
    """Also while the master accelerates evenly, and with a slave that moves already."""
    if moving:
        direction = 1 if moving > 0.0 else -1
        ramp = {"Acceleration": 1e6, "Deceleration": 1e6}
        axes.start("Velocity", Velocity=abs(moving), Direction=direction, **ramp)
        axes.cycle(5)
    if accelerating:
        axes.run_master(400.0, 40.0)
    else:
        axes.run_master(60.0)
    axes.after(0.1)
    axes.set("Gear1", RatioNumerator=numerator, Acceleration=400.0, Deceleration=300.0, Jerk=JERK)
    before = [axes.position - numerator * axes.master]
    axes.cycle()
    before.append(axes.position - numerator * axes.master)
    found = before + _ahead(axes, "Gear1", "InGear", numerator)[1:]
    assert _jerk(found) <= JERK * (1.0 + 1e-6) + ROUNDING
    assert _jerk(found) > 0.5 * JERK, "the jerk is used"


@pytest.mark.parametrize("ramp", [QUADRATIC, SMOOTH])
@pytest.mark.parametrize("block", ["Phasing", "PhasingRelative"])
def test_a_phase_is_shifted_with_its_jerk(axes: CoupledAxes, block: str, ramp: int) -> None:
    axes.set("Axis", eRampType=ramp)
    axes.run_master(60.0)
    axes.start("Gear1", RatioNumerator=1, Acceleration=1e6, Deceleration=1e6)
    axes.until("Gear1", "InGear")
    axes.cycle(3)
    axes.set(block, **SHIFT)
    found = _ahead(axes, block, "Done")
    assert found[-1] - found[0] == pytest.approx(-12.0, abs=1e-9)
    assert _jerk(found) <= JERK * (1.0 + 1e-6) + ROUNDING
    assert _jerk(found) > 0.4 * JERK


@pytest.mark.parametrize("ramp", [QUADRATIC, SMOOTH])
def test_a_backlash_is_made_up_with_its_jerk(axes: CoupledAxes, ramp: int) -> None:
    axes.set("Axis", eRampType=ramp)
    axes.run_master(60.0)
    axes.after(0.1)
    axes.start("Gear1", RatioNumerator=1, Acceleration=1e6, Deceleration=1e6)
    axes.until("Gear1", "InGear")
    axes.start("Stop", Deceleration=1e6)
    axes.release("Stop")
    axes.start("MasterStop", Deceleration=1e6)
    axes.release("MasterStop")
    axes.cycle(5)
    start = {"fCompensationVel": 30.0, "fCompensationAcc": 200.0, "fCompensationDec": 150.0}
    axes.set("Backlash", fBacklash=3.0, fCompensationJerk=JERK, eBacklashMode=1, **start)
    found = [axes.position]
    axes.set("Backlash", bExecute=True)
    while len(found) < 1000:
        axes.cycle()
        found.append(axes.position)
    assert _jerk(found) <= JERK * (1.0 + 1e-6) + ROUNDING
    assert _jerk(found) > 0.4 * JERK


@pytest.mark.parametrize("ramp", [QUADRATIC, SMOOTH])
def test_a_cam_is_ramped_into_with_its_jerk(ramp: int) -> None:
    with cam_pair(FIRST, 360.0, 0.0) as pair:
        pair.set("Slave", eRampType=ramp)
        pair.select(1, slave_absolute=True)
        pair.place(0.0, 20.0)
        pair.run(40.0)
        pair.couple(StartMode=RAMP_IN, VelocityDiff=30.0, Acceleration=200.0, Deceleration=150.0, Jerk=JERK)
        found = []
        while pair.master < 170.0:
            pair.cycle()
            found.append(pair.slave - _cam(pair.master))
        assert found[-1] == pytest.approx(0.0, abs=1e-6)
        assert _jerk(found) <= JERK * (1.0 + 1e-6) + ROUNDING
        assert _jerk(found) > 0.4 * JERK


def _cam(x: float) -> float:
    """The first half of cam FIRST: a polynomial of degree 5 from rest to the slope 1."""
    part = x / 180.0
    return 180.0 * part**3 * (6.0 - 8.0 * part + 3.0 * part**2)
