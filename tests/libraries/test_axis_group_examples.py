"""The worked examples of axis groups, with the figures of the specification (axis_group 7)."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
import pytest
from tests.libraries.axis_group import CYCLE, ERRORS, AxisGroup, axis_group
from tests.libraries.path_oracle import Segment, plan, ramp_distance, states

A, B, C = (
    np.array((1600.0, 1200.0, 800.0)),
    np.array((2200.0, 3800.0, 5000.0)),
    np.array((4500.0, 4200.0, 4800.0)),
)
O = np.zeros(3)  # noqa: E741 - as the specification names it
DYNAMICS = {"Acceleration": 5.0, "Deceleration": 5.0, "Jerk": 2.0, "CoordSystem": 0}
MOVES = {
    "Linear1": {"Position": tuple(A), "Velocity": 40.0, **DYNAMICS},
    "Linear2": {"Position": tuple(B), "Velocity": 55.0, **DYNAMICS},
    "Linear3": {"Position": tuple(C), "Velocity": 70.0, **DYNAMICS},
}
MODES = {
    "Aborting": 0,
    "Buffered": 1,
    "BlendingLow": 2,
    "BlendingPrevious": 3,
    "BlendingNext": 4,
    "BlendingHigh": 5,
}
SAMPLES = [
    *((1.25, 1, 1.5625, 0.484, 0.363, 0.242), (2.5, 1, 6.25, 3.869, 2.901, 1.934)),
    *((5.25, 1, 20, 30.678, 23.009, 15.339), (8, 1, 33.75, 85.575, 64.181, 42.787)),
    *((10.5, 1, 40, 155.984, 116.988, 77.992), (30, 1, 40, 735.354, 551.515, 367.677)),
    *((50, 1, 40, 1329.579, 997.184, 664.789), (60, 2, 40.807, 1604.362, 1218.902, 830.535)),
    *((80, 2, 55, 1733.622, 1779.029, 1735.354), (100, 2, 55, 1866.260, 2353.794, 2663.822)),
    *((140, 2, 55, 2131.537, 3503.325, 4520.757), (146, 2, 58.712, 2171.616, 3677.001, 4801.309)),
    *((160, 3, 70, 2916.450, 3924.600, 4937.700), (180, 3, 50.229, 4251.064, 4156.707, 4821.647)),
    *((185, 3, 25.229, 4436.241, 4188.912, 4805.544), (191.2958, 3, 0, 4500, 4200, 4800)),
]
"""Time, block, path velocity and positions of EX-AG-01."""


def tolerance(cycles: int) -> float:
    """Of a time that is seen in cycles."""
    return cycles * CYCLE + 0.02


@pytest.fixture
def group() -> Iterator[AxisGroup]:
    with axis_group() as one:
        yield one


def give(group: AxisGroup, *modes: str) -> None:
    for (block, inputs), mode in zip(MOVES.items(), modes, strict=False):
        group.give(block, **inputs, BufferMode=MODES[mode])


def distance_from_line(points: np.ndarray, start: np.ndarray, end: np.ndarray) -> np.ndarray:
    way = (end - start) / np.linalg.norm(end - start)
    apart = points - start
    return np.asarray(np.linalg.norm(apart - np.outer(apart @ way, way), axis=1))


def test_table_2_of_the_paper(group: AxisGroup) -> None:
    """EX-AG-01 and EX-AG-09; AG-03, AG-05, AG-12, AG-13, AG-30, AG-31, AG-34, AG-37, AG-38, AG-40."""
    give(group, "Aborting", "BlendingLow", "BlendingHigh")
    first = group.cycles
    rows, accelerations = [], []
    seen: dict[str, float] = {}
    while len(seen) < 3:
        group.cycle()
        time = (group.cycles - first) * CYCLE
        rows.append((time, *group.position, group.path_velocity))
        accelerations.append(group.path_acceleration)
        for block in MOVES:
            if block not in seen and group.done(block):
                seen[block] = time - CYCLE
        for number, block in enumerate(MOVES):
            active = group.flag(f"{block}.Active")
            assert not group.flag(f"{block}.CommandAborted")
            assert not group.flag(f"{block}.Error")
            assert group.flag(f"{block}.Busy") == (block not in seen)
            assert not active or [*MOVES][:number] == [*seen][:number]
        assert group.state == ("GroupMoving" if rows[-1][0] < 191.29 else group.state)
        assert time < 200
    assert list(seen.values()) == pytest.approx([59.1016, 149.5733, 191.2958], abs=tolerance(3))
    trace = np.array(rows)
    times, points, speeds = trace[:, 0], trace[:, 1:4], trace[:, 4]

    def at(time: float) -> int:
        return int(np.argmin(np.abs(times - time)))

    assert speeds[at(59.1016)] == pytest.approx(40, abs=0.1)
    assert speeds[at(149.5733)] == pytest.approx(70, abs=0.1)
    assert speeds[-1] == 0
    one, two = times < 59.09, (times > 59.11) & (times < 144.07)
    assert speeds[one].max() == pytest.approx(40, abs=1e-9)
    assert speeds[two].max() == pytest.approx(55, abs=1e-9)
    assert speeds.max() == pytest.approx(70, abs=1e-9)
    assert speeds[(times > 10.5) & (times < 174.79)].min() > 39.9
    assert np.abs(accelerations).max() <= 5.0 + 1e-9
    jerks = np.diff(accelerations) / CYCLE
    assert np.abs(jerks).max() < 2.0 * 1.01
    assert points[-1] == pytest.approx(C, abs=1e-9)
    for time, _, speed, *place in SAMPLES:
        row = trace[at(time)]
        assert row[1:4] == pytest.approx(place, abs=speed * CYCLE + 0.05)
        assert row[4] == pytest.approx(speed, abs=5 * CYCLE + 0.01)
    for start, end, inside in (
        *((O, A, times < 59.09), (A, B, (times > 59.11) & (times < 149.56))),
        (B, C, times > 149.59),
    ):
        assert distance_from_line(points[inside], start, end).max() < 1e-9
    assert np.all(np.diff(points[:, 0]) >= 0)
    assert np.all(np.diff(points[:, 1]) >= 0)
    rising = times < 149.56
    assert np.all(np.diff(points[rising, 2]) >= 0)
    assert np.all(np.diff(points[times > 149.59, 2]) <= 0)
    group.cycle()
    assert group.state == "GroupStandby"
    assert [group.text(f"{axis}.nAxisState") for axis in "XYZ"] == ["standstill"] * 3


COMBINATIONS = [
    ("Buffered", "Buffered", 0, 0, 64.3516, 103.9717, 49.9725),
    ("Buffered", "BlendingLow", 0, 55, 64.3516, 97.2217, 42.3118),
    ("Buffered", "BlendingHigh", 0, 70, 64.3516, 96.4717, 41.7225),
    ("BlendingPrevious", "Buffered", 40, 0, 59.1016, 97.9717, 49.9725),
    ("BlendingLow", "BlendingPrevious", 40, 55, 59.1016, 91.2217, 42.3118),
    ("BlendingPrevious", "BlendingNext", 40, 70, 59.1016, 90.4717, 41.7225),
    ("BlendingNext", "Buffered", 55, 0, 58.0704, 97.2217, 49.9725),
    ("BlendingHigh", "BlendingLow", 55, 55, 58.0704, 90.4717, 42.3118),
    ("BlendingHigh", "BlendingNext", 55, 70, 58.0704, 89.7217, 41.7225),
]


@pytest.mark.parametrize(("second", "third", "at_a", "at_b", *"xyz"), COMBINATIONS)
def test_all_mode_combinations(
    group: AxisGroup, second: str, third: str, at_a: float, at_b: float, x: float, y: float, z: float
) -> None:
    """EX-AG-02; AG-31, AG-32, AG-37."""
    give(group, "Aborting", second, third)
    group.cycle()
    durations, speeds = [], []
    for block in MOVES:
        durations.append(group.until_done(block))
        speeds.append(group.path_velocity)
    assert durations == pytest.approx([x, y + CYCLE, z + CYCLE], abs=tolerance(2))
    assert speeds == pytest.approx([at_a, at_b, 0], abs=5 * 2 * CYCLE)


@pytest.mark.parametrize("mode", ["BlendingLow", "BlendingPrevious", "BlendingNext", "BlendingHigh"])
def test_falling_velocities(group: AxisGroup, mode: str) -> None:
    """EX-AG-02, the other pairing: with falling velocities Low is that of the next block."""
    group.give("Linear1", **{**MOVES["Linear1"], "Velocity": 55.0}, BufferMode=0)
    group.give("Linear2", **{**MOVES["Linear2"], "Velocity": 40.0}, BufferMode=MODES[mode])
    group.cycle()
    group.until_done("Linear1")
    expected = 40 if mode in ("BlendingLow", "BlendingNext") else 55
    assert group.path_velocity == pytest.approx(expected, abs=5 * 2 * CYCLE)


def test_aborting_in_motion(group: AxisGroup) -> None:
    """EX-AG-03; AG-33."""
    give(group, "Aborting")
    group.after(30.0)
    start = group.position
    assert start == pytest.approx((735.354, 551.515, 367.677), abs=0.001)
    group.give("Linear2", **MOVES["Linear2"], BufferMode=0)
    group.cycle()
    assert group.outputs("Linear1") == {"Busy", "Active"}
    group.cycle()
    assert group.outputs("Linear1") == {"CommandAborted"}
    assert group.outputs("Linear2") == {"Busy", "Active"}
    assert np.linalg.norm(B - start) == pytest.approx(5844.3359, abs=1e-3)
    first = group.cycles - 2
    slowest = 100.0
    while not group.done("Linear2"):
        slowest = min(slowest, group.path_velocity)
        last = group.position
        group.cycle()
        assert distance_from_line(group.position[None], start, B).max() < 1e-9
    assert (group.cycles - first - 1) * CYCLE == pytest.approx(113.7607, abs=tolerance(2))
    assert group.position == pytest.approx(B, abs=1e-9)
    assert np.linalg.norm(last - B) < 0.01
    assert slowest < 0.1


def test_buffered(group: AxisGroup) -> None:
    """EX-AG-04."""
    give(group, "Aborting", "Buffered")
    group.cycle()
    assert group.until_done("Linear1") == pytest.approx(64.3516, abs=tolerance(2))
    assert group.path_velocity == pytest.approx(0, abs=1e-4)
    assert group.state == "GroupMoving"
    assert group.until_done("Linear2") == pytest.approx(103.9717, abs=tolerance(2))


def test_late_queueing(group: AxisGroup) -> None:
    """EX-AG-05; AG-37: the head has begun to brake."""
    give(group, "Aborting")
    group.after(55.0)
    assert group.number("Group.fPathPosition") == pytest.approx(1989.495, abs=0.01)
    assert group.path_velocity == pytest.approx(38.681, abs=0.001)
    assert group.path_acceleration == pytest.approx(-2.297, abs=0.001)
    group.give("Linear2", **MOVES["Linear2"], BufferMode=MODES["BlendingLow"])
    slowest, at, back = 100.0, 0.0, 0.0
    while not group.done("Linear1"):
        group.cycle()
        if group.path_velocity < slowest:
            slowest, at = group.path_velocity, group.cycles
        if group.path_acceleration == 0 and not back:
            back = group.cycles
    base = group.cycles
    assert slowest == pytest.approx(37.363, abs=0.005)
    assert (base - at) * CYCLE == pytest.approx(59.253 - 56.148, abs=tolerance(2))
    assert (base - back) * CYCLE == pytest.approx(59.253 - 58.445, abs=tolerance(2))
    assert group.path_velocity == pytest.approx(40, abs=5 * 2 * CYCLE)


def test_late_queueing_that_cannot_come_back(group: AxisGroup) -> None:
    """EX-AG-05, at 55.5 s; AG-54: the velocity at A is the highest that is reached without acceleration."""
    give(group, "Aborting")
    group.after(55.5)
    first = group.cycles
    group.give("Linear2", **MOVES["Linear2"], BufferMode=MODES["BlendingLow"])
    slowest = 100.0
    while not group.done("Linear1"):
        group.cycle()
        slowest = min(slowest, group.path_velocity)
    assert slowest == pytest.approx(34.566, abs=0.005)
    assert 55.5 + (group.cycles - first - 1) * CYCLE == pytest.approx(59.566, abs=tolerance(1))
    assert group.number("Group.CommandQueue[1].vStart") == pytest.approx(37.488, abs=0.005)
    assert group.flag("Group.CommandQueue[0].xReduced")


def test_a_blend_velocity_out_of_reach(group: AxisGroup) -> None:
    """EX-AG-06 a; AG-54 (V-5)."""
    group.give("Linear1", Position=(100, 0, 0), Velocity=40.0, **DYNAMICS, BufferMode=0)
    group.give("Linear2", Position=(1000, 0, 0), Velocity=40.0, **DYNAMICS, BufferMode=MODES["BlendingLow"])
    group.cycle()
    assert group.number("Group.CommandQueue[0].vEnd") == pytest.approx(25.9845, abs=1e-4)
    assert ramp_distance(0, 25.9845, 5, 2) == pytest.approx(100, abs=1e-3)
    assert group.flag("Group.CommandQueue[0].xReduced")
    group.until_done("Linear1")
    assert group.path_velocity == pytest.approx(25.98, abs=0.1)


def test_a_blend_velocity_that_is_too_fast_for_the_next(group: AxisGroup) -> None:
    """EX-AG-06 b; AG-55 (V-6)."""
    group.give("Linear1", Position=(1000, 0, 0), Velocity=40.0, **DYNAMICS, BufferMode=0)
    group.give("Linear2", Position=(1020, 0, 0), Velocity=40.0, **DYNAMICS, BufferMode=MODES["BlendingLow"])
    group.cycle()
    assert group.number("Group.CommandQueue[0].vEnd") == pytest.approx(9.2832, abs=1e-4)
    group.until_done("Linear2")
    assert group.position == pytest.approx((1020, 0, 0), abs=1e-9)


def test_a_path_that_is_shorter_than_the_braking_way(group: AxisGroup) -> None:
    """EX-AG-06 c; AG-53 (V-4): an error of the block, the movement goes on."""
    give(group, "Aborting")
    group.after(30.0)
    group.give("Relative1", Distance=(100, 0, 0), Velocity=40.0, **DYNAMICS, BufferMode=0)
    group.cycle()
    assert group.outputs("Relative1") == {"Error"}
    assert group.error("Relative1") == ERRORS["TOO_SHORT"]
    assert group.until_done("Linear1") == pytest.approx(64.3516 - 30.0, abs=tolerance(2))
    assert group.position == pytest.approx(A, abs=1e-9)


def test_stop(group: AxisGroup) -> None:
    """EX-AG-07; AG-16, AG-17."""
    give(group, "Aborting", "BlendingLow")
    group.after(30.0)
    group.give("Stop1", Deceleration=5.0, Jerk=2.0)
    group.cycle()
    assert group.state == "GroupStopping"
    group.cycle()
    assert group.outputs("Linear1") == group.outputs("Linear2") == {"CommandAborted"}
    group.give("Linear3", **MOVES["Linear3"], BufferMode=0)
    group.cycle()
    assert group.error("Linear3") == ERRORS["WRONG_STATE"]
    assert group.until_done("Stop1") + 3 * CYCLE == pytest.approx(10.5, abs=tolerance(2))
    assert group.position == pytest.approx((891.338, 668.503, 445.669), abs=0.001)
    group.after(1.0)
    assert group.state == "GroupStopping"
    assert group.outputs("Stop1") == {"Done", "Busy", "Active"}
    group.put("Stop1", Execute=False)
    group.cycle()
    assert group.state == "GroupStandby"
    assert group.text("X.nAxisState") == "standstill"


def test_interrupt_and_continue(group: AxisGroup) -> None:
    """EX-AG-07; AG-18, AG-19."""
    give(group, "Aborting", "Buffered")
    group.after(30.0)
    first = group.cycles
    group.give("Interrupt1", Deceleration=5.0, Jerk=2.0)
    group.cycle(2)
    assert group.outputs("Linear1") == {"Busy"}
    assert group.until_done("Interrupt1") + 2 * CYCLE == pytest.approx(10.5, abs=tolerance(2))
    assert group.position == pytest.approx((891.338, 668.503, 445.669), abs=0.001)
    assert group.state == "GroupMoving"
    group.cycle(round(20 / CYCLE) - (group.cycles - first))
    group.give("GoOn")
    group.cycle(2)
    assert group.outputs("GoOn") == {"Done"}
    assert group.outputs("Linear1") == {"Busy", "Active"}
    assert group.until_done("Linear1") + 2 * CYCLE == pytest.approx(34.3516, abs=tolerance(2))
    assert group.outputs("Linear2") == {"Busy", "Active"}
    group.put("GoOn", Execute=False)
    group.cycle()
    group.start("GoOn")
    assert group.error("GoOn") == ERRORS["NOT_INTERRUPTED"]


def test_an_axis_without_power_when_a_block_becomes_the_head(group: AxisGroup) -> None:
    """EX-AG-08; AG-22, AG-23, AG-56 (V-7)."""
    group.start("Wait", WaitTime=1.0, BufferMode=0)
    give(group, "Buffered", "Buffered")
    group.after(0.5)
    group.put("Power", bRegulatorOn=False)
    group.after(0.4)
    assert group.state == "GroupMoving"
    group.after(0.2)
    assert group.state == "GroupErrorStop"
    assert group.outputs("Linear1") == {"Error"}
    assert group.error("Linear1") == ERRORS["POWER"]
    assert group.outputs("Linear2") == {"CommandAborted"}
    group.power()
    group.start("Reset")
    group.cycle(3)
    assert group.state == "GroupStandby"


def test_the_oracle_has_the_times_of_the_specification() -> None:
    """The formulas of axis_group 6, on their own."""
    first = Segment(float(np.linalg.norm(A)), 0, 40, 40, 5, 5, 2)
    second = Segment(float(np.linalg.norm(B - A)), 40, 55, 70, 5, 5, 2)
    third = Segment(float(np.linalg.norm(C - B)), 70, 70, 0, 5, 5, 2)
    durations = [sum(duration for duration, _ in plan(segment)) for segment in (first, second, third)]
    assert durations == pytest.approx([59.1016, 90.4717, 41.7225], abs=1e-4)
    assert states(plan(first), 0.0, np.array([10.5]))[0] == pytest.approx((210, 40, 0), abs=1e-9)
