"""A loop ends: its condition can change, or an EXIT, RETURN or JMP leaves it.

A cycle that does not end stops the application by its watchdog.

Source: coding guidelines of PLCopen, L13; spec LST-30, LST-31.

Passes:
    VAR n : INT; END_VAR
    WHILE TRUE DO
        n := n + 1;
        IF n > 10 THEN EXIT; END_IF
    END_WHILE
Fails:
    VAR n : INT; END_VAR
    WHILE TRUE DO                  (* W1129: never ends *)
        n := n + 1;
    END_WHILE
Fails:
    VAR n, k : INT; END_VAR
    WHILE k < 10 DO                (* W1130: nothing inside changes k *)
        n := n + 1;
    END_WHILE
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from tappet.lang import ast
from tappet.lang.symbols import BuiltinSymbol, Storage, VarSymbol
from tappet.lang.types import BOOL, Reference
from tappet.lang.walk import bodies, expressions, own_expressions, root, statements, targets

if TYPE_CHECKING:
    from tappet.lang.analysis.context import Body

CODES = ("W1129", "W1130")
NODES = (ast.While, ast.RepeatUntil)
_LEAVING = (ast.Return, ast.Jump, ast.Try)
_FIXED = frozenset({Storage.LOCAL, Storage.INSTANCE, Storage.PROGRAM, Storage.PARAMETER})


def check_statement(b: Body, s: ast.While | ast.RepeatUntil) -> None:
    """Reports loops whose condition cannot change and that nothing leaves."""
    condition = s.condition
    endless = condition.is_constant and bool(condition.constant) is isinstance(s, ast.While)
    if (condition.is_constant and not endless) or condition.type is not BOOL:
        return
    names: set[int] = set()
    if not endless:
        for e in expressions(condition):
            if isinstance(e, (ast.Call, ast.Deref, ast.Member, ast.Index, ast.AssignExpr, ast.Held)):
                return
            if isinstance(e, ast.Name) and not e.is_constant:
                symbol = e.symbol
                if not isinstance(symbol, VarSymbol) or symbol.home not in _FIXED:
                    return
                if isinstance(symbol.type, Reference) or symbol.section == "VAR_IN_OUT":
                    return
                names.add(id(symbol))
        if not names:
            return
    if _leaves(s.body, 0):
        return
    if endless:
        b.report("W1129", condition.span)
        return
    for inner in statements(s.body):
        for e in own_expressions(inner):
            if isinstance(e, ast.Call) and not isinstance(e.target, BuiltinSymbol):
                return  # what is called may change it
        for target in targets(inner):
            place = root(target)
            if isinstance(place, ast.Name) and id(place.symbol) in names:
                return
    b.report("W1130", condition.span)


def _leaves(body: list[ast.Stmt], loops: int) -> bool:
    for s in body:
        if isinstance(s, _LEAVING) or (isinstance(s, ast.Exit) and loops == 0):
            return True
        inner = loops + isinstance(s, (ast.For, ast.While, ast.RepeatUntil))
        if any(_leaves(part, inner) for part in bodies(s)):
            return True
    return False
