"""Random online changes of a program that runs: no value is lost that need not be (LDEC-47, 103, 106)."""

from __future__ import annotations

import math
from random import Random
from typing import Any

import pytest
from online_edits import Maker, Program, after_change, leaves, objects, run_cycle

from tappet.codegen.build import BuildOptions, BuildSession, build_application
from tappet.codegen.package import CodePackage
from tappet.iec.task import Task
from tappet.lang.source import Source
from tappet.runtime.local import LocalRuntime


def built(program: Program, session: BuildSession, previous: CodePackage | None) -> CodePackage:
    sources = [
        Source(name, text, name=name if name in program.lists else None)
        for name, text in objects(program).items()
    ]
    tasks = [Task("Main", interval_ns=10_000_000, programs=tuple(program.order))]
    result = build_application(sources, tasks, BuildOptions(level=0), previous, session)
    errors = [f"{d.uri}: {d}" for d in result.diagnostics if d.severity == "error"]
    assert errors == [], "\n".join([*errors, *objects(program).values()])
    assert result.package is not None
    return result.package


def wrong(runtime: LocalRuntime, values: dict[str, Any]) -> list[str]:
    found = []
    for path, expected in values.items():
        actual: Any = runtime.read(path)
        both_nan = isinstance(expected, float) and math.isnan(expected) and math.isnan(actual)
        if actual != expected and not both_nan:
            found.append(f"{path}: expected {expected!r}, got {actual!r}")
    return found


def check(seed: int, changes: int) -> int:
    """How many changes were made, each in the program that the one before has left running."""
    r = Random(seed)
    maker = Maker(r)
    program = maker.program()
    session = BuildSession()
    with LocalRuntime(built(program, session, None)) as runtime:
        values = {path: leaf.initial for path, leaf in leaves(program).items()}
        for number in range(changes):
            for path, leaf in r.sample(sorted(leaves(program).items()), min(25, len(values))):
                values[path] = maker.value(leaf.type)
                runtime.write(path, values[path])
            runtime.run(cycles=2)
            run_cycle(program, values)
            run_cycle(program, values)
            assert wrong(runtime, values) == [], f"seed {seed}, before change {number}"
            edited = maker.edited(program)
            package = built(edited, session, runtime.package)
            runtime.plc.download(package.to_bytes(), "online_change")
            values = after_change(program, values, edited)
            found = wrong(runtime, values)
            texts = [*objects(program).values(), "// -- after the edit --", *objects(edited).values()]
            assert found == [], "\n".join([f"seed {seed}, change {number}", *found, *texts])
            program = edited
            runtime.run(cycles=1)
            run_cycle(program, values)
            assert all(runtime.read(f"{name}.bFollows") for name in program.order), "a pointer is lost"
    return changes


@pytest.mark.parametrize("seed", range(4))
def test_changes(seed: int) -> None:
    check(seed, 25)


@pytest.mark.slow
@pytest.mark.parametrize("block", range(20))
def test_ten_thousand_changes(block: int) -> None:
    assert sum(check(100 + 10 * block + n, 50) for n in range(10)) == 500
