"""Where the values lie that Get is called for while they are watched (LPRG-33)."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from tappet.codegen.package import DataObject
from tappet.core.lower import Lowered, instances
from tappet.core.watched_properties import holds_watched, monitors_by_call, watched_members
from tappet.lang import types as t

MOST = 100_000
"""Instances of properties in the list of a package; those behind them are not served."""


def watched_values(lowered: Lowered, objects: Mapping[str, DataObject]) -> list[tuple[int, int, int]]:
    """Offset and size of each value, and the offset of the byte that asks for it, by offset."""
    assert lowered.program is not None
    if not monitors_by_call(lowered.program.analysis.pous):
        return []
    found: list[tuple[int, int, int]] = []
    for item in lowered.data:
        base = objects[item.symbol].offset
        instance = getattr(item.owner, "instance", None)
        if isinstance(instance, t.FunctionBlock):
            found += _values(base, instance)
        else:
            for offset, type_ in instances(item.owner):
                found += _values(base + offset, type_)
    return sorted(found)[:MOST]


def _values(at: int, type_: t.Type) -> Iterator[tuple[int, int, int]]:
    if not holds_watched(type_, set()):
        return
    if isinstance(type_, t.Array):
        for number in range(type_.count):
            yield from _values(at + number * type_.element.size, type_.element)
    elif isinstance(type_, t.FunctionBlock | t.Struct):
        if isinstance(type_, t.FunctionBlock):
            for value, asking in watched_members(type_):
                yield at + value.offset, value.type.size, at + asking.offset
        for member in type_.members.values():
            if member.section != "VAR_IN_OUT":
                yield from _values(at + member.offset, member.type)
