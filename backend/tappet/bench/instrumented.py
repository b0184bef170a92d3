"""What debugging costs while it is used: the instrumented variant beside the normal code, nothing halts.

Both run in the soft PLC on virtual time; the executive takes the times around the programs.
"""

from __future__ import annotations

import math
from collections.abc import Iterable
from pathlib import Path

from tappet.codegen.build import BuildSession, build_application
from tappet.codegen.debug_build import instrument
from tappet.iec.task import Task
from tappet.lang.source import Source
from tappet.runtime.flight import FlightSettings
from tappet.runtime.local import LocalRuntime

CYCLES = 20
ROUNDS = 15


def ratio(path: Path) -> float:
    """Time of a workload in the instrumented variant, as a multiple of that in the normal code."""
    session = BuildSession()
    source = Source(uri=path.name, text=path.read_text(encoding="utf-8"), name=path.stem)
    result = build_application([source], [Task("Task", programs=("Main",))], session=session)
    assert result.package is not None
    assert session.generated is not None
    with LocalRuntime(result.package, flight=FlightSettings(memory=0)) as runtime:
        runtime.plc.debugger.load(instrument(session.generated).to_bytes())
        times: dict[bool, list[int]] = {False: [], True: []}
        for _ in range(ROUNDS):
            for active in (False, True):
                runtime.plc.debugger.keep_active(active)
                runtime.plc.reset_statistics(None)
                runtime.run(CYCLES)
                times[active].append(runtime.plc.tasks()[0].min_ns)
    return min(times[True]) / max(min(times[False]), 1)


def remark(paths: Iterable[Path]) -> str:
    """One figure over all workloads."""
    ratios = [ratio(path) for path in paths]
    mean = math.exp(sum(math.log(r) for r in ratios) / len(ratios))
    return (
        f"instrumented code: {mean:.2f} x the normal one, {min(ratios):.2f} to {max(ratios):.2f} (debugging)"
    )
