"""CNC programs: path objects decoded, preprocessed and planned a second, and a cycle of the interpolator.

The blocks are called as a slow path task calls them, by a consumer that is never in the way. What they are
measured against: docs/benchmarks.md.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path

from tappet.bench.native import CProgram, NativeLoop, gcc_version, scratch_directory
from tappet.bench.program import running
from tappet.bench.report import Report, Row
from tappet.runtime.local import LocalRuntime

SOURCES = Path(__file__).resolve().parent / "cnc_path"
LIBRARIES = ("SM3_Basic", "SM3_CNC")
LINES = 10_000
"""Lines of a program, each of which is a path object."""
ROOM = 100
"""Path objects in a queue: how far the plan looks ahead."""
LEFT = 80
"""Path objects that the consumer leaves in the last queue each time that it is full."""
ROUNDS = 7
IPO_CYCLES = 1000
BAR = "short lines through decoder, preprocessing and plan: 200,000 a second"


@dataclass(frozen=True)
class Stage:
    """A block between two queues: its type and its other inputs."""

    block: str
    inputs: str = ""
    own_queue: bool = True


PLAN = ("plan", Stage("SMC_CheckVelocities", "dAngleTol := 10.0", own_queue=False))
STAGES = {
    "rounding": Stage("SMC_RoundPath", "dRadius := 0.02"),
    "smoothing": Stage("SMC_SmoothPath", "dEdgeDistance := 0.02"),
    "tool radius correction": Stage("SMC_ToolCorr", "dToolRadius := 0.01"),
    "loop avoidance": Stage("SMC_AvoidLoop"),
    "limits on arcs": Stage("SMC_LimitCircularVelocity", "dMaxAcc := 1E6"),
}
WHOLE = [("rounding", STAGES["rounding"]), ("limits on arcs", STAGES["limits on arcs"]), PLAN]
MODES = ("TRAPEZOID", "SIGMOID", "QUADRATIC")
MARKS = {"rounding": "52", "smoothing": "51", "tool radius correction": "41", "loop avoidance": "61"}
"""G commands that switch a stage on, in front of the program."""
ELEMENTS = {
    "lines": "Put(GCODE_G, 1); Put(GCODE_X, dX); Put(GCODE_Y, dY);",
    "arcs": "Put(GCODE_G, 3); Put(GCODE_X, dX); Put(GCODE_Y, dY); Put(GCODE_R, 10.0);",
    "splines": "Put(GCODE_G, 5); Put(GCODE_X, dX); Put(GCODE_Y, dY);",
}
"""The words of an element that ends in (dX, dY)."""
_HEAD = """PROGRAM Main
VAR
    aWords  : ARRAY[0..{words}] OF SM3_CNC.SMC_GCODE_WORD;
    ncprog  : SM3_CNC.SMC_CNC_REF;
    dec     : SM3_CNC.SMC_NCDecoder;
    aQueue  : ARRAY[1..{room}] OF SM3_CNC.SMC_GEOINFO;
{variables}
    pOut    : POINTER TO SM3_CNC.SMC_OUTQUEUE;
    xFilled : BOOL;
    n, nObjects, nDeepest, nLeave : DINT;
    dX, dY, dAngle : LREAL;
    xError  : BOOL;
    result  : LREAL; (* Path objects that came out in the last cycle *)
END_VAR
VAR CONSTANT
    GCODE_G : BYTE := 71;
    GCODE_X : BYTE := 88;
    GCODE_Y : BYTE := 89;
    GCODE_R : BYTE := 82;
    GCODE_F : BYTE := 70;
    GCODE_D : BYTE := 68;
END_VAR
IF NOT xFilled THEN
    xFilled := TRUE;
    ncprog.pgc := ADR(aWords);
    Put(GCODE_F, 50.0);
    EndLine();
{marks}
    FOR n := 1 TO {lines} DO
        dAngle := dAngle + 0.01;
        dX := dX + 0.1 * COS(dAngle);
        dY := dY + 0.1 * SIN(dAngle);
        {element}
        EndLine();
    END_FOR
