"""The variable of a FOR loop is written by the loop alone.

The loop adds its step to whatever the body leaves in the variable.

Source: spec LST-28.

Passes:
    VAR i, n : INT; END_VAR
    FOR i := 1 TO 10 DO n := n + i; END_FOR
Fails:
    VAR i : INT; END_VAR
    FOR i := 1 TO 10 DO
        i := i + 1;                (* W1111: i is written inside the loop *)
    END_FOR
"""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from tappet.lang.analysis.context import Body

CODES = ("W1111",)


def check_pou(b: Body) -> None:
    """Reports assignments to the variable of a loop around them."""
    for symbol, span in b.loop_writes:
        b.report("W1111", span, name=symbol.name)
    b.loop_writes.clear()
