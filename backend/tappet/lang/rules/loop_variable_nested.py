"""A loop inside another one has a variable of its own.

Source: coding guidelines of PLCopen, L12; spec LST-28.

Passes:
    VAR i, j, n : INT; END_VAR
    FOR i := 1 TO 3 DO
        FOR j := 1 TO 3 DO n := n + 1; END_FOR
    END_FOR
Fails:
    VAR i, n : INT; END_VAR
    FOR i := 1 TO 3 DO
        FOR i := 1 TO 3 DO n := n + 1; END_FOR   (* W1137: i is the variable of the outer loop *)
    END_FOR
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from tappet.lang import ast

if TYPE_CHECKING:
    from tappet.lang.analysis.context import Body

CODES = ("W1137",)
NODES = (ast.For,)


def check_statement(b: Body, s: ast.For) -> None:
    """Reports a loop variable that a loop around counts with."""
    variable = s.variable
    if b.loop_variables and isinstance(variable, ast.Name) and variable.symbol in b.loop_variables:
        b.report("W1137", variable.span, name=variable.name)
