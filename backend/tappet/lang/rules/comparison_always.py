"""A comparison with a constant can have both results.

An unsigned value is never below zero, a BYTE never above 255.

Source: spec LOPR-50..LOPR-55.

Passes:
    VAR u : UINT; b : BOOL; END_VAR
    b := u > 0;
Fails:
    VAR u : UINT; b : BOOL; END_VAR
    b := u >= 0;                   (* W1113: always TRUE *)
Fails:
    VAR y : BYTE; b : BOOL; END_VAR
    b := y = 300;                  (* W1113: always FALSE *)
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from tappet.lang import ast
from tappet.lang.types import Elementary, Kind, value_type

if TYPE_CHECKING:
    from tappet.lang.analysis.context import Body

CODES = ("W1113",)
_MIRRORED = {"<": ">", ">": "<", "<=": ">=", ">=": "<=", "=": "=", "<>": "<>"}
OPERATORS = tuple(_MIRRORED)


def check_expression(b: Body, e: ast.Binary) -> None:
    """Reports a comparison whose constant lies outside the range of the other operand."""
    op = e.op
    if e.left.is_constant == e.right.is_constant:
        return
    variable, constant = (e.left, e.right) if e.right.is_constant else (e.right, e.left)
    if e.left.is_constant:
        op = _MIRRORED[op]
    number = constant.constant
    if variable.type is None or not isinstance(number, int) or isinstance(number, bool):
        return
    base = value_type(variable.type)
    if not isinstance(base, Elementary) or not base.is_integer or not isinstance(variable, _PLACES):
        return
    bits = 8 * base.size
    signed = base.kind is Kind.SIGNED
    low, high = (-(1 << (bits - 1)), (1 << (bits - 1)) - 1) if signed else (0, (1 << bits) - 1)
    result = _result(op, number, low, high)
    if result is not None:
        b.report("W1113", e.span, value=number, result="TRUE" if result else "FALSE", type=base)


_PLACES = (ast.Name, ast.Member, ast.Index, ast.Deref)


def _result(op: str, number: int, low: int, high: int) -> bool | None:
    if op == "<":
        return False if number <= low else True if number > high else None
    if op == "<=":
        return False if number < low else True if number >= high else None
    if op == ">":
        return False if number >= high else True if number < low else None
    if op == ">=":
        return False if number > high else True if number <= low else None
    if low <= number <= high:
        return None
    return op == "<>"
