"""The conditions of an IF chain differ: the second of two equal ones is never reached.

Source: spec LST-25.

Passes:
    VAR a, n : INT; END_VAR
    IF a = 1 THEN n := 1; ELSIF a = 2 THEN n := 2; END_IF
Fails:
    VAR a, n : INT; END_VAR
    IF a = 1 THEN n := 1; ELSIF a = 1 THEN n := 2; END_IF   (* W1131: the same condition *)
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from tappet.lang import ast
from tappet.lang.diagnostics import Related
from tappet.lang.walk import expressions, same

if TYPE_CHECKING:
    from tappet.lang.analysis.context import Body

CODES = ("W1131",)
NODES = (ast.If,)
_COMPARED = 50
"""So many branches are compared with each other; the time grows with the square."""


def check_statement(b: Body, s: ast.If) -> None:
    """Reports an ELSIF whose condition stands above it already."""
    branches = s.branches
    for number in range(1, min(len(branches), _COMPARED)):
        condition = branches[number][0]
        for earlier, _ in branches[:number]:
            if same(earlier, condition) and not any(isinstance(e, ast.Call) for e in expressions(condition)):
                place = Related("the same condition", b.uri, earlier.span)
                b.report("W1131", condition.span, [place], line=earlier.span.line + 1 - _first_line(b))
                break


def _first_line(b: Body) -> int:
    """Line from which the lines of this text are counted in the editor."""
    return b.source.body_line
