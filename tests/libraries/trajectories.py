"""Plans of SM3_Trajectory by the thousand: arrays in, all segments out."""

from __future__ import annotations

import ctypes
from collections.abc import Callable, Iterator
from contextlib import contextmanager

import numpy as np
import numpy.typing as npt
import ruckig
from tests.libraries.st_program import run

Numbers = npt.NDArray[np.float64]
PER_CYCLE = 1000
INPUTS = ("p0", "v0", "a0", "p1", "v1", "a1", "v_max", "v_min", "a_max", "a_min", "jerk")
SEGMENTS = 12
SEGMENT = ("start", "duration", "position", "velocity", "acceleration", "jerk", "rise", "bend")
OUTPUTS = 4 + SEGMENTS * len(SEGMENT)
PLANNED = 0
RUCKIGS_INPUTS = (
    *("current_position", "current_velocity", "current_acceleration"),
    *("target_position", "target_velocity", "target_acceleration"),
    *("max_velocity", "min_velocity", "max_acceleration", "min_acceleration", "max_jerk"),
)


POSITION = "PlanPosition(st0, st1, stLimits, stTrajectory)"
VELOCITY = "PlanVelocity(st0, st1.fVelocity, st1.fAcceleration, stLimits, stTrajectory)"
MOVE_TO_POSITION = "MoveToPosition(st0, st1.fPosition, st1.fVelocity, stRamps, stTrajectory)"
MOVE_TO_VELOCITY = "MoveToVelocity(st0, st1.fVelocity, stRamps, stTrajectory)"
"""Their ramps are the upper limits, with the lower one of the acceleration as deceleration."""

PROGRAM = f"""
PROGRAM Main
VAR
    afIn  : ARRAY [0..{PER_CYCLE * len(INPUTS) - 1}] OF LREAL;
    afOut : ARRAY [0..{PER_CYCLE * OUTPUTS - 1}] OF LREAL;
    uIn   : ULINT;
    uOut  : ULINT;
    i, k, n, m   : DINT;
    st0, st1     : SM3_Trajectory.MotionState;
    stLimits     : SM3_Trajectory.Limits;
    stRamps      : SM3_Trajectory.Ramps;
    stTrajectory : SM3_Trajectory.Trajectory;
    stEmpty      : SM3_Trajectory.Trajectory;
    eResult      : SM3_Trajectory.PlanResult;
END_VAR
uIn := ADR(afIn);
uOut := ADR(afOut);
FOR i := 0 TO {PER_CYCLE - 1} DO
    n := i * {len(INPUTS)};
    st0.fPosition := afIn[n];
    st0.fVelocity := afIn[n + 1];
    st0.fAcceleration := afIn[n + 2];
    st1.fPosition := afIn[n + 3];
    st1.fVelocity := afIn[n + 4];
    st1.fAcceleration := afIn[n + 5];
    stLimits.fVelocityMax := afIn[n + 6];
    stLimits.fVelocityMin := afIn[n + 7];
    stLimits.fAccelerationMax := afIn[n + 8];
    stLimits.fAccelerationMin := afIn[n + 9];
    stLimits.fJerk := afIn[n + 10];
    stLimits.eShape := SM3_Trajectory.RampShape.{{shape}};
    stRamps.fVelocity := stLimits.fVelocityMax;
    stRamps.fAcceleration := stLimits.fAccelerationMax;
    stRamps.fDeceleration := -stLimits.fAccelerationMin;
    stRamps.fJerk := stLimits.fJerk;
    stRamps.eShape := stLimits.eShape;
    stTrajectory := stEmpty;
    eResult := SM3_Trajectory.{{call}};
    m := i * {OUTPUTS};
    afOut[m] := DINT_TO_LREAL(eResult);
    afOut[m + 1] := stTrajectory.fDuration;
    afOut[m + 2] := INT_TO_LREAL(stTrajectory.iSegments);
    afOut[m + 3] := stTrajectory.stTarget.fPosition;
    FOR k := 0 TO {SEGMENTS - 1} DO
        n := m + 4 + k * {len(SEGMENT)};
        afOut[n] := stTrajectory.aSegments[k].fStart;
        afOut[n + 1] := stTrajectory.aSegments[k].fDuration;
        afOut[n + 2] := stTrajectory.aSegments[k].fPosition;
        afOut[n + 3] := stTrajectory.aSegments[k].fVelocity;
        afOut[n + 4] := stTrajectory.aSegments[k].fAcceleration;
        afOut[n + 5] := stTrajectory.aSegments[k].fJerk;
        afOut[n + 6] := stTrajectory.aSegments[k].fRise;
        afOut[n + 7] := stTrajectory.aSegments[k].fBend;
    END_FOR
END_FOR
END_PROGRAM
"""


