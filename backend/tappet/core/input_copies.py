"""Strings and aggregates passed by value are read where the caller has them, if nothing changes them there.

Lowering copies those that a body takes the address of, or that anything it writes to might overlap; once all
bodies are known, most of these copies turn out to be needless: `LEN`, `FIND` and `MID` only read.
"""

from __future__ import annotations

from tappet.core import ir
from tappet.core.effects import EffectsTable
from tappet.core.written_memory import written_memory


def drop_input_copies(module: ir.Module, effects: EffectsTable, function: ir.Function) -> None:
    """Use the caller's memory for the inputs that keep their value while `function` runs."""
    copies = function.input_copies
    function.input_copies = []
    done = {id(copy) for copy, _, _ in copies}
    function.body = [statement for statement in function.body if id(statement) not in done]
    written = written_memory(module, function)
    changing = written.foreign or any(effects.of(name).stores for name in written.calls)
    kept: list[ir.Stmt] = []
    for copy, local, number in copies:
        if changing or local in written.locals:
            kept.append(copy)
        else:
            function.aliases[local] = number
            function.assumed |= {name: effects.of(name) for name in written.calls}
    function.body = [*kept, *function.body]
