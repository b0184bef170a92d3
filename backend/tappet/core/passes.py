"""The passes over a core module, in order."""

from __future__ import annotations

from tappet.core import ir
from tappet.core.effects import EffectsTable
from tappet.core.loops import Promotion, mark_fixed_counters, mark_pointer_walks
from tappet.core.ranges import Ranges


def run(module: ir.Module) -> None:
    """Keep loop variables in locals, then drop the checks that can never fire."""
    promotion = Promotion(module, EffectsTable(module))
    for function in module.functions.values():
        if function.loops:
            promotion.run(function)
            mark_fixed_counters(function)
            mark_pointer_walks(function)
        if function.loops or function.subscripted:
            Ranges().run(function)
