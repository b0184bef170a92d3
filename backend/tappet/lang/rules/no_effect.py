"""A statement does something: an expression alone computes a value that nobody uses.

Most often an assignment was meant and `=` was written for `:=`.

Source: spec LST-20.

Passes:
    VAR a, b : INT; END_VAR
    a := b;
Fails:
    VAR a, b : INT; END_VAR
    a = b;                         (* W1108: the comparison has no effect *)
Fails:
    VAR a, b : INT; END_VAR
    a + b;                         (* W1101: the expression has no effect *)
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from tappet.lang import ast

if TYPE_CHECKING:
    from tappet.lang.analysis.context import Body

CODES = ("W1101", "W1108")
NODES = (ast.ExprStmt,)


def check_statement(b: Body, s: ast.ExprStmt) -> None:
    """Reports an expression that stands alone."""
    e = s.expr
    if s.call is not None or isinstance(e, (ast.Call, ast.AssignExpr)) or _is_incomplete(e):
        return
    if isinstance(e, ast.Binary) and e.op == "=":
        b.report("W1108", e.span)
    else:
        b.report("W1101", e.span)


def _is_incomplete(e: ast.Expr) -> bool:
    """Whether the parser has missed an operand, and said so."""
    while isinstance(e, (ast.Binary, ast.Unary)):
        if isinstance(e, ast.Binary) and _is_incomplete(e.right):
            return True
        e = e.left if isinstance(e, ast.Binary) else e.operand
    return isinstance(e, ast.ErrorExpr)