END_IF
nObjects := 0;
{reset}
REPEAT
    dec(bExecute := TRUE, ncprog := ncprog, nSizeOutQueue := SIZEOF(aQueue), pbyBufferOutQueue := ADR(aQueue),
        fTimeBudget := 1.0);
    xError := dec.bError;
    pOut := dec.poqDataOut;
{calls}
    nDeepest := MAX(nDeepest, SM3_CNC.SMC_GetCount(pOut));
    nLeave := 0;
    IF NOT xError AND NOT pOut^.bEndOfList THEN
        nLeave := {left};
    END_IF
    IF pOut^.bFull OR nLeave = 0 THEN
        WHILE SM3_CNC.SMC_GetCount(pOut) > nLeave DO
            SM3_CNC.SMC_DeleteObj(pOut, 0);
            nObjects := nObjects + 1;
        END_WHILE
    END_IF
UNTIL xError OR pOut^.bEndOfList
END_REPEAT
result := nObjects;
END_PROGRAM

METHOD Put
VAR_INPUT
    byLetter : BYTE;
    fValue   : LREAL;
END_VAR
aWords[ncprog.nElements].byLetter := byLetter;
aWords[ncprog.nElements].fValue := fValue;
aWords[ncprog.nElements].diValue := LREAL_TO_DINT(fValue);
ncprog.nElements := ncprog.nElements + 1;
END_METHOD

METHOD EndLine
aWords[ncprog.nElements].byLetter := 0;
ncprog.nElements := ncprog.nElements + 1;
END_METHOD
"""
_INTERPOLATION = """PROGRAM Main
VAR
    queue   : SM3_CNC.SMC_OUTQUEUE;
    aQueue  : ARRAY[1..{room}] OF SM3_CNC.SMC_GEOINFO;
    geo     : SM3_CNC.SMC_GEOINFO;
    check   : SM3_CNC.SMC_CheckVelocities;
    ipo     : SM3_CNC.SMC_Interpolator := (dwIpoTime := 1000, iVelMode := SM3_CNC.SMC_INT_VELMODE.{mode});
    xFilled : BOOL;
    n       : DINT;
    dAt     : LREAL;
    result  : LREAL;
END_VAR
IF NOT xFilled THEN
    xFilled := TRUE;
    queue.pbyBuffer := ADR(aQueue);
    SM3_CNC.SMC_SetQueueCapacity(ADR(queue), SIZEOF(aQueue));
    SM3_CNC.SMC_OutQueueInit(ADR(queue));
    geo.dVel := 50.0;
    geo.dVelEnd := 50.0;
END_IF
FOR n := 1 TO {cycles} DO
    IF NOT queue.bFull THEN
        geo.iMoveType := SM3_CNC.SMC_MOVTYP.LIN;
        geo.piStartPos.dX := dAt;
        dAt := dAt + 1.0;
        geo.piDestPos.dX := dAt;
        geo.dLength := 1.0;
        SM3_CNC.SMC_AppendObj(ADR(queue), ADR(geo));
        check(bExecute := TRUE, poqDataIn := ADR(queue), dAngleTol := 1.0);
    END_IF
    ipo(bExecute := queue.bFull OR ipo.bBusy, poqDataIn := ADR(queue));
