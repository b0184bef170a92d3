"""Random IL bodies, several in one program: the compiler and the machine with one accumulator agree."""

from __future__ import annotations

from random import Random

import il_programs
from arithmetic import same
from il_rows import COMMON, Counter, Machine
from linked_application import LoadedApplication
from seeds import seeds

from tappet.codegen.build import BuildOptions, BuildSession, build_application
from tappet.lang.source import Source

SESSION = BuildSession()
COUNT = 20
"""Bodies of one program."""


def check(seed: int, level: int, count: int = COUNT) -> None:
    r = Random(seed)
    texts, machines, bodies = [], [], []
    g = 0
    for number in range(count):
        maker = il_programs.BodyMaker(r)
        bodies.append(maker.make())
        texts.append(il_programs.text(bodies[-1], maker, f"FB{number}"))
        machines.append(Machine(maker.types, {**maker.initial, "g": 0}, {n: Counter() for n in ("i0", "i1")}))
    instances = "".join(f"b{n} : FB{n}; " for n in range(count))
    calls = "\n".join(f"b{n}(); v{n} := g;" for n in range(count))
    seen = "".join(f"v{n} : DINT; " for n in range(count))
    main = f"{COMMON}PROGRAM PLC_PRG\nVAR {instances}{seen}END_VAR\n{calls}\nEND_PROGRAM"
    sources = [Source(f"text{number}", text) for number, text in enumerate([main, *texts])]
    result = build_application(sources, session=SESSION, options=BuildOptions(level=level))
    errors = [f"{d}\n{texts[int(d.uri[4:]) - 1]}" for d in result.diagnostics if d.severity == "error"]
    assert errors == [], f"seed {seed}\n{errors[0]}"
    assert result.package is not None
    application = LoadedApplication(result.package)
    try:
        application.start()
        application.cycle()
        for number, (machine, body) in enumerate(zip(machines, bodies, strict=True)):
            machine.memory["g"] = g
            machine.run(body)
            g = machine.memory.pop("g")
            wanted = {f"b{number}.{n}": value for n, value in machine.memory.items()}
            wanted |= {f"b{number}.{n}.sum": c.sum for n, c in machine.instances.items()}
            wanted[f"v{number}"] = g
            found = {path: application.read(f"PLC_PRG.{path}") for path in wanted}
            wrong = {p: (v, found[p]) for p, v in wanted.items() if not same(v, found[p])}
            assert not wrong, f"seed {seed}: expected, got {wrong}\n{texts[number]}"
    finally:
        application.close()


@seeds(4, range(1000, 1200))
def test_bodies(seed: int, level: int) -> None:
    """IL-10..IL-17, IL-20..IL-52."""
    check(seed, level)
