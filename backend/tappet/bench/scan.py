"""Scan speed: workloads in ST, checks on, beside the same algorithm in C compiled by gcc -O2.

Final values are compared, so a fast wrong answer does not count; the time of an empty call is taken off both.
Both are timed in turns, and the fastest round of each is shown: what else the machine does only ever adds.
What each workload is like and how its C version is written: docs/benchmarks.md. Bar: architecture, 4.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from pathlib import Path

from tappet.bench import instrumented
from tappet.bench.native import CProgram, NativeLoop, gcc_version, scratch_directory
from tappet.bench.report import Report, Row
from tappet.codegen.build import build_application
from tappet.iec.task import Task
from tappet.lang.source import Source
from tappet.runtime.flight import FlightSettings
from tappet.runtime.local import LocalRuntime

WORKLOADS = Path(__file__).resolve().parent / "workloads"
ROUNDS = 25
"""Rounds in which both are timed alternately."""
TARGET_SECONDS = 0.012
"""Length of one timed run."""
BAR = "at most 1.25 x C"


class WrongResultError(Exception):
    """The ST and the C version disagree on the result."""


def names() -> list[str]:
    """Workloads in alphabetical order."""
    return sorted(path.stem for path in WORKLOADS.glob("*.st"))


def load(name: str) -> LocalRuntime:
    """The ST version of a workload in the soft PLC, stopped; its program is `Main`."""
    path = WORKLOADS / f"{name}.st"
    source = Source(uri=path.name, text=path.read_text(encoding="utf-8"), name=name)
    result = build_application([source], [Task("Task", programs=("Main",))])
    if result.package is None:
        raise ValueError(
            "\n".join(f"{d.uri}:{d.span.line + 1}: {d.code} {d.message}" for d in result.diagnostics)
        )
    return LocalRuntime(result.package, flight=FlightSettings(memory=0), start=False)


def cycle_of(runtime: LocalRuntime) -> int:
    """Address of the function that runs one cycle."""
    application = runtime.plc.application
    assert application is not None
    return application.code[runtime.package.tasks[0].symbol]


def compare(name: str, cycles: int, directory: Path) -> tuple[float, float]:
    """Results of both versions after the same number of cycles; raises WrongResultError when they differ."""
    application = load(name)
    loop = NativeLoop()
    try:
        loop.seconds(cycle_of(application), cycles)
        ours = float(str(application.read("Main.result")))
    finally:
        application.close()
    program = CProgram(WORKLOADS / f"{name}.c", directory)
    loop.seconds(program.cycle, cycles)
    if not math.isclose(ours, program.result, rel_tol=1e-12, abs_tol=1e-12):
        raise WrongResultError(f"{name}: ST gives {ours!r}, C gives {program.result!r} after {cycles} cycles")
    return ours, program.result


def measure(name: str, directory: Path | None) -> Row:
    """Microseconds per cycle of one workload, beside C when there is a directory to compile it in."""
    loop = NativeLoop()
    application = load(name)
    try:
        ours_at = cycle_of(application)
        program = None
        if directory is not None:
            compare(name, 100, directory)
            program = CProgram(WORKLOADS / f"{name}.c", directory)
        cycles = _calibrate(loop, ours_at)
        ours: list[float] = []
        base: list[float] = []
        for _ in range(ROUNDS):
            ours.append(loop.seconds(ours_at, cycles) / cycles * 1e6)
            if program is not None:
                base.append(loop.seconds(program.cycle, cycles) / cycles * 1e6)
    finally:
        application.close()
    return Row(name, min(ours), min(base, default=None), "us/cycle")


def _calibrate(loop: NativeLoop, function: int) -> int:
    cycles = 64
    while (seconds := loop.seconds(function, cycles)) < TARGET_SECONDS / 2 and cycles < 1 << 24:
        cycles = int(cycles * min(max(TARGET_SECONDS / max(seconds, 1e-6), 2.0), 16.0))
    return cycles


def run(only: Sequence[str] = ()) -> Report:
    """All workloads, or those named."""
    compiler = gcc_version()
    with scratch_directory() as scratch:
        directory = Path(scratch) if compiler else None
        rows = [measure(name, directory) for name in names() if not only or name in only]
    remark = [] if compiler else ["gcc is not installed: no baseline"]
    remark.append(instrumented.remark(WORKLOADS / f"{row.name}.st" for row in rows))
    return Report("scan", f"{compiler} -O2" if compiler else "none", rows, BAR, remark)
