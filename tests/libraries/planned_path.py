"""Paths as cells for SM3_PathPlanner, and what its planner does with them in every cycle."""

from __future__ import annotations

import ctypes
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field

import numpy as np
import numpy.typing as npt
from scipy.integrate import cumulative_simpson
from scipy.interpolate import make_interp_spline
from tests.libraries.st_program import Program, run

Numbers = npt.NDArray[np.float64]
AXES = 6
PER_CELL = 10 + 6 * AXES
MOST_CELLS = 4000
RECORDS = 20_000
RECORD = (
    "position",
    "velocity",
    "acceleration",
    "jerk",
    "element",
    "limit",
    "axis",
    "share",
    "cell",
    "stands",
)
JERK, ACCELERATION = 0, 1
"""Values of PlanMethod."""
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
    fCycle    : LREAL := 0.001;
    xClears   : BOOL;
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
    """A piece of a path by its own length: q and three derivatives, (4, axes) or (4, places, axes)."""

    length: float
    shape: Callable[[float | Numbers], Numbers]
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
        numbers = np.minimum(cells.astype(int), len(self.owners) - 1)
        places = np.array([place for _, place in self.owners])[numbers] + positions - self.knots[numbers]
        which = np.array([self.elements.index(element) for element, _ in self.owners])[numbers]
        found = np.zeros((len(positions), 4, len(self.limits)))
        for number in np.unique(which):
            mine = which == number
            found[mine] = (
                self.elements[number].shape(places[mine]).transpose(1, 0, 2)[:, :, : len(self.limits)]
            )
        return found


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

    def load(
        self,
        path: Path,
        method: int = JERK,
        per_cycle: int = MOST_CELLS,
        steps: int = 100,
        cycle: float = 0.001,
        **inputs: float | bool | str,
    ) -> None:
        """Forgets what was there; so many cells of the path arrive in each cycle from the next one on."""
        rows = path.rows()
        self.inside[: rows.size] = rows.ravel()
        names = ("fVelocity", "fAcceleration", "fJerk")
        for axis, limits in enumerate(path.limits):
            members = {
                f"aLimits[{axis + 1}].{name}": value for name, value in zip(names, limits, strict=True)
            }
            self.program.set("Main.planner", **members)
        given = {"fOverride": 1.0, "xHold": False, "xClosed": False, **inputs}
        self.program.set("Main.planner", nAxes=len(path.limits), eMethod=method, **given)
        self.program.set("Main", iPerCycle=per_cycle, iSteps=steps, fCycle=cycle)
        self.program.set("Main", iCells=len(rows), xClears=True, iRecords=0)
        self.program.cycle()

    def move(self, cycles: int) -> dict[str, Numbers]:
        """So many cycles of the motion, at most RECORDS; what there was in each."""
        assert cycles <= RECORDS
        self.program.set("Main", iRecords=cycles)
        self.program.cycle()
        table = self.outside[: cycles * len(RECORD)].reshape(cycles, len(RECORD)).copy()
        return {name: table[:, at] for at, name in enumerate(RECORD)}

    def set(self, **inputs: float | bool | str) -> None:
        """Writes inputs of the planner."""
        self.program.set("Main.planner", **inputs)

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

    def shape(s: float | Numbers) -> Numbers:
        along = np.asarray(s)[..., None]
        return np.stack((first + along * unit, unit + 0 * along, nothing + 0 * along, nothing + 0 * along))

    return Element(length, shape, **limits)


def arc(centre: Sequence[float], radius: float, start: float, sweep: float, **limits: float) -> Element:
    """An arc in the plane; angles in radians."""
    turn = float(np.sign(sweep)) / radius
    middle = np.array(centre, dtype=float)

    def shape(s: float | Numbers) -> Numbers:
        angle = start + np.asarray(s) * turn
        out = np.stack((np.cos(angle), np.sin(angle)), axis=-1)
        across = np.stack((-np.sin(angle), np.cos(angle)), axis=-1)
        return np.stack(
            (
                middle + radius * out,
                radius * turn * across,
                -radius * turn**2 * out,
                -radius * turn**3 * across,
            )
        )

    return Element(radius * abs(sweep), shape, curvature=1 / radius, **limits)


def curve(of: Callable[[Numbers], Numbers], last: float, samples: int = 1201, **limits: float) -> Element:
    """A smooth curve q(u), u from 0 to `last`, by its length: a quintic spline through samples of it."""
    u = np.linspace(0.0, last, samples)
    points = of(u)
    speed = make_interp_spline(u, points, k=5).derivative()(u)
    length = cumulative_simpson(np.linalg.norm(speed, axis=1), x=u, initial=0.0)
    spline = make_interp_spline(length, points, k=5)
    orders = (spline, *(spline.derivative(order) for order in (1, 2, 3)))
    return Element(float(length[-1]), lambda s: np.stack([order(s) for order in orders]), **limits)


def wave(amplitude: float, pace: float, last: float, **limits: float) -> Element:
    """A sine in the plane."""
    return curve(lambda u: np.stack((u, amplitude * np.sin(pace * u)), axis=1), last, **limits)


def rounded_corners(cell: float, feed: float, limits: Sequence[tuple[float, float, float]]) -> Path:
    """Two corners of 90 degrees, rounded by arcs of radius 5: the curvature jumps at each joint."""
    own = {"feed": feed, "acceleration": 1000.0, "jerk": 20_000.0}
    half = np.pi / 2
    return Path(
        (
            line((0, 0), (15, 0), **own),
            arc((15, 5), 5, -half, half, **own),
            line((20, 5), (20, 15), **own),
            arc((25, 15), 5, np.pi, -half, **own),
            line((25, 20), (60, 20), **own),
        ),
        cell,
        limits,
    )


@dataclass(frozen=True)
class AxisMotion:
    """Position of the axes; velocity, acceleration and jerk by the chain rule."""

    position: Numbers
    velocity: Numbers
    acceleration: Numbers
    jerk: Numbers

    def shares(self, limits: Sequence[tuple[float, float, float]]) -> Numbers:
        """The largest part of each limit that an axis reaches: velocity, acceleration, jerk."""
        table = np.array(limits)
        orders = (self.velocity, self.acceleration, self.jerk)
        return np.array([(np.abs(values) / table[:, at]).max() for at, values in enumerate(orders)])


def axis_motion(path: Path, record: dict[str, Numbers]) -> AxisMotion:
    """What the axes did."""
    q = path.axes_at(record["element"], record["position"])
    v, a, j = (record[name][:, None] for name in ("velocity", "acceleration", "jerk"))
    q0, q1, q2, q3 = (q[:, order] for order in range(4))
    return AxisMotion(q0, q1 * v, q2 * v**2 + q1 * a, q3 * v**3 + 3 * q2 * v * a + q1 * j)


def duration(record: dict[str, Numbers], cycle: float) -> float:
    """Time of the motion, from the first cycle on; it has ended."""
    assert record["stands"][-1] == 1.0
    return float(np.flatnonzero(record["stands"] == 0.0)[-1] + 1) * cycle
