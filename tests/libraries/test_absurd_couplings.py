"""Absurd values at couplings, phases, profiles and superimposed motion: errors, and the axis can be moved."""

from __future__ import annotations

import math
from collections.abc import Iterator
from functools import partial

import pytest
from tests.libraries.coupled_axes import BLOCKS, CoupledAxes, coupled_axes

from tappet.libraries import load
from tappet.libraries.catalog import items

SHIFT = {"PhaseShift": 30.0, "Velocity": 20.0, "Acceleration": 1000.0, "Deceleration": 1000.0}
SANE: dict[str, dict[str, float]] = {
    "Gear1": {"RatioNumerator": 1, "RatioDenominator": 2, "Acceleration": 1000.0, "Deceleration": 1000.0},
    "GearPos": {
        "RatioNumerator": 1,
        "RatioDenominator": 2,
        "MasterSyncPosition": 200.0,
        "SlaveSyncPosition": 50.0,
        "MasterStartDistance": 60.0,
    },
    "Phasing": SHIFT,
    "PhasingRelative": SHIFT,
    "Backlash": {
        "fBacklash": 1.0,
        "fCompensationVel": 10.0,
        "fCompensationAcc": 100.0,
        "fCompensationDec": 100.0,
    },
    "Super1": {"Distance": 10.0, "VelocityDiff": 20.0, "Acceleration": 100.0, "Deceleration": 100.0},
    "Follow": {"fSetPosition": 0.0},
    "FollowVelocity": {"fSetVelocity": 0.0},
    "FollowBoth": {"fSetPosition": 0.0, "fSetVelocity": 0.0},
    "FollowValues": {"dwValueMask": 31, "fSetPosition": 0.0, "fSetVelocity": 0.0, "fSetAcceleration": 0.0},
    "Positions": {"ArraySize": 2},
    "Velocities": {"ArraySize": 2},
    "Accelerations": {"ArraySize": 2},
}
"""What blocks are given beside the absurd value."""
AFTER_A_GEAR = ("Phasing", "PhasingRelative")
ABSURD: dict[str, tuple[float, ...]] = {
    "LREAL": (math.nan, math.inf, -math.inf, 1e300, -1e300, 0.0, -1.0),
    "DINT": (0, -1, 2**31 - 1, -(2**31)),
    "UDINT": (0, 2**32 - 1),
    "INT": (0, -1, 2**15 - 1, -(2**15)),
}
UNLIMITED = ("Acceleration", "Deceleration", "Jerk")
"""Limits that infinity takes away."""
_ITEMS = {item.name: item for item in items(load("SM3_Basic"))}
CASES = [
    (block, pin.name, value)
    for block in SANE
    for pin in _ITEMS[BLOCKS[block]].inputs
    for value in ABSURD.get(pin.type, ())
]
SET_VALUES = (
    "fSetPosition",
    "fSetVelocity",
    "fSetAcceleration",
    "fActPosition",
    "fActVelocity",
    "fSetTorque",
    "fSetCurrent",
)


@pytest.fixture
def axes() -> Iterator[CoupledAxes]:
    with coupled_axes() as found:
        for table, member in (("Positions", "TP"), ("Velocities", "TV"), ("Accelerations", "TA")):
            quantity = {"TP": "position", "TV": "velocity", "TA": "acceleration"}[member]
            found.set(f"{table}Table", Number_of_pairs=2, IsAbsolute=True)
            for number in (1, 2):
                place = f"{table}Table.MC_{member}_Array[{number}]"
                found.set(place, **{"delta_time": 500_000_000, quantity: 5.0 * number})
        yield found


def _name(case: tuple[str, str, float]) -> str:
    return f"{case[0]}.{case[1]}={case[2]:g}"


def _finite(axes: CoupledAxes) -> bool:
    return all(
        math.isfinite(axes.number(f"{axis}.{name}")) for axis in ("Master", "Axis") for name in SET_VALUES
    )


@pytest.mark.parametrize("case", CASES, ids=map(_name, CASES))
def test_an_absurd_value_leaves_the_axis_controllable(
    axes: CoupledAxes, case: tuple[str, str, float]
) -> None:
    block, pin, value = case
    axes.run_master(100.0)
    axes.after(0.2)
    if block in AFTER_A_GEAR:
        axes.start("Gear1", **SANE["Gear1"])
        axes.until("Gear1", "InGear")
    axes.start(block, **{**SANE[block], pin: value})
    error = False
    for _ in range(30):
        axes.cycle(5)
        assert _finite(axes)
        error = error or bool({"Error", "bError"} & axes.outputs(block))
    unlimited = value == math.inf and pin.endswith(UNLIMITED)
    if not (math.isfinite(value) or unlimited):
        assert error, "no motion has such a value"
    release = partial(axes.set, block)
    release(**{("bExecute" if block.startswith(("Follow", "Backlash")) else "Execute"): False})
    axes.set("Gear1", Execute=False)
    axes.cycle()
    if axes.state == "errorstop":
        axes.cycle(400)
        axes.start("Reset")
        axes.cycle(20)
        assert axes.state == "standstill"
    axes.start("Stop", Deceleration=1e12, Jerk=0.0)
    axes.cycle(20)
    assert axes.state == "stopping", case
    axes.release("Stop")
    axes.cycle(2)
    assert axes.state == "standstill"
    target = axes.position + 1.0
    if abs(target) < 1e9:  # Else nobody sees a step of 1
        axes.start("Absolute", Position=target, Velocity=100.0, Acceleration=1e4, Deceleration=1e4)
        axes.until("Absolute", "Done")
        assert axes.position == pytest.approx(target)
