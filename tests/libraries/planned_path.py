"""Paths as cells for SM3_PathPlanner, and what its planner does with them in every cycle."""

from __future__ import annotations

import ctypes
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field

import numpy as np
import numpy.typing as npt
from tests.libraries.st_program import Program, run

Numbers = npt.NDArray[np.float64]
AXES = 6
PER_CELL = 10 + 6 * AXES
MOST_CELLS = 4000
RECORDS = 20_000
RECORD = ("position", "velocity", "acceleration", "jerk", "element", "limit", "axis", "share", "cell", "stands")
LIMITS = ("Standing", "Feed", "Velocity", "Joint", "Acceleration", "Jerk", "Transition")

PROGRAM = f"""
PROGRAM Main
VAR
    planner : SM3_PathPlanner.PathPlanner;
    stCell  : SM3_PathPlanner.PathCell;
    afIn    : ARRAY [0..{MOST_CELLS * PER_CELL - 1}] OF LREAL;
    afOut   : ARRAY [0..{RECORDS * len(RECORD) - 1}] OF LREAL;
    uIn, uOut : ULINT;
    iCells, iFed, iRecords, i, k, n : DINT;
    iPerCycle : DINT := {MOST_CELLS};  (* Cells that arrive in a cycle *)
    iSteps    : INT := 100;
    iNewton   : DINT;
    fCycle    : LREAL := 0.001;
    xClears   : BOOL;
    stEmpty   : SM3_PathPlanner.PathCell;
END_VAR
uIn := ADR(afIn);
uOut := ADR(afOut);
IF xClears THEN
    xClears := FALSE;
    planner.Clear();
    iFed := 0;
END_IF
FOR k := 0 TO iRecords - 1 DO
    i := 0;
    WHILE i < iPerCycle AND iFed < iCells DO
        Fill();
        IF NOT planner.Append(stCell) THEN
            EXIT;
        END_IF
        iFed := iFed + 1;
        i := i + 1;
    END_WHILE
    planner.Plan(iSteps);
    planner.Advance(fCycle);
    Store();
END_FOR
END_PROGRAM

METHOD Fill
VAR
    m : DINT;
    a : DINT;
END_VAR
m := iFed * {PER_CELL};
stCell.nElement := DINT_TO_UDINT(iFed);
stCell.fFrom := afIn[m];
stCell.fLength := afIn[m + 1];
stCell.fFeed := afIn[m + 2];
stCell.fVelocity := afIn[m + 3];
stCell.fAcceleration := afIn[m + 4];
stCell.fDeceleration := afIn[m + 5];
stCell.fJerk := afIn[m + 6];
stCell.fCurvature := afIn[m + 7];
stCell.fCentripetal := afIn[m + 8];
stCell.fStartVelocity := afIn[m + 9];
FOR a := 1 TO {AXES} DO
    stCell.stStart.aFirst[a] := afIn[m + 9 + a];
    stCell.stStart.aSecond[a] := afIn[m + 9 + {AXES} + a];
    stCell.stStart.aThird[a] := afIn[m + 9 + {2 * AXES} + a];
    stCell.stEnd.aFirst[a] := afIn[m + 9 + {3 * AXES} + a];
    stCell.stEnd.aSecond[a] := afIn[m + 9 + {4 * AXES} + a];
    stCell.stEnd.aThird[a] := afIn[m + 9 + {5 * AXES} + a];
END_FOR
END_METHOD

METHOD Store
n := k * {len(RECORD)};
afOut[n] := planner.stState.fPosition;
afOut[n + 1] := planner.stState.fVelocity;
afOut[n + 2] := planner.stState.fAcceleration;
afOut[n + 3] := planner.stState.fJerk;
afOut[n + 4] := UDINT_TO_LREAL(planner.nElement);
afOut[n + 5] := TO_LREAL(TO_INT(planner.eLimit));
afOut[n + 6] := INT_TO_LREAL(planner.iAxis);
afOut[n + 7] := planner.fShare;
afOut[n + 8] := UDINT_TO_LREAL(planner.nCell);
afOut[n + 9] := BOOL_TO_LREAL(planner.xStands);
END_METHOD
"""


@dataclass(frozen=True)
class Element:
    """A piece of a path by its own length: q(s) and its first three derivatives as rows of (4, axes)."""

    length: float
    shape: Callable[[float], Numbers]
    feed: float = 0.0
    velocity: float = 0.0
    acceleration: float = 0.0
    deceleration: float = 0.0
    jerk: float = 0.0
    curvature: float = 0.0
    centripetal: float = 0.0
    start_velocity: float = 1e30


