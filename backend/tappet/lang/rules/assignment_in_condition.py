"""A condition compares; `:=` inside it assigns.

An assignment of a comparison or of the result of a call is taken as meant: `IF bOk := (n > 3) THEN`.

Source: spec LST-40 (assignments as expressions).

Passes:
    VAR a, b : BOOL; END_VAR
    IF a = b THEN a := FALSE; END_IF
Fails:
    VAR a, b : BOOL; END_VAR
    IF a := b THEN b := FALSE; END_IF   (* W1124: assigns to a *)
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from tappet.lang import ast

if TYPE_CHECKING:
    from tappet.lang.analysis.context import Body

CODES = ("W1124",)
_COMPUTED = (ast.Binary, ast.Call, ast.AssignExpr)
NODES = (ast.If, ast.While, ast.RepeatUntil)


def check_statement(b: Body, s: ast.If | ast.While | ast.RepeatUntil) -> None:
    """Reports conditions that are an assignment as a whole."""
    conditions = [c for c, _ in s.branches] if isinstance(s, ast.If) else [s.condition]
    for condition in conditions:
        if isinstance(condition, ast.AssignExpr) and not isinstance(condition.value, _COMPUTED):
            target = condition.target
            b.report("W1124", condition.span, name=getattr(target, "name", "a variable"))
