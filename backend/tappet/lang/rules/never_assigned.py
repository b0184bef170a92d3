"""A variable of a function block that is read gets a value somewhere.

Source: spec LDEC-42.

Passes:
    FUNCTION_BLOCK FB
    VAR_OUTPUT bDone : BOOL; END_VAR
    VAR bReady : BOOL; END_VAR
    bDone := bReady;
    bReady := TRUE;
    END_FUNCTION_BLOCK
Fails:
    FUNCTION_BLOCK FB
    VAR_OUTPUT bDone : BOOL; END_VAR
    VAR bReady : BOOL; END_VAR     (* W1141: read, never assigned *)
    bDone := bReady;
    END_FUNCTION_BLOCK
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from tappet.lang.symbols import PouSymbol, VarSymbol
from tappet.lang.types import Elementary

if TYPE_CHECKING:
    from tappet.lang.analysis.context import Session

CODES = ("W1141",)


def check_variables(session: Session, pou: PouSymbol) -> None:
    """Reports local variables of simple type without initial value that are read and never written."""
    if pou.kind != "FUNCTION_BLOCK":
        return
    assert pou.pou is not None
    assert pou.source is not None
    used, written = session.used, session.written
    for block in pou.pou.blocks:
        if block.section != "VAR" or block.flags or block.attributes:
            continue
        for decl in block.variables:
            symbol = decl.symbol
            if (
                decl.init is None
                and decl.address is None
                and not decl.attributes
                and id(symbol) in used
                and id(symbol) not in written
                and isinstance(symbol, VarSymbol)
                and isinstance(symbol.type, Elementary)
            ):
                session.report("W1141", pou.source.uri, decl.name_span, name=decl.name, type=symbol.type)
