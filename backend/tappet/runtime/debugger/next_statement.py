"""Where a halted task may be sent: another statement of the body that it stands in."""

from __future__ import annotations

from tappet.runtime.debugger import frames
from tappet.runtime.debugger.places import line_of
from tappet.runtime.debugger.shapes import Spot
from tappet.runtime.debugger.variant import Variant
from tappet.runtime.errors import DebugError


def next_statement(variant: Variant, task: int, spot: Spot) -> int:
    """The statement of the halted function that a place names. Raises DebugError saying why there is none."""
    here = frames.stack_of_halted(variant, task).activations[0]
    line = line_of(variant.application.package.source_maps, spot)
    if isinstance(line, str):
        raise DebugError(line)
    first = variant.firsts[variant.functions.index(here.function)]
    inside = range(first, first + len(here.function.sites))
    found = [number - first for number in variant.sites_at(*line) if number in inside]
    if not found:
        raise DebugError(f"the place is not in '{here.function.name}', where the task is halted")
    if here.function.fixed_order == "try":
        raise DebugError("the next statement cannot be set in a body that contains __TRY")
    if here.function.fixed_order:
        raise DebugError("the body has too many statements to set the next one")
    loops = here.function.sites[found[0]].loops
    if here.site.loops[: len(loops)] != loops:
        raise DebugError("the next statement cannot be set inside a loop that the task is not in")
    return found[0]
