"""A variable is not assigned to itself.

Source: spec LST-20.

Passes:
    VAR a, b : INT; END_VAR
    a := b;
Fails:
    VAR a : INT; END_VAR
    a := a;                        (* W1107: assigned to itself *)
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from tappet.lang import ast
from tappet.lang.symbols import VarSymbol

if TYPE_CHECKING:
    from tappet.lang.analysis.context import Body

CODES = ("W1107",)
VALUES = (ast.Name,)


def check_statement(b: Body, s: ast.Assign) -> None:
    """Reports `x := x`."""
    target, value = s.target, s.value
    if (
        target.__class__ is ast.Name
        and value.__class__ is ast.Name
        and isinstance(target, ast.Name)
        and isinstance(value, ast.Name)
        and target.symbol is value.symbol
        and isinstance(target.symbol, VarSymbol)
    ):
        b.report("W1107", s.span, name=target.name)
