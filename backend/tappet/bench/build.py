"""Build speed: lines per second of a generated project of many POUs, cold, and again after one edit.

There is no other IEC compiler to stand beside it here; the baseline of the edit is the cold build itself.
Bars: DESIGN section 4.
"""

from __future__ import annotations

import time

from tappet.bench.report import Report, Row
from tappet.codegen.build import build_application
from tappet.codegen.package import TaskSpec
from tappet.lang.source import Source

POUS = 550
BAR = "cold build of 550 POUs / 30,000 lines under 5 s on 2 cores; one edited POU under 200 ms"

_BLOCK = """FUNCTION_BLOCK FB_Unit{n}
VAR_INPUT
    xEnable : BOOL;
    lrSet : LREAL;
    iMode : INT;
END_VAR
VAR_OUTPUT
    lrOut : LREAL;
    xDone : BOOL;
    diErrors : DINT;
END_VAR
VAR
    aHistory : ARRAY [0..15] OF LREAL;
    iHead : INT;
    iState : INT;
    lrSum : LREAL;
    diCount : DINT;
    i : INT;
END_VAR
xDone := FALSE;
CASE iState OF
    0:
        IF xEnable THEN
            iState := 1;
            diCount := 0;
        END_IF
    1:
        lrOut := lrOut + (lrSet - lrOut) * 0.{n:03};
        diCount := diCount + 1;
        IF diCount > {n} THEN
            iState := 2;
        END_IF
    2:
        aHistory[iHead] := lrOut;
        iHead := (iHead + 1) MOD 16;
        lrSum := 0.0;
        FOR i := 0 TO 15 DO
            lrSum := lrSum + aHistory[i];
        END_FOR
        iState := 3;
    3:
        IF ABS(lrSum / 16.0 - lrSet) > 1.0 THEN
            diErrors := diErrors + 1;
        END_IF
        xDone := TRUE;
        iState := 0;
ELSE
    iState := 0;
END_CASE
IF iMode = {n} AND NOT xEnable THEN
    lrOut := MAX(lrOut, lrSet);
ELSIF iMode < 0 THEN
    lrOut := LIMIT(-100.0, lrOut, 100.0);
END_IF
END_FUNCTION_BLOCK
"""


def project(pous: int = POUS) -> list[Source]:
    """Sources of a synthetic application of `pous` function blocks, all instantiated and called by `Main`."""
    sources = [Source(f"FB_Unit{n}", _BLOCK.format(n=n), name=f"FB_Unit{n}") for n in range(1, pous)]
    instances = "".join(f"    fb{n} : FB_Unit{n};\n" for n in range(1, pous))
    calls = "".join(f"fb{n}(xEnable := TRUE, lrSet := {n}.5, iMode := 1);\n" for n in range(1, pous))
    main = f"PROGRAM Main\nVAR\n{instances}END_VAR\n{calls}END_PROGRAM\n"
    return [*sources, Source("Main", main, name="Main")]


def run() -> Report:
    """Cold build, and the build after one edited POU."""
    sources = project()
    lines = sum(source.text.count("\n") for source in sources)
    tasks = [TaskSpec("Task", programs=("Main",))]
    start = time.perf_counter()
    cold = build_application(sources, tasks)
    cold_seconds = time.perf_counter() - start
    if cold.package is None:
        raise ValueError(cold.diagnostics[0].message)
    edited = list(sources)
    edited[7] = Source("FB_Unit8", edited[7].text.replace("0.008", "0.009"), name="FB_Unit8")
    start = time.perf_counter()
    build_application(edited, tasks, previous=cold.package)
    edit_seconds = time.perf_counter() - start
    rows = [
        Row("cold build", cold_seconds, None, "s", f"{lines} lines, {lines / cold_seconds:,.0f} lines/s"),
        Row("one POU edited", edit_seconds, cold_seconds, "s", "baseline: cold build"),
    ]
    stages = ", ".join(f"{name} {seconds:.2f} s" for name, seconds in cold.timings.items())
    return Report("build", "the cold build", rows, BAR, (f"cold build by stage: {stages}",))
