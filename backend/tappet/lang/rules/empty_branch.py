"""A branch or a loop contains a statement; a lone `;` says that it is meant to be empty.

Source: coding guidelines of PLCopen, L11 (no empty statements); spec LST-25.

Passes:
    VAR a : INT; END_VAR
    IF a > 3 THEN
        ; // nothing to do above 3
    ELSE
        a := 3;
    END_IF
Fails:
    VAR a : INT; END_VAR
    IF a > 3 THEN                  (* W1123: empty *)
    END_IF
Fails:
    VAR i : INT; END_VAR
    FOR i := 1 TO 10 DO            (* W1123: empty *)
    END_FOR
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from tappet.lang import ast

if TYPE_CHECKING:
    from tappet.lang.analysis.context import Body

CODES = ("W1123",)
NODES = (ast.If, ast.For, ast.While)


def check_statement(b: Body, s: ast.If | ast.For | ast.While) -> None:
    """Reports bodies without any statement."""
    if isinstance(s, ast.If):
        for condition, body in s.branches:
            if not body:
                first = condition is s.branches[0][0]
                b.report("W1123", condition.span, what="IF branch" if first else "ELSIF branch")
    elif not s.body:
        b.report("W1123", s.span, what="FOR loop" if isinstance(s, ast.For) else "WHILE loop")
