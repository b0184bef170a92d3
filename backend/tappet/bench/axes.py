"""Cost of axes: in standstill, in motion, coupled, with a new command, and of building 100 of them.

An axis has its PLCopen state machine, its monitoring, MC_Power and the block that moves it, called in every
cycle. What it is measured against: docs/benchmarks.md. Bars: docs/architecture.md, section 4.
"""

from __future__ import annotations

import importlib.util
import shutil
import subprocess
import time
from collections.abc import Callable, Sequence
from pathlib import Path

from tappet.bench.native import CProgram, NativeLoop, gcc_version, scratch_directory
from tappet.bench.program import built, running
from tappet.bench.report import Report, Row
from tappet.runtime.local import LocalRuntime

MOTION = Path(__file__).resolve().parent / "motion"
AXES = 1000
ROUNDS = 15
CYCLES = 40
"""Cycles of one timed round."""
RUCKIG = "baseline: C++ Ruckig"
BAR = (
    "moving with limited jerk at most 200 ns, a slave of a cam at most 300 ns, a new command at most 20 us,"
    " re-planning at most 2 x Ruckig"
)
DISCRETE_MOTION, SYNCHRONIZED_MOTION = 4, 6
RAMP_TYPES = ("trapez", "sin2", "quadratic", "quadratic_smooth")
_HEAD = """PROGRAM Main
VAR
    Axis   : ARRAY [1..{axes}] OF SM3_Basic.{kind};
    Power  : ARRAY [1..{axes}] OF SM3_Basic.MC_Power;
    i      : INT;
    xGo    : BOOL;
    xAgain : BOOL; (* An edge in every second cycle *)
    rtRamp : SM3_Basic.SMC_RAMPTYPE;
    fTarget, fOther, fBefore, fSpeed, fRamp, fJerk : LREAL;
    result : LREAL;
{variables}
END_VAR
IF xAgain THEN
    xGo := NOT xGo;
    fBefore := fTarget;
    fTarget := SEL(xGo, fTarget, fOther);
    fOther := SEL(xGo, fOther, fBefore);
END_IF
FOR i := 1 TO {axes} DO
    Axis[i].eRampType := rtRamp;
    Axis[i].fTaskCycle := 0.001;
    Axis[i].fMaxVelocity := 1E9;
    Axis[i].fMaxAcceleration := 1E9;
    Axis[i].fMaxDeceleration := 1E9;
    Axis[i].BeginCycle();
    Power[i](Axis := Axis[i], Enable := TRUE, bRegulatorOn := TRUE, bDriveStart := TRUE);
END_FOR
{calls}
FOR i := 1 TO {axes} DO
    Axis[i].EndCycle();
END_FOR
result := Axis[{axes}].fSetPosition;
END_PROGRAM
"""


def program(axes: int, variables: str, calls: str, kind: str = "AXIS_REF_VIRTUAL_SM3") -> str:
    """A program with axes of a type, `{axes}` in the parts being their number."""
    parts = {"variables": variables.format(axes=axes), "calls": calls.format(axes=axes)}
    return _HEAD.format(axes=axes, kind=kind, **parts)


MOVES = (
    "    Move : ARRAY [1..{axes}] OF SM3_Basic.MC_MoveAbsolute;",
    """FOR i := 1 TO {axes} DO
    Move[i](Axis := Axis[i], Execute := xGo, Position := fTarget, Velocity := fSpeed, Acceleration := fRamp,
        Deceleration := fRamp, Jerk := fJerk);
END_FOR""",
)
SERVOS = (
    MOVES[0] + "\n    Drive : ARRAY [1..{axes}] OF SM3_Basic.SimulatedDrive;",
    """FOR i := 1 TO {axes} DO
    Drive[i](stOut := Axis[i].out, fCycle := 0.001);
    Axis[i].in := Drive[i].stIn;
    Axis[i].iRatioTechUnitsNum := 360;
    Axis[i].dwRatioTechUnitsDenom := 65536;
END_FOR
"""
    + MOVES[1],
)
"""Each axis with a simulated drive, which computes its loops in 64 parts of a cycle."""
GEARS = (
    "    Lead : SM3_Basic.MC_MoveVelocity;\n    Gear : ARRAY [1..{axes}] OF SM3_Basic.MC_GearIn;",
    """Lead(Axis := Axis[1], Execute := xGo, Velocity := 100.0, Acceleration := 1.0, Deceleration := 1.0);
FOR i := 2 TO {axes} DO
    Gear[i](Master := Axis[1], Slave := Axis[i], Execute := xGo, RatioNumerator := 2, Acceleration := 1E6,
        Deceleration := 1E6);
END_FOR""",
)
CAMS = (
    """    Lead   : SM3_Basic.MC_MoveVelocity;
    Points : ARRAY [0..3] OF SM3_Basic.SMC_CAMXYVA := [(dX := 0, dY := 0), (dX := 120, dY := 120, dV := 1),
        (dX := 240, dY := 240, dV := 1), (dX := 360, dY := 360)];
    Cam    : SM3_Basic.MC_CAM_REF := (byType := 3, nElements := 4, xEnd := 360, pce := ADR(Points));
    Select : SM3_Basic.MC_CamTableSelect;
    CamIn  : ARRAY [1..{axes}] OF SM3_Basic.MC_CamIn;""",
    """Lead(Axis := Axis[1], Execute := xGo, Velocity := 100.0, Acceleration := 1E6, Deceleration := 1E6);
Select(Master := Axis[1], Slave := Axis[2], CamTable := Cam, Execute := xGo, SlaveAbsolute := FALSE);
FOR i := 2 TO {axes} DO
    CamIn[i](Master := Axis[1], Slave := Axis[i], Execute := xGo, CamTableID := Select.CamTableID);
END_FOR""",
)


