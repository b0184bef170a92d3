"""Lowering again what an edit of bodies changed, and whatever had relied on the old bodies.

Data, types and names stay. Besides the edited bodies, those are lowered again that kept variables in
registers because of what the edited ones touched, or because nobody had taken an address that is taken now.
"""

from __future__ import annotations

from collections.abc import Iterable

from tappet.core import passes
from tappet.core.effects import EffectsTable
from tappet.core.exposure import Exposure
from tappet.core.lower import Lowered, complete_bodies, lower_pou
from tappet.core.program import Program
from tappet.lang.symbols import PouSymbol


def relower(lowered: Lowered, effects: EffectsTable, changed: Iterable[PouSymbol]) -> set[str]:
    """Lower `changed` again; names of all functions whose code is new.

    Raises LoweringError; `lowered` is half done then and of no use any more.
    """
    program = lowered.program
    assert program is not None
    module = program.module
    exposed, names, numbers = Exposure(module), set(module.functions), _numbers(program)
    fresh: set[str] = set()
    for pou in changed:
        name = program.functions.get(id(pou))
        if name is not None and name in module.functions:
            lower_pou(program, pou)
            fresh.add(name)
    complete_bodies(program)
    fresh |= set(module.functions) - names
    effects.forget(fresh)
    stale = _stale(program, effects, Exposure(module).roots - exposed.roots) - fresh
    for name in sorted(stale):
        lower_pou(program, program.bodies[name])
    complete_bodies(program)
    fresh |= stale
    effects.forget(fresh)
    passes.run_on(module, effects, sorted(fresh))
    return fresh if _numbers(program) == numbers else set(module.functions)


def _numbers(program: Program) -> tuple[object, ...]:
    """What method tables, and the tables behind interface queries, are made from."""
    return len(program.type_ids), len(program.blocks), len(program.dispatched), dict(program.slots)


def _stale(program: Program, effects: EffectsTable, exposed: set[tuple[str, int]]) -> set[str]:
    """Functions whose register variables, or inputs not copied, rest on what no longer holds."""
    bases = {name for name, _ in exposed}
    found: set[str] = set()
    for name, function in program.module.functions.items():
        if not function.promoted_bases and not function.assumed:
            continue
        touched = not bases.isdisjoint(function.promoted_bases)
        if touched or any(effects.of(callee) != known for callee, known in function.assumed.items()):
            found.add(name)
    return found & program.bodies.keys()
