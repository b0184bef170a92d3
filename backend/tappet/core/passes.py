"""The passes over a core module, in order."""

from __future__ import annotations

from tappet.core import ir
from tappet.core.effects import effects_of
from tappet.core.loops import Promotion, mark_fixed_counters, mark_pointer_walks
from tappet.core.ranges import Ranges


def run(module: ir.Module) -> None:
    """Keep loop variables in locals, then drop the checks that can never fire."""
    promotion = Promotion(module, effects_of(module))
    for function in module.functions.values():
        promotion.run(function)
        mark_fixed_counters(function)
        mark_pointer_walks(function)
        Ranges().run(function)
