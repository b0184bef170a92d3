"""Plans of SM3_Trajectory by the thousand: arrays in, all segments out."""

from __future__ import annotations

import ctypes
from collections.abc import Callable, Iterator
from contextlib import contextmanager

import numpy as np
import numpy.typing as npt
from tests.libraries.st_program import run

Numbers = npt.NDArray[np.float64]
PER_CYCLE = 1000
INPUTS = ("p0", "v0", "a0", "p1", "v1", "a1", "v_max", "v_min", "a_max", "a_min", "jerk")
SEGMENTS = 12
SEGMENT = ("start", "duration", "position", "velocity", "acceleration", "jerk", "rise", "bend")
OUTPUTS = 4 + SEGMENTS * len(SEGMENT)
PLANNED = 0

POSITION = "PlanPosition(st0, st1, stLimits, stTrajectory)"
VELOCITY = "PlanVelocity(st0, st1.fVelocity, st1.fAcceleration, stLimits, stTrajectory)"

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
        self.cases = {name: cases[:, i] for i, name in enumerate(INPUTS)}
        self.result = rows[:, 0].astype(int)
        self.duration = rows[:, 1]
        self.count = rows[:, 2].astype(int)
        self.target = rows[:, 3]
        segments = rows[:, 4:].reshape(len(rows), SEGMENTS, len(SEGMENT))
        self.segments = {name: segments[:, :, i] for i, name in enumerate(SEGMENT)}
        self.used = np.arange(SEGMENTS) < self.count[:, None]


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
