"""The result of an operator is used: an operator does nothing else.

Source: spec LOPR-01.

Passes:
    VAR a : INT; END_VAR
    a := ABS(a);
Fails:
    VAR a : INT; END_VAR
    ABS(a);                        (* W1138: the result is not used *)
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from tappet.lang import ast
from tappet.lang.symbols import BuiltinSymbol

if TYPE_CHECKING:
    from tappet.lang.analysis.context import Body

CODES = ("W1138",)
NODES = (ast.CallStmt,)


def check_statement(b: Body, s: ast.CallStmt) -> None:
    """Reports operators and conversions that stand alone."""
    target = s.call.target
    if (
        isinstance(target, BuiltinSymbol)
        and target.return_type is not None
        and not target.name.startswith("_")
    ):
        b.report("W1138", s.call.span, name=getattr(s.call.callee, "name", target.name))
    elif s.call.expansion is not None:
        b.report("W1138", s.call.span, name=getattr(s.call.callee, "name", ""))
