"""The constants of LIMIT and MUX fit each other.

Source: spec LOPR-41, LOPR-43.

Passes:
    VAR n, a, b : INT; END_VAR
    n := LIMIT(0, a, 10);
    n := MUX(1, n, b);
Fails:
    VAR n, a : INT; END_VAR
    n := LIMIT(10, a, 0);          (* W1142: always 0 or 10 *)
Fails:
    VAR n, a, b : INT; END_VAR
    n := MUX(5, a, b);             (* W1143: there is no input 5 *)
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from tappet.lang import ast
from tappet.lang.symbols import BuiltinSymbol

if TYPE_CHECKING:
    from tappet.lang.analysis.context import Body

CODES = ("W1142", "W1143")
NODES = (ast.Call,)


def check_expression(b: Body, e: ast.Call) -> None:
    """Reports bounds in the wrong order and a selector beyond the inputs."""
    target = e.target
    if not isinstance(target, BuiltinSymbol) or target.name not in ("LIMIT", "MUX"):
        return
    values = [arg.value.constant if arg.value is not None else None for arg in e.args]
    if target.name == "LIMIT":
        low, high = values[0], values[2]
        if isinstance(low, (int, float)) and isinstance(high, (int, float)) and low > high:
            b.report("W1142", e.span, low=low, high=high)
    elif isinstance(values[0], int) and not 0 <= values[0] < len(values) - 1:
        b.report("W1143", e.args[0].span, value=values[0], count=len(values) - 1)
