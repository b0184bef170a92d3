"""Splits large applications into modules that are compiled, and cached, one by one.

A module holds bodies that belong together. Small bodies of other modules that it calls come along as copies
for inlining only (`available_externally`), so that splitting costs no speed where it matters.
"""

from __future__ import annotations

from dataclasses import dataclass, field

from tappet.codegen.emit_calls import direct_targets
from tappet.core import ir
from tappet.core.walk import visit

WHOLE = 3_000
"""Up to this weight an application is one module, and everything in it can be inlined."""
PART = 200
"""Weight of the modules of larger applications: what is compiled again after an edit."""
SMALL = 60
"""Weight of bodies that are copied into the modules that call them; LLVM inlines nothing larger."""
COPIES = 600
"""Weight of all copies in one module; the smallest come first."""


@dataclass(slots=True)
class Part:
    """One module: its functions, and the foreign ones it may inline."""

    names: list[str]
    copies: list[str] = field(default_factory=list)
    used: set[str] = field(default_factory=set)
    """Symbols of data and constants that its text refers to."""


def partition(module: ir.Module) -> list[Part]:
    """Modules in stable order: an edit of one body changes only the modules that hold a copy of it."""
    functions = module.functions
    if sum(f.weight for f in functions.values()) <= WHOLE:
        return [Part(list(functions))]
    parts: list[Part] = []
    weight = PART
    for name in sorted(functions):
        owner = name.partition(".")[0]
        family = parts and parts[-1].names[-1].partition(".")[0] == owner
        full = PART if not family else 2 * PART
        if weight >= full or (weight and not family and weight + functions[name].weight > 2 * PART):
            parts.append(Part([]))
            weight = 0
        parts[-1].names.append(name)
        weight += functions[name].weight
    for part in parts:
        part.copies = copies_for(module, part.names)
    return parts


def copies_for(module: ir.Module, names: list[str]) -> list[str]:
    """Small functions of other modules that these call, and what those call, as many as fit."""
    own = set(names)
    found: dict[str, None] = {}
    todo = list(names)
    while todo:
        for callee in _callees(module, module.functions[todo.pop()]):
            function = module.functions.get(callee)
            if function is None or callee in own or callee in found:
                continue
            if function.weight <= SMALL and not function.returns_twice and not function.cold:
                found[callee] = None
                todo.append(callee)
    chosen, room = [], COPIES
    for name in sorted(found, key=lambda name: (module.functions[name].weight, name)):
        room -= module.functions[name].weight
        if room < 0:
            break
        chosen.append(name)
    return sorted(chosen)


def _callees(module: ir.Module, function: ir.Function) -> list[str]:
    """Functions that one calls; those that a virtual call reaches when it is one of few."""
    found: set[str] = set()

    def note(node: ir.Expr | ir.Stmt) -> None:
        if isinstance(node, ir.Call):
            found.add(node.function)
        elif isinstance(node, ir.CallVirtual):
            found.add(node.method.key)

    if function.callees is None:
        visit(function.body, note)
        function.callees = found
    names: list[str] = []
    for name in function.callees:
        virtual = module.virtual.get(name)
        names += [name] if virtual is None else direct_targets(virtual)
    return names


def refreshed(
    module: ir.Module, parts: list[Part], fresh: set[str], resized: set[str]
) -> tuple[list[Part], list[int]]:
    """Modules after an edit, and the numbers of those to compile: all that hold a function of `fresh`, be it
    only for inlining, or use data objects of `resized`. New functions get a module of their own."""
    functions = module.functions
    placed = {name for part in parts for name in part.names}
    result: list[Part] = []
    dirty: list[int] = []
    for number, part in enumerate(parts):
        kept = all(name in functions for name in part.names)
        touched = not (fresh.isdisjoint(part.names) and fresh.isdisjoint(part.copies))
        if kept and not touched and resized.isdisjoint(part.used):
            result.append(part)
            continue
        names = [name for name in part.names if name in functions]
        result.append(Part(names))
        dirty.append(number)
    added = sorted(functions.keys() - placed)
    if added and len(result) == 1:
        result[0].names += added
        dirty = [0]
    elif added:
        dirty.append(len(result))
        result.append(Part(added))
    if len(result) > 1:
        for number in dirty:
            result[number].copies = copies_for(module, result[number].names)
    return result, dirty