class Plans:
    """Results of one call: a row a case."""

    def __init__(self, cases: Numbers, rows: Numbers) -> None:
        self.limit(cases)
        self.result = rows[:, 0].astype(int)
        self.duration = rows[:, 1]
        self.count = rows[:, 2].astype(int)
        self.target = rows[:, 3]
        segments = rows[:, 4:].reshape(len(rows), SEGMENTS, len(SEGMENT))
        self.segments = {name: segments[:, :, i] for i, name in enumerate(SEGMENT)}
        self.used = np.arange(SEGMENTS) < self.count[:, None]

    def limit(self, cases: Numbers) -> None:
        """Has the plans checked against these cases."""
        self.cases = {name: cases[:, i] for i, name in enumerate(INPUTS)}


@contextmanager
def planner(call: str, shape: str) -> Iterator[Callable[[Numbers], Plans]]:
    """A function that plans cases, rows of INPUTS, by a call of SM3_Trajectory."""
    with run(PROGRAM.replace("{call}", call).replace("{shape}", shape), 1) as program:
        inside = _array(int(program.literal("Main.uIn")), PER_CYCLE * len(INPUTS))
        outside = _array(int(program.literal("Main.uOut")), PER_CYCLE * OUTPUTS)

        def plan(cases: Numbers) -> Plans:
            rows = []
            for at in range(0, len(cases), PER_CYCLE):
                some = cases[at : at + PER_CYCLE]
                inside[: some.size] = some.ravel()
                program.cycle()
                rows.append(outside.reshape(PER_CYCLE, OUTPUTS)[: len(some)].copy())
            return Plans(cases, np.concatenate(rows))

        yield plan


def _array(address: int, length: int) -> Numbers:
    return np.ctypeslib.as_array((ctypes.c_double * length).from_address(address))


Plan = Callable[[Numbers], Plans]


def one_of(random: np.random.Generator, *columns: Numbers | float) -> Numbers:
    """Each row takes one of the columns."""
    table = np.stack(np.broadcast_arrays(*columns))
    return table[random.integers(len(columns), size=table.shape[1]), np.arange(table.shape[1])]


def random_cases(seed: int, count: int, start: str) -> Numbers:
    """Random plans with jerk 1, starts within the limits, at them, or up to three times beyond them."""
    random = np.random.default_rng(seed)

    def size(low: float, high: float) -> Numbers:
        return 10 ** random.uniform(low, high, count)

    a_max, v_max = size(-1, 1), size(-1.5, 1.5)
    a_min, v_min = -a_max * size(-0.5, 0.5), -v_max * size(-0.5, 0.5)
    equal = random.random(count) < 0.2
    a_min, v_min = np.where(equal, -a_max, a_min), np.where(equal, -v_max, v_min)
    beyond = 3.0 if start == "beyond" else 1.0
    zeros = np.zeros(count)
    v0 = one_of(random, zeros, beyond * random.uniform(v_min, v_max))
    a0 = one_of(random, zeros, beyond * random.uniform(a_min, a_max))
    if start == "at":
        v0, a0 = one_of(random, v0, v_max, v_min), one_of(random, a0, a_max, a_min)
    v1 = one_of(random, zeros, v_max, v_min, random.uniform(v_min, v_max))
    a1 = one_of(random, zeros, zeros, 0.7 * random.uniform(a_min, a_max))
    lead = 0.5 * a1 * a1
    a1 = np.where((v1 + lead <= v_max) & (v1 - lead >= v_min), a1, 0.0)
    distance = random.normal(size=count) * size(-2, 2)
    return np.stack(
        (zeros, v0, a0, distance, v1, a1, v_max, v_min, a_max, a_min, np.ones(count)), axis=1
    ).astype(np.float64)


