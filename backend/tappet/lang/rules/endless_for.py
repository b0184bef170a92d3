"""The bound of a FOR loop is not the limit of the type of its variable.

The variable is compared after the step has been added; at the limit of its type it wraps and the loop never
ends.

Source: spec LST-29.

Passes:
    VAR i : INT; n : DINT; END_VAR
    FOR i := 0 TO 127 DO n := n + 1; END_FOR
Fails:
    VAR i : SINT; n : DINT; END_VAR
    FOR i := 0 TO 127 DO           (* W1106: 127 is the limit of SINT *)
        n := n + 1;
    END_FOR
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from tappet.lang import ast
from tappet.lang.types import Elementary, Kind, value_type

if TYPE_CHECKING:
    from tappet.lang.analysis.context import Body

CODES = ("W1106",)
NODES = (ast.For,)


def check_statement(b: Body, s: ast.For) -> None:
    """Reports a constant bound that leaves no room for one more step."""
    type_ = s.variable.type
    bound = s.stop.constant
    if type_ is None or not isinstance(bound, int):
        return
    base = value_type(type_)
    if not isinstance(base, Elementary) or not base.is_integer:
        return
    step = 1 if s.step is None else s.step.constant
    if not isinstance(step, int) or step == 0:
        return
    signed = base.kind is Kind.SIGNED
    bits = 8 * base.size
    low, high = (-(1 << (bits - 1)), (1 << (bits - 1)) - 1) if signed else (0, (1 << bits) - 1)
    if (step == 1 and bound == high) or (step == -1 and bound == low):
        b.report("W1106", s.stop.span, bound=bound, type=type_)
