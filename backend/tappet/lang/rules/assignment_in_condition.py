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
    if isinstance(s, ast.If):
        for condition, _ in s.branches:
            if condition.__class__ is ast.AssignExpr:
                _check(b, condition)
    else:
        _check(b, s.condition)


def _check(b: Body, e: ast.Expr) -> None:
    if isinstance(e, ast.AssignExpr) and not isinstance(e.value, _COMPUTED):
        b.report("W1124", e.span, name=getattr(e.target, "name", "a variable"))
