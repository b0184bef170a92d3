"""Behind RETURN, EXIT, CONTINUE or JMP there is nothing, unless a label leads there.

Source: spec LST-24, LST-33..LST-35.

Passes:
    VAR a : INT; END_VAR
    IF a > 3 THEN
        RETURN;
    END_IF
    a := 1;
Passes:
    VAR a : INT; END_VAR
    again: a := a + 1;
    IF a > 3 THEN RETURN; END_IF
    JMP again;
Fails:
    VAR a : INT; END_VAR
    RETURN;
    a := 1;                        (* W1102: never reached *)
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from tappet.lang import ast

if TYPE_CHECKING:
    from tappet.lang.analysis.context import Body

CODES = ("W1102",)
_LEAVING = frozenset({ast.Return, ast.Exit, ast.Continue, ast.Jump})


def check_list(b: Body, body: list[ast.Stmt]) -> None:
    """Reports the first statement behind one that leaves."""
    left = False
    for s in body:
        if left and s.label is None and not isinstance(s, (ast.Empty, ast.PragmaStmt)):
            b.report("W1102", s.span)
            return
        if s.label is not None:
            left = False
        if s.__class__ in _LEAVING:
            left = True