def ruckigs_duration(case: Numbers, to_velocity: bool) -> float:
    """Duration as Ruckig finds it, NaN where it finds none."""
    problem = ruckig.InputParameter(1)
    for at, name in enumerate(RUCKIGS_INPUTS):
        setattr(problem, name, [float(case[at])])
    if case[-1] == 0:
        problem.max_jerk = [float("inf")]
    if to_velocity:
        problem.control_interface = ruckig.ControlInterface.Velocity
    trajectory = ruckig.Trajectory(1)
    try:
        result = ruckig.Ruckig(1).calculate(problem, trajectory)
    except ruckig.RuckigError:
        return float("nan")
    return float(trajectory.duration) if result == ruckig.Result.Working else float("nan")


def check_segments(plans: Plans, within: bool) -> None:
    """One segment leads to the next, the last one to the target, and no limit is passed."""
    good = plans.result == PLANNED
    s, c = plans.segments, plans.cases
    t = s["duration"]
    bent = s["bend"] * (1 / 4 - 1 / np.pi**2)
    ends = (
        s["position"]
        + t * (s["velocity"] + s["rise"] / 2 + t * (s["acceleration"] / 2 + bent + t * s["jerk"] / 6)),
        s["velocity"] + s["rise"] + t * (s["acceleration"] + s["bend"] / 2 + t * s["jerk"] / 2),
        s["acceleration"] + s["bend"] + t * s["jerk"],
    )
    names = ("position", "velocity", "acceleration")
    targets = (plans.target - c["p0"], c["v1"], c["a1"])
    last = np.arange(s["start"].shape[1]) == (plans.count - 1)[:, None]
    a_unit = np.maximum(c["a_max"], -c["a_min"])
    v_unit = np.maximum(np.maximum(c["v_max"], -c["v_min"]), np.abs(c["v0"]))
    ramp = np.divide(a_unit, c["jerk"], out=np.zeros_like(a_unit), where=c["jerk"] > 0)
    p_unit = np.maximum(np.abs(plans.target - c["p0"]), v_unit * np.maximum(plans.duration, ramp))
    p_unit = np.where(p_unit > 0, p_unit, 1.0)
    for name, end, target, unit in zip(names, ends, targets, (p_unit, v_unit, a_unit), strict=True):
        following = np.where(last, target[:, None], np.roll(s[name], -1, axis=1))
        gap = np.where(plans.used, np.abs(end - following), 0.0).max(axis=1) / unit
        if name == "acceleration":  # it jumps where jerk is not limited
            gap[c["jerk"] == 0] = 0.0
        assert gap[good].max() < 1e-9, (name, gap[good].max())
    if within:
        peaks = np.where(
            s["jerk"] != 0, s["velocity"] - s["acceleration"] ** 2 / (2 * s["jerk"] + (s["jerk"] == 0)), 0
        )
        inside = (s["acceleration"] * ends[2] < 0) & plans.used
        for values in (np.where(plans.used, ends[1], 0), np.where(inside, peaks, 0)):
            assert np.all((values <= c["v_max"][:, None] + 1e-9 * v_unit[:, None])[good])
            assert np.all((values >= c["v_min"][:, None] - 1e-9 * v_unit[:, None])[good])
        values = np.where(plans.used, ends[2], 0)
        assert np.all((values <= c["a_max"][:, None] + 1e-9 * a_unit[:, None])[good])
        assert np.all((values >= c["a_min"][:, None] - 1e-9 * a_unit[:, None])[good])
    assert np.all(np.abs(s["jerk"]) <= c["jerk"][:, None])
    within_a = (s["acceleration"] <= c["a_max"][:, None]) & (s["acceleration"] >= c["a_min"][:, None])
    assert np.all(within_a[(c["jerk"] == 0) & good])
