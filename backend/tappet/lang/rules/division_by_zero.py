"""The divisor of a division is not the constant zero.

The division ends in an exception of the application as soon as it is reached.

Source: spec LOPR-13, LOPR-14.

Passes:
    VAR a, b : INT; END_VAR
    a := b / 2;
Fails:
    VAR a, b : INT; END_VAR
    a := b / 0;                    (* W1120: ends in an exception *)
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from tappet.lang import ast
from tappet.lang.types import Elementary

if TYPE_CHECKING:
    from tappet.lang.analysis.context import Body

CODES = ("W1120",)
OPERATORS = ("/", "MOD")


def check_expression(b: Body, e: ast.Binary) -> None:
    """Reports `x / 0` and `x MOD 0` of integers; two constants are an error of their own."""
    right = e.right
    if right.is_constant and right.constant == 0 and e.op in ("/", "MOD") and not e.left.is_constant:
        type_ = e.operand_type
        if isinstance(type_, Elementary) and type_.is_integer:
            b.report("W1120", right.span, op=e.op)
