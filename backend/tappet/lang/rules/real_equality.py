"""Floating point numbers are not compared with = and <>.

A computed value is almost never exactly the one that is written; zero, which is assigned rather than
computed, and the test for NaN (`x <> x`) are left out.

Source: IEC 61131-3 coding guidelines of PLCopen, CP8 (floating point comparison shall not be equality).

Passes:
    VAR rPos, rTarget : REAL; b : BOOL; END_VAR
    b := ABS(rPos - rTarget) < 0.001;
    b := rPos = 0.0;
Fails:
    VAR rPos, rTarget : REAL; b : BOOL; END_VAR
    b := rPos = rTarget;           (* W1122: almost never exactly equal *)
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from tappet.lang import ast
from tappet.lang.types import Elementary, Kind
from tappet.lang.walk import same

if TYPE_CHECKING:
    from tappet.lang.analysis.context import Body

CODES = ("W1122",)
OPERATORS = ("=", "<>")


def check_expression(b: Body, e: ast.Binary) -> None:
    """Reports = and <> of REAL and LREAL."""
    type_ = e.operand_type
    if not isinstance(type_, Elementary) or type_.kind is not Kind.REAL:
        return
    left, right = e.left, e.right
    if left.is_constant or right.is_constant:
        number = left.constant if left.is_constant else right.constant
        if number == 0 or (left.is_constant and right.is_constant):
            return
    elif same(left, right):
        return
    b.report("W1122", e.span, op=e.op, type=type_)
