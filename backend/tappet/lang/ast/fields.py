"""What the fields of nodes hold: the source, what analysis fills in, or a node that stands elsewhere.

Declared with the field, so that comparing, copying and walking trees need no lists of names.
"""

from __future__ import annotations

from dataclasses import fields
from typing import Any, Final

_ROLE, _TREE = "role", "tree"
RESOLVED: Final = {_ROLE: "resolved"}
"""Metadata of a field that analysis fills in: a symbol, a type, a value."""
RESOLVED_TREE: Final = {_ROLE: "resolved", _TREE: "yes"}
"""Metadata of a field that analysis fills in with nodes, which are lowered like those of the source."""
ELSEWHERE: Final = {_ROLE: "elsewhere"}
"""Metadata of a field that refers to a node with a place of its own in the tree: a parent, an argument."""
_PLACES = frozenset({"Span", "list[Span]"})
_SCALARS = frozenset({"str", "str | None", "int", "int | None", "bool", "Constant", "set[str]", "list[str]"})


_SOURCE: dict[type[Any], tuple[str, ...]] = {}
_TREES: dict[type[Any], tuple[str, ...]] = {}
_FILLED: dict[type[Any], frozenset[str]] = {}


def resolved_fields(kind: type[Any]) -> frozenset[str]:
    """The fields of a class of nodes that analysis fills in."""
    found = _FILLED.get(kind)
    if found is None:
        names = (item.name for item in fields(kind) if item.metadata.get(_ROLE) == "resolved")
        found = _FILLED[kind] = frozenset(names)
    return found


def source_fields(kind: type[Any]) -> tuple[str, ...]:
    """The fields of a class of nodes that say what the source says; places are not among them."""
    found = _SOURCE.get(kind)
    if found is None:
        own = (item for item in fields(kind) if item.metadata.get(_ROLE) is None)
        found = _SOURCE[kind] = tuple(item.name for item in own if item.type not in _PLACES)
    return found


def tree_fields(kind: type[Any]) -> tuple[str, ...]:
    """The fields of a class that can hold the nodes below one, those that analysis fills in included."""
    found = _TREES.get(kind)
    if found is None:
        own = (item for item in fields(kind) if item.metadata.get(_ROLE) is None or _TREE in item.metadata)
        found = tuple(item.name for item in own if item.type not in _PLACES and item.type not in _SCALARS)
        _TREES[kind] = found
    return found
