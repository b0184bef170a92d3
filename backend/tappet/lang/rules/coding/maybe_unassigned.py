"""A temporary variable has a value on every way to where it is read.

Source: coding guidelines of PLCopen, CP3 (variables shall be initialised before being used).

Passes:
    @static
    FUNCTION F_Half : INT
    VAR_INPUT nValue : INT; END_VAR
    VAR nPart : INT; END_VAR
    IF nValue > 3 THEN nPart := 3; ELSE nPart := nValue; END_IF
    F_Half := nPart;
    END_FUNCTION
Fails:
    @static
    FUNCTION F_Half : INT
    VAR_INPUT nValue : INT; END_VAR
    VAR nPart : INT; END_VAR
    IF nValue > 3 THEN nPart := 3; END_IF
    F_Half := nPart;               (* S1222: not assigned when nValue <= 3 *)
    END_FUNCTION
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from tappet.lang.dataflow.flow import Reaching
from tappet.lang.rules.temporary_values import temporaries
from tappet.lang.walk import statements

if TYPE_CHECKING:
    from tappet.lang.analysis.context import Body

CODES = ("S1222",)


def check_pou(b: Body, chosen: frozenset[str]) -> None:
    """Reports the first read of each variable that some way has not assigned."""
    watched = temporaries(b)
    body = b.pou.pou.body if b.pou is not None and b.pou.pou is not None else []
    if not watched or any(s.label for s in statements(body)):
        return
    reaching = Reaching(key for key, decl in watched.items() if decl.init is None)
    reaching.run(body)
    for name in reaching.sometimes.values():
        b.report("S1222", name.span, name=name.name)