def _expect(runtime: LocalRuntime, path: str, state: int) -> None:
    if runtime.read(path) != state:
        raise ValueError(f"{path} is {runtime.read(path)}, not {state}: something else was measured")


def _nanoseconds(loop: NativeLoop, cycle: int, axes: int, rounds: int = ROUNDS) -> float:
    """Of one axis in one cycle, the fastest round."""
    return min(loop.seconds(cycle, CYCLES) for _ in range(rounds)) / CYCLES / axes * 1e9


def moving(loop: NativeLoop, ramp: int, axes: int = AXES) -> tuple[float, float, float]:
    """Nanoseconds of an axis and cycle in standstill and in motion, and microseconds of a new command."""
    with running(program(axes, *MOVES)) as (runtime, cycle):
        for name, value in (("fTarget", 1e9), ("fSpeed", 1e6), ("fRamp", 20.0), ("fJerk", 1e-2)):
            runtime.write(f"Main.{name}", value)
        runtime.write("Main.rtRamp", ramp)
        loop.seconds(cycle, 5)
        standing = _nanoseconds(loop, cycle, axes)
        runtime.write("Main.xGo", True)
        command = loop.seconds(cycle, 1) / axes * 1e6
        loop.seconds(cycle, 2)
        in_motion = _nanoseconds(loop, cycle, axes)
        _expect(runtime, "Main.Axis[1].nAxisState", DISCRETE_MOTION)
    return standing, in_motion, command


def driven(loop: NativeLoop, axes: int = 100) -> float:
    """Nanoseconds of an axis in motion with its simulated drive and a cycle."""
    with running(program(axes, *SERVOS, "AXIS_REF_MAPPING_SM3")) as (runtime, cycle):
        for name, value in (("fTarget", 1e6), ("fSpeed", 1e3), ("fRamp", 2e3), ("fJerk", 1e5)):
            runtime.write(f"Main.{name}", value)
        loop.seconds(cycle, 20)
        runtime.write("Main.xGo", True)
        loop.seconds(cycle, 20)
        found = _nanoseconds(loop, cycle, axes)
        _expect(runtime, "Main.Axis[1].nAxisState", DISCRETE_MOTION)
        if float(str(runtime.read("Main.Drive[1].fVelocity"))) <= 0.0:
            raise ValueError("the motor of the simulated drive sticks: its cost in motion was not measured")
    return found


FAR, NEAR = (1000.0, 1010.0), (10.0, -10.0)
"""Two targets in turn: those over the largest velocity, and those where it is not reached."""


def replanning(loop: NativeLoop, targets: tuple[float, float], axes: int = AXES) -> float:
    """Microseconds of a command with limited jerk to an axis in motion, above those of moving."""
    with running(program(axes, *MOVES)) as (runtime, cycle):
        for name, value in (("fSpeed", 50.0), ("fRamp", 20.0), ("fJerk", 200.0)):
            runtime.write(f"Main.{name}", value)
        runtime.write("Main.fTarget", targets[0])
        runtime.write("Main.fOther", targets[1])
        runtime.write("Main.rtRamp", RAMP_TYPES.index("quadratic"))
        loop.seconds(cycle, 5)
        runtime.write("Main.xGo", True)
        loop.seconds(cycle, 2)
        alone = _nanoseconds(loop, cycle, axes)
        runtime.write("Main.xAgain", True)
        return 2 * (_nanoseconds(loop, cycle, axes) - alone) / 1000


