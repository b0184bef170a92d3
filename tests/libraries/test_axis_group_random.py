"""Random commands for an axis group against the formulas of the specification, and what always holds.

The path is continuous, its velocity, acceleration and jerk stay within their limits, all axes are on one
straight line between two targets, commands end in their order, and the end is exact.
"""

from __future__ import annotations

import itertools
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from tests.libraries.axis_group import CYCLE, ERRORS, AxisGroup, axis_group
from tests.libraries.path_oracle import Move, durations, joined

NUMBER = st.floats(0.0, 1.0)
COORDINATE = st.one_of(st.integers(-100, 100).map(float), st.floats(-100.0, 100.0))
POINT = st.tuples(COORDINATE, COORDINATE, COORDINATE)
SPEED = st.floats(5.0, 200.0)
RATE = st.floats(50.0, 2000.0)
JERK = st.one_of(st.just(0.0), st.floats(200.0, 50000.0))
MOVE = st.fixed_dictionaries(
    {
        "Position": POINT,
        "Velocity": SPEED,
        "Acceleration": RATE,
        "Deceleration": RATE,
        "Jerk": JERK,
        "BufferMode": st.integers(1, 5),
    }
)
BLOCKS = ("Linear1", "Linear2", "Linear3", "Linear4")


def _trace(group: AxisGroup, cycles: int, rows: list[list[float]]) -> None:
    for _ in range(cycles):
        group.cycle()
        rows.append([*group.position, group.path_velocity, group.path_acceleration])


def _largest_distance(points: np.ndarray, corners: list[np.ndarray]) -> float:
    """From the polyline, of the point that is farthest from it."""
    nearest = np.full(len(points), np.inf)
    for start, end in itertools.pairwise(corners):
        way = end - start
        square = float(way @ way)
        share = np.clip((points - start) @ way / square, 0, 1) if square > 0 else np.zeros(len(points))
        nearest = np.minimum(nearest, np.linalg.norm(points - start - np.outer(share, way), axis=1))
    return float(nearest.max())


@settings(max_examples=20, deadline=None)
@given(st.lists(MOVE, min_size=1, max_size=4))
def test_commands_that_are_queued_at_once(moves: list[dict[str, Any]]) -> None:
    """AG-30 to AG-38, AG-54, AG-55, AG-57: durations and velocities of the formulas."""
    corners = [np.zeros(3), *[np.array(move["Position"]) for move in moves]]
    lengths = [float(np.linalg.norm(b - a)) for a, b in itertools.pairwise(corners)]
    queue = [
        Move(
            length,
            move["Velocity"],
            move["Acceleration"],
            move["Deceleration"],
            move["Jerk"],
            move["BufferMode"],
        )
        for length, move in zip(lengths, moves, strict=True)
    ]
    with axis_group() as group:
        for block, move in zip(BLOCKS, moves, strict=False):
            group.give(block, **move, CoordSystem=0)
        rows: list[list[float]] = []
        _trace(group, 1, rows)
        ends = joined(queue)
        taken = [group.number(f"Group.CommandQueue[{index}].vEnd") for index in range(len(moves))]
        assert taken == pytest.approx(ends, rel=1e-6, abs=1e-6)
        due, finished = 0.0, -1
        for index, seconds in enumerate(durations(queue)):
            due += seconds
            while not group.done(BLOCKS[index]):
                assert len(rows) * CYCLE < due + 3 * CYCLE
                _trace(group, 1, rows)
            assert len(rows) * CYCLE > due - CYCLE / 100
            finished = index
        assert finished == len(moves) - 1
        assert group.position == pytest.approx(corners[-1], abs=1e-12)
        group.cycle()
        assert group.state == "GroupStandby"
    trace = np.array(rows)
    assert _largest_distance(trace[:, :3], corners) < 1e-9
    assert trace[:, 3].min() >= 0
    assert trace[:, 3].max() <= max([move.velocity for move in queue] + ends) * (1 + 1e-9)
    largest = max(max(move.acceleration, move.deceleration) for move in queue)
    assert np.abs(trace[:, 4]).max() <= largest * (1 + 1e-9)
    steps = np.linalg.norm(np.diff(trace[:, :3], axis=0), axis=1)
    assert np.all(steps <= (trace[1:, 3] + trace[:-1, 3]) / 2 * CYCLE + largest * CYCLE**2)
    if all(move.jerk > 0 for move in queue):
        assert np.abs(np.diff(trace[:, 4])).max() <= max(move.jerk for move in queue) * CYCLE * 1.001


