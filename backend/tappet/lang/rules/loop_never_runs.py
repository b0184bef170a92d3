"""A FOR loop with constant bounds runs at least once.

Source: spec LST-28.

Passes:
    VAR i, n : INT; END_VAR
    FOR i := 10 TO 1 BY -1 DO n := n + i; END_FOR
Fails:
    VAR i, n : INT; END_VAR
    FOR i := 10 TO 1 DO n := n + i; END_FOR   (* W1136: never runs *)
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from tappet.lang import ast

if TYPE_CHECKING:
    from tappet.lang.analysis.context import Body

CODES = ("W1136",)
NODES = (ast.For,)


def check_statement(b: Body, s: ast.For) -> None:
    """Reports bounds in the wrong direction."""
    if not isinstance(s.start, _WRITTEN) or not isinstance(s.stop, _WRITTEN):
        return  # a named constant may make a loop of no turns on purpose
    low, high = s.start.constant, s.stop.constant
    step = 1 if s.step is None else s.step.constant
    if not isinstance(low, int) or not isinstance(high, int) or not isinstance(step, int):
        return
    if (step > 0 and high < low) or (step < 0 and high > low):
        b.report("W1136", s.stop.span, low=low, high=high, step=step)


_WRITTEN = (ast.Literal, ast.Unary)
