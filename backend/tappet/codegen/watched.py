"""Where the values lie that Get is called for while they are watched (LPRG-33)."""

from __future__ import annotations

from collections.abc import Mapping

from tappet.codegen.package import DataObject
from tappet.core.lower import Lowered
from tappet.core.watched_properties import monitors_by_call, watched, watched_members
from tappet.lang import types as t
from tappet.lang.parts import Part, variables_of, walk

MOST = 100_000
"""Instances of properties in the list of a package; those behind them are not served."""


def watched_values(lowered: Lowered, objects: Mapping[str, DataObject]) -> list[tuple[int, int, int]]:
    """Offset and size of each value, and the offset of the byte that asks for it, by offset."""
    assert lowered.program is not None
    if not monitors_by_call(lowered.program.analysis.pous):
        return []
    found: list[tuple[int, int, int]] = []
    holding = watched(lowered.program)

    def visit(part: Part) -> bool:
        if isinstance(part.type, t.FunctionBlock):
            for value, asking in watched_members(part.type):
                found.append((part.offset + value.offset, value.type.size, part.offset + asking.offset))
        return holding.holds(part.type)

    for item in lowered.data:
        for part in variables_of(item.owner, "", objects[item.symbol].offset):
            walk(part, visit)
    return sorted(found)[:MOST]
