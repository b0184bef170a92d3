"""A quotient that is needed as a floating point number is computed as one.

Integers are divided without the fraction, and the result is converted afterwards: 7 / 2 gives 3.0.

Source: spec LOPR-13.

Passes:
    VAR n : INT; r : REAL; END_VAR
    r := INT_TO_REAL(n) / 2.0;
Fails:
    VAR n : INT; r : REAL; END_VAR
    r := n / 2;                    (* W1009: the fraction is lost *)
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from tappet.lang import ast
from tappet.lang.types import Elementary, Kind

if TYPE_CHECKING:
    from tappet.lang.analysis.context import Body

CODES = ("W1009",)
VALUES = (ast.Binary,)


def check_statement(b: Body, s: ast.Assign) -> None:
    """Reports a division of integers that is assigned to REAL or LREAL."""
    value = s.value
    if not isinstance(value, ast.Binary) or value.op != "/" or value.is_constant:
        return
    target, own = s.target.type, value.type
    if (
        isinstance(target, Elementary)
        and target.kind is Kind.REAL
        and isinstance(own, Elementary)
        and own.is_integer
    ):
        b.report("W1009", value.span, source=own, target=target)
