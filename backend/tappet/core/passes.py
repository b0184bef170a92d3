"""The passes over a core module, in order."""

from __future__ import annotations

from collections.abc import Iterable

from tappet.core import ir
from tappet.core.effects import EffectsTable
from tappet.core.input_copies import drop_input_copies
from tappet.core.internal_error import function_at, working_on
from tappet.core.loops import Promotion, mark_fixed_counters, mark_pointer_walks
from tappet.core.ranges import Ranges


def run(module: ir.Module) -> EffectsTable:
    """Drop copies of inputs, keep loop variables in locals, then drop the checks that can never fire."""
    effects = EffectsTable(module)
    run_on(module, effects, module.functions)
    return effects


def run_on(module: ir.Module, effects: EffectsTable, names: Iterable[str]) -> None:
    """The passes over some functions of a module."""
    promotion = Promotion(module, effects)
    for name in names:
        function = module.functions[name]
        with working_on("optimisation", lambda: function_at(function)):  # noqa: B023
            _run_on_function(module, effects, promotion, function)


def _run_on_function(
    module: ir.Module, effects: EffectsTable, promotion: Promotion, function: ir.Function
) -> None:
    if function.returns_twice:
        # A fault leaves any statement: what holds behind it is not known.
        return
    if function.input_copies:
        drop_input_copies(module, effects, function)
    if function.loops:
        promotion.run(function)
        mark_fixed_counters(function)
        mark_pointer_walks(function)
    if function.loops or function.subscripted:
        Ranges().run(function)
