"""Interval analysis: bounds of integer expressions, as far as their types and constants give them."""

from __future__ import annotations

from collections.abc import Mapping

from tappet.lang import ast
from tappet.lang.symbols import BuiltinSymbol
from tappet.lang.types import Elementary, Kind, Subrange, value_type

Interval = tuple[int, int]
"""The lowest and the highest value."""

_COMPUTED = frozenset({"+", "-", "*", "/", "MOD", "AND"})


def interval(e: ast.Expr, known: Mapping[int, Interval], types: bool = False) -> Interval | None:
    """The values that an expression can have, or None when no bounds are known.

    `known` gives the values of variables by id() of their symbol; `types` lets a variable have all values of
    its type. MOD by a constant counts as not negative, as almost everywhere it is used.
    """
    try:
        return _interval(e, known, types)
    except RecursionError:
        return None


def of_type(type_: object) -> Interval | None:
    """All values of an integer type."""
    if isinstance(type_, Subrange):
        return type_.low, type_.high
    if not isinstance(type_, Elementary) or not type_.is_integer:
        return None
    bits = 8 * type_.size
    return (-(1 << (bits - 1)), (1 << (bits - 1)) - 1) if type_.kind is Kind.SIGNED else (0, (1 << bits) - 1)


def _interval(e: ast.Expr, known: Mapping[int, Interval], types: bool) -> Interval | None:
    if e.is_constant:
        number = e.constant
        return (number, number) if isinstance(number, int) and not isinstance(number, bool) else None
    if isinstance(e, ast.Binary):
        return _computed(e, known, types) if e.op in _COMPUTED else None
    if isinstance(e, ast.Unary):
        found = _interval(e.operand, known, types)
        if found is None or e.op == "NOT":
            return None
        return (-found[1], -found[0]) if e.op == "-" else found
    if isinstance(e, ast.Call):
        return _called(e, known, types)
    if isinstance(e, ast.Name) and id(e.symbol) in known:
        return known[id(e.symbol)]
    if isinstance(e.type, Subrange) or types:
        return of_type(e.type)
    return None


def _computed(e: ast.Binary, known: Mapping[int, Interval], types: bool) -> Interval | None:
    left, right = _interval(e.left, known, types), _interval(e.right, known, types)
    if e.op == "MOD" and right is not None and right[0] > 0:
        return 0, right[1] - 1
    if e.op == "AND":
        masks = [found[1] for found in (left, right) if found is not None and found[0] >= 0]
        return (0, min(masks)) if masks else None
    if left is None or right is None:
        return None
    if e.op == "+":
        return left[0] + right[0], left[1] + right[1]
    if e.op == "-":
        return left[0] - right[1], left[1] - right[0]
    if e.op == "*":
        corners = [x * y for x in left for y in right]
        return min(corners), max(corners)
    if e.op == "/" and right[0] > 0:
        corners = [_quotient(x, y) for x in left for y in right]
        return min(corners), max(corners)
    return None


def _quotient(x: int, y: int) -> int:
    """Cut towards zero, as in ST; `y` is positive."""
    return x // y if x >= 0 else -(-x // y)


def _called(e: ast.Call, known: Mapping[int, Interval], types: bool) -> Interval | None:
    target = e.target
    if not isinstance(target, BuiltinSymbol):
        return None
    if e.expansion is not None:
        return _interval(e.expansion, known, types)
    values = [_interval(a.value, known, types) if a.value is not None else None for a in e.args]
    if target.name == "LIMIT" and len(values) == 3 and values[0] is not None and values[2] is not None:
        return values[0][0], max(values[0][0], values[2][1])
    if target.name == "CONVERT" and values and values[0] is not None and target.return_type is not None:
        whole = of_type(value_type(target.return_type))
        fits = whole is not None and whole[0] <= values[0][0] and values[0][1] <= whole[1]
        return values[0] if fits else None
    return None
