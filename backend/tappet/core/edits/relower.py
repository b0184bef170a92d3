"""Lowering again what an edit has changed, and whatever had relied on what was there before.

Bodies are lowered again by the rule of `dependencies`. Data objects and initial values are made again for the
texts that were declared again, task entries and what runs at start and end always. Besides, those bodies are
lowered again that kept variables in registers because of what the new ones touched, or because nobody had
taken an address that is taken now.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable

from tappet.core import ir, passes
from tappet.core.edits.dependencies import Dependencies, objects_of
from tappet.core.edits.edit import Edit
from tappet.core.effects import EffectsTable
from tappet.core.exposure import Exposure
from tappet.core.lower import (
    Lowered,
    complete_bodies,
    data_owners,
    fill_data_object,
    lower_frame,
    lower_pou,
)
from tappet.core.program import Program, data_symbol
from tappet.core.relations import Relations, relate
from tappet.core.templates import initialiser_of
from tappet.lang.analysis.result import Analysis
from tappet.lang.symbols import PouSymbol


class Relowering:
    """One time that a lowered application is brought up to date.

    After LoweringError the lowered application is half done and of no use any more.
    """

    def __init__(self, lowered: Lowered, effects: EffectsTable, dependencies: Dependencies) -> None:
        program = lowered.program
        assert program is not None
        self.lowered = lowered
        self.program: Program = program
        self.effects = effects
        self.dependencies = dependencies
        self.module = program.module
        self.filled: set[str] = set()
        """Symbols of the data objects that were made again."""
        self._declared = False
        self._before = dict(self.module.functions)
        self._exposed = Exposure(self.module).roots
        self._numbers = _numbers(program)
        self._relations = Relations.of(self.module)

    def declarations(self, analysis: Analysis, edit: Edit) -> bool:
        """Bring data and initial values up to date; False when other objects are declared than before."""
        program = self.program
        program.analysis = analysis
        owners = data_owners(analysis)
        if [data_symbol(owner) for owner in owners] != [item.symbol for item in self.lowered.data]:
            return False
        if objects_of(program) != self.dependencies.objects:
            return False
        self._declared = True
        program.claim()
        initialiser_of(program).forget(edit.entities)
        for holding in program.holding.values():
            holding.forget(edit.entities)
        for item, owner in zip(self.lowered.data, owners, strict=True):
            uri = owner.source.uri if owner.source is not None else ""
            if item.owner is not owner or uri in edit.texts or id(owner) in edit.entities:
                item.owner = owner
                fill_data_object(program, item)
                self.filled.add(item.symbol)
        for block, lower in list(program.made_for.values()):
            if id(block) in edit.entities:
                lower()
        lower_frame(program, self.lowered.data, self.lowered.tasks)
        invalidated = self.dependencies.invalidated(edit.entities)
        self.bodies(program.bodies[name] for name in sorted(invalidated & self.module.functions.keys()))
        return True

    def bodies(self, pous: Iterable[PouSymbol]) -> None:
        """Lower the bodies of these POUs again, as far as they are reached."""
        program = self.program
        for pou in pous:
            name = program.functions.get(id(pou))
            if name is None or name not in self.module.functions:
                continue
            if self.module.functions[name] is self._before.get(name):
                self.dependencies.forget(name)
                lower_pou(program, pou)

    def complete(self) -> None:
        """Lower what the new bodies call."""
        complete_bodies(self.program)

    def finish(self, same: Callable[[ir.Function, ir.Function], bool]) -> set[str]:
        """Bring up to date what relied on other code, and run the passes on all that is new.

        Names of what has other code than before, as far as `same` compares them.
        """
        program, module = self.program, self.module
        complete_bodies(program)
        if self._declared:
            relate(program, [(item.symbol, item.owner) for item in self.lowered.data])
        fresh = self._fresh()
        self.effects.forget(fresh | self._before.keys() - module.functions.keys())
        exposed = {name for name, _ in Exposure(module).roots - self._exposed}
        stale = self._stale(exposed | self._relations.changed(module)) - fresh
        for name in sorted(stale):
            self.dependencies.forget(name)
            lower_pou(program, program.bodies[name])
        complete_bodies(program)
        fresh = self._fresh()
        self.effects.forget(fresh)
        passes.run_on(module, self.effects, sorted(fresh))
        if _numbers(program) != self._numbers:
            return set(module.functions)
        before, now = self._before, module.functions
        return {name for name in fresh if name not in before or not same(before[name], now[name])}

    def _fresh(self) -> set[str]:
        """Names of the functions that were lowered again, or for the first time."""
        before = self._before
        return {name for name, function in self.module.functions.items() if before.get(name) is not function}

    def _stale(self, bases: set[str]) -> set[str]:
        """Functions whose register variables, or inputs not copied, depend on what no longer holds."""
        effects = self.effects
        found: set[str] = set()
        for name, function in self.module.functions.items():
            if not function.promoted_bases and not function.assumed:
                continue
            touched = not bases.isdisjoint(function.promoted_bases)
            if touched or any(effects.of(callee) != known for callee, known in function.assumed.items()):
                found.add(name)
        return found & self.program.bodies.keys()


def _numbers(program: Program) -> tuple[object, ...]:
    """What method tables, and the tables behind interface queries, are made from."""
    return len(program.type_ids), len(program.blocks), len(program.dispatched), dict(program.slots)
