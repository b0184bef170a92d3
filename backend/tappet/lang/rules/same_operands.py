"""The two sides of a comparison or of a logical operation differ.

`x <> x` of floating point numbers is the test for NaN and is left out.

Source: spec LOPR-20..LOPR-55.

Passes:
    VAR a, b : INT; x : BOOL; END_VAR
    x := a > b;
Fails:
    VAR a : INT; x : BOOL; END_VAR
    x := a > a;                    (* W1133: both sides are the same *)
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from tappet.lang import ast
from tappet.lang.types import Elementary, Kind
from tappet.lang.walk import same

if TYPE_CHECKING:
    from tappet.lang.analysis.context import Body

CODES = ("W1133",)
OPERATORS = ("=", "<>", "<", ">", "<=", ">=", "AND", "OR", "XOR", "AND_THEN", "OR_ELSE", "-", "/")
_PLACES = (ast.Name, ast.Member)


def check_expression(b: Body, e: ast.Binary) -> None:
    """Reports operations on one variable twice."""
    left, right = e.left, e.right
    if left.__class__ is not right.__class__ or left.__class__ not in _PLACES:
        return
    if isinstance(left, _PLACES) and isinstance(right, _PLACES):
        if left.symbol is not right.symbol or left.is_constant or not same(left, right):
            return
        if not (isinstance(left.type, Elementary) and left.type.kind is Kind.REAL):
            b.report("W1133", e.span, op=e.op, name=left.name)
