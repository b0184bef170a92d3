"""Build speed: lines per second of a generated project of many POUs, cold, and again after one edit.

There is no other IEC compiler to stand beside it here; the baseline of the edit is the cold build itself.
Bars: docs/architecture.md, section 4.
"""

from __future__ import annotations

import gc
import tempfile
from dataclasses import asdict, replace
from typing import Any

from msgspec import to_builtins

from tappet.bench.report import Report, Row
from tappet.iec.heap import DEFAULT_HEAP
from tappet.iec.task import Task
from tappet.lang.source import Source
from tappet.project.library_reference import LibraryReference
from tappet.server.builds.messages import BuildOrder
from tappet.server.builds.worker import Compiler

POUS = 550
EDITED = (7, 100, 222, 333, 444)
"""Function blocks edited one after the other."""
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


def order(sources: list[Source], previous: bytes | None, cache: str) -> dict[str, Any]:
    """What the server sends its compiler process for these texts and one task."""
    task = Task("Task", programs=("Main",))
    return asdict(
        BuildOrder(
            "bench",
            "Application",
            tuple(to_builtins(source) for source in sources),
            (asdict(task),),
            (LibraryReference("Standard"),),
            previous,
            cache,
            {"rules": {}, "prefixes": {}, "limits": {}},
            asdict(DEFAULT_HEAP),
        )
    )


def build(compiler: Compiler, sources: list[Source], previous: bytes | None, cache: str) -> dict[str, Any]:
    """One build as the compiler process does it, garbage collection outside; raises ValueError."""
    outcome = compiler.build(order(sources, previous, cache))
    compiler.tidy()
    if outcome["package"] is None:
        raise ValueError(outcome["diagnostics"][0]["message"])
    return outcome


def run(pous: int = POUS) -> Report:
    """Cold build, and builds after one edited POU, by what the compiler process of the server runs."""
    sources = project(pous)
    lines = sum(source.text.count("\n") for source in sources)
    compiler = Compiler()
    gc.disable()  # as the compiler process does
    try:
        with tempfile.TemporaryDirectory(prefix="tappet-bench-") as cache:
            cold = build(compiler, sources, None, cache)
            package = cold["package"]

            def edited(number: int, old: str, new: str) -> dict[str, Any]:
                nonlocal package
                source = sources[number]
                sources[number] = replace(source, text=source.text.replace(old, new, 1))
                outcome = build(compiler, sources, package, cache)
                package = outcome["package"]
                return outcome

            blocks = [place % (pous - 1) for place in EDITED]
            body = _median([edited(number, "> 1.0", "> 2.0") for number in blocks])
            calls = edited(-1, "iMode := 1", "iMode := 2")
            added = "diCount : DINT;", "diCount, diMore : DINT;"
            variable = _median([edited(number, *added) for number in blocks])
            local = edited(-1, "END_VAR", "    diMore : DINT;\nEND_VAR")
    finally:
        gc.enable()
    seconds = cold["seconds"]
    median = f"median of {len(EDITED)}; baseline: cold build"
    rows = [
        Row("cold build", seconds, None, "s", f"{lines} lines, {lines / seconds:,.0f} lines/s"),
        Row("one POU edited", body["seconds"], seconds, "s", median),
        Row("program of all calls edited", calls["seconds"], seconds, "s", "baseline: cold build"),
        Row("variable added to one POU", variable["seconds"], seconds, "s", median),
        Row("variable added to the program", local["seconds"], seconds, "s", "baseline: cold build"),
    ]
    remarks = (
        f"cold build by stage: {_stages(cold)}",
        f"one POU edited by stage: {_stages(body)}",
        f"variable added by stage: {_stages(variable)}",
    )
    return Report("build", "the cold build", rows, BAR, remarks)


def _median(outcomes: list[dict[str, Any]]) -> dict[str, Any]:
    return sorted(outcomes, key=lambda outcome: float(outcome["seconds"]))[len(outcomes) // 2]


def _stages(outcome: dict[str, Any]) -> str:
    timings: dict[str, float] = outcome["timings"]
    rest = outcome["seconds"] - sum(timings.values())
    return ", ".join(f"{name} {seconds * 1e3:.0f} ms" for name, seconds in [*timings.items(), ("rest", rest)])
