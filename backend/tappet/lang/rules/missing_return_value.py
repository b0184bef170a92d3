"""A function assigns its result.

Source: spec LDEC-33, POU-03.

Passes:
    FUNCTION F_Double : INT
    VAR_INPUT x : INT; END_VAR
    F_Double := 2 * x;
    END_FUNCTION
Fails:
    FUNCTION F_Double : INT        (* W1209: never assigns its result *)
    VAR_INPUT x : INT; END_VAR
    VAR y : INT; END_VAR
    y := 2 * x;
    END_FUNCTION
"""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from tappet.lang.analysis.context import Body

CODES = ("W1209",)


def check_pou(b: Body) -> None:
    """Reports a FUNCTION with a body that leaves its result alone."""
    pou = b.pou
    if pou is None or pou.kind != "FUNCTION" or pou.result is None or pou.pou is None or not pou.pou.body:
        return
    if pou.return_type is not None and id(pou.result) not in b.session.written:
        b.report("W1209", pou.pou.name_span, name=pou.name)
