"""Where instances of function blocks lie, and which block types share bases: what alias questions need."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from tappet.core import ir
from tappet.core.program import Program
from tappet.lang import types as t
from tappet.lang.parts import composed, innermost
from tappet.lang.symbols import GvlSymbol, PouSymbol, VarSymbol

Nested = dict[tuple[str, int], frozenset[str]]


@dataclass(frozen=True, slots=True)
class Relations:
    """What was known of a module at some time."""

    nested: Nested
    containers: dict[str, set[str]]

    @classmethod
    def of(cls, module: ir.Module) -> Relations:
        """What is known now; `relate` makes it again."""
        return cls(module.nested, module.containers)

    def changed(self, module: ir.Module) -> set[str]:
        """Data objects and block types of which something else is known in `module` now."""
        found = set()
        if self.nested != module.nested:
            found |= {name for (name, _), _ in self.nested.items() ^ module.nested.items()}
        for name in self.containers.keys() | module.containers.keys():
            if self.containers.get(name) != module.containers.get(name):
                found.add(name)
        return found


def relate(program: Program, data: Sequence[tuple[str, GvlSymbol | PouSymbol]]) -> None:
    """Which block types share bases, and which data objects hold instances of which."""
    module = program.module
    module.nested, module.containers, module.families = {}, {}, {}
    groups: dict[str, set[str]] = {}
    for pou in program.analysis.pous:
        if pou.kind == "FUNCTION_BLOCK" and pou.instance is not None:
            root = pou
            while root.base is not None:
                root = root.base
            if root.instance is not None:
                name = program.block_name(root.instance)
                groups.setdefault(name, {name}).add(program.block_name(pou.instance))
    for group in groups.values():
        for name in group:
            module.families[name] = frozenset(group)
    nested: dict[int, set[str]] = {}
    for symbol, owner in data:
        holder = owner.instance if isinstance(owner, PouSymbol) else owner
        members = holder.members.values() if holder is not None else ()
        for name in _nested_blocks(program, symbol, members, nested):
            module.containers.setdefault(name, set()).add(symbol)
    for pou in program.analysis.pous:
        if pou.kind == "FUNCTION_BLOCK" and pou.instance is not None:
            name = program.block_name(pou.instance)
            _nested_blocks(program, name, pou.instance.members.values(), nested)


def _nested_blocks(
    program: Program, owner: str, members: Iterable[VarSymbol | t.Member], nested: dict[int, set[str]]
) -> set[str]:
    """Note the block types inside each member; all of them together."""
    every: set[str] = set()
    for member in members:
        found = _blocks_in(program, member.type, nested) if member.section != "VAR_IN_OUT" else None
        if found:
            key = (owner, member.offset)
            program.module.nested[key] = program.module.nested.get(key, frozenset()) | found
            every |= found
    return every


def _blocks_in(program: Program, type_: t.Type | None, nested: dict[int, set[str]]) -> set[str]:
    """Names of the block types that have instances inside a type."""
    if type_ is None:
        return set()
    type_ = innermost(type_)
    found = nested.get(id(type_))
    if found is None:
        found = nested[id(type_)] = set()
        if isinstance(type_, t.FunctionBlock) and not type_.program:
            found.add(program.block_name(type_))
        for inner in composed(type_):
            found |= _blocks_in(program, inner, nested)
    return found
