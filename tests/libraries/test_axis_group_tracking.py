"""Products that move: on a conveyor belt, on a rotary table, at the tool of another group.

What the group does in the coordinates of a product is compared with closed forms: its path there, moved by
where the belt or table is. Joining and leaving it keeps the limits of the axes, by differences of positions.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import numpy.typing as npt
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from tests.libraries import kinematic_models as models
from tests.libraries.axis_group import CYCLE, ERRORS
from tests.libraries.group_machine import LIMITS, Machine, machine

Numbers = npt.NDArray[np.float64]
DYNAMICS: dict[str, Any] = {"Velocity": 100.0, "Acceleration": 800.0, "Deceleration": 800.0, "Jerk": 2e4}
MCS, PCS_1, PCS_2 = 1, 3, 4
_SCARA = "TRAFO.Kin_Scara3_Z := (dArmLength1 := 300, dArmLength2 := 250, dArmLength3 := 50)"
ORIGIN = {"X": 100.0, "Y": 200.0, "Z": -10.0, "A": 25.0}
OBJECT = {"X": 5.0, "Y": 30.0, "Z": 2.0, "A": -15.0}


def _frame(place: dict[str, float]) -> Numbers:
    get = [place.get(name, 0.0) for name in "XYZABC"]
    return models.translation(*get[:3]) @ models.orientation("ZYX", *(np.array(value) for value in get[3:]))


def _belt(travelled: Numbers | float) -> Numbers:
    return _frame(ORIGIN) @ models.translation(travelled, 0.0, 0.0) @ _frame(OBJECT)


def _table(turned: Numbers | float) -> Numbers:
    return _frame(ORIGIN) @ models.rotation(2, turned) @ _frame(OBJECT)


def _at(frame: Numbers, point: tuple[float, ...]) -> Numbers:
    place: Numbers = (frame @ np.array([*point[:3], 1.0]))[..., :3]
    return place


class Recorder:
    """Positions of the axes and of the belt and table, cycle by cycle."""

    def __init__(self, group: Machine) -> None:
        self.group = group
        self.rows: list[list[float]] = []

    def record(self) -> None:
        """Adds the positions of a cycle that something else has run."""
        others = [self.group.number(f"{name}.fSetPosition") for name in ("Belt", "Table", "CX", "CY")]
        self.rows.append([*self.group.position, *others])

    def cycle(self, count: int = 1) -> None:
        for _ in range(count):
            self.group.cycle()
            self.record()

    def until_done(self, block: str) -> None:
        first = len(self.rows)
        while not self.group.done(block):
            assert not self.group.flag(f"{block}.Error"), self.group.error(block)
            self.cycle()
            assert (len(self.rows) - first) * CYCLE < 30, "it never ends"
        self.group.put(block, Execute=False)

    def until(self, condition: Callable[[], bool]) -> None:
        first = len(self.rows)
        while not condition():
            self.cycle()
            assert (len(self.rows) - first) * CYCLE < 30, "it never comes"

    @property
    def axes(self) -> Numbers:
        return np.array(self.rows)[:, : len(self.group.axes)]

    @property
    def belt(self) -> Numbers:
        return np.array(self.rows)[:, len(self.group.axes)]

    @property
    def table(self) -> Numbers:
        return np.array(self.rows)[:, len(self.group.axes) + 1]

    def keeps_limits(self, extra: float = 0.0) -> None:
        """No axis is beyond its velocity, acceleration or jerk."""
        velocity = np.diff(self.axes, axis=0) / CYCLE
        acceleration = np.diff(velocity, axis=0) / CYCLE
        jerk = np.diff(acceleration, axis=0) / CYCLE
        assert np.abs(velocity).max() <= LIMITS["fSWMaxVelocity"] * 1.001
        assert np.abs(acceleration).max() <= LIMITS["fSWMaxAcceleration"] * 1.001 + extra
        assert np.abs(jerk).max() <= LIMITS["fSWMaxJerk"] * 1.01


def _track(group: Machine, block: str, which: str) -> None:
    for name, value in ORIGIN.items():
        group.write(f"{block}.{which}Origin.{name}", value)
    for name, value in OBJECT.items():
        group.write(f"{block}.InitialObjectPosition.{name}", value)
    group.start(block)
    assert group.outputs(block) == {"Done"}, group.error(block)


@pytest.mark.parametrize("speed", [80.0, -60.0, 0.0])
def test_a_place_on_a_belt(speed: float) -> None:
    """The group joins the belt within its limits, and is then exactly where the place on it is, for good."""
    with machine(3) as group:
        seen = Recorder(group)
        if speed:
            group.run_axis("BeltMove", speed)
            group.cycle(100)
        _track(group, "Belted", "ConveyorBelt")
        before = group.number("Belt.fSetPosition") - speed * CYCLE  # where it was when the block was called
        group.give("Linear1", Position=(40, -10, 6), CoordSystem=PCS_1, **DYNAMICS)
        seen.cycle()
        seen.until_done("Linear1")
        assert group.state == "GroupMoving"
        assert group.flag("Belted.InUse")
        joined = len(seen.rows)
        seen.cycle(100)
        wanted = _at(_belt(seen.belt - before), (40, -10, 6))
        assert np.abs(seen.axes - wanted)[joined - 1 :].max() < 1e-9
        seen.keeps_limits()


def test_a_path_on_a_belt_that_changes_its_speed() -> None:
    """Lines and an arc between places on a belt are those seen from it, whatever the belt does."""
    with machine(3) as group:
        seen = Recorder(group)
        _track(group, "Belted", "ConveyorBelt")
        before = group.number("Belt.fSetPosition")
        group.give("Linear1", Position=(0, 0, 0), CoordSystem=PCS_1, **DYNAMICS)
        seen.until_done("Linear1")
        start = len(seen.rows)
        group.run_axis("BeltMove", 90.0, 300.0)
        seen.record()
        group.give("Linear2", Position=(60, 0, 0), CoordSystem=PCS_1, **DYNAMICS)
        group.give(
            "Circular",
            CircMode=1,
            AuxPoint=(60, 20, 0),
            EndPoint=(80, 20, 0),
            PathChoice=1,
            CoordSystem=PCS_1,
            **DYNAMICS,
            BufferMode=1,
        )
        seen.until_done("Circular")
        inverse = np.linalg.inv(_belt(seen.belt - before))
        homogeneous = np.concatenate([seen.axes, np.ones((len(seen.axes), 1))], axis=1)
        product = np.einsum("nij,nj->ni", inverse, homogeneous)[start:, :3]
        on_line = product[product[:, 0] < 59.999]
        assert np.abs(on_line[:, 1:]).max() < 1e-9
        round_it = product[product[:, 1] > 1e-3]
        assert np.hypot(round_it[:, 0] - 60, round_it[:, 1] - 20) == pytest.approx(
            np.full(len(round_it), 20.0), abs=1e-9
        )
        assert product[-1] == pytest.approx((80, 20, 0), abs=1e-9)
        seen.keeps_limits()


@pytest.mark.parametrize(("axes", "kinematics", "start"), [(3, "", ()), (4, _SCARA, (20, 60, 10, -30))])
def test_a_place_on_a_table(axes: int, kinematics: str, start: tuple[float, ...]) -> None:
    """With a kinematics the tool also turns with the table."""
    with machine(axes, kinematics, start) as group:
        seen = Recorder(group)
        group.run_axis("TableMove", 20.0)
        group.cycle(100)
        _track(group, "Tabled", "RotaryTable")
        before = group.number("Table.fSetPosition") - 20.0 * CYCLE
        target = (20, 10, 4, 30, 0, 0)
        group.give("Linear1", Position=target[: max(axes, 3)], CoordSystem=PCS_1, **DYNAMICS)
        seen.cycle()
        seen.until_done("Linear1")
        joined = len(seen.rows)
        seen.cycle(150)
        pose = _table(seen.table - before) @ models.translation(*target[:3]) @ models.rotation(2, target[3])
        if kinematics:
            q = seen.axes
            ours = models.scara([q[:, 0], q[:, 1], q[:, 2]], [300.0, 250.0, 50.0])
            ours = models.translation(0.0, 0.0, q[:, 3]) @ ours
            assert np.abs(ours - pose)[joined - 1 :].max() < 1e-7
        else:
            assert np.abs(seen.axes - pose[:, :3, 3])[joined - 1 :].max() < 1e-9
        seen.keeps_limits()


def test_the_tool_of_another_group_carries_a_product() -> None:
    """MC_SetDynCoordTransform: the place is at the first axes of the other group, moving or standing."""
    with machine(3) as group:
        seen = Recorder(group)
        group.place("Attached.CoordTransform", X=3.0, Y=-4.0, A=90.0)
        group.start("Attached", CoordSystem=PCS_2)
        assert group.outputs("Attached") == {"Done"}
        group.give("Linear1", Position=(10, 20, 5), CoordSystem=PCS_2, **DYNAMICS)
        seen.until_done("Linear1")
        joined = len(seen.rows)
        group.give("CarrierMove", Position=(120, -60), CoordSystem=0, **DYNAMICS)
        seen.until_done("CarrierMove")
        seen.cycle(150)
        carrier = np.array(seen.rows)[:, -2:]
        wanted = np.column_stack([carrier[:, 0] + 3 - 20, carrier[:, 1] - 4 + 10, np.full(len(carrier), 5.0)])
        assert np.abs(seen.axes - wanted)[-1].max() < 1e-9
        assert np.abs(seen.axes - wanted)[joined:].max() < 2e4 * CYCLE**3  # it is seen before it moves on
        seen.keeps_limits()


def test_leaving_a_belt() -> None:
    """A movement in the machine behind one on the belt: within the limits, to the exact end."""
    with machine(3) as group:
        seen = Recorder(group)
        group.run_axis("BeltMove", 100.0)
        group.cycle(100)
        _track(group, "Belted", "ConveyorBelt")
        group.give("Linear1", Position=(0, 0, 0), CoordSystem=PCS_1, **DYNAMICS)
        group.give("Linear2", Position=(300, 100, 50), CoordSystem=MCS, **DYNAMICS, BufferMode=1)
        seen.cycle()
        seen.until_done("Linear2")
        assert seen.axes[-1] == pytest.approx((300, 100, 50), abs=1e-9)
        seen.cycle(3)
        assert group.state == "GroupStandby"
        assert not group.flag("Belted.InUse")
        seen.keeps_limits()


@pytest.mark.parametrize("block", ["Halt", "Stop", "Interrupt"])
def test_stopping_on_a_belt(block: str) -> None:
    """The group comes to standstill in the machine; after an interrupt it joins the belt again."""
    with machine(3) as group:
        seen = Recorder(group)
        group.run_axis("BeltMove", 100.0)
        group.cycle(100)
        _track(group, "Belted", "ConveyorBelt")
        before = group.number("Belt.fSetPosition") - 100.0 * CYCLE
        group.give("Linear1", Position=(0, 0, 0), CoordSystem=PCS_1, **DYNAMICS)
        seen.until_done("Linear1")
        group.give("Linear2", Position=(-80, 40, 0), CoordSystem=PCS_1, **DYNAMICS)
        seen.cycle(100)
        assert group.state == "GroupMoving"
        group.give(block, Deceleration=800.0, Jerk=2e4)
        seen.cycle()
        seen.until(lambda: group.done(block))
        standing = group.position
        seen.cycle(20)
        assert np.abs(group.position - standing).max() == 0
        group.put(block, Execute=False)
        seen.cycle(2)
        if block == "Interrupt":
            group.give("GoOn")
            seen.cycle()
            seen.until_done("Linear2")
            wanted = _at(_belt(seen.belt[-1] - before), (-80, 40, 0))
            assert seen.axes[-1] == pytest.approx(wanted, abs=1e-9)
        else:
            assert group.state == "GroupStandby"
            assert not group.flag("Belted.InUse")
        seen.keeps_limits()


def test_an_override_of_zero_keeps_the_group_on_the_belt() -> None:
    """It stands on its path, which goes on with the belt."""
    with machine(3) as group:
        seen = Recorder(group)
        group.run_axis("BeltMove", 100.0)
        group.cycle(100)
        _track(group, "Belted", "ConveyorBelt")
        group.give("Linear1", Position=(0, 0, 0), CoordSystem=PCS_1, **DYNAMICS)
        seen.until_done("Linear1")
        group.give("Linear2", Position=(-80, 40, 0), CoordSystem=PCS_1, **DYNAMICS)
        seen.cycle(100)
        group.put("Override", Enable=True, VelFactor=0.0)
        seen.cycle(200)
        velocity = np.diff(seen.axes[-3:], axis=0) / CYCLE
        along = 100.0 * np.array([np.cos(np.radians(25)), np.sin(np.radians(25)), 0])
        assert velocity == pytest.approx(np.array([along, along]), abs=1e-6)
        group.put("Override", VelFactor=1.0)
        seen.until_done("Linear2")
        seen.keeps_limits()


def test_a_belt_that_leaves_the_reach_of_the_kinematics() -> None:
    """The group ends in GroupErrorStop, its axes brake within their limits, and it can be reset."""
    with machine(4, _SCARA, (20, 60, 10, -30)) as group:
        seen = Recorder(group)
        _track(group, "Belted", "ConveyorBelt")
        group.give("Linear1", Position=(0, 0, 0, 30, 0, 0), CoordSystem=PCS_1, **DYNAMICS)
        seen.until_done("Linear1")
        group.run_axis("BeltMove", 60.0)
        seen.rows.clear()
        seen.until(lambda: group.state == "GroupErrorStop")
        assert int(group.number("Group.eError")) == ERRORS["UNREACHABLE"]
        seen.cycle(200)
        velocity = np.diff(seen.axes, axis=0) / CYCLE
        assert np.abs(velocity[-1]).max() == 0
        group.start("Reset")
        group.until_done("Reset")
        group.cycle()
        assert group.state == "GroupStandby"


def test_products_in_use_are_not_moved() -> None:
    """SMC_AXIS_GROUP_PCS_STILL_IN_USE; and an axis of the group carries no product of it."""
    with machine(3) as group:
        _track(group, "Belted", "ConveyorBelt")
        group.give("Linear1", Position=(50, 0, 0), CoordSystem=PCS_1, **DYNAMICS)
        group.cycle(10)
        group.start("Frame")
        assert group.error("Frame") == ERRORS["IN_USE"]
        group.start("Tabled")
        assert group.error("Tabled") == ERRORS["IN_USE"]
        group.cycle()
        group.start("Tabled", CoordSystem=PCS_2)
        assert group.outputs("Tabled") == {"Done"}
        group.cycle()
        group.start("Tabled", CoordSystem=MCS)
        assert group.error("Tabled") == ERRORS["VALUES"]


STEP = st.tuples(
    st.sampled_from(["belt", "product", "machine", "halt", "interrupt", "override"]),
    st.floats(-100.0, 100.0),
    st.floats(-100.0, 100.0),
    st.integers(1, 150),
    st.integers(0, 5),
)


@settings(max_examples=25, deadline=None)
@given(st.lists(STEP, min_size=1, max_size=8))
def test_whatever_comes_limits_are_kept(steps: list[tuple[str, float, float, int, int]]) -> None:
    """Movements on the belt and in the machine, stops and overrides at any time."""
    with machine(3) as group:
        seen = Recorder(group)
        _track(group, "Belted", "ConveyorBelt")
        group.put("Override", Enable=True)
        for kind, first, second, cycles, mode in steps:
            block = ""
            if kind == "belt":
                group.run_axis("BeltMove", first, 300.0)
                group.put("BeltMove", Execute=False)
                seen.record()
            elif kind in ("product", "machine"):
                block = "Linear1" if not group.flag("Linear1.Busy") else "Linear2"
                system = PCS_1 if kind == "product" else MCS
                jump = (
                    mode == 0
                    and group.state == "GroupMoving"
                    and not group.flag("Belted.InUse")
                    and system == MCS
                )
                if jump:
                    mode = 1  # aborting turns the direction at once: spec AG-33
                group.give(
                    block,
                    Position=(first, second, 5),
                    CoordSystem=system,
                    **DYNAMICS,
                    BufferMode=min(mode, 1),
                )
            elif kind == "halt":
                block = "Halt"
                group.give(block, Deceleration=800.0, Jerk=2e4)
            elif kind == "interrupt":
                block = "Interrupt"
                group.give(block, Deceleration=800.0, Jerk=2e4)
            else:
                group.put("Override", VelFactor=abs(first) / 100)
            seen.cycle()
            if block:
                group.put(block, Execute=False)
            seen.cycle(cycles)
            if group.flag("Interrupt.Done") or kind == "interrupt":
                seen.cycle(60)
                group.give("GoOn")
                seen.cycle()
                group.put("GoOn", Execute=False)
            assert group.text("Group.eError") == "SMC_NO_ERROR"
        velocity = np.diff(seen.axes, axis=0) / CYCLE
        acceleration = np.diff(velocity, axis=0) / CYCLE
        assert np.abs(velocity).max() <= LIMITS["fSWMaxVelocity"]
        if len(acceleration):
            assert np.abs(acceleration).max() <= LIMITS["fSWMaxAcceleration"] * 1.001
