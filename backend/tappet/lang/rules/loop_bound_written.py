"""The last value of a FOR loop does not change while the loop runs.

It is computed again before each turn, so that the number of turns is hard to see.

Source: coding guidelines of PLCopen, L14; spec LST-28.

Passes:
    VAR i, n, k : INT; END_VAR
    FOR i := 1 TO n DO k := k + i; END_FOR
Fails:
    VAR i, n : INT; END_VAR
    FOR i := 1 TO n DO
        n := n - 1;                (* W1126: n is the bound of the loop *)
    END_FOR
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from tappet.lang import ast
from tappet.lang.walk import expressions, statements, targets

if TYPE_CHECKING:
    from tappet.lang.analysis.context import Body

CODES = ("W1126",)
NODES = (ast.For,)


def check_statement(b: Body, s: ast.For) -> None:
    """Reports assignments to a variable of the bound or the step."""
    if s.stop.is_constant and (s.step is None or s.step.is_constant):
        return
    names = {id(e.symbol) for e in expressions(s.stop, s.step) if isinstance(e, ast.Name)}
    for inner in statements(s.body):
        for target in targets(inner):
            if isinstance(target, ast.Name) and id(target.symbol) in names:
                b.report("W1126", target.span, name=target.name)