ACTION = st.one_of(
    st.tuples(st.just("move"), MOVE.map(lambda move: {**move, "BufferMode": 0})),
    st.tuples(st.just("move"), MOVE),
    st.tuples(st.just("move"), MOVE),
    st.tuples(st.just("Interrupt1"), st.fixed_dictionaries({"Deceleration": RATE, "Jerk": JERK})),
    st.tuples(st.just("GoOn"), st.just({})),
    st.tuples(st.just("Halt"), st.fixed_dictionaries({"Deceleration": RATE, "Jerk": JERK})),
    st.tuples(st.just("Stop1"), st.fixed_dictionaries({"Deceleration": RATE, "Jerk": JERK})),
    st.tuples(st.just("override"), st.one_of(st.just(0.0), st.just(1.0), NUMBER)),
    st.tuples(st.just("wait"), st.floats(0.0, 0.3)),
)


def _free(group: AxisGroup) -> str | None:
    return next((block for block in BLOCKS if not group.flag(f"{block}.Busy")), None)


@settings(max_examples=25, deadline=None)
@given(st.lists(st.tuples(ACTION, st.integers(1, 120)), min_size=1, max_size=12))
def test_commands_at_any_time(actions: list[tuple[tuple[str, Any], int]]) -> None:
    """AG-14 to AG-19, AG-33, AG-35, AG-39: whatever comes, the group stays on its path, to its end."""
    rows: list[list[float]] = []
    allowed = [0.0]
    stronger = False
    with axis_group() as group:
        group.put("Override", Enable=True)
        for (kind, inputs), cycles in actions:
            block = kind
            if kind == "move":
                free = _free(group)
                if free is None:
                    continue
                block = free
                allowed += [inputs["Acceleration"], inputs["Deceleration"]]
                group.give(block, **inputs, CoordSystem=0)
            elif kind == "override":
                group.put("Override", VelFactor=inputs)
            elif kind == "wait":
                group.give("Wait", WaitTime=inputs, BufferMode=1)
                block = "Wait"
            else:
                stronger = True  # than its own deceleration, where the path is too short for that
                group.give(block, **inputs)
            _trace(group, 1, rows)
            if block != "override":
                group.put(block, Execute=False)
            _trace(group, cycles, rows)
            assert group.state in ("GroupStandby", "GroupMoving", "GroupStopping")
        group.put("Override", VelFactor=1.0)
        for _ in range(3):
            _trace(group, 500, rows)
            group.give("GoOn")
            _trace(group, 1, rows)
            group.put("GoOn", Execute=False)
        group.until(lambda: group.state == "GroupStandby", 400.0)
        refusals = {ERRORS["WRONG_STATE"], ERRORS["TOO_SHORT"]}
        failed = [block for block in BLOCKS if group.flag(f"{block}.Error")]
        assert {group.error(block) for block in failed} <= refusals
        group.cycle(2)
        blocks = (*BLOCKS, "Wait", "Halt", "Stop1", "Interrupt1")
        assert [block for block in blocks if group.flag(f"{block}.Busy")] == []
        assert group.text("Group.eError") == "SMC_NO_ERROR"
    trace = np.array(rows)
    assert trace[:, 3].min() >= -1e-6
    assert trace[:, 3].max() <= 200 * (1 + 1e-9) + 2000**2 / 200
    steps = np.linalg.norm(np.diff(trace[:, :3], axis=0), axis=1)
    change = np.abs(np.diff(trace[:, 3])).max() if len(trace) > 1 else 0.0
    room = np.maximum(trace[1:, 3], trace[:-1, 3]) * CYCLE * 1.5 + change * CYCLE + 1e-9 - steps
    assert room.min() > 0, (room.argmin(), trace[room.argmin() - 2 : room.argmin() + 3])
    if not stronger:
        assert np.abs(trace[:, 4]).max() <= max(allowed) * (1 + 1e-9)
