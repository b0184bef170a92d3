"""A local variable does not hide a global one, nor a variable of a method one of its block.

Source: coding guidelines of PLCopen, N9 (no name twice in overlapping scopes); spec LDEC-08.

Passes:
    FUNCTION_BLOCK FB
    VAR nCount : INT; END_VAR
    METHOD Add : BOOL
    VAR_INPUT nStep : INT; END_VAR
    nCount := nCount + nStep;
    Add := TRUE;
    END_METHOD
    END_FUNCTION_BLOCK
Fails:
    @source GVL
    VAR_GLOBAL nCount : INT; END_VAR
    @source P
    PROGRAM P
    VAR nCount : INT; END_VAR      (* W1204: hides GVL.nCount *)
    nCount := nCount + 1;
    END_PROGRAM
Fails:
    FUNCTION_BLOCK FB
    VAR nCount : INT; END_VAR
    METHOD Add : BOOL
    VAR nCount : INT; END_VAR      (* W1216: hides nCount of FB *)
    nCount := 1;
    Add := nCount > 0;
    END_METHOD
    END_FUNCTION_BLOCK
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from tappet.lang.diagnostics import Related
from tappet.lang.source import Scope
from tappet.lang.symbols import VarSymbol

if TYPE_CHECKING:
    from tappet.lang.analysis.context import Body

CODES = ("W1204", "W1216")
OWN_CODE_ONLY = True


def check_pou(b: Body) -> None:
    """Reports own variables with the name of a global variable, or of a variable of the block."""
    pou = b.pou
    if pou is None or pou.pou is None:
        return
    names = b.names
    members = pou.owner.locals if pou.owner is not None and pou.kind == "METHOD" else {}
    for block in pou.pou.blocks:
        if block.section == "VAR_EXTERNAL":
            continue
        for decl in block.variables:
            key = decl.name.upper()
            hidden = members.get(key) if members else None
            if hidden is not None and hidden is not decl.symbol:
                owner = pou.owner.name if pou.owner is not None else ""
                b.report("W1216", decl.name_span, _place(hidden), name=decl.name, owner=owner)
                continue
            other = names.get(key)
            if not isinstance(other, VarSymbol) or other is decl.symbol or other.source is None:
                continue
            if other.source.scope is not Scope.LIBRARY:
                b.report("W1204", decl.name_span, _place(other), name=decl.name, owner=other.owner)


def _place(symbol: VarSymbol) -> list[Related]:
    if symbol.source is None or symbol.span is None:
        return []
    return [Related("hidden by it", symbol.source.uri, symbol.span)]
