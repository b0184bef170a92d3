"""A product that needs 64 bits is computed in 64 bits.

DINT * DINT is computed in 32 bits and overflows before the result is widened.

Source: spec LOPR-03.

Passes:
    VAR d : DINT; l : LINT; END_VAR
    l := DINT_TO_LINT(d) * d;
Fails:
    VAR d : DINT; l : LINT; END_VAR
    l := d * d;                    (* W1010: computed in 32 bits *)
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from tappet.lang import ast
from tappet.lang.types import Elementary

if TYPE_CHECKING:
    from tappet.lang.analysis.context import Body

CODES = ("W1010",)
VALUES = (ast.Binary,)
_WIDE = 8


def check_statement(b: Body, s: ast.Assign) -> None:
    """Reports a product of 32 bit factors that is assigned to a 64 bit integer."""
    value = s.value
    if not isinstance(value, ast.Binary) or value.op != "*" or value.is_constant:
        return
    target, computed = s.target.type, value.operand_type
    if not isinstance(target, Elementary) or not target.is_integer or target.size < _WIDE:
        return
    if isinstance(computed, Elementary) and computed.is_integer and computed.size < _WIDE:
        left, right = value.left.type, value.right.type
        narrow = isinstance(left, Elementary) and isinstance(right, Elementary)
        if narrow and left.size + right.size > computed.size:  # type: ignore[union-attr]
            b.report("W1010", value.span, source=computed, target=target)
