"""The step behind the bound of a FOR loop stays inside the type of its variable.

The variable is compared after the step has been added; at the limit of its type it wraps and the loop never
ends.

Source: spec LST-29.

Passes:
    VAR i : INT; n : DINT; END_VAR
    FOR i := 0 TO 127 DO n := n + 1; END_FOR
Passes:
    VAR u : USINT; n : DINT; END_VAR
    FOR u := 9 TO 1 BY -1 DO n := n + 1; END_FOR
    FOR u := 0 TO 240 BY 50 DO n := n + 1; END_FOR
Fails:
    VAR u : USINT; n : DINT; END_VAR
    FOR u := 9 TO 0 BY -1 DO       (* W1106: a USINT cannot be -1 *)
        n := n + 1;
    END_FOR
Fails:
    VAR u : USINT; n : DINT; END_VAR
    FOR u := 9 TO 1 BY -2 DO       (* W1106: behind 1 comes 255 *)
        n := n + 1;
    END_FOR
Fails:
    VAR i : SINT; n : DINT; END_VAR
    FOR i := 0 TO 127 DO           (* W1106: 127 is the limit of SINT *)
        n := n + 1;
    END_FOR
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from tappet.lang import ast
from tappet.lang.dataflow.for_loops import iterations, limits, step_of

if TYPE_CHECKING:
    from tappet.lang.analysis.context import Body

CODES = ("W1106",)
NODES = (ast.For,)


def check_statement(b: Body, s: ast.For) -> None:
    """Reports a constant bound that leaves no room for one more step."""
    known, step, bound = limits(s), step_of(s), s.stop.constant
    if known is None or step is None or not isinstance(bound, int):
        return
    found = iterations(s)
    if found is None:
        endless = bound == (known[1] if step > 0 else known[0])
    else:
        endless = found.any and not known[0] <= found.last + step <= known[1]
    if endless:
        b.report("W1106", s.stop.span, bound=bound, type=s.variable.type)
