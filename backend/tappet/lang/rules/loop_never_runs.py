"""A FOR loop with constant bounds runs at least once.

Source: spec LST-28.

Passes:
    VAR i, n : INT; END_VAR
    FOR i := 10 TO 1 BY -1 DO n := n + i; END_FOR
Passes:
    VAR u : USINT; n : INT; END_VAR
    FOR u := 10 TO 1 BY -1 DO n := n + u; END_FOR
Fails:
    VAR u : USINT; n : INT; END_VAR
    FOR u := 1 TO 10 BY -1 DO n := n + u; END_FOR   (* W1136: never runs *)
Fails:
    VAR i, n : INT; END_VAR
    FOR i := 10 TO 1 DO n := n + i; END_FOR   (* W1136: never runs *)
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from tappet.lang import ast
from tappet.lang.dataflow.for_loops import iterations

if TYPE_CHECKING:
    from tappet.lang.analysis.context import Body

CODES = ("W1136",)
NODES = (ast.For,)


def check_statement(b: Body, s: ast.For) -> None:
    """Reports bounds in the wrong direction."""
    if not isinstance(s.start, _WRITTEN) or not isinstance(s.stop, _WRITTEN):
        return  # a named constant may make a loop of no iterations on purpose
    found = iterations(s)
    if found is not None and not found.any:
        b.report("W1136", s.stop.span, low=found.first, high=found.bound, step=found.step)


_WRITTEN = (ast.Literal, ast.Unary)
