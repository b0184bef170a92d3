"""A shift by a constant moves less than the whole width.

Source: spec LOPR-34.

Passes:
    VAR w : WORD; END_VAR
    w := SHL(w, 3);
Fails:
    VAR y : BYTE; END_VAR
    y := SHR(y, 8);                (* W1112: the shift is as wide as BYTE *)
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from tappet.lang import ast
from tappet.lang.symbols import BuiltinSymbol
from tappet.lang.types import Elementary

if TYPE_CHECKING:
    from tappet.lang.analysis.context import Body

CODES = ("W1112",)
NODES = (ast.Call,)


def check_expression(b: Body, e: ast.Call) -> None:
    """Reports a constant count that is not below the width."""
    target = e.target
    if not isinstance(target, BuiltinSymbol) or target.name not in ("SHL", "SHR"):
        return
    content, count = e.args[0].value, e.args[1].value
    if content is None or count is None or content.is_constant:
        return
    type_ = target.return_type
    number = count.constant
    if isinstance(type_, Elementary) and isinstance(number, int) and number >= 8 * type_.size:
        b.report("W1112", count.span, count=number, type=type_)
