"""Numbers of the methods that are called virtually, and a table of methods per block type."""

from __future__ import annotations

from collections import defaultdict

from tappet.core import ir
from tappet.core.program import Program
from tappet.core.virtual_calls import fits
from tappet.lang.symbols import PouSymbol


def number_methods(program: Program) -> None:
    """Slots for the names that are called virtually, and a table per block type with instances.

    Two names share a slot when no block type has both.
    """
    program.module.dispatch.clear()
    slots: dict[str, int] = {}
    taken: defaultdict[str, set[int]] = defaultdict(set)
    users: dict[str, list[str]] = {}
    for block_name, block in program.blocks.items():
        symbol = block.pou.symbol if block.pou is not None else None
        if isinstance(symbol, PouSymbol):
            for name in symbol.vtable:
                if name in program.dispatched:
                    users.setdefault(name, []).append(block_name)
    for name in program.dispatched:
        having = users.get(name, [])
        slot = 0
        while any(slot in taken[owner] for owner in having):
            slot += 1
        slots[name] = slot
        for owner in having:
            taken[owner].add(slot)
    program.slots = slots
    for block_name, block in program.blocks.items():
        symbol = block.pou.symbol if block.pou is not None else None
        methods = {}
        if isinstance(symbol, PouSymbol):
            for name, method in symbol.vtable.items():
                if name in slots:
                    methods[slots[name]] = program.functions[id(method)]
        program.module.dispatch.append(ir.DispatchTable(program.type_ids[block_name], methods))
    _fill_virtual(program)
    _fill_queries(program)


def _fill_virtual(program: Program) -> None:
    """What every virtual call reaches: the bodies of the blocks with instances that fit its static type."""
    tables = {table.type_id: table.methods for table in program.module.dispatch}
    for method, name, static in program.virtual.values():
        method.slot = slot = program.slots[name]
        numbers = sorted(program.type_ids[n] for n, block in program.blocks.items() if fits(block, static))
        method.targets = {number: tables[number][slot] for number in numbers if slot in tables[number]}


def _fill_queries(program: Program) -> None:
    highest = max(program.type_ids.values(), default=0)
    for symbol, wanted in program.queried.items():
        table = bytearray(highest + 1)
        for name, block in program.blocks.items():
            if fits(block, wanted):
                table[program.type_ids[name]] = 1
        program.module.constants[symbol].data = bytes(table)
