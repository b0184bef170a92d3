"""Jitter: how late a 1 ms task starts, idle and while 1,000 variables are watched and a build runs.

The baseline is a bare native sleep loop that runs in the same process, at the same time and in the same
scheduling class, so both meet the same machine. Shown is what 99.9 % of the starts kept.
Bar: docs/architecture.md, section 4.
"""

from __future__ import annotations

import ctypes
import multiprocessing
import os
import threading
import time
from collections.abc import Callable
from pathlib import Path

import llvmlite.binding as llvm

from tappet.bench import build as build_bench
from tappet.bench.report import Report, Row
from tappet.codegen.build import build_application
from tappet.codegen.compile_options import OptimiseOptions
from tappet.codegen.optimise import target_machine
from tappet.codegen.system import build_system
from tappet.iec.task import Task
from tappet.lang.source import Scope, Source
from tappet.runtime.local import LocalRuntime, Trace
from tappet.runtime.threads import real_time_scheduling

PERIOD_NS = 1_000_000
SECONDS = 10
WATCHED = 1000
BARE_PRIORITY = 80
"""SCHED_FIFO priority of the bare loop: that of a task of priority 0."""
CLASS_LIMIT_NS = 1_048_576
"""The task's lateness histogram ends here; a baseline above it is cut as well and marked."""
BAR = "99.9 % lateness at most 1.2 x that of a bare native sleep loop beside it"

_PROGRAM = f"""PROGRAM Main
VAR
    aValues : ARRAY [1..{WATCHED}] OF LREAL;
    i : INT;
END_VAR
FOR i := 1 TO {WATCHED} DO
    aValues[i] := aValues[i] + INT_TO_LREAL(i);
END_FOR
END_PROGRAM
"""


class BareLoop:
    """The baseline, compiled from `bare_loop.st` and run in a thread of its own."""

    def __init__(self) -> None:
        path = Path(__file__).with_name("bare_loop.st")
        code = build_system([Source(path.name, path.read_text(encoding="utf-8"), scope=Scope.LIBRARY)])
        self._jit = llvm.create_lljit_compiler(target_machine(OptimiseOptions()), use_jit_link=True)
        builder = llvm.JITLibraryBuilder().add_current_process().add_object_img(code.object)
        self._library = builder.export_symbol("tappet_bare_loop").link(self._jit, "tappet_bare")
        signature = ctypes.CFUNCTYPE(ctypes.c_int32, ctypes.c_void_p, ctypes.c_int64, ctypes.c_int64)
        self._function = signature(self._library["tappet_bare_loop"])

    def start(self, cycles: int, *, realtime: bool) -> Callable[[], int]:
        """Begins; the result waits for the end: the lateness in ns that 99.9 % of the wake-ups kept."""
        lateness = (ctypes.c_int64 * cycles)()
        address = ctypes.addressof(lateness)

        def loop() -> None:
            if realtime:
                os.sched_setscheduler(0, os.SCHED_FIFO, os.sched_param(BARE_PRIORITY))
            self._function(address, cycles, PERIOD_NS)

        thread = threading.Thread(target=loop)
        thread.start()

        def result() -> int:
            thread.join()
            return int(sorted(lateness)[min(cycles - 1, cycles * 999 // 1000)])

        return result


def _build_for(seconds: float) -> None:
    end = time.monotonic() + seconds
    sources = build_bench.project(200)
    round_number = 0
    while time.monotonic() < end:
        round_number += 1
        sources[3] = Source("FB_Unit4", sources[3].text + f"\n(* {round_number} *)", name="FB_Unit4")
        build_application(sources, [Task("Task", programs=("Main",))])


def _watch(trace: Trace, until: float) -> None:
    while time.monotonic() < until:
        trace.collect()
        trace.samples.clear()
        time.sleep(0.1)


def _measure(runtime: LocalRuntime, bare: BareLoop, *, loaded: bool, realtime: bool) -> tuple[int, int]:
    """99.9 % lateness in ns of the task and of the bare loop over the same seconds."""
    end = time.monotonic() + SECONDS
    builder = None
    watcher = None
    trace = None
    if loaded:
        builder = multiprocessing.get_context("spawn").Process(target=_build_for, args=(SECONDS,))
        builder.start()
        trace = runtime.trace(["Main.aValues"], min_interval_ns=100_000_000)
        watcher = threading.Thread(target=_watch, args=(trace, end))
        watcher.start()
    runtime.plc.reset_statistics(None)
    baseline = bare.start(SECONDS * 1_000_000_000 // PERIOD_NS, realtime=realtime)
    base = baseline()
    ours = runtime.statistics()[0].jitter_p999_ns
    if watcher is not None and builder is not None and trace is not None:
        watcher.join()
        builder.join()
        trace.close()
    return ours, base


def run() -> Report:
    """Both situations."""
    task = Task("Task", interval_ns=PERIOD_NS, priority=0, programs=("Main",))
    result = build_application([Source("Main", _PROGRAM, name="Main")], [task])
    if result.package is None:
        raise ValueError(result.diagnostics[0].message)
    rows = []
    bare = BareLoop()
    scheduling = real_time_scheduling(pin=False)
    with LocalRuntime(result.package, virtual=False, scheduling=scheduling) as runtime:
        for name, loaded in (("idle", False), (f"{WATCHED} values watched, build", True)):
            ours, base = _measure(runtime, bare, loaded=loaded, realtime=scheduling.realtime)
            cut = min(base, CLASS_LIMIT_NS)
            note = "beyond the histogram" if max(ours, base) >= CLASS_LIMIT_NS else ""
            rows.append(Row(name, ours / 1000.0, cut / 1000.0, "us", note))
    remarks = ("task lateness is counted in classes of 2.048 us", *scheduling.notes)
    return Report("jitter", "bare clock_nanosleep loop, same process, time and class", rows, BAR, remarks)
