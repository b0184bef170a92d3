"""Visits the parts of core trees: expressions, places, nested statements."""

from __future__ import annotations

from collections.abc import Callable, Iterable

from tappet.core import ir

_EXPRESSIONS: dict[type, tuple[str, ...]] = {
    ir.Unary: ("operand",),
    ir.Binary: ("left", "right"),
    ir.Compare: ("left", "right"),
    ir.Convert: ("operand",),
    ir.Reinterpret: ("operand",),
    ir.Select: ("condition", "then", "otherwise"),
    ir.ShortCircuit: ("left", "right"),
    ir.Store: ("value",),
    ir.CopyBytes: ("target", "source", "count"),
    ir.FillBytes: ("target", "value", "count"),
    ir.Evaluate: ("value",),
    ir.If: ("condition",),
    ir.Switch: ("selector",),
    ir.For: ("start", "stop"),
    ir.While: ("condition",),
    ir.Repeat: ("condition",),
    ir.FaultIf: ("condition",),
    ir.Sequence: ("value",),
    ir.CallPointer: ("pointer",),
}
"""Fields that hold one expression."""
_LISTS: dict[type, str] = {
    ir.Call: "args",
    ir.CallPointer: "args",
    ir.CallVirtual: "args",
    ir.Intrinsic: "args",
    ir.FaultIf: "args",
}
"""Fields that hold a list of expressions."""
_PLACES: dict[type, tuple[str, ...]] = {
    ir.Load: ("place",),
    ir.Address: ("place",),
    ir.Store: ("place",),
    ir.Copy: ("target", "source"),
    ir.Fill: ("target",),
    ir.For: ("counter",),
}
"""Fields that hold a place."""
_BLOCKS: dict[type, tuple[str, ...]] = {
    ir.If: ("then", "otherwise"),
    ir.For: ("body",),
    ir.While: ("body",),
    ir.Repeat: ("body",),
    ir.Sequence: ("statements",),
}
"""Fields that hold statements."""

Node = ir.Expr | ir.Stmt
Visit = Callable[[Node], None]


def visit(roots: Iterable[Node], on_node: Visit) -> None:
    """Call `on_node` for every expression and statement below `roots`, parents first."""
    todo: list[Node] = list(roots)
    while todo:
        node = todo.pop()
        on_node(node)
        children(node, todo)


def children(node: Node, out: list[Node]) -> None:
    """Append the direct parts of a node to `out`."""
    kind = type(node)
    out.extend(getattr(node, name) for name in _EXPRESSIONS.get(kind, ()))
    name = _LISTS.get(kind, "")
    if name:
        out += getattr(node, name)
    for name in _PLACES.get(kind, ()):
        _place_parts(getattr(node, name), out)
    for name in _BLOCKS.get(kind, ()):
        out += getattr(node, name)
    if kind is ir.Switch:
        assert isinstance(node, ir.Switch)
        for case in node.cases:
            out += case.body
        out += node.default
    elif kind is ir.For:
        assert isinstance(node, ir.For)
        if isinstance(node.step, ir.Expr):
            out.append(node.step)
    elif kind is ir.CheckIndex:
        assert isinstance(node, ir.CheckIndex)
        out.append(node.subscript.index)
    elif kind is ir.Promoted:
        assert isinstance(node, ir.Promoted)
        out.append(node.loop)


def _place_parts(place: ir.Place, out: list[Node]) -> None:
    if isinstance(place.base, ir.Indirect):
        out.append(place.base.pointer)
    out.extend(sub.index for sub in place.subscripts)


def places_of(node: Node) -> list[tuple[str, ir.Place]]:
    """The places a node accesses itself, with the field that holds each."""
    return [(name, getattr(node, name)) for name in _PLACES.get(type(node), ())]


def blocks_of(node: Node) -> list[list[ir.Stmt]]:
    """The statement lists directly inside a node."""
    found = [getattr(node, name) for name in _BLOCKS.get(type(node), ())]
    if isinstance(node, ir.Switch):
        found += [case.body for case in node.cases]
        found.append(node.default)
    return found
