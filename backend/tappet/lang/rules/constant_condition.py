"""A condition depends on something.

A literal TRUE or FALSE, or a named constant, is taken as intended (a switch, an endless loop).

Source: spec LST-25.

Passes:
    VAR a : INT; END_VAR
    IF a > 3 THEN a := 0; END_IF
Passes:
    VAR CONSTANT bTest : BOOL := FALSE; END_VAR
    VAR a : INT; END_VAR
    IF bTest THEN a := 0; END_IF
Fails:
    VAR CONSTANT nMax : INT := 10; END_VAR
    VAR a : INT; END_VAR
    IF nMax > 3 THEN a := 0; END_IF   (* W1105: always TRUE *)
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from tappet.lang import ast

if TYPE_CHECKING:
    from tappet.lang.analysis.context import Body

CODES = ("W1105",)
NODES = (ast.If,)


def check_statement(b: Body, s: ast.If) -> None:
    """Reports conditions that are computed and constant."""
    for condition, _ in s.branches:
        if condition.is_constant and isinstance(condition, (ast.Binary, ast.Unary)):
            b.report("W1105", condition.span, value="TRUE" if condition.constant else "FALSE")
