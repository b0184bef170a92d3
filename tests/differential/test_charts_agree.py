"""Random charts, several in one program: the compiler and the reference agree in every call."""

from __future__ import annotations

from random import Random

import chart_tree
from chart_reference import Run
from charts import ChartMaker
from linked_application import LoadedApplication
from seeds import seeds

from tappet.codegen.build import BuildOptions, BuildSession, build_application
from tappet.lang.source import Source

SESSION = BuildSession()
COUNT, CALLS = 8, 40
"""Charts of one program, and how often each is called."""


def numbers(seed: int) -> list[int]:
    """The input of every call."""
    r = Random(seed)
    return [r.getrandbits(32) for _ in range(CALLS)]


def check(seed: int, level: int, count: int = COUNT) -> None:
    r = Random(seed)
    charts = [ChartMaker(r).make() for _ in range(count)]
    texts = [chart_tree.text(c, f"FB{i}") for i, c in enumerate(charts)]
    calls = []
    for i, c in enumerate(charts):
        given = [f"{f} := r.{a} AND r.{b}" for f, (a, b) in c.inputs.items()]
        calls.append(f"b{i}({', '.join(['r := r', *given])});")
    instances = "".join(f"b{i} : FB{i}; " for i in range(count))
    main = f"PROGRAM PLC_PRG\nVAR r : UDINT; {instances}END_VAR\n" + "\n".join(calls) + "\nEND_PROGRAM"
    sources = [Source("main", "\n".join([main, chart_tree.ASK]))]
    sources += [Source(f"text{i}", text) for i, text in enumerate(texts)]
    result = build_application(sources, session=SESSION, options=BuildOptions(level=level))
    errors = [f"{d.uri} {d}" for d in result.diagnostics if d.severity == "error"]
    assert errors == [], f"seed {seed}"
    assert result.package is not None
    application = LoadedApplication(result.package)
    runs = [Run(c) for c in charts]
    try:
        application.start()
        for call, number in enumerate(numbers(seed)):
            application.write("PLC_PRG.r", str(number))
            application.cycle()
            for i, run in enumerate(runs):
                run.call(number, call * chart_tree.CYCLE_MS)
                wrong = {
                    path: (value, found)
                    for path, value in run.values().items()
                    if (found := application.read(f"PLC_PRG.b{i}.{path}")) != value
                }
                assert not wrong, f"seed {seed}, chart {i}, call {call}: expected, got {wrong}\n{texts[i]}"
            application.clock_ns += chart_tree.CYCLE_MS * 1_000_000
    finally:
        application.close()


@seeds(3, range(1000, 1100))
def test_charts(seed: int, level: int) -> None:
    """LSFC-01..LSFC-24, LSFC-30..LSFC-42, LSFC-50..LSFC-56, LSFC-60..LSFC-69."""
    check(seed, level)