def coupled(loop: NativeLoop, parts: tuple[str, str], axes: int = AXES) -> float:
    """Nanoseconds of a slave and cycle while the master accelerates."""
    with running(program(axes, *parts)) as (runtime, cycle):
        loop.seconds(cycle, 5)
        runtime.write("Main.xGo", True)
        loop.seconds(cycle, 5)
        found = _nanoseconds(loop, cycle, axes)
        _expect(runtime, "Main.Axis[2].nAxisState", SYNCHRONIZED_MOTION)
    return found


def ruckig(directory: Path, targets: tuple[float, float]) -> CProgram | None:
    """The moves of `replanning` in C++; None without g++ or the wheel of Ruckig, which has the library."""
    found = importlib.util.find_spec("ruckig")
    if found is None or found.origin is None or shutil.which("g++") is None:
        return None
    library = Path(found.origin)
    target = directory / f"ruckig_{targets[0]:.0f}.so"
    command = [
        "g++",
        "-O2",
        "-std=c++20",
        "-shared",
        "-fPIC",
        f"-I{library.parent / 'include'}",
        "-o",
        str(target),
    ]
    command += [str(MOTION / "ruckig_replan.cpp"), "-Wl,--unresolved-symbols=ignore-all", str(library)]
    command += [f"-Wl,-rpath,{library.parent}", f"-DTARGET={targets[0]}", f"-DOTHER={targets[1]}"]
    importlib.import_module("ruckig")
    done = subprocess.run(command, check=False, capture_output=True)  # noqa: S603 - our own file and arguments
    return CProgram.compiled(target) if done.returncode == 0 else None


def _base(loop: NativeLoop, program: CProgram | None, count: int, divisor: float) -> float | None:
    if program is None:
        return None
    loop.seconds(program.cycle, count)
    return min(loop.seconds(program.cycle, count) for _ in range(ROUNDS)) / count / divisor


def project(axes: int = 100) -> Row:
    """Seconds to build a project with axes and a block each, and the memory of its variables."""
    start = time.process_time()
    package = built(program(axes, *MOVES))
    seconds = time.process_time() - start
    size = package.image_size
    return Row(
        f"build of {axes} axes",
        seconds,
        None,
        "s",
        f"{size / 1024:,.0f} KiB of variables, {size // axes} B an axis",
    )


def run(only: Sequence[str] = ()) -> Report:
    """All rows, or those of the parts that are named: moving, count, drives, gears, cams, replan, build."""
    loop = NativeLoop()
    compiler = gcc_version()
    with scratch_directory() as scratch:
        directory = Path(scratch)
        segments = CProgram(MOTION / "segments.c", directory) if compiler else None
        evaluated = _base(loop, segments, CYCLES, AXES / 1e9)
        cams = CProgram(MOTION / "cams.c", directory) if compiler else None
        parts: dict[str, Callable[[], list[Row]]] = {
            "moving": lambda: _moving_rows(loop, evaluated),
            "count": lambda: [
                Row(f"moving, quadratic, {axes} axes", moving(loop, 2, axes)[1], evaluated, "ns")
                for axes in (1, 10, 100, 10_000)
            ],
            "drives": lambda: [
                Row(
                    "moving with a simulated drive",
                    driven(loop),
                    evaluated,
                    "ns",
                    "its loops 64 times a cycle",
                )
            ],
            "gears": lambda: [Row("slave of a gear", coupled(loop, GEARS), evaluated, "ns")],
            "cams": lambda: [
                Row(
                    "slave of a cam",
                    coupled(loop, CAMS),
                    _base(loop, cams, CYCLES, AXES / 1e9),
                    "ns",
                    "baseline: the cam in C",
                )
            ],
            "replan": lambda: [
                Row(
                    f"re-planning in flight, quadratic, {name}",
                    replanning(loop, targets),
                    _base(loop, ruckig(directory, targets), 1000, 1e-6),
                    "us",
                    RUCKIG,
                )
                for name, targets in (("far", FAR), ("near", NEAR))
            ],
            "build": lambda: [project()],
        }
        rows = [row for name, part in parts.items() if not only or name in only for row in part()]
    remark = () if compiler else ("gcc is not installed: no baseline",)
    return Report(
        "axes", f"segments evaluated in C, {compiler} -O2" if compiler else "none", rows, BAR, remark
    )


def _moving_rows(loop: NativeLoop, evaluated: float | None) -> list[Row]:
    rows = []
    for number, name in enumerate(RAMP_TYPES):
        standing, in_motion, command = moving(loop, number)
        rows.append(Row(f"moving, {name}", in_motion, evaluated, "ns", f"in standstill {standing:.0f} ns"))
        rows.append(Row(f"new command, {name}", command, None, "us", f"to {AXES:,} axes in one cycle"))
    return rows
