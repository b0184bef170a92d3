"""Expressions that decide: those of IF, WHILE, UNTIL and EN."""

from __future__ import annotations

from tappet.lang import ast
from tappet.lang import types as t
from tappet.lang.analysis.adaptation import as_zero, retype
from tappet.lang.analysis.context import Body
from tappet.lang.analysis.expressions import value


def condition(b: Body, e: ast.Expr) -> None:
    """Resolves an expression that decides: it must be BOOL."""
    type_ = value(b, e)
    if type_ is None or type_ is t.BOOL:
        return
    if (e.untyped and retype(e, t.BOOL)) or as_zero(e, t.BOOL):
        return
    if t.value_type(type_) is not t.BOOL:
        b.report("E0307", e.span, source=type_)
