"""Path tables, the group behind a master, an axis behind the group, and curves at corners with arcs."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import numpy.typing as npt
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from tests.libraries.axis_group import CYCLE, ERRORS
from tests.libraries.group_machine import LIMITS, Machine, machine

Numbers = npt.NDArray[np.float64]
DYNAMICS: dict[str, Any] = {"Velocity": 100.0, "Acceleration": 800.0, "Deceleration": 800.0, "Jerk": 2e4}
ACS, MCS = 0, 1


def _describe(group: Machine, elements: list[dict[str, Any]]) -> None:
    group.write("Description.nElements", len(elements))
    for index, element in enumerate(elements):
        group.element(index, **DYNAMICS, **element)
    group.start("Select")


SLOT = [
    {"EndPoint": (60, 0, 0)},
    {"bCircular": True, "CircMode": 1, "AuxPoint": (60, 20, 0), "EndPoint": (60, 40, 0), "PathChoice": 1},
    {"EndPoint": (0, 40, 0)},
    {"bCircular": True, "CircMode": 1, "AuxPoint": (0, 20, 0), "EndPoint": (0, 0, 0), "PathChoice": 1},
]
LENGTH = 120 + 40 * math.pi


def _slot(way: Numbers | float) -> Numbers:
    """A point of the slot by the way from its start: two lines and two half circles."""
    s = np.clip(np.asarray(way, dtype=float), 0, LENGTH)
    half = 20 * math.pi
    turn, back = (s - 60) / 20, (s - 120 - half) / 20
    x = np.select(
        [s <= 60, s <= 60 + half, s <= 120 + half],
        [s, 60 + 20 * np.sin(turn), 60 - (s - 60 - half)],
        -20 * np.sin(back),
    )
    y = np.select(
        [s <= 60, s <= 60 + half, s <= 120 + half],
        [0 * s, 20 - 20 * np.cos(turn), 40 + 0 * s],
        20 + 20 * np.cos(back),
    )
    return np.stack([x, y, 0 * s], axis=-1)


def _distance(points: Numbers) -> float:
    """From the slot, of the point that is farthest from it."""
    inside = np.clip(points[:, 0], 0, 60)
    from_axis = np.hypot(points[:, 0] - inside, points[:, 1] - 20)
    return float(np.abs(from_axis - 20).max() + np.abs(points[:, 2]).max())


def _run(group: Machine, block: str) -> Numbers:
    rows = [group.position]
    while not group.done(block):
        assert not group.flag(f"{block}.Error"), group.error(block)
        group.cycle()
        rows.append(group.position)
        assert len(rows) * CYCLE < 60
    return np.array(rows)


def test_a_path_is_one_movement() -> None:
    """All points are on the slot, and it takes the time of one movement of its length."""
    with machine(3) as group:
        _describe(group, SLOT)
        assert group.outputs("Select") == {"Done"}
        group.give("MovePath", CoordSystem=MCS)
        trace = _run(group, "MovePath")
        assert group.number("MovePath.MovementId") > 0
        group.cycle()
        assert group.state == "GroupStandby"
    assert _distance(trace) < 1e-9
    assert trace[-1] == pytest.approx((0, 0, 0), abs=1e-9)
    ramp = 100 / 800 + 800 / 2e4
    assert len(trace) * CYCLE == pytest.approx(LENGTH / 100 + ramp, abs=4 * CYCLE)


def test_a_path_between_other_movements() -> None:
    """It waits for the one before it, the one behind for its last element; a halt aborts all of it."""
    with machine(3) as group:
        _describe(group, SLOT)
        group.give("Linear1", Position=(-50, 0, 0), CoordSystem=MCS, **DYNAMICS)
        group.cycle()
        group.give("MovePath", CoordSystem=MCS, BufferMode=1)
        group.cycle()
        group.give("Linear2", Position=(0, -30, 0), CoordSystem=MCS, **DYNAMICS, BufferMode=1)
        group.cycle()
        assert group.outputs("MovePath") == {"Busy"}
        _run(group, "Linear1")
        group.cycle(20)
        assert group.outputs("MovePath") == {"Busy", "Active"}
        _run(group, "MovePath")
        assert group.position == pytest.approx((0, 0, 0), abs=1)
        _run(group, "Linear2")
        assert group.position == pytest.approx((0, -30, 0), abs=1e-9)
        group.put("MovePath", Execute=False)
        group.cycle(2)
        group.give("MovePath", BufferMode=0)
        group.cycle(60)
        group.give("Halt", Deceleration=800.0, Jerk=2e4)
        group.cycle(2)
        assert group.outputs("MovePath") == {"CommandAborted"}


@pytest.mark.parametrize(
    "wrong",
    [
        {"Velocity": 0.0},
        {"Acceleration": -1.0},
        {"BufferMode": 0},
        {"TransitionMode": 3},
        {"CircMode": 3},
        {"EndPoint": (float("nan"), 0, 0)},
    ],
)
def test_descriptions_that_are_none(wrong: dict[str, Any]) -> None:
    """Values that are none, no elements or too many: nothing is selected, and nothing moves."""
    with machine(3) as group:
        _describe(group, SLOT)
        group.cycle()
        group.element(2, **wrong)
        group.start("Select")
        assert group.outputs("Select") == {"Error"}
        assert group.error("Select") == ERRORS["PATH"]
        group.start("MovePath")
        assert group.error("MovePath") == ERRORS["PATH"]
        for count in (0, 33, -1):
            group.cycle()
            group.write("Description.nElements", count)
            group.start("Select")
            assert group.error("Select") == ERRORS["PATH"]
        assert group.state == "GroupStandby"


def test_a_path_with_an_arc_that_is_none_moves_nothing() -> None:
    """The last element is refused with the whole path."""
    with machine(3) as group:
        _describe(group, [*SLOT[:3], {**SLOT[3], "AuxPoint": (0, 10, 0)}])
        group.start("MovePath", CoordSystem=MCS)
        assert group.error("MovePath") == ERRORS["CIRCLE"]
        assert group.state == "GroupStandby"
        assert group.number("Group.iCommands") == 0


@pytest.mark.parametrize("speed", [70.0, -70.0])
def test_a_master_moves_the_group(speed: float) -> None:
    """MC_SyncGroupToAxis relative: in sync the group is where the way of the master is, forwards and back."""
    with machine(3) as group:
        _describe(group, SLOT)
        group.run_axis("BeltMove", speed)
        group.cycle(200)
        before = group.number("Belt.fSetPosition")
        group.give("SyncGroup")
        rows, ways, synced = [], [], []
        for cycle in range(900):
            if cycle == 350:
                group.run_axis("BeltMove", -speed, 300.0)
                rows.append(group.position)
                ways.append(group.number("Belt.fSetPosition") - before)
                synced.append(group.flag("SyncGroup.InSync"))
            group.cycle()
            rows.append(group.position)
            ways.append(group.number("Belt.fSetPosition") - before)
            synced.append(group.flag("SyncGroup.InSync"))
        assert group.state == "GroupMoving"
        group.start("Halt", Deceleration=800.0, Jerk=2e4)
        group.until(lambda: group.state == "GroupStandby")
        assert group.outputs("SyncGroup") == {"CommandAborted"}
    trace, way = np.array(rows), np.array(ways)
    follows = np.array([*synced[1:], False]) & np.array(synced)
    assert follows.sum() > 500
    assert np.abs(trace - _slot(way))[follows].max() < 1e-7
    velocity = np.diff(trace, axis=0) / CYCLE
    acceleration = np.diff(velocity, axis=0) / CYCLE
    assert np.abs(acceleration).max() <= LIMITS["fSWMaxAcceleration"] * 1.001
    assert np.abs(velocity).max() <= LIMITS["fSWMaxVelocity"]


def test_an_absolute_master() -> None:
    """Its position is the way from the start of the path, to which the axes go within their limits first."""
    with machine(3) as group:
        _describe(group, SLOT)
        group.run_axis("BeltMove", 10.0)
        group.give("Linear1", Position=(-30, -30, 20), CoordSystem=MCS, **DYNAMICS)
        _run(group, "Linear1")
        for index, value in enumerate((0.0, 0.0, 0.0)):
            group.write(f"Description.StartPoint.a[{index}]", value)
        group.give("SyncGroup", Mode=1)
        rows = [group.position]
        while not group.flag("SyncGroup.InSync"):
            group.cycle()
            rows.append(group.position)
            assert len(rows) < 2000
        assert group.position == pytest.approx(_slot(group.number("Belt.fSetPosition")), abs=1e-7)
        acceleration = np.diff(np.array(rows), n=2, axis=0) / CYCLE**2
        assert np.abs(acceleration).max() <= LIMITS["fSWMaxAcceleration"] * 1.001
        group.put("SyncGroup", Execute=False)
        group.cycle()
        group.give("Linear2", Position=(5, 5, 5), CoordSystem=MCS, **DYNAMICS)
        _run(group, "Linear2")
        assert group.outputs("SyncGroup") <= {"CommandAborted"}
        assert group.position == pytest.approx((5, 5, 5), abs=1e-9)


def test_an_impossible_mode_of_a_master() -> None:
    """Neither relative nor absolute, or no path."""
    with machine(3) as group:
        group.start("SyncGroup")
        assert group.error("SyncGroup") == ERRORS["PATH"]
        _describe(group, SLOT)
        group.cycle()
        group.start("SyncGroup", Mode=2)
        assert group.error("SyncGroup") == ERRORS["VALUES"]
        assert group.state == "GroupStandby"


@pytest.mark.parametrize(("numerator", "denominator"), [(1, 1), (-3, 2), (1, 10)])
def test_an_axis_follows_the_path(numerator: int, denominator: int) -> None:
    """MC_SyncAxisToGroup: in sync its way is that of the path times the ratio, a cycle later."""
    ratio = numerator / denominator
    with machine(3) as group:
        _describe(group, SLOT)
        group.give("MovePath", CoordSystem=MCS)
        group.cycle(100)
        group.give(
            "SyncAxis",
            RatioNumerator=numerator,
            RatioDenominator=denominator,
            Acceleration=2000.0,
            Deceleration=2000.0,
            Jerk=1e5,
        )
        group.until(lambda: group.flag("SyncAxis.InSync"))
        ways = [(group.number("Feed.fSetPosition"), 0.0)]
        points = [group.position]
        while not group.done("MovePath"):
            group.cycle()
            points.append(group.position)
            ways.append((group.number("Feed.fSetPosition"), group.path_velocity))
        group.cycle()
        feed = group.number("Feed.fSetPosition") - ways[1][0]
        gone = _way_of(np.array(points)[-1]) - _way_of(np.array(points)[0])
        assert feed == pytest.approx(ratio * gone, abs=1e-7)
        assert group.flag("SyncAxis.InSync")
        assert group.number("Feed.fSetVelocity") == pytest.approx(0, abs=1e-9)


def _way_of(point: Numbers) -> float:
    """The way on the slot of a point of it; its end is that of the whole way."""
    x, y = float(point[0]), float(point[1])
    half = 20 * math.pi
    if y < 1e-9 and x > 1e-9:
        return x
    if x > 60:
        return 60 + 20 * math.acos((20 - y) / 20)
    if y > 40 - 1e-9:
        return 60 + half + 60 - x
    return 120 + half + 20 * math.acos(max(-1.0, min(1.0, (y - 20) / 20)))


def test_a_ratio_that_is_none() -> None:
    """As MC_GearIn says."""
    with machine(3) as group:
        group.start("SyncAxis", RatioDenominator=0, Acceleration=1.0, Deceleration=1.0)
        assert group.outputs("SyncAxis") == {"Error"}


CORNERS = st.fixed_dictionaries(
    {
        "first_arc": st.booleans(),
        "second_arc": st.booleans(),
        "turn": st.floats(-2.0, 2.0),
        "radius": st.floats(20.0, 80.0),
        "angle": st.floats(0.5, 2.5),
        "lean": st.floats(-1.0, 1.0),
        "reach": st.floats(1.0, 10.0),
        "mode": st.sampled_from([1, 3, 4]),
    }
)


def _arc(
    start: Numbers, tangent: Numbers, side: Numbers, radius: float, angle: float
) -> tuple[Numbers, Numbers]:
    """A point on the way and the end of an arc that begins with a direction and turns to a side."""
    points = [
        start + radius * (math.sin(turn) * tangent + (1 - math.cos(turn)) * side)
        for turn in (angle / 2, angle)
    ]
    return points[0], points[1]


@settings(max_examples=40, deadline=None)
@given(CORNERS)
def test_corners_with_arcs_are_smooth(case: dict[str, Any]) -> None:
    """Line or arc to line or arc: velocity and acceleration of the axes are continuous, by differences.

    The path begins and ends exactly, and goes by the corner at no more than its distance.
    """
    x, y, z = np.eye(3)
    corner = np.array([60.0, 0.0, 0.0])
    out = math.cos(case["turn"]) * x + math.sin(case["turn"]) * (
        math.cos(case["lean"]) * y + math.sin(case["lean"]) * z
    )
    side = np.cross(out, np.cross(z + 0.1 * x, out))
    side /= np.linalg.norm(side)
    with machine(3) as group:
        if case["first_arc"]:
            aux, start = _arc(corner, -x, y, case["radius"], case["angle"])
            group.give("Direct", Position=start.tolist(), CoordSystem=ACS)
            _run(group, "Direct")
            group.cycle(3)
            group.give(
                "Circular",
                CircMode=0,
                AuxPoint=aux.tolist(),
                EndPoint=corner.tolist(),
                CoordSystem=ACS,
                **DYNAMICS,
            )
        else:
            group.give("Linear1", Position=corner.tolist(), CoordSystem=ACS, **DYNAMICS)
        group.cycle()
        blend = {"BufferMode": 2, "TransitionMode": case["mode"], "TransitionParameter": (case["reach"],)}
        if case["mode"] == 1:
            blend["TransitionParameter"] = (1.0,)
        if case["second_arc"]:
            aux, end = _arc(corner, out, side, case["radius"], case["angle"])
            group.element(0, bCircular=True, CircMode=0, AuxPoint=tuple(aux), EndPoint=tuple(end), **DYNAMICS)
            group.write("Description.nElements", 1)
            group.give("Select")
            group.cycle()
            group.give("MovePath", CoordSystem=ACS, **blend)
            block = "MovePath"
        else:
            end = corner + 60 * out
            group.give("Linear2", Position=end.tolist(), CoordSystem=ACS, **DYNAMICS, **blend)
            block = "Linear2"
        trace = _run(group, block)
    speed = np.linalg.norm(np.diff(trace, axis=0), axis=1) / CYCLE
    acceleration = np.diff(trace, n=2, axis=0) / CYCLE**2
    assert trace[-1] == pytest.approx(end, abs=1e-9)
    nearest = np.linalg.norm(trace - corner, axis=1).min()
    if case["mode"] == 4:
        assert nearest <= case["reach"] + 100 * CYCLE
    elif case["mode"] == 3:
        assert nearest <= case["reach"]
    passing = np.linalg.norm(trace - corner, axis=1)[:-1] < 8
    if passing.any():
        speeds = speed[passing]
        assert speeds.min() > 1
    # twice the acceleration of a path is a jump: the differences of it stay those of a limited jerk
    assert np.linalg.norm(acceleration, axis=1).max() < 1.8e4
    assert np.abs(np.diff(acceleration, axis=0)).max() <= LIMITS["fSWMaxJerk"] * CYCLE * 1.05