END_FOR
result := ipo.piSetPosition.dX;
END_PROGRAM
"""


def chain(element: str, stages: Sequence[tuple[str, Stage]], lines: int = LINES) -> str:
    """A program that decodes `lines` elements of a kind and sends them through blocks, once a cycle."""
    variables, calls, reset = "", "", "dec(bExecute := FALSE, ncprog := ncprog);\n"
    for n, (_, stage) in enumerate(stages):
        variables += f"    fb{n} : SM3_CNC.{stage.block};\n"
        queue = ""
        if stage.own_queue:
            variables += f"    aQueue{n} : ARRAY[1..{ROOM}] OF SM3_CNC.SMC_GEOINFO;\n"
            queue = f", nSizeOutQueue := SIZEOF(aQueue{n}), pbyBufferOutQueue := ADR(aQueue{n})"
        inputs = f", {stage.inputs}" if stage.inputs else ""
        reset += f"fb{n}(bExecute := FALSE);\n"
        calls += f"    fb{n}(bExecute := TRUE, poqDataIn := pOut{queue}{inputs});\n"
        calls += f"    xError := xError OR fb{n}.bError;\n    pOut := fb{n}.poqDataOut;\n"
    marks = "".join(
        f"    Put(GCODE_G, {MARKS[name]});\n    EndLine();\n" for name, _ in stages if name in MARKS
    )
    return _HEAD.format(
        words=5 * lines + 100,
        room=ROOM,
        left=LEFT,
        lines=lines,
        variables=variables,
        marks=marks,
        element=ELEMENTS[element],
        reset=reset,
        calls=calls,
    )


def passing(
    loop: NativeLoop, element: str, stages: Sequence[tuple[str, Stage]] = (), lines: int = LINES
) -> tuple[float, int]:
    """Nanoseconds of a line on its way through the chain, and how many waited in its last queue at most.

    Raises ValueError where the program does not come through.
    """
    with running(chain(element, stages, lines), LIBRARIES) as (runtime, cycle):
        seconds = min(loop.seconds(cycle, 1) for _ in range(ROUNDS))
        if runtime.read("Main.xError") or _number(runtime, "Main.result") < lines:
            names = ", ".join(name for name, _ in stages)
            raise ValueError(f"{element} through {names}: {runtime.read('Main.result')} of {lines} came out")
        return seconds / lines * 1e9, int(_number(runtime, "Main.nDeepest"))


def interpolation(loop: NativeLoop, mode: str) -> float:
    """Nanoseconds of a call of the interpolator in motion, with a queue that is always full."""
    with running(_INTERPOLATION.format(room=ROOM, cycles=IPO_CYCLES, mode=mode), LIBRARIES) as (
        runtime,
        cycle,
    ):
        loop.seconds(cycle, 3)
        before = _number(runtime, "Main.result")
        found = min(loop.seconds(cycle, 1) for _ in range(ROUNDS)) / IPO_CYCLES * 1e9
        if _number(runtime, "Main.result") <= before:
            raise ValueError(f"the interpolator stands in mode {mode}: its cost in motion was not measured")
        return found


def _number(runtime: LocalRuntime, path: str) -> float:
    return float(str(runtime.read(path)))


def queue_bytes(loop: NativeLoop, lines: int) -> int:
    """Bytes of all variables but the words of the program: the queues, whatever the length of the program."""
    with running(chain("lines", [PLAN], lines), LIBRARIES) as (runtime, _):
        return runtime.package.image_size - runtime.package.symbols.resolve("Main.aWords").size


def run(only: Sequence[str] = ()) -> Report:
    """All rows, or those of the parts that are named: decode, stages, plan, interpolate, memory."""
    loop = NativeLoop()
    compiler = gcc_version()
    with scratch_directory() as scratch:
        planned = along = None
        if compiler:
            planned = _in_c(loop, CProgram(SOURCES / "lines.c", Path(scratch)), LINES)
            along = _in_c(loop, CProgram(SOURCES / "along.c", Path(scratch)), IPO_CYCLES)
        parts: dict[str, Callable[[], list[Row]]] = {
            "decode": lambda: [_row(loop, f"{element} decoded", element) for element in ELEMENTS],
            "stages": lambda: [
                _row(loop, f"lines decoded, {name}", "lines", [(name, stage)])
                for name, stage in STAGES.items()
            ],
            "plan": lambda: [
                *(
                    _row(loop, f"{element} decoded, planned", element, [PLAN], planned)
                    for element in ELEMENTS
                ),
                _row(loop, "lines decoded, rounded, limited, planned", "lines", WHOLE, planned),
            ],
            "interpolate": lambda: [
                Row(f"interpolation, {mode}", interpolation(loop, mode), along, "ns", "a cycle in motion")
                for mode in MODES
            ],
            "memory": lambda: [_memory(loop)],
        }
        rows = [row for name, part in parts.items() if not only or name in only for row in part()]
    remark = () if compiler else ("gcc is not installed: no baseline",)
    return Report("cnc", f"the same in C, {compiler} -O2" if compiler else "none", rows, BAR, remark)


def _in_c(loop: NativeLoop, program: CProgram, count: int) -> float:
    """Nanoseconds of one of `count` elements of a cycle in C."""
    loop.seconds(program.cycle, 1)
    return min(loop.seconds(program.cycle, 1) for _ in range(ROUNDS)) / count * 1e9


def _row(
    loop: NativeLoop,
    name: str,
    element: str,
    stages: Sequence[tuple[str, Stage]] = (),
    baseline: float | None = None,
) -> Row:
    nanoseconds, deepest = passing(loop, element, stages)
    note = f"{1e9 / nanoseconds:,.0f} a second, {deepest} ahead"
    return Row(name, nanoseconds, baseline if element == "lines" else None, "ns", note)


def _memory(loop: NativeLoop) -> Row:
    small, large = queue_bytes(loop, 1000), queue_bytes(loop, LINES)
    return Row(
        "variables with 1,000 lines", small / 1024, large / 1024, "KiB", f"baseline: with {LINES:,} lines"
    )