@dataclass(frozen=True)
class Path:
    """Elements one after the other, cut into cells."""

    elements: Sequence[Element]
    cell: float
    limits: Sequence[tuple[float, float, float]] = ()  # of the axes: velocity, acceleration, jerk
    knots: Numbers = field(init=False)
    owners: Sequence[tuple[Element, float]] = field(init=False)  # element of a cell, place where it begins

    def __post_init__(self) -> None:
        knots, owners = [0.0], []
        for element in self.elements:
            count = max(1, round(element.length / self.cell))
            for number in range(count):
                owners.append((element, element.length * number / count))
                knots.append(knots[-1] + element.length / count)
        object.__setattr__(self, "knots", np.array(knots))
        object.__setattr__(self, "owners", owners)

    def ends(self, cell: int) -> tuple[Numbers, Numbers]:
        """q and its derivatives at the start and at the end of a cell."""
        element, place = self.owners[cell]
        length = self.knots[cell + 1] - self.knots[cell]
        return element.shape(place), element.shape(place + length)

    def rows(self) -> Numbers:
        """The cells as the program reads them."""
        table = np.zeros((len(self.owners), PER_CELL))
        for number, (element, place) in enumerate(self.owners):
            length = self.knots[number + 1] - self.knots[number]
            table[number, :10] = (
                *(self.knots[number], length, element.feed, element.velocity, element.acceleration),
                *(element.deceleration, element.jerk, element.curvature, element.centripetal),
                element.start_velocity if place == 0.0 else 1e30,
            )
            axes = len(self.limits)
            for side, values in enumerate(self.ends(number)):
                for order in range(3):
                    at = 10 + (3 * side + order) * AXES
                    table[number, at : at + axes] = values[order + 1][:axes]
        return table

    def axes_at(self, cells: Numbers, positions: Numbers) -> Numbers:
        """q of the axes at positions of the path, in cells: rows of (samples, 4, axes)."""
        found = []
        for cell, position in zip(cells.astype(int), positions, strict=True):
            element, place = self.owners[min(cell, len(self.owners) - 1)]
            start = self.knots[min(cell, len(self.owners) - 1)]
            found.append(element.shape(place + position - start))
        return np.array(found)


class Planned:
    """The running planner."""

    def __init__(self, program: Program) -> None:
        self.program = program
        program.cycle()
        self.inside = self._array("Main.uIn", MOST_CELLS * PER_CELL)
        self.outside = self._array("Main.uOut", RECORDS * len(RECORD))

    def _array(self, variable: str, length: int) -> Numbers:
        address = int(self.program.literal(variable))
        return np.ctypeslib.as_array((ctypes.c_double * length).from_address(address))

    def load(self, path: Path, **inputs: float | bool | str) -> None:
        """Forgets what was there; the cells of the path arrive from the next cycle on."""
        rows = path.rows()
        self.inside[: rows.size] = rows.ravel()
        names = ("fVelocity", "fAcceleration", "fJerk")
        for axis, limits in enumerate(path.limits):
            members = {f"aLimits[{axis + 1}].{name}": value for name, value in zip(names, limits, strict=True)}
            self.program.set("Main.planner", **members)
        self.program.set("Main.planner", nAxes=len(path.limits), **inputs)
        self.program.set("Main", iCells=len(rows), xClears=True, iRecords=0)
        self.program.cycle()

    def move(self, cycles: int) -> dict[str, Numbers]:
        """So many cycles of the motion, at most RECORDS; what there was in each."""
        assert cycles <= RECORDS
        self.program.set("Main", iRecords=cycles)
        self.program.cycle()
        table = self.outside[: cycles * len(RECORD)].reshape(cycles, len(RECORD)).copy()
        return {name: table[:, at] for at, name in enumerate(RECORD)}

    def count(self, name: str) -> int:
        return int(self.program.literal(f"Main.planner.{name}"))


@contextmanager
def planned() -> Iterator[Planned]:
    with run(PROGRAM, cycles=0) as program:
        yield Planned(program)


def line(start: Sequence[float], end: Sequence[float], **limits: float) -> Element:
    """A straight element."""
    first, last = np.array(start, dtype=float), np.array(end, dtype=float)
    length = float(np.linalg.norm(last - first))
    unit, nothing = (last - first) / length, np.zeros(len(first))
    return Element(length, lambda s: np.stack((first + s * unit, unit, nothing, nothing)), **limits)


def arc(centre: Sequence[float], radius: float, start: float, sweep: float, **limits: float) -> Element:
    """An arc in the plane; angles in radians."""
    turn = float(np.sign(sweep)) / radius
    middle = np.array(centre, dtype=float)

    def shape(s: float) -> Numbers:
        angle = start + s * turn
        out = np.array((np.cos(angle), np.sin(angle)))
        across = np.array((-out[1], out[0]))
        return np.stack(
            (middle + radius * out, radius * turn * across, -radius * turn**2 * out, -radius * turn**3 * across)
        )

    return Element(radius * abs(sweep), shape, curvature=1 / radius, **limits)
