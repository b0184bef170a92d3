"""Variables of functions and methods are new in each call: RETAIN and PERSISTENT mean nothing there.

Source: spec LDEC-77.

Passes:
    FUNCTION_BLOCK FB_Hours
    VAR RETAIN nHours : UDINT; END_VAR
    nHours := nHours + 1;
    END_FUNCTION_BLOCK
Fails:
    FUNCTION F_Hours : UDINT
    VAR RETAIN nHours : UDINT; END_VAR   (* W1202: no effect in a function *)
    nHours := nHours + 1;
    F_Hours := nHours;
    END_FUNCTION
"""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from tappet.lang.analysis.context import Body

CODES = ("W1202",)


def check_pou(b: Body) -> None:
    """Reports remanent blocks in functions and methods."""
    pou = b.pou
    if pou is None or pou.pou is None or pou.kind not in ("FUNCTION", "METHOD"):
        return
    for block in pou.pou.blocks:
        if block.section != "VAR_STAT" and block.flags & {"RETAIN", "PERSISTENT"}:
            b.report("W1202", block.span)
