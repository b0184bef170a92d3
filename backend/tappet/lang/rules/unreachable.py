"""Behind RETURN, EXIT, CONTINUE or JMP, or branches that all leave, is nothing, unless a label leads there.

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
Fails:
    VAR a, b : INT; END_VAR
    IF a > 3 THEN
        RETURN;
    ELSE
        __TRY
            b := b / a;
            RETURN;
        __CATCH
            RETURN;
        __ENDTRY
    END_IF
    a := 1;                        (* W1102: never reached *)
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING

from tappet.lang import ast
from tappet.lang.walk import statements

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
        if _leaves(s):
            left = True


def _leaves(s: ast.Stmt) -> bool:
    """Whether no way leads behind a statement; labels inside are not followed."""
    if s.__class__ in _LEAVING:
        return True
    if isinstance(s, ast.If) and s.otherwise is not None:
        return _all_leave([s.otherwise, *(body for _, body in s.branches)])
    if isinstance(s, ast.Case) and s.otherwise is not None:
        return _all_leave([s.otherwise, *(branch.body for branch in s.branches)])
    if isinstance(s, ast.Try):
        return _all_leave([s.final]) or _all_leave([s.body, s.handler] if s.caught else [s.body])
    return False


def _all_leave(lists: Iterable[list[ast.Stmt]]) -> bool:
    return all(
        any(map(_leaves, body)) and not any(inner.label is not None for inner in statements(body))
        for body in lists
    )
